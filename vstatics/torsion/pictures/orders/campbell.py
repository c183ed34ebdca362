"""The Campbell diagram: natural frequencies of gears over the speed of the input, and its orders.

All gears are in one panel, linear in both scales, up to where the highest order ends. Beside it
stand the frequencies gear by gear, below it the table of resonances.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence

from matplotlib.figure import Figure

from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.ends import LineEnd, beside, height_of, width_of
from vstatics.pictures.drawing.head import Meaning, sheet_head
from vstatics.pictures.drawing.labels import height, ticks, widest, width
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import MARGIN, Style
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.torsion.pictures.orders.campbell_sheet import (
    CampbellSheet,
    campbell_sheet,
    order_look,
)
from vstatics.torsion.pictures.orders.dots import dot_look, dot_signs
from vstatics.torsion.pictures.orders.excited import Order
from vstatics.torsion.pictures.orders.gear_strip import GearStrip
from vstatics.torsion.pictures.orders.resonance_table import TableParts, resonance_tables
from vstatics.torsion.pictures.orders.resonances import Meeting
from vstatics.torsion.pictures.orders.running import draw_running, running_sign

PANEL_HEIGHT = 250.0
"""Of the panel, where nothing else decides. [pt]"""
TALLEST_PANEL = 340.0
"""Of the panel, on a page with room. [pt]"""
FREQUENCY_SCALE_WIDTH, SPEED_SCALE_HEIGHT = 52.0, 46.0
"""For the scales. [pt]"""
ORDERS_PART = 0.6
"""Of the right edge, at most, that names of orders take beside those of modes."""
ABOVE_PANEL = 16.0
"""For what the strip of gears is. [pt]"""
BEFORE_STRIP = 6.0
"""Between names of orders and the gears. [pt]"""


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """Draw the diagram of all gears of a case, or of some, on pages.

    Raises
    ------
    CaseError
        If scipy is not installed, or no gear has a natural frequency.
    """
    sheet = campbell_sheet(results, style, gears)
    return list(_pages(sheet))


def _mode_look(style: Style, *, is_common: bool) -> Look:
    """Of a natural frequency: ink, as links alone have colours."""
    return {"color": style.ink, "width": 1.3 if is_common else 0.5}


def _signs(sheet: CampbellSheet) -> list[Meaning]:
    style, several = sheet.style, len(sheet.gears) > 1
    common = any(len(one.modes) == len(sheet.gears) for one in sheet.shared)
    alone = any(len(one.modes) < len(sheet.gears) for one in sheet.shared)
    of_all = "natural frequency of all gears"
    if not several:
        of_all = "natural frequency"
    fires, others = (any(one.fires is so for one in sheet.orders) for so in (True, False))
    plain, firing = (order_look(Order(1.0, so), style) for so in (False, True))
    return [
        (common, of_all, _mode_look(style, is_common=True)),
        (alone, "of some gears", _mode_look(style, is_common=False)),
        (others, "order n×", plain),
        (fires, "order that fires", firing),
        *running_sign(sheet.running, style),
        *dot_signs(sheet.meetings, style),
    ]


def _pages(sheet: CampbellSheet) -> Iterator[Figure]:
    """The panel with as much of the tables as fits, then the rest."""
    style, across = sheet.style, sheet.style.width
    text, room = _title(sheet), across - 2 * MARGIN
    tables = resonance_tables(
        sheet.modes, sheet.orders, (sheet.running, sheet.fastest, sheet.slowest), room, style
    )
    left = TableParts([(one, one.rows) for one in tables])
    head = sheet_head(text, sheet.note, _signs(sheet), room, style)
    around = ABOVE_PANEL + SPEED_SCALE_HEIGHT
    high = max(PANEL_HEIGHT, height_of(sheet.order_ends))
    free = style.height - head.high - MARGIN - around
    if math.isfinite(free):
        high = max(high, free - left.high)
    high = min(high, TALLEST_PANEL)
    first, left = left.fitting(free - high)
    pen = head.over((across, first.high + around + high), MARGIN, style)
    _draw_panel(pen, sheet, (first.high + SPEED_SCALE_HEIGHT, high))
    first.draw(pen)
    yield pen.figure
    head = sheet_head(text, "", [], room, style)
    while left.parts:
        page, left = left.fitting(style.height - head.high - MARGIN, least=1)
        pen = head.over((across, page.high), MARGIN, style)
        page.draw(pen)
        yield pen.figure


def _title(sheet: CampbellSheet) -> str:
    subject = sheet.style.text("Campbell diagram")
    return title(sheet.case, subject)


def _draw_panel(pen: Pen, sheet: CampbellSheet, place: tuple[float, float]) -> None:
    """The diagram and the strip of gears, from an ordinate up, of a height [pt]."""
    (low, high), style = place, sheet.style
    strip = GearStrip(sheet.gears, sheet.modes, sheet.top, style)
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
    for met in sorted(sheet.meetings, key=lambda one: one.mode.participation):
        _draw_meeting(panel, met, sheet)
    if not is_lone:
        at = FREQUENCY_SCALE_WIDTH + wide + width_of(ends) + BEFORE_STRIP
        strip.draw(pen.panel((at, low), (strip.across, high), y=scales[1]))


def _mode_ends(sheet: CampbellSheet) -> list[LineEnd]:
    """The names of the modes of one gear, an arrow at those above."""
    found = []
    for one in sheet.modes:
        above = " ↑" if one.frequency > sheet.top else ""
        part = min(one.frequency / sheet.top, 1.0)
        found.append(LineEnd(part, (f"{one.number}: {sheet.hertz(one.frequency)}{above}",)))
    return found


def thinned(ends: Sequence[LineEnd], room: float) -> list[LineEnd]:
    """As many names as there is room for [pt], evenly chosen.

    >>> some = [LineEnd(0.1 * n, (str(n),)) for n in range(9)]
    >>> [end.names[0] for end in thinned(some, 60.0)]
    ['0', '2', '4', '6', '8']
    """
    every = max(1, math.ceil(height_of(ends) / max(room, ends[0].high))) if ends else 1
    return list(ends[::every])


def _draw_scales(pen: Pen, sheet: CampbellSheet) -> None:
    (wide, high), style = pen.size, sheet.style
    speeds = ticks(sheet.slowest, sheet.fastest, max(2, int(wide / (width("10000") + 14))))
    hertz = ticks(0.0, sheet.top, max(2, int(high / (2.5 * height("")))))
    texts = [f"{one:g}" for one in hertz]
    pen.scale("bottom", speeds, [f"{one:g}" for one in speeds], grid=True)
    pen.scale("left", hertz, texts, grid=True)
    pen.frame()
    rpm = style.text("rpm")
    said = style.text("speed of {input}, {rpm}", input=sheet.input, rpm=rpm)
    if not sheet.input or width(said) >= wide:  # a link with a long name is the input
        said = style.text("speed of the input, {rpm}", rpm=rpm)
    pen.name("bottom", said, 28)
    pen.name("left", style.text("frequency, Hz"), widest(texts) + 16)


def _draw_lines(pen: Pen, sheet: CampbellSheet) -> None:
    """Modes, and orders over them."""
    style, (wide, _) = sheet.style, pen.size
    for mode in sheet.shared:
        if mode.frequency <= sheet.top:
            y, names = pen.up(mode.frequency), json.dumps(mode.gears, ensure_ascii=False)
            own = pen.within("mode", mode=str(mode.number), gears=names)
            said = style.text("mode {number}", number=mode.number)
            which = ", ".join(mode.gears)
            said = f"{said}, {gear_title(which, style)}: {sheet.hertz(mode.frequency)}"
            common = len(mode.modes) == len(sheet.gears)
            own.line((0.0, y), (wide, y), title=said, **_mode_look(style, is_common=common))
    for order in sheet.orders:
        own = pen.within("order", order=f"{order.number:g}", firing=json.dumps(order.fires))
        end = wide, pen.up(order.frequency(sheet.fastest))
        begin = 0.0, pen.up(order.frequency(sheet.slowest))
        own.line(begin, end, title=order.name, **order_look(order, style))


def _draw_meeting(pen: Pen, met: Meeting, sheet: CampbellSheet) -> None:
    """The dot of a resonance."""
    style, mode, speed = sheet.style, met.mode, met.speed
    own = pen.within(
        "resonance",
        gear=mode.gear,
        mode=str(mode.number),
        order=f"{met.order.number:g}",
        rpm=f"{speed:.12g}",
        participation=f"{mode.participation:.12g}",
    )
    rpm, share = style.text("rpm"), style.text("participation")
    said = style.text("mode {number}", number=mode.number)
    said = f"{gear_title(mode.gear, style)}, {said}, {met.order.name}: {speed:.0f} {rpm}"
    said = f"{said}, {sheet.hertz(mode.frequency)}, {share} {mode.participation:.2g}"
    if mode.damping_ratio:
        said = f"{said}, {style.text('damping ratio')} {mode.damping_ratio:.3f}"
    at = pen.across(speed), pen.up(mode.frequency)
    own.line(at, title=said, **dot_look(met, style))
