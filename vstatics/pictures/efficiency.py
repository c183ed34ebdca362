"""Efficiency by gear: what each mechanism loses hangs down from 1 to the efficiency."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Floats
from vstatics.pictures import labels
from vstatics.pictures.labels import LEADER, Label, Panel
from vstatics.pictures.state import state_of
from vstatics.pictures.style import TITLE, Style, number
from vstatics.pictures.words import fault, title
from vstatics.statics.results import Results
from vstatics.statics.status import LOCKED
from vstatics.tables.values import tables

HIGH = 230.0
"""Of the axes. [pt]"""
STEP = 40.0
"""Between gears. [pt]"""
LEAST = 200.0
"""Width of the axes at least. [pt]"""
BAR = 0.62
"""Width of a bar over the step."""
MARGIN = 14.0
"""[pt]"""
LEFT, BELOW = 58.0, 24.0
"""For the scale, and for what the gears are called together. [pt]"""
LONGEST = 120.0
"""Names of mechanisms are wrapped to this width. [pt]"""


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """Draw the efficiency of all gears, or of some.

    Raises
    ------
    CaseError
        If no gear that is asked for has an efficiency.
    """
    case = results.case
    chosen = [gear - 1 for gear in gears] or list(range(len(case.gears)))
    efficiency = results.efficiency[chosen]
    if np.isnan(efficiency).all():
        asked = ", ".join(case.gears[place].name for place in chosen)
        which = f"gear {asked}" if gears else "the case"
        raise CaseError([Problem(f"{which} has no efficiency that could be drawn")])
    names, shares = loss_shares(results, style)
    shares = shares[:, chosen]
    wrapped = [labels.wrapped(name, LONGEST) for name in names]
    shown = [case.gears[place].name for place in chosen]
    figure, panel = _figure(_title(case, style), shown, wrapped)
    _frame(panel, efficiency, style)
    _bars(panel, efficiency, shares, style)
    for place, one in enumerate(chosen):
        if math.isnan(efficiency[place]):
            is_locked = LOCKED in state_of(results, one + 1).faults
            why = (
                fault(LOCKED, style) if is_locked else style.text("not determined", "не определён")
            )
            how = {"ha": "center", "va": "top", "rotation": 90}
            panel.write(panel.across(place), panel.up(1.0) - 6, why, **how)
    at = [Label(panel.across(place), name, style.ink) for place, name in enumerate(shown)]
    panel.along("bottom", at, upright=_foot(shown)[0])
    low = -LEADER - _foot(shown)[1] - 4
    panel.write(panel.width / 2, low, style.text("gear", "передача"), ha="center", va="top")
    _legend(panel, wrapped, style)
    return figure


def _figure(head: str, gears: Sequence[str], wrapped: Sequence[str]) -> tuple[Figure, Panel]:
    """A figure with room for its title, the names of gears and those of mechanisms."""
    wide = max(len(gears) * STEP, LEAST)
    high = max(HIGH, sum(labels.height(name) + 6 for name in wrapped))
    across = LEFT + wide + 3 * MARGIN + 12 + max(map(labels.width, wrapped), default=0.0)
    lines = labels.wrapped(head, across - 2 * MARGIN, TITLE)
    below = LEADER + _foot(gears)[1] + BELOW
    up = below + high + labels.height(lines, TITLE) + 3 * MARGIN
    figure = labels.figure(across, up)
    figure.text(0.5, 1 - MARGIN / up, lines, ha="center", va="top", fontsize=TITLE)
    return figure, labels.panel(figure, LEFT, below, wide, high)


def _foot(gears: Sequence[str]) -> tuple[bool, float]:
    """Whether the names of gears run upwards, as they do not fit else, and their height [pt]."""
    step = max(STEP, LEAST / len(gears))
    if any(labels.width(name) + 2 * labels.GAP > step for name in gears):
        return True, max(map(labels.width, gears))
    return False, max(map(labels.height, gears))


def loss_shares(results: Results, style: Style) -> tuple[list[str], Floats]:
    """What mechanisms and drag take of the power that enters; with the efficiency it makes 1.

    Returns
    -------
    list of str
        Elements or mechanisms, then drag if there is any.
    ndarray, shape (rows, gears)
        Shares of the power that enters, NaN where there is no efficiency. [-]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> pair = Mechanism(1, 2, 0, ratio=-2.5, efficiency=0.96)
    >>> names, shares = loss_shares(solve(Transmission(2, [], [pair], [Gear()])), Style())
    >>> names, shares.round(6)
    (['D1'], array([[0.04]]))
    """
    by_name = {table.quantity.key: table for table in tables(results)}
    names, losses = list(by_name["losses"].rows), by_name["losses"].values
    if "drag_losses" in by_name:
        names.append(style.text("drag", "сопротивления"))
        losses = np.vstack([losses, by_name["drag_losses"].values])
    total = losses.sum(axis=0)
    # below 0 when coasting; the sum of all shares is 1 - efficiency by the balance of power
    entered = np.where(total == 0, 1.0, total)
    return names, losses / entered * (1.0 - results.efficiency) + 0.0


def _title(case: Transmission, style: Style) -> str:
    what = style.text("efficiency, and what each mechanism takes", "КПД и доли потерь в механизмах")
    if case.coast:
        what += style.text(" (coasting)", " (торможение двигателем)")
    return title(case, what)


def _frame(panel: Panel, efficiency: Floats, style: Style) -> None:
    """The scale: from 1 down to a little below the lowest bar, with room for its number."""
    lowest = min(float(np.nanmin(efficiency)), 0.99)
    axes = panel.axes
    axes.set_xlim(-0.6, len(efficiency) - 0.4)
    axes.set_ylim(lowest - 0.12 * (1 - lowest), 1.0)
    axes.set_xticks([])
    axes.grid(axis="y", linewidth=0.4, alpha=0.7)
    axes.set_axisbelow(True)
    for side in ("right", "bottom"):
        axes.spines[side].set_visible(False)
    text = style.text("efficiency", "КПД")
    panel.write(MARGIN - LEFT, panel.height / 2, text, rotation=90, ha="center", va="center")


def _bars(panel: Panel, efficiency: Floats, shares: Floats, style: Style) -> None:
    """The shares of each gear, one below the other, and the efficiency below them."""
    places = np.arange(len(efficiency))
    reached = np.ones(len(efficiency))
    for row, share in enumerate(np.nan_to_num(shares)):
        how: dict[str, Any] = {
            "facecolor": style.colour(row),
            "hatch": style.hatch(row),
            "edgecolor": style.paper,
            "linewidth": 0.5,
        }
        panel.axes.bar(places, -share, BAR, bottom=reached, **how)
        reached = reached - share
    for place, value in enumerate(efficiency):
        if math.isfinite(value):
            low = panel.up(float(value))
            ends = (panel.across(place - BAR / 2), low), (panel.across(place + BAR / 2), low)
            panel.line(*ends, color=style.ink, linewidth=1.5)
            panel.write(panel.across(place), low - 4, number(value), ha="center", va="top")


def _legend(panel: Panel, names: list[str], style: Style) -> None:
    """The colours of mechanisms at the right, from the top."""
    y = panel.height
    for row, name in enumerate(names):
        own = labels.height(name) + 6
        middle = y - own / 2
        left = panel.width + MARGIN
        how = {"facecolor": style.colour(row), "hatch": style.hatch(row)}
        panel.box((left, middle - 4), (10, 8), edgecolor=style.paper, linewidth=0, **how)
        panel.write(left + 20, middle, name, va="center", linespacing=labels.LINE)
        y -= own
