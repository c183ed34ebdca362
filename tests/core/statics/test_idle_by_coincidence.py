"""Mechanisms that are idle by coincidence, whose direction of power matters."""

from dataclasses import replace

from tests.core.statics.differential import texts, train
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


def test_nothing_is_said_of_a_set_that_statics_holds_together() -> None:
    """Clutched as one piece: the split of torque depends on its direction, the ports do not."""
    results = solve(train([(1, 2)], Gear([1])))
    assert coincidences(results, 0, results.case.gears[0], *idle_with_torque(results)) == {}


def test_it_is_told_whether_the_efficiency_depends_on_it() -> None:
    """An axle whose wheels turn alike: eta**x/(1 + eta**x) each, and 1 in all whatever x."""
    results = solve(AXLE)
    assert coincidences(results, 0, AXLE.gears[0], *idle_with_torque(results)) == {"D1": False}
