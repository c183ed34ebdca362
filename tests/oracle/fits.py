"""Ratios of the sets for wanted ratios of the gears, found in a slow and simple way.

The speeds of a gear by numpy's solution of its equations, differences in place of
derivatives, many starts, and scipy's optimiser over -- per set -- the logarithm of |K|, or a
search that knows no derivatives at all. Nothing is shared with the program.
"""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.optimize import Bounds, differential_evolution, least_squares

from tests.oracle.combinations import Train

Vector = npt.NDArray[np.float64]
Limits = Sequence[tuple[float, float]]
"""Of K of each set, both of one sign."""
Engaged = Sequence[int]
"""Indices of the elements of a gear."""


class Fitted(NamedTuple):
    """One set of ratios at which nothing near is better."""

    ratios: tuple[float, ...]
    squares: float
    """Sum of ln(i/target)^2, with weights."""
    largest: float
    """The largest |ln(i/target)|."""


def ratio(train: Train, engaged: Engaged, ratios: Sequence[float]) -> float:
    """Input speed by output speed; nan where the output stands or is free."""
    links = train.links
    place = {link: at for at, link in enumerate(links)}
    rows = []
    for (first, second, third), k in zip(train.sets, ratios, strict=True):
        rows.append([(first, 1.0), (second, -k), (third, k - 1)])
    rows += [[(train.elements[n][0], 1.0), (train.elements[n][1], -1.0)] for n in engaged]
    matrix = np.zeros((len(rows) + 1, len(links)))
    for at, row in enumerate(rows):
        for link, value in row:
            if link:
                matrix[at, place[link]] += value
    matrix[-1, place[train.input]] = 1
    right = np.zeros(len(matrix))
    right[-1] = 1
    speeds, _, _, _ = np.linalg.lstsq(matrix, right, rcond=None)
    if not np.allclose(matrix @ speeds, right, atol=1e-9):
        return math.nan
    out = float(speeds[place[train.output]])
    return 1 / out if abs(out) > 1e-12 else math.nan


class Wish(NamedTuple):
    """What is to be met, and what may be changed for it."""

    train: Train
    gears: Mapping[str, Engaged]
    targets: Mapping[str, float]
    bounds: Limits
    weights: Mapping[str, float] = {}

    @property
    def signs(self) -> list[int]:
        """Of K of each set."""
        return [1 if low > 0 else -1 for low, _ in self.bounds]

    @property
    def ends(self) -> list[tuple[float, float]]:
        """The least and the largest ln |K| of each set."""
        both = [sorted((math.log(abs(a)), math.log(abs(b)))) for a, b in self.bounds]
        return [(low, high) for low, high in both]

    def ratios(self, logarithms: Vector) -> tuple[float, ...]:
        """K of each set from ln |K|."""
        pairs = zip(self.signs, logarithms.tolist(), strict=True)
        return tuple(sign * math.exp(x) for sign, x in pairs)

    def misses(self, logarithms: Vector) -> Vector:
        """ln(i/target) of each gear; a wrong sign of i counts as ten."""
        values = []
        for name, target in self.targets.items():
            share = ratio(self.train, self.gears[name], self.ratios(logarithms)) / target
            values.append(math.log(share) if share > 0 else 10.0)
        return np.array(values)

    def weighted(self, logarithms: Vector) -> Vector:
        """The same by the roots of the weights."""
        weights = [self.weights.get(name, 1.0) for name in self.targets]
        weighted: Vector = np.sqrt(weights) * self.misses(logarithms)
        return weighted

    def squares(self, logarithms: Vector) -> float:
        """The sum of their squares."""
        return float((self.weighted(logarithms) ** 2).sum())

    def fitted(self, logarithms: Vector) -> Fitted:
        """What is found there."""
        largest = float(abs(self.misses(logarithms)).max())
        return Fitted(self.ratios(logarithms), self.squares(logarithms), largest)


def fits(wish: Wish, *, starts: int = 30, seed: int = 0) -> list[Fitted]:
    """All least squares that many starts lead to, the best first."""
    low, high = np.array(wish.ends).T
    chance = np.random.default_rng(seed)
    found: list[Fitted] = []
    for _ in range(starts):
        done = least_squares(
            wish.weighted,
            low + chance.random(len(low)) * (high - low),
            bounds=(low, high),
            jac="3-point",
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
        one = wish.fitted(done.x)
        if one.largest < 10 and not any(
            np.allclose(one.ratios, other.ratios, rtol=1e-4) for other in found
        ):
            found.append(one)
    return sorted(found, key=lambda one: one.squares)


def without_derivatives(wish: Wish, *, seed: int = 0) -> Fitted:
    """The least squares of differential evolution."""
    low, high = np.array(wish.ends).T
    done = differential_evolution(wish.squares, Bounds(low, high), rng=seed, tol=1e-12, maxiter=400)
    return wish.fitted(done.x)
