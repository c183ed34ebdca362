"""Springs before and behind a converter whose speed ratio is given: the pump sets their torques.

The torques, the slopes and the natural frequencies are calculated here by hand: the torque of the
pump by (1.38) of Tsitovich, Algin, Vehicle dynamics (1981), pairs by their powers, numpy's
eigenvalues.
"""

import math
from collections.abc import Sequence
from random import Random
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import examples, seeded
from tests.torsion.systems import Array
from vstatics import Gear, Load, Mechanism, Spring, Transmission, loads, solve
from vstatics.core.model.converters import Converter
from vstatics.core.model.parts import OfLoad
from vstatics.torsion import Harmonic, White, modes, random_vibration, response
from vstatics.torsion.system.working_points import working_gear
from vstatics.torsion.vibration.varied_frequencies import frequencies

RPM = math.pi / 30


class Train(NamedTuple):
    """Engine 1, damper, link 2, pair to 3, shaft, pump 4, turbine 5, pair to 6, shaft, link 7.

    Link 8 is a pump of oil on a linear spring at link 2: it branches off and carries nothing.
    """

    case: Transmission
    torque: float
    """Torque of the input. [N*m]"""
    slopes: list[float]
    """Slopes of damper and shafts. [N*m/rad]"""
    inertias: list[float]


def slope_at(points: Sequence[tuple[float, float]], torque: float) -> float:
    """The slope of the piece with a torque; the last pieces go on."""
    torques = [point[1] for point in points]
    place = min(max(int(np.searchsorted(torques, torque)), 1), len(points) - 1)
    (x0, y0), (x1, y1) = points[place - 1 : place + 1]
    return (y1 - y0) / (x1 - x0)


def bent(random: Random) -> list[tuple[float, float]]:
    """Points of a spring: through 0, and steeper or flatter beyond torques of either sign."""
    lower = [-random.uniform(50, 900), -random.uniform(1, 50)]
    upper = [random.uniform(1, 50), random.uniform(50, 900)]
    twists = np.cumsum([random.uniform(0.01, 0.5) for _ in range(5)])
    torques = [*lower, 0.0, *upper]
    return [(float(x - twists[2]), y) for x, y in zip(twists, torques, strict=True)]


def train(random: Random) -> Train:
    """A random train with its numbers by hand, in which drag takes less than the converter."""
    ratio, behind = (random.choice([-1, 1]) * 10 ** random.uniform(-0.5, 0.5) for _ in range(2))
    efficiency, drag = random.uniform(0.85, 1), random.choice([0.0, random.uniform(0, 30)])
    speed, at = random.uniform(500, 5000), random.uniform(0.05, 1.15)
    points = ((0.0, 2.0, 0.008), (0.9, 1.0, 0.004), (1.0, 1.0, 0.0), (1.2, 1.0, -0.004))
    curves = [bent(random) for _ in range(3)]

    pump = speed * RPM / ratio
    factors = np.transpose(points)
    taken = float(np.interp(at, factors[0], factors[2])) * pump * abs(pump)
    given = float(np.interp(at, factors[0], factors[1])) * taken
    needed = taken + math.copysign(drag, pump)
    if needed * taken <= 0:  # both of its ends would drive, against the drag
        return train(random)
    torque = needed / ratio / efficiency if needed * pump > 0 else needed / ratio * efficiency
    brought = given * behind * (efficiency if given * pump > 0 else 1 / efficiency)
    torques = zip(curves, (torque, taken, brought), strict=True)
    slopes = [slope_at(curve, one) for curve, one in torques]

    masses = [10 ** random.uniform(-1.5, 0.5) for _ in range(8)]
    ends = ({1: 1, 2: -1}, {3: 1, 4: -1}, {6: 1, 7: -1})
    names = zip(ends, curves, ("S1", "S2", "S3"), strict=True)
    springs = [Spring(form, points=curve, name=name) for form, curve, name in names]
    case = Transmission(
        8, [], [Mechanism(2, 3, 0, ratio, efficiency), Mechanism(5, 6, 0, behind, efficiency)],
        [Gear(speed_ratios={3: at}, drag={3: OfLoad(drag, 1.0)})],
        inertias=dict(enumerate(masses, 1)), load=Load(speed=speed), output=7,
        springs=[*springs, Spring({2: 1, 8: -1}, stiffness=700.0, name="branch")],
        converters=[Converter("TC", 4, 5, points)],
    )  # fmt: skip
    return Train(case, torque, slopes, masses)


def omegas_of(one: Train) -> Array:
    """Natural frequencies, by the angles of links 1, 2, 4, 5, 7 and 8 [rad/s]."""
    ratio, behind = (mechanism.ratio for mechanism in one.case.mechanisms)
    links = np.zeros((8, 6))
    links[[0, 1, 3, 4, 6, 7], range(6)] = 1
    links[2, 1], links[5, 3] = 1 / ratio, 1 / behind
    twists = np.array([links[a] - links[b] for a, b in ((0, 1), (2, 3), (5, 6), (1, 7))])
    stiffness = twists.T @ np.diag([*one.slopes, 700.0]) @ twists
    mass = links.T @ np.diag(one.inertias) @ links
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
    return np.sqrt(squares[2:])  # two rigid motions: before the converter and behind it


@examples(1, 3, 400)
def test_the_pump_sets_the_torques_of_all_springs(examples: int) -> None:
    """With and without a load that agrees, by each way to give the speed ratio, in each answer."""
    random, coasts = seeded(46), 0
    for _ in range(examples):
        one = train(random)
        case, at = one.case, one.case.gears[0].speed_ratios[3]
        coasts += one.torque < 0
        [gear] = modes(case)
        assert [gear.slopes[f"S{n}"] for n in (1, 2, 3)] == pytest.approx(one.slopes, rel=1e-9)
        expected = omegas_of(one)
        assert [mode.omega for mode in gear.modes] == pytest.approx(expected, rel=1e-6)
        assert not gear.warnings
        agreeing = case.with_torque(one.torque)
        by_option = case.replace(gears=[case.gears[0]._replace(speed_ratios={})])
        mechanisms = [*case.mechanisms, case.converters[0].at_ratio(at)]
        inside = case.replace(converters=[], mechanisms=mechanisms)
        for other, ratios in ((agreeing, {}), (by_option, {"TC": at}), (inside, {})):
            [same] = modes(other, speed_ratios=ratios)
            assert same.slopes == pytest.approx(gear.slopes)
            assert not same.warnings
        found = frequencies(case, [], np.zeros((1, 0)), {0: range(4)}).omegas[0, 0]
        assert found == pytest.approx(expected, rel=1e-6)
        pairs = zip(case.springs, [*one.slopes, 700.0], strict=True)
        straight = [Spring(of.form, stiffness=slope, name=of.name) for of, slope in pairs]
        linear, speeds = case.replace(springs=straight), [random.uniform(100, 3000)]
        by_points, by_slopes = (
            [response(of, 1, [Harmonic(1.0)], speeds), random_vibration(of, 1, White(1.0))]
            for of in (case, linear)
        )
        assert repr(by_points) == repr(by_slopes)
    assert coasts or examples == 1


@pytest.mark.parametrize("torque", [100.0, -40.0])
def test_the_torque_on_the_pump_is_that_of_its_own_row_beside_gear_sets(torque: float) -> None:
    """It falls to 0 at i = 1 from 3.8e-3 w^2 at 0.8, and further to -2e-3 w^2 at 1.2."""
    text = f"""
    links: [engine, turbine, ring, out]
    load: {{speed: 2000 rpm, torque: {torque} N*m}}
    elements: {{P: {{kind: planetary, sun: turbine, ring: ring, carrier: out, teeth: {{sun: 30, ring: 70}}}}}}
    mechanisms: {{TC: {{kind: converter, first: engine, second: turbine,
                      points: [[0, 2, 4e-3], [0.8, 1.1, 3.8e-3], [1, 1, 0], [1.2, 0.98, -2e-3]]}}}}
    shift_elements: {{B: [ring, housing]}}
    gears: {{"1": [B]}}
    inertias: {{engine: 0.2, turbine: 0.1, out: 5}}
    """
    case = loads(text)
    expected = 1 - 0.2 * torque / (2000 * RPM) ** 2 / (3.8e-3 if torque > 0 else 2e-3)
    [gear] = modes(case)
    assert gear.converters
    assert gear.converters["TC"].speed_ratio == pytest.approx(expected, rel=1e-9)
    assert solve(case).speed_ratio[0, 0] == pytest.approx(expected, rel=1e-9)


@examples(3, 7, 400)
def test_a_load_that_contradicts_the_pump_is_reported(examples: int) -> None:
    """Above a twentieth, as in statics; the vibration is that of the pump all the same."""
    random, tries, told = seeded(47), examples, 0
    for _ in range(tries):
        one = train(random)
        factor = random.choice([0.0, -1.0, 1 / 1.2, 1 / 1.01, 1.01, 1.2, 40.0])
        given = one.torque * factor or random.choice([0.0, 5.0])
        [gear] = modes(one.case.with_torque(given))
        assert [gear.slopes[f"S{n}"] for n in (1, 2, 3)] == pytest.approx(one.slopes)
        working = working_gear(one.case.with_torque(given), one.case.gears[0], {})
        assert list(working.doubts) == list(gear.warnings)
        brought, taken = solve(working.case.with_torque(given)), solve(working.case)
        off = [float(of.lossy_torques_Nm[0, 3]) for of in (brought, taken)]
        assert bool(gear.warnings) == (abs(off[0] - off[1]) > 0.05 * max(map(abs, off)))
        for text in gear.warnings:
            assert text.startswith("the load brings ")
            assert f"this vibration is about {one.torque:.5g} N*m at the input" in text
        told += len(gear.warnings)
    assert 0.3 < told / tries < 0.9


def test_beside_a_slipping_lock_up_a_converter_damps_at_the_speed_ratio_of_the_slip() -> None:
    """The pump takes M = 3e-3 (w_P - w_T) w_P, the turbine has (2 - w_T/w_P) M; at 200 and 190 rad/s.

    The two inertias therefore decay to a common course: dM/dw_P = 0.63, dM/dw_T = -0.6, and the
    same for the turbine by the product rule.
    """
    text = """links: [engine, turbine]
load: {speed: 200 rad/s, torque: 90 N*m}
shift_elements: {LU: [engine, turbine]}
inertias: {engine: 0.2, turbine: 0.5}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2, 3e-3], [1, 1, 0]]}
gears: {slip: {slip: {LU: 10 rad/s}}}
"""
    pump, i = 3e-3 * 10 * 200, 0.95
    by_speeds = np.array([0.63, -0.6])
    matrix = np.array(
        [-by_speeds / 0.2, (by_speeds * (2 - i) + pump * np.array([i, -1]) / 200) / 0.5]
    )
    [gear] = modes(loads(text))
    expected = [root for root in np.linalg.eigvals(matrix) if abs(root) > 1e-9]
    assert sorted(gear.damped, key=abs) == pytest.approx(sorted(expected, key=abs))


def test_in_neutral_a_converter_that_a_spring_bridges_still_damps() -> None:
    """The spring sets the mean speed ratio 1 of TC, and nothing determines that of TD."""
    case = loads("""
    links: [engine, middle, turbine, wheels]
    load: {speed: 2000 rpm, torque: 80 N*m}
    mechanisms:
      TC: {kind: converter, first: engine, second: middle, points: [[0, 2, 4e-3], [1, 1, 0]]}
      TD: {kind: converter, first: middle, second: turbine, points: [[0, 2, 4e-3], [1, 1, 0]]}
    springs: {damper: {links: [engine, middle], stiffness: 500}}
    inertias: {engine: 0.2, middle: 0.1, turbine: 0.1, wheels: 9}
    shift_elements: {A: [turbine, wheels]}
    gears: {N: []}
    """)
    working = working_gear(case, case.gears[0], {})
    assert [(pump.name, pump.speed_ratio) for pump in working.converters] == [("TC", 1.0)]
