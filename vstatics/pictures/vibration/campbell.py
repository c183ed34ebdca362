"""The Campbell diagram: natural frequencies over the speed of the input, and its orders."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from matplotlib.figure import Figure

from vstatics.model.transmission import Gear, Transmission
from vstatics.pictures.sheet.ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.sheet.head import headed
from vstatics.pictures.sheet.labels import LEADER, Label, height, widest, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import MARGIN, SMALL_NUMBER, Style, number
from vstatics.pictures.sheet.words import gear_title, title
from vstatics.pictures.vibration.shown_modes import modes_of, why_none
from vstatics.statics.results import Results
from vstatics.tables.numbers import certain
from vstatics.torsion.tolerances import LEAST_PARTICIPATION

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes

DIAGRAM_SIZE = (270.0, 210.0)
"""Width and height without labels, where there are several. [pt]"""
LONE_DIAGRAM_SCALE = 1.5
"""By so much a diagram is larger that stands alone."""
FREQUENCY_SCALE_WIDTH, SPEED_SCALE_HEIGHT = 56.0, 44.0
"""For the scales. [pt]"""
ORDERS_HEIGHT = 46.0
"""For the gear, and orders. [pt]"""
DIAGRAMS_ON_SHEET = 6
"""So many diagrams fit a printed page."""
DIGIT_HEIGHT = 0.75
"""Height of digits over their size."""
ORDERS = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0)
"""Of four-stroke engines: half orders, the shaft, the firing of four, six, eight, twelve
cylinders."""
FASTEST_INPUT = 6000.0
"""Where no load tells the speed of the input. [rpm]"""
SPEED_ROOM = 1.25
"""So far above the speed of the load."""
FREQUENCY_ROOM = 1.1
"""Of the highest frequency that is shown."""
PER_MINUTE = 60.0


class _CampbellDiagram(NamedTuple):
    """A gear."""

    head: str
    found: GearModes
    input: str
    """The link whose speed is across."""
    shown: OrderRange
    style: Style

    @property
    def frequencies(self) -> list[float]:
        """Of all modes [Hz]."""
        return [mode.frequency for mode in self.found.modes]

    @property
    def excited(self) -> dict[float, float]:
        """Frequencies of modes [Hz] in which the input moves, its amplitude by the largest."""
        parts = ((mode.frequency, abs(mode.shape[self.input])) for mode in self.found.modes)
        return {frequency: part for frequency, part in parts if part > LEAST_PARTICIPATION}

    def hertz(self, frequency: float) -> str:
        """A frequency with its unit."""
        return f"{number(frequency)} {self.style.text('Hz', 'Гц')}"

    @property
    def ends(self) -> list[LineEnd]:
        """What reaches the right edge: modes, an arrow at those above the range, and orders."""
        shown, found = self.shown, []
        for place, frequency in enumerate(self.frequencies, 1):
            above = " ↑" if frequency > shown.frequency else ""
            at = shown.up(min(frequency, shown.frequency))
            found.append(LineEnd(at, (f"{place}: {self.hertz(frequency)}{above}",)))
        reached = ((order, *shown.end(order)) for order in (ORDERS if found else ()))
        return found + [LineEnd(y, (_order_name(n),)) for n, x, y in reached if x == 1.0]


def draw(results: Results, style: Style, gears: Sequence[int] = ()) -> list[Figure]:
    """Draw a diagram for each gear of a case, or for some, all to one scale, on pages.

    Raises
    ------
    CaseError
        If scipy is not installed, or no gear has a natural frequency.
    """
    every = _diagrams(results, style, gears)
    on_page = len(every) if math.isinf(style.height) else DIAGRAMS_ON_SHEET
    starts = range(0, len(every), on_page)
    return [_figure(results.case, every[n : n + on_page]) for n in starts]


def _diagrams(results: Results, style: Style, gears: Sequence[int]) -> list[_CampbellDiagram]:
    case = results.case
    numbers = list(gears) or list(range(1, len(case.gears) + 1))
    own = [case.gears[one - 1] for one in numbers]
    found = modes_of(results, numbers)
    frequencies = [certain(mode.frequency) for gear in found for mode in gear.modes]
    shown = order_range(highest_speed(case, own, frequencies), frequencies)
    return [
        _CampbellDiagram(
            gear_title(gear.name, style), modes, case.link_name(case.gear_input(gear)), shown, style
        )
        for gear, modes in zip(own, found, strict=True)
    ]


def _figure(case: Transmission, diagrams: Sequence[_CampbellDiagram]) -> Figure:
    """Diagrams beside and below one another."""
    part, style = LONE_DIAGRAM_SCALE if len(diagrams) == 1 else 1.0, diagrams[0].style
    ends = [one.ends for one in diagrams]
    wide, least = (part * length for length in DIAGRAM_SIZE)
    high = max(least, *map(height_of, ends))
    right = max(*map(width_of, ends), LEADER + width(_order_name(0.5))) + MARGIN
    across, up = FREQUENCY_SCALE_WIDTH + wide + right, ORDERS_HEIGHT + high + SPEED_SCALE_HEIGHT
    columns = min(len(diagrams), 2)
    rows = math.ceil(len(diagrams) / columns)
    subject = style.text(
        "natural frequencies, and orders of the input speed",
        "собственные частоты и порядки частоты вращения входа",
    )
    note = style.text("scales by square roots", "шкалы квадратных корней")
    resonates = any(next(crossings(one.shown, one.excited), None) for one in diagrams)
    resonance = "resonance, at its speed in rpm", "резонанс, при его скорости в об/мин"
    signs = [
        (True, "natural frequency, by mode", "собственная частота, по формам", _mode_look(style)),
        (True, "order n×", "порядок n×", _order_look(style)),
        (resonates, *resonance, _dot_look(style)),
    ]
    pen = headed(title(case, subject), note, signs, (columns * across + MARGIN, rows * up), style)
    for place, diagram in enumerate(diagrams):
        row, column = divmod(place, columns)
        corner = column * across + FREQUENCY_SCALE_WIDTH, (rows - 1 - row) * up + SPEED_SCALE_HEIGHT
        _draw(pen.panel(corner, (wide, high)), diagram)
    return pen.figure


def _mode_look(style: Style) -> Look:
    """Of a natural frequency: ink, as links alone have colours."""
    return {"color": style.ink, "width": 1.3}


def _order_look(style: Style) -> Look:
    return {"color": style.soft, "width": 0.8}


def _dot_look(style: Style) -> Look:
    edge = {"markerfacecolor": style.paper, "markeredgecolor": style.ink, "width": 1.5}
    return {"color": style.ink, "marker": "o", "markersize": 3.8, "zorder": 4, **edge}


def _order_name(order: float) -> str:
    return f"{order:g}×"


def _draw(pen: Pen, diagram: _CampbellDiagram) -> None:
    """A diagram with its labels."""
    (wide, high), style, shown = pen.size, pen.style, diagram.shown
    _draw_scales(pen, diagram)
    pen.text(0, high + LEADER + height("") - 2, diagram.head, va="bottom", bold=True)
    if not diagram.found.modes:
        why = why_none(diagram.found, style)
        pen.text(wide / 2, high / 2, why, ha="center", va="center")
        return
    above = []
    for order in ORDERS:
        x, y = shown.end(order)
        pen.line((0.0, 0.0), (x * wide, y * high), title=_order_name(order), **_order_look(style))
        if x < 1.0:
            above.append(Label(x * wide, _order_name(order), style.soft))
    for place, frequency in enumerate(diagram.frequencies, 1):
        if frequency <= shown.frequency:
            y = high * shown.up(frequency)
            mode = style.text(f"mode {place}", f"форма {place}")
            said = f"{diagram.head}, {mode}: {diagram.hertz(frequency)}"
            pen.line((0.0, y), (wide, y), title=said, **_mode_look(style))
    beside(pen, "right", diagram.ends)
    along(pen, "top", above, upright=False)
    _draw_crossings(pen, diagram)


def _draw_scales(pen: Pen, diagram: _CampbellDiagram) -> None:
    (wide, high), style, shown = pen.size, pen.style, diagram.shown
    speeds = root_ticks(shown.speed, (width(f"{shown.speed:g}") + 8) / wide)
    hertz = root_ticks(shown.frequency, 1.5 * height("") / high)
    texts = [f"{one:g}" for one in hertz]
    pen.scale("bottom", [*map(shown.across, speeds)], [f"{one:g}" for one in speeds], grid=True)
    pen.scale("left", [*map(shown.up, hertz)], texts, grid=True)
    pen.frame()
    rpm = style.text("rpm", "об/мин")
    said = style.text(f"speed of {diagram.input}, {rpm}", f"скорость {diagram.input}, {rpm}")
    if width(said) >= wide:  # a link with a long name is the input
        said = style.text(f"speed of the input, {rpm}", f"скорость входа, {rpm}")
    pen.name("bottom", said, 26)
    pen.name("left", style.text("frequency, Hz", "частота, Гц"), widest(texts) + 16)


def _draw_crossings(pen: Pen, diagram: _CampbellDiagram) -> None:
    """Dots, each with its speed where there is room beside all dots, lines and numbers."""
    (wide, high), style, shown = pen.size, pen.style, diagram.shown
    found, parts = list(crossings(shown, diagram.excited)), diagram.excited
    dots = [(wide * shown.across(one.speed), high * shown.up(one.frequency)) for one in found]
    taken = [(x - 2, y - 2, x + 2, y + 2) for x, y in dots]
    levels = [high * shown.up(one) for one in diagram.frequencies if one <= shown.frequency]
    slopes = [y * high / (x * wide) for x, y in map(shown.end, ORDERS)]
    rpm = style.text("rpm", "об/мин")
    took_part = style.text("participation", "участие")
    for (x, y), one in zip(dots, found, strict=True):
        text = f"{one.speed:.0f}"
        said = f"{diagram.head}, {_order_name(one.order)}: {text} {rpm}"
        said = f"{said}, {diagram.hertz(one.frequency)}, {took_part} {parts[one.frequency]:.2g}"
        pen.line((x, y), title=said, **_dot_look(style))
        long, tall = width(text, SMALL_NUMBER), DIGIT_HEIGHT * SMALL_NUMBER
        for left, low in ((x - long - 3.5, y + 2.5), (x + 3.5, y - tall - 2.5)):
            box = left - 1, low - 1, left + long + 1, low + tall + 1
            inside = min(box[:2]) > 0 and box[2] < wide and box[3] < high
            covers = any(
                box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
                for other in taken
            )
            if inside and not covers and not _crossed(box, levels, slopes):
                taken.append(box)
                at = left, low + tall / 2
                pen.text(*at, text, size=SMALL_NUMBER, va="center_baseline", over=True)
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

    def end(self, order: float) -> tuple[float, float]:
        """Where the line of an order leaves the diagram, as parts of its width and height."""
        frequency = order * self.speed / PER_MINUTE
        if frequency <= self.frequency:
            return 1.0, self.up(frequency)
        return self.across(self.frequency * PER_MINUTE / order), 1.0


def highest_speed(case: Transmission, gears: Iterable[Gear], frequencies: Sequence[float]) -> float:
    """A round speed above those that loads have, else one at which all orders are above [rpm].

    >>> from vstatics import Gear, Load
    >>> loads = Load(-5800.0), None
    >>> loaded, bare = (Transmission(2, [], [], [Gear()], load=load) for load in loads)
    >>> highest_speed(loaded, loaded.gears, [20.0]), highest_speed(bare, bare.gears, [20.0])
    (7500.0, 2500.0)
    """
    loads = (case.gear_load(gear) for gear in gears)
    fastest = SPEED_ROOM * max((abs(load.speed or 0.0) for load in loads), default=0.0)
    if not fastest:
        fastest = min(FASTEST_INPUT, max(frequencies) * PER_MINUTE / ORDERS[0])
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
