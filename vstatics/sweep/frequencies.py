"""Natural frequencies of the variants of a block: `omega[mode, gear]` of expressions.

Variants with the same ratios have the same links, so they go together to the room `torsion`,
which is imported here alone, and only when a frequency is asked for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vstatics.extras import require
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.statics.status import CONFLICT
from vstatics.sweep.targets import OF_MECHANISM, Target

if TYPE_CHECKING:
    from vstatics.torsion.system import TorsionalSystem

OMEGA = "omega"
"""The name of the table. [rad/s]"""

Asked = Mapping[int, Sequence[int]]
"""Index of a gear -> indices of modes, of those that are not rigid."""


class Frequencies(NamedTuple):
    """Natural frequencies of variants, and why there are none.

    Attributes
    ----------
    omegas : ndarray, shape (variants, gears, modes)
        NaN where a variant has fewer modes, and what is not asked for. [rad/s]
    tied_up, conflict : ndarray, shape (variants,)
        Whether a gear that is asked for can't turn, or its freewheels are in conflict.
    """

    omegas: Floats
    tied_up: Booleans
    conflict: Booleans


def frequencies(
    case: Transmission, targets: Sequence[Target], values: Floats, asked: Asked
) -> Frequencies:
    """The frequencies of variants.

    Parameters
    ----------
    case : Transmission
    targets : sequence of Target
    values : ndarray, shape (variants, targets)
        The varied numbers, all of them possible.
    asked : mapping

    Examples
    --------
    Two masses of 2 on a shaft: ``omega^2 = c (1/2 + 1/2)``.

    >>> from vstatics import Spring
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> stiffness = Target("S1.stiffness", 0, "stiffness")
    >>> frequencies(case, [stiffness], np.array([[100.0], [400.0]]), {0: [0]}).omegas
    array([[[10.]],
    <BLANKLINE>
           [[20.]]])
    """
    from vstatics.torsion.state import vibrating

    count = 1 + max((mode for modes in asked.values() for mode in modes), default=-1)
    found = np.full((len(values), len(case.gears), count), np.nan)
    tied_up, conflict = np.zeros((2, len(values)), np.bool_)
    for rows in _of_one_structure(case, targets, values):
        some = values[rows]
        one = _with_ratios(case, targets, some[0])
        for gear, modes in asked.items():
            system = vibrating(one, one.gears[gear])
            if isinstance(system, str):
                (conflict if system.startswith(CONFLICT.english) else tied_up)[rows] = True
            else:
                omegas = _of_gear(case, system, targets, some, modes)
                found[rows[:, np.newaxis], gear, modes] = omegas
    return Frequencies(found, tied_up, conflict)


def mode_names(case: Transmission, targets: Sequence[Target]) -> list[str]:
    """The numbers of modes that a gear of the case has at most: as it is, or with varied inertias.

    A gear that is tied up may have one in a variant.

    Raises
    ------
    CaseError
        If scipy is missing.
    """
    require("torsion", "omega")
    from vstatics.torsion.coordinates import coordinates
    from vstatics.torsion.state import vibrating

    heavy = {target.owner + 1: 1.0 for target in targets if target.quantity == "inertia"}
    case = replace(case, inertias={**case.inertias, **heavy})
    systems = [vibrating(case, gear) for gear in case.gears]
    counts = [1 if isinstance(one, str) else coordinates(one).modes for one in systems]
    return [str(number) for number in range(1, max(counts, default=0) + 1)]


def _of_one_structure(
    case: Transmission, targets: Sequence[Target], values: Floats
) -> Iterator[Integers]:
    """Variants with the same ratios; where there are freewheels, with the same efficiencies too."""
    deciding = ("ratio", "efficiency") if case.freewheels else ("ratio",)
    columns = [place for place, target in enumerate(targets) if target.quantity in deciding]
    numbers = values[:, columns]
    if not len(values) or (numbers == numbers[0]).all():
        yield np.arange(len(values))
        return
    _, kinds = np.unique(numbers, axis=0, return_inverse=True)
    order = np.argsort(kinds.reshape(-1), kind="stable")
    ends = np.flatnonzero(np.diff(kinds.reshape(-1)[order])) + 1
    yield from np.split(order, ends)


def _with_ratios(case: Transmission, targets: Sequence[Target], values: Floats) -> Transmission:
    """The case with the ratios and efficiencies of a variant."""
    mechanisms = list(case.mechanisms)
    for target, value in zip(targets, values.tolist(), strict=True):
        if target.quantity in OF_MECHANISM:
            changed = {target.quantity: value}
            mechanisms[target.owner] = mechanisms[target.owner]._replace(**changed)
    return case.with_numbers(mechanisms)


def _of_gear(
    case: Transmission,
    system: TorsionalSystem,
    targets: Sequence[Target],
    values: Floats,
    modes: Sequence[int],
) -> Floats:
    """The frequencies of a gear, of shape (variants, modes); what is open has no stiffness."""
    from vstatics.torsion.variants import variant_frequencies

    places = {device.name: place for place, device in enumerate(system.elastic)}
    stiffnesses, inertias = {}, {}
    for target, numbers in zip(targets, values.T, strict=True):
        if target.quantity == "inertia":
            inertias[target.owner] = numbers
        elif target.quantity in ("stiffness", "compliance"):
            place = places.get(case.devices[target.owner])
            if place is not None:
                stiff = target.quantity == "stiffness"
                stiffnesses[place] = numbers if stiff else 1 / numbers
    return variant_frequencies(
        system, modes, stiffnesses=stiffnesses, inertias=inertias, variants=len(values)
    )
