"""The published method: what its equations give, calculated apart from this program.

The numbers beside those of `test_golden` are of the same scenarios; they differ, since (12) lacks
terms, and its energy does not close.
"""

import math

import numpy as np
import pytest

from tests.simulation.boxes import (
    box,
    capacity,
    first_gear,
    held,
    planetary_set,
    points,
    run_of_box,
    second_gear,
)
from tests.simulation.test_golden import happened
from vstatics import CaseError, Mechanism, Spring, Transmission
from vstatics.core.model.converters import Converter
from vstatics.core.model.springs import between
from vstatics.simulation import Dog, Formula, Resistance, Scenario, Shift, Start, constant, simulate
from vstatics.simulation.published.tarasik import tarasik
from vstatics.simulation.published.two_masses import TwoMasses, two_masses
from vstatics.simulation.scenario.parts import ControlState, SequenceStep, StepSequence
from vstatics.simulation.scenario.programme import programmes
from vstatics.simulation.system.devices import motion_system


def test_brake_stops_the_ring() -> None:
    motion = simulate(first_gear(), method="tarasik")
    [(element, event, time)] = happened(motion)
    assert (element, event) == ("F1", "locks")
    assert time == pytest.approx(0.103815, abs=6e-7)
    at_lock = motion.speeds[np.searchsorted(motion.time, time)]
    assert at_lock[:2] == pytest.approx([45.419057, 18.167623], abs=6e-7)
    assert motion.energy.heat["F1"] == pytest.approx(219.843, abs=6e-4)
    assert motion.energy.balance == pytest.approx(391.906, abs=6e-4)
    assert "391.906 J" in motion.messages[0].text
    energy = tarasik(first_gear(duration=0.1038149)).energy
    assert energy.work == pytest.approx(147.643, abs=6e-4)
    assert energy.kinetic == pytest.approx(-464.106, abs=6e-4)
    # locked, it has the same acceleration as the event run
    rate = (motion.speeds[-1, 0] - at_lock[0]) / (1 - time)
    assert rate == pytest.approx(25.477707, abs=6e-7)
    # and passes on what its input leaves, of which the brake takes u - 1
    assert motion.torques[-1, 0] == pytest.approx(-1.5 * (40 - 0.5 * rate), rel=1e-7)


@pytest.mark.parametrize("law", ["-60 - 20*angle", "-60 - 20*speed"])
def test_loads_over_time_angle_and_speed_in_first_gear(law: str) -> None:
    """(12) with L = P = 1, u = 2.5, J = J_in + J_out/u^2 = 0.628: J w' = M_in - M_out/u.

    M_in = 40 + 30 t. With k = 20/u^2 a load by angle swings about its level, one by speed
    approaches it: both in closed form.
    """
    loads = ((1, points((0, 40), (0.7, 61), (1, 70))), (2, Formula(law)))
    case = planetary_set()
    motion = tarasik(Scenario(case, 1.0, Start("1", 50.0), {1: held(900)}, loads), step=0.1)
    assert happened(motion) == []
    inertia, k, t = 0.5 + 0.8 / 2.5**2, 20 / 2.5**2, motion.time
    if "angle" in law:
        omega = math.sqrt(k / inertia)
        level = (40 - 60 / 2.5) / k
        expected = 30 / k + level * omega * np.sin(omega * t) + (50 - 30 / k) * np.cos(omega * t)
    else:
        level = (40 - 60 / 2.5 - inertia * 30 / k) / k
        expected = level + 30 / k * t + (50 - level) * np.exp(-k / inertia * t)
    np.testing.assert_allclose(motion.speeds[:, 0], expected, rtol=1e-8)
    np.testing.assert_allclose(motion.speeds[:, 1], expected / 2.5, rtol=1e-8)


def test_lock_up() -> None:
    motion = tarasik(second_gear())
    assert motion.events[0].time == pytest.approx(0.122889680, abs=6e-10)
    assert motion.energy.heat["F2"] == pytest.approx(2647.488, abs=6e-4)
    assert motion.energy.balance == pytest.approx(-4593.4, abs=0.06)


def test_losses_break_the_lock() -> None:
    """From (12): 24.295752, and 23.566879 for u dw_out/dt; consistent would be 24.143556."""
    loads = ((1, constant(40)), (2, constant(-60)))
    motion = tarasik(Scenario(planetary_set(0.95), 1e-4, Start("1", 50.0), torques=loads))
    rates = (motion.speeds[-1] - motion.speeds[0]) / 1e-4
    assert rates[0] == pytest.approx(24.295752, abs=6e-7)
    assert 2.5 * rates[1] == pytest.approx(23.566879, abs=6e-7)


def test_lock_of_the_box() -> None:
    """The less inertia the output has, the more (12) is wrong: 4, 16, 29 %."""
    expected = {41.2: (0.282344, 0.293875), 4.0: (0.115581, 0.137580), 1.2: (0.079945, 0.111913)}
    for output, (published, exact) in expected.items():
        case = box().replace(inertias={**box().inertias, 7: output})
        scenario = run_of_box(duration=0.5)._replace(case=case)
        assert tarasik(scenario).events[0].time == pytest.approx(published, abs=6e-7)
        assert simulate(scenario).events[0].time == pytest.approx(exact, abs=6e-7)


def test_shift_at_once() -> None:
    controls = {1: capacity((0, 300), (0.5, 300), (0.5, 0)), 2: capacity((0.5, 0), (0.5, 300))}
    loads = ((1, constant(40)), (2, constant(-60)))
    motion = tarasik(Scenario(planetary_set(), 1.5, Start("1", 50.0), controls, loads))
    assert [one[:2] for one in happened(motion)] == [("F1", "slips"), ("F2", "locks")]
    assert motion.stopped is None
    assert motion.speeds[-1] == pytest.approx([motion.speeds[-1, 0]] * 3)
    assert np.isnan(motion.torques[:, -1]).all()


def test_what_does_not_hold_slips_again() -> None:
    """(15): at 0.2 s the brake has less than it must pass."""
    controls = {1: capacity((0, 120), (0.2, 120), (0.2, 20))}
    motion = tarasik(first_gear()._replace(controls=controls))
    assert [one[:2] for one in happened(motion)] == [("F1", "locks"), ("F1", "slips")]


@pytest.mark.parametrize("sign", [1, -1])
def test_it_slips_the_way_that_its_torque_drives_it(sign: int) -> None:
    """(12) with L = 0, u = 2.5, M_f = 20/1.5 at the input, J_in = 0.5 as the ring is at rest."""
    controls = {1: capacity((0, 120), (0.2, 120), (0.2, 20))}
    loads = ((1, constant(sign * 40)), (2, constant(-sign * 60)))
    motion = tarasik(Scenario(planetary_set(), 0.2001, Start("1", 50.0), controls, loads))
    locked = 0.2 * (40 - 60 / 2.5) / (0.5 + 0.8 / 2.5**2)
    slips = (40 - 20 / 1.5) / 0.5, (20 / 1.5 * 2.5 - 60) / 0.8
    began = np.array([50 + sign * locked, (50 + sign * locked) / 2.5])
    slipped = [sign * 1e-4 * rate for rate in slips]
    assert motion.speeds[-1, :2] - began == pytest.approx(slipped, rel=1e-4)


def test_two_clutches_stop_it() -> None:
    motion = tarasik(run_of_box())
    assert motion.stopped is not None
    assert "FB slips, and with FH and F1 held the box has 1 degree" in motion.stopped.message
    assert motion.time[-1] == pytest.approx(1.9)
    both = {1: held(50), 2: held(50)}
    motion = tarasik(first_gear()._replace(controls=both))
    assert motion.stopped is not None
    assert "F1 and F2 slip at once" in motion.stopped.message


def test_what_it_does_not_know() -> None:
    case = planetary_set().replace(springs=[Spring(between(2), 100.0)])
    converter = Converter("TC", 1, 2, ((0.0, 2.0, 1e-3), (1.0, 1.0, 0.0)))
    base = first_gear()
    step = SequenceStep(wait=0.1, shift=Shift(0.0, base.case.gears[0].name))
    for scenario, path in (
        (first_gear(case), ("case", "springs", 1)),
        (base._replace(converters=(converter,)), ("converters", "TC")),
        (base._replace(controls={1: Dog(((0.1, True),))}), ("controls", "F1")),
        (base._replace(states=(ControlState("x", constant(1.0)),)), ("states",)),
        (base._replace(sequences=(StepSequence("s", (step,)),)), ("sequences",)),
        (base._replace(speeds={2: constant(10.0)}), ("speeds",)),
        (base._replace(torques=((2, Resistance(5.0)),)), ("torques", "h")),
        (base._replace(torques=((3, points((0, 5))),)), ("torques", "b")),
    ):
        with pytest.raises(CaseError) as error:
            tarasik(scenario)
        assert error.value.problems[0].path == path


J_IN = {
    1: {0: 0.811111, 1: 0.723162, 2: 0.647049, 3: 0.584538, 4: 0.537639, 5: 0.508642},
    2: {0: 0.5, 5: 0.513317, 10: 0.557143, 15: 0.638272, 20: 0.765089, 25: 0.948, 30: 1.2},
}
"""Of figure 2, calculated apart: gear -> time [s] -> [kg*m^2]."""


def test_inertia_at_the_input() -> None:
    """Gear 1: 500 - 10t and 30t rpm; gear 2: 1500 - 10t and 600 + 20t rpm."""
    for gear, time, inertia in [(g, t, j) for g, row in J_IN.items() for t, j in row.items()]:
        masses = masses_of_set()
        fast, slow = (500, 0) if gear == 1 else (1500, 600)
        speeds = (fast - 10 * time, slow + (30 if gear == 1 else 20) * time)
        assert masses.input_inertia(*speeds) == pytest.approx(inertia, abs=6e-7)


def test_points_a_and_c() -> None:
    """A: the ring stands at 500/85 s, J_in is that of the sun; C: all turn alike."""
    masses, time = masses_of_set(), 500 / 85
    assert time == pytest.approx(5.882353, abs=6e-7)
    speeds = (500 - 10 * time, 30 * time)
    assert speeds == pytest.approx((441.1765, 176.4706), abs=6e-5)
    assert (masses.speeds @ speeds)[2] == pytest.approx(0, abs=1e-9)
    assert masses.input_inertia(*speeds) == pytest.approx(0.5, abs=1e-12)
    assert masses.ratio == pytest.approx(2.5)
    assert masses.output_inertia == pytest.approx(0.8)
    pair = Mechanism(4, 2, 0, 2.0)  # on a shaft that turns twice as fast, four times the inertia
    a_set = planetary_set()
    names, inertias = [*a_set.link_names, "c"], {**a_set.inertias, 4: 0.1}
    case = a_set.replace(
        links=4, link_names=names, mechanisms=[*a_set.mechanisms, pair], inertias=inertias
    )
    assert masses_of_set(case).output_inertia == pytest.approx(0.8 + 4 * 0.1)


def masses_of_set(case: Transmission | None = None) -> TwoMasses:
    scenario = first_gear(case)
    system = motion_system(scenario, programmes(scenario, ()), None)
    return two_masses(system, (0, 1), (), 0)
