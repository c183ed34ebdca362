"""Picture of the efficiency by gear, with the losses of mechanisms as bars from 1 downwards."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import DRAGGED, LOCKED
from vstatics.core.tables.numbers import typeset
from vstatics.core.tables.values import tables
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.ends import along
from vstatics.pictures.drawing.head import Meaning, NameInKey, sheet_head
from vstatics.pictures.drawing.labels import LEADER, Label, across_size, height, ticks, width
from vstatics.pictures.drawing.line_styles import loss_look
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, Style, number
from vstatics.pictures.drawing.tolerances import EFFICIENCY_STEP, NO_LOSS_SHARE
from vstatics.pictures.drawing.words import fault, gear_title, title

AXES_HEIGHT = 200.0
"""Height of a panel. [pt]"""
STEP, LEAST_STEP = 42.0, 30.0
"""Usual distance of neighbouring gears, and smallest distance at which numbers do not overlap. [pt]
"""
LEAST_AXIS_WIDTH = 200.0
"""Smallest width of a panel. [pt]"""
BAR_WIDTH = 0.66
"""Width of a bar, relative to the distance of gears. [-]"""
EFFICIENCY_SCALE_WIDTH, GEARS_NAME_HEIGHT = 58.0, 24.0
"""Width of the scale, and height of the axis name below the gears. [pt]"""
LEAST_OF_HEAD = 330.0
"""Smallest width of a figure without scale and margin, sufficient for the title. [pt]"""
PANEL_ROW_GAP = 12.0
"""Vertical distance between panels. [pt]"""


class _Losses(NamedTuple):
    """Efficiencies of gears, with the losses in mechanisms and by drag."""

    gears: list[str]
    efficiency: Floats
    """Efficiency of each gear. [-]"""
    names: list[str]
    shares: Floats
    """Losses relative to the input power, shape (names, gears). [-]"""
    missing: dict[int, str]
    """Reason for an undefined efficiency, by the index of the gear."""
    style: Style

    @property
    def key(self) -> list[Meaning]:
        """Entries of the key for the losses that occur."""
        return [
            (True, NameInKey(name), loss_look(row, self.style))
            for row, name in enumerate(self.names)
        ]

    def part(self, places: Sequence[int]) -> _Losses:
        """Return the losses of a selection of gears."""
        missing = {new: self.missing[old] for new, old in enumerate(places) if old in self.missing}
        gears = [self.gears[place] for place in places]
        shares = self.shares[:, list(places)]
        return self._replace(
            gears=gears, efficiency=self.efficiency[list(places)], shares=shares, missing=missing
        )

    def foot(self, step: float) -> tuple[bool, float]:
        """Return True if the names of gears must be vertical, and the height of the names [pt]."""
        upright = any(map(step.__lt__, map(across_size, self.gears)))
        return upright, max(map(width if upright else height, self.gears))


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Canvas]:
    """Draw the efficiency of all gears, or of a selection.

    Parameters
    ----------
    alike : sequence of Results
        Results of further cases whose pictures have the same scale.

    Raises
    ------
    CaseError
        If no requested gear has an efficiency.
    """
    case = results.case
    chosen = [gear - 1 for gear in gears] or list(range(len(case.gears)))
    if np.isnan(results.efficiency[chosen]).all():
        asked = ", ".join(case.gears[place].name for place in chosen)
        which = f"gear {asked}" if gears else "the case"
        raise CaseError("E402", f"{which} has no efficiency to draw")
    losses = _losses(results, chosen, style)
    known = np.concatenate([losses.efficiency, *(other.efficiency for other in alike)])
    lowest = min(float(np.nanmin(known)), 0.99)
    scale = AxisScale(lowest - 0.12 * (1 - lowest), 1.0)
    what = style.text("efficiency and losses of the mechanisms")
    if all(case.coasts(case.gears[place]) for place in chosen):
        what += style.text(" (coasting)")
    return list(_pages(title(case, what), losses, scale, style))


def _losses(results: Results, chosen: Sequence[int], style: Style) -> _Losses:
    efficiency, gears = results.efficiency[list(chosen)], results.case.gears
    names, shares = loss_shares(results, style)
    shares = np.nan_to_num(shares[:, list(chosen)])
    rows = [row for row in range(len(names)) if np.abs(shares[row]).max() > NO_LOSS_SHARE]
    undetermined = style.text("not determined")
    missing = {
        place: next(
            (fault(status, style) for status in (LOCKED, DRAGGED) if status in known), undetermined
        )
        for place, gear in enumerate(chosen)
        if math.isnan(efficiency[place])
        for known in [results.gear_at(gear).statuses]
    }
    shown = [gears[place].name for place in chosen]
    return _Losses(shown, efficiency, [names[row] for row in rows], shares[rows], missing, style)


def _pages(name: str, losses: _Losses, scale: AxisScale, style: Style) -> Iterator[Canvas]:
    """Yield pages of panels from top to bottom, none wider than the page."""
    room = style.width - EFFICIENCY_SCALE_WIDTH - MARGIN
    count = len(losses.gears)
    panels = -(-count // max(int(room / LEAST_STEP), 1))
    parts = [losses.part(indices.tolist()) for indices in np.array_split(np.arange(count), panels)]
    most = max(len(part.gears) for part in parts)
    step = min(max(STEP, LEAST_AXIS_WIDTH / most), room / most)
    foot = max(part.foot(step)[1] for part in parts)
    below = LEADER + foot + GEARS_NAME_HEIGHT
    high = below + AXES_HEIGHT + PANEL_ROW_GAP
    note = "" if losses.names or losses.missing else style.text("nothing is lost")
    wide = EFFICIENCY_SCALE_WIDTH + MARGIN + max(most * step, LEAST_OF_HEAD)
    wide = min(wide, style.width)
    head = sheet_head(name, note, losses.key, wide - 2 * MARGIN, style)
    on_page = (
        max(int((style.height - head.high - MARGIN) / high), 1)
        if math.isfinite(style.height)
        else panels
    )
    for at in range(0, panels, on_page):
        page = parts[at : at + on_page]
        pen = head.over((wide, len(page) * high), MARGIN, style)
        for row, part in enumerate(reversed(page)):
            indices = pen.panel(
                (EFFICIENCY_SCALE_WIDTH, row * high + below),
                (len(part.gears) * step, AXES_HEIGHT),
                AxisScale(-0.5, len(part.gears) - 0.5),
                scale,
            )
            _panel(indices, part, part.foot(step)[0], LEADER + foot + SIZE)
        yield pen.canvas


def _panel(pen: Pen, losses: _Losses, upright: bool, name_off: float) -> None:  # noqa: FBT001
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
    """Return the losses of mechanisms and drag as fractions of the input power.

    Returns
    -------
    list of str
        Names of gear sets or mechanisms, then drag if present.
    ndarray, shape (rows, gears)
        Losses divided by input power, NaN if the efficiency is undefined. Losses and efficiency
        have the sum 1. [-]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> pair = Mechanism(1, 2, 0, ratio=-2.5, efficiency=0.96)
    >>> names, shares = loss_shares(solve(Transmission(2, [], [pair], [Gear()])), Style())
    >>> names, shares.round(6)
    (['D1'], array([[0.04]]))
    """
    by_name = {table.quantity.name: table for table in tables(results)}
    names, losses = list(by_name["losses"].rows), by_name["losses"].values
    if "drag_losses" in by_name:
        names.append(style.text("drag"))
        losses = np.vstack([losses, by_name["drag_losses"].values])
    if "slip_losses" in by_name:
        names += map("slip.{}".format, by_name["slip_losses"].rows)
        losses = np.vstack([losses, by_name["slip_losses"].values])
    total = losses.sum(axis=0)
    # The power balance gives the sum 1 - efficiency. Losses are negative when coasting.
    entered = np.where(total == 0, 1.0, total)
    return names, losses / entered * (1.0 - results.efficiency) + 0.0


def _bars(pen: Pen, losses: _Losses) -> None:
    """Draw the bars of each gear: the losses from 1 downwards, and the efficiency underneath."""
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
        pen.text(left + wide / 2, low - 4, number(value), ha="center", va="top", over=True)
