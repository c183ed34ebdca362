"""The largest torques when the clutch is dumped, gear by gear, beside what breaks away."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from matplotlib.figure import Figure

from vstatics.core.errors import CaseError, listed
from vstatics.core.extras import require
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.head import Meaning, headed
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, ticks, widest, wrapped
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import LONG_NAME, MARGIN, Style, number
from vstatics.pictures.drawing.words import gear_title, title

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
"""What happens in the cases of the source."""
DUMP_ROW, BAR_HEIGHT, THIN_BAR_HEIGHT = 35.0, 9.0, 4.0
"""Of a gear; its bars. [pt]"""
TORQUE_SCALE_HEIGHT = 42.0
"""For the scale. [pt]"""
WORDS_WIDTH = 140.0
"""What happens is wrapped to it. [pt]"""
FARTHEST_LIMIT = 1.6
"""Torques at which something breaks away are shown up to this times the largest torque."""
LIMIT_OVER = 3.0
"""By so much the mark of a limit is higher than its bar, on both sides. [pt]"""


class _Limits(NamedTuple):
    """The looks of what is marked beside the bars."""

    slips: Look
    clutch: Look
    tyres: Look
    simplified: Look

    @staticmethod
    def of(style: Style) -> _Limits:
        """In the colours of a style."""
        return _Limits(
            {"color": style.ink, "width": 1.2, "linestyle": (0, (2, 1.5))},
            {"color": style.engaged, "width": 1.8},
            {"color": style.lost, "width": 1.8, "linestyle": (0, (5, 1.5))},
            {"color": style.ink, "marker": "D", "markersize": 3.2, "markerfacecolor": style.paper},
        )


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """Draw the largest torques in all gears of a case, or in some, on pages.

    Raises
    ------
    CaseError
        If scipy is not installed, the case has no `dump`, or no gear has such a torque.
    """
    require("torsion", "a picture of a clutch that is dumped")
    from vstatics.torsion.clutch.gear_dump import gear_dumps

    found = gear_dumps(results.case, list(gears) or None)
    if not any(one.made for one in found):
        names = listed([one.name for one in found])
        raise CaseError("E742", f"no torque of a dumped clutch in gear {names}: {found[0].error}")
    on_page = len(found)
    if math.isfinite(style.height):
        on_page = max(1, int((style.height - 90.0 - TORQUE_SCALE_HEIGHT) / DUMP_ROW))
    scale = AxisScale(0.0, 1.04 * max(_shown(found)))
    starts = range(0, len(found), on_page)
    return [_figure(results, found[n : n + on_page], scale, style) for n in starts]


def _shown(found: Sequence[GearDump]) -> Iterator[float]:
    """Torques that the scale has to hold [N*m]."""
    made = [one.made for one in found if one.made]
    largest = max(max(one.max_torque, one.max_torque_simplified) for one in made)
    yield largest
    for one in made:
        for limit in (one.clutch_breaks_at, one.tyres_break_at):
            if limit <= FARTHEST_LIMIT * largest:
                yield limit


def _figure(results: Results, found: Sequence[GearDump], scale: AxisScale, style: Style) -> Figure:
    """Gears below one another over a scale of torque."""
    names = [wrapped(gear_title(one.name, style), LONG_NAME) for one in found]
    left = MARGIN + widest(names) + 8.0
    wide = style.width - left - WORDS_WIDTH - 2 * MARGIN
    high = DUMP_ROW * len(found)
    link = found[0].to
    subject = style.text("clutch dumped, torques on {link}", link=link)
    size = style.width, high + TORQUE_SCALE_HEIGHT
    pen = headed(title(results.case, subject), "", _signs(found, scale, style), size, style)
    panel = pen.panel((left, TORQUE_SCALE_HEIGHT), (wide, high), scale)
    torques = ticks(0.0, scale.high, max(2, int(wide / 44.0)))
    panel.scale("bottom", torques, grid=True)
    panel.frame("left", "bottom")
    panel.name("bottom", style.text("torque, N·m"), 12.0 + 1.5 * height(""))
    for place, (one, name) in enumerate(zip(found, names, strict=True)):
        middle = high - (place + 0.5) * DUMP_ROW
        look: Look = {"va": "center", "linespacing": LINE_HEIGHT}
        panel.text(-8.0, middle, name, ha="right", **look)
        own = panel.within("dump", gear=one.name)
        if one.made is None:
            own.text(4.0, middle, wrapped(one.error, wide - 8.0), **look)
            continue
        _draw_gear(own, middle, one.made)
        largest = f"{number(one.made.max_torque)} {style.text('N·m')}"
        happens = f"{one.made.case}: {style.text(_WORDS[one.made.case])}"
        said = f"{largest}\n{wrapped(happens, WORDS_WIDTH)}"
        panel.text(wide + MARGIN, middle, said, **look)
    return pen.figure


def _signs(found: Sequence[GearDump], scale: AxisScale, style: Style) -> list[Meaning]:
    looks, made = _Limits.of(style), [one.made for one in found if one.made]
    clutch = any(one.clutch_breaks_at <= scale.high for one in made)
    tyres = any(one.tyres_break_at <= scale.high for one in made)
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
    """Of the largest torque, and of that at the input shaft."""
    return {"facecolor": style.power}, {"facecolor": style.faint}


def _draw_gear(pen: Pen, middle: float, made: DumpTorque) -> None:
    """The bars of a gear about an ordinate [pt], with its limits."""
    style, looks = pen.style, _Limits.of(pen.style)
    (most, least), unit = _bars(style), style.text("N·m")
    low = middle - BAR_HEIGHT / 2 + 2.0
    reach = pen.across(made.max_torque)
    factor = style.text("dynamic factor")
    largest = f"{number(made.max_torque)} {unit}, {factor} {number(made.dynamic_factor)}"
    pen.box((0.0, low), (reach, BAR_HEIGHT), title=largest, **most)
    behind = f"{number(made.input_shaft_torque)} {unit}"
    at_disc = pen.across(made.input_shaft_torque), THIN_BAR_HEIGHT
    pen.box((0.0, low - THIN_BAR_HEIGHT - 1.0), at_disc, title=behind, **least)
    slips = made.max_torque / made.dynamic_factor
    for torque, look, lowest in (
        (slips, looks.slips, low),
        (made.clutch_breaks_at, looks.clutch, low),
        (made.tyres_break_at, looks.tyres, low),
    ):
        if torque <= pen.x.high:
            ends = (lowest - LIMIT_OVER, lowest + BAR_HEIGHT + LIMIT_OVER)
            x = pen.across(torque)
            pen.line(*((x, y) for y in ends), title=f"{number(torque)} {unit}", **look)
    at = pen.across(made.max_torque_simplified), low + BAR_HEIGHT / 2
    pen.line(at, title=f"{number(made.max_torque_simplified)} {unit}", zorder=4, **looks.simplified)
