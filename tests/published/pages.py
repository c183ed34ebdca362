"""The tables of the pages in docs/sources, which lay what is printed beside what is calculated."""

import re
from pathlib import Path

SOURCES = Path(__file__).parents[2] / "docs" / "sources"

Row = dict[str, str]
"""Cells by the heads of their columns."""


def rows(page: str, heading: str, number: int = 0) -> list[Row]:
    """A table below a heading of a page, by its number there from 0."""
    text = (SOURCES / f"{page}.md").read_text("utf-8")
    below = text.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = re.findall(r"(?:^\|.*\n)+", below, re.MULTILINE)[number].splitlines()
    head, _, *cells = [[cell.strip() for cell in line[1:-1].split("|")] for line in lines]
    return [dict(zip(head, one, strict=True)) for one in cells]


def rounded(value: float, like: str) -> str:
    """Return a number with as many decimals as a number that is shown."""
    return f"{value:.{len(like.partition('.')[2])}f}"
