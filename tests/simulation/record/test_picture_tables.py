"""Tables of pictures of a run: what sticks, capacities, heat and losses, torque of the output.

Against the energies of its account, the torques of its columns, statics and the scenarios' numbers.
"""

import numpy as np
import pytest

from tests.chance import with_slow
from tests.commands import CASES
from tests.simulation.test_closed_forms import links, run
from tests.simulation.test_friction import FALLING, PRESSURE
from tests.simulation.test_roads import CASE, ROAD
from vstatics import ShiftElement, load_scenario
from vstatics.simulation import Motion, Road, Scenario, Start, simulate

QUICK = ("8l90-shifts", "gf4a-upshifts", "moskvich-start", "tarasik-box", "tarasik-set-lock")
SLOW = ("8hp70-downshift", "8hp70-shifts", "tarasik-truck")
NAMES = with_slow(QUICK, SLOW)


def motion_of(name: str) -> Motion:
    return simulate(load_scenario(CASES / "scenarios" / f"{name}.yaml"))


@pytest.fixture(params=NAMES)
def motion(request: pytest.FixtureRequest) -> Motion:
    return motion_of(request.param)


def test_what_sticks_has_no_slip_and_what_slips_carries_its_capacity(motion: Motion) -> None:
    small = 1e-6 * np.abs(motion.speeds).max()
    for place, name in enumerate(motion.elements):
        slip, torque = (np.abs(table[:, place]) for table in (motion.slips, motion.torques))
        sticks = motion.beside["sticks"][name] > 0
        assert slip[sticks].max(initial=0.0) <= small, name
        slides = ~sticks & (slip > small) & (torque > 0)
        assert torque[slides] == pytest.approx(motion.beside["capacities"][name][slides])


def test_capacities_are_those_of_the_controls() -> None:
    """Of tarasik-box.yaml at 6 s, bare numbers of its controls."""
    ends = {name: one[-1] for name, one in motion_of("tarasik-box").beside["capacities"].items()}
    assert ends == {"FH": 3000, "FB": 0, "F1": 0, "F2": 6000, "F3": 0, "FR": 0}


def test_the_capacity_of_a_pack_follows_its_slip() -> None:
    """8 surfaces of 0.006 m^2 on 0.1 m at 1e4 Pa, with mu = 0.1 - slip/200 up to 10 rad/s."""
    case = links(1.0, 1.0, elements=(ShiftElement(1, 2, "C", friction=FALLING),))
    motion = run(case, 0.1, {1: 9.0, 2: 0.0}, controls=PRESSURE)
    expected = 8 * 0.006 * 0.1 * 1e4 * (0.1 - motion.slips[:, 0] / 200)
    assert motion.beside["capacities"]["C"] == pytest.approx(expected)


def test_a_clutch_holds_more_than_it_carries_when_it_slips() -> None:
    """Moskvich: 0.8*182*(1 - exp(-60 t)) N*m while it slips, 1/0.8 of it once it sticks."""
    motion = motion_of("moskvich-start")
    found, sticks = motion.beside["capacities"]["clutch"], motion.beside["sticks"]["clutch"] > 0
    kinetic = 0.8 * 182 * (1 - np.exp(-60 * motion.time))
    assert found[~sticks] == pytest.approx(kinetic[~sticks])
    assert found[sticks] == pytest.approx(kinetic[sticks] / 0.8)


@pytest.mark.parametrize(
    ("name", "by"),
    [
        ("tarasik-set-lock", {"set": 2.5}), ("tarasik-box", {"set 2": 4.0, "set 3": 3.04}),
        ("moskvich-start", {"tyres": 1.0}),
    ],
)  # fmt: skip
def test_the_output_gets_what_its_sets_or_springs_give(name: str, by: dict[str, float]) -> None:
    """A carrier takes 1 - u of the torque on the sun, u = -1.5, -3, -2.04."""
    motion = motion_of(name)
    given = {name: motion.torques[:, motion.devices.index(name)] for name in by}
    expected = sum(part * given[name] for name, part in by.items())
    assert motion.beside["output_torque"][""] == pytest.approx(expected, abs=1e-9)


def test_a_vehicle_is_as_fast_as_its_acceleration_makes_it() -> None:
    """Integrated by trapezes over the instants of the run."""
    motion = motion_of("8l90-shifts")
    scenario = load_scenario(CASES / "scenarios" / "8l90-shifts.yaml")
    [(link, law)] = [(link, law) for link, law in scenario.torques if isinstance(law, Road)]
    gained = np.trapezoid(motion.beside["vehicle_acceleration"]["output"], motion.time)
    speed = motion.speeds[:, link - 1] * law.radius
    assert gained == pytest.approx(speed[-1] - speed[0], rel=1e-3)


def test_the_vehicle_of_a_wheel_that_gives_way_is_as_asked_columns_tell() -> None:
    """Table 1.1 of Tarasik: its velocity is not the speed of the wheel times a radius."""
    scenario = Scenario(CASE, 20.0, Start(speeds={1: 60.0}), {}, torques=((1, ROAD),))
    motion = simulate(scenario, columns=[("vehicle_acceleration", "wheels")])
    asked = motion.asked["vehicle_acceleration"]["wheels"]
    assert asked.min() < -0.2
    assert motion.beside["vehicle_acceleration"]["wheels"] == pytest.approx(asked)
