"""Summaries as JSON."""

from __future__ import annotations

from tests.commands import CASES, json_answer


def test_two_cases_are_two_documents_of_json() -> None:
    case = CASES / "simpson.yaml"
    alone = json_answer("summary", case)
    assert json_answer("summary", case, case) == [alone, alone]


def test_json_has_the_digits_of_the_result() -> None:
    case = CASES / "zf-9hp48.yaml"
    made = json_answer("summary", case)
    result = json_answer("run", case)
    assert [line["ratio"] for line in made["gears"]] == result["ratio"]
    assert [line["efficiency"] for line in made["gears"]] == result["efficiency"]
