"""Exhaustive and slow searches for teeth and ratios, against known counts and closed forms."""

import math
from collections import Counter
from fractions import Fraction

import pytest

from tests.oracle.combinations import Train
from tests.oracle.fits import Wish, fits, ratio, without_derivatives
from tests.oracle.teeth import Meshed, Ravigneaux, Rules, belaz, is_meshed, ravigneaux, simple

pytestmark = pytest.mark.slow  # nothing in them is the program's own
TABLE = ((range(15, 61), range(14, 61), range(122)), (3, 4, 5, 6), Rules(0.5, 14))


def test_table_of_simple_sets() -> None:
    """1433 sets, 635 ratios; the best largest error of the BelAZ-7516 is 2.5e-5."""
    found = list(simple(*TABLE))
    assert (len(found), len({one.ratio for one in found})) == (1433, 635)
    assert Counter(one.planets for one in found) == {3: 437, 4: 593, 5: 183, 6: 220}
    error, sizes = belaz(
        (one.ratio for one in found), {"2": 4, "4": 2.01, "5": 1.4925, "R2": -5.12}
    )
    assert error == pytest.approx(math.log(100 / 67 / 1.4925), rel=1e-3)
    assert error == pytest.approx(2.5e-5, rel=1e-3)
    assert sizes == pytest.approx((67 / 33, 67 / 33, 3, 2.04))


def test_built_ravigneaux() -> None:
    """The Mazda GF4A-EL and the Ford AOD are among those that can be built."""
    rules = Rules(0.5, 17)
    near = ((30,), (36,), (84,), (22,), (24,))
    assert list(ravigneaux(near, (3,), rules)) == [Ravigneaux(30, 36, 84, 22, 24, 3)]
    near = ((30,), (36,), (72,), (18,), (18,))
    assert list(ravigneaux(near, (3,), rules)) == [Ravigneaux(30, 36, 72, 18, 18, 3)]


def test_pairs_in_line_are_the_limit() -> None:
    """On a straight line the ring has the sun's teeth and twice both planets'."""
    rules = Rules(0.5, 17)
    assert is_meshed(Meshed(30, 20, 20, 90, 3), rules)
    assert not any(is_meshed(Meshed(30, 20, 20, ring, 1), rules) for ring in range(110, 200))


BELAZ = Train(
    sets=[(3, 1, 2), (2, 4, 5), (2, 5, 7), (5, 6, 7)],
    ratios=[Fraction(-2)] * 4,
    elements=[(1, 2), (2, 5), (3, 0), (4, 0), (5, 0), (6, 0)],
    input=1,
    output=7,
)
"""Evseenko, tables 1 and 2: sun, ring, carrier of four sets; F1 F2 T1 T2 T3 T4."""
GEARS = {
    "F1 T3": (0, 4),
    "F1 T2": (0, 3),
    "F1 T4": (0, 5),
    "T1 F2": (1, 2),
    "T1 T3": (2, 4),
    "T1 T2": (2, 3),
}
BOUNDS = [(-5.0, -1.4)] * 4


def test_ratios_of_the_belaz_are_their_formulas() -> None:
    k1, k2, k3, k4 = ratios = (-2.0, -2.6, -2.2, -2.4)
    split, low = (k1 - 1) / k1, (1 - k2) * (1 - k3) / (1 - k2 - k3)
    forms = [1 - k3, low, 1 - k3 * k4, split, split * (1 - k3), split * low]
    found = [ratio(BELAZ, engaged, ratios) for engaged in GEARS.values()]
    assert found == pytest.approx(forms, rel=1e-13)


def test_four_ratios_are_met_by_the_explicit_solution() -> None:
    """p3 = u1 - 1, p2 = u1 (u2 - 1)/(u1 - u2), p4 = (1 - uR)/p3, p1 = 1/(us - 1)."""
    one, two, reverse, split = 4, 2.01, -5.12, 1.4925
    targets = {"F1 T3": one, "F1 T2": two, "F1 T4": reverse, "T1 F2": split}
    p3 = one - 1
    explicit = (1 / (split - 1), one * (two - 1) / (one - two), p3, (1 - reverse) / p3)
    (found,) = fits(Wish(BELAZ, GEARS, targets, BOUNDS), starts=6)
    assert [-k for k in found.ratios] == pytest.approx(explicit, rel=1e-10)
    assert found.largest < 1e-12


def test_a_search_without_derivatives_finds_the_same_compromise() -> None:
    targets = {"F1 T3": 4, "F1 T2": 2.01, "T1 F2": 1.4925, "T1 T3": 5.97, "T1 T2": 2.95}
    best, *_ = fits(Wish(BELAZ, GEARS, targets, BOUNDS), starts=6)
    other = without_derivatives(Wish(BELAZ, GEARS, targets, BOUNDS))
    assert other.squares == pytest.approx(best.squares, rel=1e-6)
    assert other.largest == pytest.approx(best.largest, rel=1e-3)
    assert best.largest > 1e-3
