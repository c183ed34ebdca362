"""Gears in columns of a sweep are called as those of statics."""

from __future__ import annotations

from vstatics import Gear, Mechanism, ShiftElement, Transmission, sweep


def test_gears_in_columns_are_named_as_elsewhere() -> None:
    engaged = [Gear([1], name="low"), Gear([2], name="high")]  # ring held; all as one
    elements = [ShiftElement(2), ShiftElement(1, 2)]
    words = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], engaged)
    [chunk] = sweep(words, {"D1.ratio": [-3]}, out="ratio[2], ratio[#1]")
    assert chunk.columns.tolist() == [[1, 4]]
