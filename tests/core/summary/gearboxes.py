"""Gearboxes with their summaries."""

import pytest

from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.summary import Summary, summarize
from vstatics.core.summary.extremes import Largest


def summary_of(name: str) -> Summary:
    return summarize(shipped_results(name))


def assert_largest(line: Largest, value: float, gear: str) -> None:
    assert line.value == pytest.approx(value)
    assert line.gear == gear


def differential(u: float = -2.5, **more: object) -> Transmission:
    """Sun in, carrier out; the brake holds the ring, the clutch joins sun and ring."""
    return Transmission(
        links=3,
        shift_elements=[ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
        mechanisms=[Mechanism(1, 2, 3, u, 0.96)],
        gears=[Gear([2], name="low"), Gear([1], name="direct")],
        **more,  # type: ignore[arg-type]
    )
