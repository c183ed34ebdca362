"""Lengths on paper as typed by the user."""

from __future__ import annotations

import re

from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE

_POINTS = {
    "mm": POINTS_PER_MILLIMETRE,
    "cm": 10 * POINTS_PER_MILLIMETRE,
    "in": 72.0,
    "pt": 1.0,
}
"""Number of points in each unit of length. [pt]"""
LEAST_WIDTH, MOST_WIDTH = 80.0, 1200.0
"""Smallest page width, a column of a journal, and largest page width, an A0 sheet. [mm]"""
DECIMALS = 6
"""Number of decimals of a length in comparisons, so that rounded conversions count as equal. [mm]
"""
_LENGTH = re.compile(r"(\d{1,9}(?:\.\d*)?|\.\d+) *([a-z]+)")


def page_width(text: str) -> float:
    """Return the width of a page [pt] from a text such as "84 mm".

    Raises
    ------
    ValueError
        If the text is not a length with a unit, or not a possible width of a page.

    Examples
    --------
    >>> [round(page_width(text), 6) for text in ("254mm", "25.4 cm", "6.5in", "500pt")]
    [720.0, 720.0, 468.0, 500.0]
    """
    match = _LENGTH.fullmatch(text.strip())
    if match is None or match[2] not in _POINTS:
        raise ValueError(f"expected a length in {', '.join(_POINTS)}, such as 170mm")
    return checked_width(float(match[1]) * _POINTS[match[2]] / POINTS_PER_MILLIMETRE)


def checked_width(millimetres: float) -> float:
    """Return the width of a page in points from a width in mm.

    Raises
    ------
    ValueError
        If the width is out of range.

    Examples
    --------
    >>> round(checked_width(254.0), 6)
    720.0
    """
    if not LEAST_WIDTH <= round(millimetres, DECIMALS) <= MOST_WIDTH:
        raise ValueError(f"expected a width of {LEAST_WIDTH:g}mm to {MOST_WIDTH:g}mm")
    return millimetres * POINTS_PER_MILLIMETRE
