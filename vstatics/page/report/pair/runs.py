"""The runs of two scenarios: over time side by side, then rows of one below those of the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.core.errors import CaseError, printable
from vstatics.core.tables.grid import Grid, Row, text
from vstatics.core.tables.html import Markup, tables, tag
from vstatics.core.texts import tr
from vstatics.page.report.marks import marked
from vstatics.page.report.page_pictures import HALF, Drawn, in_spoken, inline
from vstatics.page.report.pair.paged import PagedCase, merged_tables
from vstatics.page.report.parts import figures
from vstatics.pictures import pages
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.record.tables import motion_grids
from vstatics.simulation.report.motion import in_figures


def runs(both: Sequence[PagedCase]) -> Iterator[Markup]:
    """Runs over time, side by side, then their events, energies and torques."""
    motions = [one.motion for one in both]
    for one in both:
        if one.motion and one.motion.stopped is not None:
            why = printable(one.motion.stopped.told)
            yield tag("p", one.label, ": ", tr("The run stopped: {why}", why=why), class_="error")
    ends = [f"{motion.time[-1]:.6g}" for motion in motions if motion]
    if not ends:
        return
    if len({*ends}) > 1:
        first, second = ends
        said = tr(
            "The runs last {one} s and {other} s: their axes of time differ.",
            one=first,
            other=second,
        )
        yield tag("p", said, class_="note")
    yield tag("div", *(_course(one, both) for one in both if one.motion), class_="two")
    yield from tables(merged_tables(both, pair) for pair in run_grids(motions))


def _course(one: PagedCase, both: Sequence[PagedCase]) -> Markup:
    """The picture of a run over time, with the scales of both."""
    name = f"{one.label}: {tr('Run over time')}"
    try:
        others = [
            (each.material.results, each.motion) for each in both if each is not one and each.motion
        ]
        own = one.material.results
        made = pages(own, "shift", "svg", in_spoken(HALF), motion=one.motion, others=others)
    except CaseError as error:
        return tag("div", *figures(Drawn("shift", [], " ".join(str(error).split())), name))
    sheets = [inline(svg, f"{one.label}-run-{n}", name) for n, svg in enumerate(made)]
    return tag("div", *figures(Drawn("shift", sheets), name), data_case=one.label)


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
        yield [_by_event(marked(_certain(grid))) if grid else None for grid in same]


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
