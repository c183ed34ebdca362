"""What is other in a case, by the paths that a sweep varies."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from tests.commands import SHIPPED
from vstatics import CaseError, Transmission
from vstatics.core import readers
from vstatics.core.comparison.case_changes import case_changes
from vstatics.core.elements.part_numbers import own_part_number, part_numbers, with_part_numbers
from vstatics.core.model.parts import Gear

CASES = [path for path in SHIPPED if path.suffix == ".yaml"]


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_a_case_is_that_of_itself(path: Path) -> None:
    case = readers.load(path)
    renamed = case.replace(name="other", description="other", source="other")
    assert list(case_changes(renamed, case)) == []


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_a_number_that_a_sweep_varies_is_told_by_its_path(path: Path) -> None:
    """The variant is made by the sweep; what else it changes follows from the number."""
    case = readers.load(path)
    numbers = part_numbers(case)
    own = {name: own_part_number(case, number) for name, number in numbers.items()}
    known = [
        name
        for name, value in own.items()
        if isinstance(value, int | float) and value and numbers[name].kind != "relative_torque"
    ]
    for name in random.Random(path.stem).sample(known, min(4, len(known))):  # noqa: S311
        value = own[name]
        assert isinstance(value, int | float)
        other = value + 1 if isinstance(value, int) else value * 0.9
        try:
            variant = with_part_numbers(case, [numbers[name]], [other])
        except CaseError:
            continue  # such a case can't be
        told = {one.path: (one.expected, one.actual) for one in case_changes(variant, case)}
        assert told == {name: (pytest.approx(value), pytest.approx(other))}


def test_parts_and_gears_that_are_new_or_gone_are_one_path(zf: Transmission) -> None:
    fewer = zf.replace(gears=zf.gears[1:])
    [change] = case_changes(fewer, zf)
    assert (change.path, change.actual) == ("gears.1", None)
    assert change.expected == {"engaged": ["A", "B", "C"]}
    [change] = case_changes(zf, fewer)
    assert (change.path, change.expected) == ("gears.1", None)


def test_the_order_of_engaged_elements_is_no_change(zf: Transmission) -> None:
    gears = [Gear(gear.engaged[::-1], name=gear.name) for gear in zf.gears]
    assert list(case_changes(zf.replace(gears=gears), zf)) == []
    gears[2] = Gear([1, 2, 4], name=gears[2].name)
    [change] = case_changes(zf.replace(gears=gears), zf)
    assert change == ("gears.3.engaged", ["B", "C", "E"], ["A", "B", "D"])


@pytest.fixture
def zf() -> Transmission:
    return readers.load(next(path for path in CASES if path.stem == "zf-8hp70"))
