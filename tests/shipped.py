"""Results of the shipped cases, and the printed tables of one of them."""

from typing import Any

from tests.commands import CASES, ROOT, json_file
from vstatics import Results, load, solve

PUBLISHED = ROOT / "tests/published"
PRINTED: dict[str, Any] = json_file(PUBLISHED / "mzkt7922.json")
"""Printed tables of the MZKT-7922, from its publication."""


def shipped_results(name: str, *, coast: bool = False) -> Results:
    """Return the results of a file in `cases`."""
    return solve(load(CASES / name), coast=coast)
