"""Natural frequencies of variants with other ratios, in which links are joined otherwise.

Their motions follow those of the first variant (`followed`), of which the ranks are known.

What homogeneous equations leave free, for many variants of them that go the same way.

The rank of the first variant is known, from entries that tell by themselves when they are zero
(`numerics.motions`). Others are solved for the same unknowns by the same equations. Where that
is well conditioned and the other equations hold too their rank is the same; where it is not,
the variant has to be looked at alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.torsion.system.coordinates import Coordinates, coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import LOST_PIVOT, NO_ROW, RESIDUE
from vstatics.torsion.vibration.modal_masses import Split, natural_frequencies, of_split
from vstatics.torsion.vibration.variants import NUMBERS, Varied, varied_numbers


class VariedSystem(NamedTuple):
    """A system and what is other in its variants; it is the first of them.

    Attributes
    ----------
    system : TorsionalSystem
    twists : mapping of int to ndarray, shape (variants, links)
        By places in `TorsionalSystem.devices`.
    stiffnesses, inertias : mapping of int to ndarray, shape (variants,)
        By places among elastic devices and among bodies. [N*m/rad, kg*m^2]
    """

    system: TorsionalSystem
    twists: Mapping[int, Floats]
    stiffnesses: Varied
    inertias: Varied


def frequencies_of_ratios(
    varied: VariedSystem, modes: Sequence[int], variants: int
) -> tuple[Floats, Booleans]:
    """The frequencies of variants, and which go the way of the first: others are unknown.

    Returns
    -------
    ndarray, shape (variants, len(modes)), and ndarray, shape (variants,)
        NaN where there are fewer modes. [rad/s]

    Examples
    --------
    A mass of 1 on a shaft of 100 to a pair of wheels, another of 1 behind these:
    ``omega^2 = c (1 + u^2)``; the ratio -2 and the ratio -3.

    >>> from vstatics import Mechanism, Spring, Transmission
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> shaft, pair = Spring({1: 1, 2: -1}, stiffness=100.0), Mechanism(2, 3, 0, -2.0)
    >>> case = Transmission(3, [], [pair], [], springs=[shaft], inertias={1: 1.0, 3: 1.0})
    >>> twists = np.array([[0.0, 1.0, 2.0], [0.0, 1.0, 3.0]])
    >>> system = torsional_system(case, case.gears[0])
    >>> frequencies_of_ratios(VariedSystem(system, {0: twists}, {}, {}), [0], 2)
    (array([[22.36067977],
           [31.6227766 ]]), array([ True,  True]))
    """
    system = varied.system
    bodies = list(system.bodies)
    for place, numbers in varied.inertias.items():
        bodies[place] = bodies[place]._replace(inertia=float(numbers[0]))
    system = system._replace(bodies=tuple(bodies))
    split = coordinates(system)
    found = np.full((variants, len(modes)), np.nan)
    safe = np.zeros(variants, np.bool_)
    if split.undetermined.any() or not variants:
        return found, safe
    existing = [place for place, mode in enumerate(modes) if mode < split.modes]
    step = max(NUMBERS // (len(system.devices) * len(system.names)), 1)
    for start in range(0, variants, step):
        rows = np.arange(start, min(start + step, variants))
        omegas, kept = _block(varied._replace(system=system), split, np.append(0, rows))
        for place in existing:
            found[rows, place] = omegas[1:, modes[place]]
        safe[rows] = kept[1:]
    return found, safe


def _block(varied: VariedSystem, split: Coordinates, variants: Integers) -> tuple[Floats, Booleans]:
    """All frequencies of a few variants, the first of all before them."""
    system = varied.system
    every = system.rows([one.twist for one in system.devices])
    forms = varied_numbers(every, varied.twists, variants)
    stiffnesses = varied_numbers(system.rates, varied.stiffnesses, variants)
    inertias = varied_numbers(system.inertias, varied.inertias, variants)
    rigid = np.array([one.stiffness is None for one in system.devices])
    heavy = inertias > 0

    free = followed_motions(forms[:, rigid], split.free.shape[1])
    bodies = system.speeds @ free.motions
    still = followed_motions(bodies[:, heavy[0]], split.massless.shape[1])
    twists = forms[:, ~rigid] @ free.motions
    together = followed_motions(twists, split.rigid.shape[1])
    massless = twists @ still.motions
    moving, others = still.others, together.motions[:, still.free]
    by_heavy = together.motions[:, moving] - still.motions[:, moving] @ others
    safe = free.safe & still.safe & together.safe & _resisted(massless)
    safe &= (heavy == heavy[0]).all(axis=1)

    parts = Split(bodies[:, :, moving], twists[:, :, moving], massless, by_heavy)
    omegas = np.full((len(variants), split.modes), np.nan)
    if split.modes and safe.any():
        normed = of_split(Split(*(part[safe] for part in parts)), inertias[safe])
        omegas[safe] = natural_frequencies(normed, stiffnesses[safe])
    return omegas, safe


def _resisted(massless: Floats) -> Booleans:
    """Whether devices resist all massless motions, as in the first variant."""
    if not massless.shape[2]:
        return np.ones(len(massless), np.bool_)
    sizes = np.linalg.svd(massless, compute_uv=False)
    shares = sizes[:, -1] / sizes[:, 0]
    resisted: Booleans = shares > LOST_PIVOT * shares[0]
    return resisted


class FollowedMotions(NamedTuple):
    """Solutions of variants.

    Attributes
    ----------
    motions : ndarray, shape (variants, unknowns, free)
        In each column one of the free unknowns is 1, the others of these 0.
    free, others : ndarray of int
        Which unknowns are left free, in the order of the columns, and which follow.
    safe : ndarray, shape (variants,)
        Whether a variant goes as the first does; of others the motions say nothing.
    """

    motions: Floats
    free: Integers
    others: Integers
    safe: Booleans


def followed_motions(equations: Floats, free: int) -> FollowedMotions:
    """What equations leave free in many variants.

    Parameters
    ----------
    equations : ndarray, shape (variants, equations, unknowns)
    free : int
        How many unknowns are free in the first variant.

    Examples
    --------
    Two wheels of ratio -2 and of -4, and a pair of equations whose rank is another:

    >>> equations = np.array([[[1.0, 2.0], [2.0, 4.0]], [[1.0, 4.0], [2.0, 8.0]],
    ...                       [[1.0, 4.0], [2.0, 9.0]]])
    >>> found = followed_motions(equations, 1)
    >>> found.motions[:2, :, 0].tolist(), found.safe.tolist()
    ([[1.0, -0.5], [1.0, -0.25]], [True, True, False])
    """
    variants, _, unknowns = equations.shape
    rows, others = _pivots(equations[0], unknowns - free)
    open_ones = np.setdiff1d(np.arange(unknowns), others)
    motions = np.zeros((variants, unknowns, free))
    motions[:, open_ones, np.arange(free)] = 1.0
    safe = np.ones(variants, np.bool_)
    if len(rows):
        block = equations[:, rows[:, None], others]
        with np.errstate(all="ignore"):
            sizes = np.abs(block).max(axis=2)
            sizes = np.maximum(sizes, sizes[0])  # a row that is nearly nothing counts as that
            shares = np.abs(np.linalg.det(block)) / sizes.prod(axis=1)
            safe = shares > LOST_PIVOT * shares[0]
        block[~safe] = block[0]
        motions[:, others] = -np.linalg.solve(block, equations[:, rows[:, None], open_ones])
    largest = np.abs(equations).max(axis=2, keepdims=True, initial=0.0)
    sizes = largest * np.abs(motions).max(axis=1, keepdims=True, initial=0.0)
    safe &= (np.abs(equations @ motions) <= RESIDUE * sizes).all(axis=(1, 2))
    return FollowedMotions(motions, open_ones, others, safe)


def _pivots(matrix: Floats, rank: int) -> tuple[Integers, Integers]:
    """Equations and unknowns of a regular block, by elimination with the largest pivot."""
    left = matrix / np.maximum(np.abs(matrix).max(axis=1, keepdims=True, initial=0.0), NO_ROW)
    rows, columns = [], []
    for _ in range(rank):
        row, column = np.unravel_index(int(np.argmax(np.abs(left))), left.shape)
        rows.append(row)
        columns.append(column)
        left = left - np.outer(left[:, column], left[row]) / left[row, column]
        left[row] = 0.0
        left[:, column] = 0.0
    return np.array(rows, np.int64), np.array(columns, np.int64)
