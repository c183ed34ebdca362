"""Two summaries beside one another."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.insight.summary import Summary
from vstatics.insight.summary.design import GearLine
from vstatics.insight.summary.extremes import overall
from vstatics.insight.summary.grids import Column, Grid, number, other_combinations, text

QUANTITIES = (
    ("WSAT", "largest planet speed", 3),
    ("WFRI", "largest slip", 3),
    ("AMLG", "largest torque", 3),
    ("AMLGP", "largest torque with losses", 3),
    ("WSAT_rpm", "largest planet speed [rpm]", 1),
    ("WFRI_rpm", "largest slip [rpm]", 1),
    ("AMLG_Nm", "largest torque [N*m]", 1),
    ("AMLGP_Nm", "largest torque with losses [N*m]", 1),
)
"""Tables, how their largest values are called, and with how many decimals they are shown."""

_MISSING = GearLine("", math.nan, "", math.nan, math.nan, "")


def contrasted(one: Summary, other: Summary) -> Iterator[Grid]:
    """The tables of two cases, called A and B, side by side.

    Gears of one name stand on one line.
    """
    pair = one, other
    yield _gears(pair)
    yield Grid(
        "In all",
        [text("quantity"), Column("A"), text("where"), Column("B"), text("where")],
        list(_in_all(pair)),
    )
    for letter, summary in zip("AB", pair, strict=True):
        if summary.combinations is not None:
            grid = other_combinations(summary)
            yield grid._replace(title=f"{letter}. {grid.title}")


def _gears(pair: Sequence[Summary]) -> Grid:
    lines = [{line.gear: line for line in summary.design.gears} for summary in pair]
    names = list(dict.fromkeys(name for by_name in lines for name in by_name))
    headings = (f"{what} {letter}" for what in ("ratio", "step", "efficiency") for letter in "AB")
    rows = []
    for name in names:
        found = [by_name.get(name, _MISSING) for by_name in lines]
        values = [
            *(line.ratio for line in found),
            *(line.step for line in found),
            *(line.efficiency for line in found),
        ]
        rows.append([name, *map(number, values)])
    return Grid("Gears", [text("gear"), *map(Column, headings)], rows)


def _in_all(pair: Sequence[Summary]) -> Iterator[list[str]]:
    """Rows of what is told of a case as a whole."""
    counts = {
        "forward gears": [len(one.design.forward) for one in pair],
        "shift elements": [len(one.results.case.shift_elements) for one in pair],
        "most that change in a shift": [
            max((shift.changes for shift in one.transitions if not shift.jumped), default=0)
            for one in pair
        ],
    }
    for name, values in counts.items():
        yield [name, *(cell for value in values for cell in (str(value), ""))]
    yield ["spread", *(cell for one in pair for cell in (number(one.design.spread), ""))]
    for table, name, decimals in QUANTITIES:
        found = [overall(one.largest.get(table, ())) for one in pair]
        if any(found):
            cells: list[str] = []
            for line in found:
                value = math.nan if line is None else line.value
                where = f"{line.row}, {line.gear}" if line is not None and line.gear else ""
                cells += [number(value, decimals), where]
            yield [name, *cells]
