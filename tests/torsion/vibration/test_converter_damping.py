"""A torque converter about its working point: damped and forced vibration with it.

Numbers: closed forms, differences of (1.38) of Tsitovich, Algin, Vehicle dynamics (1981), a first
order form that is made by hand here, tables 2.9 and 2.10 of the book.
"""

import math
from itertools import pairwise
from random import Random

import numpy as np
import pytest

from tests.chance import count, examples, seeded
from tests.torsion.systems import Array, chain, eigenvalues, matrices
from tests.torsion.vibration.test_gear_modes import omegas, only
from vstatics import CaseError, Damping, Gear, Load, Mechanism, ShiftElement, Spring, Transmission
from vstatics.core.model.converters import Converter
from vstatics.torsion import Harmonic, modes, response
from vstatics.torsion.system.converters import WorkingConverter

POINTS = ((0.0, 2.5, 0.003), (0.5, 1.5, 0.0032), (0.9, 1.0, 0.0015), (1.0, 1.0, 0.0))
RPM = math.pi / 30
AT_200 = Load(speed=200 / RPM, torque=94.0)


def two_masses(**others: object) -> Transmission:
    """A pump of 0.4 and a turbine of 0.2 kg*m^2."""
    case = Transmission(
        2, [], [], [Gear()], inertias={1: 0.4, 2: 0.2}, load=AT_200,
        converters=[Converter("TC", 1, 2, POINTS)],
    )  # fmt: skip
    return case.replace(**others)


def matrix_of(links: int, one: WorkingConverter) -> Array:
    """What a converter adds to D: +A1, +A2 in the row of the pump, -A3, -A4 in the turbine's."""
    made = np.zeros((links, links))
    made[one.pump, [one.pump, one.turbine]] = one.A1, one.A2
    made[one.turbine, [one.pump, one.turbine]] = -one.A3, -one.A4
    return made


def torques_of(pump: float, turbine: float, points: Array) -> Array:
    """(1.38): M_P = lambda w_P |w_P|, M_T = K M_P."""
    ratio = turbine / pump
    taken = np.interp(ratio, points[:, 0], points[:, 2]) * pump * abs(pump)
    return np.array([taken, np.interp(ratio, points[:, 0], points[:, 1]) * taken])


def test_two_masses_by_their_load() -> None:
    """-[[A1/J_P, A2/J_P], [-A3/J_T, -A4/J_T]] has the eigenvalues -.600976, -11.486524."""
    gear = only(two_masses())
    assert gear.rigid_modes == 2
    assert not gear.modes
    assert gear.damped == pytest.approx([-0.6009759773, -11.4865240227], rel=1e-9)
    assert gear.converters
    found = gear.converters["TC"]
    assert found[3:] == pytest.approx((0.7, 200, 94, 117.5, 1.535, -0.85, 2.33, -1.65), rel=1e-12)


def test_a_fluid_coupling_leaves_out_the_zero_of_both_turning() -> None:
    """With K = 1 the torques are opposite: of two eigenvalues one is 0, one -(A1/J_P - A4/J_T)."""
    coupling = [Converter("TC", 1, 2, ((0.0, 1.0, 0.003), (1.0, 1.0, 0.0)))]
    gear = only(two_masses(converters=coupling, gears=[Gear(speed_ratios={1: 0.9})]))
    assert gear.converters
    one = gear.converters["TC"]
    assert pytest.approx((one.A3, one.A4)) == (one.A1, one.A2)
    assert gear.damped == pytest.approx([-(one.A1 / 0.4 - one.A4 / 0.2)])


@pytest.mark.parametrize("reverse", [1, -1])
@examples(6, 20, 400)
def test_slopes_are_differences_of_the_torques(reverse: int, examples: int) -> None:
    """Within a piece, of random points, turning either way; (i A2 + A1) w = 2 M_P, by Euler."""
    random = seeded(38)
    for _ in range(examples):
        ratios = sorted(random.uniform(-0.3, 1.2) for _ in range(5))
        rows = [(i, random.uniform(0, 3), random.uniform(0.001, 0.01)) for i in ratios]
        ratio, pump = random.uniform(-0.4, 1.3), reverse * random.uniform(20, 300)
        converter = Converter("TC", 1, 2, tuple(rows))
        case = two_masses(converters=[converter], load=Load(speed=pump / RPM))
        [gear] = modes(case, speed_ratios={"TC": ratio})
        assert gear.converters
        one, points, turbine = gear.converters["TC"], np.array(rows), ratio * pump
        near = 1e-6 * pump
        if min(abs(ratio - i) for i in ratios) < 1e-5:
            continue
        by_pump, by_turbine = (
            (torques_of(pump + a, turbine + b, points) - torques_of(pump - a, turbine - b, points))
            / (2 * near)
            for a, b in ((near, 0.0), (0.0, near))
        )
        found = [one.A1, one.A3, one.A2, one.A4]
        assert found == pytest.approx([*by_pump, *by_turbine], rel=1e-6, abs=1e-6)
        assert (ratio * one.A2 + one.A1) * pump == pytest.approx(2 * one.pump_torque)
        assert (ratio * one.A4 + one.A3) * pump == pytest.approx(2 * one.turbine_torque)


def with_converter(random: Random) -> Transmission:
    sizes = random.randint(2, 3), random.randint(2, 3)
    links = sum(sizes)
    joints = [n for n in range(1, links) if n != sizes[0]]
    springs = []
    for n in joints:
        rate, damping = 10 ** random.uniform(1, 4), random.choice([0.0, random.uniform(0.1, 3)])
        springs.append(Spring({n: 1, n + 1: -1}, rate, damping=damping, name=f"c{n}"))
    inertias = {n: 10 ** random.uniform(-2, 0.5) for n in range(1, links + 1)}
    ends = random.randint(1, sizes[0]), random.randint(sizes[0] + 1, links)
    converter = Converter("TC", *ends, POINTS)
    return Transmission(
        links, [], [], [Gear(speed_ratios={1: random.uniform(0, 1)})], inertias=inertias,
        springs=springs, converters=[converter], load=Load(speed=random.uniform(500, 4000)),
    )  # fmt: skip


@examples(8, 25, 1000)
def test_random_systems_have_the_eigenvalues_of_a_first_order_form(examples: int) -> None:
    """It has 2 zeros of angles that nothing holds."""
    random = seeded(29)
    for _ in range(examples):
        case = with_converter(random)
        gear = only(case)
        assert gear.converters
        mass, stiffness, resistance = matrices(case)
        resistance = resistance + matrix_of(case.links, gear.converters["TC"])
        values = eigenvalues(mass, stiffness, resistance)
        values = values[np.abs(values) > 1e-4]  # what is left are zeros: of angles, of all turning
        expected = sorted(values, key=lambda s: (round(abs(s), 6), s.imag))
        found = sorted(gear.damped, key=lambda s: (round(abs(s), 6), s.imag))
        assert len(found) == len(expected)
        assert np.abs(np.array(found) - expected).max() < 1e-6 * np.abs(values).max()


def test_random_systems_respond_as_a_dynamic_stiffness_does() -> None:
    """(K + i w D - w^2 M) q = 1 on one link, with the D of the converter; its torque, too."""
    random = seeded(30)
    for _ in range(count(10, 300)):
        case = with_converter(random)
        at, speed = random.randint(1, case.links), random.uniform(100, 6000)
        [gear] = response(case, at, [Harmonic(2.0)], [speed])
        assert gear.converters
        one, w = gear.converters["TC"], 2 * speed * RPM
        mass, stiffness, resistance = matrices(case)
        dynamic = stiffness + 1j * w * (resistance + matrix_of(case.links, one)) - w**2 * mass
        expected = np.linalg.solve(dynamic, np.eye(case.links)[at - 1])
        found = np.array([gear.orders[0].amplitudes[str(n)][0] for n in range(1, case.links + 1)])
        assert found == pytest.approx(expected, rel=1e-7, abs=1e-12)
        pump = 1j * w * (one.A1 * expected[one.pump] + one.A2 * expected[one.turbine])
        assert gear.orders[0].torques["TC"][0] == pytest.approx(pump, rel=1e-7)


def test_loss_factors_beside_a_converter() -> None:
    """Viscous damping that is equal at the one natural frequency; the rigid motion has none."""
    shaft = {"stiffness": 3e3, "name": "shaft"}
    made = []
    omega = math.sqrt(3e3 * (1 / 0.2 + 1 / 0.5))
    for damping in (Damping(loss_factor=0.1), Damping(viscous=0.1 * 3e3 / omega)):
        case = Transmission(
            3, [], [], [Gear()], inertias={1: 0.4, 2: 0.2, 3: 0.5}, load=AT_200,
            springs=[Spring({2: 1, 3: -1}, damping=damping, **shaft)],  # type: ignore[arg-type]
            converters=[Converter("TC", 1, 2, POINTS)],
        )  # fmt: skip
        made.append(only(case))
    lossy, viscous = made
    assert lossy.modes[0].damping_ratio == pytest.approx(viscous.modes[0].damping_ratio, rel=1e-9)
    swings = [one for one in lossy.damped if one.imag]
    assert swings == pytest.approx([one for one in viscous.damped if one.imag])
    slow = [[one.real for one in gear.damped if not one.imag] for gear in made]
    assert slow[0] == pytest.approx(slow[1], rel=1e-3)
    assert len(slow[0]) == 2


def test_a_mechanism_of_its_kind_is_the_same_converter() -> None:
    mechanism = Mechanism(1, 2, 0, 0.7, name="TC", kind="converter", points=POINTS)
    case = Transmission(2, [], [mechanism], [Gear()], inertias={1: 0.4, 2: 0.2}, load=AT_200)
    assert only(case).damped == only(two_masses(gears=[Gear(speed_ratios={1: 0.7})])).damped


def test_locked_up_a_converter_takes_no_part() -> None:
    locked = two_masses(shift_elements=[ShiftElement(1, 2, name="F")], gears=[Gear([1])], load=None)
    gear = only(locked)
    assert (gear.rigid_modes, gear.damped, gear.converters) == (1, [], {})


def test_without_a_working_point_there_is_an_error() -> None:
    """A torque of 0 has one: at i = 1 alone, and no piece is above it."""
    for load, why in (
        *((load, "give `speed_ratios` in the gear") for load in (None, Load(torque=94))),
        (Load(speed=1900), "a `load` with speed and torque would"),
        *((Load(1900, torque), "at no speed ratio up to 1 it takes") for torque in (-94, 1e4)),
    ):
        with pytest.raises(CaseError, match=why):
            only(two_masses(load=load))
    working = (only(two_masses(load=Load(speed=1900, torque=0))).converters or {})["TC"]
    assert (working.speed_ratio, working.pump_torque) == (1, 0)
    with pytest.raises(CaseError, match="the speed of the pump of TC is unknown"):
        modes(two_masses(load=None), speed_ratios={"TC": 0.6})
    with pytest.raises(ValueError, match="no converter 'TK'; converters are TC"):
        modes(two_masses(), speed_ratios={"TK": 0.6})


ALLISON_II = (
    [0.642, 0.087, 0.073, 0.105, 0.00477, 0.0945, 6.83, 0.0426],
    [2.17, 2.05, 53, 693, 111, 113],
)
"""J'1, J''1, J2 ... J6, casing [kg*m^2]; E [1e-5 rad/(N*m)]; table 2.9."""


def allison() -> Transmission:
    """Second gear: the shaft of the axle twists against its casing."""
    inertias, compliances = ALLISON_II
    twists = [{n: 1, n + 1: -1} for n in range(2, 7)] + [{8: 1}]
    twists[3] = {5: 1, 6: -1, 8: -1}
    springs = [
        Spring(twist, compliance=e * 1e-5) for twist, e in zip(twists, compliances, strict=True)
    ]
    return Transmission(
        8, [ShiftElement(1, 2, name="F")], [], [Gear([1], name="locked"), Gear(name="open")],
        inertias=dict(enumerate(inertias, 1)), springs=springs, load=Load(speed=1900),
        converters=[Converter("TC", 1, 2, POINTS)], output=7,
    )  # fmt: skip


def test_allison_and_belaz_540_in_second_gear_vibrate_as_printed() -> None:
    """Table 2.10 (its labels J'1 and J'1 + J''1 are exchanged): within 1 %; BelAZ is locked up."""
    closed, opened = modes(allison(), speed_ratios={"TC": 0.7})
    assert omegas(closed) == pytest.approx([11.4, 104, 156, 466, 671, 1267], rel=0.01)
    assert omegas(opened) == pytest.approx([20, 104, 156, 632, 734, 1342], rel=0.01)
    assert (closed.rigid_modes, opened.rigid_modes) == (1, 2)
    compliances = [0.291, 0.244, 0.467, 18.1, 3.1]
    inertias = [3.64 + 0.334, 2.006, 0.0997, 0.195, 1.45, 49.5]
    case = chain(inertias, [1e5 / e for e in compliances])
    assert omegas(only(case)) == pytest.approx([28.4, 163, 476, 898, 2608], rel=0.01)


def test_links_without_inertia_beside_a_converter_follow_by_their_rates() -> None:
    """As the limit of a small inertia: pump without one, on a spring to the engine."""
    found = []
    for inertia in (0.0, 1e-8):
        case = Transmission(
            3, [], [], [Gear(speed_ratios={1: 0.7})], inertias={1: 0.4, 2: inertia, 3: 0.2},
            springs=[Spring({1: 1, 2: -1}, stiffness=500.0)], load=AT_200,
            converters=[Converter("TC", 2, 3, POINTS)],
        )  # fmt: skip
        found.append([one for one in only(case).damped if abs(one) < 1e5])
    assert found[0] == pytest.approx(found[1], rel=1e-4)
    assert all(abs(one) <= abs(other) for one, other in pairwise(found[0]))
