"""The signs of a kinematic plan, and what is said of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vstatics.model.transmission import Transmission
from vstatics.pictures.plan.rays import KinematicPlan
from vstatics.pictures.sheet.head import KeySign
from vstatics.pictures.sheet.line_styles import Look, striped_look
from vstatics.pictures.sheet.style import Style

THICK, THIN = 2.6, 1.4
"""Lines of input and output, and of others. [pt]"""
PATH: Look = {"linestyle": (0, (1, 1.5)), "linewidth": 0.9}
"""Of a run off a plan."""
BROAD: Look = {"linewidth": 6.0, "alpha": 0.3, "solid_capstyle": "butt"}
"""Of a run on a plan."""


def gear_look(style: Style) -> Look:
    """The vertical of a gear."""
    return {"color": style.faint, "linewidth": 0.9, "linestyle": (0, (4, 3)), "zorder": 0.6}


def dot_look(style: Style) -> Look:
    """What makes a gear."""
    return {"marker": "o", "color": style.ink, "markersize": 4.5, "zorder": 4}


def unit_look(style: Style) -> Look:
    """The point in which all rays meet."""
    edge = {"markeredgecolor": style.ink, "markerfacecolor": "none"}
    return {"marker": "o", "color": style.ink, "markersize": 9, "zorder": 3, **edge}


def plan_note(case: Transmission, shown: Sequence[KinematicPlan], style: Style) -> str:
    """Which links are input and output, and what a line is."""
    said = []
    for english, russian, links in (
        ("input", "вход", dict.fromkeys(plan.input for plan in shown)),
        ("output", "выход", dict.fromkeys(plan.output for plan in shown)),
    ):
        names = [case.link_name(link) for link in links]
        if names != [english]:
            said.append(f"{style.text(english, russian)}: {', '.join(names)}")
    return "; ".join(said)


def plan_signs(
    shown: Sequence[KinematicPlan],
    ranges: Sequence[tuple[float, float]],
    style: Style,
    runs: Sequence[NDArray[np.bool_]] = (),
) -> list[KeySign]:
    """The signs that occur in some plans.

    Parameters
    ----------
    ranges : sequence of tuple of float
        The ends of the abscissa of each.
    runs : sequence of ndarray
        Of each, when a run is on it.
    """
    ink = {"color": style.ink}
    signs = [
        KeySign(style.text("input, output", "вход, выход"), {**ink, "linewidth": THICK}),
        KeySign(style.text("gear", "передача"), gear_look(style)),
    ]
    if any(low < 0 < high for low, high in ranges):
        text = style.text("speed 0", "скорость 0")
        signs.append(KeySign(text, {**ink, "linewidth": 0.8}))
    if any(mark.elements for plan in shown for mark in plan.marks):
        text = style.text(
            "element of the gear: holds a link, or joins two",
            "элемент передачи: держит звено или соединяет два",
        )
        signs.append(KeySign(text, dot_look(style)))
    if any(len(ray.links) > 1 for plan in shown for ray in plan.rays):
        text = style.text("striped: links turn together", "полосы: звенья вращаются вместе")
        signs.append(KeySign(text, striped_look(style)))
    if any(
        plan.has_unit_point and low < 1 < high
        for plan, (low, high) in zip(shown, ranges, strict=True)
    ):
        text = style.text("all turn as one piece", "всё вращается как одно целое")
        signs.append(KeySign(text, unit_look(style)))
    if any(run.any() for run in runs):
        signs.append(KeySign(style.text("run on the plan", "движение на плане"), {**ink, **BROAD}))
    if not all(run.all() for run in runs):
        signs.append(KeySign(style.text("off the plan", "вне плана"), {**ink, **PATH}))
    return signs
