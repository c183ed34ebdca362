"""Variances of a gear under a random input, and whether there are any.

Of a spectrum that is rational they follow from a Lyapunov equation: white noise drives a filter of
two states for each part of a correlation, the filter drives the gear. Of points, and where there
are loss factors, they are integrals over omega, by parts between the resonances.

What has a part that nothing damps, or that white noise moves at once, has no variance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy import linalg
from scipy.integrate import quad_vec

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.torsion.random.excited import ExcitedGear, FirstOrder, without_rounding
from vstatics.torsion.random.spectra import Correlation, Spectrum, SpectrumPoints, White
from vstatics.torsion.tolerances import ACCURACY, NEVER_DAMPED, NOTHING, ROUGH_ACCURACY, UNMOVED

MOST_PIECES = 2000
"""Of an integral."""


class Signal(NamedTuple):
    """A number that follows a motion: a row over states, and over the input itself."""

    row: Floats
    at_once: float = 0.0

    def plus(self, other: Signal) -> Signal:
        """The sum of two."""
        return Signal(self.row + other.row, self.at_once + other.at_once)


class Driven(NamedTuple):
    """``x' = A x + b w`` under white noise w of the spectrum 1, parts that nothing damps apart."""

    matrix: Floats
    input: Floats
    settled: Floats
    """Covariance of the damped part, of rows by `damped`."""
    damped: Floats
    """Shape (states, damped)."""
    undamped: Floats
    """Shape (states, others)."""
    moved: Floats
    """Of the others, after 0, 1, ... integrations, shape (others, others): what the input moves."""

    def variance(self, signal: Signal | None) -> float:
        """NaN where there is none."""
        if signal is None or signal.at_once or self.sees_undamped(signal.row):
            return math.nan
        row = signal.row @ self.damped
        return max(float(row @ self.settled @ row), 0.0)

    def sees_undamped(self, row: Floats) -> bool:
        """Whether a row has a part in it of what is moved and not damped."""
        if not self.undamped.size:
            return False
        seen = np.abs((row @ self.undamped) @ self.moved)
        sizes = np.linalg.norm(row) * np.linalg.norm(self.moved, axis=0)
        return bool((seen > UNMOVED * sizes).any())

    def derivative(self, signal: Signal | None) -> Signal | None:
        """The rate of a signal; none of what the noise moves at once."""
        if signal is None or signal.at_once:
            return None
        parts = signal.row * self.input
        at_once = float(parts.sum())
        moved = abs(at_once) > UNMOVED * float(np.abs(parts).sum())
        rates = without_rounding(signal.row[np.newaxis], self.matrix)[0]
        return Signal(rates, at_once * moved)


def driven(matrix: Floats, by_input: Floats) -> Driven:
    """A system under white noise; its damped part settles.

    Examples
    --------
    ``x' = -a x + w``: the variance is ``pi/a``.

    >>> one = driven(np.array([[-2.0]]), np.array([1.0]))
    >>> round(one.variance(Signal(np.array([1.0]))), 9)
    1.570796327
    """
    size = len(matrix)
    largest = np.abs(linalg.eigvals(matrix)).max(initial=0.0)
    schur, vectors, count = linalg.schur(
        matrix, output="real", sort=lambda real, _: real < -NEVER_DAMPED * largest
    )
    left, right = schur[:count, :count], schur[count:, count:]
    apart = np.eye(size)
    if 0 < count < size:
        apart[:count, count:] = linalg.solve_sylvester(left, -right, -schur[:count, count:])
    basis = vectors @ apart
    inputs = np.linalg.solve(basis, by_input)
    settled: Floats = np.zeros((count, count))
    if count:
        noise = -2 * math.pi * np.outer(inputs[:count], inputs[:count])
        settled = np.asarray(linalg.solve_continuous_lyapunov(left, noise), np.float64)
    other = inputs[count:] * (np.abs(inputs[count:]) > UNMOVED * np.linalg.norm(by_input))
    moved: list[Floats] = [other]
    for _ in range(size - count - 1):
        moved.append(right @ moved[-1])
    columns: Floats = np.column_stack(moved)
    return Driven(matrix, by_input, settled, basis[:, :count], basis[:, count:], columns)


class FormVariances(NamedTuple):
    """Variances of forms of angles, of their rates and of the rates of these; NaN of none."""

    angles: Floats
    rates: Floats
    accelerations: Floats
    between: Floats | None = None
    """``2 int |omega| S`` of the angles, where there are loss factors: what a material loses goes
    with the rate, but has the size of the angle."""


def form_variances(gear: ExcitedGear, spectrum: Spectrum, forms: Floats) -> FormVariances:
    """The variances of forms of the angles of links, shape (forms, links)."""
    if isinstance(spectrum, SpectrumPoints):
        exists = _existing_at_points(gear, spectrum, forms)
        edges = [omega for omega, _ in spectrum.points]
        return FormVariances(*_integrated(gear, spectrum, forms, edges, exists))
    parts = [(spectrum.white, None)] if isinstance(spectrum, White) else _filters(spectrum)
    system = gear.first_order
    total = np.sum([_of_part(system, forms, size, one) for size, one in parts], axis=0)
    if gear.lossy:
        total = _integrated(gear, spectrum, forms, [0.0, math.inf], np.isfinite(total))
    return FormVariances(*total)


_Filter = tuple[Floats, Floats, Floats]
"""Matrix, input and output of two states."""


def _filters(spectrum: Correlation) -> list[tuple[float, _Filter | None]]:
    """Filters that make of white noise of the spectrum 1 each part of a correlation."""
    found: list[tuple[float, _Filter | None]] = []
    for variance, a, b in spectrum.parts:
        whole = math.hypot(a, b)
        matrix = np.array([[0.0, whole], [-whole, -2 * a]])
        found.append((variance * a / math.pi, (matrix, np.array([0.0, 1.0]), np.ones(2))))
    return found


def _of_part(system: FirstOrder, forms: Floats, size: float, one: _Filter | None) -> Floats:
    """Variances of forms by white noise, or by what a filter makes of it; shape (3, forms)."""
    states = len(system.matrix)
    matrix, by_input, seen = system.matrix, system.input, np.zeros(states)
    extra = 0
    if one is not None:
        extra, seen = 2, np.concatenate([np.zeros(states), one[2]])
        matrix = np.zeros((states + 2, states + 2))
        matrix[:states, :states], matrix[states:, states:] = system.matrix, one[0]
        matrix[:states, states:] = np.outer(system.input, one[2])
        by_input = np.concatenate([np.zeros(states), one[1]])
    whole = driven(matrix, by_input)

    def signal(row: Floats, at_once: float) -> Signal:
        row = np.concatenate([row, np.zeros(extra)])
        return Signal(row, at_once) if one is None else Signal(row + at_once * seen)

    def of(form: Floats) -> Iterator[float]:
        turning = signal(form @ system.angles, _tidy(form, system.at_once))
        drifting = signal(form @ system.drift, _tidy(form, system.drift_at_once))
        drifts = _drifts(system, form)
        rate = whole.derivative(turning)
        if drifts and rate is not None:
            rate = rate.plus(drifting)
        still = drifts and (bool(drifting.at_once) or not _stands(whole, drifting))
        yield math.nan if still else whole.variance(turning)
        yield whole.variance(rate)
        yield whole.variance(whole.derivative(rate))

    return size * np.array([[*of(form)] for form in forms]).reshape(-1, 3).T


def _stands(whole: Driven, drifting: Signal) -> bool:
    """Whether a rigid speed is not moved at all, so that its angle exists."""
    return not whole.sees_undamped(drifting.row) and whole.variance(drifting) == 0


def _tidy(form: Floats, parts: Floats) -> float:
    """A sum, 0 where it is rounding."""
    total = float(form @ parts)
    return total if abs(total) > UNMOVED * float(np.abs(form) @ np.abs(parts)) else 0.0


def _drifts(system: FirstOrder, form: Floats) -> bool:
    """Whether a form has a part of rigid motions."""
    return bool(np.abs(form @ system.drift).max(initial=0.0) > UNMOVED * np.abs(form).max())


def _existing_at_points(gear: ExcitedGear, spectrum: SpectrumPoints, forms: Floats) -> Booleans:
    """Whether integrals exist: no resonance that nothing damps lies where the spectrum is."""
    system = gear.first_order
    whole = driven(system.matrix, system.input)
    values = linalg.eigvals(system.matrix)
    largest = np.abs(values).max(initial=0.0)
    undamped = np.abs(values[values.real >= -NEVER_DAMPED * largest].imag)
    met = any(a <= one <= b for a, b in spectrum.bands for one in undamped.tolist())
    from_0 = any(a == 0 for a, _ in spectrum.bands)
    found = np.ones((3, len(forms)), np.bool_)
    for number, form in enumerate(forms):
        row = form @ system.angles
        drifts = _drifts(system, form)
        for order in range(3):
            found[order, number] = not (met and whole.sees_undamped(row))
            row = row @ system.matrix + (form @ system.drift if order == 0 else 0.0)
        if drifts and from_0:
            found[0, number] = _stands(whole, Signal(form @ system.drift))
    return found


def _integrated(
    gear: ExcitedGear,
    spectrum: Spectrum,
    forms: Floats,
    edges: Sequence[float],
    exists: Booleans,
) -> Floats:
    """``2 int S |H|^2`` of angles, rates, accelerations and between, shape (4, forms)."""
    orders = np.array([0, 2, 4, 1])[:, None]
    exists = np.vstack([exists, exists[0] & exists[1]])

    def density(omega: float) -> Floats:
        answer = np.abs(gear.answers(forms, omega)) ** 2
        twice = 2 * float(spectrum.at(np.array(omega)))
        made: Floats = np.where(exists, twice * omega**orders * answer, 0.0)
        return made

    values = linalg.eigvals(gear.first_order.matrix)
    peaks = sorted({abs(one.imag) + k * abs(one.real) for one in values for k in (-3, 0, 3)})
    total = np.where(exists, 0.0, np.nan)
    for low, high in pairwise(edges):
        cuts = [low, *(one for one in peaks if low < one < high), high]
        total += sum(_integral(density, a, b) for a, b in pairwise(cuts))
    return total


def _integral(density: Callable[[float], Floats], low: float, high: float) -> Floats:
    """Of all parts to the same relative accuracy."""
    rough = _quadrature(density, low, high, ROUGH_ACCURACY)
    least = UNMOVED**2 * rough.max(axis=1, keepdims=True)
    sizes: Floats = np.where(rough > least, rough, np.where(least > 0, least, 1.0))
    return _quadrature(lambda omega: density(omega) / sizes, low, high, ACCURACY) * sizes


def _quadrature(
    density: Callable[[float], Floats], low: float, high: float, accuracy: float
) -> Floats:
    options: dict[str, Any] = {"epsabs": NOTHING, "norm": "max", "limit": MOST_PIECES}
    found: Floats = quad_vec(density, low, high, epsrel=accuracy, **options)[0]
    return found
