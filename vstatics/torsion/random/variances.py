"""Variances of the motion of a gear under a random input, as far as they exist.

For a rational spectrum the variances follow from a Lyapunov equation. For each term of a
correlation function, white noise drives a filter with two states, which drives the gear. For
spectra given by points, and with loss factors, the variances are integrals over omega, split at the
resonances.

A quantity has no variance if an undamped motion contributes to it, or if white noise moves it
directly.
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
from vstatics.torsion.random.excited import ExcitedGear, FirstOrder
from vstatics.torsion.random.spectra import Correlation, Spectrum, SpectrumPoints, White
from vstatics.torsion.system.coordinates import without_rounding
from vstatics.torsion.tolerances import ACCURACY, NEVER_DAMPED, NOTHING, ROUGH_ACCURACY, UNMOVED

MOST_PIECES = 2000
"""Largest number of intervals of an integral."""


class Signal(NamedTuple):
    """Signal: linear combination of the states and the input."""

    row: Floats
    """Coefficients of the states, shape (states,)."""
    at_once: float = 0.0
    """Coefficient of the input."""


class Driven(NamedTuple):
    """System ``x' = A x + b w`` under white noise w of spectrum 1, split by damping."""

    matrix: Floats
    """Matrix A."""
    input: Floats
    """Vector b."""
    settled: Floats
    """Stationary covariance of the damped coordinates, shape (d, d)."""
    damped: Floats
    """Basis of the damped motions, shape (states, d)."""
    undamped: Floats
    """Basis of the undamped motions, shape (states, u)."""
    moved: Floats
    """Effects of the input on undamped coordinates: in column k (from 0) after k integrations."""

    def variance(self, signal: Signal | None) -> float:
        """Return the variance of a signal, NaN if it does not exist."""
        if signal is None or signal.at_once or self.sees_undamped(signal.row):
            return math.nan
        row = signal.row @ self.damped
        return max(float(row @ self.settled @ row), 0.0)

    def sees_undamped(self, row: Floats) -> bool:
        """Return whether the input excites an undamped motion that contributes to a signal."""
        if not self.undamped.size:
            return False
        effects = np.abs((row @ self.undamped) @ self.moved)
        sizes = np.linalg.norm(row) * np.linalg.norm(self.moved, axis=0)
        return bool((effects > UNMOVED * sizes).any())

    def derivative(self, signal: Signal | None) -> Signal | None:
        """Return the time derivative of a signal, None if noise acts on the signal directly."""
        if signal is None or signal.at_once:
            return None
        rates = without_rounding(signal.row[np.newaxis], self.matrix)[0]
        return Signal(rates, float(without_rounding(signal.row, self.input)))


def driven(matrix: Floats, by_input: Floats) -> Driven:
    """Split a system under white noise into damped and undamped motions.

    Examples
    --------
    The state of ``x' = -a x + w`` has the variance ``pi/a``:

    >>> system = driven(np.array([[-2.0]]), np.array([1.0]))
    >>> round(system.variance(Signal(np.array([1.0]))), 9)
    1.570796327
    """
    size = len(matrix)
    largest = np.abs(linalg.eigvals(matrix)).max(initial=0.0)
    schur, vectors, count = linalg.schur(
        matrix, output="real", sort=lambda real, _: real < -NEVER_DAMPED * largest
    )
    damped, undamped = schur[:count, :count], schur[count:, count:]
    split = np.eye(size)
    if 0 < count < size:
        split[:count, count:] = linalg.solve_sylvester(damped, -undamped, -schur[:count, count:])
    basis = vectors @ split
    inputs = np.linalg.solve(basis, by_input)
    settled = np.zeros((count, count))
    if count:
        noise = -2 * math.pi * np.outer(inputs[:count], inputs[:count])
        settled = np.asarray(linalg.solve_continuous_lyapunov(damped, noise), np.float64)
    moves = np.abs(inputs[count:]) > UNMOVED * np.linalg.norm(by_input)
    moved = [inputs[count:] * moves]
    for _ in range(size - count - 1):
        moved.append(undamped @ moved[-1])
    columns = np.column_stack(moved)
    return Driven(matrix, by_input, settled, basis[:, :count], basis[:, count:], columns)


class FormVariances(NamedTuple):
    """Variances of linear forms of link angles, shape (forms,); NaN for undefined variances."""

    angles: Floats
    """Variances of angles. [rad^2]"""
    rates: Floats
    """Variances of first derivatives. [rad^2/s^2]"""
    accelerations: Floats
    """Variances of second derivatives. [rad^2/s^4]"""
    between: Floats | None = None
    """Integrals ``2 int omega S d omega`` of the spectra S of angles, over omega above 0. [rad^2/s]

    Only the torque of a loss factor needs them: it is in phase with the rate of twist, but
    proportional to the twist.
    """


def form_variances(gear: ExcitedGear, spectrum: Spectrum, forms: Floats) -> FormVariances:
    """Calculate the variances of linear forms of link angles, shape (forms, links)."""
    if isinstance(spectrum, SpectrumPoints):
        exists = _existing_at_points(gear, spectrum, forms)
        edges = [omega for omega, _ in spectrum.points]
        return FormVariances(*_integrated(gear, spectrum, forms, edges, exists))
    parts = [(spectrum.white, None)] if isinstance(spectrum, White) else _filters(spectrum)
    system = gear.first_order
    total = np.sum([_of_part(system, forms, size, part) for size, part in parts], axis=0)
    if gear.lossy:
        total = _integrated(gear, spectrum, forms, [0.0, math.inf], np.isfinite(total))
    return FormVariances(*total)


_Filter = tuple[Floats, Floats, Floats]
"""Matrix, input vector and output row of a filter with two states."""


def _filters(spectrum: Correlation) -> list[tuple[float, _Filter | None]]:
    """Return the white-noise spectrum, and its filter, for each term of a correlation function."""
    filters: list[tuple[float, _Filter | None]] = []
    for variance, a, b in spectrum.parts:
        omega = math.hypot(a, b)
        matrix = np.array([[0.0, omega], [-omega, -2 * a]])
        filters.append((variance * a / math.pi, (matrix, np.array([0.0, 1.0]), np.ones(2))))
    return filters


def _of_part(
    system: FirstOrder, forms: Floats, size: float, noise_filter: _Filter | None
) -> Floats:
    """Return the variances of linear forms and of their two derivatives, shape (3, forms).

    The input is white noise, filtered if there is a filter.
    """
    states = len(system.matrix)
    matrix, by_input, output = system.matrix, system.input, np.zeros(states)
    extra = 0
    if noise_filter is not None:
        extra, output = 2, np.concatenate([np.zeros(states), noise_filter[2]])
        matrix = np.zeros((states + 2, states + 2))
        matrix[:states, :states], matrix[states:, states:] = system.matrix, noise_filter[0]
        matrix[:states, states:] = np.outer(system.input, noise_filter[2])
        by_input = np.concatenate([np.zeros(states), noise_filter[1]])
    noisy = driven(matrix, by_input)

    def signal(row: Floats, at_once: float) -> Signal:
        row = np.concatenate([row, np.zeros(extra)])
        return Signal(row, at_once) if noise_filter is None else Signal(row + at_once * output)

    def variances(form: Floats) -> Iterator[float]:
        angle = signal(form @ system.angles, float(without_rounding(form, system.at_once)))
        drift = signal(form @ system.drift, float(without_rounding(form, system.drift_at_once)))
        drifts = _drifts(system, form)
        rate = noisy.derivative(angle)
        if drifts and rate is not None:
            rate = Signal(rate.row + drift.row, rate.at_once + drift.at_once)
        is_unbounded = drifts and (bool(drift.at_once) or not _is_at_rest(noisy, drift))
        yield math.nan if is_unbounded else noisy.variance(angle)
        yield noisy.variance(rate)
        yield noisy.variance(noisy.derivative(rate))

    return size * np.array([[*variances(form)] for form in forms]).reshape(-1, 3).T


def _is_at_rest(noisy: Driven, drift: Signal) -> bool:
    """Return whether the input leaves rigid motions at rest, so that the angle has a variance."""
    return not noisy.sees_undamped(drift.row) and noisy.variance(drift) == 0


def _drifts(system: FirstOrder, form: Floats) -> bool:
    """Return whether rigid motions contribute to a linear form."""
    return bool(np.abs(form @ system.drift).max(initial=0.0) > UNMOVED * np.abs(form).max())


def _existing_at_points(gear: ExcitedGear, spectrum: SpectrumPoints, forms: Floats) -> Booleans:
    """Return True for integrals that exist: no undamped resonance is in the spectrum."""
    system = gear.first_order
    noisy = driven(system.matrix, system.input)
    values = linalg.eigvals(system.matrix)
    largest = np.abs(values).max(initial=0.0)
    undamped = np.abs(values[values.real >= -NEVER_DAMPED * largest].imag)
    in_band = any(a <= omega <= b for a, b in spectrum.bands for omega in undamped.tolist())
    from_0 = any(a == 0 for a, _ in spectrum.bands)
    exists = np.ones((3, len(forms)), np.bool_)
    for number, form in enumerate(forms):
        row = form @ system.angles
        drifts = _drifts(system, form)
        for order in range(3):
            exists[order, number] = not (in_band and noisy.sees_undamped(row))
            row = row @ system.matrix + (form @ system.drift if order == 0 else 0.0)
        if drifts and from_0:
            exists[0, number] = _is_at_rest(noisy, Signal(form @ system.drift))
    return exists


def _integrated(
    gear: ExcitedGear,
    spectrum: Spectrum,
    forms: Floats,
    edges: Sequence[float],
    exists: Booleans,
) -> Floats:
    """Return ``2 int S |H|^2 d omega``, weighted for each field of `FormVariances`."""
    orders = np.array([0, 2, 4, 1])[:, None]
    exists = np.vstack([exists, exists[0] & exists[1]])

    def density(omega: float) -> Floats:
        squares = np.abs(gear.answers(forms, omega)) ** 2
        twice = 2 * float(spectrum.at(np.array(omega)))
        return np.where(exists, twice * omega**orders * squares, 0.0)

    values = linalg.eigvals(gear.first_order.matrix)
    peaks = sorted({abs(s.imag) + k * abs(s.real) for s in values for k in (-3, 0, 3)})
    total = np.where(exists, 0.0, np.nan)
    for low, high in pairwise(edges):
        cuts = [low, *(peak for peak in peaks if low < peak < high), high]
        total += sum(_integral(density, a, b) for a, b in pairwise(cuts))
    return total


def _integral(density: Callable[[float], Floats], low: float, high: float) -> Floats:
    """Integrate a vector function, each component with the same relative accuracy."""
    rough = _quadrature(density, low, high, ROUGH_ACCURACY)
    least = UNMOVED**2 * rough.max(axis=1, keepdims=True)
    sizes = np.where(rough > least, rough, np.where(least > 0, least, 1.0))
    return _quadrature(lambda omega: density(omega) / sizes, low, high, ACCURACY) * sizes


def _quadrature(
    density: Callable[[float], Floats], low: float, high: float, accuracy: float
) -> Floats:
    options: dict[str, Any] = {"epsabs": NOTHING, "norm": "max", "limit": MOST_PIECES}
    integral: Floats = quad_vec(density, low, high, epsrel=accuracy, **options)[0]
    return integral
