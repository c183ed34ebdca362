"""The run of a scenario, for its page: pictures, events, energy, largest torques."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.errors import printable
from vstatics.report.drawn import Drawn, picture_of
from vstatics.report.parts import figures
from vstatics.simulation.motion import Motion
from vstatics.statics.results import Results
from vstatics.tables.html import Markup, tables, tag


class RunSection(NamedTuple):
    """What the page shows of a run."""

    motion: Motion
    course: Drawn | None = None
    """Over time; nothing where there are no pictures."""
    plan: Drawn | None = None
    """In the kinematic plan."""


def run_section(results: Results, motion: Motion, *, has_pictures: bool) -> RunSection:
    """A run with its pictures.

    Parameters
    ----------
    has_pictures : bool
        Whether anything can be drawn.
    """
    if not has_pictures:
        return RunSection(motion)
    course, plan = (picture_of(results, kind, motion=motion) for kind in ("shift", "plan"))
    return RunSection(motion, course, plan)


def shown_run(section: RunSection, digits: int | None) -> Iterator[Markup]:
    """All of it; why the run stopped, if it did, comes first."""
    from vstatics.simulation.motion_grids import motion_grids

    motion = section.motion
    if motion.stopped is not None:
        yield tag("p", f"The run stopped: {printable(motion.stopped.message)}", class_="error")
    if motion.messages:
        yield tag("ul", *(tag("li", str(one)) for one in motion.messages), class_="messages")
    if section.course:
        yield from figures(section.course, "Run over time")
    yield from tables(grid.with_digits(digits) for grid in motion_grids(motion))
    if section.plan:
        yield from figures(section.plan, "Run in the kinematic plan")
