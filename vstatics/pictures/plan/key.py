"""Styles of the symbols of a kinematic plan, and the legend that explains them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vstatics.core.model.transmission import Transmission
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.line_styles import striped_look
from vstatics.pictures.drawing.pen import AxisScale
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.words import TURN_TOGETHER
from vstatics.pictures.plan.rays import KinematicPlan

PORT_RAY_WIDTH, RAY_WIDTH = 2.6, 1.4
"""Line widths of the rays of input and output, and of the rays of other links. [pt]"""
PATH: Look = {"linestyle": (0, (1, 1.5)), "width": 0.9}
"""Style of the path of a run where the plan's constraints are not satisfied."""
BROAD: Look = {"width": 6.0, "alpha": 0.3}
"""Style of the path of a run where the plan's constraints are satisfied."""


def gear_look(style: Style) -> Look:
    """Return the style of the vertical line of a gear."""
    return {"color": style.faint, "width": 0.9, "linestyle": (0, (4, 3)), "zorder": 0.6}


def dot_look(style: Style) -> Look:
    """Return the style of the dot on a gear line at the speed imposed by a shift element."""
    return {"marker": "o", "color": style.ink, "markersize": 4.5, "zorder": 4, "width": 1.5}


def unit_look(style: Style) -> Look:
    """Return the style of the point (1, 1), where all rays meet."""
    size = {"markersize": 9, "markerfacecolor": "none", "markeredgecolor": style.ink}
    return dot_look(style) | {"zorder": 3, **size}


def plan_note(
    case: Transmission, shown: Sequence[KinematicPlan], left_out: Sequence[str], style: Style
) -> str:
    """Return the note on input and output, and on the gears that are not on any plan."""
    off = f"{style.text('not on a plan')}: {', '.join(left_out)}"
    notes = [off] * bool(left_out)
    for english, links in (
        ("input", dict.fromkeys(plan.input for plan in shown)),
        ("output", dict.fromkeys(plan.output for plan in shown)),
    ):
        names = [case.link_name(link) for link in links]
        if names and names not in ([english], [style.text(english)]):
            notes.append(f"{style.text(english)}: {', '.join(names)}")
    if len(left_out) == len(case.gears):
        reason = style.text(
            "no single shift element separates two gears of different ratios",
        )
        notes.append(reason)
    elif not shown:
        notes.append(style.text("the run is on no plan"))
    return "; ".join(notes)


def plan_signs(
    shown: Sequence[KinematicPlan],
    ranges: Sequence[AxisScale],
    style: Style,
    runs: Sequence[NDArray[np.bool_]],
) -> list[Meaning]:
    """Return the legend of plans.

    Parameters
    ----------
    ranges : sequence of AxisScale
        Horizontal scale of each plan.
    runs : sequence of ndarray
        For each plan, whether the run satisfies its constraints at each instant.
    """
    ink = {"color": style.ink}
    element = "engaged shift element: holds a link or joins two"
    striped = any(len(ray.links) > 1 for plan in shown for ray in plan.rays)
    units = (
        plan.has_unit_point and x.low < 1 < x.high for plan, x in zip(shown, ranges, strict=True)
    )
    return [
        (True, "input, output", {**ink, "width": PORT_RAY_WIDTH}),
        (True, "gear", gear_look(style)),
        (True, "speed 0", {**ink, "width": 0.8}),
        (any(mark.elements for plan in shown for mark in plan.marks), element, dot_look(style)),
        (striped, TURN_TOGETHER, striped_look(style)),
        (any(units), "everything rotates as a block", unit_look(style)),
        (any(run.any() for run in runs), "run on the plan", ink | BROAD),
        (not all(run.all() for run in runs), "off the plan", ink | PATH),
    ]
