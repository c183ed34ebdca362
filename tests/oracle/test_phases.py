"""The assembly conditions of planets against a simulation that puts the planets in.

The conditions are the usual closed ones; the simulation in `phases` knows none of them.
"""

import math
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.oracle.phases import (
    Contact,
    Group,
    Wheel,
    assembles,
    assembles_double,
    assembles_ravigneaux,
    assembles_rims,
    assembles_simple,
    assembles_stepped,
    triangle,
)

SUNS = st.integers(12, 60)
PLANETS = st.integers(10, 36)
COUNTS = st.integers(2, 6)


def test_three_planets_go_into_48_24_96_and_five_do_not() -> None:
    """48 + 96 = 144 pitches go round: divided by 3 without rest, by 5 not; one always goes in."""
    assert assembles_simple(48, 24, 96, 3)
    assert not assembles_simple(48, 24, 96, 5)
    assert assembles_simple(17, 23, 64, 1)
    assert assembles_stepped(17, 23, 101, 19, 1, internal1=False, internal2=True)


def test_planets_that_do_not_go_in_evenly_go_in_at_whole_steps_of_the_sum() -> None:
    """Places are the multiples of a turn by zs + zr; 17 + 63 = 80 allows 4 or 5 planets, not 3."""
    assert [n for n in range(2, 9) if assembles_simple(17, 23, 63, n)] == [2, 4, 5, 8]


@given(sun=SUNS, planet=PLANETS, more=st.integers(-2, 2), n=COUNTS)
def test_simple_planets_need_a_whole_sum_of_sun_and_ring_for_each(
    sun: int, planet: int, more: int, n: int
) -> None:
    ring = sun + 2 * planet + more
    assert assembles_simple(sun, planet, ring, n) == ((sun + ring) % n == 0)


@given(sun=SUNS, inner=PLANETS, outer=PLANETS, room=st.integers(0, 60), n=COUNTS)
def test_meshed_planets_need_a_whole_difference_of_ring_and_sun_for_each_pair(
    sun: int, inner: int, outer: int, room: int, n: int
) -> None:
    """The triangle of the centres has to close; there is no coaxial condition otherwise."""
    ring = sun + 2 * max(inner, outer) + room
    assume(ring <= sun + 2 * inner + 2 * outer)
    assert assembles_double(sun, inner, outer, ring, n) == ((ring - sun) % n == 0)


@given(
    wheels=st.tuples(SUNS, SUNS),
    rims=st.tuples(PLANETS, PLANETS),
    n=COUNTS,
    internal=st.tuples(st.booleans(), st.booleans()),
)
def test_stepped_planets_count_in_common_teeth_of_their_rims(
    wheels: tuple[int, int], rims: tuple[int, int], n: int, internal: tuple[bool, bool]
) -> None:
    """(za z2 + zb z1)/(n gcd(z1, z2)), with a minus between two suns or two rings."""
    sign = 1 if internal[0] != internal[1] else -1
    sum_of_products = wheels[0] * rims[1] + sign * wheels[1] * rims[0]
    found = assembles_stepped(
        wheels[0], rims[0], wheels[1], rims[1], n, internal1=internal[0], internal2=internal[1]
    )
    assert found == (sum_of_products % (n * math.gcd(*rims)) == 0)


@given(wheels=st.tuples(SUNS, SUNS, SUNS), rims=st.tuples(PLANETS, PLANETS), n=st.integers(2, 4))
def test_three_wheels_on_stepped_planets_need_the_condition_of_each_pair_at_once(
    wheels: tuple[int, int, int], rims: tuple[int, int], n: int
) -> None:
    """Sun and ring on the first rim, another ring on the second: Wolfrom's train.

    The simulation looks for one turned position that suits all three wheels.
    """
    sun, ring, ring2 = wheels
    on_first = Wheel(sun, "rim1", internal=False), Wheel(ring, "rim1", internal=True)
    both = assembles_rims(*rims, [*on_first, Wheel(ring2, "rim2", internal=True)], n)
    with_sun = assembles_stepped(sun, rims[0], ring2, rims[1], n, internal1=False, internal2=True)
    with_ring = assembles_stepped(ring, rims[0], ring2, rims[1], n, internal1=True, internal2=True)
    simple = assembles_simple(sun, rims[0], ring, n)
    assert both == (simple and with_sun and with_ring)


@given(
    small=SUNS, large=SUNS, short=PLANETS, long=PLANETS, n=st.integers(2, 5), more=st.integers(0, 1)
)
def test_a_ravigneaux_set_needs_both_conditions(  # noqa: PLR0913, PLR0917
    small: int, large: int, short: int, long: int, n: int, more: int
) -> None:
    """Of a simple set with the large sun and of meshed planets with the small one."""
    ring = large + 2 * long + more
    assume(abs(small + short - large - long) < short + long < small + short + large + long)
    found = assembles_ravigneaux(small, large, short, long, ring, n)
    assert found == ((large + ring) % n == 0 and (ring - small) % n == 0)


@given(sun=SUNS, inner=PLANETS, outer=PLANETS, n=COUNTS, angle=st.fractions(0, 1))
def test_the_angle_in_a_pair_does_not_matter(
    sun: int, inner: int, outer: int, n: int, angle: Fraction
) -> None:
    """It shifts the wheels against one another, once for all sets."""
    ring = sun + 2 * max(inner, outer) + 3
    assume(ring <= sun + 2 * inner + 2 * outer)
    bent = Group(
        {"inner": {"inner": inner}, "outer": {"outer": outer}},
        {"inner": Fraction(0), "outer": angle},
        [Wheel(sun, "inner", internal=False), Wheel(ring, "outer", internal=True)],
        [Contact("inner", "outer", 2 * angle)],
    )
    assert assembles(bent, n) == assembles_double(sun, inner, outer, ring, n)


def test_the_triangle_of_centres() -> None:
    """Equal sides; and 3, 4, 5, where the line from the first planet to the second is square."""
    assert [*map(float, triangle(1, 1, 1))] == pytest.approx([1 / 6, 1 / 3])
    assert [*map(float, triangle(3, 5, 4))] == pytest.approx([math.atan2(4, 3) / math.tau, 1 / 4])
    with pytest.raises(ValueError, match="cannot touch"):
        triangle(1, 5, 1)


def umdm(z1: int = 36, z4: int = 34, z7: int = 84) -> Group:
    """The multi-flow mechanism of Voloshko and Salakhov with invented teeth.

    Planets A = (2, 2') and B = (3, 3') stand at 27 modules from the axis, 25.5 apart.
    """
    place, line = triangle(27, 27, 25.5)
    return Group(
        {"A": {"2": 18, "2'": 21}, "B": {"3": 30, "3'": 20}},
        {"A": Fraction(0), "B": place},
        [
            Wheel(z1, "2", internal=False),
            Wheel(72, "2", internal=True),
            Wheel(z7, "3", internal=True),
            Wheel(z4, "3'", internal=False),
            Wheel(74, "3'", internal=True),
        ],
        [Contact("2'", "3", line)],
    )


def test_three_pairs_go_into_the_multi_flow_mechanism_and_with_one_tooth_more_they_do_not() -> None:
    """The angle in the pair is that of two radii of 27 and a distance of 25.5: 56.357 degrees."""
    assert float(360 * umdm().places["B"]) == pytest.approx(56.357, abs=5e-4)
    assert assembles(umdm(), 3)
    for more in (umdm(z1=37), umdm(z7=85), umdm(z4=35)):
        assert not assembles(more, 3)
