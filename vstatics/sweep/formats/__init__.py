"""Formats of the output of a sweep, which is calculated in pieces and written to a file.

`text` writes CSV and JSON lines, `npz` columns of numbers. `tables` writes formats that need all
rows together: Parquet, and Markdown, LaTeX and workbooks for few rows.
"""

from __future__ import annotations

from typing import Literal, get_args

Format = Literal["csv", "jsonl", "npz", "parquet", "markdown", "latex", "xlsx"]

FORMATS: tuple[Format, ...] = get_args(Format)
TEXTS: tuple[Format, ...] = ("csv", "jsonl")
"""Formats whose pieces are stored as text; pieces of other formats are columns of numbers."""
MOST_ROWS: dict[Format, int] = {"markdown": 10_000, "latex": 10_000, "xlsx": 100_000}
"""Greatest number of rows in formats for readers, which are written in memory."""
