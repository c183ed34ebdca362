"""Formats of the output of a sweep: how its pieces look, and how they become one file.

`text` writes CSV and JSON lines, `npz` columns of numbers; `tables` has what is made of all rows
together, Parquet, and Markdown, LaTeX and workbooks for few rows that people read.
"""

from __future__ import annotations

from typing import Literal, get_args

Format = Literal["csv", "jsonl", "npz", "parquet", "markdown", "latex", "xlsx"]

FORMATS: tuple[Format, ...] = get_args(Format)
TEXTS: tuple[Format, ...] = ("csv", "jsonl")
"""Formats whose pieces are text; those of the others are columns of numbers."""
MOST_ROWS: dict[Format, int] = {"markdown": 10_000, "latex": 10_000, "xlsx": 100_000}
"""Of the formats that people read, which are made in memory."""
