"""Heading of a picture: title, note, and key of the symbols that occur."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from operator import attrgetter
from typing import NamedTuple

from vstatics.core.groups import filled
from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, title_width, width, wrapped
from vstatics.pictures.drawing.pen import Pen, blank
from vstatics.pictures.drawing.style import MARGIN, SIGN_WIDTH, SIZE, TITLE, Style

AFTER_SIGN, BETWEEN_SIGNS = 5.0, 16.0
"""Distances from a symbol to the following text, and from the text to the next symbol. [pt]"""
BELOW_HEAD = 5.0
"""Vertical distance between title, note and key. [pt]"""
SIGN_ROW_HEIGHT = LINE_HEIGHT * SIZE + 2.0
"""Height of a row of the key. [pt]"""
BELOW: Look = {"va": "top", "linespacing": LINE_HEIGHT}
"""Alignment of texts whose upper edge is at a given height."""


class NameInKey(str):
    """Text of a key that is a name in the case, and so is not translated."""

    __slots__ = ()


Meaning = tuple[object, str, Look]
"""Entry of a key: true for a symbol that occurs, the meaning in English, and the style.

The symbol is an area if the style has a ``facecolor``, otherwise a line.
"""


class KeySign(NamedTuple):
    """Symbol of a key with the meaning, which is wrapped into lines."""

    text: str
    look: Look

    @property
    def wide(self) -> float:
        """Width of symbol and text [pt]."""
        return SIGN_WIDTH + AFTER_SIGN + width(self.text)

    @property
    def high(self) -> float:
        """Height of symbol and text [pt]."""
        return SIGN_ROW_HEIGHT + height(self.text) - height("")

    def draw(self, pen: Pen, x: float, top: float) -> None:
        """Draw the symbol and the text, with the upper left corner at (`x`, `top`) [pt]."""
        y = top - SIGN_ROW_HEIGHT / 2
        if "facecolor" in self.look:
            pen.box((x, y - 4.0), (SIGN_WIDTH, 8.0), **self.look)
        elif "marker" in self.look:
            pen.line((x + SIGN_WIDTH / 2, y), **self.look)
        else:
            pen.line((x, y), (x + SIGN_WIDTH, y), **self.look)
        for number, line in enumerate(self.text.split("\n")):
            at = y - number * LINE_HEIGHT * SIZE
            pen.text(x + SIGN_WIDTH + AFTER_SIGN, at, line, va="center")


def rows_of(signs: Iterable[KeySign], room: float) -> list[list[KeySign]]:
    """Return symbols side by side, in rows no wider than `room` [pt]."""
    return [row for row in filled(signs, room, attrgetter("wide"), BETWEEN_SIGNS) if row]


class SheetHead(NamedTuple):
    """Title, note and key of a picture, wrapped to a given width."""

    lines: Sequence[tuple[str, float, Look]]
    """Texts, each with the height including a gap [pt] and the style."""
    rows: Sequence[Sequence[KeySign]]
    high: float
    """Total height with a gap below; 0 without title, note and key. [pt]"""

    def over(self, size: Point, margin: float, style: Style) -> Pen:
        """Return a pen for a picture of a given size [pt], below the heading on a new canvas."""
        top = size[1] + self.high
        pen = blank(size[0], top + margin, style)
        for text, high, look in self.lines:
            pen.text(margin, top, text, **look, **BELOW)
            top -= high
        for row in self.rows:
            x = margin
            for sign in row:
                sign.draw(pen, x, top)
                x += sign.wide + BETWEEN_SIGNS
            top -= max(sign.high for sign in row)
        return pen


def sheet_head(
    title: str, note: str, meanings: Iterable[Meaning], room: float, style: Style
) -> SheetHead:
    """Return the heading of a picture for a width [pt]. HTML pages show the title separately.

    >>> look = {"color": "#000000"}
    >>> head = sheet_head("", "", [(1, "gear", look), (0, "", {})], 99.0, Style())
    >>> [[sign.text for sign in row] for row in head.rows]
    [['gear']]
    """
    text_room = room - SIGN_WIDTH - AFTER_SIGN
    named = (
        (said if isinstance(said, NameInKey) else style.text(said), look)
        for occurs, said, look in meanings
        if occurs
    )
    rows = rows_of((KeySign(wrapped(text, text_room), look) for text, look in named), room)
    texts: list[tuple[str, Look]] = [
        (wrapped(title, room, title_width) * style.titled, {"size": TITLE, "bold": True}),
        (wrapped(note, room), {"size": SIZE, "color": style.soft}),
    ]
    lines = [(text, height(text, look["size"]) + BELOW_HEAD, look) for text, look in texts if text]
    key = (sum(max(sign.high for sign in row) for row in rows) + BELOW_HEAD) * bool(rows)
    return SheetHead(lines, rows, sum(high for _, high, _ in lines) + key)


def headed(title: str, note: str, meanings: Iterable[Meaning], size: Point, style: Style) -> Pen:
    """Return a pen for panels of a given size [pt], below title, note and key on a new canvas."""
    head = sheet_head(title, note, meanings, size[0] - 2 * MARGIN, style)
    return head.over(size, MARGIN, style)
