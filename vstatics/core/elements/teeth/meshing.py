"""Two wheels that mesh: undercut, interference in a ring, wear of the same teeth.

They hold for the usual profile of 20 degrees with tips one module high.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.elements.teeth.conditions import INSIDE, UNCUT, UNCUT_SHIFTED
from vstatics.core.elements.teeth.layout import Doubt, Key


class Toothed(NamedTuple):
    """A wheel or a rim."""

    label: str
    teeth: int
    key: Key
    internal: bool = False

    def __str__(self) -> str:
        """Its name with its teeth."""
        return f"{self.label} {self.teeth}"


class Mesh(NamedTuple):
    """Two that mesh; the first one is the ring of an internal mesh."""

    first: Toothed
    second: Toothed

    @property
    def divisor(self) -> int:
        """The greatest common divisor of their teeth.

        >>> Mesh(Toothed("first", 20, "first"), Toothed("second", 42, "second")).divisor
        2
        """
        return math.gcd(self.first.teeth, self.second.teeth)


def undercut(wheels: Iterable[Toothed]) -> Iterator[Doubt]:
    """The tool digs into the feet of few teeth."""
    for wheel in wheels:
        if wheel.internal:
            continue
        if wheel.teeth < UNCUT_SHIFTED:
            message = (
                f"{wheel} is undercut even with a shifted profile, "
                f"expected {UNCUT_SHIFTED} teeth or more"
            )
            yield Doubt("N319", message, wheel.key)
        elif wheel.teeth < UNCUT:
            message = f"{wheel} needs a shifted profile: below {UNCUT} teeth are undercut"
            yield Doubt("N317", message, wheel.key, has_cure=False)


def interfering(meshes: Sequence[Mesh]) -> Iterator[Doubt]:
    """Tips foul one another in a ring that is hardly larger than the wheel in it."""
    for ring, wheel in meshes:
        more = ring.teeth - wheel.teeth
        if ring.internal and more <= 0:
            yield Doubt("W320", f"{wheel} doesn't fit into {ring}", ring.key)
        elif ring.internal and more < INSIDE:
            yield Doubt(
                "W321",
                f"tips of {wheel} and {ring} interfere: their numbers of teeth differ by {more}, "
                f"expected {INSIDE} or more",
                ring.key,
            )


def hunting(meshes: Sequence[Mesh], against: str) -> Iterator[Doubt]:
    """Meshes where each tooth meets only some of the other wheel's, and a fault wears these.

    Parameters
    ----------
    meshes : sequence of Mesh
    against : str
        What the turns are counted against; the housing when empty.
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
        message += f"; likewise {', '.join(names)}"
    yield Doubt("N318", message, first.key, has_cure=False)
