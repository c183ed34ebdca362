"""Sizes of texts, against the fonts of matplotlib as it opens them itself."""

import warnings
from pathlib import Path

import matplotlib as mpl
import pytest
from matplotlib.font_manager import get_font
from matplotlib.ft2font import LoadFlags

from vstatics.pictures.drawing.metrics import line_extent, line_width


@pytest.mark.parametrize("bold", [False, True])
def test_a_text_is_as_large_as_matplotlib_draws_it(bold: bool) -> None:
    """Letters that the font lacks (齿 and 輪) are boxes."""
    font = get_font(Path(mpl.get_data_path(), "fonts", "ttf", f"DejaVuSans{'-Bold' * bold}.ttf"))
    for text in ("carrier 1", "−0.430 · AV fi", "водило 2", "齿輪 P1", " "):
        for size, measured in (
            (8.0, line_width(text, 8.0, bold=bold)),
            (100.0, line_extent(text, 100.0, bold=bold)),
        ):
            font.set_size(size, 72.0)
            with warnings.catch_warnings(action="ignore"):
                font.set_text(text, 0.0, flags=LoadFlags.NO_HINTING)
            wide, high = font.get_width_height()
            assert measured in (wide / 64, (wide / 64, high / 64, font.get_descent() / 64))
