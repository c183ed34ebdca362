"""Combinations of shift elements as tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from vstatics.synthesis.engaged_kinds import EngagedKind
from vstatics.synthesis.engaged_sets import EngagedSet
from vstatics.tables.grid import Column, Grid, Row, exact, sign, text, whole, words


def combination_grids(found: Iterable[EngagedSet]) -> Iterator[Grid]:
    """A row for each combination; then how many there are of each kind.

    Examples
    --------
    >>> found = [EngagedSet(["F1", "T3"], "gear", 3.2, False)]
    >>> [grid.texts for grid in combination_grids(found)]
    [[['F1, T3', 'gear', '3.200', '·']], [['gear', '1']]]
    """
    kinds: Counter[str] = Counter()
    rows: list[Row] = []
    for one in found:
        kinds[one.kind] += 1
        rows.append([words(one.engaged), one.kind, exact(one.ratio), sign(one.free)])
    columns = [text("engaged"), text("kind"), Column("ratio"), Column("free", is_sign=True)]
    yield Grid("Combinations", columns, rows, key="combinations")
    named = (kind.word for kind in reversed(EngagedKind))
    counts: list[Row] = [[kind, whole(kinds[kind])] for kind in named if kinds[kind]]
    yield Grid("Kinds", [text("kind"), Column("combinations")], counts, key="kinds")
