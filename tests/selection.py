"""Cases of the tests that a run takes: the first of each test, all others, or all.

The first case of a test finds almost every fault that all its cases find, in a fraction of the
time. Published numbers and comparisons with independent references are always taken in full.
"""

from collections import Counter
from functools import cache
from pathlib import Path
from typing import Literal

import pytest

Cases = Literal["first", "other", "all"]

TESTS = Path(__file__).parent
IN_FULL = (TESTS / "published", TESTS / "oracle")
"""Folders whose cases all count as first ones."""


@cache
def is_in_full(path: Path) -> bool:
    """Return whether all cases of a file of tests count as first ones."""
    return any(path.is_relative_to(folder) for folder in IN_FULL) or path.parent.name == "published"


def is_skipped(item: pytest.Item) -> bool:
    """Return whether a mark skips a case here, so that it cannot stand for its test."""
    return any(mark.args and mark.args[0] for mark in item.iter_markers("skipif"))


def selected(items: list[pytest.Item], cases: Cases) -> tuple[list[pytest.Item], list[pytest.Item]]:
    """Return the items of a run, and those left out, each in their order.

    A test is a function with its parameters, or the example of a docstring.
    """
    if cases == "all":
        return items, []
    seen: Counter[str] = Counter()
    taken: list[pytest.Item] = []
    left: list[pytest.Item] = []
    for item in items:
        name = item.nodeid.partition("[")[0]
        is_first = is_in_full(item.path) or seen[name] == 0
        seen[name] += not is_skipped(item)
        (taken if is_first == (cases == "first") else left).append(item)
    return taken, left
