"""Style of pictures: language, and colours for paper and for a dark screen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from vstatics.core.tables.numbers import typeset
from vstatics.core.texts import Language, translated

FONT = "DejaVu Sans"
"""Font that comes with matplotlib and has Cyrillic letters."""
FAMILIES = "DejaVu Sans, Verdana, Bitstream Vera Sans, sans-serif"
"""Font families of SVG texts. The first three have letters of equal width."""
HINTING: dict[Any, Any] = {"text.hinting": "none"}
"""Setting of matplotlib that switches off hinting, which would change the stems of capitals."""
SIZE = 8.0
"""Size of texts. [pt]"""
TITLE = 10.0
"""Size of titles. [pt]"""
SMALL = SIZE - 1
"""Size of less important texts in diagrams. [pt]"""

# The following lengths, in points, are common to several pictures.
MARGIN = 12.0
"""Margin around panels and texts. [pt]"""
WIDE_MARGIN = 14.0
"""Margin around levers, schemes and power flows. [pt]"""
TICK_LENGTH = 3.0
"""Length of a tick mark of a scale. [pt]"""
FRAME_WIDTH = 0.8
"""Width of lines around a panel. [pt]"""
LEADER_WIDTH = 0.6
"""Width of leader lines to names. [pt]"""
SIGN_WIDTH = 20.0
"""Length of a line sample in a key, or before a name. [pt]"""
LONG_NAME = 110.0
"""Width to which names of links and components next to panels are wrapped. [pt]"""
SHORT_NAME = 84.0
"""Width to which names within a picture are wrapped. [pt]"""
SMALL_NUMBER = 7.0
"""Size of numbers within a picture. [pt]"""

POINTS_PER_MILLIMETRE = 72 / 25.4
PAGE_WIDTH, PAGE_HEIGHT = 170 * POINTS_PER_MILLIMETRE, 240 * POINTS_PER_MILLIMETRE
"""Width and height of the text area of a page. [pt]"""

# The colours were found by a search. For normal vision, and for vision without red or green cones
# (Machado et al. 2009), any two colours differ by at least 0.12 in OKLab, and by 0.09 from the
# colours `ink`, `faint` and `engaged`. Each has a contrast of 3 to 1 with the paper (WCAG 2.2,
# 1.4.11).
_ON_PAPER = ("#0c4cff", "#d9780c", "#045965", "#7300af", "#a25500", "#8788ef", "#2a9693")
_ON_BLACK = ("#5aa5ff", "#fca03c", "#cac3dd", "#e059a9", "#b47c2e", "#7d5cf2", "#f2f046")
DASHES: tuple[str | tuple[float, tuple[float, ...]], ...] = (
    "solid",
    (0, (6, 2)),
    (0, (2, 1.5)),
    (0, (8, 2, 2, 2)),
    (0, (4, 1, 1, 1, 1, 1)),
)
"""Dash patterns: the first for the first seven lines, the second for the next seven, and so on."""
LARGE_NUMBER = 1e6
"""Magnitude from which numbers are written with a power of ten."""


class Excitation(NamedTuple):
    """Excitation of a vibrating case for pictures, instead of the excitation in the case."""

    orders: tuple[float, ...] = ()
    """Excitation orders, relative to the speed of the link `at`; by default the engine's orders.
    [-]
    """
    at: str = ""
    """Name or number of the link whose speed defines the orders; by default the input."""
    speeds: tuple[float, ...] = ()
    """Input speeds to calculate in addition to the speeds of the case. [rpm]"""
    shown: tuple[float, float] | None = None
    """Range of speeds in the picture; by default chosen from the case. [rpm]"""


class PictureFiles(NamedTuple):
    """Files that a picture needs in addition to the case."""

    duty: str = ""
    """CSV file of a duty cycle."""
    classes: str | int | Sequence[float] = 10
    """Number of torque classes, or upper bounds of the classes [N*m]. A text can contain a unit."""
    torque: str = ""
    """CSV file with the orders of an exciting torque."""


class Style(NamedTuple):
    """Style of a picture.

    Parameters
    ----------
    language : {"en", "ru"}
        Language of axes and titles; names of the case are not translated.
    dark : bool
        True for light lines on a dark background, for a screen.
    titled : bool
        True to draw the title; HTML pages show it as text instead.
    wheels : bool
        True for stick diagrams with names and tooth numbers of gears.
    merged : bool
        True to merge two gear sets with two common links into one lever.
    ordered : bool
        True to keep the gear sets of stick diagrams in the order of the case.
    width, height : float
        Largest size of a page; an infinite height gives a single page. [pt]
    excited : Excitation
        Excitation for pictures of vibration.
    data : object
        Contents of further files, as read by the function `PictureKind.reads` of the kind of
        picture.
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
    data: object = None

    def text(self, english: str, /, **places: object) -> str:
        """Return a text in the language of the picture; see `vstatics.core.texts`.

        >>> Style("ru").text("efficiency")
        'КПД'
        """
        if self.language == "en" and not places:
            return english
        return translated(english, self.language, **places)

    @property
    def paper(self) -> str:
        """Colour of the background; in the light style white, which is readable on any screen."""
        return "#14171c" if self.dark else "#ffffff"

    @property
    def ink(self) -> str:
        """Colour of texts and main lines."""
        return "#e6e6e6" if self.dark else "#1a1a1a"

    @property
    def faint(self) -> str:
        """Colour of background lines and of lines without torque; too pale for texts."""
        return "#5a616b" if self.dark else "#b0b0b0"

    @property
    def soft(self) -> str:
        """Colour of less important texts, with a contrast of 4.5 to 1 (WCAG 2.2, 1.4.3).

        The colours `engaged`, `lost` and `circulating` also have this contrast.
        """
        return "#a0a8b2" if self.dark else "#6b6b6b"

    @property
    def engaged(self) -> str:
        """Colour of engaged shift elements."""
        return "#ff7a8c" if self.dark else "#a0003c"

    @property
    def lost(self) -> str:
        """Colour of losses in numbers and areas."""
        return "#ffb454" if self.dark else "#c25400"

    @property
    def circulating(self) -> str:
        """Colour of recirculating power."""
        return "#b9a0ff" if self.dark else "#6a3fb0"

    @property
    def power(self) -> str:
        """Colour of the bands of a power flow."""
        return "#3c6a94" if self.dark else "#8fbbe0"

    @property
    def colours(self) -> tuple[str, ...]:
        """Colours that distinguish curves and areas."""
        return _ON_BLACK if self.dark else _ON_PAPER

    def colour(self, number: int) -> str:
        """Return the colour of the curve or area with an index; colours repeat."""
        return self.colours[number % len(self.colours)]

    def dash(self, number: int) -> str | tuple[float, tuple[float, ...]]:
        """Return the dash pattern of a line by index, which distinguishes lines of equal colour.

        >>> Style().dash(6), Style().dash(7)
        ('solid', (0, (6, 2)))
        """
        return DASHES[number // len(self.colours) % len(DASHES)]

    @property
    def settings(self) -> dict[Any, Any]:
        """Settings of matplotlib for the style."""
        return {
            "text.color": self.ink,
            "font.family": FONT,
            "font.size": SIZE,
            "figure.facecolor": self.paper,
            "savefig.facecolor": self.paper,
            "text.parse_math": False,  # the sign $ in a name is not mathematics
            "svg.hashsalt": "vstatics",
            "svg.fonttype": "none",
            **HINTING,
            "lines.solid_capstyle": "butt",
            "lines.dash_capstyle": "butt",
            "pdf.fonttype": 42,
        }


def number(value: float) -> str:
    """Format a number for a picture with few digits. An undefined value gives a dash.

    >>> [number(value) for value in (2.6428571, -251.0, 1e7, -0.00001, float("nan"))]
    ['2.643', '−251.0', '1e+07', '0.000', '–']
    >>> number(100.0), number(99.99999999999999)
    ('100.0', '100.0')
    """
    if not math.isfinite(value):
        return "–"
    # Rounded first, so that rounding noise does not determine the number of digits.
    size = abs(float(f"{value:.4g}"))
    if size >= LARGE_NUMBER:
        return typeset(f"{value:.4g}")
    decimals = 3 - sum(size >= bound for bound in (10, 100, 1000))
    return typeset(f"{value:z.{decimals}f}")
