"""Eigenvalues with loss factors: each natural mode has the damping that is equal at its frequency.

So each mode has a D of its own. All are found at once with one D that is near to those of all; what
has a part in a mode is then corrected for the D of the mode (`refined`). Where that does not tell
for certain which eigenvalue has the largest part the mode is solved by itself.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from vstatics.core.numerics.arrays import Complex, Floats, Integers
from vstatics.torsion.tolerances import REAL_EIGENVALUE, SAME_MODULUS
from vstatics.torsion.vibration.eigen_pairs import EigenPairs, Pencil, eigen_pairs, settled
from vstatics.torsion.vibration.refined import STACKED_NUMBERS, Pencils, Refined, refined

LIGHTLY_DAMPED = 0.3
"""Up to this damping ratio squares of parts in a mode add up to 1, nearly. [-]"""
REST = 0.5
"""What is left of that sum, by the largest square, is of none that is larger. [-]"""
SAME_SHAPE = 0.9999
"""The part of a shape that is all but that of a mode which is damped more. [-]"""
MOST_CANDIDATES = 5
"""For a mode."""


def pairs_of_modes(pencil: Pencil, omegas: Floats) -> Complex:
    """Both eigenvalues of each natural mode, of shape (modes, 2)."""
    if not len(omegas):
        return np.zeros((0, 2), np.complex128)
    pairs = np.full((len(omegas), 2), np.nan, np.complex128)
    if pencil.symmetric:  # as what is corrected takes for granted
        found = eigen_pairs(pencil, pencil.resistance_of_all(omegas))
        pieces = math.ceil(len(omegas) * len(pencil.stiffness) ** 2 / STACKED_NUMBERS)
        parts = np.array_split(np.arange(len(omegas)), pieces)
        pairs = np.concatenate([_corrected(pencil, omegas[one], one, found) for one in parts])
    for mode in np.flatnonzero(np.isnan(pairs[:, 0])).tolist():
        own = eigen_pairs(pencil, pencil.viscous + pencil.lost / omegas[mode])
        pairs[mode] = own.values([mode])
    return pairs


def _corrected(pencil: Pencil, omegas: Floats, modes: Integers, found: EigenPairs) -> Complex:
    """Those of some modes with the D of each; NaN where not certain."""
    pencils, pairs = pencil.at(omegas), np.full((len(modes), 2), np.nan, np.complex128)
    light = pencils.resistances[np.arange(len(modes)), modes, modes] <= 2 * LIGHTLY_DAMPED * omegas
    asked = [
        _candidates(found, mode) if lightly else found.of_mode(mode)[:1]
        for mode, lightly in zip(modes.tolist(), light, strict=True)
    ]
    rows = np.repeat(np.arange(len(modes)), [*map(len, asked)])
    starts = found.shapes[:, [start for one in asked for start in one]].T
    near = refined(pencils.of(rows), _roots(pencils.of(rows), starts), starts)
    values, parts = _told(pencil, near, modes[rows])
    for row, lightly in enumerate(light):
        own = np.flatnonzero(rows == row)
        best = own[np.argmax(parts[own])]
        if _are_all(values[own], parts[own]) if lightly else parts[best] > SAME_SHAPE:
            pairs[row] = values[best], values[best].conjugate()
    creeps = np.flatnonzero(pairs[:, 0].imag == 0)
    some, faster = pencils.of(creeps), [found.of_mode(mode)[1] for mode in modes[creeps].tolist()]
    starts = found.shapes[:, faster].T
    near = refined(some, some.roots(starts)[1], starts)
    values, parts = _told(pencil, near, modes[creeps])
    pairs[creeps, 1] = np.where(parts > SAME_SHAPE, values, np.nan)
    apart = np.abs(pairs[:, 1] - pairs[:, 0]) > SAME_MODULUS * np.abs(pairs[:, 0])
    pairs[~apart | (pairs[:, 1].imag > 0)] = np.nan
    return pairs


def _roots(pencils: Pencils, shapes: Complex) -> Complex:
    """Where to begin: with the root of a shape that swings, else with the slower one."""
    slow, fast = pencils.roots(shapes)
    swings = np.abs(slow.imag) > REAL_EIGENVALUE * np.abs(slow)
    return np.where(swings & (fast.imag > slow.imag), fast, slow)


def _told(pencil: Pencil, near: Refined, modes: Integers) -> tuple[Complex, Floats]:
    """Eigenvalues, NaN where none was found, and the part of each in a mode."""
    values = settled(near.eigenvalues.real + 1j * np.abs(near.eigenvalues.imag))
    parts = np.abs(near.shapes[np.arange(len(modes)), modes])
    parts /= pencil.lengths(near.shapes.T, near.eigenvalues)
    return np.where(near.converged, values, np.nan), np.where(near.converged, parts, 0.0)


def _candidates(found: EigenPairs, mode: int) -> Sequence[int]:
    """Those beside which no other can have the largest part in a lightly damped mode."""
    squares = np.abs(found.shapes[mode]) ** 2
    order = np.argsort(-squares, kind="stable")[:MOST_CANDIDATES]
    enough = 1 - np.cumsum(squares[order]) < REST / 2 * squares[order[0]]
    return [int(one) for one in order[: int(np.argmax(enough)) + 1]]


def _are_all(values: Complex, parts: Floats) -> bool:
    """Whether candidates were found, each another that swings, and none is missing."""
    if not (values.imag > 0).all():
        return False
    apart = np.abs(values[:, None] - values) + np.diag(np.full(len(values), np.inf))
    rest = 1 - float((parts**2).sum())
    return bool(rest < REST * parts.max() ** 2 and (apart > SAME_MODULUS * np.abs(values)).all())
