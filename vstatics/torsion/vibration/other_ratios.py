"""Natural frequencies of variants with other ratios of gear sets.

The possible motions of each variant are the solutions of homogeneous equations
(`followed_motions`). The rank of these equations is known for the first variant
(`numerics.motions`). Other variants are solved with the same equations for the same unknowns. If
this block of equations is well conditioned, and the solution satisfies all other equations, the
rank is the same. Otherwise the variant must be analysed separately.
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
from vstatics.torsion.vibration.variants import NUMBERS, Varied, first_variant, varied_numbers


class VariedSystem(NamedTuple):
    """System of the first variant, and the numbers of other variants.

    Attributes
    ----------
    system : TorsionalSystem
        System of the first variant.
    twists : mapping of int to ndarray, shape (variants, links)
        Varied twists, by index in `TorsionalSystem.devices`.
    stiffnesses, inertias : mapping of int to ndarray, shape (variants,)
        Varied numbers, by index of the elastic component or body. [N*m/rad, kg*m^2]
    """

    system: TorsionalSystem
    twists: Mapping[int, Floats]
    stiffnesses: Varied
    inertias: Varied


def frequencies_of_ratios(
    varied: VariedSystem, modes: Sequence[int], variants: int
) -> tuple[Floats, Booleans]:
    """Calculate the natural frequencies of variants with other ratios.

    Returns
    -------
    ndarray, shape (variants, len(modes))
        Angular natural frequencies, NaN where a variant has fewer modes. [rad/s]
    ndarray of bool, shape (variants,)
        True if the rank is as in the first variant; otherwise the frequencies are unknown.

    Examples
    --------
    A mass of 1 on a shaft of 100 to a gear pair, and a mass of 1 on the driven gear:
    ``omega^2 = c (1 + u^2)`` for the ratios -2 and -3.

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
    system = first_variant({}, varied.inertias).of(varied.system)
    split = coordinates(system)
    frequencies = np.full((variants, len(modes)), np.nan)
    safe = np.zeros(variants, np.bool_)
    if split.undetermined.any() or split.drifting.size or not variants:
        return frequencies, safe
    existing = [place for place, mode in enumerate(modes) if mode < split.modes]
    step = max(NUMBERS // (len(system.devices) * len(system.names)), 1)
    for start in range(0, variants, step):
        rows = np.arange(start, min(start + step, variants))
        omegas, safe_rows = _block(varied._replace(system=system), split, np.append(0, rows))
        for place in existing:
            frequencies[rows, place] = omegas[1:, modes[place]]
        safe[rows] = safe_rows[1:]
    return frequencies, safe


def _block(varied: VariedSystem, split: Coordinates, variants: Integers) -> tuple[Floats, Booleans]:
    """Return all frequencies of the first variant and of `variants`, and flags of equal rank."""
    system = varied.system
    every = system.rows([device.twist for device in system.devices])
    forms = varied_numbers(every, varied.twists, variants)
    stiffnesses = varied_numbers(system.rates, varied.stiffnesses, variants)
    inertias = varied_numbers(system.inertias, varied.inertias, variants)
    rigid = np.array([device.stiffness is None for device in system.devices])
    heavy = inertias > 0

    free = followed_motions(forms[:, rigid], split.free.shape[1])
    bodies = system.speeds @ free.motions
    still = followed_motions(bodies[:, heavy[0]], split.massless.shape[1])
    twists = forms[:, ~rigid] @ free.motions
    together = followed_motions(twists, split.rigid.shape[1])
    massless = twists @ still.motions
    moving, others = still.others, together.motions[:, still.free]
    by_heavy = together.motions[:, moving] - still.motions[:, moving] @ others
    safe = free.safe & still.safe & together.safe & (heavy == heavy[0]).all(axis=1)
    if massless.shape[2]:  # the components must resist all massless motions
        sizes = np.linalg.svd(massless, compute_uv=False)
        shares = sizes[:, -1] / sizes[:, 0]
        safe &= shares > LOST_PIVOT * shares[0]

    parts = Split(bodies[:, :, moving], twists[:, :, moving], massless, by_heavy)
    omegas = np.full((len(variants), split.modes), np.nan)
    if split.modes and safe.any():
        normed = of_split(Split(*(part[safe] for part in parts)), inertias[safe])
        omegas[safe] = natural_frequencies(normed, stiffnesses[safe])
    return omegas, safe


class FollowedMotions(NamedTuple):
    """Solutions of the homogeneous equations of all variants.

    Attributes
    ----------
    motions : ndarray, shape (variants, unknowns, free)
        Solutions as columns; in each column a single free unknown is 1, all other free unknowns 0.
    free, others : ndarray of int
        Indices of the free unknowns, in the order of the columns, and of the dependent unknowns.
    safe : ndarray, shape (variants,)
        True if the rank is as in the first variant; otherwise the motions are meaningless.
    """

    motions: Floats
    free: Integers
    others: Integers
    safe: Booleans


def followed_motions(equations: Floats, free: int) -> FollowedMotions:
    """Solve homogeneous equations for many variants of the same rank.

    Parameters
    ----------
    equations : ndarray, shape (variants, equations, unknowns)
    free : int
        Number of free unknowns in the first variant.

    Examples
    --------
    Two gear pairs of ratio -2 and -4, and equations of another rank:

    >>> equations = np.array([[[1.0, 2.0], [2.0, 4.0]], [[1.0, 4.0], [2.0, 8.0]],
    ...                       [[1.0, 4.0], [2.0, 9.0]]])
    >>> solution = followed_motions(equations, 1)
    >>> solution.motions[:2, :, 0].tolist(), solution.safe.tolist()
    ([[1.0, -0.5], [1.0, -0.25]], [True, True, False])
    """
    variants, _, unknowns = equations.shape
    rows, others = _pivots(equations[0], unknowns - free)
    free_unknowns = np.setdiff1d(np.arange(unknowns), others)
    motions = np.zeros((variants, unknowns, free))
    motions[:, free_unknowns, np.arange(free)] = 1.0
    safe = np.ones(variants, np.bool_)
    if len(rows):
        block = equations[:, rows[:, None], others]
        with np.errstate(all="ignore"):
            sizes = np.abs(block).max(axis=2)
            sizes = np.maximum(sizes, sizes[0])  # rows with much smaller numbers count as 0
            shares = np.abs(np.linalg.det(block)) / sizes.prod(axis=1)
            safe = shares > LOST_PIVOT * shares[0]
        block[~safe] = block[0]
        motions[:, others] = -np.linalg.solve(block, equations[:, rows[:, None], free_unknowns])
    largest = np.abs(equations).max(axis=2, keepdims=True, initial=0.0)
    sizes = largest * np.abs(motions).max(axis=1, keepdims=True, initial=0.0)
    safe &= (np.abs(equations @ motions) <= RESIDUE * sizes).all(axis=(1, 2))
    return FollowedMotions(motions, free_unknowns, others, safe)


def _pivots(matrix: Floats, rank: int) -> tuple[Integers, Integers]:
    """Return indices of equations and unknowns that form a regular block, by full pivoting."""
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
