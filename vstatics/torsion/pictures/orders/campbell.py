"""Campbell diagram: natural frequencies of gears and orders over the speed of the input.

A panel with linear scales shows the modes of all gears as horizontal lines, and the orders as lines
through 0. A strip to the right shows the frequencies gear by gear, and a table below lists
resonances.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence

from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.drawing.head import Meaning, sheet_head
from vstatics.pictures.drawing.labels import Label, height, ticks, widest, width
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import MARGIN, Style
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.torsion.pictures.orders.campbell_sheet import (
    CampbellSheet,
    campbell_sheet,
    order_look,
)
from vstatics.torsion.pictures.orders.dots import dot_look, dot_signs
from vstatics.torsion.pictures.orders.gear_strip import GearStrip, thinned
from vstatics.torsion.pictures.orders.orders_and_speeds import Order
from vstatics.torsion.pictures.orders.resonance_table import TableParts, resonance_tables
from vstatics.torsion.pictures.orders.resonances import Meeting
from vstatics.torsion.pictures.orders.running import draw_running, running_sign

PANEL_HEIGHT = 250.0
"""Usual height of the panel. [pt]"""
TALLEST_PANEL = 340.0
"""Largest height of the panel, if the page has room. [pt]"""
FREQUENCY_SCALE_WIDTH, SPEED_SCALE_HEIGHT = 52.0, 46.0
"""Width of the scale of frequencies, and height of the scale of speeds. [pt]"""
ORDERS_PART = 0.6
"""Largest share of the right edge for names of orders, if names of modes need room, too."""
ABOVE_PANEL = 16.0
"""Height above the panel for the title of the strip of gears. [pt]"""
BEFORE_STRIP = 6.0
"""Gap between names of orders and the strip of gears. [pt]"""


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Canvas]:
    """Draw the Campbell diagram of all gears of a case, or of given gears, on pages.

    Raises
    ------
    CaseError
        If scipy is not installed, or no gear has a natural frequency.
    """
    sheet = campbell_sheet(results, style, gears)
    return list(_pages(sheet))


def _mode_look(style: Style, *, is_common: bool) -> Look:
    """Return the line style of a natural frequency, without colour, since colours are for links."""
    return {"color": style.ink, "width": 1.3 if is_common else 0.5}


def _signs(sheet: CampbellSheet) -> list[Meaning]:
    style, several = sheet.style, len(sheet.gears) > 1
    common = [len(mode.modes) == len(sheet.gears) for mode in sheet.shared]
    of_all = "natural frequency of all gears" if several else "natural frequency"
    firing = [order.fires for order in sheet.orders]
    return [
        (any(common), of_all, _mode_look(style, is_common=True)),
        (not all(common), "of some gears", _mode_look(style, is_common=False)),
        (not all(firing), "order n×", order_look(Order(1.0, fires=False), style)),
        (any(firing), "order that fires", order_look(Order(1.0, fires=True), style)),
        *running_sign(sheet.running, style),
        *dot_signs(sheet.meetings, style),
    ]


def _pages(sheet: CampbellSheet) -> Iterator[Canvas]:
    """Draw a page with the panel and the tables that fit, then pages with all other tables."""
    style, across = sheet.style, sheet.style.width
    room, subject = across - 2 * MARGIN, style.text("Campbell diagram")
    if len(sheet.gears) == 1 < len(sheet.case.gears):
        subject = f"{subject}, {gear_title(sheet.gears[0], style)}"
    text = title(sheet.case, subject)
    remaining = TableParts([(table, table.rows) for table in resonance_tables(sheet, room)])
    head = sheet_head(text, sheet.note, _signs(sheet), room, style)
    around = ABOVE_PANEL + SPEED_SCALE_HEIGHT
    high = max(PANEL_HEIGHT, height_of(sheet.order_ends))
    free = style.height - head.high - MARGIN - around
    if math.isfinite(free):
        high = max(high, free - remaining.high)
    high = min(high, TALLEST_PANEL)
    first, remaining = remaining.fitting(free - high)
    pen = head.over((across, first.high + around + high), MARGIN, style)
    _draw_panel(pen, sheet, (first.high + SPEED_SCALE_HEIGHT, high))
    first.draw(pen)
    yield pen.canvas
    head = sheet_head(text, "", [], room, style)
    while remaining.parts:
        page, remaining = remaining.fitting(style.height - head.high - MARGIN, least=1)
        pen = head.over((across, page.high), MARGIN, style)
        page.draw(pen)
        yield pen.canvas


def _draw_panel(pen: Pen, sheet: CampbellSheet, place: tuple[float, float]) -> None:
    """Draw the panel and the strip of gears; `place` is lower edge and height [pt]."""
    (low, high), style = place, sheet.style
    strip = GearStrip(sheet)
    is_lone = len(sheet.gears) == 1
    ends = thinned(sheet.order_ends, high * (ORDERS_PART if is_lone else 1.0))
    if is_lone:
        ends = thinned(_mode_ends(sheet), high - height_of(ends)) + ends
    right = width_of(ends) + MARGIN
    if not is_lone:
        right += BEFORE_STRIP + strip.wide
    wide = style.width - FREQUENCY_SCALE_WIDTH - right
    scales = AxisScale(sheet.slowest, sheet.fastest), AxisScale(0.0, sheet.top)
    panel = pen.panel((FREQUENCY_SCALE_WIDTH, low), (wide, high), *scales)
    draw_running(panel, sheet.running, style)
    _draw_scales(panel, sheet)
    _draw_lines(panel, sheet)
    beside(panel, "right", ends)
    cut = sheet.orders[len(sheet.order_ends) :]
    tops = [Label(panel.across(order.speed(sheet.top)), order.name, style.ink) for order in cut]
    along(panel, "top", tops, upright=False)
    for meeting in sorted(sheet.meetings, key=lambda meeting: meeting.mode.participation):
        _draw_meeting(panel, meeting, sheet)
    if not is_lone:
        at = FREQUENCY_SCALE_WIDTH + wide + width_of(ends) + BEFORE_STRIP
        strip.draw(pen.panel((at, low), (strip.across, high), y=scales[1]))


def _mode_ends(sheet: CampbellSheet) -> list[LineEnd]:
    """Return the names of the modes of a single gear, with arrows at modes above the scale."""
    ends = []
    for mode in sheet.modes:
        part = mode.frequency / sheet.top
        text = f"{mode.number}: {sheet.hertz(mode.frequency)}{' ↑' * (part > 1)}"
        ends.append(LineEnd(min(part, 1.0), (text,)))
    return ends


def _draw_scales(pen: Pen, sheet: CampbellSheet) -> None:
    (wide, high), style = pen.size, sheet.style
    speeds = ticks(sheet.slowest, sheet.fastest, max(2, int(wide / (width("10000") + 14))))
    hertz = ticks(0.0, sheet.top, max(2, int(high / (2.5 * height("")))))
    texts = [f"{frequency:g}" for frequency in hertz]
    pen.scale("bottom", speeds, [f"{speed:g}" for speed in speeds], grid=True)
    pen.scale("left", hertz, texts, grid=True)
    pen.frame()
    rpm = style.text("rpm")
    name = style.text("speed of {input}, {rpm}", input=sheet.input, rpm=rpm)
    if not sheet.input or width(name) >= wide:  # the inputs differ, or their name is long
        name = style.text("speed of the input, {rpm}", rpm=rpm)
    pen.name("bottom", name, 28)
    pen.name("left", style.text("frequency, Hz"), widest(texts) + 16)


def _draw_lines(pen: Pen, sheet: CampbellSheet) -> None:
    style, (wide, _) = sheet.style, pen.size
    for mode in sheet.shared:
        if mode.frequency <= sheet.top:
            y, names = pen.up(mode.frequency), json.dumps(mode.gears, ensure_ascii=False)
            group = pen.within("mode", mode=str(mode.number), gears=names)
            hint = style.text("mode {number}", number=mode.number)
            gears = gear_title(", ".join(mode.gears), style)
            hint = f"{hint}, {gears}: {sheet.hertz(mode.frequency)}"
            common = len(mode.modes) == len(sheet.gears)
            group.line((0.0, y), (wide, y), title=hint, **_mode_look(style, is_common=common))
    for order in sheet.orders:
        group = pen.within("order", order=f"{order.number:g}", firing=json.dumps(order.fires))
        last = min(sheet.fastest, order.speed(sheet.top))
        end = pen.across(last), pen.up(order.frequency(last))
        begin = 0.0, pen.up(order.frequency(sheet.slowest))
        group.line(begin, end, title=order.name, **order_look(order, style))


def _draw_meeting(pen: Pen, meeting: Meeting, sheet: CampbellSheet) -> None:
    style, mode, speed = sheet.style, meeting.mode, meeting.speed
    group = pen.within(
        "resonance",
        gear=mode.gear,
        mode=str(mode.number),
        order=f"{meeting.order.number:g}",
        rpm=f"{speed:.12g}",
        participation=f"{mode.participation:.12g}",
    )
    rpm, share = style.text("rpm"), style.text("participation")
    hint = style.text("mode {number}", number=mode.number)
    hint = (
        f"{gear_title(mode.gear, style)}, {hint}, {meeting.order.name}: {speed:.0f} {rpm}, "
        f"{sheet.hertz(mode.frequency)}, {share} {mode.participation:.2g}"
    )
    if mode.damping_ratio:
        hint = f"{hint}, {style.text('damping ratio')} {mode.damping_ratio:.3f}"
    at = pen.across(speed), pen.up(mode.frequency)
    group.line(at, title=hint, **dot_look(meeting, style))
