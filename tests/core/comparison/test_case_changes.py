"""What is other in a case, by the paths that a sweep varies."""

import pytest

from tests.commands import SHIPPED
from vstatics import Transmission
from vstatics.core import readers
from vstatics.core.comparison.case_changes import case_changes
from vstatics.core.model.parts import Gear

CASES = [path for path in SHIPPED if path.suffix == ".yaml"]


def test_a_case_is_that_of_itself() -> None:
    for case in map(readers.load, CASES):
        renamed = case.replace(name="other", description="other", source="other")
        assert list(case_changes(renamed, case)) == []


def test_parts_and_gears_that_are_new_or_gone_are_one_path(zf: Transmission) -> None:
    fewer, gear = zf.replace(gears=zf.gears[1:]), {"engaged": ["A", "B", "C"]}
    assert list(case_changes(fewer, zf)) == [("gears.1", gear, None)]
    assert list(case_changes(zf, fewer)) == [("gears.1", None, gear)]


def test_the_order_of_engaged_elements_is_no_change(zf: Transmission) -> None:
    gears = [Gear(gear.engaged[::-1], name=gear.name) for gear in zf.gears]
    assert list(case_changes(zf.replace(gears=gears), zf)) == []
    gears[2] = Gear([1, 2, 4], name=gears[2].name)
    [change] = case_changes(zf.replace(gears=gears), zf)
    assert change == ("gears.3.engaged", ["B", "C", "E"], ["A", "B", "D"])


@pytest.fixture
def zf() -> Transmission:
    return readers.load(next(path for path in CASES if path.stem == "zf-8hp70"))
