"""Size of texts, from the outlines of the font that comes with matplotlib."""

from __future__ import annotations

import warnings
from functools import cache, lru_cache
from io import BytesIO
from pathlib import Path
from threading import get_ident
from typing import NamedTuple

import matplotlib as mpl
from matplotlib.ft2font import FT2Font, LoadFlags

from vstatics.pictures.drawing.style import FONT

POINTS_PER_INCH = 72.0
"""Points per inch."""
_SUBPIXELS = 64.0
"""Units of measurement per pixel in the library FreeType."""
_MEASURED_SIZE = 100.0
"""Letter size at which the library measures heights, large so that rounding is small. [pt]"""
ASCENT, DESCENT, LINE_GAP = 1556 / 2048, 492 / 2048, 410 / 2048
"""Heights in table OS/2 of the font: ascent, descent, line gap, relative to the letter size. [-]"""


class TextExtent(NamedTuple):
    """Size of a line of letters, in points."""

    wide: float
    high: float
    low: float
    """Depth below the baseline."""


def _measured(line: str, size: float, *, bold: bool) -> TextExtent:
    font = _font_in_memory(get_ident(), bold=bold)
    if all(map(font.get_char_index, map(ord, line))):
        return _measured_with(font, line, size)
    from matplotlib.font_manager import get_font  # the import takes long

    with warnings.catch_warnings(action="ignore"):  # a missing letter is measured as a box
        return _measured_with(get_font(_path(bold=bold)), line, size)


def _measured_with(font: FT2Font, line: str, size: float) -> TextExtent:
    font.set_size(size, POINTS_PER_INCH)
    font.set_text(line, 0.0, flags=LoadFlags.NO_HINTING)
    wide, high = font.get_width_height()
    return TextExtent(wide / _SUBPIXELS, high / _SUBPIXELS, font.get_descent() / _SUBPIXELS)


@lru_cache(maxsize=64)
def _font_in_memory(_thread: int, *, bold: bool) -> FT2Font:
    """Return the font of a thread, in memory so that the file is not read for each letter."""
    return FT2Font(BytesIO(_path(bold=bold).read_bytes()))


def _path(*, bold: bool) -> Path:
    name = f"{FONT.replace(' ', '')}{'-Bold' * bold}.ttf"
    return Path(mpl.get_data_path(), "fonts", "ttf", name)


def line_width(line: str, size: float, *, bold: bool = False) -> float:
    """Return the width of a line of text [pt]."""
    return _measured(line, size, bold=bold).wide


@cache
def _fine_extent(line: str, *, bold: bool) -> TextExtent:
    return _measured(line, _MEASURED_SIZE, bold=bold)


def line_extent(line: str, size: float, *, bold: bool = False) -> TextExtent:
    """Return the size of a line of text, all 0 for an empty line."""
    if not line:
        return TextExtent(0.0, 0.0, 0.0)
    wide, high, low = _fine_extent(line, bold=bold)
    scale = size / _MEASURED_SIZE
    return TextExtent(wide * scale, high * scale, low * scale)
