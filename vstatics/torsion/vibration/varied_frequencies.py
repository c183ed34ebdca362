"""Natural frequencies of variants of a sweep, for `omega[mode, gear]` in expressions.

Variants with equal ratios have the same motions of links, so they are calculated together. A sweep
calls `frequencies` through the declaration of this annex if an expression contains `omega`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from vstatics.core.extras import require
from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics.matrix import column
from vstatics.core.statics.status import CONFLICT
from vstatics.torsion.system.coordinates import coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.system.state import vibrating
from vstatics.torsion.vibration.other_ratios import VariedSystem, frequencies_of_ratios
from vstatics.torsion.vibration.variants import first_variant, variant_frequencies

OF_MECHANISM = ("ratio", "efficiency")
"""Quantities of mechanisms that can vary."""
FEW_EQUAL_RATIOS = 64
"""Average number of variants per set of ratios, below which all sets are solved together."""

Asked = Mapping[int, Sequence[int]]
"""Indices of modes by index of the gear; rigid modes do not count."""


class VariedQuantity(Protocol):
    """Number of a case that a sweep varies."""

    @property
    def owner(self) -> int:
        """Index of the mechanism, elastic component or link."""

    @property
    def quantity(self) -> str:
        """Name of the varied quantity, such as `stiffness`."""


class VariedFrequencies(NamedTuple):
    """Natural frequencies of variants, with flags of variants without frequencies.

    Attributes
    ----------
    omegas : ndarray, shape (variants, gears, modes)
        Natural frequencies; NaN if a variant has fewer modes or a frequency was not requested.
        [rad/s]
    tied_up, conflict : ndarray, shape (variants,)
        True if a requested gear cannot rotate, or if its freewheels are in conflict.
    """

    omegas: Floats
    tied_up: Booleans
    conflict: Booleans


def frequencies(
    case: Transmission,
    targets: Sequence[VariedQuantity],
    values: Floats,
    asked: Asked,
    first: Floats | None = None,
) -> VariedFrequencies:
    """Calculate the requested natural frequencies of variants.

    If only stiffnesses and inertias vary, modes have the numbers of the first variant of the sweep.
    Otherwise they are numbered by ascending frequency.

    Parameters
    ----------
    case : Transmission
        Case with the numbers that do not vary.
    targets : sequence of VariedQuantity
        Varied numbers of the case.
    values : ndarray, shape (variants, targets)
        Values of the varied numbers, all within their ranges.
    asked : mapping
        Requested modes by gear.
    first : ndarray, shape (1, targets), optional
        Values of the first variant of the sweep, by default the first row of `values`.

    Examples
    --------
    Two masses of 2 on a shaft: ``omega^2 = c (1/2 + 1/2)``.

    >>> from vstatics import Spring
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> from types import SimpleNamespace
    >>> stiffness = SimpleNamespace(owner=0, quantity="stiffness")
    >>> frequencies(case, [stiffness], np.array([[100.0], [400.0]]), {0: [0]}).omegas
    array([[[10.]],
    <BLANKLINE>
           [[20.]]])
    """
    count = 1 + max((mode for modes in asked.values() for mode in modes), default=-1)
    omegas = np.full((len(values), len(case.gears), count), np.nan)
    tied_up, conflict = np.zeros((2, len(values)), np.bool_)
    kinds = _structures(case, targets, values)
    many = kinds.max(initial=0) * FEW_EQUAL_RATIOS > len(values) and not _depends_on_torque(case)
    for gear, modes in asked.items():
        left = np.arange(len(values))
        if many:
            omegas[:, gear, modes], safe = _by_ratios(case, targets, values, gear, modes)
            left = left[~safe]
        for rows in _alike(kinds, left):
            variant = _with_ratios(case, targets, values[rows[0]])
            system = vibrating(variant, variant.gears[gear])
            if isinstance(system, str):
                (conflict if system.startswith(CONFLICT.english) else tied_up)[rows] = True
            else:
                alike = values[rows]
                stiffnesses, inertias = _elastic_and_heavy(case, system, targets, alike)
                start = _elastic_and_heavy(
                    case, system, targets, alike[:1] if first is None else first
                )
                omegas[rows[:, np.newaxis], gear, modes] = variant_frequencies(
                    system,
                    modes,
                    stiffnesses=stiffnesses,
                    inertias=inertias,
                    variants=len(alike),
                    first=first_variant(*start),
                )
    return VariedFrequencies(omegas, tied_up, conflict)


def mode_names(case: Transmission, targets: Sequence[VariedQuantity]) -> list[str]:
    """Return the numbers, as texts, of all modes that a gear of the case can have in a sweep.

    A tied-up gear counts as one mode, because it can rotate in another variant.

    Raises
    ------
    CaseError
        If scipy is missing.
    """
    require("torsion", "omega")
    varied = [target.owner + 1 for target in targets if target.quantity == "inertia"]
    for link in varied:
        heavy = "masses" if link in case.masses else "inertias"
        case = case.replace(**{heavy: {**getattr(case, heavy), link: 1.0}})
    systems = [vibrating(case, gear) for gear in case.gears]
    counts = [1 if isinstance(system, str) else coordinates(system).modes for system in systems]
    return [str(number) for number in range(1, max(counts, default=0) + 1)]


def _depends_on_torque(case: Transmission) -> bool:
    return bool(case.freewheels) or any(spring.points for spring in case.springs)


def _structures(case: Transmission, targets: Sequence[VariedQuantity], values: Floats) -> Integers:
    """Return a number for each variant; variants with equal ratios have the same number.

    Freewheels and nonlinear springs depend on torques. With these, efficiencies must be equal, too.
    """
    deciding = ["ratio", *["efficiency"] * _depends_on_torque(case)]
    columns = [place for place, target in enumerate(targets) if target.quantity in deciding]
    numbers = values[:, columns]
    if not len(values) or (numbers == numbers[0]).all():
        return np.zeros(len(values), np.int64)
    _, kinds = np.unique(numbers, axis=0, return_inverse=True)
    return kinds.reshape(-1)


def _by_ratios(
    case: Transmission,
    targets: Sequence[VariedQuantity],
    values: Floats,
    gear: int,
    modes: Sequence[int],
) -> tuple[Floats, Booleans]:
    """Return the frequencies of a gear if nearly all ratios differ, and flags of known results."""
    variant = _with_ratios(case, targets, values[0])
    system = vibrating(variant, variant.gears[gear])
    if isinstance(system, str):
        return np.full((len(values), len(modes)), np.nan), np.zeros(len(values), np.bool_)
    twists = {}
    for target, ratios in zip(targets, values.T, strict=True):
        if target.quantity == "ratio":
            mechanism = case.mechanisms[target.owner]
            rows = np.zeros((len(values), len(system.names)))
            for link, part in zip(mechanism.links, column(ratios), strict=True):
                if link != HOUSING:
                    rows[:, link - 1] += part
            place = [device.name for device in system.devices].index(mechanism.name)
            twists[place] = rows
    others = _elastic_and_heavy(case, system, targets, values)
    return frequencies_of_ratios(VariedSystem(system, twists, *others), modes, len(values))


def _alike(kinds: Integers, rows: Integers) -> Iterator[Integers]:
    """Yield `rows` in groups with equal numbers in `kinds`."""
    if not len(rows):
        return
    order = rows[np.argsort(kinds[rows], kind="stable")]
    yield from np.split(order, np.flatnonzero(np.diff(kinds[order])) + 1)


def _with_ratios(
    case: Transmission, targets: Sequence[VariedQuantity], values: Floats
) -> Transmission:
    mechanisms = list(case.mechanisms)
    for target, value in zip(targets, values.tolist(), strict=True):
        if target.quantity in OF_MECHANISM:
            changed = {target.quantity: value}
            mechanisms[target.owner] = mechanisms[target.owner]._replace(**changed)
    return case.with_numbers(mechanisms)


def _elastic_and_heavy(
    case: Transmission, system: TorsionalSystem, targets: Sequence[VariedQuantity], values: Floats
) -> tuple[dict[int, Floats], dict[int, Floats]]:
    places = {device.name: place for place, device in enumerate(system.elastic)}
    stiffnesses, inertias = {}, {}
    for target, numbers in zip(targets, values.T, strict=True):
        if target.quantity == "inertia":
            inertias[target.owner] = numbers
        elif target.quantity in ("stiffness", "compliance"):
            place = places.get(case.devices[target.owner])
            if place is not None:
                stiffnesses[place] = numbers if target.quantity == "stiffness" else 1 / numbers
    return stiffnesses, inertias
