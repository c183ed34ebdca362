"""Gears in mesh: undercut, interference in a ring, and wear of teeth that always meet.

The conditions assume the usual profile with a pressure angle of 20 degrees and an addendum of one
module.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.elements.teeth.conditions import INSIDE, UNCUT, UNCUT_SHIFTED
from vstatics.core.elements.teeth.layout import Doubt, Key


class Toothed(NamedTuple):
    """Gear or rim with teeth."""

    label: str
    teeth: int
    key: Key
    internal: bool = False

    def __str__(self) -> str:
        """Return the name with the number of teeth."""
        return f"{self.label} {self.teeth}"


SHIFT_PER_TOOTH = math.sin(math.radians(20)) ** 2 / 2
"""Decrease of the least profile shift without undercut per tooth, for the standard profile (DIN
3960). [module]"""


class Mesh(NamedTuple):
    """Two gears in mesh; in an internal mesh the first gear is the ring."""

    first: Toothed
    second: Toothed

    @property
    def divisor(self) -> int:
        """Greatest common divisor of the numbers of teeth.

        >>> Mesh(Toothed("first", 20, "first"), Toothed("second", 42, "second")).divisor
        2
        """
        return math.gcd(self.first.teeth, self.second.teeth)


def undercut(wheels: Iterable[Toothed]) -> Iterator[Doubt]:
    """Report external gears with few teeth, undercut by the tool.

    The least profile shift of 10 teeth is 1 - 10 sin(20°)^2/2 = 0.415 modules.

    >>> [doubt] = undercut([Toothed("sun", 10, "sun")])
    >>> doubt.message
    'sun 10 is undercut unless its profile is shifted by 0.42 modules or more, expected 14 ...'
    """
    for wheel in wheels:
        if wheel.internal:
            continue
        if wheel.teeth < UNCUT_SHIFTED:
            yield Doubt(
                "N319",
                f"{wheel} is undercut unless its profile is shifted by "
                f"{1 - wheel.teeth * SHIFT_PER_TOOTH:.2f} modules or more, "
                f"expected {UNCUT_SHIFTED} teeth or more",
                wheel.key,
            )
        elif wheel.teeth < UNCUT:
            message = f"{wheel} needs a shifted profile: fewer than {UNCUT} teeth are undercut"
            yield Doubt("N317", message, wheel.key, has_cure=False)


def interfering(meshes: Sequence[Mesh]) -> Iterator[Doubt]:
    """Report tip interference of a ring that is hardly larger than the gear inside."""
    for ring, wheel in meshes:
        more = ring.teeth - wheel.teeth
        if ring.internal and more <= 0:
            yield Doubt("W320", f"{wheel} does not fit into {ring}", ring.key)
        elif ring.internal and more < INSIDE:
            yield Doubt(
                "W321",
                f"tips of {wheel} and {ring} interfere: their numbers of teeth differ by {more}, "
                f"expected {INSIDE} or more",
                ring.key,
            )


def hunting(meshes: Sequence[Mesh], against: str) -> Iterator[Doubt]:
    """Yield a note on each mesh in which a tooth meets only some teeth of the mating gear.

    A damaged tooth then always meets the same teeth and wears them.

    Parameters
    ----------
    meshes : sequence of Mesh
    against : str
        Part relative to which messages count revolutions; empty for the housing.
    """
    common = sorted(
        (mesh for mesh in meshes if mesh.divisor > 1), key=lambda mesh: mesh.divisor, reverse=True
    )
    if not common:
        return
    (first, second), *others = common
    shared = common[0].divisor
    turns = second.teeth // shared
    often = "every turn" if turns == 1 else f"every {turns} turns"
    message = (
        f"{first} and {second} have the common divisor {shared}: "
        f"the same teeth meet {often} of {first.label}{against}"
    )
    if others:
        names = (f"{mesh.first} and {mesh.second} ({mesh.divisor})" for mesh in others)
        message += f"; also {', '.join(names)}"
    yield Doubt("N318", message, first.key, has_cure=False)
