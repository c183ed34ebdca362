"""Mechanisms that are idle by coincidence, whose direction of power matters."""

from dataclasses import replace

from tests.core.statics.differential import texts
from tests.oracle.cases import NASTY
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.statics.idle_by_coincidence import coincidences, idle_with_torque

AXLE = Transmission(3, [], [Mechanism(2, 3, 1, -1.0, 0.98, 0.5)], [Gear(speeds={2: 1.0})])


def test_a_mechanism_idle_by_coincidence_is_told() -> None:
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
    # the axle has 1 in all whatever x is, so its efficiency does not depend on it
    results = solve(AXLE)
    assert coincidences(results, 0, AXLE.gears[0], *idle_with_torque(results)) == {"D1": False}
