"""Straight equations in closed form: by the exponential of their matrix.

``x(t + h) = exp(A h) x(t)`` where x has, beside twists and speeds, the powers of time of which the
given torques are made. Works and losses are products of what is known at every instant, so they are
sums over Gauss points. A stretch is cut into equal parts, of which the fastest motion that has not
yet died away turns through about two radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.simulation.affine import Affine
from vstatics.simulation.equations import Equations
from vstatics.simulation.pieces import TimeStep

_RADIANS = 2.0
"""Of the fastest motion, in a part of a stretch."""
_GAUSS = 8
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(_GAUSS)
_NODES = np.append(0.5 + 0.5 * _POINTS, 1.0)
"""Gauss points of a part and its end, by its length."""
_TERMS = 22
"""Of the series of the exponential."""
_PARTS = 128
"""Most parts of a stretch."""
_DEGREE = 12
"""Of the polynomials in time by which torques by a formula are replaced in a stretch."""
_FIT = 1e-13
"""How near these come, by the largest."""
_GONE = 40.0
"""A motion has died away after so many of its time constants."""
_MOST_PARTS = 200_000


def is_closed(equations: Equations) -> bool:
    """Whether equations are straight, so that there is a closed form."""
    return equations.ports.is_affine


def _fitting() -> tuple[Floats, Floats, Floats]:
    """Where torques are asked for, from 0 to 1; from there to a series; from that to powers."""
    count = _DEGREE + 3
    places = np.cos(np.pi * (np.arange(count) + 0.5) / count)
    values = np.asarray(np.polynomial.chebyshev.chebvander(places, count - 1), float)
    to_series: Floats = np.linalg.inv(values).T
    powers = np.zeros((count, _DEGREE + 1))
    for number in range(_DEGREE + 1):
        series = np.polynomial.Chebyshev.basis(number, domain=[0.0, 1.0])
        powers[number, : number + 1] = series.convert(kind=np.polynomial.Polynomial).coef
    return 0.5 + 0.5 * places, to_series, powers


_FIT_NODES, _TO_SERIES, _TO_POWERS = _fitting()


class Parts(NamedTuple):
    """The parts of a stretch."""

    begin: float
    """[s]"""
    length: float
    """Of each. [s]"""
    number: int


class NoFit(Exception):  # noqa: N818 - it never leaves the room
    """Torques that no polynomial comes near, or more parts than are worth while."""


class Closed:
    """The closed form of straight equations."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        self.affine: Affine = equations.affine
        self.size = equations.works.start
        self.matrix = self.affine.change.by_state
        self.rates = np.linalg.eigvals(self.matrix) if self.size else np.zeros(0)
        self.balance = self._balanced()

    def _balanced(self) -> Floats:
        """Factors by which speeds and twists count alike: square roots of their energies."""
        equations = self.equations
        factors = np.ones(self.size)
        stiffness = equations.ports.stiffness
        factors[equations.twists] = np.sqrt(stiffness)
        free = equations.structure.free
        mass = ((free.T @ equations.system.mass) * free.T).sum(axis=1)
        factors[: equations.motions] = np.sqrt(np.maximum(mass, 1e-30))
        return factors

    def stretches(self, state: Floats, end: float) -> Iterator[TimeStep]:
        """Stretches up to a time.

        Raises
        ------
        NoFit
        """
        time = begin = self.equations.time
        parts_left = _MOST_PARTS
        while time < end:
            length, count = self._parts(time - begin, end - time)
            powers, count = self._powers(time, length, count)
            parts_left -= count
            if parts_left < 0:
                raise NoFit
            step = self._stretch(Parts(time, length, count), state, powers, end)
            yield step
            time, state = step.end, step.last

    def _parts(self, gone: float, left: float) -> tuple[float, int]:
        """Length and number of the parts of the next stretch."""
        alive = np.abs(self.rates)[np.abs(self.rates.real) * gone < _GONE]
        fastest = float(alive.max(initial=0.0))
        if fastest * left <= _RADIANS:
            return left, 1
        length = _RADIANS / fastest
        count = min(_PARTS, int(np.ceil(left / length)))
        if count * length >= left:
            length = left / count
        return length, count

    def _powers(self, time: float, length: float, count: int) -> tuple[Floats, int]:
        """What is given as a polynomial in time by the length of a part, for so many parts.

        Shape (size of x, powers); fewer parts where no polynomial comes near.
        """
        affine, ports = self.affine, self.equations.ports
        if not ports.timed:
            start = ports.c0 + ports.c1 * time
            change = affine.change
            constant = change.by_given @ start + change.by_slope @ ports.c1
            return np.column_stack([constant, change.by_given @ ports.c1 * length]), count
        while True:
            given, slopes = affine.given_at(time + count * length * _FIT_NODES)
            pushed = affine.change.by_given @ given + affine.change.by_slope @ slopes
            fitted = pushed @ _TO_SERIES
            largest = np.abs(fitted).max(axis=1)
            if (np.abs(fitted[:, -2:]).max(axis=1) <= _FIT * largest).all():
                return fitted @ _TO_POWERS / float(count) ** np.arange(_DEGREE + 1), count
            if count == 1:
                raise NoFit
            count = max(1, count // 2)

    def _exponent(self, length: float, powers: Floats) -> Floats:
        """The matrix of x and of the powers of time, by a part; in balanced units."""
        size, terms = self.size, powers.shape[1]
        made = np.zeros((size + terms, size + terms))
        factors = self.balance
        made[:size, :size] = (factors[:, None] * self.matrix / factors) * length
        made[:size, size:] = factors[:, None] * powers * length
        for power in range(1, terms):  # of s^k/k!
            made[size + power, size + power - 1] = 1.0
            made[:size, size + power] *= math.factorial(power)
        return made

    def _stretch(self, parts: Parts, state: Floats, powers: Floats, end: float) -> TimeStep:
        """A stretch of equal parts from a state on; the last of all ends at a time."""
        size = self.size
        matrix = self._exponent(parts.length, powers)
        large = float(np.abs(matrix[:size, size:]).max(initial=0.0)) or 1.0
        matrix[:size, size:] /= large
        exponential = _Exponential(matrix)
        nodes = exponential.at(_NODES)
        first = np.zeros(len(matrix))
        first[:size] = self.balance * state[:size]
        first[size] = large
        starts = _repeated(nodes[-1], first, parts.number)
        inner = (nodes.transpose(1, 0, 2) @ starts).transpose(0, 2, 1)
        times = parts.begin + parts.length * (np.arange(parts.number)[:, None] + _NODES)
        if abs(end - times[-1, -1]) <= 1e-13 * abs(end):
            times[-1, -1] = end
        states = np.zeros((self.equations.size, parts.number, len(_NODES)))
        states[:size] = inner[:size] / self.balance[:, None, None]
        self._account(states, times, state, parts.length)
        flat = states.reshape(self.equations.size, -1)
        befores = np.column_stack([state, states[:, :-1, -1]])

        def exact(time: float) -> Floats:
            return self._inside(parts, time, exponential, starts, befores)

        def between(asked: Floats) -> Floats:
            return np.array([exact(time) for time in asked.tolist()]).T

        marks: Booleans = np.tile(np.arange(len(_NODES)) == _GAUSS, parts.number)
        last = float(times[-1, -1]), flat[:, -1].copy()
        return TimeStep(
            parts.begin, last[0], state, last[1], between, exact, times.reshape(-1), flat, marks
        )

    def _inside(
        self,
        parts: Parts,
        time: float,
        exponential: _Exponential,
        starts: Floats,
        befores: Floats,
    ) -> Floats:
        """The state at any time of a stretch; works by Gauss points up to there."""
        passed = (time - parts.begin) / parts.length
        part = min(parts.number - 1, max(0, int(passed)))
        within = min(1.0, max(0.0, passed - part))
        moves = exponential.at(within * _NODES)
        size = self.size
        made = np.zeros((self.equations.size, 1, len(_NODES)))
        made[:size, 0] = (moves @ starts[:, part])[:, :size].T / self.balance[:, None]
        begin = parts.begin + part * parts.length
        times = begin + parts.length * within * _NODES[None, :]
        self._account(made, times, befores[:, part], parts.length * within)
        return np.asarray(made[:, 0, -1])

    def _account(self, states: Floats, times: Floats, before: Floats, length: float) -> None:
        """Fill in works and losses."""
        equations = self.equations
        first = equations.works.start
        count, nodes = times.shape
        at = np.broadcast_to(before[first:, None], (equations.size - first, count * nodes))
        flat = np.vstack([states[:first].reshape(first, count * nodes), at])
        powers = equations.powers_at(times.reshape(-1), flat)
        by_part = powers.reshape(-1, count, nodes)[:, :, :_GAUSS] @ _WEIGHTS * (0.5 * length)
        ends = before[first:, None] + np.cumsum(by_part, axis=1)
        begins = np.hstack([before[first:, None], ends[:, :-1]])
        states[first:] = begins[:, :, None]
        states[first:, :, -1] = ends


class _Exponential:
    """Of a matrix, for any part of a time: by its series, after so many halvings."""

    def __init__(self, matrix: Floats) -> None:
        norm = float(np.abs(matrix).sum(axis=0).max(initial=0.0))
        self.halvings = max(0, int(np.ceil(np.log2(norm / 2.0)))) if norm > 2.0 else 0
        step = matrix / 2.0**self.halvings
        terms = [np.eye(len(matrix))]
        for number in range(1, _TERMS + 1):
            terms.append(terms[-1] @ step / number)
        self.series = np.array(terms)

    def at(self, parts: Floats) -> Floats:
        """For parts of the time, each 0 to 1; shape (parts, size, size)."""
        factors = parts[:, None] ** np.arange(len(self.series))
        made: Floats = np.tensordot(factors, self.series, axes=1)
        for _ in range(self.halvings):
            made = made @ made
        return made


def _repeated(step: Floats, first: Floats, count: int) -> Floats:
    """States at the start of each of so many equal parts, by doubling."""
    made = first[:, None]
    while made.shape[1] < count:
        made = np.hstack([made, step @ made])
        step = step @ step
    return made[:, :count]
