"""Picture of the largest torques after a clutch dump in each gear, with breakaway limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.errors import CaseError, listed
from vstatics.core.extras import require
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.head import Meaning, headed
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, ticks, widest, wrapped
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import LONG_NAME, MARGIN, Style, number
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.torsion.pictures.shown_modes import gear_names

if TYPE_CHECKING:
    from vstatics.torsion.clutch.dumped import DumpCase, DumpTorque
    from vstatics.torsion.clutch.gear_dump import GearDump

_WORDS: Mapping[DumpCase, str] = {
    "A1": "the clutch slips, the wheels are clamped",
    "A2": "the clutch slips, the wheels roll",
    "A3": "the clutch slips, then the tyres",
    "B1": "the clutch grabs, the wheels are clamped",
    "B2": "the clutch grabs, the wheels roll",
    "B3": "the clutch grabs, the tyres slip",
    "V1": "the clutch grabs and breaks away",
    "V2": "the clutch breaks away, then the tyres",
    "V3": "the tyres break away, then the clutch",
}
"""Events in each case of a dump, as printed in the row of a gear."""
DUMP_ROW, BAR_HEIGHT, THIN_BAR_HEIGHT = 35.0, 9.0, 4.0
"""Height of the row of a gear, and of its two bars. [pt]"""
TORQUE_SCALE_HEIGHT = 42.0
"""Height of the scale of torques. [pt]"""
WORDS_WIDTH = 140.0
"""Width of the text about the events of a dump. [pt]"""
FARTHEST_LIMIT = 1.6
"""Largest breakaway limit that is drawn, divided by the largest torque of all bars."""
LIMIT_OVER = 3.0
"""Length by which the mark of a limit extends beyond the bar, above and below. [pt]"""


class _Limits(NamedTuple):
    """Line styles of the marks of breakaway limits and of the torque by the simplified formula."""

    slips: Look
    clutch: Look
    tyres: Look
    simplified: Look

    @staticmethod
    def of(style: Style) -> _Limits:
        """Return the line styles in the colours of a style."""
        return _Limits(
            {"color": style.ink, "width": 1.2, "linestyle": (0, (2, 1.5))},
            {"color": style.engaged, "width": 1.8},
            {"color": style.lost, "width": 1.8, "linestyle": (0, (5, 1.5))},
            {"color": style.ink, "marker": "D", "markersize": 3.2, "markerfacecolor": style.paper},
        )


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Canvas]:
    """Draw the largest torques in all gears of a case, or in given gears, on pages.

    Raises
    ------
    CaseError
        If scipy is not installed, the case has no `dump`, or no gear has such a torque.
    """
    require("torsion", "a picture of a clutch that is dumped")
    from vstatics.torsion.clutch.gear_dump import gear_dumps

    dumps = gear_dumps(results.case, gear_names(results.case, gears) or None)
    if not any(dump.made for dump in dumps):
        names = listed([dump.name for dump in dumps])
        raise CaseError("E742", f"no torque of a clutch dump in gear {names}: {dumps[0].error}")
    on_page = len(dumps)
    if math.isfinite(style.height):
        on_page = max(1, int((style.height - 90.0 - TORQUE_SCALE_HEIGHT) / DUMP_ROW))
    scale = AxisScale(0.0, 1.04 * max(_shown_torques(dumps)))
    starts = range(0, len(dumps), on_page)
    return [_figure(results, dumps[n : n + on_page], scale, style) for n in starts]


def _shown_torques(dumps: Sequence[GearDump]) -> Iterator[float]:
    results = [dump.made for dump in dumps if dump.made]
    largest = max(max(result.max_torque, result.max_torque_simplified) for result in results)
    yield largest
    for result in results:
        for limit in (result.clutch_breaks_at, result.tyres_break_at):
            if limit <= FARTHEST_LIMIT * largest:
                yield limit


def _figure(results: Results, dumps: Sequence[GearDump], scale: AxisScale, style: Style) -> Canvas:
    names = [wrapped(gear_title(dump.name, style), LONG_NAME) for dump in dumps]
    left = MARGIN + widest(names) + 8.0
    wide = style.width - left - WORDS_WIDTH - 2 * MARGIN
    high = DUMP_ROW * len(dumps)
    link = dumps[0].to
    subject = style.text("clutch dumped, torques on {link}", link=link)
    size = style.width, high + TORQUE_SCALE_HEIGHT
    pen = headed(title(results.case, subject), "", _signs(dumps, scale, style), size, style)
    panel = pen.panel((left, TORQUE_SCALE_HEIGHT), (wide, high), scale)
    torques = ticks(0.0, scale.high, max(2, int(wide / 44.0)))
    panel.scale("bottom", torques, grid=True)
    panel.frame("left", "bottom")
    panel.name("bottom", style.text("torque, N·m"), 12.0 + 1.5 * height(""))
    for place, (dump, name) in enumerate(zip(dumps, names, strict=True)):
        middle = high - (place + 0.5) * DUMP_ROW
        look: Look = {"va": "center", "linespacing": LINE_HEIGHT}
        panel.text(-8.0, middle, name, ha="right", **look)
        group = panel.within("dump", gear=dump.name)
        if dump.made is None:
            group.text(4.0, middle, wrapped(dump.error, wide - 8.0), **look)
            continue
        _draw_gear(group, middle, dump.made)
        largest = f"{number(dump.made.max_torque)} {style.text('N·m')}"
        happens = f"{dump.made.case}: {style.text(_WORDS[dump.made.case])}"
        words = f"{largest}\n{wrapped(happens, WORDS_WIDTH)}"
        panel.text(wide + MARGIN, middle, words, **look)
    return pen.canvas


def _signs(dumps: Sequence[GearDump], scale: AxisScale, style: Style) -> list[Meaning]:
    looks, results = _Limits.of(style), [dump.made for dump in dumps if dump.made]
    clutch = any(result.clutch_breaks_at <= scale.high for result in results)
    tyres = any(result.tyres_break_at <= scale.high for result in results)
    most, least = _bars(style)
    return [
        (True, "largest torque", most),
        (True, "between disc and gearbox", least),
        (True, "of the clutch that slips", looks.slips),
        (clutch, "the stuck clutch breaks away", looks.clutch),
        (tyres, "the tyres break away", looks.tyres),
        (True, "first approximation", looks.simplified),
    ]


def _bars(style: Style) -> tuple[Look, Look]:
    return {"facecolor": style.power}, {"facecolor": style.faint}


def _draw_gear(pen: Pen, middle: float, result: DumpTorque) -> None:
    style, looks = pen.style, _Limits.of(pen.style)
    (most, least), unit = _bars(style), style.text("N·m")
    low = middle - BAR_HEIGHT / 2 + 2.0
    reach = pen.across(result.max_torque)
    factor = style.text("dynamic factor")
    largest = f"{number(result.max_torque)} {unit}, {factor} {number(result.dynamic_factor)}"
    pen.box((0.0, low), (reach, BAR_HEIGHT), title=largest, **most)
    input_shaft = f"{number(result.input_shaft_torque)} {unit}"
    at_disc = pen.across(result.input_shaft_torque), THIN_BAR_HEIGHT
    pen.box((0.0, low - THIN_BAR_HEIGHT - 1.0), at_disc, title=input_shaft, **least)
    slips = result.max_torque / result.dynamic_factor
    for torque, look in (
        (slips, looks.slips),
        (result.clutch_breaks_at, looks.clutch),
        (result.tyres_break_at, looks.tyres),
    ):
        if torque <= pen.x.high:
            ends = (low - LIMIT_OVER, low + BAR_HEIGHT + LIMIT_OVER)
            x = pen.across(torque)
            pen.line(*((x, y) for y in ends), title=f"{number(torque)} {unit}", **look)
    at = pen.across(result.max_torque_simplified), low + BAR_HEIGHT / 2
    pen.line(
        at, title=f"{number(result.max_torque_simplified)} {unit}", zorder=4, **looks.simplified
    )
