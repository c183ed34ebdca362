"""How pictures look: language, colours for paper and for a dark screen."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vstatics.statics.results import Language

FONT = "DejaVu Sans"
"""It comes with matplotlib and has Cyrillic letters."""
SIZE = 8.0
"""Of texts. [pt]"""
TITLE = 10.0
"""Of titles. [pt]"""

# Okabe and Ito, Color Universal Design (2008): told apart also by the colour-blind
_ON_PAPER = ("#0072b2", "#d55e00", "#009e73", "#b8578f", "#a07800", "#3f97cc", "#6a4c93")
_ON_BLACK = ("#56b4e9", "#ff9248", "#2fd0a0", "#e89ac7", "#f0e442", "#9fd0f0", "#b9a3e3")
HATCHES = ("", "////", "xxxx", "....", "----")
LARGE = 1e6
"""From here on numbers are written with a power of ten."""


class Style(NamedTuple):
    """How a picture looks.

    Parameters
    ----------
    language : {"en", "ru"}
        Of axes and titles; names are those of the case.
    dark : bool
        Light on dark, for a screen.
    """

    language: Language = "en"
    dark: bool = False

    def text(self, english: str, russian: str) -> str:
        """A text in the language of the picture.

        >>> Style("ru").text("efficiency", "КПД")
        'КПД'
        """
        return russian if self.language == "ru" else english

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
        """Of what stands behind."""
        return "#5a616b" if self.dark else "#b0b0b0"

    @property
    def soft(self) -> str:
        """Of texts that matter less."""
        return "#a0a8b2" if self.dark else "#757575"

    @property
    def accent(self) -> str:
        """Of what is engaged, or lost."""
        return "#ff7a5c" if self.dark else "#c8391f"

    @property
    def colours(self) -> tuple[str, ...]:
        """To tell lines and areas apart."""
        return _ON_BLACK if self.dark else _ON_PAPER

    def colour(self, number: int) -> str:
        """The colour of the line or area of a number, from 0; they come again."""
        return self.colours[number % len(self.colours)]

    def hatch(self, number: int) -> str:
        """What tells areas of one colour apart.

        >>> Style().hatch(6), Style().hatch(7)
        ('', '////')
        """
        return HATCHES[number // len(self.colours) % len(HATCHES)]

    @property
    def settings(self) -> dict[Any, Any]:
        """The settings of matplotlib."""
        inked = ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color")
        return {
            **dict.fromkeys(inked, self.ink),
            "font.family": FONT,
            "font.size": SIZE,
            "axes.titlesize": TITLE,
            "figure.facecolor": self.paper,
            "axes.facecolor": self.paper,
            "savefig.facecolor": self.paper,
            "legend.facecolor": self.paper,
            "legend.edgecolor": self.faint,
            "grid.color": self.faint,
            "text.parse_math": False,  # names of links may have any letters
            "svg.hashsalt": "vstatics",
            "pdf.fonttype": 42,
        }


def number(value: float) -> str:
    """A number for a picture, short enough for its place; a dash for what does not exist.

    >>> [number(value) for value in (2.6428571, -251.0, 1e7, -0.00001, float("nan"))]
    ['2.643', '-251.0', '1e+07', '0.000', '–']
    """
    if not math.isfinite(value):
        return "–"
    if abs(value) >= LARGE:
        return f"{value:.4g}"
    decimals = 3 - sum(abs(value) >= bound for bound in (10, 100, 1000))
    return f"{value:z.{decimals}f}"
