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


def test_a_name_stays_whatever_is_in_it() -> None:
    """NaN is told as no value, a gear that is named so is not."""
    name = "ratio[nan banana]"
    sweeps = [WrittenSweep([1], ["ok"], {name: [value]}) for value in (math.nan, 2.5)]
    assert told(*sweeps) == [
        "new: 1 of 1 variant, 1 of 1 column differ",
        f"  {name}  variant 1  2.500 -> no value",
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


@pytest.mark.parametrize("name", ["case", "step", "ratio", "column"])
def test_a_column_may_have_the_name_of_a_table(name: str) -> None:
    old, new = (WrittenSweep([0, 1], ["ok"] * 2, {name: [1.0, end]}) for end in (2.0, 2.5))
    line = f"  {name:10}  variant 1  2.000 -> 2.500  +25.00 %"
    assert told(new, old) == ["new: 1 of 2 variants, 1 of 1 column differ", line]
