"""What a page is like on paper: its sheets as a browser prints them."""

import io
import math
import unicodedata
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pytest


class PrintedSheet(NamedTuple):
    """A sheet of paper."""

    lines: Sequence[str]
    letters: Sequence[tuple[str, float]]
    """Texts with the size of their letters [pt]."""


def printed(browser: Any, file: Path) -> list[PrintedSheet]:
    pypdf = pytest.importorskip("pypdf")
    window = browser.new_page()
    window.goto(file.as_uri())
    made = window.pdf(prefer_css_page_size=True)
    window.close()
    sheets = []
    for sheet in pypdf.PdfReader(io.BytesIO(made)).pages:
        letters: list[tuple[str, float]] = []

        def note(text: str, page: Any, own: Any, _: Any, size: float, into: Any = letters) -> None:
            if text.strip():
                into.append((text.strip(), size * _part(own) * _part(page)))

        shown = unicodedata.normalize("NFKC", sheet.extract_text(visitor_text=note))  # ligatures
        lines = [line.strip() for line in shown.splitlines() if line.strip()]
        sheets.append(PrintedSheet(lines, letters))
    return sheets


def _part(matrix: Sequence[float]) -> float:
    """By how much a transform makes a height longer."""
    return math.hypot(matrix[2], matrix[3])
