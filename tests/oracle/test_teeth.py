"""The exhaustive search of teeth against known counts and built gearboxes."""

import math
from collections import Counter

import pytest

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
