"""Differences of sweeps, in words."""

from __future__ import annotations

import math

from vstatics.comparison.sweeps import sweep_lines, sweep_places
from vstatics.tables.written_results import WrittenSweep


def test_a_name_stays_whatever_is_in_it() -> None:
    """NaN is told as no value, a gear that is named so is not."""
    name = "ratio[nan banana]"
    sweeps = [WrittenSweep([1], ["ok"], {name: [value]}) for value in (math.nan, 2.5)]
    told = [list(sweep_lines(sweep_places(*pair))) for pair in (sweeps, sweeps[::-1])]
    assert told == [
        [f"variant 1, {name}: no value, expected 2.5"],
        [f"variant 1, {name}: 2.5, expected no value"],
    ]
