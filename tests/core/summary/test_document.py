"""Summaries as JSON."""

from __future__ import annotations

import json

from tests.commands import CASES, vstatics


def test_two_cases_are_two_documents_of_json() -> None:
    case = CASES / "simpson.yaml"
    alone = json.loads(vstatics("summary", case, "-f", "json").out)
    assert json.loads(vstatics("summary", case, case, "-f", "json").out) == [alone, alone]


def test_json_has_the_digits_of_the_result() -> None:
    case = CASES / "zf-9hp48.yaml"
    made = json.loads(vstatics("summary", case, "-f", "json").out)
    result = json.loads(vstatics("run", case, "-f", "json").out)
    assert [line["ratio"] for line in made["gears"]] == result["ratio"]
    assert [line["efficiency"] for line in made["gears"]] == result["ETA"]
