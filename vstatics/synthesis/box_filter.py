"""Which of the found boxes are wanted."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from vstatics.synthesis.box import FoundBox
from vstatics.synthesis.box_figures import BoxFigures, MeasuredBox

LIMITED = tuple(name for name in BoxFigures._fields if name not in ("single", "planar"))
"""The figures that can have a limit."""


class BoxFilter(NamedTuple):
    """What a box has to be.

    Examples
    --------
    >>> BoxFilter(brakes=(2, 3), limits={"loss": 0.05})
    BoxFilter(single=False, planar=False, brakes=(2, 3), clutches=(), limits={'loss': 0.05})
    """

    single: bool = False
    """One element changes between neighbours."""
    planar: bool = False
    brakes: tuple[int, ...] = ()
    """It has one of these numbers of them; any when empty."""
    clutches: tuple[int, ...] = ()
    limits: Mapping[str, float] = MappingProxyType({})
    """The largest value of a figure, one of `LIMITED`."""

    def before(self, box: FoundBox) -> bool:
        """Whether a box may be wanted, before its figures are known.

        >>> from vstatics.synthesis.box import HELD
        >>> from vstatics.synthesis.scheme import SetScheme
        >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
        ...                ((1,), (0,)), 0.0)
        >>> BoxFilter(brakes=(1,)).before(box), BoxFilter(limits={"clutches": 0}).before(box)
        (True, False)
        """
        counts = {"brakes": len(list(box.brakes)), "clutches": len(list(box.clutches))}
        allowed = {"brakes": self.brakes, "clutches": self.clutches}
        return all(
            (not allowed[name] or count in allowed[name]) and count <= self.limits.get(name, count)
            for name, count in counts.items()
        )

    def lets(self, found: MeasuredBox) -> bool:
        """Whether a box with its figures is wanted."""
        figures = found.figures
        return (
            self.before(found.box)
            and figures.single >= self.single
            and figures.planar >= self.planar
            and not any(getattr(figures, name) > most for name, most in self.limits.items())
        )
