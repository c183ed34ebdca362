"""Where labels go so that none covers another: along an edge, and wrapped to a width."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.ticker import MaxNLocator

from vstatics.pictures.drawing.files import ALONE
from vstatics.pictures.drawing.style import FONT, HINTING, SIZE, TITLE

POINTS_PER_INCH = 72.0
"""In an inch."""
LABEL_GAP = 3.0
"""Between labels. [pt]"""
LEADER = 16.0
"""Length of the line from an edge to its label. [pt]"""
Point = tuple[float, float]
"""A place of a picture. [pt]"""
Segment = tuple[Point, Point]
"""A straight line from place to place."""
LINE_HEIGHT = 1.25
"""Height of a line of text over its size, with what stands between lines."""
Span = tuple[float, float]
"""From where to where."""


def spread(
    wanted: Sequence[float],
    sizes: Sequence[float],
    low: float = float("-inf"),
    high: float = float("inf"),
) -> list[float]:
    """Places along an edge, near to the wanted ones, where labels of these sizes do not overlap.

    The sum of squares of the shifts is the least that there is (isotonic regression by
    pooling neighbours). Labels keep their order.

    Parameters
    ----------
    wanted : sequence of float
        Middle of each label, in any order.
    sizes : sequence of float
        Length of each along the edge.
    low, high : float
        Ends of the edge; with too little room labels go beyond `high`.

    Examples
    --------
    >>> spread([1.0, 5.0, 1.0], [2.0, 2.0, 2.0])
    [0.0, 5.0, 2.0]
    >>> spread([1.0, 5.0, 1.0], [2.0, 2.0, 2.0], low=0.0)
    [1.0, 5.0, 3.0]
    """
    order = sorted(range(len(wanted)), key=lambda place: wanted[place])
    starts: list[float] = []  # what is taken by the labels before each, and half of its own
    taken = 0.0
    for place in order:
        starts.append(taken + sizes[place] / 2)
        taken += sizes[place]
    pools: list[tuple[float, int]] = []  # mean and number of labels that touch one another
    for place, start in zip(order, starts, strict=True):
        mean, count = wanted[place] - start, 1
        while pools and pools[-1][0] > mean:
            before, others = pools.pop()
            mean = (mean * count + before * others) / (count + others)
            count += others
        pools.append((mean, count))
    means = [mean for mean, count in pools for _ in range(count)]
    places = [0.0] * len(order)
    for place, start, mean in zip(order, starts, means, strict=True):
        places[place] = max(min(mean, high - taken), low) + start
    return places


@cache
def _renderer() -> Any:
    canvas: Any = FigureCanvasAgg(Figure(dpi=POINTS_PER_INCH))
    return canvas.get_renderer()


@cache
def width(text: str, size: float = SIZE, *, bold: bool = False) -> float:
    """Width of a text of one or more lines [pt]; the same whatever matplotlib is set to."""
    font = FontProperties(family=FONT, size=size, weight="bold" if bold else "normal")
    measure = _renderer().get_text_width_height_descent
    with ALONE, mpl.rc_context(HINTING):
        return float(max(measure(line, font, ismath=False)[0] for line in text.split("\n")))


title_width = partial(width, size=TITLE, bold=True)
"""Width of a title [pt]."""


def widest(texts: Iterable[str]) -> float:
    """Width of the widest text [pt]."""
    return max((width(one) for one in texts), default=0.0)


def height(text: str, size: float = SIZE) -> float:
    """Height of a text with its lines [pt]."""
    return LINE_HEIGHT * size * (1 + text.count("\n"))


def across_size(text: str) -> float:
    """The part of an edge that a text beside others needs [pt]."""
    return width(text) + 2 * LABEL_GAP


def wrapped(text: str, room: float, measure: Callable[[str], float] = width) -> str:
    r"""A text in lines that fit into a width, or whatever measures them, as far as its words do.

    >>> wrapped("carrier and second ring", 60.0), wrapped("carrier and second ring", 14, len)
    ('carrier and\nsecond ring', 'carrier and\nsecond ring')
    """
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and measure(longer) > room:
            lines.append(word)
        else:
            lines[-1] = longer
    return "\n".join(lines)


class Label(NamedTuple):
    """A text that belongs to a place on an edge."""

    at: float
    """Along the edge, from its left or lower end. [pt]"""
    text: str
    colour: str


def ticks(low: float, high: float, most: int) -> list[float]:
    """Round numbers between two, for a scale.

    >>> ticks(-35.0, 2.0, 5)
    [-30.0, -20.0, -10.0, 0.0]
    """
    found = MaxNLocator(most, steps=[1, 2, 5, 10]).tick_values(low, high)
    return [float(one) for one in found if low <= one <= high]
