"""Results of the shipped cases, and the printed tables of one of them."""

import json
from typing import Any

from tests.commands import CASES, ROOT
from vstatics import Results, load, solve

PUBLISHED = ROOT / "tests/published"
PRINTED: dict[str, Any] = json.loads((PUBLISHED / "mzkt7922.json").read_text(encoding="utf-8"))
"""Printed tables of the MZKT-7922, from its publication."""


def shipped_results(name: str, *, coast: bool = False) -> Results:
    """Return the results of a file in `cases`."""
    return solve(load(CASES / name), coast=coast)
