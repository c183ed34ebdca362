"""Differences of sweeps, in words."""

import math

import pytest

from vstatics.core.comparison.compared_files import verdicts_of_files
from vstatics.core.comparison.layout import text
from vstatics.core.comparison.tolerances import Tolerances
from vstatics.core.tables.written_results import WrittenSweep


def told(actual: WrittenSweep, expected: WrittenSweep) -> list[str]:
    (found,) = verdicts_of_files(actual, expected, ("new.csv", "old.csv"), Tolerances())
    return text(found)


@pytest.mark.parametrize("name", ["ratio[nan banana]", "case", "step", "ratio"])
def test_a_name_stays_whatever_is_in_it(name: str) -> None:
    """NaN is told as no value, a gear that is named so is not; names of tables are names, too."""
    sweeps = [WrittenSweep([1], ["ok"], {name: [value]}) for value in (math.nan, 2.5)]
    assert told(*sweeps) == [
        "new: 1 of 1 variant, 1 of 1 column differ",
        f"  {name:10}  variant 1  2.500 -> no value",
    ]


def test_the_first_line_counts_what_differs_and_what_only_one_has() -> None:
    """Rows below it are those of a column, the largest first."""
    old = WrittenSweep([1, 2, 3], ["ok"] * 3, {"u": [1.0, 2.0, 4.0], "v": [1.0] * 3})
    new = WrittenSweep([2, 3, 5], ["ok", "tied up", "ok"], {"u": [2.5, 4.1, 1.0], "w": [1.0] * 3})
    assert told(new, old) == [
        "new: 2 of 2 variants, 1 of 1 column, 1 status differ; "
        "1 variant added; 1 variant gone; 1 column added; 1 column gone",
        "  variant     1          there -> not there",
        "  variant     5          not there -> there",
        "  v                      there -> not there",
        "  w                      not there -> there",
        "  status      variant 3  ok -> tied up",
        "  u           variant 2  2.000 -> 2.500  +25.00 %",
        "  u           variant 3  4.000 -> 4.100  +2.50 %",
    ]
