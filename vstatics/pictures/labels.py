"""Where labels go so that none covers another: along an edge, and wrapped to a width."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, Literal, NamedTuple

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import Affine2D, Transform

from vstatics.pictures.style import FONT, SIZE

POINTS = 72.0
"""In an inch."""
GAP = 3.0
"""Between labels. [pt]"""
LEADER = 16.0
"""Length of the line from an edge to its label. [pt]"""
Point = tuple[float, float]
"""A place of a picture. [pt]"""
LINE = 1.25
"""Height of a line of text over its size, with what stands between lines."""


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
    canvas: Any = FigureCanvasAgg(Figure(dpi=POINTS))
    return canvas.get_renderer()


@cache
def width(text: str, size: float = SIZE) -> float:
    """Width of a text of one or more lines [pt]."""
    font = FontProperties(family=FONT, size=size)
    measure = _renderer().get_text_width_height_descent
    return float(max(measure(line, font, ismath=False)[0] for line in text.split("\n")))


def height(text: str, size: float = SIZE) -> float:
    """Height of a text with its lines [pt]."""
    return LINE * size * (1 + text.count("\n"))


def across_size(text: str) -> float:
    """The part of an edge that a text beside others needs [pt]."""
    return width(text) + 2 * GAP


def wrapped(text: str, room: float, size: float = SIZE) -> str:
    r"""A text in lines that fit into a width, as far as its words do.

    >>> wrapped("carrier and second ring", 60.0)
    'carrier and\nsecond ring'
    """
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and width(longer, size) > room:
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


class Panel(NamedTuple):
    """Axes of a fixed size, in which places can be given in points."""

    axes: Axes
    width: float
    """[pt]"""
    height: float
    """[pt]"""

    def write(self, x: float, y: float, text: str, **how: Any) -> None:
        """A text at a place in points from the lower left corner."""
        self.axes.text(x / self.width, y / self.height, text, transform=self.axes.transAxes, **how)

    def line(self, *places: tuple[float, float], **how: Any) -> None:
        """A line through places in points from the lower left corner, also outside the axes."""
        xs, ys = zip(*places, strict=True)
        self.axes.plot(
            [x / self.width for x in xs],
            [y / self.height for y in ys],
            transform=self.axes.transAxes,
            clip_on=False,
            **how,
        )

    def box(self, corner: tuple[float, float], size: tuple[float, float], **how: Any) -> None:
        """A rectangle by its lower left corner and its size in points, also outside the axes."""
        (x, y), (wide, high) = corner, size
        place = (x / self.width, y / self.height), wide / self.width, high / self.height
        drawn = Rectangle(*place, transform=self.axes.transAxes, clip_on=False, **how)
        self.axes.add_patch(drawn)

    def across(self, x: float) -> float:
        """The place of an abscissa [pt]."""
        low, high = self.axes.get_xlim()
        return (x - low) / (high - low) * self.width

    def up(self, y: float) -> float:
        """The place of an ordinate [pt]."""
        low, high = self.axes.get_ylim()
        return (y - low) / (high - low) * self.height

    def beside(self, side: Literal["left", "right"], labels: Sequence[Label]) -> None:
        """Labels at the left or right edge, each with a line to its place."""
        sizes = [height(label.text) + GAP for label in labels]
        places = spread([label.at for label in labels], sizes, 0.0, self.height)
        edge, way = (0.0, -1.0) if side == "left" else (self.width, 1.0)
        for label, place in zip(labels, places, strict=True):
            ends = ((edge, label.at), (edge + 0.8 * LEADER * way, place))
            self.line(*ends, color=label.colour, linewidth=0.7)
            aligned = {"ha": "right" if side == "left" else "left", "va": "center"}
            x = edge + LEADER * way
            self.write(x, place, label.text, **aligned)

    def along(
        self, edge: Literal["bottom", "top"], labels: Sequence[Label], *, upright: bool
    ) -> None:
        """Labels at the lower or upper edge, each with a line to its place.

        Parameters
        ----------
        upright : bool
            Texts run upwards, and need little room along the edge.
        """
        sizes = [height(one.text) + GAP if upright else across_size(one.text) for one in labels]
        places = spread([label.at for label in labels], sizes, 0.0, self.width)
        start, way = (0.0, -1.0) if edge == "bottom" else (self.height, 1.0)
        for label, place in zip(labels, places, strict=True):
            ends = ((label.at, start), (place, start + 0.5 * LEADER * way))
            self.line(*ends, color=label.colour, linewidth=0.7)
            aligned = {"ha": "center", "va": "top" if edge == "bottom" else "bottom"}
            y = start + 0.65 * LEADER * way
            turned = {"rotation": 90} if upright else {}
            self.write(place, y, label.text, **aligned, **turned)


class Paper(NamedTuple):
    """A figure without axes, which take most of the time: places in points from its lower left."""

    figure: Figure

    @property
    def _points(self) -> Transform:
        return Affine2D().scale(1 / POINTS) + self.figure.dpi_scale_trans

    def write(self, x: float, y: float, text: str, **how: Any) -> None:
        """A text at a place."""
        self.figure.text(x, y, text, transform=self._points, **how)

    def line(self, *places: Point, **how: Any) -> None:
        """A line through places."""
        xs, ys = zip(*places, strict=True)
        self.add(Line2D(xs, ys, **how))

    def add(self, artist: Artist) -> None:
        """An artist whose places are in points: a patch, a line."""
        artist.set_transform(self._points)
        self.figure.add_artist(artist)


def ticks(low: float, high: float, most: int) -> list[float]:
    """Round numbers between two, for a scale.

    >>> ticks(-35.0, 2.0, 5)
    [-30.0, -20.0, -10.0, 0.0]
    """
    found = MaxNLocator(most, steps=[1, 2, 5, 10]).tick_values(low, high)
    return [float(one) for one in found if low <= one <= high]


def figure(wide: float, high: float) -> Figure:
    """A figure of a size in points."""
    return Figure(figsize=(wide / POINTS, high / POINTS))


def panel(figure: Figure, left: float, bottom: float, wide: float, high: float) -> Panel:
    """Axes at a place of a figure, all in points."""
    across, up = (POINTS * length for length in figure.get_size_inches())
    axes = figure.add_axes((left / across, bottom / up, wide / across, high / up))
    return Panel(axes, wide, high)
