"""The Campbell diagram: natural frequencies over the speed of the input, and its orders."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from matplotlib.figure import Figure

from vstatics.model.transmission import Gear, Transmission
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import AxisScale, Chart, widest
from vstatics.pictures.sheet.ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.sheet.head import KeySign, chart_head
from vstatics.pictures.sheet.labels import LEADER, Label, Paper, height, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.style import Style, number
from vstatics.pictures.sheet.svg import halo, told
from vstatics.pictures.sheet.words import gear_title, title
from vstatics.pictures.vibration.shown_modes import modes_of, why_none
from vstatics.statics.results import Results
from vstatics.tables.numbers import certain

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes


WIDE, HIGH = 270.0, 210.0
"""Of a diagram without its labels, where there are several. [pt]"""
LONE_DIAGRAM_SCALE = 1.5
"""By so much a diagram is larger that stands alone."""
CAMPBELL_MARGIN = 12.0
"""[pt]"""
LEFT, BELOW = 56.0, 44.0
"""For the scales. [pt]"""
ABOVE = 46.0
"""For the gear, and orders. [pt]"""
ON_SHEET = 6
"""So many diagrams fit a printed page."""
CROSSING_SIZE = 6.5
"""Of speeds at crossings. [pt]"""
DIGIT_HEIGHT = 0.75
"""Height of digits over their size."""


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
    frequencies = [certain(mode.frequency) for gear in found for mode in gear.modes]
    return diagrams, order_range(highest_speed(case, own, frequencies), frequencies)


def _figure(
    case: Transmission, diagrams: Sequence[_CampbellDiagram], shown: OrderRange, style: Style
) -> Figure:
    """Diagrams beside and below one another."""
    layout = _layout(diagrams, shown, style)
    rows = math.ceil(len(diagrams) / layout.columns)
    wide = layout.columns * layout.across + CAMPBELL_MARGIN
    subject = style.text(
        "natural frequencies, and orders of the input speed",
        "собственные частоты и порядки частоты вращения входа",
    )
    note = style.text("scales by square roots", "шкалы квадратных корней")
    signs = _signs(diagrams, shown, style)
    head = chart_head(title(case, subject), note, signs, wide - 2 * CAMPBELL_MARGIN, style)
    high = CAMPBELL_MARGIN + head.high + rows * layout.up
    paper = Paper(labels.figure(wide, high))
    head.draw(paper, CAMPBELL_MARGIN, high - CAMPBELL_MARGIN, style)
    whole = AxisScale(0.0, 1.0)
    for place, diagram in enumerate(diagrams):
        row, column = divmod(place, layout.columns)
        corner = column * layout.across + LEFT, (rows - 1 - row) * layout.up + BELOW
        chart = Chart(paper, corner, layout.wide, layout.high, whole, whole)
        _draw(chart, diagram, shown, style)
    return paper.figure


def _layout(
    diagrams: Sequence[_CampbellDiagram], shown: OrderRange, style: Style
) -> _DiagramLayout:
    size = LONE_DIAGRAM_SCALE if len(diagrams) == 1 else 1.0
    ends = [_ends(one, shown, style, 1.0) for one in diagrams]
    high = max(size * HIGH, *map(height_of, ends))
    right = max(*map(width_of, ends), LEADER + width(_order_name(0.5))) + CAMPBELL_MARGIN
    wide = size * WIDE
    columns = min(len(diagrams), 2)
    return _DiagramLayout(columns, wide, high, LEFT + wide + right, ABOVE + high + BELOW)


def _mode_look(style: Style) -> Look:
    """Of a natural frequency: ink, as links alone have colours."""
    return {"color": style.ink, "linewidth": 1.3, "solid_capstyle": "butt"}


def _order_look(style: Style) -> Look:
    return {"color": style.soft, "linewidth": 0.8}


def _dot_look(style: Style) -> Look:
    edge = {"markerfacecolor": style.paper, "markeredgecolor": style.ink}
    return {"color": style.ink, "marker": "o", "markersize": 3.8, "zorder": 4, **edge}


def _signs(diagrams: Sequence[_CampbellDiagram], shown: OrderRange, style: Style) -> list[KeySign]:
    """The key, of what occurs."""
    signs = [
        KeySign(
            style.text("natural frequency, by mode", "собственная частота, по формам"),
            _mode_look(style),
        ),
        KeySign(style.text("order n×", "порядок n×"), _order_look(style)),
    ]
    if any(list(crossings(shown, _frequencies(one))) for one in diagrams):
        text = style.text("resonance, at its speed in rpm", "резонанс, при его скорости в об/мин")
        signs.append(KeySign(text, _dot_look(style)))
    return signs


def _frequencies(diagram: _CampbellDiagram) -> list[float]:
    return [mode.frequency for mode in diagram.found.modes]


def _order_name(order: float) -> str:
    return f"{order:g}×"


def _order_end(order: float, shown: OrderRange) -> tuple[float, float]:
    """Where the line of an order leaves the diagram, as parts of its width and height."""
    frequency = order * shown.speed / PER_MINUTE
    if frequency <= shown.frequency:
        return 1.0, shown.up(frequency)
    return shown.across(shown.frequency * PER_MINUTE / order), 1.0


def _ends(diagram: _CampbellDiagram, shown: OrderRange, style: Style, high: float) -> list[LineEnd]:
    """What reaches the right edge: modes, with an arrow at those above the range, and orders."""
    hertz = style.text("Hz", "Гц")
    found = []
    for place, frequency in enumerate(_frequencies(diagram), 1):
        above = " ↑" if frequency > shown.frequency else ""
        text = f"{place}: {number(frequency)} {hertz}{above}"
        found.append(LineEnd(high * shown.up(min(frequency, shown.frequency)), (text,)))
    if found:
        for order in ORDERS:
            x, y = _order_end(order, shown)
            if x == 1.0:
                found.append(LineEnd(high * y, (_order_name(order),)))
    return found


def _draw(chart: Chart, diagram: _CampbellDiagram, shown: OrderRange, style: Style) -> None:
    """A diagram with its labels."""
    _draw_scales(chart, diagram, shown, style)
    top = chart.height + LEADER + height("") - 2
    chart.write(0, top, diagram.head, va="bottom", weight="bold")
    if not diagram.found.modes:
        middle = chart.width / 2, chart.height / 2
        chart.write(*middle, why_none(diagram.found, style), ha="center", va="center")
        return
    above = []
    for order in ORDERS:
        x, y = _order_end(order, shown)
        end = x * chart.width, y * chart.height
        chart.line((0.0, 0.0), end, gid=told(_order_name(order)), **_order_look(style))
        if x < 1.0:
            above.append(Label(end[0], _order_name(order), style.soft))
    for place, frequency in enumerate(_frequencies(diagram), 1):
        if frequency <= shown.frequency:
            y = chart.height * shown.up(frequency)
            mode = style.text(f"mode {place}", f"форма {place}")
            said = told(f"{diagram.head}, {mode}: {number(frequency)} {style.text('Hz', 'Гц')}")
            chart.line((0.0, y), (chart.width, y), gid=said, **_mode_look(style))
    beside(chart, "right", _ends(diagram, shown, style, chart.height), style)
    along(chart, "top", above, style, upright=False)
    _draw_crossings(chart, diagram, shown, style)


def _draw_scales(chart: Chart, diagram: _CampbellDiagram, shown: OrderRange, style: Style) -> None:
    speeds = root_ticks(shown.speed, (width(f"{shown.speed:g}") + 8) / chart.width)
    at = [shown.across(one) for one in speeds]
    chart.scale("bottom", at, style, [f"{one:g}" for one in speeds], grid=True)
    hertz = root_ticks(shown.frequency, 1.5 * height("") / chart.height)
    texts = [f"{one:g}" for one in hertz]
    chart.scale("left", [shown.up(one) for one in hertz], style, texts, grid=True)
    chart.frame(style, "left", "right", "bottom", "top")
    chart.name("bottom", _speed_text(chart, diagram, style), 26)
    chart.name("left", style.text("frequency, Hz", "частота, Гц"), widest(texts) + 16)


def _speed_text(chart: Chart, diagram: _CampbellDiagram, style: Style) -> str:
    """What is across; a link with a long name is the input."""
    rpm = style.text("rpm", "об/мин")
    said = style.text(f"speed of {diagram.input}, {rpm}", f"скорость {diagram.input}, {rpm}")
    if width(said) < chart.width:
        return said
    return style.text(f"speed of the input, {rpm}", f"скорость входа, {rpm}")


def _draw_crossings(
    chart: Chart, diagram: _CampbellDiagram, shown: OrderRange, style: Style
) -> None:
    """Dots, each with its speed where there is room beside all dots, lines and numbers."""
    found = list(crossings(shown, _frequencies(diagram)))
    dots = [
        (chart.width * shown.across(one.speed), chart.height * shown.up(one.frequency))
        for one in found
    ]
    taken = [(x - 2, y - 2, x + 2, y + 2) for x, y in dots]
    levels = [
        chart.height * shown.up(one) for one in _frequencies(diagram) if one <= shown.frequency
    ]
    slopes = [
        y * chart.height / (x * chart.width) for x, y in (_order_end(o, shown) for o in ORDERS)
    ]
    rpm = style.text("rpm", "об/мин")
    for (x, y), one in zip(dots, found, strict=True):
        text = f"{one.speed:.0f}"
        hertz = f"{number(one.frequency)} {style.text('Hz', 'Гц')}"
        said = f"{diagram.head}, {_order_name(one.order)}: {text} {rpm}, {hertz}"
        chart.line((x, y), gid=told(said), **_dot_look(style))
        wide, high = width(text, CROSSING_SIZE), DIGIT_HEIGHT * CROSSING_SIZE
        for left, low in ((x - wide - 3.5, y + 2.5), (x + 3.5, y - high - 2.5)):
            box = left - 1, low - 1, left + wide + 1, low + high + 1
            inside = min(box[:2]) > 0 and box[2] < chart.width and box[3] < chart.height
            covers = any(_meet(box, other) for other in taken) or _crossed(box, levels, slopes)
            if inside and not covers:
                taken.append(box)
                how: dict[str, Any] = {"fontsize": CROSSING_SIZE, "va": "center_baseline"}
                chart.write(left, low + high / 2, text, **how, **halo(style))
                break


def _crossed(box: tuple[float, ...], levels: Sequence[float], slopes: Sequence[float]) -> bool:
    """Whether a level line, or one of a slope from the origin, goes through a box.

    >>> box = (10.0, 20.0, 30.0, 28.0)
    >>> _crossed(box, [24.0], []), _crossed(box, [], [1.0]), _crossed(box, [30.0], [0.5, 3.0])
    (True, True, False)
    """
    left, low, right, high = box
    return any(low < one < high for one in levels) or any(
        slope * left < high and slope * right > low for slope in slopes
    )


def _meet(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    """Whether two boxes cover each other: left, low, right, high."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


ORDERS = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0)
"""Of four-stroke engines: half orders, the shaft, the firing of four, six, eight, twelve
cylinders."""
FASTEST = 6000.0
"""Where no load tells the speed of the input. [rpm]"""
OVER = 1.25
"""So far above the speed of the load."""
FREQUENCY_ROOM = 1.1
"""Of the highest frequency that is shown."""
PER_MINUTE = 60.0


class Crossing(NamedTuple):
    """An order that meets a natural frequency: a resonance."""

    speed: float
    """Of the input. [rpm]"""
    frequency: float
    """[Hz]"""
    order: float
    """[-]"""


class OrderRange(NamedTuple):
    """What a Campbell diagram shows, from 0 on, its scales by square roots.

    So orders are straight lines from the origin, and low frequencies stand apart.
    """

    speed: float
    """The highest. [rpm]"""
    frequency: float
    """The highest. [Hz]"""

    def across(self, speed: float) -> float:
        """The place of a speed, the highest at 1."""
        return math.sqrt(speed / self.speed)

    def up(self, frequency: float) -> float:
        """The place of a frequency, the highest at 1."""
        return math.sqrt(frequency / self.frequency)


def highest_speed(case: Transmission, gears: Iterable[Gear], frequencies: Sequence[float]) -> float:
    """A round speed above those that loads have, else one at which all orders are above [rpm].

    >>> from vstatics import Gear, Load
    >>> loads = Load(-5800.0), None
    >>> loaded, bare = (Transmission(2, [], [], [Gear()], load=load) for load in loads)
    >>> highest_speed(loaded, loaded.gears, [20.0]), highest_speed(bare, bare.gears, [20.0])
    (7500.0, 2500.0)
    """
    loads = (case.gear_load(gear) for gear in gears)
    fastest = OVER * max((abs(load.speed or 0.0) for load in loads), default=0.0)
    if not fastest:
        fastest = min(FASTEST, max(frequencies) * PER_MINUTE / ORDERS[0])
    unit = 10.0 ** math.floor(math.log10(fastest)) / 2
    return math.ceil(fastest / unit) * unit


def order_range(speed: float, frequencies: Sequence[float]) -> OrderRange:
    """Up to the highest frequency that an order reaches, a little more.

    >>> order_range(6000.0, [30.0, 250.0, 900.0])
    OrderRange(speed=6000.0, frequency=275.0)
    """
    top = ORDERS[-1] * speed / PER_MINUTE
    reached = [frequency for frequency in frequencies if frequency <= top]
    return OrderRange(speed, FREQUENCY_ROOM * max(reached) if reached else top)


def crossings(shown: OrderRange, frequencies: Iterable[float]) -> Iterator[Crossing]:
    """The resonances within a range, by ascending frequency, then order.

    >>> [(one.order, one.speed) for one in crossings(OrderRange(3000.0, 150.0), [50.0])]
    [(1.0, 3000.0), (2.0, 1500.0), (3.0, 1000.0), (4.0, 750.0), (6.0, 500.0)]
    """
    for frequency in frequencies:
        for order in ORDERS:
            speed = frequency * PER_MINUTE / order
            if speed <= shown.speed and frequency <= shown.frequency:
                yield Crossing(speed, frequency, order)


def root_ticks(highest: float, least: float) -> list[float]:
    """Round numbers up to the highest whose square roots are apart, by parts of the scale.

    >>> root_ticks(1000.0, 0.12)
    [0.0, 20.0, 100.0, 200.0, 500.0, 700.0, 1000.0]
    """
    power = 10.0 ** math.floor(math.log10(highest))
    chosen = [0.0]
    for digits in ((1.0,), (5.0,), (2.0,), (3.0, 7.0), (4.0, 6.0, 8.0, 9.0)):
        for size in (power, power / 10, power / 100):
            for tick in (digit * size for digit in digits):
                at = math.sqrt(tick / highest)
                apart = all(abs(at - math.sqrt(one / highest)) >= least for one in chosen)
                chosen += [tick] if tick <= highest and apart else []
    return sorted(chosen)
