"""Efficiency by gear: what each mechanism loses hangs down from 1 to the efficiency."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import DRAGGED, LOCKED
from vstatics.core.tables.numbers import typeset
from vstatics.core.tables.values import tables
from vstatics.pictures.drawing.ends import along
from vstatics.pictures.drawing.head import Meaning, NameInKey, headed, sheet_head
from vstatics.pictures.drawing.labels import LEADER, Label, across_size, height, ticks, width
from vstatics.pictures.drawing.line_styles import loss_look
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, Style, number
from vstatics.pictures.drawing.tolerances import EFFICIENCY_STEP, NO_LOSS_SHARE
from vstatics.pictures.drawing.words import fault, gear_title, title

AXES_HEIGHT = 200.0
"""Of a panel. [pt]"""
STEP, LEAST_STEP = 42.0, 30.0
"""Between gears, and at least, so that numbers stand beside each other. [pt]"""
LEAST_AXIS_WIDTH = 200.0
"""Width of a panel at least. [pt]"""
BAR_WIDTH = 0.66
"""Width of a bar over the step."""
EFFICIENCY_SCALE_WIDTH, GEARS_NAME_HEIGHT = 58.0, 24.0
"""For the scale, and for what the gears are called together. [pt]"""
LEAST_OF_HEAD = 330.0
"""Room for the title. [pt]"""
PANEL_ROW_GAP = 12.0
"""Between panels below one another. [pt]"""


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
    def key(self) -> list[Meaning]:
        """The areas of the names."""
        return [(True, NameInKey(name), loss_look(row, self.style)) for row, name in self._drawn()]

    def _drawn(self) -> list[tuple[int, str]]:
        seen = [np.abs(own).max(initial=0.0) > NO_LOSS_SHARE for own in self.shares]
        return [(row, name) for row, name in enumerate(self.names) if seen[row]]

    def part(self, places: Sequence[int]) -> _Losses:
        """The same of some gears."""
        missing = {new: self.missing[old] for new, old in enumerate(places) if old in self.missing}
        gears = [self.gears[place] for place in places]
        shares = self.shares[:, list(places)]
        return self._replace(
            gears=gears, efficiency=self.efficiency[list(places)], shares=shares, missing=missing
        )

    def foot(self, step: float) -> tuple[bool, float]:
        """Whether the names of gears run upwards, as they do not fit else; their height [pt]."""
        upright = any(map(step.__lt__, map(across_size, self.gears)))
        return upright, max(map(width if upright else height, self.gears))


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Figure]:
    """Draw the efficiency of all gears, or of some.

    Parameters
    ----------
    alike : sequence of Results
        Of further cases, with which the scale is common.

    Raises
    ------
    CaseError
        If no gear that is asked for has an efficiency.
    """
    case = results.case
    chosen = [gear - 1 for gear in gears] or list(range(len(case.gears)))
    if np.isnan(results.efficiency[chosen]).all():
        asked = ", ".join(case.gears[place].name for place in chosen)
        which = f"gear {asked}" if gears else "the case"
        raise CaseError("E402", f"{which} has no efficiency that could be drawn")
    losses = _losses(results, chosen, style)
    known = np.concatenate([losses.efficiency, *(one.efficiency for one in alike)])
    lowest = min(float(np.nanmin(known)), 0.99)
    scale = AxisScale(lowest - 0.12 * (1 - lowest), 1.0)
    what = style.text("efficiency, and what each mechanism takes")
    if all(case.coasts(case.gears[place]) for place in chosen):
        what += style.text(" (coasting)")
    return list(_pages(title(case, what), losses, scale, style))


def _losses(results: Results, chosen: Sequence[int], style: Style) -> _Losses:
    """What some gears lose, by their indices."""
    efficiency, gears = results.efficiency[list(chosen)], results.case.gears
    names, shares = loss_shares(results, style)
    shares = np.nan_to_num(shares[:, list(chosen)])
    rows = [row for row in range(len(names)) if np.abs(shares[row]).max() > NO_LOSS_SHARE]
    undetermined = style.text("not determined")
    missing = {
        place: next((fault(one, style) for one in (LOCKED, DRAGGED) if one in known), undetermined)
        for place, gear in enumerate(chosen)
        if math.isnan(efficiency[place])
        for known in [results.gear_at(gear).statuses]
    }
    shown = [gears[place].name for place in chosen]
    return _Losses(shown, efficiency, [names[row] for row in rows], shares[rows], missing, style)


def _pages(name: str, losses: _Losses, scale: AxisScale, style: Style) -> Iterator[Figure]:
    """Panels below one another, each as wide as the page at most."""
    room = style.width - EFFICIENCY_SCALE_WIDTH - MARGIN
    count = len(losses.gears)
    panels = -(-count // max(int(room / LEAST_STEP), 1))
    parts = [losses.part(own.tolist()) for own in np.array_split(np.arange(count), panels)]
    most = max(len(part.gears) for part in parts)
    step = min(max(STEP, LEAST_AXIS_WIDTH / most), room / most)
    foot = max(part.foot(step)[1] for part in parts)
    below = LEADER + foot + GEARS_NAME_HEIGHT
    high = below + AXES_HEIGHT + PANEL_ROW_GAP
    lossless = style.text("nothing is lost")
    note = "" if losses.names or losses.missing else lossless
    wide = EFFICIENCY_SCALE_WIDTH + MARGIN + max(most * step, LEAST_OF_HEAD)
    wide = min(wide, style.width)
    head = sheet_head(name, note, losses.key, wide - 2 * MARGIN, style).high
    on_page = (
        max(int((style.height - head - MARGIN) / high), 1)
        if math.isfinite(style.height)
        else panels
    )
    for at in range(0, panels, on_page):
        page = parts[at : at + on_page]
        pen = headed(name, note, losses.key, (wide, len(page) * high), style)
        for row, part in enumerate(reversed(page)):
            own = pen.panel(
                (EFFICIENCY_SCALE_WIDTH, row * high + below),
                (len(part.gears) * step, AXES_HEIGHT),
                AxisScale(-0.5, len(part.gears) - 0.5),
                scale,
            )
            _panel(own, part, part.foot(step)[0], LEADER + foot + SIZE)
        yield pen.figure


def _panel(pen: Pen, losses: _Losses, upright: bool, name_off: float) -> None:  # noqa: FBT001
    """Scales from 1 down to a little below the lowest bar, and of the gears; with all bars."""
    style = losses.style
    pen.frame("left", "top")
    numbers = ticks(pen.y.low, 1.0, 6)
    pen.scale("left", numbers, tick_texts(numbers, [EFFICIENCY_STEP]), grid=True)
    pen.name("left", style.text("efficiency"), EFFICIENCY_SCALE_WIDTH - MARGIN - SIZE / 2)
    at = [Label(pen.across(place), gear, style.ink) for place, gear in enumerate(losses.gears)]
    along(pen, "bottom", at, upright=upright)
    pen.name("bottom", style.text("gear"), name_off)
    _bars(pen, losses)
    for place, why in losses.missing.items():
        where = pen.across(place), pen.size[1] - 6
        pen.text(*where, why, ha="center", va="top", rotation=90)


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
        names.append(style.text("drag"))
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
        low, reads = pen.up(float(value)), style.text("efficiency")
        said = f"{head}: {reads} {number(value)}"
        pen.line((left, low), (left + wide, low), color=style.ink, width=1.5, title=said)
        pen.text(left + wide / 2, low - 4, number(value), ha="center", va="top")
