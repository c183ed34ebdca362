"""The figures of the pages in docs/sources: each that no example there shows."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.published.pages import rows

HERE = Path(__file__).parent
MZKT: dict[str, Any] = json.loads((HERE / "mzkt7922.json").read_text(encoding="utf-8"))


def test_cells_of_the_listing_that_are_wrong_in_print() -> None:
    """All that the published numbers know, with what is printed and what is right."""
    known = {
        f"{one['table']}({one['row']},{gear})": (one["printed"], one["here"])
        for one in MZKT["corrections"]
        for gear in one["gears"]
    }
    idle = MZKT["idle"]
    right = MZKT[idle["table"]][idle["row"] - 1][idle["gears"][0] - 1]
    known[f"{idle['table']}({idle['row']},{idle['gears'][0]})"] = idle["printed"], right
    told = {
        row["cell"]: (float(row["printed"]), float(row["here"]))
        for row in rows("visual-statics", "Cells of the listing")
    }
    assert told == known
