"""Combinations of shift elements and what they do: one by one, and as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.model.transmission import ShiftElement
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.synthesis.engaged_kinds import EngagedKind, Indices


class EngagedSet(NamedTuple):
    """A combination of shift elements, and what it does."""

    engaged: Sequence[str]
    """Their names; a freewheel among them holds."""
    kind: str
    """The word of an `EngagedKind`."""
    ratio: float
    """Input speed by output speed; NaN but for `gear` and `direct`. [-]"""
    free: bool
    """Whether a link besides input and output is left undetermined."""


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
        have: Booleans = self.kinds >= EngagedKind.GEAR
        return have
