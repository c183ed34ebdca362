"""What cells stand for, whatever they look like."""

from __future__ import annotations

import math

from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.summary.pretty import gears_grid
from vstatics.core.tables.grid import Cell, exact, sign, whole


def test_a_number_stays_one_with_any_number_of_decimals() -> None:
    assert exact(4.696, 0)[:2] == ("5", 4.696)
    assert exact(4.696, 0).datum == 4.696
    assert exact(math.nan).datum is None


def test_counts_and_signs_are_no_fractions() -> None:
    assert repr(whole(20_000_000).datum) == "20000000"
    assert repr(sign(1.0).datum) == "True"
    assert [whole(math.nan).datum, sign(math.nan).datum] == [None, None]


def test_words_beside_a_number_are_words() -> None:
    """The number is what they are sorted by."""
    assert Cell("1333 set.planet", 1333.33).datum == "1333 set.planet"


def test_a_coloured_number_is_that_number() -> None:
    pair = Transmission(2, [], [Mechanism(1, 2, 0, 4.696, 0.98)], [Gear()])
    assert gears_grid(solve(pair)).data[0][1] == 4.696
