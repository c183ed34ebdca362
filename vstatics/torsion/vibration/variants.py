"""Natural frequencies of many variants of a system with other stiffnesses and inertias.

The possible motions do not depend on stiffnesses and inertias, and are determined once for all
variants. If a single stiffness varies, its secular equation is solved for all variants (`secular`);
otherwise stacks of small matrices are solved (`modal_masses`).
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
"""Largest number of matrix entries that are solved at once, which fit into the cache."""
SOME = 20
"""Ratio of links to variants above which a single varied stiffness needs no secular equation.

The secular equation requires all modes, which take as long as the lowest modes of ``links/SOME``
variants.
"""

Varied = Mapping[int, Floats]
"""Numbers by index of the component or body, each of shape (variants,)."""


def variant_frequencies(  # noqa: PLR0913
    system: TorsionalSystem,
    modes: Sequence[int],
    *,
    stiffnesses: Varied,
    inertias: Varied,
    variants: int,
    first: FirstVariant | None = None,
) -> Floats:
    """Return natural frequencies of a system for other stiffnesses and inertias.

    A mode has the same number as in the first variant, even if frequencies cross.

    Parameters
    ----------
    system : TorsionalSystem
        System with the numbers that do not vary.
    modes : sequence of int
        Numbers of modes, from 0, without rigid modes.
    stiffnesses : mapping of int to ndarray, shape (variants,)
        Stiffnesses above 0, by index in `TorsionalSystem.elastic`. [N*m/rad]
    inertias : mapping of int to ndarray, shape (variants,)
        Inertias by index in `TorsionalSystem.bodies`. [kg*m^2]
    variants : int
        Number of variants.
    first : FirstVariant, optional
        Variant that determines the numbers of modes, by default the first of the given variants.

    Returns
    -------
    ndarray, shape (variants, len(modes))
        Angular frequencies, NaN where a variant has fewer modes. [rad/s]

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
    frequencies = np.full((variants, len(modes)), np.nan)
    if not variants:
        return frequencies
    first = first or first_variant(stiffnesses, inertias)
    for rows in _alike(inertias, variants):
        of_bodies = {place: numbers[rows] for place, numbers in inertias.items()}
        of_devices = {place: numbers[rows] for place, numbers in stiffnesses.items()}
        stiff = _VariedNumbers(system.rates, of_devices)
        heavy = _VariedNumbers(system.inertias, of_bodies)
        alike = _Alike(_with_numbers(system, stiff.first, heavy.first), stiff, heavy)
        for part, modes_of_part in alike.parts(first, modes):
            places = [index for index, mode in enumerate(modes) if mode in modes_of_part]
            if places:
                asked = [modes_of_part.index(modes[index]) for index in places]
                frequencies[rows[:, None], places] = part.frequencies(asked, len(rows))
    return frequencies


class FirstVariant(NamedTuple):
    """Stiffnesses and inertias of the first variant, by indices of components and bodies."""

    stiffnesses: Mapping[int, float]
    inertias: Mapping[int, float]

    def of(self, system: TorsionalSystem) -> TorsionalSystem:
        """Return the system with the numbers of the first variant."""
        rates, inertias = system.rates, system.inertias
        rates[[*self.stiffnesses]] = [*self.stiffnesses.values()]
        inertias[[*self.inertias]] = [*self.inertias.values()]
        return _with_numbers(system, rates, inertias)


def first_variant(stiffnesses: Varied, inertias: Varied) -> FirstVariant:
    """Return the stiffnesses and inertias of the first variant."""
    return FirstVariant(
        {place: float(numbers[0]) for place, numbers in stiffnesses.items()},
        {place: float(numbers[0]) for place, numbers in inertias.items()},
    )


def _with_numbers(system: TorsionalSystem, rates: Floats, inertias: Floats) -> TorsionalSystem:
    stiff, heavy = iter(rates.tolist()), iter(inertias.tolist())
    devices = [
        device if device.stiffness is None else device._replace(stiffness=next(stiff))
        for device in system.devices
    ]
    bodies = [body._replace(inertia=next(heavy)) for body in system.bodies]
    return system._replace(devices=tuple(devices), bodies=tuple(bodies))


def _alike(inertias: Varied, variants: int) -> Iterator[Integers]:
    """Yield groups of variants in which the same bodies have inertia."""
    every = np.arange(variants)
    if all(numbers.all() for numbers in inertias.values()):
        yield every
        return
    patterns = np.column_stack([numbers > 0 for numbers in inertias.values()])
    _, kinds = np.unique(patterns, axis=0, return_inverse=True)
    for kind in range(int(kinds.max()) + 1):
        yield every[kinds.reshape(-1) == kind]


def varied_numbers(constants: Floats, varied: Varied, variants: Integers) -> Floats:
    """Return the numbers of some variants, shape (variants, numbers)."""
    numbers_of_variants = np.repeat(constants[None], len(variants), axis=0)
    for place, numbers in varied.items():
        numbers_of_variants[:, place] = numbers[variants]
    return numbers_of_variants


class _VariedNumbers:
    """Stiffnesses of all components, or inertias of all bodies, some of which vary."""

    def __init__(self, constants: Floats, varied: Varied) -> None:
        self.first: Floats = varied_numbers(constants, varied, np.arange(1))[0]
        self.varied = {p: numbers for p, numbers in varied.items() if (numbers != numbers[0]).any()}

    def only(self, places: Collection[int]) -> _VariedNumbers:
        """Restrict the variation to some indices; other numbers are as in the first variant."""
        restricted = copy(self)
        restricted.varied = {place: n for place, n in self.varied.items() if place in places}
        return restricted

    def rows(self, start: int, stop: int) -> Floats:
        """Return the numbers of variants `start` to `stop`, or a single row if none varies."""
        if not self.varied:
            return self.first[None]
        return varied_numbers(self.first, self.varied, np.arange(start, stop))


class _Alike:
    """Variants of a system that have the same basis of motions."""

    def __init__(
        self, system: TorsionalSystem, stiff: _VariedNumbers, heavy: _VariedNumbers
    ) -> None:
        self.system, self.stiff, self.heavy = system, stiff, heavy
        self.split = coordinates(system)

    def parts(
        self, first: FirstVariant, modes: Sequence[int]
    ) -> Iterator[tuple[_Alike, Sequence[int]]]:
        """Yield groups of motions that are uncoupled in all variants, with the modes of each.

        A system of many links is not divided, because only its lowest modes are calculated.
        """
        system = first.of(self.system)
        alike = ((system.inertias > 0) == (self.system.inertias > 0)).all()
        whole = self, range(self.split.modes)
        if not alike or not self.split.modes or self.split.has_many_more(max(modes) + 1):
            yield whole
            return
        separate = separate_motions(system, self.split, first.stiffnesses, first.inertias)
        if len(separate) == 1:
            yield whole
            return
        for part in separate:
            variants_of_part = copy(self)
            variants_of_part.split = part.split
            variants_of_part.stiff, variants_of_part.heavy = (
                self.stiff.only(part.devices),
                self.heavy.only(part.bodies),
            )
            yield variants_of_part, part.modes

    def frequencies(self, modes: Sequence[int], variants: int) -> Floats:
        """Return frequencies [rad/s], shape (variants, modes); (1, modes) if nothing varies."""
        variants = variants if self.heavy.varied or self.stiff.varied else 1
        alone = not self.heavy.varied and len(self.stiff.varied) == 1
        if self.split.has_many_more(max(modes) + 1) and not (
            alone and variants * SOME > len(self.system.names)
        ):
            return np.array([self._lowest(variant, modes) for variant in range(variants)])
        if alone:
            [(device, numbers)] = self.stiff.varied.items()
            base = without(self.system, self.split, self.stiff.first, device)
            if base is None:  # the stiffness of `device` has no effect
                return self._of_matrices(modes, 1)
            squares = [
                squares_with_device(base.poles, 1 / numbers + base.slack, mode) for mode in modes
            ]
            return np.sqrt(squares).T
        return self._of_matrices(modes, variants)

    def _lowest(self, variant: int, modes: Sequence[int]) -> Floats:
        from vstatics.torsion.vibration.natural import lowest_modes  # imports scipy

        numbers = (varied.rows(variant, variant + 1)[0] for varied in (self.stiff, self.heavy))
        system = _with_numbers(self.system, *numbers)
        return lowest_modes(system, self.split, max(modes) + 1).omegas[modes]

    def _of_matrices(self, modes: Sequence[int], variants: int) -> Floats:
        system, split, heavy = self.system, self.split, self.heavy
        common = None if heavy.varied else normed_twists(system, split, heavy.first)
        step = max(NUMBERS // (len(self.stiff.first) * split.bound.shape[1]), 1)
        blocks = []
        for start in range(0, variants, step):
            stop = min(start + step, variants)
            twists = common or normed_twists(system, split, heavy.rows(start, stop))
            omegas = natural_frequencies(twists, self.stiff.rows(start, stop), min(modes))
            blocks.append(omegas[:, modes])
        return np.concatenate(blocks)


class WithoutDevice(NamedTuple):
    """System without a component, from which the frequencies with the component follow.

    Attributes
    ----------
    poles : Poles
        Modes without the component.
    slack : float
        Compliance, in series with the component, of other components that hold its massless links.
        [rad/(N*m)]
    """

    poles: Poles
    slack: float


def without(
    system: TorsionalSystem, split: Coordinates, stiffnesses: Floats, device: int
) -> WithoutDevice | None:
    """Cut an elastic component out of a system; return None if it carries no torque in any mode.

    Parameters
    ----------
    system : TorsionalSystem
        System with the component.
    split : Coordinates
        Coordinates of this system.
    stiffnesses : ndarray, shape (devices,)
        Stiffnesses of all elastic components. [N*m/rad]
    device : int
        Index of the component among the elastic components.

    Examples
    --------
    A mass of 2 on a spring of 8 is connected to a mass of 1 by two shafts in series. If the
    first shaft is cut, the second shaft (stiffness 5, compliance 0.2) is a loose end on the mass 1.

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
    held_motion = _held_alone(system, device)
    if held_motion == "massless":
        return None
    normed = normed_twists(system, split, system.inertias)
    others = NormedTwists(*(np.delete(part, device, axis=0) for part in normed))
    [rows] = triangular(others, np.delete(stiffnesses, device)[None])
    count = normed.massless.shape[1]
    of_massless, by_modes = rows[:count, :count], rows[:count, count:]
    shares = np.linalg.solve(of_massless.T, normed.massless[device])
    twists = normed.heavy[device] - shares @ by_modes
    _, sizes, vectors = np.linalg.svd(rows[count:, count:] if count else rows)
    squares = np.zeros(len(vectors))
    squares[: len(sizes)] = sizes**2
    if held_motion == "heavy":
        squares[-1] = 0.0
    weights = (vectors @ twists) ** 2
    return WithoutDevice(Poles(squares[::-1], weights[::-1]), float(shares @ shares))


def _held_alone(system: TorsionalSystem, device: int) -> Literal["", "heavy", "massless"]:
    """Return the kind of motion that no component except `device` resists, or an empty text."""
    elastic = system.elastic_twists
    others = [*elastic[:device], *elastic[device + 1 :]]

    def is_held(*forms: Form) -> bool:
        free = [system.free(*resisting, *forms) for resisting in (others, elastic)]
        return bool(free[0].shape[1] > free[1].shape[1])

    return "massless" if is_held(*system.heavy) else "heavy" if is_held() else ""
