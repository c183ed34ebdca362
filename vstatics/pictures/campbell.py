"""The Campbell diagram: natural frequencies over the speed of the input, and its orders."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from matplotlib.figure import Figure

from vstatics.model.transmission import Transmission
from vstatics.pictures import labels
from vstatics.pictures.labels import LEADER, Label, Panel, height, width, wrapped
from vstatics.pictures.orders import (
    ORDERS,
    PER_MINUTE,
    OrderRange,
    crossings,
    highest_speed,
    order_range,
    root_ticks,
)
from vstatics.pictures.style import TITLE, Style, number
from vstatics.pictures.vibration import modes_of, why_none
from vstatics.pictures.words import gear_title, title
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from vstatics.torsion.gear_modes import GearModes

WIDE, HIGH = 270.0, 210.0
"""Of a diagram without its labels, where there are several. [pt]"""
ALONE = 1.5
"""By so much a diagram is larger that stands alone."""
MARGIN = 14.0
"""[pt]"""
LEFT, BELOW = 56.0, 40.0
"""For the scales. [pt]"""
ABOVE = 58.0
"""For the gear, and orders. [pt]"""
ON_SHEET = 6
"""So many diagrams fit a printed page."""
SMALL = 6.5
"""Of speeds at crossings. [pt]"""


class _CampbellDiagram(NamedTuple):
    """A gear."""

    head: str
    found: GearModes
    input: str
    """The link whose speed is across."""


class _DiagramLayout(NamedTuple):
    """Where the diagrams of a figure stand; lengths in points."""

    columns: int
    wide: float
    """Of the axes."""
    high: float
    across: float
    """A diagram with all its labels."""
    up: float


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> Figure:
    """Draw a diagram for each gear of a case, or for some, all to one scale.

    Raises
    ------
    CaseError
        If scipy is not installed, or no gear has a natural frequency.
    """
    diagrams, shown = _diagrams(results, style, gears)
    return _figure(results.case, diagrams, shown, style)


def sheets(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """The same in figures that fit a printed page each; errors as of `draw`."""
    diagrams, shown = _diagrams(results, style, gears)
    starts = range(0, len(diagrams), ON_SHEET)
    return [_figure(results.case, diagrams[n : n + ON_SHEET], shown, style) for n in starts]


def _diagrams(
    results: Results, style: Style, gears: Sequence[int]
) -> tuple[list[_CampbellDiagram], OrderRange]:
    """What is drawn, and its range."""
    case = results.case
    numbers = list(gears) or list(range(1, len(case.gears) + 1))
    own = [case.gears[one - 1] for one in numbers]
    found = modes_of(results, numbers)
    diagrams = [
        _CampbellDiagram(gear_title(gear.name, style), modes, case.link_name(case.gear_input(gear)))
        for gear, modes in zip(own, found, strict=True)
    ]
    frequencies = [mode.frequency for gear in found for mode in gear.modes]
    return diagrams, order_range(highest_speed(case, own, frequencies), frequencies)


def _figure(
    case: Transmission, diagrams: Sequence[_CampbellDiagram], shown: OrderRange, style: Style
) -> Figure:
    """Diagrams beside and below one another."""
    layout = _layout(diagrams, shown, style)
    rows = math.ceil(len(diagrams) / layout.columns)
    wide = layout.columns * layout.across + MARGIN
    subject = style.text(
        "natural frequencies, and orders of the input speed",
        "собственные частоты и порядки частоты вращения входа",
    )
    head = wrapped(title(case, subject), wide - 2 * MARGIN, TITLE)
    note = wrapped(_note(style), wide - 2 * MARGIN)
    above = 2 * MARGIN + height(head, TITLE) + height(note)
    high = above + rows * layout.up
    figure = labels.figure(wide, high)
    how: dict[str, Any] = {"ha": "center", "va": "top", "linespacing": labels.LINE}
    figure.text(0.5, 1 - MARGIN / high, head, fontsize=TITLE, **how)
    low = 1 - (above - MARGIN / 2) / high
    figure.text(0.5, low, note, **{**how, "va": "bottom", "color": style.soft})
    for place, diagram in enumerate(diagrams):
        row, column = divmod(place, layout.columns)
        left = column * layout.across + LEFT
        bottom = (rows - 1 - row) * layout.up + BELOW
        panel = labels.panel(figure, left, bottom, layout.wide, layout.high)
        _draw(panel, diagram, shown, style)
    return figure


def _layout(
    diagrams: Sequence[_CampbellDiagram], shown: OrderRange, style: Style
) -> _DiagramLayout:
    size = ALONE if len(diagrams) == 1 else 1.0
    texts = [text for one in diagrams for _, text, _ in _mode_labels(one, shown, style)]
    count = max(len(_mode_labels(one, shown, style)) for one in diagrams) + len(ORDERS)
    high = max(size * HIGH, count * (height("") + labels.GAP))
    right = LEADER + max(map(width, [*texts, _order_name(0.5)])) + MARGIN
    wide = size * WIDE
    columns = min(len(diagrams), 2)
    return _DiagramLayout(columns, wide, high, LEFT + wide + right, ABOVE + high + BELOW)


def _note(style: Style) -> str:
    """What the marks mean."""
    return style.text(
        "horizontal: natural frequencies, by mode; n×: order n; dots: resonances, with their "
        "speed in rpm; scales by square roots",
        "горизонтали: собственные частоты по формам; n×: порядок n; точки: резонансы, с их "
        "скоростью в об/мин; шкалы квадратных корней",
    )


def _order_name(order: float) -> str:
    return f"{order:g}×"


def _mode_labels(
    diagram: _CampbellDiagram, shown: OrderRange, style: Style
) -> list[tuple[float, str, str]]:
    """Frequency, text and colour of each mode; an arrow at those above the range."""
    hertz = style.text("Hz", "Гц")
    return [
        (
            min(mode.frequency, shown.frequency),
            f"{place}: {number(mode.frequency)} {hertz}"
            + (" ↑" if mode.frequency > shown.frequency else ""),
            style.colour(place - 1),
        )
        for place, mode in enumerate(diagram.found.modes, 1)
    ]


def _draw(panel: Panel, diagram: _CampbellDiagram, shown: OrderRange, style: Style) -> None:
    """A diagram with its labels."""
    _draw_scales(panel, diagram, shown, style)
    top = panel.height + LEADER + height("") + 2
    panel.write(0, top, diagram.head, va="bottom", weight="bold", fontsize=TITLE)
    if not diagram.found.modes:
        middle = panel.width / 2, panel.height / 2
        panel.write(*middle, why_none(diagram.found, style), ha="center", va="center")
        return
    right = [
        Label(panel.height * shown.up(at), text, colour)
        for at, text, colour in _mode_labels(diagram, shown, style)
    ]
    above = []
    for order in ORDERS:
        end = order * shown.speed / PER_MINUTE
        if end <= shown.frequency:
            x, y = panel.width, panel.height * shown.up(end)
            right.append(Label(y, _order_name(order), style.soft))
        else:
            x = panel.width * shown.across(shown.frequency * PER_MINUTE / order)
            y = panel.height
            above.append(Label(x, _order_name(order), style.soft))
        panel.line((0, 0), (x, y), color=style.soft, linewidth=0.8)
    frequencies = [mode.frequency for mode in diagram.found.modes]
    for place, frequency in enumerate(frequencies):
        if frequency <= shown.frequency:
            y = panel.height * shown.up(frequency)
            panel.line((0, y), (panel.width, y), color=style.colour(place), linewidth=1.3)
    panel.beside("right", right)
    panel.along("top", above, upright=False)
    _draw_crossings(panel, frequencies, shown, style)


def _draw_scales(panel: Panel, diagram: _CampbellDiagram, shown: OrderRange, style: Style) -> None:
    axes = panel.axes
    axes.set(xlim=(0, 1), ylim=(0, 1))
    axes.grid(linewidth=0.3, alpha=0.6)
    axes.set_axisbelow(True)
    speeds = root_ticks(shown.speed, (width(f"{shown.speed:g}") + 8) / panel.width)
    axes.set_xticks([shown.across(one) for one in speeds], [f"{one:g}" for one in speeds])
    hertz = root_ticks(shown.frequency, 1.5 * height("") / panel.height)
    axes.set_yticks([shown.up(one) for one in hertz], [f"{one:g}" for one in hertz])
    middle, low = panel.width / 2, 4 - BELOW
    panel.write(middle, low, _speed_text(panel, diagram, style), ha="center", va="bottom")
    text = style.text("frequency, Hz", "частота, Гц")
    panel.write(8 - LEFT, panel.height / 2, text, rotation=90, ha="center", va="center")


def _speed_text(panel: Panel, diagram: _CampbellDiagram, style: Style) -> str:
    """What is across; a link with a long name is the input."""
    rpm = style.text("rpm", "об/мин")
    said = style.text(f"speed of {diagram.input}, {rpm}", f"скорость {diagram.input}, {rpm}")
    if width(said) < panel.width:
        return said
    return style.text(f"speed of the input, {rpm}", f"скорость входа, {rpm}")


def _draw_crossings(
    panel: Panel, frequencies: Sequence[float], shown: OrderRange, style: Style
) -> None:
    """Dots, each with its speed where there is room."""
    dots = [
        (
            panel.width * shown.across(one.speed),
            panel.height * shown.up(one.frequency),
            f"{one.speed:.0f}",
        )
        for one in crossings(shown, frequencies)
    ]
    taken = [(x - 1.5, y - 1.5, x + 1.5, y + 1.5) for x, y, _ in dots]
    for x, y, text in dots:
        look: dict[str, Any] = {"color": style.ink, "marker": "o", "markersize": 3.0, "zorder": 4}
        panel.line((x, y), **look)
        wide, high = width(text, SMALL), height(text, SMALL)
        for left, low in ((x - wide - 2.5, y + 1.5), (x + 2.5, y - high - 1.5)):
            box = left - 1, low - 1, left + wide + 1, low + high + 1
            inside = min(box[:2]) > 0 and box[2] < panel.width and box[3] < panel.height
            if inside and not any(_meet(box, other) for other in taken):
                taken.append(box)
                ground: dict[str, Any] = {"facecolor": style.paper, "linewidth": 0, "zorder": 2.5}
                panel.box((left, low + 1), (wide, high - 2), alpha=0.8, **ground)
                panel.write(left, low + high / 2, text, fontsize=SMALL, va="center")
                break


def _meet(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    """Whether two boxes cover each other: left, low, right, high."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
