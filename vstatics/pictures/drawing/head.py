"""What stands over a picture: title, notes, and the key of the signs that occur in it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.labels import LINE_HEIGHT, Point, height, title_width, width, wrapped
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import Pen, blank
from vstatics.pictures.drawing.style import MARGIN, SIGN_WIDTH, SIZE, TITLE, Style

AFTER_SIGN, BETWEEN_SIGNS = 5.0, 16.0
"""From a sign to its text, and from this to the next sign. [pt]"""
BELOW_HEAD = 5.0
"""Between title, notes and key. [pt]"""
SIGN_ROW_HEIGHT = LINE_HEIGHT * SIZE + 2.0
"""Of signs. [pt]"""
BELOW: Look = {"va": "top", "linespacing": LINE_HEIGHT}
"""How lines of text are written below a height."""


class NameInKey(str):
    """A name of the case in a key, which no language changes."""

    __slots__ = ()


Meaning = tuple[object, str, Look]
"""Whether a sign occurs, what it means in English; its look is that of a line, or
of an area if it has a ``facecolor``."""


class KeySign(NamedTuple):
    """A sign of a key with what it means, in lines."""

    text: str
    look: Look

    @property
    def wide(self) -> float:
        """With its text [pt]."""
        return SIGN_WIDTH + AFTER_SIGN + width(self.text)

    @property
    def high(self) -> float:
        """Of its row [pt]."""
        return SIGN_ROW_HEIGHT + height(self.text) - height("")

    def draw(self, pen: Pen, x: float, top: float) -> None:
        """At its left end, below a height [pt]; the sign beside the first line."""
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


class SheetHead(NamedTuple):
    """Title, note and key in a width."""

    lines: Sequence[tuple[str, float, Look]]
    """Texts, each with its height and a gap [pt]."""
    rows: Sequence[Sequence[KeySign]]
    high: float
    """All of it, with a gap below; 0 without a text. [pt]"""

    def over(self, size: Point, margin: float, style: Style) -> Pen:
        """A figure with the head over a picture of a size [pt]."""
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


def _in_key(said: str, style: Style) -> str:
    return said if isinstance(said, NameInKey) else style.text(said)


def sheet_head(
    title: str, note: str, meanings: Iterable[Meaning], room: float, style: Style
) -> SheetHead:
    """What stands over a picture in a width [pt]; a page has titles of its own.

    >>> look = {"color": "#000000"}
    >>> found = sheet_head("", "", [(1, "gear", look), (0, "", {})], 99.0, Style())
    >>> [[sign.text for sign in row] for row in found.rows]
    [['gear']]
    """
    rows: list[list[KeySign]] = []
    beside = room - SIGN_WIDTH - AFTER_SIGN
    for said, look in ((_in_key(said, style), look) for occurs, said, look in meanings if occurs):
        sign = KeySign(wrapped(said, beside), look)
        last = sum(one.wide + BETWEEN_SIGNS for one in rows[-1]) if rows else room
        if last + sign.wide > room:
            rows.append([])
        rows[-1].append(sign)
    texts: list[tuple[str, Look]] = [
        (wrapped(title, room, title_width) * style.titled, {"size": TITLE, "bold": True}),
        (wrapped(note, room), {"size": SIZE, "color": style.soft}),
    ]
    lines = [(text, height(text, look["size"]) + BELOW_HEAD, look) for text, look in texts if text]
    key = (sum(max(sign.high for sign in row) for row in rows) + BELOW_HEAD) * bool(rows)
    return SheetHead(lines, rows, sum(high for _, high, _ in lines) + key)


def headed(title: str, note: str, meanings: Iterable[Meaning], size: Point, style: Style) -> Pen:
    """A figure with title, note and key over panels of a size with their margins [pt]."""
    head = sheet_head(title, note, meanings, size[0] - 2 * MARGIN, style)
    return head.over(size, MARGIN, style)
