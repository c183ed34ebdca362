"""Ranges of ratios and tolerances by gear, as they are typed."""

import math

import pytest

from vstatics.synthesis.cli.box.ratios import (
    WantedGears,
    wanted_gears,
    wanted_ratio,
    wanted_tolerances,
)


def gears(ratios: str, tolerance: str) -> WantedGears:
    ranges = [wanted_ratio(one) for one in ratios.split(",")]
    return wanted_gears(ranges, wanted_tolerances(0.01)([tolerance]))


def test_a_number_is_the_range_of_its_tolerance() -> None:
    by_range = gears(f"{3.5 * math.exp(0.02)}:{3.5 * math.exp(-0.02)},{-2.0 * math.e}:-2", ".01")
    by_tolerance = gears(f"3.5,{-2 * math.exp(0.5)}", ".01,1=.02,R=.5")
    assert by_range.targets == pytest.approx(by_tolerance.targets, rel=1e-14)
    assert by_range.tolerances == pytest.approx(by_tolerance.tolerances, rel=1e-13)


def test_gears_are_named_by_falling_ratio_however_they_stand() -> None:
    one = gears("1,-4:-2.5,5.8:6.2,2.4", "2=.03,.02,3=.04")
    other = gears("6.2:5.8,2.4,1,-2.5:-4", ".02,3=.04,2=.03")
    assert sorted(other.tolerances) == pytest.approx(sorted(one.tolerances))
    assert sorted(other.targets) == pytest.approx(sorted(one.targets))
    assert one.tolerances == pytest.approx(
        (0.04, math.log(4 / 2.5) / 2, math.log(6.2 / 5.8) / 2, 0.03)
    )


def test_one_tolerance_of_all_is_told_once() -> None:
    assert gears("3,1", ".02") == WantedGears((3.0, 1.0), 0.02, ())
