"""Picture of the response of a link to a harmonic torque on it, over speed, for several orders.

Each gear has a panel with a line for each order, whose torque has the amplitude 1 N*m or is from a
table. Speeds and orders are chosen as in the Campbell diagram.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, listed
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.head import Meaning, SheetHead, sheet_head
from vstatics.pictures.drawing.labels import height, power_of_ten, ticks, width, wrapped
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import MARGIN, Style, number
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.torsion.pictures.orders.orders_and_speeds import Order
from vstatics.torsion.pictures.orders.resonances import Meeting
from vstatics.torsion.pictures.orders.response_lines import (
    ResponseLine,
    ResponsePanel,
    by_order,
    response_panels,
)
from vstatics.torsion.pictures.orders.running import draw_running, running_sign

RESPONSE_HEIGHT, LEAST_RESPONSE_HEIGHT = 118.0, 84.0
"""Usual and smallest height of a panel among several. [pt]"""
LONE_RESPONSE_HEIGHT = 230.0
"""Height of a single panel. [pt]"""
AMPLITUDE_SCALE_WIDTH, SPEED_SCALE_HEIGHT = 40.0, 40.0
"""Width of the scale of amplitudes, and height of the scale of speeds. [pt]"""
PANEL_HEAD = 18.0
"""Height above a panel for the name of the gear. [pt]"""
BETWEEN_PANELS = 12.0
"""Gap between panels. [pt]"""
MOST_DECADES = 7
"""Largest number of powers of ten in the scale of amplitudes."""
SLOW = 0.04
"""Speed below which only resonances affect the scale, divided by the highest speed.

Amplitudes grow without bound towards speed 0.
"""


class _ResponseSheet(NamedTuple):
    """Panels of all gears, with orders, speeds and a scale in common."""

    panels: Sequence[ResponsePanel]
    orders: Sequence[Order]
    running: Sequence[float]
    """Speeds at which the input runs, if the torque acts on the input. [rpm]"""
    fastest: float
    """Highest speed. [rpm]"""
    slowest: float
    """Lowest speed. [rpm]"""
    decades: tuple[float, float]
    """Exponents of 10 at both ends of the scale of amplitudes in rad."""
    style: Style

    @property
    def link(self) -> str:
        """Link on which the torque acts; empty if the link differs between gears."""
        links = {panel.link for panel in self.panels}
        return next(iter(links)) if len(links) == 1 else ""

    def look(self, order: Order) -> Look:
        """Return the line style of an order; firing orders have thick lines."""
        place, wide = self.orders.index(order), 1.9 if order.fires else 1.0
        return {
            "color": self.style.colour(place),
            "linestyle": self.style.dash(place),
            "width": wide,
        }


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Canvas]:
    """Draw the response in each gear of a case, or in given gears, on pages.

    Raises
    ------
    CaseError
        If scipy is not installed, or nothing can be excited in these gears.
    ValueError
        If the link does not exist.
    """
    excited, panels = response_panels(results, style, gears)
    if not any(panel.lines for panel in panels):
        names = listed([panel.gear for panel in panels])
        raise CaseError("E741", f"no response in gear {names}: {panels[0].why}")
    running = [] if style.excited.at else excited.running
    decades = _decades(panels, excited.fastest)
    sheet = _ResponseSheet(panels, excited.orders, running, *excited[2:], decades, style)
    columns = min(2, len(panels))
    high, on_page = _rows(results, sheet, math.ceil(len(panels) / columns))
    parts = range(0, len(panels), on_page * columns)
    return [
        _figure(results, sheet, panels[start : start + on_page * columns], (columns, high))
        for start in parts
    ]


def _rows(results: Results, sheet: _ResponseSheet, rows: int) -> tuple[float, int]:
    """Return the height of panels [pt], and the number of panel rows per page."""
    if len(sheet.panels) == 1:
        return LONE_RESPONSE_HEIGHT, 1
    if math.isinf(sheet.style.height):
        return RESPONSE_HEIGHT, rows
    room = sheet.style.height - _head(results, sheet).high - MARGIN - SPEED_SCALE_HEIGHT
    high = room / rows - PANEL_HEAD - BETWEEN_PANELS
    if high >= LEAST_RESPONSE_HEIGHT:
        return min(high, RESPONSE_HEIGHT), rows
    return RESPONSE_HEIGHT, max(1, int(room / (PANEL_HEAD + RESPONSE_HEIGHT + BETWEEN_PANELS)))


def _head(results: Results, sheet: _ResponseSheet) -> SheetHead:
    style = sheet.style
    link = sheet.link or style.text("the input")
    words = "amplitude of {link} by a torque of 1 N·m on it"
    if harmonics := by_order(style).values():
        words = "amplitude of {link} by each order of the torque on it"
        if any(harmonic.by_link for harmonic in harmonics):
            words = "amplitude of {link} by each order of the torques"
    subject = style.text(words, link=link)
    signs: list[Meaning] = [
        (True, order.name + style.text(", fires") * order.fires, sheet.look(order))
        for order in sheet.orders
    ]
    signs += running_sign(sheet.running, style)
    return sheet_head(title(results.case, subject), "", signs, style.width - 2 * MARGIN, style)


def _decades(panels: Sequence[ResponsePanel], fastest: float) -> tuple[float, float]:
    """Return exponents of 10 that enclose the amplitudes, at most 7 apart."""
    lines = [line for panel in panels for line in panel.lines]
    lowest = min((met.mode.frequency for panel in panels for met in panel.peaks), default=math.inf)
    slow = SLOW * fastest
    logs = [
        _logs(line.amplitudes[line.speeds >= min(slow, line.order.speed(lowest))]) for line in lines
    ]
    every = np.concatenate(logs)
    every = every[np.isfinite(every)]
    high = math.ceil(float(every.max(initial=-30.0)))
    low = math.floor(float(every.min(initial=high - 1.0)))
    return float(max(low, high - MOST_DECADES)), float(high)


def _logs(amplitudes: Floats) -> Floats:
    known = np.where(amplitudes > 0, amplitudes, np.nan)
    logs: Floats = np.log10(known)
    return logs


def _figure(
    results: Results,
    sheet: _ResponseSheet,
    panels: Sequence[ResponsePanel],
    size: tuple[int, float],
) -> Canvas:
    """Draw panels; `size` contains the number of columns and the height of a panel [pt]."""
    style, (columns, high) = sheet.style, size
    rows = math.ceil(len(panels) / columns)
    pitch = PANEL_HEAD + high + BETWEEN_PANELS
    whole = style.width, rows * pitch + SPEED_SCALE_HEIGHT
    pen = _head(results, sheet).over(whole, MARGIN, style)
    left = MARGIN + 14.0
    across = (style.width - left - MARGIN) / columns
    wide = across - AMPLITUDE_SCALE_WIDTH
    scales = AxisScale(sheet.slowest, sheet.fastest), AxisScale(*sheet.decades)
    for place, panel in enumerate(panels):
        row, column = divmod(place, columns)
        corner = (
            left + column * across + AMPLITUDE_SCALE_WIDTH,
            SPEED_SCALE_HEIGHT + (rows - 1 - row) * pitch,
        )
        in_panel = pen.panel(corner, (wide, high), *scales).within("panel", gear=panel.gear)
        is_lowest = place + columns >= len(panels)
        _draw_panel(in_panel, panel, sheet, is_lowest=is_lowest)
    middle = SPEED_SCALE_HEIGHT + (rows * pitch) / 2
    pen.text(
        MARGIN,
        middle,
        style.text("amplitude, rad"),
        rotation=90,
        ha="center",
        va="center",
    )
    return pen.canvas


def _draw_panel(pen: Pen, panel: ResponsePanel, sheet: _ResponseSheet, *, is_lowest: bool) -> None:
    (wide, high), style = pen.size, sheet.style
    head = gear_title(panel.gear, style)
    pen.text(0.0, high + 4.0, head, va="bottom", bold=True)
    if panel.why:
        pen.frame()
        why = wrapped(panel.why, wide - 12.0)
        pen.text(wide / 2, high / 2, why, ha="center", va="center")
        return
    draw_running(pen, sheet.running, style)
    _draw_scales(pen, sheet, is_lowest=is_lowest)
    for line in panel.lines:
        order = line.order
        group = pen.within("line", order=f"{order.number:g}", firing=json.dumps(order.fires))
        group.plot(
            line.speeds,
            _logs(line.amplitudes),
            title=f"{head}, {order.name}",
            **sheet.look(order),
        )
    by_order = {line.order: line for line in panel.lines}
    for met in panel.peaks:
        _draw_peak(pen, by_order[met.order], met, sheet)


def _draw_scales(pen: Pen, sheet: _ResponseSheet, *, is_lowest: bool) -> None:
    """Draw the scales of amplitudes and speeds, with numbers of speeds at the lowest panel only."""
    style, (wide, _) = sheet.style, pen.size
    low, high = (int(end) for end in sheet.decades)
    decades = list(range(low, high + 1))
    pen.scale("left", decades, [power_of_ten(exponent) for exponent in decades], grid=True)
    speeds = ticks(sheet.slowest, sheet.fastest, max(2, int(wide / 34.0)))
    pen.scale("bottom", speeds, [f"{speed:g}" for speed in speeds] if is_lowest else [], grid=True)
    pen.frame()
    if is_lowest:
        rpm = style.text("rpm")
        name = style.text("speed of {link}, {rpm}", link=sheet.link, rpm=rpm)
        if not sheet.link or width(name) > wide:  # the links differ, or their name is long
            name = style.text("speed, {rpm}", rpm=rpm)
        pen.name("bottom", name, 12.0 + 1.5 * height(""))


def _draw_peak(pen: Pen, line: ResponseLine, met: Meeting, sheet: _ResponseSheet) -> None:
    """Draw a dot on the line at a resonance, if its amplitude is within the scale."""
    at = int(np.argmin(np.abs(line.speeds - met.speed)))
    value = _logs(line.amplitudes[at : at + 1])[0]
    low, high = sheet.decades
    if not low <= value <= high:
        return
    style = sheet.style
    hint = style.text("mode {number}", number=met.mode.number)
    rpm, rad = style.text("rpm"), style.text("rad")
    hint = f"{line.order.name}, {hint}: {met.speed:.0f} {rpm}, {number(10.0**value)} {rad}"
    dot = {"marker": "o", "markersize": 2.2, "zorder": 3, "color": sheet.look(line.order)["color"]}
    pen.line((pen.across(float(line.speeds[at])), pen.up(float(value))), title=hint, **dot)
