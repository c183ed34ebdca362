"""The run of a scenario, for its page: pictures, events, energy, largest torques."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import printable
from vstatics.core.extras import missing
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Cell, Column, Grid, exact
from vstatics.core.tables.html import Markup, tables, tag
from vstatics.core.tables.numbers import certain
from vstatics.core.texts import tr
from vstatics.pictures.paged.drawn import Drawn, bare_stick
from vstatics.pictures.paged.marks import with_mark
from vstatics.pictures.paged.parts import PartRequest, figures, on_screen
from vstatics.simulation.record.motion import Motion

TIME, FIGURES = 4, 5
"""Digits of a time in s after the point; significant ones of the largest in a column."""
KILO = 1e4
"""Energies with one as large are told in kJ. [J]"""
NOTHING = Markup()


class RunSection(NamedTuple):
    """What the page shows of a run."""

    motion: Motion
    course: Drawn | None = None
    """Over time; nothing where there are no pictures."""
    plan: Drawn | None = None
    """In the kinematic plan."""
    moves: Markup = NOTHING
    """What a script moves; it takes the place of `course` on a screen."""
    in_full: bool = False
    """Whether its plan is printed, too."""
    has_marks: bool = False
    """Whether times of events say what they are, for a script."""
    without: str = ""

    @property
    def drawn(self) -> tuple[str, ...]:
        """The plan, if it is drawn with the run in it."""
        return ("plan",) if self.plan and self.plan.sheets else ()

    def shown(self, digits: int | None) -> Iterator[Markup]:
        """All of it; why the run stopped, if it did, comes first."""
        from vstatics.simulation.record.tables import motion_grids

        motion = self.motion
        if motion.stopped is not None:
            why = printable(motion.stopped.told)
            yield tag("p", tr("The run stopped: {why}", why=why), class_="error")
        if motion.messages:
            yield tag("ul", *(tag("li", str(one)) for one in motion.messages), class_="messages")
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
    """Whether a page has a run."""
    return runs


def part(request: PartRequest) -> RunSection | None:
    """Return a run with its pictures; nothing if there is none."""
    motion = request.motion
    if not isinstance(motion, Motion):
        return None
    section = RunSection(motion, in_full=request.in_full, has_marks=request.has_marks)
    if not request.has_pictures:
        return section
    course, plan = (request.draw(kind, motion=motion) for kind in ("shift", "plan"))
    moves = NOTHING
    if request.has_marks and not missing("plot", "a run that moves"):
        moves = moving_of(request.results, motion, bare_stick(request.draw, motion))
    return section._replace(course=course, plan=plan, moves=moves)


def moving_of(results: Results, motion: Motion, stick: Drawn) -> Markup:
    """What moves of a run; nothing where nothing moves.

    Parameters
    ----------
    stick : Drawn
        The diagram whose shift elements show what they do.
    """
    if len(motion.time) < 2:
        return NOTHING
    from vstatics.simulation.report.runs.section import moving_run

    return moving_run(results, motion, stick)


def marked_events(grid: Grid) -> Grid:
    """Return a table of events with marks on their times; other tables as they are."""
    if grid.key != "events":
        return grid
    return grid._replace(rows=[_of_event(row) for row in grid.cells])


def _of_event(row: Sequence[Cell]) -> list[Cell]:
    """The time of what happens, by what it happens to."""
    time, element, event, *others = row
    named = with_mark(time, "events", row=f"{element.text} {event.text}".strip())
    return [named, element, event, *others]


def in_figures(grid: Grid) -> Grid:
    """A table of a run with the digits that a reader needs, large energies in kJ.

    Examples
    --------
    >>> from vstatics.core.tables.grid import text
    >>> columns = [Column("time [s]"), text("element"), Column("energy [J]")]
    >>> rows = [[exact(0.805359703), "B", exact(474894.33)], [exact(2), "C", exact(-30.7)]]
    >>> made = in_figures(Grid("t", columns, rows))
    >>> made.columns[2].heading, made.texts
    ('energy [kJ]', [['.8054', 'B', '474.894'], ['2.0000', 'C', '-.03070']])
    """
    if not grid.rows:
        return grid
    made = [
        _column(*pair) for pair in zip(grid.columns, zip(*grid.cells, strict=True), strict=True)
    ]
    if not grid.columns[0].heading:
        made[0] = (grid.columns[0]._replace(heading="part"), made[0][1])
    rows = [list(row) for row in zip(*(cells for _, cells in made), strict=True)]
    return grid._replace(columns=[column for column, _ in made], rows=rows)


def _column(column: Column, cells: Sequence[Cell]) -> tuple[Column, Sequence[Cell]]:
    """A column with its cells; what is shown as 0 stays so."""
    numbers = [one.value for one in cells if one.kind is float and one.value is not None]
    largest = max((abs(one) for one in numbers if math.isfinite(one)), default=0.0)
    if not numbers:
        return column, cells
    if "[J" in column.heading and largest >= KILO:
        heading = column.heading.replace("[J", "[kJ")
        return column._replace(heading=heading), [_rounded(one, 1e-3, 3) for one in cells]
    places = FIGURES - 1 - math.floor(math.log10(certain(largest))) if largest else 3
    decimals = TIME if "[s]" in column.heading else min(max(places, 1), TIME)
    return column, [_rounded(one, 1.0, decimals) for one in cells]


def _rounded(cell: Cell, scale: float, decimals: int) -> Cell:
    if cell.kind is not float or cell.value is None:
        return cell
    is_zero = "0" in cell.text and not cell.text.strip("-.0")
    return exact(0.0 if is_zero else cell.value * scale, decimals)._replace(
        value=cell.value * scale
    )
