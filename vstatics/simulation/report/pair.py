"""Runs of two scenarios side by side: pictures over time, and tables row by row."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.core.errors import CaseError, printable
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid, Row, text
from vstatics.core.tables.html import Markup, tag
from vstatics.core.texts import tr
from vstatics.pictures import pages
from vstatics.pictures.paged.drawn import HALF, Drawn, in_spoken
from vstatics.pictures.paged.inline import inline
from vstatics.pictures.paged.parts import figures
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.record.tables import motion_grids
from vstatics.simulation.report.motion import in_figures, marked_events

LabelledRun = tuple[str, Results, Motion | None]
"""Letter of a case, its results, and its run if any."""


def paired_runs(
    both: Sequence[LabelledRun],
) -> tuple[list[Markup], Iterator[list[Grid | None]]]:
    """Return the pictures of two runs side by side, and their tables."""
    return [*_shown(both)], run_grids([motion for _, _, motion in both])


def _shown(both: Sequence[LabelledRun]) -> Iterator[Markup]:
    for label, _, motion in both:
        if motion and motion.stopped is not None:
            why = printable(motion.stopped.told)
            yield tag("p", label, ": ", tr("The run stopped: {why}", why=why), class_="error")
    ends = [f"{motion.time[-1]:.6g}" for _, _, motion in both if motion]
    if len({*ends}) > 1:
        first, second = ends
        remark = tr(
            "The runs last {one} s and {other} s: their axes of time differ.",
            one=first,
            other=second,
        )
        yield tag("p", remark, class_="note")
    yield tag("div", *(_course(run, both) for run in both if run[-1]), class_="two")


def _course(labelled: LabelledRun, both: Sequence[LabelledRun]) -> Markup:
    label, results, motion = labelled
    name = f"{label}: {tr('Run over time')}"
    others = [(case, run) for _, case, run in both if run and run is not motion]
    try:
        sheets = pages(results, "shift", "svg", in_spoken(HALF), motion=motion, others=others)
    except CaseError as error:
        return tag("div", *figures(Drawn("shift", [], " ".join(str(error).split())), name))
    drawn = [inline(svg, f"{label}-run-{n}", name) for n, svg in enumerate(sheets)]
    return tag("div", *figures(Drawn("shift", drawn), name), data_case=label)


def run_grids(motions: Sequence[Motion | None]) -> Iterator[list[Grid | None]]:
    """Yield each kind of table as a list with an item per run, None for a run without it.

    All runs use the same units in a table. The name of an event precedes its time, so that events
    are paired by name. Energies that are rounding noise become 0.
    """
    tables = [
        {grid.key: grid for grid in motion_grids(motion) if grid.key != "stopped"} if motion else {}
        for motion in motions
    ]
    for key in {key: None for grids in tables for key in grids}:
        exact_grids = [grids.get(key) for grids in tables]
        shown = [in_figures(grid) if grid else None for grid in exact_grids]
        heads = {tuple(column.heading for column in grid.columns[1:]) for grid in shown if grid}
        same = shown if len(heads) == 1 else exact_grids
        yield [_by_event(marked_events(_certain(grid))) if grid else None for grid in same]


def _certain(grid: Grid) -> Grid:
    """Set the energies that are printed as 0 to 0."""
    if grid.key != "energy":
        return grid
    rows = [
        [
            cell._replace(value=0.0) if cell.value and not cell.text.strip("-.0") else cell
            for cell in row
        ]
        for row in grid.cells
    ]
    return grid._replace(rows=rows)


def _by_event(grid: Grid) -> Grid:
    """Add the component to the word of each event, and move this column before the times.

    >>> from vstatics.core.tables.grid import Column, exact
    >>> columns = [Column("time [s]"), text("element"), text("event")]
    >>> _by_event(Grid("Events", columns, [[exact(0.5), "B", "locks"]], key="events")).texts
    [['B locks', '0.500']]
    """
    if grid.key != "events":
        return grid
    rows: list[Row] = []
    for time, element, event, *energy in grid.cells:
        event_cell = element._replace(text=f"{element.text} {event.text}")
        rows.append([event_cell, time, *energy])
    columns = [text("event"), grid.columns[0], *grid.columns[3:]]
    return grid._replace(columns=columns, rows=rows)
