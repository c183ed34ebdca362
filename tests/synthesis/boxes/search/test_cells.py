"""What is cut off from cells of ratios holds no solution."""

from itertools import permutations

import numpy as np
import pytest

from vstatics.synthesis.boxes.search.matching import is_assigned, match_room
from vstatics.synthesis.boxes.search.planes import plane_room, planes_leave


@pytest.mark.parametrize("seed", range(40))
def test_a_ratio_keeps_just_the_targets_of_some_assignment(seed: int) -> None:
    rng = np.random.default_rng(seed)
    targets = int(rng.integers(1, 5))
    ratios = int(rng.integers(1, 7))
    reach = rng.integers(0, 1 << targets, ratios)
    expected = np.zeros_like(reach)
    for order in permutations(range(ratios), min(targets, ratios)):
        if len(order) == targets and all(reach[r] >> t & 1 for t, r in enumerate(order)):
            for target, ratio in enumerate(order):
                expected[ratio] |= 1 << target
            for ratio in set(range(ratios)) - set(order):  # it may have one that another has here
                for target in range(targets):
                    expected[ratio] |= reach[ratio] & 1 << target
    assert is_assigned(reach, ratios, match_room(targets)) == bool(expected.any())
    if expected.any():
        assert reach.tolist() == expected.tolist()


@pytest.mark.parametrize("seed", range(60))
def test_planes_leave_every_place_where_all_gears_are_within_their_ranges(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sets, targets = int(rng.integers(1, 5)), int(rng.integers(1, 8))
    width = 10 ** rng.uniform(-2, 0.3)
    parts = rng.normal(size=(targets, 2, 1)) + width * rng.normal(size=(targets, 2, 2**sets))
    place = rng.uniform(size=sets)
    corners = np.arange(2**sets)[:, None] >> np.arange(sets) & 1
    weights = np.where(corners, place, 1 - place).prod(axis=1)
    ratios = parts[:, 0] @ weights / (parts[:, 1] @ weights)
    factors = np.exp(rng.uniform(0, 0.05, (2, targets)))
    ends = np.sort([ratios / factors[0], ratios * factors[1]], axis=0)
    room, left = plane_room(targets, sets), np.tile([0.0, 1.0], (sets, 1))
    room.only_ratios[:] = np.where(rng.uniform(size=targets) < 0.9, np.arange(targets), -1)
    assert planes_leave(parts, ends[0], ends[1], room, left)
    assert (left[:, 0] <= place).all()
    assert (place <= left[:, 1]).all()
