"""Efficiency by gear: what each mechanism loses hangs down from 1 to the efficiency."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Floats
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import AxisScale, Chart, tick_texts
from vstatics.pictures.sheet.ends import along
from vstatics.pictures.sheet.gear_state import state_of
from vstatics.pictures.sheet.head import AFTER, SIGN_WIDTH, KeySign, chart_head
from vstatics.pictures.sheet.labels import LEADER, Label, Paper
from vstatics.pictures.sheet.line_styles import loss_look
from vstatics.pictures.sheet.style import SIZE, Style, number
from vstatics.pictures.sheet.svg import halo, told
from vstatics.pictures.sheet.words import fault, gear_title, title
from vstatics.statics.results import Results
from vstatics.statics.status import LOCKED
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
EFFICIENCY_MARGIN = 12.0
"""[pt]"""
LEFT, BELOW = 58.0, 24.0
"""For the scale, and for what the gears are called together. [pt]"""
MECHANISM_NAME_WIDTH = 120.0
"""Names of mechanisms are wrapped to this width. [pt]"""
NO_SHARE = 1e-9
"""A smaller share is rounding. [-]"""


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

    @property
    def key(self) -> list[str]:
        """The names, wrapped."""
        return [labels.wrapped(name, MECHANISM_NAME_WIDTH) for name in self.names]


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
    shares = np.nan_to_num(shares[:, chosen])
    rows = [row for row in range(len(names)) if np.abs(shares[row]).max() > NO_SHARE]
    missing = {
        place: _why(results, one + 1, style)
        for place, one in enumerate(chosen)
        if math.isnan(efficiency[place])
    }
    shown = [case.gears[place].name for place in chosen]
    losses = _Losses(shown, efficiency, [names[row] for row in rows], shares[rows], missing)
    chart = _chart(_title(case, style), losses, style)
    _scales(chart, losses, style)
    _bars(chart, losses, style)
    for place, why in missing.items():
        how: dict[str, Any] = {"ha": "center", "va": "top", "rotation": 90}
        chart.write(chart.across(place), chart.height - 6, why, **how)
    _key(chart, losses, style)
    return chart.paper.figure


def _why(results: Results, gear: int, style: Style) -> str:
    """Why a gear has no efficiency."""
    if LOCKED in state_of(results, gear).faults:
        return fault(LOCKED, style)
    return style.text("not determined", "не определён")


def _chart(name: str, losses: _Losses, style: Style) -> Chart:
    """A chart with room for its title, the names of gears and those of mechanisms."""
    wide = max(len(losses.gears) * STEP, LEAST_AXIS_WIDTH)
    high = max(AXES_HEIGHT, sum(labels.height(name) + 6 for name in losses.key))
    beside = max((SIGN_WIDTH + AFTER + labels.width(name) for name in losses.key), default=0.0)
    across = LEFT + wide + 2 * EFFICIENCY_MARGIN + beside
    lossless = style.text("nothing is lost", "потерь нет")
    note = "" if losses.names or losses.missing else lossless
    head = chart_head(name, note, [], across - 2 * EFFICIENCY_MARGIN, style)
    below = LEADER + _foot(losses.gears)[1] + BELOW
    up = below + high + head.high + EFFICIENCY_MARGIN + SIZE
    paper = Paper(labels.figure(across, up))
    head.draw(paper, EFFICIENCY_MARGIN, up - EFFICIENCY_MARGIN, style)
    lowest = min(float(np.nanmin(losses.efficiency)), 0.99)
    x = AxisScale(-0.6, len(losses.gears) - 0.4)
    y = AxisScale(lowest - 0.12 * (1 - lowest), 1.0)
    return Chart(paper, (LEFT, below), wide, high, x, y)


def _foot(gears: Sequence[str]) -> tuple[bool, float]:
    """Whether the names of gears run upwards, as they do not fit else, and their height [pt]."""
    step = max(STEP, LEAST_AXIS_WIDTH / len(gears))
    if any(labels.width(name) + 2 * labels.LABEL_GAP > step for name in gears):
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


def _scales(chart: Chart, losses: _Losses, style: Style) -> None:
    """From 1 down to a little below the lowest bar, with room for its number; the gears."""
    chart.frame(style, "left", "top")
    ticks = labels.ticks(chart.y.low, 1.0, 6)
    chart.scale("left", ticks, style, tick_texts(ticks, [0.001]), grid=True)
    chart.name("left", style.text("efficiency", "КПД"), LEFT - EFFICIENCY_MARGIN - SIZE / 2)
    upright, high = _foot(losses.gears)
    at = [Label(chart.across(place), name, style.ink) for place, name in enumerate(losses.gears)]
    along(chart, "bottom", at, style, upright=upright)
    chart.name("bottom", style.text("gear", "передача"), LEADER + high + SIZE)


def _bars(chart: Chart, losses: _Losses, style: Style) -> None:
    """The shares of each gear, one below the other, and the efficiency below them."""
    wide = BAR_WIDTH * chart.width / (chart.x.high - chart.x.low)
    for place, (gear, value) in enumerate(zip(losses.gears, losses.efficiency, strict=True)):
        if not math.isfinite(value):
            continue
        left, reached = chart.across(place) - wide / 2, 1.0
        for row, name in enumerate(losses.names):
            share = float(losses.shares[row, place])
            if abs(share) > NO_SHARE:
                top, low = chart.up(reached), chart.up(reached - share)
                percent = typeset(f"{100 * share:.3g} %")
                said = told(f"{gear_title(gear, style)}, {name}: {percent}")
                chart.box((left, low), (wide, top - low), gid=said, **loss_look(row, style))
                if top - low > SIZE + 2 and labels.width(name) < wide - 2:
                    how: dict[str, Any] = {"ha": "center", "va": "center_baseline"}
                    chart.write(left + wide / 2, (top + low) / 2, name, **how, **halo(style))
                reached -= share
        low, reads = chart.up(float(value)), style.text("efficiency", "КПД")
        said = told(f"{gear_title(gear, style)}: {reads} {number(value)}")
        how = {"color": style.ink, "linewidth": 1.5, "solid_capstyle": "butt", "gid": said}
        chart.line((left, low), (left + wide, low), **how)
        chart.write(left + wide / 2, low - 4, number(value), ha="center", va="top")


def _key(chart: Chart, losses: _Losses, style: Style) -> None:
    """The areas of mechanisms at the right, from the top."""
    left, low = chart.corner
    y = low + chart.height
    for row, name in enumerate(losses.key):
        high = labels.height(name) + 6
        sign = KeySign(name, loss_look(row, style))
        sign.draw(chart.paper, left + chart.width + EFFICIENCY_MARGIN / 2, y - high / 2)
        y -= high
