"""Load duration distributions over a duty cycle: revolutions of members by torque class."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, cast

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.head import Meaning, sheet_head
from vstatics.pictures.drawing.labels import LINE_HEIGHT, power_of_ten, ticks, widest, wrapped
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, SIZE, Style, number
from vstatics.pictures.drawing.words import title
from vstatics.vehicle.life.classes import LoadClass, MemberSpectrum

if TYPE_CHECKING:
    from vstatics.vehicle.duty_file import DutyTable

SPECTRUM_SIZE = (128.0, 80.0)
"""Least width and height of a panel without scales. [pt]"""
SPECTRUM_SCALE_WIDTH, SPECTRUM_SCALE_HEIGHT = 44.0, 32.0
"""Width and height of the scales of a panel. [pt]"""
NAME_ROOM = 2 * LINE_HEIGHT * SIZE + 4.0
"""Height of two lines above a panel: name of the member, and its time without torque. [pt]"""
MOST_SPECTRA = 60
"""Largest number of drawn members."""


class _Sheet(NamedTuple):
    """Members in a picture, with a common scale of revolutions."""

    spectra: Mapping[str, MemberSpectrum]
    revolutions: AxisScale
    are_shares: bool
    style: Style

    @property
    def names(self) -> tuple[str, str]:
        """Titles of the axes."""
        turns = "turns a second" if self.are_shares else "turns"
        return self.style.text("torque, N·m"), self.style.text(turns)


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Canvas]:
    """Draw a panel for each member that turns under torque, up to `MOST_SPECTRA`.

    Raises
    ------
    CaseError
        If no member turns under torque.
    ReadError
        If the duty cycle does not fit the case.
    """
    del gears  # the duty cycle determines the gears
    duty = cast("DutyTable", style.data).of(results)
    turning = {
        name: spectrum
        for name, spectrum in (duty.spectrum or {}).items()
        if any(each.revolutions > 0 for each in spectrum.classes)
    }
    spectra = dict(list(turning.items())[:MOST_SPECTRA])
    classes = [each for spectrum in spectra.values() for each in spectrum.classes]
    counts = [each.revolutions for each in classes if each.revolutions > 0]
    if not counts:
        raise CaseError("E425", "no member turns under torque, so there is nothing to draw")
    low, high = math.floor(math.log10(min(counts)) - 0.05), math.ceil(math.log10(max(counts)))
    scale = AxisScale(10.0**low, 10.0 ** max(high, low + 1), is_log=True)
    sheet = _Sheet(spectra, scale, duty.are_shares, style)
    columns = int((style.width - 2 * MARGIN) // (SPECTRUM_SIZE[0] + SPECTRUM_SCALE_WIDTH))
    high_pitch = SPECTRUM_SIZE[1] + NAME_ROOM + SPECTRUM_SCALE_HEIGHT
    pitch = (style.width - 2 * MARGIN) / columns, high_pitch
    text = title(results.case, style.text("load spectrum"))
    is_open = any(math.isnan(each.to) for each in classes)
    key: list[Meaning] = [(is_open, "above the last bound", _bar(style, is_open=True))]
    head = sheet_head(text, "", key, style.width - 2 * MARGIN, style)
    names = list(spectra)
    rows = [names[start : start + columns] for start in range(0, len(names), columns)]
    room = (style.height - head.high - 2 * MARGIN) / pitch[1]
    on_page = len(rows) if math.isinf(room) else max(1, int(room))
    pages = []
    for start in range(0, len(rows), on_page):
        page = rows[start : start + on_page]
        pen = head.over((style.width, len(page) * pitch[1] + MARGIN), MARGIN, style)
        for row, members in enumerate(page):
            low_edge = MARGIN + (len(page) - 1 - row) * pitch[1] + SPECTRUM_SCALE_HEIGHT
            for column, name in enumerate(members):
                corner = MARGIN + column * pitch[0] + SPECTRUM_SCALE_WIDTH, low_edge
                size = pitch[0] - SPECTRUM_SCALE_WIDTH - SIZE, SPECTRUM_SIZE[1]
                _draw_member(pen.panel(corner, size), name, sheet)
        pages.append(pen.canvas)
    return pages


def _bar(style: Style, *, is_open: bool) -> Look:
    look: Look = {"facecolor": style.power, "edgecolor": style.ink, "width": 0.5}
    return look | ({"hatch": "////"} if is_open else {})


def _ends(each: LoadClass, classes: Sequence[LoadClass]) -> tuple[float, float]:
    """Return both bounds of a bar [N*m]; without upper bound it is as wide as the bar before."""
    if not math.isnan(each.to):
        return each.from_, each.to
    wide = next(
        (other.to - other.from_ for other in classes if other.to == each.from_), each.from_ or 1.0
    )
    return each.from_, each.from_ + wide


def _draw_member(pen: Pen, name: str, sheet: _Sheet) -> None:
    spectrum, style = sheet.spectra[name], sheet.style
    bars = [(each, _ends(each, spectrum.classes)) for each in spectrum.classes]
    edges = [0.0, *(end for _, ends in bars for end in ends)]
    pen = pen._replace(x=AxisScale(min(edges), max(edges)), y=sheet.revolutions)
    panel = pen.within("panel", name=name, idle_time=f"{spectrum.idle.time:.9g}")
    decades = range(
        round(math.log10(pen.y.low)),
        round(math.log10(pen.y.high)) + 1,
        max(1, round(math.log10(pen.y.high / pen.y.low) / 4)),
    )
    panel.scale("left", [10.0**n for n in decades], [power_of_ten(n) for n in decades], grid=True)
    across = ticks(pen.x.low, pen.x.high, 4)
    while len(across) > 2 and widest(tick_texts(across)) + SIZE > pen.size[0] / len(across):
        across = across[::2]
    panel.scale("bottom", across)
    for each, ends in bars:
        if each.revolutions > 0:
            _draw_bar(panel, each, ends)
    panel.frame("left", "bottom")
    if pen.x.low < 0:
        zero = pen.across(0.0)
        panel.line((zero, 0.0), (zero, pen.size[1]), color=style.ink, width=0.6)
    x, y = sheet.names
    panel.name("bottom", x, 22.0)
    panel.name("left", y, SPECTRUM_SCALE_WIDTH - SIZE)
    texts = wrapped(name, pen.size[0]).split("\n")[0]
    panel.text(0.0, pen.size[1] + LINE_HEIGHT * SIZE + 2, texts, va="bottom", bold=True)
    idle = number(100 * spectrum.idle.time / _duration(spectrum))
    words = style.text("without torque {share} % of the time", share=idle)
    panel.text(0.0, pen.size[1] + 2, words * (spectrum.idle.time > 0), va="bottom")


def _duration(spectrum: MemberSpectrum) -> float:
    return spectrum.idle.time + sum(each.time for each in spectrum.classes)


def _draw_bar(panel: Pen, each: LoadClass, ends: tuple[float, float]) -> None:
    fields = {"from": each.from_, "to": each.to, "revolutions": each.revolutions}
    fields |= {"contacts": each.contacts, "time": each.time, "speed": each.speed}
    data = {key: f"{value:.9g}" if math.isfinite(value) else "" for key, value in fields.items()}
    left, right = sorted(map(panel.across, ends))
    look = _bar(panel.style, is_open=math.isnan(each.to))
    to = "" if math.isnan(each.to) else number(each.to)
    words = f"{number(each.from_)} … {to}: {number(each.revolutions)}"
    group = panel.within("class", **data)
    group.box((left, 0.0), (right - left, panel.up(each.revolutions)), title=words, **look)
