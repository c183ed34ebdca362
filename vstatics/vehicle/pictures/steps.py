"""Forward gears on a logarithmic line of ratios, against geometric and progressive steps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.core.summary.design_table import Design, design
from vstatics.pictures.drawing.ends import along
from vstatics.pictures.drawing.head import headed
from vstatics.pictures.drawing.labels import LEADER, LINE_HEIGHT, Label, across_size, widest, width
from vstatics.pictures.drawing.line_styles import Look, mixed
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import FRAME_WIDTH, MARGIN, SIZE, Style, number
from vstatics.pictures.drawing.words import gear_title, title
from vstatics.vehicle.pictures.laws import StepLaw, geometric, progressive

STEP_ROW_HEIGHT = 24.0
"""[pt]"""
BETWEEN_LAWS = 8.0
"""Rows of laws. [pt]"""
UPRIGHT_IN_CELL: Look = {"rotation": 90, "ha": "center", "va": "center"}


class ForwardGears(NamedTuple):
    """The gears of a case with steps between them, from the largest ratio on."""

    names: Sequence[str]
    ratios: Sequence[float]
    """Without sign. [-]"""
    sign: float
    """Of all ratios: 1, or -1 where a final drive turns it."""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), alike: Sequence[Results] = ()
) -> list[Figure]:
    """Draw the steps between all forward gears, or those of some.

    Parameters
    ----------
    alike : sequence of Results
        Of further cases, with which the line of ratios is common.

    Raises
    ------
    CaseError
        If the forward gears have fewer than two ratios.
    """
    own = _forward(results, gears)
    every = [own, *(_forward(one, gears) for one in alike)]
    line = AxisScale(
        max(one.ratios[0] for one in every), min(one.ratios[-1] for one in every), is_log=True
    )
    laws = _laws(own, style)
    names = [style.text("gears"), *(name for name, _ in laws)]
    left = MARGIN + widest(names) + SIZE + MARGIN
    wide = style.width - left - 2 * MARGIN
    is_stacked = _narrowest(every) * wide < SIZE  # an upright number is so wide
    if is_stacked:
        left, wide = 2 * MARGIN, style.width - 4 * MARGIN
    between = BETWEEN_LAWS + is_stacked * LINE_HEIGHT * SIZE
    numbers = [number(own.sign * ratio) for ratio in own.ratios]
    upright = sum(map(across_size, numbers)) > wide + 2 * MARGIN
    ends = LEADER + (widest(numbers) + SIZE / 2 if upright else LINE_HEIGHT * SIZE)
    low = MARGIN + len(laws) * (STEP_ROW_HEIGHT + between) + ends
    said = style.text("steps between gears")
    spread = style.text("spread")
    note = f"{spread} {number(own.ratios[0] / own.ratios[-1])}"
    high = low + STEP_ROW_HEIGHT + LEADER + LINE_HEIGHT * SIZE
    pen = headed(title(results.case, said), note, [], (style.width, high), style)
    row = pen.panel((left, low), (wide, STEP_ROW_HEIGHT), line)
    _draw_gears(row, own, upright=upright)
    if not is_stacked:  # else names of gears stand there
        _name_row(row, names[0])
    for place, (name, law) in enumerate(laws, 1):
        below = low - ends - place * STEP_ROW_HEIGHT - (place - 1 + is_stacked) * between
        row = pen.panel((left, below), (wide, STEP_ROW_HEIGHT), line)
        _draw_law(row, law)
        _name_row(row, name, is_stacked=is_stacked)
    return [pen.figure]


def _narrowest(every: Sequence[ForwardGears]) -> float:
    """The narrowest of all cells, as a part of the line of ratios.

    >>> round(_narrowest([ForwardGears("123", [4.0, 2.0, 1.0], 1.0)]), 3)
    0.5
    """
    spread = max(one.ratios[0] for one in every) / min(one.ratios[-1] for one in every)
    steps = [high / low for one in every for high, low in pairwise(one.ratios)]
    return math.log(min(step for step in steps if step > 1)) / math.log(spread)


def _forward(results: Results, shown: Sequence[int]) -> ForwardGears:
    """The forward gears of a case, or those of some numbers.

    Raises
    ------
    CaseError
        If they have fewer than two ratios.
    """
    made: Design = design(results)
    asked = {results.case.gears[number - 1].name for number in shown} or {*made.forward}
    lines = {line.gear: line for line in made.gears}
    own = [lines[name] for name in made.forward if name in asked]
    if len({f"{line.ratio:.9g}" for line in own}) < 2:
        message = "a picture of steps needs forward gears of two different ratios, or more"
        raise CaseError("E444", message)
    return ForwardGears(
        [line.gear for line in own],
        [abs(line.ratio) for line in own],
        math.copysign(1.0, own[0].ratio),
    )


def _laws(own: ForwardGears, style: Style) -> list[tuple[str, StepLaw]]:
    """Geometric steps; progressive ones where a factor between steps is to be seen."""
    equal, growing = geometric(own.ratios), progressive(own.ratios)
    geometric_name = style.text("geometric")
    found = [(f"{geometric_name} {number(equal.steps[0])}", equal)]
    if len(own.names) > 2:
        name = style.text("progressive")
        found.append((f"{name} ×{number(growing.growth)}", growing))
    return found


def _draw_gears(pen: Pen, own: ForwardGears, *, upright: bool) -> None:
    """A cell from each gear to the next, with names above and ratios, perhaps upright, below."""
    style = pen.style
    following = [*own.ratios[1:], None]
    for name, ratio, other in zip(own.names, own.ratios, following, strict=True):
        data = {"gear": name, "ratio": f"{own.sign * ratio:.9g}"}
        said = f"{gear_title(name, style)}: {number(own.sign * ratio)}"
        if other:
            data["step"] = f"{ratio / other:.9g}"
            said += f", {style.text('step')} {number(ratio / other)}"
        cell = pen.within("step", **data)
        x = pen.across(ratio)
        if other:
            face = mixed(style.power, style.paper, 0.45)
            wide = pen.across(other) - x
            cell.box((x, 0.0), (wide, pen.size[1]), facecolor=face, title=said)
            _name_cell(cell, x, wide, ratio / other)
        cell.line((x, 0.0), (x, pen.size[1]), color=style.ink, width=FRAME_WIDTH, title=said)
    ends = pen.across(own.ratios[0]), pen.across(own.ratios[-1])
    level = [tuple((x, y) for x in ends) for y in (0.0, pen.size[1])]
    pen.lines(level, color=style.ink, width=FRAME_WIDTH)
    left, low = pen.corner
    beyond = pen.panel((left - MARGIN, low), (pen.size[0] + 2 * MARGIN, pen.size[1]))
    places = [MARGIN + pen.across(ratio) for ratio in own.ratios]
    names, ratios = (
        [Label(x, text, style.ink) for x, text in zip(places, texts, strict=True)]
        for texts in (own.names, [number(own.sign * ratio) for ratio in own.ratios])
    )
    along(beyond, "top", names, upright=False)
    along(beyond, "bottom", ratios, upright=upright)


def _draw_law(pen: Pen, law: StepLaw) -> None:
    """The places of gears by a law, with its steps."""
    style = pen.style
    marks = [pen.across(ratio) for ratio in law.ratios]
    for (left, right), step in zip(pairwise(marks), law.steps, strict=True):
        _name_cell(pen, left, right - left, step)
    sides = [((x, 0.0), (x, pen.size[1])) for x in marks]
    pen.lines(sides, color=style.ink, width=FRAME_WIDTH)
    ends = marks[0], marks[-1]
    level = [tuple((x, y) for x in ends) for y in (0.0, pen.size[1])]
    pen.lines(level, color=style.faint, width=FRAME_WIDTH)


def _name_cell(pen: Pen, left: float, wide: float, step: float) -> None:
    """The number of a step in the middle of its cell, upright where this is narrow."""
    text = number(step)
    look: Look = {"ha": "center", "va": "center_baseline"}
    if width(text) > wide - 2:
        look = UPRIGHT_IN_CELL
    pen.text(left + wide / 2, pen.size[1] / 2, text, **look)


def _name_row(pen: Pen, name: str, *, is_stacked: bool = False) -> None:
    """Left of a row, or above it where cells need the width."""
    if is_stacked:
        pen.text(0.0, pen.size[1] + 2, name, va="bottom")
        return
    pen.text(-SIZE - MARGIN, pen.size[1] / 2, name, ha="right", va="center_baseline")
