"""Pictures on the page of a case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.extras import require
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.page.report.asked import EVERYTHING, AskedPage
from vstatics.pictures.paged.drawn import HALF, Drawn, of_each, picture_of

OF_ALL_GEARS = ("efficiency", "plan")
OF_A_VEHICLE = ("traction", "sawtooth")
"""Kinds of pictures that need a vehicle with an engine."""


def of_all_gears(case: Transmission) -> tuple[str, ...]:
    """Return the kinds of pictures that show all gears of a case together."""
    return (*OF_ALL_GEARS, *(OF_A_VEHICLE if getattr(case.vehicle, "engine", ()) else ()))


class Pictures(NamedTuple):
    """Pictures on the page of a case, except of vibration and of a simulated run."""

    of_gears: Mapping[str, Sequence[Drawn]] = {}
    """Pictures of each gear on the page, by kind."""
    of_all: Mapping[str, Drawn] = {}
    small_sticks: Sequence[Drawn] = ()
    """Small stick diagrams of each gear on the page, for print."""
    bare_stick: Drawn | None = None
    """Stick diagram without a gear, for print."""
    flows: Drawn | None = None
    """Power flow of all gears on the page, for print."""


def pictures(results: Results, asked: AskedPage = EVERYTHING) -> Pictures:
    """Draw the pictures on the page of a case, except vibration and simulated run.

    The structure of a gear replaces a stick diagram that cannot be drawn.

    Raises
    ------
    CaseError
        If matplotlib is not installed.
    """
    require("plot", "a picture")
    gears = [[n] for n, gear in enumerate(results.case.gears, 1) if asked.shows(gear.name)]
    chosen = [number for [number] in gears] if asked.gears else []
    sticks, small, bare = _sticks(results, asked, gears)
    has_flows = asked.has("flow") and not asked.in_full("flow") and len(gears) > 1
    shown = {"flow": [*gears, *[chosen] * has_flows], "lever": gears}
    of_gears = {kind: of_each(results, kind, shown[kind]) for kind in shown if asked.has(kind)}
    flows = of_gears["flow"].pop() if has_flows else None
    of_all = {
        kind: picture_of(results, kind, chosen)
        for kind in of_all_gears(results.case)
        if asked.has("vehicle" if kind in OF_A_VEHICLE else kind)
    }
    return Pictures({"stick": sticks, **of_gears}, of_all, small, bare, flows)


def _sticks(
    results: Results, asked: AskedPage, gears: Sequence[Sequence[int]]
) -> tuple[Sequence[Drawn], Sequence[Drawn], Drawn | None]:
    """Draw large and small stick diagrams of gears, and a stick diagram without a gear.

    The structure replaces a stick diagram that cannot be drawn. If the table of gears is printed
    with small diagrams, large diagrams are printed only on request.
    """
    in_full = asked.in_full("overview") and (asked.prints_all or not asked.has("gears"))
    has_small = asked.has("gears") and not in_full and len(gears) > 1
    shown = [*gears, *[()] * (not in_full)] if asked.has("overview") else []
    for kind in ("stick", "structure"):
        sticks = of_each(results, kind, shown)
        bare = sticks.pop() if len(sticks) > len(gears) else None
        small = of_each(results, kind, gears, HALF) if has_small else []
        if any(picture.sheets for picture in (*sticks, *small)):
            break
    return sticks, small, bare
