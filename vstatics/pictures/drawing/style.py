"""How pictures look: language, colours for paper and for a dark screen."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vstatics.core.tables.numbers import typeset
from vstatics.core.texts import Language, translated

FONT = "DejaVu Sans"
"""It comes with matplotlib and has Cyrillic letters."""
FAMILIES = "DejaVu Sans, Verdana, Bitstream Vera Sans, sans-serif"
"""Of texts in SVG; the first three have letters of the same width."""
HINTING: dict[Any, Any] = {"text.hinting": "none"}
"""A setting of matplotlib; with others stems of single capitals become one pixel wide."""
SIZE = 8.0
"""Of texts. [pt]"""
TITLE = 10.0
"""Of titles. [pt]"""
SMALL = SIZE - 1
"""Of texts in schemes that matter less. [pt]"""

# lengths that several pictures have, in points
MARGIN = 12.0
"""Around panels, and between what stands beside them and the edge."""
WIDE_MARGIN = 14.0
"""Around levers, schemes and flows of power."""
TICK_LENGTH = 3.0
"""Of a mark of a scale."""
FRAME_WIDTH = 0.8
"""Of lines around a panel."""
LEADER_WIDTH = 0.6
"""Of the lines that lead to names."""
SIGN_WIDTH = 20.0
"""Of a sign of a key, or before a name."""
LONG_NAME = 110.0
"""Names of links and devices beside panels are wrapped to this width, ..."""
SHORT_NAME = 84.0
"""... and those within a picture to this."""
SMALL_NUMBER = 7.0
"""Size of numbers within a picture."""

POINTS_PER_MILLIMETRE = 72 / 25.4
PAGE_WIDTH, PAGE_HEIGHT = 170 * POINTS_PER_MILLIMETRE, 240 * POINTS_PER_MILLIMETRE
"""What a page of a report has room for. [pt]"""

# Found by a search: in normal sight, without red and without green cones (Machado et al. 2009)
# any two are .12 apart in OKLab, and .09 from ink, faint and engaged; each has a contrast of
# 3 to 1 with the paper (WCAG 2.2, 1.4.11).
_ON_PAPER = ("#0c4cff", "#d9780c", "#045965", "#7300af", "#a25500", "#8788ef", "#2a9693")
_ON_BLACK = ("#5aa5ff", "#fca03c", "#cac3dd", "#e059a9", "#b47c2e", "#7d5cf2", "#f2f046")
DASHES: tuple[str | tuple[float, tuple[float, ...]], ...] = (
    "solid",
    (0, (6, 2)),
    (0, (2, 1.5)),
    (0, (8, 2, 2, 2)),
    (0, (4, 1, 1, 1, 1, 1)),
)
"""Of the first seven lines, of the next seven, ..."""
LARGE_NUMBER = 1e6
"""From here on numbers are written with a power of ten."""


class Excitation(NamedTuple):
    """What excites a case that vibrates, where a picture is asked for other than its own."""

    orders: tuple[float, ...] = ()
    """Of the speed of a link; those of the engine when not given. [-]"""
    at: str = ""
    """Name or number of the link; the input when not given."""
    speeds: tuple[float, ...] = ()
    """At which the input runs, besides those that the case tells. [rpm]"""
    shown: tuple[float, float] | None = None
    """Range of speeds across the picture; chosen by the case when not given. [rpm]"""


class Style(NamedTuple):
    """How a picture looks.

    Parameters
    ----------
    language : {"en", "ru"}
        Of axes and titles; names are those of the case.
    dark : bool
        Light on dark, for a screen.
    titled : bool
        With a title; a page has its own.
    wheels : bool
        Stick diagrams with names and teeth of wheels.
    merged : bool
        Two sets with two common links are one lever.
    ordered : bool
        Sets of stick diagrams stand in the order of the case.
    width, height : float
        That no page exceeds; an endless height is one page. [pt]
    excited : Excitation
        What pictures of vibration are excited by.
    """

    language: Language = "en"
    dark: bool = False
    titled: bool = True
    wheels: bool = False
    merged: bool = False
    ordered: bool = False
    width: float = PAGE_WIDTH
    height: float = math.inf
    excited: Excitation = Excitation()

    def text(self, english: str, /, **places: object) -> str:
        """A text in the language of the picture; see `vstatics.core.texts`.

        >>> Style("ru").text("efficiency")
        'КПД'
        """
        return translated(english, self.language, **places)

    @property
    def paper(self) -> str:
        """The background; white is readable on any screen."""
        return "#14171c" if self.dark else "#ffffff"

    @property
    def ink(self) -> str:
        """Of texts and main lines."""
        return "#e6e6e6" if self.dark else "#1a1a1a"

    @property
    def faint(self) -> str:
        """Of lines that stand behind, or carry nothing; never of texts."""
        return "#5a616b" if self.dark else "#b0b0b0"

    @property
    def soft(self) -> str:
        """Of texts that matter less; contrast 4.5 to 1 (WCAG 2.2, 1.4.3), like the next three."""
        return "#a0a8b2" if self.dark else "#6b6b6b"

    @property
    def engaged(self) -> str:
        """Of shift elements that are engaged."""
        return "#ff7a8c" if self.dark else "#a0003c"

    @property
    def lost(self) -> str:
        """Of what is lost, in numbers and areas."""
        return "#ffb454" if self.dark else "#c25400"

    @property
    def circulating(self) -> str:
        """Of power that goes round."""
        return "#b9a0ff" if self.dark else "#6a3fb0"

    @property
    def power(self) -> str:
        """Of bands of power."""
        return "#3c6a94" if self.dark else "#8fbbe0"

    @property
    def colours(self) -> tuple[str, ...]:
        """To tell lines and areas apart."""
        return _ON_BLACK if self.dark else _ON_PAPER

    def colour(self, number: int) -> str:
        """The colour of the line or area of a number, from 0; they come again."""
        return self.colours[number % len(self.colours)]

    def dash(self, number: int) -> str | tuple[float, tuple[float, ...]]:
        """What tells lines of one colour apart.

        >>> Style().dash(6), Style().dash(7)
        ('solid', (0, (6, 2)))
        """
        return DASHES[number // len(self.colours) % len(DASHES)]

    @property
    def settings(self) -> dict[Any, Any]:
        """The settings of matplotlib."""
        return {
            "text.color": self.ink,
            "font.family": FONT,
            "font.size": SIZE,
            "figure.facecolor": self.paper,
            "savefig.facecolor": self.paper,
            "text.parse_math": False,  # names of links may have any letters
            "svg.hashsalt": "vstatics",
            "svg.fonttype": "none",
            **HINTING,
            "lines.solid_capstyle": "butt",
            "lines.dash_capstyle": "butt",
            "pdf.fonttype": 42,
        }


def number(value: float) -> str:
    """A number for a picture, short enough for its place; a dash for what does not exist.

    >>> [number(value) for value in (2.6428571, -251.0, 1e7, -0.00001, float("nan"))]
    ['2.643', '−251.0', '1e+07', '0.000', '–']
    >>> number(100.0), number(99.99999999999999)
    ('100.0', '100.0')
    """
    if not math.isfinite(value):
        return "–"
    size = abs(float(f"{value:.4g}"))  # so the last bits of 100 do not choose its digits
    if size >= LARGE_NUMBER:
        return typeset(f"{value:.4g}")
    decimals = 3 - sum(size >= bound for bound in (10, 100, 1000))
    return typeset(f"{value:z.{decimals}f}")
