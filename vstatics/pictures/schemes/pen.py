"""Lines, shapes and text in points on a figure; the same for all schemes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.labels import POINTS_PER_INCH, Point
from vstatics.pictures.sheet.style import FONT, SIZE, Style
from vstatics.pictures.sheet.svg import halo, told

SMALL = SIZE - 1
"""Of text that matters less. [pt]"""
LINE_WIDTH = 1.3
"""Width of a line. [pt]"""
WRAP = 14
"""Longer names are broken at blanks. [letters]"""


def wrapped(name: str, letters: int = WRAP) -> str:
    """A name on as many lines as it needs.

    >>> wrapped("low and reverse brake").split(chr(10))
    ['low and', 'reverse brake']
    """
    lines: list[str] = []
    for word in name.split():
        if lines and len(lines[-1]) + 1 + len(word) <= letters:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return "\n".join(lines)


class Window(NamedTuple):
    """A rectangle of a figure, in which a picture is drawn smaller."""

    figure: Figure
    corner: Point
    """Lower left, from that of the figure. [pt]"""
    size: Point
    """[pt]"""
    letters: float = 1.0
    """Size of letters over what they would have."""


class Pen:
    """Draws on a figure of a given size, with points as its unit.

    Parameters
    ----------
    low, high : (float, float)
        Corners of the picture. [pt]
    style : Style
    within : Window, optional
        Where on another figure it stands, as large as has room there, and no larger than it is.
    """

    def __init__(self, low: Point, high: Point, style: Style, within: Window | None = None) -> None:
        """Make the figure, or its place in another one."""
        self.style = style
        own = high[0] - low[0], high[1] - low[1]
        if within is None:
            within = Window(labels.figure(*own), (0.0, 0.0), own)
        self.figure = within.figure
        self.scale = min(1.0, *(room / size for room, size in zip(within.size, own, strict=True)))
        self.letters = within.letters
        left, bottom = (
            start + (room - length * self.scale) / 2
            for start, room, length in zip(within.corner, within.size, own, strict=True)
        )
        place = Affine2D().translate(-low[0], -low[1]).scale(self.scale).translate(left, bottom)
        self._place = place.scale(1 / POINTS_PER_INCH) + self.figure.dpi_scale_trans

    def line(self, *points: Point, color: str, width: float = LINE_WIDTH, **more: Any) -> None:
        """A line through points; for further parameters see `lines`."""
        self.lines([points], color=color, width=width, **more)

    def lines(
        self,
        lines: Iterable[Sequence[Point]],
        *,
        color: str,
        width: float = LINE_WIDTH,
        zorder: float = 3,
        title: str = "",
        **more: Any,
    ) -> None:
        """Lines through points, as one path."""
        vertices: list[Point] = []
        codes: list[int] = []
        for points in lines:
            vertices += points
            codes += [int(Path.MOVETO), *[int(Path.LINETO)] * (len(points) - 1)]
        if vertices:
            look = {"facecolor": "none", "edgecolor": color, "linewidth": width * self.scale}
            look = {"capstyle": "butt", "joinstyle": "round", "zorder": zorder, **look, **more}
            self._add(PathPatch(Path(vertices, codes), **look), title)

    def dots(self, places: Iterable[Point], color: str) -> None:
        """Where wires are joined: lines too short to be seen, with round ends."""
        short = [((x, y), (x + 0.1, y)) for x, y in places]
        self.lines(short, color=color, width=4.6, zorder=6, capstyle="round", snap=False)

    def shape(
        self,
        points: Sequence[Point],
        *,
        fill: str,
        edge: str,
        width: float = LINE_WIDTH,
        title: str = "",
    ) -> None:
        """A filled polygon."""
        look: dict[str, Any] = {"facecolor": fill, "edgecolor": edge, "joinstyle": "round"}
        look["linewidth"] = width * self.scale
        self._add(Polygon(points, closed=True, zorder=4, **look), title)

    def _add(self, artist: Artist, title: str) -> None:
        artist.set_transform(self._place)
        if title:
            artist.set_gid(told(title))
        self.figure.add_artist(artist)

    def text(  # noqa: PLR0913 - a text has these
        self,
        at: Point,
        text: str,
        *,
        color: str,
        size: float = SIZE,
        across: str = "center",
        up: str = "center",
        bold: bool = False,
        title: str = "",
        over: bool = False,
    ) -> None:
        """Text over any line; with paper around its letters where it stands `over` lines."""
        if not text:
            return
        more: dict[str, Any] = halo(self.style, title) if over else {}
        if title and not over:
            more = {"gid": told(title)}
        self.figure.text(
            *at,
            text,
            color=color,
            fontsize=size * self.scale * self.letters,
            family=FONT,
            weight="bold" if bold else "normal",
            ha=across,
            va=up,
            zorder=8,
            linespacing=1.0,
            transform=self._place,
            **more,
        )

    def arrow(self, tip: Point, way: float, color: str) -> None:
        """The head of an arrow to the right (way 1) or left (-1)."""
        x, y = tip
        points = [(x, y), (x - 9 * way, y + 3.5), (x - 9 * way, y - 3.5)]
        self.shape(points, fill=color, edge=color, width=0.5)

    def hatched(self, low: Point, high: Point, color: str, zorder: float = 1) -> None:
        """Slanted lines within a rectangle."""
        (left, bottom), (right, top) = low, high
        lines = []
        step = 5.0
        start = left - (top - bottom)
        while start < right:
            first, last = max(start, left), min(start + top - bottom, right)
            if last - first > 1:
                lines.append(((first, bottom + first - start), (last, bottom + last - start)))
            start += step
        self.lines(lines, color=color, width=0.5, zorder=zorder)


def ground(at: Point, side: int) -> list[tuple[Point, Point]]:
    """A piece of the housing at a point: a line with strokes toward a side."""
    x, y = at
    middles = [x - 9 + 6 * (number + 0.5) for number in range(3)]
    strokes = [((middle - 3.0, y), (middle + 1.5, y + 5 * side)) for middle in middles]
    return [((x - 10, y), (x + 10, y)), *strokes]
