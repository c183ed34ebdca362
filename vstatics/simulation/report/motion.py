"""The run of a scenario, for its page: pictures, events, energy, largest torques."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import printable
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Cell, Column, Grid, exact
from vstatics.core.tables.html import Markup, tables, tag
from vstatics.core.tables.numbers import certain
from vstatics.core.texts import tr
from vstatics.page.report.marks import marked
from vstatics.page.report.page_pictures import Drawn, picture_of
from vstatics.page.report.parts import figures, on_screen
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


def run_section(
    results: Results, motion: Motion, *, has_pictures: bool, moves: bool = False
) -> RunSection:
    """A run with its pictures.

    Parameters
    ----------
    has_pictures : bool
        Whether anything can be drawn.
    moves : bool
        Whether the page has the script of a run.
    """
    if not has_pictures:
        return RunSection(motion)
    course, plan = (picture_of(results, kind, motion=motion) for kind in ("shift", "plan"))
    moving = moving_of(results, motion, bare_stick(results, motion)) if moves else NOTHING
    return RunSection(motion, course, plan, moving)


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


def bare_stick(results: Results, motion: Motion) -> Drawn:
    """The stick diagram of no gear, for a run; where there is none the structure."""
    stick = picture_of(results, "stick", motion=motion)
    return stick if stick.sheets else picture_of(results, "structure", motion=motion)


def shown_run(
    section: RunSection, digits: int | None, *, in_full: bool = False, has_marks: bool = False
) -> Iterator[Markup]:
    """All of it; why the run stopped, if it did, comes first.

    Parameters
    ----------
    in_full : bool
        Whether its plan is printed, too.
    has_marks : bool
        Whether times of events say what they are, for a script.
    """
    from vstatics.simulation.record.tables import motion_grids

    motion = section.motion
    if motion.stopped is not None:
        yield tag(
            "p", tr("The run stopped: {why}", why=printable(motion.stopped.told)), class_="error"
        )
    if motion.messages:
        yield tag("ul", *(tag("li", str(one)) for one in motion.messages), class_="messages")
    yield section.moves
    if section.course:
        course = figures(section.course, tr("Run over time"))
        yield from [tag("div", *course, class_="run-still")] if section.moves else course
    grids = [in_figures(grid).with_digits(digits) for grid in motion_grids(motion)]
    yield from tables(map(marked, grids) if has_marks else grids)
    if section.plan:
        shown = figures(section.plan, tr("Run in the kinematic plan"))
        yield from shown if in_full else [on_screen(shown)]


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
