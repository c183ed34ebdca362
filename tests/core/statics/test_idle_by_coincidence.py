"""Mechanisms that are idle by coincidence, whose direction of power matters."""

from dataclasses import replace

from tests.core.statics.differential import texts
from tests.oracle.cases import NASTY
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.readers import loads
from vstatics.core.statics.idle_by_coincidence import coincidences, idle_with_torque

AXLE = Transmission(3, [], [Mechanism(2, 3, 1, -1.0, 0.98, 0.5)], [Gear(speeds={2: 1.0})])


def test_a_mechanism_idle_by_coincidence_is_reported() -> None:
    """It moves as one piece for these speeds or torques only, so a port depends on its sign.

    First: a shaft of efficiency e beside a set; with u' = u eta**x equilibrium gives a torque
    1/(u' (1 - e) - 1) on the first link. Second: an axle whose wheels turn alike, of which
    the one left open takes eta**x/(1 + eta**x): a differential straight ahead, which is a note.
    """
    shaft = texts(solve(NASTY["idle by coincidence, efficiency depends on it"]))
    assert any(one.startswith("warning: D2 happens to transmit no power; torques") for one in shaft)
    [text] = texts(solve(AXLE))
    assert text.startswith("note: D1 happens to transmit no power; torques w")
    assert texts(solve(replace(AXLE, gears=[Gear(speeds={2: 1.1})]))) == []
    # the torques of the axle add up to 1 for every x, so its efficiency does not depend on x
    results = solve(AXLE)
    assert coincidences(results, 0, AXLE.gears[0], *idle_with_torque(results)) == {"D1": False}


def test_meshes_of_a_set_that_turns_as_a_block_are_reported() -> None:
    """A ratio of 1 and S1 give both suns the same speed, so no mesh moves; the ring has no torque."""
    results = solve(loads(BLOCK))
    [text] = [one for one in texts(results) if "no power" in one]
    meshes = ("small_sun-short", "large_sun-long", "short-long")
    assert all(f"E2.{mesh}" in text for mesh in meshes)


BLOCK = """links: [L1, L2, L3, L4, L5, L6]
input: L1
output: L4
elements:
  E1: {kind: stepped, carrier: L1, ring: housing, ring2: L2,
       teeth: {ring: 99, ring2: 88, planet: 24, planet2: 18}}
  E2: {kind: ravigneaux, carrier: L2, small_sun: L3, large_sun: L4, ring: L5,
       teeth: {small_sun: 22, large_sun: 32, ring: 74, short: 22, long: 21}}
mechanisms:
  E3: {first: L4, second: L6, third: L1, ratio: 1.0, efficiency: 0.935}
shift_elements: {S1: [L6, L3]}
gears: {"1": {engaged: [S1]}}
"""
