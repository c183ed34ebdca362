"""The cylinders of the engine: how many there may be, and that every format keeps them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.commands import vstatics
from vstatics import CaseError, Gear, Mechanism, Transmission, load
from vstatics.core.model.fields import MOST_CYLINDERS
from vstatics.core.writers.named import write_json, write_yaml

PAIR = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()])


@pytest.mark.parametrize("number", [1, 4, MOST_CYLINDERS])
@pytest.mark.parametrize(("suffix", "write"), [("yaml", write_yaml), ("json", write_json)])
def test_they_are_written_and_read_again(
    number: int, suffix: str, write: object, tmp_path: Path
) -> None:
    case, file = PAIR.replace(cylinders=number), tmp_path / f"case.{suffix}"
    assert callable(write)
    file.write_text(write(case), encoding="utf-8")
    assert load(file) == case
    assert load(file).cylinders == number


@pytest.mark.parametrize("number", [0, -4, MOST_CYLINDERS + 1, 4.5])
def test_other_numbers_are_refused(number: float) -> None:
    with pytest.raises(CaseError, match=r"expected a whole number from 1 to 48 \[E740\]"):
        PAIR.replace(cylinders=number)


def test_a_case_has_none_where_it_does_not_say() -> None:
    assert PAIR.cylinders is None
    assert "cylinders" not in write_yaml(PAIR)


def test_a_deck_says_that_it_does_not_keep_them(tmp_path: Path) -> None:
    file = tmp_path / "case.json"
    file.write_text(write_json(PAIR.replace(cylinders=6)), encoding="utf-8")
    said = vstatics("convert", file, tmp_path / "case.dat")
    assert "not kept: cylinders" in said.err


def test_results_of_cases_that_differ_in_them_alone_are_the_same(tmp_path: Path) -> None:
    for name, number in (("a", 4), ("b", 6)):
        (tmp_path / f"{name}.json").write_text(write_json(PAIR.replace(cylinders=number)))
        said = vstatics("run", tmp_path / f"{name}.json", "-f", "json")
        assert said.json["case"]["cylinders"] == number
        (tmp_path / f"{name}-result.json").write_text(said.out, encoding="utf-8")
    said = vstatics("compare", tmp_path / "a-result.json", tmp_path / "b-result.json")
    told = "a: 1 change of the case; no number differs\n  case        cylinders  6 -> 4\n"
    assert (said.status, said.out) == (0, told)
