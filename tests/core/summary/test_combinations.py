"""What else the shift elements of a transmission could give."""

from dataclasses import replace

import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.core.summary.gearboxes import differential
from vstatics import CaseError, Gear, load, solve
from vstatics.core.summary.unused_sets import Combination, combinations
from vstatics.core.writers import named


def found(name: str, *without: str, at_most: int = 1000) -> dict[frozenset[str], Combination]:
    """The combinations of a case without some of its gears, by what they engage."""
    case = load(CASES / name)
    kept = [gear for gear in case.gears if gear.name not in without]
    made = combinations(solve(replace(case, gears=kept)), at_most)
    return {frozenset(one.engaged): one for one in made}


def test_a_ravigneaux_set_by_hand() -> None:
    """Ford AOD, two of five elements, ten pairs.

    Five are its gears. Two of the three clutches turn the set as one piece: gear 3 and
    two more. A clutch and a brake on one member tie the input up, twice. Both brakes
    hold the set, and nothing drives it.
    """
    made = found("ravigneaux-aod.yaml")
    assert set(made) == {frozenset({"forward", "reverse"}), frozenset({"reverse", "direct"})}
    for one in made.values():
        assert (one.ratio, one.efficiency) == pytest.approx((1, 1))
        assert one.gear == "3"


def test_gears_that_are_left_out_are_found_again() -> None:
    """Willis: i = ring/(ring + large sun) with the large sun held, -ring/large with the carrier."""
    made = found("ravigneaux-aod.yaml", "4", "R")
    overdrive = made[frozenset({"direct", "overdrive"})]
    reverse = made[frozenset({"reverse", "low"})]
    assert (overdrive.ratio, reverse.ratio) == pytest.approx((72 / (72 + 36), -72 / 36))
    assert overdrive.gear == reverse.gear == ""
    ratios = [one.ratio for one in made.values()]
    assert ratios == sorted(ratios, reverse=True)


def test_cases_that_use_every_combination_that_there_is() -> None:
    """8HP: three of five are ten; nine are gears, and A, C, E hold the input.

    ZF 3HP22: six pairs; four gears, B and C hold the input, C and D the output. The others have
    no shift elements.
    """
    for name in ("zf-8hp70", "simpson", "wheel-hub", "power-split"):
        assert found(f"{name}.yaml") == {}


def test_a_freewheel_may_take_the_place_of_an_element() -> None:
    """TH400: the rear band does what the low roller clutch does in gear 1."""
    made = found("simpson-th400.yaml")
    band = made[frozenset({"forward clutch", "rear band"})]
    assert (band.gear, band.holding) == ("1", [])
    again = found("simpson-th400.yaml", "1")[frozenset({"forward clutch"})]
    assert again.holding == ["low roller clutch"]
    assert again.ratio == pytest.approx(2 + 26 / 54)  # both sets alike, z_sun/z_ring = 26/54


def test_too_many_combinations_are_refused() -> None:
    with pytest.raises(CaseError, match=r"3 of 5 shift elements have 10 combinations, more than"):
        found("zf-8hp70.yaml", at_most=9)
    case = CASES / "zf-8hp70.yaml"
    said = vstatics("summary", case, "--combinations", "--at-most", 9)
    assert said.gives_nothing(f"{case}: error: 3 of 5")
    without = {"--at-most": "--combinations", "--exponent": "--duty with a CSV file"}
    for option, other in without.items():
        said = vstatics("summary", case, option, 9)
        assert said.is_wrong_use(f"{option} needs {other}")


def test_a_combination_that_no_gear_uses_is_a_row_of_the_table() -> None:
    """The clutch joins sun and ring: a block turns 1:1, without losses."""
    case = named.write_yaml(differential().replace(gears=[Gear([2], name="low")]))
    said = vstatics("summary", "-", "--combinations", stdin=case.encode()).out
    _, table = said.split("\nOther combinations of shift elements\n")
    assert [line.split() for line in table.splitlines()] == [
        ["ratio", "efficiency", "same", "as", "engaged"],
        ["1.000", "1.000", "C"],
    ]


def test_that_there_are_none_is_said() -> None:
    call = "summary", CASES / "zf-8hp70.yaml", "--combinations"
    assert "combinations of shift elements: none" in vstatics(*call).out
    assert json_answer(*call)["combinations"] == []
