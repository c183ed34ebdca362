"""Rows of CSV files beside a case or a scenario, bounded."""

from __future__ import annotations

import csv
import io
from pathlib import Path


def csv_rows(file: Path, most: int) -> list[tuple[int, list[str]]]:
    """Lines that are not empty, each with its number.

    Parameters
    ----------
    file : Path
    most : int
        Of its bytes.

    Raises
    ------
    OSError
    ValueError
        With what was expected.
    """
    with file.open("rb") as opened:
        data = opened.read(most + 1)
    if len(data) > most:
        raise ValueError(f"expected a file of {most // 1000} kB at most")
    try:
        rows = list(csv.reader(io.StringIO(data.decode("utf-8-sig"))))
    except csv.Error as error:
        raise ValueError(f"expected CSV: {error}") from None
    return [(number, row) for number, row in enumerate(rows, 1) if row]
