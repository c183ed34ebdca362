"""Solution of the equations of motion in closed form, by matrix exponentials.

In ``dx/dt = A x + B c + D dc/dt``, x is the state, and the matrix A contains all linear terms. The
torques c are given over time or nonlinear in the state; over a stretch of time they are
approximated by polynomials. Nonlinear torques and the motion depend on each other, so both are
iterated to convergence (waveform relaxation). The slopes of the torques at the start are in A, so
few iterations are needed. Works and losses are integrated by Gauss points. A stretch has equal
parts. In each part, the fastest eigenmotion that has not decayed turns through about three radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from copy import copy
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Complex, Floats, Integers, largest
from vstatics.simulation.events.exponential import Exponential
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.system.affine import Affine
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.linearised import slopes_by_rate, slopes_by_state
from vstatics.simulation.tolerances import (
    BETWEEN_EXACT,
    FITTING_TORQUE,
    LEAST_MASS,
    LEAST_VALUE,
    NOT_ZERO,
    ROUNDED_SUM,
    SAME_END,
    SAME_TIME,
    SHORTEST_PART,
)

DEGREE = 10
"""Degree of the polynomials of torques over a stretch."""
_ORDERS = DEGREE + 1
_GAUSS = 8
"""Number of Gauss points of a part of a stretch."""
_POINTS, WEIGHTS = np.polynomial.legendre.leggauss(_GAUSS)
NODES: Floats = np.append(0.5 + 0.5 * np.asarray(_POINTS, float), 1.0)
"""Gauss points and end of a part of a stretch, as fractions of the length of the part."""
_BY_ORDER = (
    np.linalg.inv(NODES[:-1, None] ** np.arange(_GAUSS)) / np.arange(1.0, _GAUSS + 1)[:, None]
)
"""Matrix from mechanical power at the Gauss points of a part to the work as a polynomial."""
_RADIANS = 3.0
"""Angle through which the fastest eigenmotion turns in a part of a stretch. [rad]"""
_MOST_HALVINGS = 256
"""Largest number of parts of a stretch, a power of 2."""
_GONE = 40.0
"""Number of time constants after which an eigenmotion has decayed."""
_FIRST_PARTS = 4
"""Initial number of parts of a stretch with nonlinear torques."""
_LEAST_PARTS = 2
"""Number of parts of full length below which parts become shorter instead of fewer.

Polynomials of a single part have few points and a lower degree.
"""
_FIRST_JOINED = 4
"""Number of parts in the first time step of a motion; later steps are longer."""
_SMOOTH = 16
"""Number of successful stretches of few parts before a longer stretch is tried."""
_LIKE = 1.5
"""Ratio of part lengths below which the last length is kept, to save a new exponential."""
_MOST_AT_START = 64.0
"""Largest error of polynomials at the start of a stretch, relative to the error limit."""
_RELAXATION_ROUNDS = 12
"""Largest number of rounds of waveform relaxation."""
_CONVERGED = 0.1
"""Largest expected error after the last round, relative to the error limit."""
_BALANCINGS = 3
"""Number of passes that balance the scales of the control values."""
_SLOPES_DIFFER = 0.05
"""Relative difference of slopes above which torques are linearised anew. [-]"""
_MOST_SLOPES, _MOST_KNOWN = 4, 32
"""Largest numbers of slopes and of exponentials that are kept for later stretches."""
_FEW = 64
"""Number of state variables above which eigenvalues are first estimated by a bound."""
_SQUARINGS = 6
"""Number of times that a matrix is squared for the bound of its eigenvalues."""


def _degree(count: int) -> int:
    return min(DEGREE, count * len(NODES) - 3)


@lru_cache(maxsize=16)
def fitting(count: int) -> tuple[Floats, Floats, Floats]:
    """Return the matrices that fit polynomials to values at the instants of `count` parts.

    Returns
    -------
    to_series : ndarray, shape (instants, DEGREE + 1)
        From values to Chebyshev coefficients.
    to_powers : ndarray, shape (DEGREE + 1, DEGREE + 1)
        From Chebyshev coefficients to derivatives at the start, with the length of a part as the
        unit of time.
    to_values : ndarray, shape (DEGREE + 1, 1 + instants)
        From Chebyshev coefficients to values, at the start and at the instants.
    """
    places = _places(count)
    degree = _degree(count)
    values = np.polynomial.chebyshev.chebvander(2 * np.append(0.0, places) - 1, degree)
    to_series = np.zeros((len(places), DEGREE + 1))
    to_series[:, : degree + 1] = np.linalg.pinv(values[1:]).T
    to_values = np.zeros((DEGREE + 1, len(values)))
    to_values[: degree + 1] = values.T
    scales = np.append(1.0, np.cumprod(count / np.arange(1, DEGREE + 1)))
    return to_series, _powers() / scales, to_values


def _places(count: int) -> Floats:
    """Return the Gauss points and ends of `count` parts, as fractions of the stretch."""
    return _steps(count)[1:] / count


@lru_cache(maxsize=16)
def _steps(count: int) -> Floats:
    """Return the start, and the Gauss points and end of each part, in lengths of a part."""
    return np.append(0.0, np.arange(count)[:, None] + NODES)


@lru_cache(maxsize=32)
def _continuing(ratio: float, count: int) -> Floats:
    """Return the matrix that extrapolates Chebyshev series into the next stretch.

    Parameters
    ----------
    ratio : float
        Length of the next stretch, relative to the length of the stretch before. [-]
    count : int
        Number of parts of the next stretch.
    """
    places = 1 + 2 * ratio * _places(count)
    values = np.asarray(np.polynomial.chebyshev.chebvander(places, DEGREE), float)
    return values.T @ fitting(count)[0]


@lru_cache(maxsize=1)
def _powers() -> Floats:
    """Return the matrix from Chebyshev coefficients on [0, 1] to coefficients of powers."""
    powers = np.zeros((DEGREE + 1, DEGREE + 1))
    for number in range(DEGREE + 1):
        series = np.polynomial.Chebyshev.basis(number, domain=[0.0, 1.0])
        powers[number, : number + 1] = series.convert(kind=np.polynomial.Polynomial).coef
    return powers


@lru_cache(maxsize=32)
def _rates(matrix: bytes, size: int) -> tuple[Floats, Floats]:
    """Return the magnitudes of eigenvalues and of their real parts [rad/s].

    Results are kept, because after most events the matrix returns to an earlier value.
    """
    square = np.frombuffer(matrix).reshape(size, size)
    rates: Complex = np.asarray(np.linalg.eigvals(square), complex)
    return np.abs(rates), np.abs(rates.real)


def _largest_rate(matrix: Floats) -> float:
    """Return an upper bound of the magnitudes of eigenvalues: ``|A^n|^(1/n)`` (Gelfand).

    Examples
    --------
    >>> round(_largest_rate(np.array([[0.0, 4.0], [-1.0, 0.0]])), 6)
    2.0
    """
    bound, power = 1.0, matrix
    for number in range(_SQUARINGS + 1):
        size = largest(np.abs(power).sum(axis=0))
        if not size:
            return 0.0
        bound *= size ** (0.5**number)
        power = power / size
        power = power @ power
    return bound


class NoFit(Exception):  # noqa: N818 - the simulation always catches it
    """Signal that polynomials do not fit the torques."""


class Parts(NamedTuple):
    """Equal parts of a stretch of time."""

    begin: float
    """Start of the first part. [s]"""
    length: float
    """Length of each part. [s]"""
    number: int

    @property
    def times(self) -> Floats:
        """Start of the first part, then Gauss points and end of each part [s]."""
        return self.begin + self.length * _steps(self.number)

    def end_near(self, end: float) -> float:
        """Return the end of the last part, or `end` itself if both differ by rounding only."""
        last = self.begin + self.length * self.number
        return end if abs(end - last) <= SAME_END * abs(end) else last


class GivenSeries(NamedTuple):
    """Chebyshev series of nonlinear torques and rates of control values over a stretch."""

    coefficients: Floats
    """Coefficients, shape (torques and rates, DEGREE + 1). [N*m]"""
    parts: Parts
    limits: Floats
    """Largest error of each series that counts as rounding, shape (torques and rates, 1)."""

    @property
    def fit_twice(self) -> bool:
        """True if polynomials of the same degree would fit a stretch of twice the length."""
        last = _degree(self.parts.number)
        highest = self.coefficients[:, last - 1 : last + 1]
        return bool((np.abs(highest) * (2.0 ** (last - 1), 2.0**last) <= self.limits).all())

    def continued(self, parts: Parts) -> Floats | None:
        """Return the coefficients over the next stretch, if at most twice as long."""
        ratio = parts.length * parts.number / (self.parts.length * self.parts.number)
        return self.coefficients @ _continuing(ratio, parts.number) if ratio <= 2 else None


class TimeStretch(NamedTuple):
    """Stretch of time with the solution in closed form."""

    parts: Parts
    exponential: Exponential
    balance: Floats
    """Factors by which the state is scaled in the exponential."""
    starts: Floats
    """Vector to which the exponential is applied, at the start of each part, shape (size, parts).

    It consists of the scaled state and, times a common factor, of time, 1, and derivatives of the
    nonlinear torques.
    """

    @property
    def last(self) -> Floats:
        """State at the end of the stretch."""
        state: Floats = self.exponential.nodes[-1] @ self.starts[:, -1]
        return state / self.balance


def joined_stretch(stretches: Sequence[TimeStretch]) -> TimeStretch:
    """Return consecutive stretches as one; all have the same exponential."""
    first, starts = stretches[0], np.hstack([stretch.starts for stretch in stretches])
    parts = first.parts._replace(number=starts.shape[1])
    return first._replace(parts=parts, starts=starts)


def _equal_parts(length: float, left: float, most: int) -> tuple[float, int]:
    """Return length and number of parts: at most `most`, which together take at most `left`."""
    if most * length < left:
        return length, most
    count = 1  # keep the number of parts a power of 2
    while count * length < left * (1 - SAME_TIME):
        count *= 2
    return left / count, count


class KnownSolutions:
    """Slopes of torques and matrix exponentials of a run, for use after later events.

    After most events, the matrix of the equations of motion returns to an earlier value.
    """

    def __init__(self) -> None:
        self._slopes: list[tuple[Floats, Floats]] = []
        self._exponentials: dict[bytes, Exponential] = {}
        self.parts: dict[int, tuple[int, float]] = {}
        """Number of parts, and factor on their length, by the number of state variables.

        A slipping device adds a variable.
        """

    def copy(self) -> KnownSolutions:
        """Return a copy to which further solutions add nothing; exponentials depend on no run."""
        copied = copy(self)
        copied.parts = {**self.parts}
        return copied

    def slopes_near(
        self, slopes: tuple[Floats, Floats], bending: Integers, torques: int
    ) -> tuple[Floats, Floats]:
        """Replace slopes of nonlinear torques by similar earlier slopes, if any, and return all.

        The matrix of the equations can then equal an earlier matrix.

        Parameters
        ----------
        slopes : ndarray, shape (ports,), and ndarray, shape (ports + values, size)
            Derivatives with respect to the rates of ports, and to the state.
        bending : ndarray of int
            Ports with nonlinear torques, and rates of values.
        torques : int
            Number of ports in `bending`.
        """
        for known in self._slopes:
            if not _differ(slopes, known):
                slopes[0][bending[:torques]] = known[0][bending[:torques]]
                slopes[1][bending] = known[1][bending]
                return slopes
        self._slopes = [slopes, *self._slopes[: _MOST_SLOPES - 1]]
        return slopes

    def exponential(self, matrix: Floats, size: int) -> Exponential:
        """Return the exponential of a matrix at `NODES`; `size` rows are calculated."""
        key = matrix.tobytes()
        known = self._exponentials.pop(key, None) or Exponential(matrix, NODES, size)
        self._exponentials[key] = known
        if len(self._exponentials) > _MOST_KNOWN:
            longest_unused = next(iter(self._exponentials))
            del self._exponentials[longest_unused]
        return known


def _differ(now: tuple[Floats, Floats], before: tuple[Floats, Floats]) -> bool:
    """Return whether slopes of torques differ so much that a new matrix is better."""
    return any(
        new.shape != old.shape
        or (np.abs(new - old) > _SLOPES_DIFFER * np.maximum(np.abs(new), np.abs(old))).any()
        for new, old in zip(now, before, strict=True)
    )


class Closed:
    """Closed-form solution of a set of equations of motion.

    Parameters
    ----------
    equations : Equations
    state : ndarray
        State at the start.
    large : float
        Torque that counts as large, the scale of rounding errors. [N*m]
    known : KnownSolutions
    """

    def __init__(
        self,
        equations: Equations,
        state: Floats,
        large: float,
        known: KnownSolutions,
    ) -> None:
        self.equations, self.large, self.solutions = equations, large, known
        ports = equations.ports
        timed = {port for port, _, _ in ports.timed}
        rates = range(equations.layout.ports, equations.layout.ports + len(equations.layout.values))
        self.bending = np.array([*sorted(timed.union(ports.bending)), *rates], dtype=int)
        """Ports with nonlinear torques, followed by the rates of control values."""
        self.torques = len(self.bending) - len(rates)
        """Number of torques in `bending`; the other entries are rates of control values."""
        self.is_given = ports.is_affine and not rates
        self.size = equations.works.start
        most, shorter = known.parts.get(self.size, (_FIRST_PARTS, 1.0))
        self.most = _MOST_HALVINGS if self.is_given else min(most, _FIRST_PARTS)
        """Largest number of parts of the next stretch."""
        self.shorter = 1.0 if self.is_given else shorter
        """Factor on the length of the parts."""
        looks = {*rates, *equations.coupled}
        orders = np.array([2 if port in looks else _ORDERS for port in self.bending], dtype=int)
        self.is_used: Booleans = np.arange(_ORDERS) < orders[:, None]
        """Flags of the used orders of each polynomial; 0 and 1 for laws linear in their inputs."""
        self.latest: Floats = np.zeros(len(self.bending))
        """Nonlinear torques and rates at the end of the last stretch."""
        self.series: GivenSeries | None = None
        """Polynomials of the nonlinear torques and rates over the last stretch, if they fit."""
        self._straighten(equations.time, state)

    def _straighten(self, time: float, state: Floats) -> None:
        """Linearise the torques about a state, and calculate the matrix A."""
        equations = self.equations
        slopes = self._slopes(time, state)
        by_rate, by_state = self.known = self.solutions.slopes_near(
            slopes, self.bending, self.torques
        )
        self.slopes: Floats = by_rate[self.bending[: self.torques]]
        self.by_state = by_state[self.bending]
        self.sees_state = bool(self.by_state.any())
        of_torques = np.abs(self.by_state[: self.torques])
        self.noise = ROUNDED_SUM * largest(of_torques @ np.abs(state[: self.size]))
        """Rounding error of the torques that depend on the state. [N*m]"""
        try:
            self.affine = Affine(equations, by_rate, by_state)
        except np.linalg.LinAlgError:
            # The speed of a link without inertia depends on the speed of another such link.
            raise NoFit from None
        self.latest, self.series = np.zeros(len(self.bending)), None
        matrix = self.affine.change.by_state
        self.balance = self._balanced()
        self._balance_values(matrix)
        self.matrix = self.balance[:, None] * matrix / self.balance
        self.rates: tuple[Floats, Floats] | None = None
        """Magnitudes of eigenvalues and of their real parts, None until calculated. [rad/s]"""
        self.exponentials: dict[float, tuple[Exponential, float]] = {}

    def _slopes(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        by_rate = slopes_by_rate(self.equations, time, state)
        return by_rate, slopes_by_state(self.equations, time, state)

    def _balanced(self) -> Floats:
        """Return factors that convert speeds and twists to square roots of energies."""
        equations = self.equations
        factors = np.ones(self.size)
        stiffness = equations.ports.stiffness
        factors[equations.twists] = np.sqrt(np.where(stiffness > 0, stiffness, 1.0))
        free = equations.structure.free
        mass = ((free.T @ equations.system.mass) * free.T).sum(axis=1)
        factors[: equations.motions] = np.sqrt(np.maximum(mass, LEAST_MASS))
        drivers = len(equations.structure.drivers)
        # If a driver (contact that sticks at a given speed) moves only links without inertia, its
        # mass is 0 and gives no factor.
        if drivers:
            driven = slice(equations.motions - drivers, equations.motions)
            factors[driven] = max(1.0, largest(factors[: equations.angles.start]))
        return factors

    def _balance_values(self, matrix: Floats) -> None:
        """Scale control values so that rows and columns of the matrix are balanced (Osborne)."""
        for _ in range(_BALANCINGS):
            for index in range(*self.equations.values.indices(self.size)):
                balanced = np.abs(self.balance[:, None] * matrix / self.balance)
                given, taken = balanced[:, index].sum(), balanced[index].sum()
                balanced[index] = balanced[:, index] = 0.0
                others = largest(balanced)
                if others:
                    self.balance[index] *= np.sqrt((given + others) / (taken + others))

    def steps(self, state: Floats, end: float) -> Iterator[TimeStep]:
        """Yield time steps up to a time.

        Consecutive stretches are joined into one step, because a search for events takes nearly
        the same time in a long step as in a short one.

        Raises
        ------
        NoFit
        """
        joined: list[TimeStretch] = []
        for stretch in self._stretches(state, end):
            if joined and (stretch is None or stretch.exponential is not joined[0].exponential):
                step = self._step(joined_stretch(joined), state, end)
                yield step
                state, joined = step.last, []
            if stretch is not None:
                joined.append(stretch)

    def _stretches(self, state: Floats, end: float) -> Iterator[TimeStretch | None]:
        """Yield stretches up to a time, and None wherever a time step ends."""
        time = begin = straightened = self.equations.time
        smooth = 0
        joined, most_joined, last_length = 0, _FIRST_JOINED, 0.0
        while time < end:
            length, count = self._parts(time - begin, end - time)
            if last_length < length < _LIKE * last_length:  # a new exponential would take longer
                length, count = _equal_parts(last_length, end - time, self.most)
            if self.shorter < SHORTEST_PART or time + length * count == time:
                yield None
                raise NoFit
            if joined >= most_joined or length != last_length:
                yield None
                joined, most_joined = 0, min(max(most_joined, 2 * joined), _MOST_HALVINGS)
            last_length, parts = length, Parts(time, length, count)
            stretch = self._calculated(parts, state)
            if stretch is not None:
                yield stretch
                time, state = parts.end_near(end), stretch.last
                joined += count
                smooth += 1
                if (self.series and self.series.fit_twice) or (
                    count <= _LEAST_PARTS and smooth % _SMOOTH == 0
                ):
                    self.most = min(
                        self.most if self.shorter < 1 else 2 * self.most, _MOST_HALVINGS
                    )
                    self.shorter = min(1.0, 2 * self.shorter)
                self.solutions.parts[self.size] = self.most, self.shorter
            elif time > straightened and _differ(self._slopes(time, state), self.known):
                self._straighten(time, state)
                straightened = time  # only once at a time, as slopes near 0 are rounded differently
            else:
                smooth = 0
                least = _LEAST_PARTS if self.shorter == 1 else 1
                self.shorter = self.shorter if count > least else self.shorter / 2
                self.most = max(least, count // 2)
        yield None

    def _parts(self, gone: float, left: float) -> tuple[float, int]:
        fastest = self._fastest(gone)
        length = self.shorter * (_RADIANS / fastest if fastest > 0 else left)
        if self.equations.ports.timed:
            length = min(length, self.equations.longest)
        return _equal_parts(length, left, self.most)

    def _fastest(self, gone: float) -> float:
        """Return the speed of the fastest eigenmotion that has not decayed after a time [rad/s]."""
        if self.rates is None:
            if self.size > _FEW and not gone:  # eigenvalues would take too long
                return _largest_rate(self.matrix)
            matrix = self.affine.change.by_state
            self.rates = _rates(matrix.tobytes(), len(matrix))
        speeds, decays = self.rates
        return float(speeds[decays * gone < _GONE].max(initial=0.0))

    def _exponential(self, length: float) -> tuple[Exponential, float]:
        """Return the exponential over a part, and the factor of the inputs in its vector.

        The vector consists of the scaled state and of the inputs: time, 1, and derivatives of the
        nonlinear torques.
        """
        known = self.exponentials.get(length)
        if known is not None:
            return known
        size, change, ports = self.size, self.affine.change, self.equations.ports
        matrix = np.zeros((size + 2 + int(self.is_used.sum()),) * 2)
        factors = self.balance * length
        matrix[:size, :size] = self.matrix * length
        count = len(ports.c0)
        by_torques, by_slopes = change.by_given[:, :count], change.by_slope[:, :count]
        constant = by_torques @ ports.c0 + by_slopes @ ports.c1
        matrix[:size, size] = factors * (by_torques @ ports.c1)
        matrix[:size, size + 1] = factors * constant
        matrix[size, size + 1] = length
        first = size + 2
        for port, orders in zip(self.bending, self.is_used.sum(axis=1).tolist(), strict=True):
            matrix[:size, first] = factors * change.by_given[:, port]
            matrix[:size, first + 1] = self.balance * change.by_slope[:, port]
            rows = np.arange(first, first + orders - 1)
            matrix[rows, rows + 1] = 1.0
            first += orders
        # The factor keeps the effect of inputs as small as the effect of the state.
        unit = max(largest(np.abs(matrix[:size, size:]).sum(axis=0)), NOT_ZERO)
        matrix[:size, size:] /= unit
        exponential = self.solutions.exponential(matrix, size), unit
        self.exponentials[length] = exponential
        return exponential

    def _calculated(self, parts: Parts, state: Floats) -> TimeStretch | None:
        """Return a stretch that begins with a state, or None if polynomials do not fit."""
        given, self.series = self._expected(parts), None
        times = self.equations.ports.inside(parts.times)
        to_series, to_powers, to_values = fitting(parts.number)
        before: Floats | None = given @ to_values
        change = 0.0
        at = np.empty((self.size, len(times)))
        at[:, 0] = state[: self.size]
        for _ in range(_RELAXATION_ROUNDS):
            if self.is_given:  # torques are nonlinear in the time alone
                now = before = self.affine.given_at(times)[0][self.bending]
            else:
                at[:, 1:] = self._states(self._followed(parts, state, given, to_powers))
                now = self._bent(times, at, given, to_values)
            if not math.isfinite(largest(now)):
                return None
            given = now[:, 1:] @ to_series
            limits = self._limits(now, at, parts)
            if not self.is_used.all() and self._uses_more(given, limits):
                before, change = None, 0.0
            if before is not None:
                last_change, change = change, largest((now - before) / limits)
                if change <= 1 or change * change <= _CONVERGED * last_change:
                    errors = np.abs(given @ to_values - now) / limits
                    if not largest(errors[:, 1:]) <= 4:  # NaN fails, too
                        return None
                    if not largest(errors[:, 0]) <= _MOST_AT_START:
                        return None
                    self.latest = now[:, -1]
                    self.series = GivenSeries(given, parts, limits)
                    return self._followed(parts, state, given, to_powers)
            before = now
        return None

    def _limits(self, now: Floats, states: Floats, parts: Parts) -> Floats:
        """Return the largest allowed errors of nonlinear torques, and of rates in their own units.

        Rates in Pa/s are so large that their errors would be large torques.
        """
        sizes, torques = np.abs(now).max(axis=1), self.torques
        sizes[:torques] = max(self.large, largest(sizes[:torques]), self.noise / FITTING_TORQUE)
        if len(sizes) > torques:
            reached = np.abs(states).max(axis=1)
            by_values = reached[self.equations.values] / (parts.length * parts.number)
            by_state = np.abs(self.by_state[torques:]) @ reached
            sizes[torques:] = np.max([sizes[torques:], by_values, by_state], axis=0)
        limits: Floats = FITTING_TORQUE * np.maximum(sizes, LEAST_VALUE)[:, None]
        return limits

    def _uses_more(self, given: Floats, limits: Floats) -> bool:
        """Clear unused orders of polynomials; return whether a torque now needs all orders."""
        bends = (np.abs(given) * ~self.is_used > limits).any(axis=1)
        if bends.any():
            self.is_used[bends] = True
            self.exponentials.clear()
        given[~self.is_used] = 0.0
        return bool(bends.any())

    def _expected(self, parts: Parts) -> Floats:
        """Return a first guess of the polynomials of nonlinear torques over a stretch."""
        continued = self.series.continued(parts) if self.series else None
        if continued is not None:
            return continued
        constant = np.zeros((len(self.bending), _ORDERS))
        constant[:, 0] = self.latest
        return constant

    def _followed(
        self, parts: Parts, state: Floats, given: Floats, to_powers: Floats
    ) -> TimeStretch:
        exponential, unit = self._exponential(parts.length)
        known, powers = (unit * parts.begin, unit), unit * (given @ to_powers)[self.is_used]
        first = np.concatenate([self.balance * state[: self.size], known, powers])
        starts = exponential.repeated(first, parts.number)
        return TimeStretch(parts, exponential, self.balance, starts)

    def _states(self, stretch: TimeStretch) -> Floats:
        inner = stretch.exponential.at_nodes(stretch.starts)
        return inner / stretch.balance[:, None]

    def _bent(self, times: Floats, states: Floats, given: Floats, to_values: Floats) -> Floats:
        """Return the nonlinear torques and rates, minus the linear terms that are in the matrix."""
        equations, affine = self.equations, self.affine
        rates = affine.rates.by_state @ states
        if equations.light:  # the speeds of links without inertia follow from torques
            all_given, slopes = affine.given_at(times)
            all_given[self.bending] = given @ to_values
            rates += affine.rates.by_given @ all_given + affine.rates.by_slope @ slopes
        ports = self.bending[: self.torques]
        torques = equations.torques_at(times, states, rates)
        nonlinear: Floats = torques[ports] - self.slopes[:, None] * rates[ports]
        if len(self.bending) > self.torques:
            nonlinear = np.vstack(
                [nonlinear, equations.value_rates_at(times, states, rates, torques)]
            )
        if self.sees_state:
            nonlinear -= self.by_state @ states
        return nonlinear

    def _step(self, stretch: TimeStretch, state: Floats, end: float) -> TimeStep:
        parts = stretch.parts
        times: Floats = parts.times[1:].reshape(parts.number, -1)
        times[-1, -1] = parts.end_near(end)
        states = np.zeros((self.equations.size, parts.number, len(NODES)))
        states[: self.size] = self._states(stretch).reshape(self.size, *times.shape)
        powers = self._account(states, times, state, parts.length)
        flat = states.reshape(self.equations.size, -1)
        befores = np.column_stack([state, states[:, :-1, -1]])
        between = partial(self._among, stretch, befores, powers)
        exact = partial(self._inside, stretch, befores)
        last, at_end = float(times[-1, -1]), flat[:, -1].copy()
        times = times.reshape(-1)
        return TimeStep(
            *(parts.begin, last, state, at_end, between, exact, times, flat, NODES, BETWEEN_EXACT)
        )

    def _among(
        self, stretch: TimeStretch, befores: Floats, powers: Floats, times: Floats
    ) -> Floats:
        parts, first = stretch.parts, self.equations.works.start
        passed = (times - parts.begin) / parts.length
        at = np.minimum(np.maximum(passed.astype(int), 0), parts.number - 1)
        within = np.minimum(np.maximum(passed - at, 0.0), 1.0)
        moved = stretch.exponential.moved(within, stretch.starts[:, at])
        result = befores[:, at].copy()
        result[: self.size] = moved[: self.size] / stretch.balance[:, None]
        worked = parts.length * within[:, None] ** np.arange(1, _GAUSS + 1) @ _BY_ORDER
        result[first:] += np.einsum("wnj,nj->wn", powers[:, at], worked)
        return result

    def _inside(self, stretch: TimeStretch, befores: Floats, time: float) -> Floats:
        """Return the state at a time within a stretch, with works integrated by Gauss points."""
        parts = stretch.parts
        passed = (time - parts.begin) / parts.length
        part = min(parts.number - 1, max(0, int(passed)))
        within = min(1.0, max(0.0, passed - part))
        starts = np.repeat(stretch.starts[:, part, None], len(NODES), axis=1)
        moved = stretch.exponential.moved(within * NODES, starts)
        result = np.zeros((self.equations.size, 1, len(NODES)))
        result[: self.size, 0] = moved[: self.size] / stretch.balance[:, None]
        begin = parts.begin + part * parts.length
        times = begin + parts.length * within * NODES[None, :]
        self._account(result, times, befores[:, part], parts.length * within)
        return np.asarray(result[:, 0, -1])

    def _account(self, states: Floats, times: Floats, before: Floats, length: float) -> Floats:
        """Write works and losses into the states; return the powers at the Gauss points."""
        equations = self.equations
        first = equations.works.start
        count, nodes = times.shape
        flat = np.repeat(before[:, None], count * nodes, axis=1)
        flat[:first] = states[:first].reshape(first, count * nodes)
        powers = equations.powers_at(times.reshape(-1), flat)
        at_points: Floats = powers.reshape(-1, count, nodes)[:, :, : len(WEIGHTS)]
        ends = before[first:, None] + np.cumsum(at_points @ WEIGHTS * (0.5 * length), axis=1)
        begins = np.hstack([before[first:, None], ends[:, :-1]])
        within = length * (NODES[:-1, None] ** np.arange(1, _GAUSS + 1)) @ _BY_ORDER
        states[first:, :, :-1] = begins[:, :, None] + at_points @ within.T
        states[first:, :, -1] = ends
        return at_points
