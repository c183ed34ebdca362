"""Eigenvalues of systems with loss factors, with separate equivalent damping for each mode.

Each mode has its own matrix D. First all modes are solved with a common D that is close to all
these matrices. Then candidate eigenvalues of each mode are corrected for its D (`refined`). If it
remains uncertain which eigenvalue has the largest share of a mode, the mode is solved separately.
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
"""Damping ratio up to which the squared shares of a mode in all shapes add up to nearly 1. [-]"""
REST = 0.5
"""Deficit of the sum of squared shares that means a missing shape, relative to the largest. [-]"""
SAME_SHAPE = 0.9999
"""Share of a heavily damped mode in a shape above which the shape belongs to the mode. [-]"""
MOST_CANDIDATES = 5
"""Largest number of candidate eigenvalues for a mode."""


def pairs_of_modes(pencil: Pencil, omegas: Floats) -> Complex:
    """Return the two eigenvalues of each natural mode, shape (modes, 2) [1/s]."""
    if not len(omegas):
        return np.zeros((0, 2), np.complex128)
    pairs = np.full((len(omegas), 2), np.nan, np.complex128)
    if pencil.symmetric:  # `refined` requires symmetric matrices
        common = eigen_pairs(pencil, pencil.resistance_of_all(omegas))
        pieces = math.ceil(len(omegas) * len(pencil.stiffness) ** 2 / STACKED_NUMBERS)
        parts = np.array_split(np.arange(len(omegas)), pieces)
        pairs = np.concatenate([_corrected(pencil, omegas[part], part, common) for part in parts])
    for mode in np.flatnonzero(np.isnan(pairs[:, 0])).tolist():
        of_mode = eigen_pairs(pencil, pencil.viscous + pencil.lost / omegas[mode])
        pairs[mode] = of_mode.values([mode])
    return pairs


def _corrected(pencil: Pencil, omegas: Floats, modes: Integers, common: EigenPairs) -> Complex:
    """Return eigenvalues corrected for the matrix D of each mode, NaN where uncertain."""
    pencils, pairs = pencil.at(omegas), np.full((len(modes), 2), np.nan, np.complex128)
    light = pencils.resistances[np.arange(len(modes)), modes, modes] <= 2 * LIGHTLY_DAMPED * omegas
    candidates_of_modes = [
        _candidates(common, mode) if lightly else common.of_mode(mode)[:1]
        for mode, lightly in zip(modes.tolist(), light, strict=True)
    ]
    rows = np.repeat(np.arange(len(modes)), [*map(len, candidates_of_modes)])
    starts = common.shapes[:, [place for places in candidates_of_modes for place in places]].T
    pairs_of_candidates = refined(pencils.of(rows), _roots(pencils.of(rows), starts), starts)
    values, parts = _values_and_parts(pencil, pairs_of_candidates, modes[rows])
    for row, lightly in enumerate(light):
        candidates = np.flatnonzero(rows == row)
        best = candidates[np.argmax(parts[candidates])]
        if _are_all(values[candidates], parts[candidates]) if lightly else parts[best] > SAME_SHAPE:
            pairs[row] = values[best], values[best].conjugate()
    creeps = np.flatnonzero(pairs[:, 0].imag == 0)
    overdamped = pencils.of(creeps)
    faster = [common.of_mode(mode)[1] for mode in modes[creeps].tolist()]
    starts = common.shapes[:, faster].T
    pairs_of_candidates = refined(overdamped, overdamped.roots(starts)[1], starts)
    values, parts = _values_and_parts(pencil, pairs_of_candidates, modes[creeps])
    pairs[creeps, 1] = np.where(parts > SAME_SHAPE, values, np.nan)
    apart = np.abs(pairs[:, 1] - pairs[:, 0]) > SAME_MODULUS * np.abs(pairs[:, 0])
    pairs[~apart | (pairs[:, 1].imag > 0)] = np.nan
    return pairs


def _candidates(common: EigenPairs, mode: int) -> Sequence[int]:
    """Return the indices of eigenvalues that can belong to a lightly damped mode."""
    squares = np.abs(common.shapes[mode]) ** 2
    order = np.argsort(-squares, kind="stable")[:MOST_CANDIDATES]
    enough = 1 - np.cumsum(squares[order]) < REST / 2 * squares[order[0]]
    return [int(place) for place in order[: int(np.argmax(enough)) + 1]]


def _roots(pencils: Pencils, shapes: Complex) -> Complex:
    """Return a first eigenvalue for each shape: the complex root, or the smaller real root."""
    slow, fast = pencils.roots(shapes)
    swings = np.abs(slow.imag) > REAL_EIGENVALUE * np.abs(slow)
    return np.where(swings & (fast.imag > slow.imag), fast, slow)


def _values_and_parts(pencil: Pencil, near: Refined, modes: Integers) -> tuple[Complex, Floats]:
    """Return eigenvalues, NaN if not converged, and the share of a mode in each shape."""
    values = settled(near.eigenvalues.real + 1j * np.abs(near.eigenvalues.imag))
    parts = np.abs(near.shapes[np.arange(len(modes)), modes])
    parts /= pencil.lengths(near.shapes.T, near.eigenvalues)
    return np.where(near.converged, values, np.nan), np.where(near.converged, parts, 0.0)


def _are_all(values: Complex, parts: Floats) -> bool:
    """Return whether all candidates of a mode are present, complex and distinct."""
    if not (values.imag > 0).all():
        return False
    apart = np.abs(values[:, None] - values) + np.diag(np.full(len(values), np.inf))
    remainder = 1 - float((parts**2).sum())
    return bool(
        remainder < REST * parts.max() ** 2 and (apart > SAME_MODULUS * np.abs(values)).all()
    )
