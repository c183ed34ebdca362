"""Gears are named: nobody gets another gear than the one whose name was given."""

import pytest

from tests.commands import CASES, MZKT, vstatics
from tests.shipped import shipped_results
from vstatics import Gear, Results, Transmission, load, solve

EIGHT = shipped_results("zf-8hp70.yaml")


def box(*names: str) -> Results:
    """Gears whose input turns so many times as fast as the output, from the first on."""
    gears = [Gear(speeds={2: 1 / n}, name=name) for n, name in enumerate(names, 1)]
    return solve(Transmission(2, [], [], gears))


def test_a_number_that_is_no_name_is_no_place_among_numbered_gears() -> None:
    """Of 1 to 8 and R `9` was R."""
    for read in ("9", "0", "10", "08"):
        with pytest.raises(ValueError, match=f"no gear '{read}'"):
            EIGHT["ratio", read]
    assert EIGHT["ratio", "#9"] == EIGHT["ratio", "R"] == EIGHT["ratio", 9]
    said = vstatics("flow", CASES / "zf-8hp70.yaml", "--gear", "9")
    assert said.status == 2
    assert "gears are 1, 2, 3, 4, 5, 6, 7, 8, R; #9 is R" in said.err


def test_a_number_may_be_meant_for_a_name_that_has_it() -> None:
    for names in (("R", "1", "2"), ("R", "1st", "2nd"), ("R1", "R2", "D1")):
        results = box(*names)
        for place, name in enumerate(names, 1):
            assert results["ratio", name] == results["ratio", f"#{place}"] == place
        for read in {"1", "2", "3"} - {*names}:
            with pytest.raises(ValueError, match=f"no gear '{read}'"):
                results["ratio", read]


def test_a_number_of_python_that_is_the_name_of_another_gear_is_refused() -> None:
    results = box("R", "1", "2")
    with pytest.raises(ValueError, match="gear 1 is 'R', and another is called '1': expected '#1'"):
        results["ratio", 1]
    assert results["ratio", 3] == results["ratio", "2"] == 3
    assert [results.gear_at(index).gear.name for index in range(3)] == ["R", "1", "2"]


def test_words_have_places_and_numbered_gears_of_a_deck_their_numbers() -> None:
    words = box("low", "high", "reverse")
    assert [words["ratio", read] for read in ("1", "2", "03", "#3", 3)] == [1, 2, 3, 3, 3]
    deck = solve(load(MZKT))
    assert deck["ratio", "4"] == deck["ratio", 4] == deck.ratio[3]
