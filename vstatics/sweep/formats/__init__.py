"""Formats of the output file of a sweep, which is calculated in pieces.

`text` writes CSV and JSON lines, and `npz` an archive with an array for each column. `tables`
writes formats that need all rows together: Parquet, and for few rows Markdown, LaTeX and workbooks.
"""

from __future__ import annotations

from typing import Literal, get_args

Format = Literal["csv", "jsonl", "npz", "parquet", "markdown", "latex", "xlsx"]

FORMATS: tuple[Format, ...] = get_args(Format)
TEXTS: tuple[Format, ...] = ("csv", "jsonl")
"""Formats whose pieces are stored as text. The pieces of other formats are stored as columns."""
MOST_ROWS: dict[Format, int] = {"markdown": 10_000, "latex": 10_000, "xlsx": 100_000}
"""Largest number of rows in formats that are composed in memory."""
