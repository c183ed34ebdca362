"""Section about a run in an HTML report: pictures, events, energy, largest torques."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import printable
from vstatics.core.extras import missing
from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.grid import Cell, Column, Grid, Row, exact
from vstatics.core.tables.html import Markup, tables, tag
from vstatics.core.tables.numbers import certain
from vstatics.core.texts import tr
from vstatics.pictures.paged.drawn import Drawn, bare_stick
from vstatics.pictures.paged.marks import with_mark
from vstatics.pictures.paged.parts import PartRequest, figures, on_screen
from vstatics.simulation.record.motion import Motion

TIME, FIGURES = 4, 5
"""Decimals of times in s, and significant digits of the largest number in other columns."""
KILO = 1e4
"""Largest energy of a column from which the column is in kJ. [J]"""
NOTHING = Markup()


class RunSection(NamedTuple):
    """Content of the section about a run."""

    motion: Motion
    course: Drawn | None = None
    """Picture of the run over time, if drawn."""
    plan: Drawn | None = None
    """Speed plan with the speeds of the run, if drawn."""
    moves: Markup = NOTHING
    """HTML of the interactive run, which replaces `course` on a screen."""
    in_full: bool = False
    """True if the speed plan is shown on paper, too."""
    has_marks: bool = False
    """True if the times of events are marked for the script of the page."""
    without: str = ""

    @property
    def drawn(self) -> tuple[str, ...]:
        """Kinds of pictures drawn with the run."""
        return ("plan",) if self.plan and self.plan.sheets else ()

    def shown(self, digits: int | None) -> Iterator[Markup]:
        """Yield the HTML of the section; the reason for an early stop comes first."""
        from vstatics.simulation.record.tables import motion_grids

        motion = self.motion
        if motion.stopped is not None:
            why = printable(motion.stopped.told)
            yield tag("p", tr("The run stopped: {why}", why=why), class_="error")
        if motion.messages:
            yield tag(
                "ul", *(tag("li", str(message)) for message in motion.messages), class_="messages"
            )
        yield self.moves
        if self.course:
            course = figures(self.course, tr("Run over time"))
            yield from [tag("div", *course, class_="run-still")] if self.moves else course
        grids = [in_figures(grid).with_digits(digits) for grid in motion_grids(motion)]
        yield from tables(map(marked_events, grids) if self.has_marks else grids)
        if self.plan:
            shown = figures(self.plan, tr("Run in the kinematic plan"))
            yield from shown if self.in_full else [on_screen(shown)]


def has_part(case: Transmission, *, runs: bool) -> bool:  # noqa: ARG001
    """Return whether the report contains a section about a run."""
    return runs


def part(request: PartRequest) -> RunSection | None:
    """Return the section about the run of a request, if any."""
    motion = request.motion
    if not isinstance(motion, Motion):
        return None
    section = RunSection(motion, in_full=request.in_full, has_marks=request.has_marks)
    if not request.has_pictures:
        return section
    course, plan = (request.draw(kind, motion=motion) for kind in ("shift", "plan"))
    moves = NOTHING
    if request.has_marks and not missing("plot", "a run that moves") and len(motion.time) > 1:
        from vstatics.simulation.report.runs.section import moving_run

        moves = moving_run(request.results, motion, bare_stick(request.draw, motion))
    return section._replace(course=course, plan=plan, moves=moves)


def marked_events(grid: Grid) -> Grid:
    """Return the table of events with its times marked for the script, other tables unchanged."""
    if grid.key != "events":
        return grid
    rows: list[Row] = []
    for time, element, event, *others in grid.cells:
        marked_time = with_mark(time, "events", row=f"{element.text} {event.text}".strip())
        rows.append([marked_time, element, event, *others])
    return grid._replace(rows=rows)


def in_figures(grid: Grid) -> Grid:
    """Return the table of a run with rounded numbers; large energies are in kJ.

    Examples
    --------
    >>> from vstatics.core.tables.grid import text
    >>> columns = [Column("time [s]"), text("element"), Column("energy [J]")]
    >>> rows = [[exact(0.805359703), "B", exact(474894.33)], [exact(2), "C", exact(-30.7)]]
    >>> rounded = in_figures(Grid("t", columns, rows))
    >>> rounded.columns[2].heading, rounded.texts
    ('energy [kJ]', [['0.8054', 'B', '474.894'], ['2.0000', 'C', '-0.03070']])
    """
    if not grid.rows:
        return grid
    rounded = [
        _column(*pair) for pair in zip(grid.columns, zip(*grid.cells, strict=True), strict=True)
    ]
    if not grid.columns[0].heading:
        rounded[0] = (grid.columns[0]._replace(heading="part"), rounded[0][1])
    rows = [list(row) for row in zip(*(cells for _, cells in rounded), strict=True)]
    return grid._replace(columns=[column for column, _ in rounded], rows=rows)


def _column(column: Column, cells: Sequence[Cell]) -> tuple[Column, Sequence[Cell]]:
    """Round the numbers of a column; a number printed as 0 remains 0."""
    numbers = [cell.value for cell in cells if cell.kind is float and cell.value is not None]
    largest = max((abs(number) for number in numbers if math.isfinite(number)), default=0.0)
    if not numbers:
        return column, cells
    if "[J" in column.heading and largest >= KILO:
        heading = column.heading.replace("[J", "[kJ")
        return column._replace(heading=heading), [_rounded(cell, 1e-3, 3) for cell in cells]
    places = FIGURES - 1 - math.floor(math.log10(certain(largest))) if largest else 3
    decimals = TIME if "[s]" in column.heading else min(max(places, 1), TIME)
    return column, [_rounded(cell, 1.0, decimals) for cell in cells]


def _rounded(cell: Cell, scale: float, decimals: int) -> Cell:
    if cell.kind is not float or cell.value is None:
        return cell
    value = cell.value * scale
    is_zero = "0" in cell.text and not cell.text.strip("-.0")
    return exact(0.0 if is_zero else value, decimals)._replace(value=value)
