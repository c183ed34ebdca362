"""Natural frequencies of many variants of a system, other in stiffnesses and inertias.

What the forms of links decide, free and rigid motions, is found once for all variants. Where one
stiffness alone varies its secular equation is solved for all of them (`secular`), else stacks
of small matrices (`normed`).

A system without one of its elastic devices, as its secular equation has it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import copy
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.motions import Form
from vstatics.torsion.system.coordinates import Coordinates, coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.vibration.crossings import separate_motions
from vstatics.torsion.vibration.modal_masses import (
    NormedTwists,
    natural_frequencies,
    normed_twists,
    triangular,
)
from vstatics.torsion.vibration.secular import Poles, squares_with_device

NUMBERS = 2**17
"""Of the matrices that are solved at once, so that they stay near the processor."""
SOME = 20
"""All modes of many links, which a secular equation takes, cost as much as the lowest of so many
times fewer variants than there are links."""

Varied = Mapping[int, Floats]
"""By the place of a device, or of a body: its numbers, of shape (variants,)."""


def variant_frequencies(  # noqa: PLR0913
    system: TorsionalSystem,
    modes: Sequence[int],
    *,
    stiffnesses: Varied,
    inertias: Varied,
    variants: int,
    first: FirstVariant | None = None,
) -> Floats:
    """Natural frequencies of a system with other stiffnesses and inertias.

    A mode keeps the number that it has in the first variant where frequencies cross.

    Parameters
    ----------
    system : TorsionalSystem
    modes : sequence of int
        Which, from 0, of those that are not rigid.
    stiffnesses : mapping of int to ndarray, shape (variants,)
        Of elastic devices, by their places in `TorsionalSystem.elastic`; above 0. [N*m/rad]
    inertias : mapping of int to ndarray, shape (variants,)
        Of bodies, by their places in `TorsionalSystem.bodies`; 0 or more. [kg*m^2]
    variants : int
        Their number.
    first : FirstVariant, optional
        That by which modes are numbered; the first of these when not given.

    Returns
    -------
    ndarray, shape (variants, len(modes))
        NaN where there are fewer modes. [rad/s]

    Examples
    --------
    Two masses of 2 on a shaft, ``omega^2 = c (1/2 + 1/J)``:

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> c, inertia = np.array([100.0, 200.0]), np.array([2.0, 0.5])
    >>> variant_frequencies(system, [0, 1], stiffnesses={0: c}, inertias={1: inertia}, variants=2)
    array([[10.        ,         nan],
           [22.36067977,         nan]])
    """
    found = np.full((variants, len(modes)), np.nan)
    if not variants:
        return found
    first = first or first_variant(stiffnesses, inertias)
    for rows in _alike(inertias, variants):
        some = {place: numbers[rows] for place, numbers in inertias.items()}
        others = {place: numbers[rows] for place, numbers in stiffnesses.items()}
        found[rows] = _of_one_structure(system, modes, others, some, len(rows), first)
    return found


class FirstVariant(NamedTuple):
    """The numbers of the first variant, by the places of devices and of bodies."""

    stiffnesses: Mapping[int, float]
    inertias: Mapping[int, float]

    def of(self, system: TorsionalSystem) -> TorsionalSystem:
        """The system with these numbers."""
        rates, inertias = system.rates, system.inertias
        rates[[*self.stiffnesses]] = [*self.stiffnesses.values()]
        inertias[[*self.inertias]] = [*self.inertias.values()]
        return _with_numbers(system, rates, inertias)


def first_variant(stiffnesses: Varied, inertias: Varied) -> FirstVariant:
    """The first of some variants."""
    return FirstVariant(
        {place: float(numbers[0]) for place, numbers in stiffnesses.items()},
        {place: float(numbers[0]) for place, numbers in inertias.items()},
    )


def _with_numbers(system: TorsionalSystem, rates: Floats, inertias: Floats) -> TorsionalSystem:
    """The system with other stiffnesses and inertias."""
    stiff, heavy = iter(rates.tolist()), iter(inertias.tolist())
    devices = [
        one if one.stiffness is None else one._replace(stiffness=next(stiff))
        for one in system.devices
    ]
    bodies = [one._replace(inertia=next(heavy)) for one in system.bodies]
    return system._replace(devices=tuple(devices), bodies=tuple(bodies))


def _alike(inertias: Varied, variants: int) -> Iterator[Integers]:
    """Variants in which the same bodies have an inertia: their motions split alike."""
    every = np.arange(variants)
    if all(numbers.all() for numbers in inertias.values()):
        yield every
        return
    patterns = np.column_stack([numbers > 0 for numbers in inertias.values()])
    _, kinds = np.unique(patterns, axis=0, return_inverse=True)
    for kind in range(int(kinds.max()) + 1):
        yield every[kinds.reshape(-1) == kind]


def _of_one_structure(  # noqa: PLR0913 PLR0917
    system: TorsionalSystem,
    modes: Sequence[int],
    stiffnesses: Varied,
    inertias: Varied,
    variants: int,
    first: FirstVariant,
) -> Floats:
    """The frequencies of variants in which the same bodies have an inertia."""
    stiff = _VariedNumbers(system.rates, stiffnesses)
    heavy = _VariedNumbers(system.inertias, inertias)
    alike = _Alike(_with_numbers(system, stiff.first, heavy.first), stiff, heavy)
    found = np.full((variants, len(modes)), np.nan)
    for one, own in alike.parts(first, modes):
        places = [index for index, mode in enumerate(modes) if mode in own]
        if places:
            asked = [own.index(modes[index]) for index in places]
            found[:, places] = one.frequencies(asked, variants)
    return found


def varied_numbers(own: Floats, varied: Varied, variants: Integers) -> Floats:
    """Numbers, or rows of them, for each of some variants, of shape (variants, ...)."""
    made: Floats = np.repeat(own[None], len(variants), axis=0)
    for place, numbers in varied.items():
        made[:, place] = numbers[variants]
    return made


class _VariedNumbers:
    """Numbers of devices or bodies: those of the first variant, and what is other in others."""

    def __init__(self, own: Floats, varied: Varied) -> None:
        self.first: Floats = varied_numbers(own, varied, np.arange(1))[0]
        self.varied = {p: numbers for p, numbers in varied.items() if (numbers != numbers[0]).any()}

    def only(self, places: Collection[int]) -> _VariedNumbers:
        """The same where the others are as in the first variant."""
        made = copy(self)
        made.varied = {place: n for place, n in self.varied.items() if place in places}
        return made

    def rows(self, start: int, stop: int) -> Floats:
        """All numbers of some variants: of one, if they are the same for all."""
        if not self.varied:
            return self.first[None]
        return varied_numbers(self.first, self.varied, np.arange(start, stop))


class _Alike:
    """Variants of a system that split alike."""

    def __init__(
        self, system: TorsionalSystem, stiff: _VariedNumbers, heavy: _VariedNumbers
    ) -> None:
        self.system, self.stiff, self.heavy = system, stiff, heavy
        self.split = coordinates(system)

    def parts(
        self, first: FirstVariant, modes: Sequence[int]
    ) -> Iterator[tuple[_Alike, Sequence[int]]]:
        """What stays apart in all variants, with the numbers of its modes in the first one.

        Of many links there is one part, of which the lowest modes alone are found.
        """
        system = first.of(self.system)
        alike = ((system.inertias > 0) == (self.system.inertias > 0)).all()
        whole = self, range(self.split.modes)
        if not alike or not self.split.modes or self.split.has_many_more(max(modes) + 1):
            yield whole
            return
        found = separate_motions(system, self.split, first.stiffnesses, first.inertias)
        if len(found) == 1:
            yield whole
            return
        for part in found:
            one = copy(self)
            one.split = part.split
            one.stiff, one.heavy = self.stiff.only(part.devices), self.heavy.only(part.bodies)
            yield one, part.modes

    def frequencies(self, modes: Sequence[int], variants: int) -> Floats:
        """Of shape (variants, modes), or (1, modes) if they are the same in all."""
        variants = variants if self.heavy.varied or self.stiff.varied else 1
        alone = not self.heavy.varied and len(self.stiff.varied) == 1
        if self.split.has_many_more(max(modes) + 1) and not (
            alone and variants * SOME > len(self.system.names)
        ):
            return np.array([self._lowest(variant, modes) for variant in range(variants)])
        if alone:
            [(device, numbers)] = self.stiff.varied.items()
            base = without(self.system, self.split, self.stiff.first, device)
            if base is None:  # the device carries no torque
                return self._of_matrices(modes, 1)
            squares = [
                squares_with_device(base.poles, 1 / numbers + base.slack, mode) for mode in modes
            ]
            return np.sqrt(squares).T
        return self._of_matrices(modes, variants)

    def _lowest(self, variant: int, modes: Sequence[int]) -> Floats:
        """Those of one variant of many links, by sparse matrices."""
        from vstatics.torsion.vibration.natural import lowest_modes  # which imports scipy

        numbers = (one.rows(variant, variant + 1)[0] for one in (self.stiff, self.heavy))
        system = _with_numbers(self.system, *numbers)
        omegas: Floats = lowest_modes(system, self.split, max(modes) + 1).omegas[modes]
        return omegas

    def _of_matrices(self, modes: Sequence[int], variants: int) -> Floats:
        """A few thousand matrices at a time."""
        system, split, heavy = self.system, self.split, self.heavy
        same = None if heavy.varied else normed_twists(system, split, heavy.first)
        step = max(NUMBERS // (len(self.stiff.first) * split.free.shape[1]), 1)
        found = []
        for start in range(0, variants, step):
            stop = min(start + step, variants)
            twists = same or normed_twists(system, split, heavy.rows(start, stop))
            omegas = natural_frequencies(twists, self.stiff.rows(start, stop), min(modes))
            found.append(omegas[:, modes])
        return np.concatenate(found)


class WithoutDevice(NamedTuple):
    """What the frequencies of a system with the device follow from.

    Attributes
    ----------
    poles : Poles
        The modes without the device.
    slack : float
        Compliance behind that of the device: of links without inertia, which give way in
        balance of the other devices. [rad/(N*m)]
    """

    poles: Poles
    slack: float


def without(
    system: TorsionalSystem, split: Coordinates, stiffnesses: Floats, device: int
) -> WithoutDevice | None:
    """The system without a device; None where the device carries no torque in any mode.

    Parameters
    ----------
    system : TorsionalSystem
    split : Coordinates
        Of the system with the device.
    stiffnesses : ndarray, shape (devices,)
        Of all elastic devices. [N*m/rad]
    device : int
        Its place among them.

    Examples
    --------
    A mass of 2 on a spring of 8, a shaft from there to a link without inertia, and from there
    a second shaft of 5 to a mass of 1: without the first shaft the second one is behind it.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.coordinates import coordinates
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> twists = {1: 1}, {1: 1, 2: -1}, {2: 1, 3: -1}
    >>> springs = [Spring(twist, stiffness=c) for twist, c in zip(twists, (8, 3, 5))]
    >>> case = Transmission(3, [], [], [], springs=springs, inertias={1: 2.0, 3: 1.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> poles, slack = without(system, coordinates(system), np.array([8.0, 3.0, 5.0]), 1)
    >>> poles.squares.round(9), poles.weights.round(9), round(slack, 9)
    (array([0., 4.]), array([1. , 0.5]), 0.2)
    """
    alone = _held_alone(system, device)
    if alone == "massless":
        return None
    own = normed_twists(system, split, system.inertias)
    others = NormedTwists(*(np.delete(part, device, axis=0) for part in own))
    [rows] = triangular(others, np.delete(stiffnesses, device)[None])
    count = own.massless.shape[1]
    of_massless, aside = rows[:count, :count], rows[:count, count:]
    against = np.linalg.solve(of_massless.T, own.massless[device])
    twists = own.heavy[device] - against @ aside
    _, sizes, vectors = np.linalg.svd(rows[count:, count:] if count else rows)
    squares = np.zeros(len(vectors))
    squares[: len(sizes)] = sizes**2
    if alone == "heavy":
        squares[-1] = 0.0
    weights = (vectors @ twists) ** 2
    return WithoutDevice(Poles(squares[::-1], weights[::-1]), float(against @ against))


def _held_alone(system: TorsionalSystem, device: int) -> Literal["", "heavy", "massless"]:
    """Whether a device resists a motion that no other resists, and whether that has inertia."""
    elastic = system.elastic_twists
    others = [*elastic[:device], *elastic[device + 1 :]]
    bodies = [body.form for body in system.bodies if body.inertia > 0]

    def is_held(*forms: Form) -> bool:
        free = [system.free(*some, *forms) for some in (others, elastic)]
        return bool(free[0].shape[1] > free[1].shape[1])

    return "massless" if is_held(*bodies) else "heavy" if is_held() else ""
