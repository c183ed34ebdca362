"""What stands over a chart: title, notes, and the key of the signs that occur in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from vstatics.pictures.sheet.labels import LINE_HEIGHT, Paper, height, width, wrapped
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.style import SIZE, TITLE, Style

SIGN_WIDTH = 20.0
"""Width of a sign. [pt]"""
AFTER, APART = 5.0, 16.0
"""From a sign to its text, and from this to the next sign. [pt]"""
BELOW_HEAD = 5.0
"""Between title, notes and key. [pt]"""
ROW = LINE_HEIGHT * SIZE + 2.0
"""Of signs. [pt]"""


class KeySign(NamedTuple):
    """A sign of a key with what it means."""

    text: str
    look: Look
    """Of a line, or of an area if it has a ``facecolor``."""

    @property
    def wide(self) -> float:
        """With its text [pt]."""
        return SIGN_WIDTH + AFTER + width(self.text)

    def draw(self, paper: Paper, x: float, y: float) -> None:
        """At its left end and the middle of its height [pt]."""
        if "facecolor" in self.look:
            paper.add(Rectangle((x, y - 4.0), SIGN_WIDTH, 8.0, **self.look))
        elif "marker" in self.look:
            paper.line((x + SIGN_WIDTH / 2, y), **self.look)
        else:
            how: Look = {"solid_capstyle": "butt", **self.look}
            paper.add(Line2D([x, x + SIGN_WIDTH], [y, y], **how))
        paper.write(x + SIGN_WIDTH + AFTER, y, self.text, va="center")


class ChartHead(NamedTuple):
    """Title, notes and key in a width."""

    title: str
    note: str
    rows: Sequence[Sequence[KeySign]]

    @property
    def high(self) -> float:
        """All of it, with a gap below; 0 without a text [pt]."""
        parts = [height(self.title, TITLE)] * bool(self.title) + [height(self.note)] * bool(
            self.note
        )
        if self.rows:
            parts.append(ROW * len(self.rows))
        return sum(parts) + BELOW_HEAD * len(parts)

    def draw(self, paper: Paper, left: float, top: float, style: Style) -> None:
        """From its upper left corner [pt]."""
        how: dict[str, Any] = {"va": "top", "linespacing": LINE_HEIGHT}
        if self.title:
            paper.write(left, top, self.title, weight="bold", fontsize=TITLE, **how)
            top -= height(self.title, TITLE) + BELOW_HEAD
        if self.note:
            paper.write(left, top, self.note, color=style.soft, **how)
            top -= height(self.note) + BELOW_HEAD
        for row in self.rows:
            x = left
            for sign in row:
                sign.draw(paper, x, top - ROW / 2)
                x += sign.wide + APART
            top -= ROW


def chart_head(
    title: str, note: str, signs: Sequence[KeySign], room: float, style: Style
) -> ChartHead:
    """What stands over a chart in a width [pt]; a page has titles of its own."""
    rows: list[list[KeySign]] = []
    for sign in signs:
        last = sum(one.wide + APART for one in rows[-1]) if rows else room
        if last + sign.wide > room:
            rows.append([])
        rows[-1].append(sign)
    head = wrapped(title, room, TITLE, bold=True) if style.titled else ""
    return ChartHead(head, wrapped(note, room) if note else "", rows)
