"""The runs of two scenarios: over time side by side, then rows of one below those of the other."""

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
"""A letter, and a case with its run, if it has one."""


def paired_runs(
    both: Sequence[LabelledRun],
) -> tuple[list[Markup], Iterator[list[Grid | None]]]:
    """Return two runs over time, side by side, and each of their tables of both."""
    return [*_shown(both)], run_grids([motion for _, _, motion in both])


def _shown(both: Sequence[LabelledRun]) -> Iterator[Markup]:
    for label, _, motion in both:
        if motion and motion.stopped is not None:
            why = printable(motion.stopped.told)
            yield tag("p", label, ": ", tr("The run stopped: {why}", why=why), class_="error")
    ends = [f"{motion.time[-1]:.6g}" for _, _, motion in both if motion]
    if len({*ends}) > 1:
        first, second = ends
        said = tr(
            "The runs last {one} s and {other} s: their axes of time differ.",
            one=first,
            other=second,
        )
        yield tag("p", said, class_="note")
    yield tag("div", *(_course(one, both) for one in both if one[-1]), class_="two")


def _course(own: LabelledRun, both: Sequence[LabelledRun]) -> Markup:
    """The picture of a run over time, with the scales of both."""
    label, results, motion = own
    name = f"{label}: {tr('Run over time')}"
    others = [(case, run) for _, case, run in both if run and run is not motion]
    try:
        made = pages(results, "shift", "svg", in_spoken(HALF), motion=motion, others=others)
    except CaseError as error:
        return tag("div", *figures(Drawn("shift", [], " ".join(str(error).split())), name))
    sheets = [inline(svg, f"{label}-run-{n}", name) for n, svg in enumerate(made)]
    return tag("div", *figures(Drawn("shift", sheets), name), data_case=label)


def run_grids(motions: Sequence[Motion | None]) -> Iterator[list[Grid | None]]:
    """Each table that one of the runs has, of all of them.

    Events go by what happens, the first of a kind, the second and so on, whenever it is.
    Numbers of a table are in one unit. Energies of which no digit is certain are 0.
    """
    found = [
        {grid.key: grid for grid in motion_grids(one) if grid.key != "stopped"} if one else {}
        for one in motions
    ]
    for key in {key: None for one in found for key in one}:
        own = [one.get(key) for one in found]
        shown = [in_figures(grid) if grid else None for grid in own]
        heads = {tuple(column.heading for column in grid.columns[1:]) for grid in shown if grid}
        same = shown if len(heads) == 1 else own
        yield [_by_event(marked_events(_certain(grid))) if grid else None for grid in same]


def _certain(grid: Grid) -> Grid:
    """A table of energies in which what is shown as 0 is 0."""
    if grid.key != "energy":
        return grid
    rows = [
        [one._replace(value=0.0) if one.value and not one.text.strip("-.0") else one for one in row]
        for row in grid.cells
    ]
    return grid._replace(rows=rows)


def _by_event(grid: Grid) -> Grid:
    """A table of events with what happens before its time.

    >>> from vstatics.core.tables.grid import Column, exact
    >>> columns = [Column("time [s]"), text("element"), text("event")]
    >>> _by_event(Grid("Events", columns, [[exact(0.5), "B", "locks"]], key="events")).texts
    [['B locks', '.500']]
    """
    if grid.key != "events":
        return grid
    rows: list[Row] = []
    for time, element, event, *energy in grid.cells:
        what = element._replace(text=f"{element.text} {event.text}")
        rows.append([what, time, *energy])
    columns = [text("event"), grid.columns[0], *grid.columns[3:]]
    return grid._replace(columns=columns, rows=rows)
