"""Paths of numbers that vary: what they name, and what is said of those that name nothing."""

from typing import Any

import numpy as np
import pytest

from tests.installed import needs
from tests.rejects import rejects
from vstatics import CaseError, Gear, Load, Mechanism, ShiftElement, Transmission, solve

CASE = Transmission(
    2,
    [ShiftElement(1, 2, name="C")],
    [Mechanism(1, 2, 0, -2.5, name="pair")],
    [Gear(name="low")],
    link_names=["in", "out"],
    load=Load(1000, 100),
)


@needs("sweep")
def test_a_path_that_names_nothing_is_reported_with_the_nearest() -> None:
    for path, near in (
        ("load.torqe", "vary: the case has no number `load.torqe`; did you mean `load.torque`?"),
        ("gears.lo.drag.out", "did you mean `gears.low.drag.out`?"),
    ):
        with rejects(CaseError, near):
            solve(CASE, vary={path: [0.5, 1]})


def test_a_number_that_can_not_be_is_an_error() -> None:
    for path, number, said in (
        ("drag.out", -1, "vary.drag.out: read -1 in variant 1, expected a torque of 0 or more"),
        ("load.speed", 0, "read 0 in variant 1, expected a finite speed other than 0"),
        ("load.torque", np.nan, "read nan in variant 1, expected a finite number"),
        ("pair.efficiency", 1.5, "expected an efficiency above 0 and up to 1"),
        ("pair.back_efficiency", -1, "expected an efficiency from 0 to 1"),
        ("pair.ratio", 0, "expected a finite ratio other than 0"),
    ):
        with pytest.raises(CaseError, match=r"\[E4\d\d\]") as caught:
            solve(CASE, vary={path: [0.5, number]})
        assert said in str(caught.value)


def test_arrays_go_together_on_one_axis() -> None:
    vary: dict[str, Any]
    for vary, said in (
        ({"drag.out": np.ones((2, 2))}, "expected arrays with one axis"),
        ({"drag.out": [1, 2], "drag.in": [1, 2, 3]}, r"read drag.out \(2,\), drag.in \(3,\)"),
        ({"drag.out": 1, "gears.low.drag.out": 2}, r"`gears\.low\.drag\.out` is varied twice"),
    ):
        with pytest.raises((CaseError, ValueError), match=said):
            solve(CASE, vary=vary)
    with pytest.raises(ValueError, match="not both"):
        solve(CASE, vary={"drag.out": 1}, ratios=[[-2.0]])
    without = CASE.replace(load=None)
    with pytest.raises(CaseError, match=r"gears\.low\.drag\.out varies in SI, .* with a torque"):
        solve(without, vary={"drag.out": 1})
    assert solve(without, vary={"drag.out": 1, "load.torque": 100}).consistent.all()


def test_a_number_of_a_gear_is_that_of_one_gear() -> None:
    """A drag of 1 N*m at an input of 100 N*m takes a hundredth."""
    case = CASE.replace(gears=[Gear(name="low"), Gear(name="high")])
    found = solve(case, vary={"gears.high.drag.in": [0.0, 1.0]})
    assert found.efficiency.tolist() == [[1, 1], [1, 0.99]]
    everywhere = solve(case, vary={"gears.*.drag.in": [0.0, 1.0]})
    assert everywhere.efficiency.tolist() == [[1, 1], [0.99, 0.99]]
