"""Values that a case derives from its fields, and shares with cases of other numbers."""

import copy
from dataclasses import replace
from functools import cached_property

from tests.core.statics.batches import ARRAYS, same
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.parts import OfLoad

CASE = Transmission(
    4,
    [ShiftElement(2, drag=0.01), ShiftElement(3, 4, kind="freewheel")],
    [Mechanism(1, 2, 3, -2.5, 0.96), Mechanism(3, 4, 0, 2.0, planet_ratio=-1.5)],
    [Gear([1], drag={1: OfLoad(2.0, 100.0)}), Gear([], coast=True)],
    drag={4: 0.02},
)


def names_of_links(case: Transmission) -> list[str]:
    return list(case.link_names)


def test_a_case_with_other_numbers_shares_only_what_does_not_depend_on_them() -> None:
    """Each value equals that of a case that is built anew."""
    values = [pair for part in Transmission.__mro__ for pair in vars(part).items()]
    others = [
        part._replace(ratio=1.0, efficiency=0.9, planet_ratio=2.0) for part in CASE.mechanisms
    ]
    for name in (name for name, value in values if isinstance(value, cached_property)):
        getattr(CASE, name)
        anew, changed = replace(CASE, mechanisms=others), CASE.with_numbers(others)
        assert name == "_derived" or getattr(changed, name) == getattr(anew, name), name


def test_planets_of_a_case_with_other_numbers_have_speeds_of_their_own() -> None:
    """The speed of a planet is w_1/planet_ratio, also after the original case was solved."""
    solve(CASE)
    others = [part._replace(planet_ratio=2.0) for part in CASE.mechanisms]
    found, expected = solve(CASE.with_numbers(others)), solve(replace(CASE, mechanisms=others))
    assert all(same(getattr(found, name), getattr(expected, name)) for name in ARRAYS)
    assert found.planet_speeds[0, 1] == found.speeds[0, 2] / 2.0


def test_cases_that_differ_in_numbers_share_derived_values() -> None:
    """Values are calculated once; a copy, or a case with other parts, calculates its own."""
    names = CASE.derived(names_of_links)
    assert CASE.with_numbers(CASE.mechanisms).derived(names_of_links) is names
    for other in (copy.copy(CASE), replace(CASE, name="other")):
        assert other.derived(names_of_links) == names
        assert other.derived(names_of_links) is not names
