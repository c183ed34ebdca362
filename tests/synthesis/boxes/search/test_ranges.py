"""Cells of ratios: what quotients reach, what is cut off, which targets can be assigned."""

from itertools import permutations

import numpy as np
from scipy.optimize import least_squares
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from tests.chance import each_seed
from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.search.matching import is_assigned, match_room, matched
from vstatics.synthesis.boxes.search.planes import plane_room, planes_leave
from vstatics.synthesis.boxes.search.ranges import divide, lines, reached
from vstatics.synthesis.boxes.search.set_ratios import Asked, fit_room, fitted

CORNERS = (np.arange(8)[:, None] >> np.arange(3)) & 1


def weights(points: Floats) -> Floats:
    """How corners weigh in what is linear in each of three numbers from 0 to 1."""
    return np.asarray(np.where(CORNERS, points[:, None], 1 - points[:, None]).prod(axis=2))


def test_what_is_within_bounds_is_known_from_the_corners() -> None:
    random = np.random.default_rng(15)
    inside = weights(random.random((2000, 3)))
    for _ in range(300):
        above, below = random.normal(random.normal(), 1, (2, 8))
        values = (inside @ above) / (inside @ below)
        targets = np.sort(random.choice(values[values > 0], 1)) if (values > 0).any() else [1.0]
        low, high = np.array(targets) * 0.99, np.array(targets) * 1.01
        is_met = ((values >= low) & (values <= high)).any()
        assert reached(above, below, low, high) or not is_met


def test_no_more_is_reported_where_the_denominator_has_one_sign() -> None:
    """Then all between the least and the greatest quotient is reached, as it changes steadily."""
    random = np.random.default_rng(16)
    for _ in range(300):
        above, below = random.normal(size=8), random.uniform(0.2, 2, 8)
        low, high = np.array([0.5]), np.array([0.6])
        least, most = min(above / below), max(above / below)
        assert reached(above, below, low, high) == (least <= 0.6 and most >= 0.5)


def test_a_common_factor_is_taken_out() -> None:
    """(p1 - 1/2 - p2) times 2 + p3 and 1 + p3: the quotient depends on p3 alone."""
    p1, p2, p3 = CORNERS.T.astype(float)
    above, below = (p1 - 0.5 - p2) * (2 + p3), (p1 - 0.5 - p2) * (1 + p3)
    divide(above, below, lines(3))
    np.testing.assert_allclose(above / below, (2 + p3) / (1 + p3), rtol=1e-12)
    assert reached(above, below, np.array([1.49, 3.0]), np.array([1.51, 4.0])) == 0b01


def test_targets_are_matched_where_that_can_be() -> None:
    random = np.random.default_rng(17)
    for _ in range(300):
        can = random.random((7, 5)) < 0.35
        best = maximum_bipartite_matching(csr_array(can.T.astype(np.int8)), perm_type="column")
        assert matched(can @ (1 << np.arange(5)), 7, match_room(5)) == ((best >= 0).sum() == 5)


@each_seed(40)
def test_a_ratio_keeps_just_the_targets_of_some_assignment(seed: int) -> None:
    rng = np.random.default_rng(seed)
    targets, ratios = int(rng.integers(1, 5)), int(rng.integers(1, 7))
    reach = rng.integers(0, 1 << targets, ratios)
    expected = np.zeros_like(reach)
    for order in permutations(range(ratios), min(targets, ratios)):
        if len(order) == targets and all(reach[r] >> t & 1 for t, r in enumerate(order)):
            expected[[*order]] |= 1 << np.arange(targets)
            others = [*{*range(ratios)} - {*order}]  # they may have one that another has here
            expected[others] |= reach[others] & ((1 << targets) - 1)
    assert is_assigned(reach, ratios, match_room(targets)) == bool(expected.any())
    if expected.any():
        assert reach.tolist() == expected.tolist()


@each_seed(60)
def test_planes_leave_every_place_where_all_gears_are_within_their_ranges(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sets, targets = int(rng.integers(1, 5)), int(rng.integers(1, 8))
    width = 10 ** rng.uniform(-2, 0.3)
    parts = rng.normal(size=(targets, 2, 1)) + width * rng.normal(size=(targets, 2, 2**sets))
    place = rng.uniform(size=sets)
    corners = np.arange(2**sets)[:, None] >> np.arange(sets) & 1
    own = np.where(corners, place, 1 - place).prod(axis=1)
    ratios = parts[:, 0] @ own / (parts[:, 1] @ own)
    factors = np.exp(rng.uniform(0, 0.05, (2, targets)))
    ends = np.sort([ratios / factors[0], ratios * factors[1]], axis=0)
    room, left = plane_room(targets, sets), np.tile([0.0, 1.0], (sets, 1))
    room.only_ratios[:] = np.where(rng.uniform(size=targets) < 0.9, np.arange(targets), -1)
    assert planes_leave(parts, ends[0], ends[1], room, left)
    assert (left[:, 0] <= place).all()
    assert (place <= left[:, 1]).all()


@each_seed(5)
def test_a_fit_is_that_of_scipy(seed: int) -> None:
    random = np.random.default_rng(seed)
    parts = random.uniform(0.5, 2, (5, 2, 8))
    targets = random.uniform(0.7, 1.5, 5)
    asked = Asked(targets, targets, targets, np.ones(5), 1.5, 4.0)
    room = fit_room(5, 3)
    room.logs[:] = np.log(2.5)
    total = fitted(parts, np.arange(5), asked, 0.0, room)

    def errors(logs: Floats) -> Floats:
        own = weights((np.exp(logs)[None] - 1.5) / 2.5)[0]
        return np.asarray(np.log((parts[:, 0] @ own) / (parts[:, 1] @ own) / targets))

    start = np.full(3, np.log(2.5))
    ends = np.log(1.5), np.log(4.0)
    best = least_squares(errors, start, bounds=ends, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert total <= 2 * best.cost * (1 + 1e-9) + 1e-18
