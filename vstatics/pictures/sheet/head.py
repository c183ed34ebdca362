"""What stands over a picture: title, notes, and the key of the signs that occur in it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.pictures.sheet.labels import LINE_HEIGHT, height, title_width, width, wrapped
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import Pen, blank
from vstatics.pictures.sheet.style import SIGN_WIDTH, SIZE, TITLE, Style

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


class SheetHead(NamedTuple):
    """Title, notes and key in a width."""

    title: str
    note: str
    rows: Sequence[Sequence[KeySign]]
    style: Style

    @property
    def high(self) -> float:
        """All of it, with a gap below; 0 without a text [pt]."""
        title, note = height(self.title, TITLE) + BELOW_HEAD, height(self.note) + BELOW_HEAD
        key = SIGN_ROW_HEIGHT * len(self.rows) + BELOW_HEAD
        return title * bool(self.title) + note * bool(self.note) + key * bool(self.rows)

    def over(self, wide: float, high: float, margin: float) -> Pen:
        """A figure with the head over a picture of a size [pt]."""
        top = high + self.high
        pen = blank(wide, top + margin, self.style)
        if self.title:
            pen.text(margin, top, self.title, bold=True, size=TITLE, **BELOW)
            top -= height(self.title, TITLE) + BELOW_HEAD
        if self.note:
            pen.text(margin, top, self.note, color=self.style.soft, **BELOW)
            top -= height(self.note) + BELOW_HEAD
        for row in self.rows:
            x = margin
            for sign in row:
                sign.draw(pen, x, top - SIGN_ROW_HEIGHT / 2)
                x += sign.wide + BETWEEN_SIGNS
            top -= SIGN_ROW_HEIGHT
        return pen


def sheet_head(
    title: str, note: str, meanings: Iterable[Meaning], room: float, style: Style
) -> SheetHead:
    """What stands over a picture in a width [pt]; a page has titles of its own.

    >>> look = {"color": "#000000"}
    >>> found = sheet_head("", "", [(1, "gear", "передача", look), (0, "", "", {})], 99.0, Style())
    >>> [[sign.text for sign in row] for row in found.rows]
    [['gear']]
    """
    rows: list[list[KeySign]] = []
    for sign in (KeySign(style.text(*said), look) for occurs, *said, look in meanings if occurs):
        last = sum(one.wide + BETWEEN_SIGNS for one in rows[-1]) if rows else room
        if last + sign.wide > room:
            rows.append([])
        rows[-1].append(sign)
    head = wrapped(title, room, title_width) if style.titled else ""
    return SheetHead(head, wrapped(note, room), rows, style)
