"""The tables of the pages in docs/sources, which lay what is printed beside what is calculated."""

from __future__ import annotations

from pathlib import Path

SOURCES = Path(__file__).parents[2] / "docs" / "sources"

Row = dict[str, str]
"""Cells by the heads of their columns."""


def rows(page: str, heading: str) -> list[Row]:
    """The first table below a heading of a page."""
    text = (SOURCES / f"{page}.md").read_text(encoding="utf-8")
    below = text.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line.strip("| ").split(" | ") for line in below.splitlines() if line.startswith("|")]
    head, _, *cells = lines
    return [dict(zip(head, one, strict=True)) for one in cells]


def rounded(value: float, like: str) -> str:
    """A number with as many decimals as another that is shown, no zero before its point."""
    places = len(like.partition(".")[2])
    return f"{value:.{places}f}".replace("0.", ".", 1) if abs(value) < 1 else f"{value:.{places}f}"
