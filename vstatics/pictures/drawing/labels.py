"""Measurement of labels, wrapping to a width, and placement along an edge without overlap."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.metrics import line_width
from vstatics.pictures.drawing.style import SIZE, TITLE

LABEL_GAP = 3.0
"""Smallest distance between neighbouring labels. [pt]"""
LEADER = 16.0
"""Length of the leader line from an edge to a label. [pt]"""
Segment = tuple[Point, Point]
"""Straight line between two points."""
LINE_HEIGHT = 1.25
"""Distance between the baselines of consecutive lines of a text, relative to the letter size."""
Span = tuple[float, float]
"""Start and end of an interval."""


def spread(
    wanted: Sequence[float],
    sizes: Sequence[float],
    low: float = float("-inf"),
    high: float = float("inf"),
) -> list[float]:
    """Return positions of labels along an edge, near the wanted positions, without overlap.

    Labels keep their order. The sum of squares of their shifts is minimal (isotonic regression by
    pooling adjacent violators).

    Parameters
    ----------
    wanted : sequence of float
        Wanted position of the middle of each label, in any order.
    sizes : sequence of float
        Length of each label along the edge.
    low, high : float
        Ends of the edge; without enough room, labels extend beyond `high`.

    Examples
    --------
    >>> spread([1.0, 5.0, 1.0], [2.0, 2.0, 2.0])
    [0.0, 5.0, 2.0]
    >>> spread([1.0, 5.0, 1.0], [2.0, 2.0, 2.0], low=0.0)
    [1.0, 5.0, 3.0]
    >>> spread([1.0, 1.0 - 1e-12], [2.0, 2.0], low=0.0)
    [1.0, 3.0]
    """
    # Rounding noise must not order labels of equal positions, such as those of lines that meet.
    order = sorted(range(len(wanted)), key=lambda place: round(wanted[place], 6))
    # Offset of each middle from the first label's start if all labels touch.
    starts: list[float] = []
    taken = 0.0
    for place in order:
        starts.append(taken + sizes[place] / 2)
        taken += sizes[place]
    # Mean offset and number of labels in each group of touching labels.
    pools: list[tuple[float, int]] = []
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
def width(text: str, size: float = SIZE, *, bold: bool = False) -> float:
    """Return the width of a text [pt]."""
    return max(line_width(line, size, bold=bold) for line in text.split("\n"))


bold_width = partial(width, bold=True)
"""Return the width of a bold text [pt]."""
title_width = partial(width, size=TITLE, bold=True)
"""Return the width of a title [pt]."""


def widest(texts: Iterable[str]) -> float:
    """Return the largest of the widths of texts [pt]."""
    return max((width(text) for text in texts), default=0.0)


def height(text: str, size: float = SIZE) -> float:
    """Return the height of all lines of a text [pt]."""
    return LINE_HEIGHT * size * (1 + text.count("\n"))


def across_size(text: str) -> float:
    """Return the length along an edge that a horizontal text needs, with gaps [pt]."""
    return width(text) + 2 * LABEL_GAP


def wrapped(text: str, room: float, measure: Callable[[str], float] = width) -> str:
    r"""Break a text between words into lines no wider than `room`.

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


def shortened(text: str, room: float) -> str:
    """Return a text, cut and ended by an ellipsis if it is wider than `room` [pt].

    >>> shortened("band", 60.0), shortened("low and reverse brake", 60.0)
    ('band', 'low and reve…')
    """
    if width(text) <= room:
        return text

    def cut(end: int) -> str:
        return f"{text[:end].rstrip()}…"

    fitting = bisect_right(range(len(text)), room, key=lambda end: width(cut(end)))
    return cut(max(fitting - 1, 0))


class Label(NamedTuple):
    """Text that names a position on an edge."""

    at: float
    """Position along the edge, from the left or lower end. [pt]"""
    text: str
    colour: str


def ticks(low: float, high: float, most: int) -> list[float]:
    """Return round numbers in a range for a scale, about `most` or fewer.

    >>> ticks(-35.0, 2.0, 5)
    [-30.0, -20.0, -10.0, 0.0]
    """
    if not low < high:
        return [low]
    power = math.floor(math.log10((high - low) / most))
    sizes = [(digit, power + more) for more in (1, 0, -1) for digit in (5, 2, 1)]
    enough = [size for size in sizes if size[0] * 10.0 ** size[1] >= (high - low) / most]
    values: list[float] = []
    # Try the smallest step with at most `most` intervals, then smaller steps, until at least two
    # numbers are in the range.
    for digit, tens in sizes[len(enough) - 1 :]:
        step, parts = digit * 10 ** max(tens, 0), 10 ** max(-tens, 0)
        numbers = range(math.floor(low * parts / step), math.ceil(high * parts / step) + 1)
        values = [number * step / parts for number in numbers]
        values = [value for value in values if low <= value <= high]
        if len(values) > 1:
            break
    return values


def power_of_ten(exponent: int) -> str:
    """Return the text of a power of ten, with the exponent in superscript.

    >>> power_of_ten(-4)
    '10⁻⁴'
    """
    return "10" + "".join("⁰¹²³⁴⁵⁶⁷⁸⁹"[int(c)] if c != "-" else "⁻" for c in str(exponent))
