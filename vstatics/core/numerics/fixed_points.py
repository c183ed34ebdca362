"""All fixed points of efficiencies that depend on torques.

Each law gives an efficiency e_i at a torque T_i, and each torque depends on all efficiencies. The
torques solve a linear system in which a factor y_j, either e_j or 1/e_j, multiplies the column of
T_j. By Cramer's rule T_i = N_i/D, where both determinants are linear in each factor, and N_i does
not contain y_i. While signs and exponents do not change, the extremes of a torque over a box of
efficiencies are therefore at its corners. The same is true for (dT_i/dy_j)/T_j, which follows from
differences between the corners. So derivatives are bounded in the whole box, and the operator of
Krawczyk (1969) recognises boxes with a single fixed point or none. Other boxes are halved.

Arrays have a column for each point or box, and a row for each efficiency.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property, reduce
from itertools import product
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.tolerances import (
    EPSILON,
    LEAST_BOX_WIDTH,
    SAME_CLUSTER,
    SAME_FIXED_POINT,
    SAME_TRIAL,
    STANDS_STILL,
)

MOST_BOX_CORNERS = 16
"""Number of corners of a box up to which all are used. Of more corners, the search uses those at
which all efficiencies, except at most one, are at the same end of their ranges."""
BOX_MARGIN = 0.05
"""Part of the width by which a box is enlarged, so that no fixed point is on a side. [-]"""
SMALL_BOX = 0.05
"""Width of a box below which torques are assumed to exist at a corner if they exist in the box, and
not to be much larger than at the corners. [-]"""
MOST_BOXES = 2000
"""Largest number of boxes at each point. The search at a point ends at this number."""
MOST_BOX_HALVINGS = 150
"""Largest number of halvings."""
MOST_CHORD_STEPS = 60
"""Largest number of iterations that improve a fixed point."""
MOST_CORNERS_AT_ONCE = 100_000
"""Largest number of corners at which torques are calculated together."""
MOST_SEARCHED_POINTS = 500
"""Largest number of points whose boxes are searched together."""


class TrialTorques(NamedTuple):
    """Torques for given efficiencies."""

    values: Floats
    """Torques at which the laws are evaluated. [N*m]"""
    exponents: Floats
    """Exponents (1, -1 or 0) of the efficiencies with which torques are multiplied."""
    exist: Booleans
    """Flags of existing torques, shape (points,)."""


class Extremes(NamedTuple):
    """Bounds of the values or slopes of each law at each point."""

    least: Floats
    largest: Floats


TorquesAt = Callable[[Integers, Floats], TrialTorques]
"""Function of indices of points and efficiencies; returns torques."""
BoundsOver = Callable[[Integers, Floats, Floats], Extremes]
"""Function of indices of points, least torques and largest torques; returns bounds."""


class Laws(NamedTuple):
    """Laws and the torques on which they depend."""

    torques_at: TorquesAt
    values: BoundsOver
    slopes: BoundsOver

    def error_at(self, point: Integers, efficiencies: Floats) -> Floats:
        """Return efficiencies by the laws minus given efficiencies; NaN without torques."""
        torques = self.torques_at(point, efficiencies)
        size = np.abs(torques.values)
        error = self.values(point, size, size).least - efficiencies
        return np.where(torques.exist, error, np.nan)


class AllFixedPoints(NamedTuple):
    """Fixed points, in any order."""

    point: Integers
    """Indices of the points, shape (fixed points,)."""
    efficiencies: Floats
    """Efficiencies, shape (laws, fixed points). [-]"""


class _Boxes(NamedTuple):
    """Boxes of efficiencies."""

    point: Integers
    low: Floats
    high: Floats

    def of(self, which: Booleans | Integers) -> _Boxes:
        return _Boxes(self.point[which], self.low[:, which], self.high[:, which])

    def joined(self, boxes: _Boxes) -> _Boxes:
        low, high = np.hstack([self.low, boxes.low]), np.hstack([self.high, boxes.high])
        return _Boxes(np.concatenate([self.point, boxes.point]), low, high)

    def within(self, low: Floats, high: Floats) -> _Boxes:
        return self._replace(low=np.maximum(self.low, low), high=np.minimum(self.high, high))

    @property
    def width(self) -> Floats:
        """Largest width of each box."""
        width: Floats = (self.high - self.low).max(axis=0)
        return width

    @property
    def middle(self) -> Floats:
        return (self.low + self.high) / 2

    @property
    def enlarged(self) -> _Boxes:
        slack = BOX_MARGIN * (self.high - self.low) + LEAST_BOX_WIDTH
        high = np.minimum(self.high + slack, 1 - SAME_TRIAL)
        low = np.minimum(np.maximum(self.low - slack, self.low / 2), high - LEAST_BOX_WIDTH)
        return self._replace(low=low, high=high)

    @property
    def halves(self) -> _Boxes:
        """Both halves of each box, divided across its largest width."""
        widths = self.high - self.low
        widest = np.arange(len(widths))[:, None] == widths.argmax(axis=0)
        first = self._replace(high=np.where(widest, self.middle, self.high))
        second = self._replace(low=np.where(widest, self.middle, self.low))
        return first.joined(second)


@np.errstate(all="ignore")
def find_fixed_points(laws: Laws, low: Floats, high: Floats, known: Floats) -> AllFixedPoints:
    """Find all fixed points.

    Parameters
    ----------
    laws : Laws
        Laws and torques.
    low, high : ndarray, shape (laws, points)
        Least and largest efficiencies. [-]
    known : ndarray, shape (laws, points)
        A known fixed point of each point; NaN if unknown.
    """
    is_known = np.isfinite(known).all(axis=0)
    boxes = _Boxes(np.arange(low.shape[1]), low, high)
    settled = is_known & _Corners(laws, boxes).contracts
    open_points = np.flatnonzero(~settled)
    groups: list[tuple[AllFixedPoints, float]] = []
    for start in range(0, len(open_points), MOST_SEARCHED_POINTS):
        part = open_points[start : start + MOST_SEARCHED_POINTS]
        groups += _searched(laws, boxes.of(part), known)
    return _distinct(known, groups)


def _searched(laws: Laws, boxes: _Boxes, known: Floats) -> Iterator[tuple[AllFixedPoints, float]]:
    """Yield fixed points, and the distance within which they count as equal."""
    near, clusters = [], [boxes.of(np.array([], int))]
    for _ in range(MOST_BOX_HALVINGS):
        if not boxes.point.size:
            break
        boxes, candidates = _narrowed(laws, boxes, known)
        near.append(candidates)
        # Boxes that are entirely close to a known fixed point contain no separate fixed point.
        far = np.abs(boxes.middle - known[:, boxes.point]).max(axis=0) + boxes.width
        boxes = boxes.of(~(far < SAME_CLUSTER))
        small = boxes.width < LEAST_BOX_WIDTH
        clusters.append(boxes.of(small))
        boxes = boxes.of(~small)
        boxes = boxes.of(np.bincount(boxes.point)[boxes.point] < MOST_BOXES)
    points, efficiencies, inverses = zip(*near, strict=True)
    joined = np.concatenate(points), np.hstack(efficiencies), np.concatenate(inverses, axis=-1)
    yield _iterated(laws, *joined), SAME_FIXED_POINT
    yield _of_clusters(laws, reduce(_Boxes.joined, clusters)), SAME_CLUSTER


class _Corners:
    """Bounds of torques and their derivatives in boxes, from the corners of enlarged boxes."""

    def __init__(self, laws: Laws, boxes: _Boxes) -> None:
        self.laws, self.point, self.boxes = laws, boxes.point, boxes.enlarged
        number = len(boxes.low)
        every = [*product((False, True), repeat=number)]
        if len(every) > MOST_BOX_CORNERS:
            every = [corner for corner in every if sum(corner) in (0, 1, number - 1, number)]
        self.index = {corner: place for place, corner in enumerate(every)}
        at = np.array(every)[:, :, None]
        self.efficiencies = np.where(at, self.boxes.high, self.boxes.low)
        values, exponents, self.exist = _at_corners(laws, boxes.point, self.efficiencies)
        self.values, self.exponents = values, exponents[0]
        turns = np.sum([(np.sign(values) == way).any(axis=0) for way in (-1, 0, 1)], axis=0) > 1
        self.is_regular = self.exist.all(axis=0) & ~turns.any(axis=0)
        self.is_regular &= (exponents == exponents[0]).all(axis=(0, 1))
        exist = self.exist[:, None]
        least = np.where(exist, np.abs(values), np.inf).min(axis=0)
        largest = np.where(exist, np.abs(values), -np.inf).max(axis=0)
        small = boxes.width < SMALL_BOX
        spread = (1 + 2 * boxes.width) * (largest / least) ** 2
        slack = np.where(small, np.minimum(spread, 2.0), 2.0)
        slack = np.where(self.is_regular, 1.0, slack)
        self.least = np.where(turns | np.isinf(least), 0.0, least / slack)
        self.largest = np.where(self.exist.all(axis=0) | small, largest * slack, np.inf)

    @cached_property
    def responses(self) -> tuple[Floats, Floats]:
        """Bounds of dT_i/dy_j divided by T_j, where y_j is e_j to the power of its exponent."""
        powers, number = self.efficiencies**self.exponents, len(self.least)
        low = np.full((number, *self.least.shape), np.inf)
        high = -low
        for corner, place in self.index.items():
            for law in range(number):
                flipped = *corner[:law], not corner[law], *corner[law + 1 :]
                if (other := self.index.get(flipped)) is None:
                    continue
                rise = self.values[other] - self.values[place]
                run = (powers[other, law] - powers[place, law]) * self.values[other, law]
                response = np.where(run == 0, 0.0, rise / run)
                low[:, law] = np.minimum(low[:, law], response)
                high[:, law] = np.maximum(high[:, law], response)
        return low, high

    @cached_property
    def factors(self) -> Extremes:
        """Bounds of the magnitudes of T_j dy_j/de_j."""
        ends = [
            np.abs(self.exponents) * end ** (self.exponents - 1)
            for end in (self.boxes.low, self.boxes.high)
        ]
        return Extremes(np.minimum(*ends) * self.least, np.maximum(*ends) * self.largest)

    @cached_property
    def slopes(self) -> Extremes:
        """Bounds of the slopes of the laws."""
        return self.laws.slopes(self.point, self.least, self.largest)

    @property
    def contracts(self) -> Booleans:
        """Flags of boxes in which iterations contract, so at most one fixed point exists."""
        steepest = np.maximum(*map(np.abs, self.slopes))
        largest = np.maximum(*map(np.abs, self.responses)) * self.factors.largest
        gains = steepest * largest.sum(axis=1)
        is_below: Booleans = (gains < 1).all(axis=0) & self.is_regular
        return is_below

    @property
    def derivatives(self) -> Extremes:
        """Bounds of the derivatives of the efficiencies by the laws, shape (laws, laws, boxes)."""
        ways = np.sign(self.values[0])
        response = _product(Extremes(*self.responses), Extremes(*self.factors))
        turned = _product(response, Extremes(*[ways[:, None] * ways * np.sign(self.exponents)] * 2))
        return _product(turned, Extremes(*(slope[:, None] for slope in self.slopes)))


def _at_corners(laws: Laws, point: Integers, efficiencies: Floats) -> TrialTorques:
    """Return the torques at corners, with the corners as first axis."""
    if efficiencies[:, 0].size > MOST_CORNERS_AT_ONCE:
        each = [laws.torques_at(point, at_corner) for at_corner in efficiencies]
        return TrialTorques(*map(np.array, zip(*each, strict=True)))
    corners = len(efficiencies)
    flat = laws.torques_at(np.tile(point, corners), np.hstack([*efficiencies]))
    return TrialTorques(*(np.array(np.split(array, corners, axis=-1)) for array in flat))


def _product(first: Extremes, second: Extremes) -> Extremes:
    """Return the bounds of products."""
    products = [a * b for a in first for b in second]
    return Extremes(np.minimum.reduce(products), np.maximum.reduce(products))


_Candidates = tuple[Integers, Floats, Floats]
"""Indices of points, efficiencies near fixed points, and inverse derivatives of errors."""


def _narrowed(laws: Laws, boxes: _Boxes, known: Floats) -> tuple[_Boxes, _Candidates]:
    """Return boxes in which fixed points are still possible, and candidates from other boxes."""
    at = _Corners(laws, boxes)
    width = boxes.width
    values = laws.values(boxes.point, at.least, at.largest)
    narrow = boxes.within(values.least - STANDS_STILL, values.largest + STANDS_STILL)
    remains = (narrow.low <= narrow.high).all(axis=0)
    remains &= at.exist.any(axis=0) | (width > SMALL_BOX)
    inverse, spread = _inverse(at.derivatives, at.is_regular & remains)
    inner = narrow.enlarged.within(at.boxes.low, at.boxes.high)
    half = (inner.high - inner.low) / 2
    reach = np.einsum("ijn,jn->in", spread, half)
    single = (reach < half).all(axis=0)
    near = known[:, boxes.point]
    settled = single & ((near >= at.boxes.low) & (near <= at.boxes.high)).all(axis=0)
    remains &= ~settled
    narrow, inner, reach, half = narrow.of(remains), inner.of(remains), *_of(remains, reach, half)
    inverse, width = _of(remains, inverse, width)
    if not remains.any():
        return narrow, (narrow.point, narrow.low, inverse)
    error = laws.error_at(narrow.point, inner.middle)
    step = np.nan_to_num(-np.einsum("ijn,jn->in", inverse, error), nan=np.inf)
    centre = inner.middle + np.where(np.isfinite(step), step, 0.0)
    reach = np.where(np.isfinite(step).all(axis=0), reach, np.inf)
    proven = ((reach < half / 2) & (np.abs(step) + reach < half)).all(axis=0)
    narrow = narrow.within(centre - reach - STANDS_STILL, centre + reach + STANDS_STILL)
    candidates = (narrow.point[proven], centre[:, proven], inverse[..., proven])
    remains = (narrow.low <= narrow.high).all(axis=0) & ~proven
    slow = narrow.width > width / 2
    return narrow.of(remains & ~slow).joined(narrow.of(remains & slow).halves), candidates


def _of(which: Booleans, *arrays: Floats) -> list[Floats]:
    return [array[..., which] for array in arrays]


def _inverse(derivatives: Extremes, where: Booleans) -> tuple[Floats, Floats]:
    """Return the inverse of the mean derivatives of the errors, and its relative spread.

    The spread is infinite where no inverse exists.
    """
    identity = np.eye(len(derivatives.least))
    middle = (derivatives.least + derivatives.largest) / 2 - identity[:, :, None]
    radius = (derivatives.largest - derivatives.least) / 2
    matrices = np.moveaxis(middle, -1, 0)
    where = where & np.isfinite(radius).all(axis=(0, 1)) & np.isfinite(middle).all(axis=(0, 1))
    matrices = np.where(where[:, None, None], matrices, identity)
    where &= np.abs(np.linalg.det(matrices)) > SAME_TRIAL
    inverse = np.moveaxis(np.linalg.inv(np.where(where[:, None, None], matrices, identity)), 0, -1)
    spread = np.einsum("ijn,jkn->ikn", np.abs(inverse), np.where(where, radius, 0.0))
    return inverse, np.where(where, spread, np.inf)


def _iterated(laws: Laws, point: Integers, efficiencies: Floats, inverse: Floats) -> AllFixedPoints:
    """Return fixed points, iterated from candidates with constant derivatives."""
    efficiencies, moving = efficiencies.copy(), np.arange(len(point))
    for _ in range(MOST_CHORD_STEPS):
        if not moving.size:
            break
        error = laws.error_at(point[moving], efficiencies[:, moving])
        step = np.nan_to_num(np.einsum("ijn,jn->in", inverse[..., moving], error))
        efficiencies[:, moving] -= step
        moving = moving[(np.abs(step) > 4 * EPSILON).any(axis=0)]
    return AllFixedPoints(point, efficiencies)


def _of_clusters(laws: Laws, boxes: _Boxes) -> AllFixedPoints:
    """Return fixed points in small boxes that can contain several or none, by Newton's method."""
    best, least = boxes.middle, np.full(len(boxes.point), np.inf)
    moving, efficiencies = np.arange(len(boxes.point)), boxes.middle
    for _ in range(MOST_CHORD_STEPS):
        if (least <= SAME_TRIAL).all() or not moving.size:
            break
        part = boxes.of(moving)
        error = laws.error_at(part.point, efficiencies)
        left = np.nan_to_num(np.abs(error).max(axis=0), nan=np.inf)
        best[:, moving] = np.where(left < least[moving], efficiencies, best[:, moving])
        least[moving] = np.minimum(left, least[moving])
        shifts = LEAST_BOX_WIDTH * np.eye(len(efficiencies))[:, :, None]
        shifted = [laws.error_at(part.point, efficiencies - shift) for shift in shifts]
        slopes = np.stack([(error - other) / LEAST_BOX_WIDTH for other in shifted], axis=1)
        exists = np.isfinite(slopes).all(axis=(0, 1))
        inverse = np.linalg.pinv(np.moveaxis(np.where(exists, slopes, 0.0), -1, 0))
        step = np.einsum("nij,jn->in", inverse, np.nan_to_num(error))
        following = np.clip(efficiencies - step, *part.enlarged[1:])
        moves = (following != efficiencies).any(axis=0)
        moving, efficiencies = moving[moves], following[:, moves]
    agrees = least <= SAME_TRIAL
    return AllFixedPoints(boxes.point[agrees], best[:, agrees])


def _distinct(known: Floats, groups: Iterable[tuple[AllFixedPoints, float]]) -> AllFixedPoints:
    """Return known and searched fixed points without repetitions; groups have a least distance."""
    each: dict[int, list[tuple[Floats, float]]] = {}
    for fixed, distance in groups:
        for point, efficiencies in zip(fixed.point.tolist(), fixed.efficiencies.T, strict=True):
            before = [(known[:, point], 0.0)] if np.isfinite(known[:, point]).all() else []
            of_point = each.setdefault(point, before)
            if all(
                np.abs(efficiencies - other).max() > max(distance, least)
                for other, least in of_point
            ):
                of_point.append((efficiencies, distance))
    alone = np.flatnonzero(np.isfinite(known).all(axis=0))
    alone = alone[~np.isin(alone, [*each])]
    several = [(point, root) for point, of_point in each.items() for root, _ in of_point]
    points, roots = zip(*several, strict=True) if several else ((), ())
    return AllFixedPoints(
        np.concatenate([alone, np.array(points, dtype=alone.dtype)]),
        np.hstack([known[:, alone], np.reshape(roots, (len(roots), len(known))).T]),
    )
