"""A box to be found: what is asked for, what a found one is, by which figures it is judged."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.synthesis.structures.scheme import SetScheme

HELD = -1
"""The second link of a brake."""
EFFICIENCY = 0.98
"""Of each set with its carrier held, where nothing is said."""


class BoxSearch(NamedTuple):
    """Which boxes are asked for.

    Examples
    --------
    >>> search = BoxSearch(2, 4, 2, (2.84, 1.57, 1, -2.21), own_input=True)
    >>> search.links  # the input shaft is one more, number 4
    4
    """

    sets: int
    elements: int
    """Brakes and clutches; each is engaged in a gear."""
    engaged: int
    """So many are engaged in every gear."""
    targets: tuple[float, ...]
    """Wanted ratios of the gears, all different. [-]"""
    bounds: tuple[float, float] = (1.4, 5.0)
    """Least and largest ring teeth/sun teeth of a set. [-]"""
    meshed: int = 0
    """So many sets have meshed planets."""
    own_input: bool = False
    """Whether the input is a shaft that only clutches join."""
    fixed: int = 0
    """So many members are held for good; they are one more link of the scheme."""
    tolerance: float = 0.01
    """A box is found if least squares leave no gear with a larger |ln(i/target)|. [-]"""

    @property
    def links(self) -> int:
        """Links of the scheme of its sets; the one that is held for good is among them."""
        return self.sets + self.engaged + (0 if self.own_input else 1) + (1 if self.fixed else 0)


class BoxFigures(NamedTuple):
    """By what boxes are compared: the less the better, and two that are so or not."""

    error: float
    """The largest |ln(i/target)|. [-]"""
    loss: float
    """The mean of 1 - efficiency of the forward gears; of all if there are none. [-]"""
    planet_speed: float
    """The largest |speed of a planet against its carrier|/input speed of all gears [-]; NaN where
    all sets have meshed planets, whose teeth it would need."""
    slip: float
    """The largest |slip| of an open element/input speed. [-]"""
    torque: float
    """The largest |torque| of an engaged element/input torque, without losses. [-]"""
    brakes: int
    clutches: int
    single: bool
    """Whether one element changes between neighbours."""
    planar: bool
    """Whether it can be drawn without shafts that cross."""


LIMITED = tuple(name for name in BoxFigures._fields if name not in ("single", "planar"))
"""The figures that can have a limit."""


class FoundBox(NamedTuple):
    """A scheme with ports and shift elements, with the ratios that fit best.

    Examples
    --------
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((0,), (1,)), 0.0)
    >>> list(box.brakes), list(box.clutches)
    ([(2, -1)], [(0, 1)])
    """

    scheme: SetScheme
    held: int | None
    """The link of the scheme that is held for good."""
    input: int
    """A link of the scheme; the next number after its links is an input shaft of its own."""
    output: int
    elements: tuple[tuple[int, int], ...]
    """Two links that a clutch joins; a link and `HELD` of a brake. Brakes stand first."""
    ratios: tuple[float, ...]
    """Internal ratio of each set, sun to ring with the carrier held: above 0 where its planets
    are meshed. [-]"""
    gears: tuple[tuple[int, ...], ...]
    """For each target the elements engaged, numbers in `elements` from 0."""
    error: float
    """The largest |ln(i/target)|. [-]"""

    @property
    def brakes(self) -> Iterator[tuple[int, int]]:
        """Elements that hold a link."""
        return (one for one in self.elements if one[1] == HELD)

    @property
    def clutches(self) -> Iterator[tuple[int, int]]:
        """Elements that join two links."""
        return (one for one in self.elements if one[1] != HELD)
