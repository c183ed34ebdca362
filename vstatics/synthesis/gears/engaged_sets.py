"""Combinations of shift elements and what they do: one by one, as arrays, as tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, NamedTuple

from vstatics.model.transmission import ShiftElement
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.synthesis.gears.kinds import EngagedKind, Indices
from vstatics.tables.grid import Column, Grid, grid_of, sign


class EngagedSet(NamedTuple):
    """A combination of shift elements, and what it does."""

    engaged: Sequence[str]
    """Their names; a freewheel among them holds."""
    kind: Annotated[str, tuple(one.word for one in EngagedKind)]
    """The word of an `EngagedKind`."""
    ratio: float
    """Input speed by output speed; NaN but for `gear` and `direct`. [-]"""
    free: bool
    """Whether a link besides input and output is left undetermined."""


class EngagedSetList(NamedTuple):
    """All combinations."""

    combinations: Sequence[EngagedSet]


class EngagedSets(NamedTuple):
    """Some combinations in their order, as arrays."""

    elements: Sequence[ShiftElement]
    """Those to choose from."""
    members: Indices
    """(sets, elements), indices of the engaged ones."""
    kinds: Indices
    """(sets,), numbers of `EngagedKind`."""
    ratios: Floats
    """(sets,), NaN where there is none. [-]"""
    free: Booleans
    """(sets,)"""

    def each(self) -> Iterator[EngagedSet]:
        """One by one."""
        names = [element.name for element in self.elements]
        words = [kind.word for kind in EngagedKind]
        columns = (self.members, self.kinds, self.ratios, self.free)
        for members, kind, ratio, free in zip(*(one.tolist() for one in columns), strict=True):
            yield EngagedSet([names[one] for one in members], words[kind], ratio, free)

    def where(self, chosen: Booleans) -> EngagedSets:
        """Some of them."""
        return EngagedSets(
            self.elements,
            self.members[chosen],
            self.kinds[chosen],
            self.ratios[chosen],
            self.free[chosen],
        )

    @property
    def gears(self) -> Booleans:
        """(sets,), which have a ratio."""
        return self.kinds >= EngagedKind.GEAR


def combination_grids(found: Iterable[EngagedSet]) -> Iterator[Grid]:
    """A row for each combination; then how many there are of each kind.

    Examples
    --------
    >>> found = [EngagedSet(["F1", "T3"], "gear", 3.2, False)]
    >>> [grid.texts for grid in combination_grids(found)]
    [[['F1, T3', 'gear', '3.200', '·']], [['gear', '1']]]
    """
    kinds: Counter[str] = Counter()
    rows = []
    for one in found:
        kinds[one.kind] += 1
        rows.append((one.engaged, one.kind, one.ratio, sign(one.free)))
    headings = "engaged", "kind", "ratio", Column("free", is_sign=True)
    yield grid_of("Combinations", headings, rows, key="combinations")
    named = (kind.word for kind in reversed(EngagedKind))
    counts = ((kind, kinds[kind]) for kind in named if kinds[kind])
    yield grid_of("Kinds", ["kind", "combinations"], counts, key="kinds")
