"""Efficiency by gear: what each mechanism loses hangs down from 1 to the efficiency."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.errors import CaseError
from vstatics.numerics.arrays import Floats
from vstatics.pictures.sheet.ends import along
from vstatics.pictures.sheet.head import KeySign, headed
from vstatics.pictures.sheet.labels import LEADER, Label, across_size, height, ticks, width, wrapped
from vstatics.pictures.sheet.line_styles import loss_look
from vstatics.pictures.sheet.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.sheet.style import MARGIN, SIZE, Style, number
from vstatics.pictures.sheet.tolerances import EFFICIENCY_STEP, NO_LOSS_SHARE
from vstatics.pictures.sheet.words import fault, gear_title, term, title
from vstatics.statics.results import Results
from vstatics.statics.status import DRAGGED, LOCKED
from vstatics.tables.numbers import typeset
from vstatics.tables.values import tables

AXES_HEIGHT = 230.0
"""Of the axes. [pt]"""
STEP = 42.0
"""Between gears. [pt]"""
LEAST_AXIS_WIDTH = 200.0
"""Width of the axes at least. [pt]"""
BAR_WIDTH = 0.66
"""Width of a bar over the step."""
EFFICIENCY_SCALE_WIDTH, GEARS_NAME_HEIGHT = 58.0, 24.0
"""For the scale, and for what the gears are called together. [pt]"""
MECHANISM_NAME_WIDTH = 120.0
"""Names of mechanisms are wrapped to this width. [pt]"""


class _Losses(NamedTuple):
    """What is drawn: some gears, and what takes a share in any of them."""

    gears: list[str]
    efficiency: Floats
    """[-]"""
    names: list[str]
    shares: Floats
    """Shape (names, gears). [-]"""
    missing: dict[int, str]
    """Why a gear at a place has no efficiency."""
    style: Style

    @property
    def key(self) -> list[KeySign]:
        """The areas of the names, which are wrapped."""
        return [
            KeySign(wrapped(name, MECHANISM_NAME_WIDTH), loss_look(row, self.style))
            for row, name in enumerate(self.names)
        ]

    @property
    def foot(self) -> tuple[bool, float]:
        """Whether the names of gears run upwards, as they do not fit else; their height [pt]."""
        step = max(STEP, LEAST_AXIS_WIDTH / len(self.gears))
        upright = any(map(step.__lt__, map(across_size, self.gears)))
        return upright, max(map(width if upright else height, self.gears))


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
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
        raise CaseError("E402", f"{which} has no efficiency that could be drawn")
    names, shares = loss_shares(results, style)
    shares = np.nan_to_num(shares[:, chosen])
    rows = [row for row in range(len(names)) if np.abs(shares[row]).max() > NO_LOSS_SHARE]
    undetermined = style.text("not determined", "не определён")
    missing = {
        place: next((fault(one, style) for one in (LOCKED, DRAGGED) if one in known), undetermined)
        for place, gear in enumerate(chosen)
        if math.isnan(efficiency[place])
        for known in [results.gear(gear + 1).statuses]
    }
    shown = [case.gears[place].name for place in chosen]
    losses = _Losses(shown, efficiency, [names[row] for row in rows], shares[rows], missing, style)
    what = style.text("efficiency, and what each mechanism takes", "КПД и доли потерь в механизмах")
    if all(case.coasts(case.gears[place]) for place in chosen):
        what += style.text(" (coasting)", " (торможение двигателем)")
    pen = _panel(title(case, what), losses)
    _bars(pen, losses)
    for place, why in missing.items():
        where = pen.across(place), pen.size[1] - 6
        pen.text(*where, why, ha="center", va="top", rotation=90)
    y = pen.size[1]
    for sign in losses.key:
        high = height(sign.text) + 6
        sign.draw(pen, pen.size[0] + MARGIN / 2, y - high / 2)
        y -= high
    return [pen.figure]


def _panel(name: str, losses: _Losses) -> Pen:
    """Scales from 1 down to a little below the lowest bar, and of the gears; with all names."""
    style, (upright, foot) = losses.style, losses.foot
    wide = max(len(losses.gears) * STEP, LEAST_AXIS_WIDTH)
    high = max(AXES_HEIGHT, sum(height(sign.text) + 6 for sign in losses.key))
    beside = max((sign.wide for sign in losses.key), default=0.0)
    across = EFFICIENCY_SCALE_WIDTH + wide + 2 * MARGIN + beside
    lossless = style.text("nothing is lost", "потерь нет")
    note = "" if losses.names or losses.missing else lossless
    below = LEADER + foot + GEARS_NAME_HEIGHT
    lowest = min(float(np.nanmin(losses.efficiency)), 0.99)
    pen = headed(name, note, [], (across, below + high + SIZE), style).panel(
        (EFFICIENCY_SCALE_WIDTH, below),
        (wide, high),
        AxisScale(-0.6, len(losses.gears) - 0.4),
        AxisScale(lowest - 0.12 * (1 - lowest), 1.0),
    )
    pen.frame("left", "top")
    numbers = ticks(pen.y.low, 1.0, 6)
    pen.scale("left", numbers, tick_texts(numbers, [EFFICIENCY_STEP]), grid=True)
    pen.name("left", term("efficiency", style), EFFICIENCY_SCALE_WIDTH - MARGIN - SIZE / 2)
    at = [Label(pen.across(place), gear, style.ink) for place, gear in enumerate(losses.gears)]
    along(pen, "bottom", at, upright=upright)
    pen.name("bottom", term("gear", style), LEADER + foot + SIZE)
    return pen


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


def _bars(pen: Pen, losses: _Losses) -> None:
    """The shares of each gear, one below the other, and the efficiency below them."""
    style, wide = losses.style, BAR_WIDTH * pen.size[0] / (pen.x.high - pen.x.low)
    for place, (gear, value) in enumerate(zip(losses.gears, losses.efficiency, strict=True)):
        if not math.isfinite(value):
            continue
        left, reached = pen.across(place) - wide / 2, 1.0
        head = gear_title(gear, style)
        for row, name in enumerate(losses.names):
            share = float(losses.shares[row, place])
            if abs(share) > NO_LOSS_SHARE:
                top, low = pen.up(reached), pen.up(reached - share)
                said = f"{head}, {name}: {typeset(f'{100 * share:.3g} %')}"
                pen.box((left, low), (wide, top - low), title=said, **loss_look(row, style))
                if top - low > SIZE + 2 and width(name) < wide - 2:
                    at = left + wide / 2, (top + low) / 2
                    pen.text(*at, name, ha="center", va="center_baseline", over=True)
                reached -= share
        low, reads = pen.up(float(value)), term("efficiency", style)
        said = f"{head}: {reads} {number(value)}"
        pen.line((left, low), (left + wide, low), color=style.ink, width=1.5, title=said)
        pen.text(left + wide / 2, low - 4, number(value), ha="center", va="top")
