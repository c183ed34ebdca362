"""Forward gears on a logarithmic line of ratios, compared with geometric and progressive steps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.core.summary.design_table import Design, design
from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.ends import along
from vstatics.pictures.drawing.head import headed
from vstatics.pictures.drawing.labels import LEADER, LINE_HEIGHT, Label, across_size, widest, width
from vstatics.pictures.drawing.line_styles import mixed
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import FRAME_WIDTH, MARGIN, SIZE, Style, number
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.vehicle.pictures.laws import StepLaw, geometric, progressive

STEP_ROW_HEIGHT = 24.0
"""Height of a row of cells. [pt]"""
BETWEEN_LAWS = 8.0
"""Distance between the rows of successive laws. [pt]"""
UPRIGHT_IN_CELL: Look = {"rotation": 90, "ha": "center", "va": "center"}


class ForwardGears(NamedTuple):
    """Forward gears of a case, in descending order of ratio."""

    names: Sequence[str]
    ratios: Sequence[float]
    """Magnitudes of ratios. [-]"""
    sign: float
    """Sign of all ratios: -1 if a final drive reverses the direction."""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Canvas]:
    """Draw the steps between all forward gears, or between the selected gears.

    Parameters
    ----------
    alike : sequence of Results
        Other cases, for which the scale of ratios must be the same.

    Raises
    ------
    CaseError
        If the forward gears have fewer than two ratios.
    """
    forward = _forward(results, gears)
    every = [forward, *(_forward(other, gears) for other in alike)]
    line = AxisScale(
        max(case.ratios[0] for case in every), min(case.ratios[-1] for case in every), is_log=True
    )
    laws = _laws(forward, style)
    names = [style.text("gears"), *(name for name, _ in laws)]
    left = MARGIN + widest(names) + SIZE + MARGIN
    wide = style.width - left - 2 * MARGIN
    is_stacked = _narrowest(every) * wide < SIZE  # too narrow even for upright text
    if is_stacked:
        left, wide = 2 * MARGIN, style.width - 4 * MARGIN
    between = BETWEEN_LAWS + is_stacked * LINE_HEIGHT * SIZE
    numbers = [number(forward.sign * ratio) for ratio in forward.ratios]
    upright = sum(map(across_size, numbers)) > wide + 2 * MARGIN
    ends = LEADER + (widest(numbers) + SIZE / 2 if upright else LINE_HEIGHT * SIZE)
    low = MARGIN + len(laws) * (STEP_ROW_HEIGHT + between) + ends
    name_of_picture = style.text("steps between gears")
    spread = style.text("spread")
    note = f"{spread} {number(forward.ratios[0] / forward.ratios[-1])}"
    high = low + STEP_ROW_HEIGHT + LEADER + LINE_HEIGHT * SIZE
    pen = headed(title(results.case, name_of_picture), note, [], (style.width, high), style)
    row = pen.panel((left, low), (wide, STEP_ROW_HEIGHT), line)
    _draw_gears(row, forward, numbers, upright=upright)
    if not is_stacked:  # otherwise gear names are above the scale
        _name_row(row, names[0])
    for place, (name, law) in enumerate(laws, 1):
        below = low - ends - place * STEP_ROW_HEIGHT - (place - 1 + is_stacked) * between
        row = pen.panel((left, below), (wide, STEP_ROW_HEIGHT), line)
        _draw_law(row, law)
        _name_row(row, name, is_stacked=is_stacked)
    return [pen.canvas]


def _narrowest(every: Sequence[ForwardGears]) -> float:
    """Return the width of the narrowest cell (a gear step), relative to the scale of all ratios.

    >>> round(_narrowest([ForwardGears("123", [4.0, 2.0, 1.0], 1.0)]), 3)
    0.5
    """
    spread = max(case.ratios[0] for case in every) / min(case.ratios[-1] for case in every)
    steps = [high / low for case in every for high, low in pairwise(case.ratios)]
    return math.log(min(step for step in steps if step > 1)) / math.log(spread)


def _forward(results: Results, shown: Sequence[int]) -> ForwardGears:
    table: Design = design(results)
    asked = {results.case.gears[number - 1].name for number in shown} or {*table.forward}
    lines = {line.gear: line for line in table.gears}
    chosen = [lines[name] for name in table.forward if name in asked]
    if len({f"{line.ratio:.9g}" for line in chosen}) < 2:
        message = "the picture needs at least two forward gears with different ratios"
        raise CaseError("E444", message)
    return ForwardGears(
        [line.gear for line in chosen],
        [abs(line.ratio) for line in chosen],
        math.copysign(1.0, chosen[0].ratio),
    )


def _laws(forward: ForwardGears, style: Style) -> list[tuple[str, StepLaw]]:
    """Return names and laws of steps; progressive steps need at least three gears."""
    equal, growing = geometric(forward.ratios), progressive(forward.ratios)
    geometric_name = style.text("geometric")
    laws = [(f"{geometric_name} {number(equal.steps[0])}", equal)]
    if len(forward.names) > 2:
        name = style.text("progressive")
        laws.append((f"{name} ×{number(growing.growth)}", growing))
    return laws


def _draw_gears(pen: Pen, forward: ForwardGears, numbers: Sequence[str], *, upright: bool) -> None:
    """Draw a cell from each gear to the next, with gear names above and ratios below.

    Parameters
    ----------
    numbers : sequence of str
        Texts of the ratios, with sign.
    """
    style = pen.style
    following = [*forward.ratios[1:], None]
    rows = zip(forward.names, forward.ratios, numbers, following, strict=True)
    for name, ratio, text, following_ratio in rows:
        data = {"gear": name, "ratio": f"{forward.sign * ratio:.9g}"}
        cell_title = f"{gear_title(name, style)}: {text}"
        if following_ratio:
            data["step"] = f"{ratio / following_ratio:.9g}"
            cell_title += f", {style.text('step')} {number(ratio / following_ratio)}"
        cell = pen.within("step", **data)
        x = pen.across(ratio)
        if following_ratio:
            face = mixed(style.power, style.paper, 0.45)
            wide = pen.across(following_ratio) - x
            cell.box((x, 0.0), (wide, pen.size[1]), facecolor=face, title=cell_title)
            _name_cell(cell, x, wide, ratio / following_ratio)
        cell.line((x, 0.0), (x, pen.size[1]), color=style.ink, width=FRAME_WIDTH, title=cell_title)
    _draw_edges(pen, pen.across(forward.ratios[0]), pen.across(forward.ratios[-1]), style.ink)
    left, low = pen.corner
    beyond = pen.panel((left - MARGIN, low), (pen.size[0] + 2 * MARGIN, pen.size[1]))
    places = [MARGIN + pen.across(ratio) for ratio in forward.ratios]
    names, ratios = (
        [Label(x, text, style.ink) for x, text in zip(places, texts, strict=True)]
        for texts in (forward.names, numbers)
    )
    along(beyond, "top", names, upright=False)
    along(beyond, "bottom", ratios, upright=upright)


def _draw_law(pen: Pen, law: StepLaw) -> None:
    style = pen.style
    marks = [pen.across(ratio) for ratio in law.ratios]
    for (left, right), step in zip(pairwise(marks), law.steps, strict=True):
        _name_cell(pen, left, right - left, step)
    sides = [((x, 0.0), (x, pen.size[1])) for x in marks]
    pen.lines(sides, color=style.ink, width=FRAME_WIDTH)
    _draw_edges(pen, marks[0], marks[-1], style.faint)


def _draw_edges(pen: Pen, left: float, right: float, colour: str) -> None:
    edges = [((left, y), (right, y)) for y in (0.0, pen.size[1])]
    pen.lines(edges, color=colour, width=FRAME_WIDTH)


def _name_cell(pen: Pen, left: float, wide: float, step: float) -> None:
    text = number(step)
    look: Look = {"ha": "center", "va": "center_baseline"}
    if width(text) > wide - 2:
        look = UPRIGHT_IN_CELL
    pen.text(left + wide / 2, pen.size[1] / 2, text, **look)


def _name_row(pen: Pen, name: str, *, is_stacked: bool = False) -> None:
    if is_stacked:
        pen.text(0.0, pen.size[1] + 2, name, va="bottom")
        return
    pen.text(-SIZE - MARGIN, pen.size[1] / 2, name, ha="right", va="center_baseline")
