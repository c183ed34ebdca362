"""Names of rows: those of a table, and how one is written, as in `speeds[C1]`."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.model.transmission import Transmission
from vstatics.statics.arrays import Rows, row_names
from vstatics.tables.quantities import BY_NAME

NAME = re.compile(r"[^\W\d]\w*")
"""A plain word."""
DOTTED = re.compile(rf"{NAME.pattern}(?:\.\w+)*")
"""What is written without quotes between brackets, such as `P1.ring`, as are digits."""
BEFORE_NAME = "|"
"""Stands before the name of a row in a listing."""


class RowWords(NamedTuple):
    """How rows of a kind are called."""

    one: str
    all: str
    size: str
    """Their number, as the deck calls it."""


ROWS: Mapping[Rows, RowWords] = {
    "links": RowWords("link", "links", "KJG"),
    "planets": RowWords("planet", "mechanisms", "KG"),
    "elements": RowWords("shift element", "shift elements", "KL"),
    "devices": RowWords("mechanism", "mechanisms", "KG"),
    "mechanisms": RowWords("mechanism", "mechanisms", "KG"),
    "torques": RowWords("device", "shift elements, then mechanisms, then the output", "KLG1"),
    "meshes": RowWords("mesh", "meshes", "KM"),
    "one": RowWords("gear", "gears", "NP"),
}
"""By what the rows of a table stand for."""

_DIGITS = re.compile(r"[0-9]+")


def table_rows(name: str, case: Transmission) -> Sequence[str]:
    """The names of a table's rows; none if it has one value per gear.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> list(table_rows("torques", case)), list(table_rows("ratio", case))
    (['D1', 'Mx'], [])
    """
    return row_names(case, BY_NAME[name].rows)


def written(index: int, names: Sequence[str]) -> str:
    """A row or a gear as it can be written between brackets; no other is written so.

    >>> [written(index, ["C1", "4-5", "C1"]) for index in range(3)]
    ['#1', '"4-5"', '#3']
    """
    name = names[index]
    if names.count(name) > 1 or ('"' in name and "'" in name):
        return f"#{index + 1}"
    if is_bare(name):
        return name
    mark = "'" if '"' in name else '"'
    return f"{mark}{name}{mark}"


def is_bare(name: str) -> bool:
    """Whether a name may stand between brackets without quotes.

    >>> is_bare("вал"), is_bare("P1.ring"), is_bare("2"), is_bare("1R"), is_bare("4-5")
    (True, True, True, False, False)
    """
    return bool(DOTTED.fullmatch(name) or _DIGITS.fullmatch(name))
