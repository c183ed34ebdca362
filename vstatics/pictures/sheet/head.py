"""What stands over a picture: title, notes, and the key of the signs that occur in it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from vstatics.pictures.sheet.labels import LINE_HEIGHT, Point, height, title_width, width, wrapped
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import Pen, blank
from vstatics.pictures.sheet.style import MARGIN, SIGN_WIDTH, SIZE, TITLE, Style

AFTER_SIGN, BETWEEN_SIGNS = 5.0, 16.0
"""From a sign to its text, and from this to the next sign. [pt]"""
BELOW_HEAD = 5.0
"""Between title, notes and key. [pt]"""
SIGN_ROW_HEIGHT = LINE_HEIGHT * SIZE + 2.0
"""Of signs. [pt]"""
BELOW: Look = {"va": "top", "linespacing": LINE_HEIGHT}
"""How lines of text are written below a height."""

Meaning = tuple[object, str, str, Look]
"""Whether a sign occurs, what it means in English and in Russian; its look is that of a line, or
of an area if it has a ``facecolor``."""


class KeySign(NamedTuple):
    """A sign of a key with what it means."""

    text: str
    look: Look

    @property
    def wide(self) -> float:
        """With its text [pt]."""
        return SIGN_WIDTH + AFTER_SIGN + width(self.text)

    def draw(self, pen: Pen, x: float, y: float) -> None:
        """At its left end and the middle of its height [pt]."""
        if "facecolor" in self.look:
            pen.box((x, y - 4.0), (SIGN_WIDTH, 8.0), **self.look)
        elif "marker" in self.look:
            pen.line((x + SIGN_WIDTH / 2, y), **self.look)
        else:
            pen.line((x, y), (x + SIGN_WIDTH, y), **self.look)
        pen.text(x + SIGN_WIDTH + AFTER_SIGN, y, self.text, va="center")


def headed(  # noqa: PLR0913 - what stands there, and where
    title: str,
    note: str,
    meanings: Iterable[Meaning],
    size: Point,
    style: Style,
    *,
    margin: float = MARGIN,
) -> Pen:
    """A figure with title, note and key over a picture of a size [pt]; a page has titles.

    >>> look = {"color": "#000000"}
    >>> pen = headed("", "", [(1, "gear", "передача", look), (0, "", "", {})], (99, 9), Style())
    >>> [text.get_text() for text in pen.figure.texts]
    ['gear']
    """
    (wide, high), rows = size, list[list[KeySign]]()
    room = wide - 2 * margin
    for sign in (KeySign(style.text(*said), look) for occurs, *said, look in meanings if occurs):
        last = sum(one.wide + BETWEEN_SIGNS for one in rows[-1]) if rows else room
        if last + sign.wide > room:
            rows.append([])
        rows[-1].append(sign)
    lines: list[tuple[str, float, Look]] = [
        (wrapped(title, room, title_width) * style.titled, TITLE, {"bold": True}),
        (wrapped(note, room), SIZE, {"color": style.soft}),
    ]
    heights = [(height(text, letters) + BELOW_HEAD) * bool(text) for text, letters, _ in lines]
    key = (SIGN_ROW_HEIGHT * len(rows) + BELOW_HEAD) * bool(rows)
    top = high + sum(heights) + key
    pen = blank(wide, top + margin, style)
    for (text, letters, look), own in zip(lines, heights, strict=True):
        pen.text(margin, top, text, size=letters, **look, **BELOW)
        top -= own
    for row in rows:
        x = margin
        for sign in row:
            sign.draw(pen, x, top - SIGN_ROW_HEIGHT / 2)
            x += sign.wide + BETWEEN_SIGNS
        top -= SIGN_ROW_HEIGHT
    return pen
