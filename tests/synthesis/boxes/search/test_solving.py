"""Whether gears can be within their ranges, each by a ratio of its own, against a fine grid."""

from itertools import combinations, pairwise, permutations

import numpy as np
import pytest

from tests.chance import examples
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.synthesis.boxes.search.engaged import combinations_table
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.boxes.search.shifts import neighbours
from vstatics.synthesis.boxes.search.solving import cell_room, solved
from vstatics.synthesis.tolerances import BEYOND_WIDTH

LOW, HIGH = 1.4, 5.0
SIZE, ENGAGED = 4, 2
PAIRS = sorted(combinations(range(SIZE), ENGAGED), key=lambda one: one[::-1])
"""The combinations of four elements, as their table has them."""


def weights(points: Floats) -> Floats:
    part = (points - LOW) / (HIGH - LOW)
    bits = (np.arange(4)[:, None] >> np.arange(2)) & 1
    return np.asarray(np.where(bits, part[:, None], 1 - part[:, None]).prod(axis=2))


def values(parts: Floats, points: Floats) -> Floats:
    own = weights(points)
    return np.asarray((own @ parts[:, 0].T) / (own @ parts[:, 1].T))


def can_be_engaged(chosen: tuple[int, ...], ratio_of: Integers, shifts: Integers) -> bool:
    """Whether pairs of elements give the chosen ratios, all elements are used, and one changes."""

    def grown(pairs: list[tuple[int, ...]]) -> bool:
        if len(pairs) == len(chosen):
            used = {element for one in pairs for element in one}
            ends = ((pairs[a], pairs[b]) for a, b in shifts.tolist())
            return used == set(range(SIZE)) and all({*a} & {*b} for a, b in ends)
        own = (p for p, ratio in zip(PAIRS, ratio_of, strict=True) if ratio == chosen[len(pairs)])
        return any(grown([*pairs, one]) for one in own)

    return grown([])


@pytest.mark.parametrize("is_single", [False, True])
@examples(20, 60, 600)
def test_boxes_are_found_where_a_grid_has_them_and_no_others(
    is_single: bool, examples: int
) -> None:
    random = np.random.default_rng(32)
    grid = np.geomspace(LOW, HIGH, 60)
    points = np.array([(one, other) for one in grid for other in grid])
    found_some = beyond_grid = 0
    for _ in range(examples):
        parts = random.uniform(0.4, 2, (5, 2, 4))
        parts[4] = 1.0  # a direct drive
        ratio_of = np.array([*random.permutation(5), random.integers(5)])
        hidden = values(parts, random.choice(points, 1))[0]
        targets = random.choice(hidden, 3, replace=False) * np.exp(random.normal(0, 0.04, 3))
        widths = random.uniform(0.01, 0.08, 3)
        ends = targets * np.exp(np.array([[-1], [1]]) * (widths + 1e-9))
        asked = Asked(targets, ends[0], ends[1], widths, LOW, HIGH)
        table = combinations_table(3, ENGAGED, SIZE)
        shifts = neighbours(targets.tolist() if is_single else [])
        room = cell_room(table, asked, 2, shifts)
        room.ratio_of[:] = ratio_of
        total = solved(parts, np.full(5, 0b111), asked, room)
        assert not room.given_up[0]

        near = (np.log(values(parts, points)[:, :, None] / targets) / widths) ** 2
        ways = [w for w in permutations(range(5), 3) if can_be_engaged(w, ratio_of, shifts)]
        best = np.inf
        for way in ways:
            own = near[:, way, range(3)]
            best = min(best, own.sum(axis=1)[(own <= 1).all(axis=1)].min(initial=np.inf))
        assert total <= best * (1 + 1e-9)
        if total < np.inf:
            found_some += 1
            beyond_grid += best == np.inf
            chosen = tuple(ratio_of[room.best_gears].tolist())
            assert chosen in ways
            there = values(parts, np.exp(room.best_logs)[None])[0, list(chosen)]
            errors = np.log(there / targets) / widths
            assert np.abs(errors).max() <= 1 + 2 * BEYOND_WIDTH
            assert total == pytest.approx((errors**2).sum(), rel=1e-9)
            assert room.best[1] == pytest.approx(np.abs(errors * widths).max())
            assert all(LOW <= one <= HIGH * (1 + 1e-12) for one in np.exp(room.best_logs))
            gears = [PAIRS[one] for one in room.best_gears]
            falling = [gears[n] for n in np.argsort(-targets)]
            assert not is_single or all({*a} & {*b} for a, b in pairwise(falling))
    assert found_some > beyond_grid > 0
