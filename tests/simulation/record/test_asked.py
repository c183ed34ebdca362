"""Columns that are asked for: closed forms, sums of energy, differences of speeds."""

import numpy as np
import pytest

from tests.chance import seeded, seeds_with_slow
from tests.simulation.control.written import TWO_WHEELS, written
from tests.simulation.runs import random_run
from vstatics import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Motion, simulate
from vstatics.simulation.record.answer import AskedAnswer
from vstatics.simulation.record.asked import TABLES
from vstatics.simulation.record.row_names import rows_of_kind

WHEEL = "inertias: {o: 2}\n"
OSCILLATOR = """links: [m, o]
inertias: {o: 2}
springs:
  soft: {links: [m, housing], stiffness: 300 N*m/rad}
  hard: {links: [o, m], stiffness: 600 N*m/rad}
"""
"""2 kg*m^2 on two springs in a row, of 200 N*m/rad together; the link between has no inertia."""
AT_REST = "start: {speeds: {o: 0}}"
OMEGA = 10.0


def asked(
    scenario: str, case: str, *columns: str, step: float | None = None
) -> tuple[Motion, list[Floats]]:
    """A motion and its columns, as in `accelerations[o]`."""
    names = [tuple(one[:-1].split("[")) for one in columns]
    motion = simulate(
        written(scenario, case), step=step, columns=[(table, row) for table, row in names]
    )
    assert motion.stopped is None
    return motion, [motion.asked[table][row] for table, row in names]


def test_a_ramp_has_a_jerk_that_ends_with_it() -> None:
    """T = 10 t on 2 kg*m^2: 5 rad/s^3 up to the instant of its end, then nothing."""
    text = f'duration: 2\n{AT_REST}\ntorques: {{o: "min(10*t, 10)"}}'
    motion, [acceleration, jerk] = asked(text, WHEEL, "accelerations[o]", "jerks[o]")
    assert acceleration == pytest.approx(np.minimum(5 * motion.time, 5.0), abs=1e-9)
    [end] = np.flatnonzero(np.diff(motion.time) == 0)
    assert motion.time[end] == pytest.approx(1.0, abs=1e-9)
    assert jerk == pytest.approx(5.0 * (np.arange(len(jerk)) <= end), abs=1e-7)


def test_a_vibration_has_rows_at_its_extremes_though_no_point_lies_there() -> None:
    """Speed cos 10 t: -10 sin 10 t, -100 cos 10 t, and of the link between two thirds of that."""
    columns = ("accelerations[o]", "jerks[o]", "accelerations[m]", "jerks[m]", "powers[hard]")
    motion, found = asked(
        "duration: 2\nstart: {speeds: {o: 1, m: 0.6666666666666666}}", OSCILLATOR, *columns
    )
    angle = OMEGA * motion.time
    bends, swings = -OMEGA * np.sin(angle), -(OMEGA**2) * np.cos(angle)
    parts = [1.0, 1.0, 2 / 3, 2 / 3]
    for column, part, exact in zip(found, parts, [bends, swings] * 2, strict=False):
        assert column == pytest.approx(part * exact, abs=1e-5 * np.abs(exact).max())
        assert column.max() == pytest.approx(part * np.abs(exact).max(), rel=1e-5)
    torque = 20 * np.sin(angle)  # 200 N*m/rad by sin(10 t)/10
    assert found[4] == pytest.approx(torque * np.cos(angle) / 3, abs=1e-6)
    between = np.linspace(0, 2, 5001)
    drawn = np.interp(between, motion.time, found[1])
    assert np.abs(drawn + 100 * np.cos(OMEGA * between)).max() < 1e-3 * 200


def test_a_clutch_turns_energy_into_heat() -> None:
    """Two wheels of 2 and 3 kg*m^2 at 100 rad/s and at rest, 60 N*m between: 1/2 J w^2."""
    text = "duration: 3\nstart: {speeds: {e: 100, o: 0}}\ncontrols: {C: 60}"
    columns = "heat[C]", "slip_power[C]", "powers[o]"
    motion, [heat, power, given] = asked(text, TWO_WHEELS, *columns)
    slip = np.maximum(100 - (60 / 2 + 60 / 3) * motion.time, 0.0)
    assert power == pytest.approx(60 * slip, abs=1e-5)
    assert heat == pytest.approx(1.2 / 2 * (100**2 - slip**2), rel=1e-8, abs=1e-6)
    assert heat[-1] == pytest.approx(motion.energy.heat["C"], rel=1e-12)
    assert not given.any()


def test_springs_have_heat_of_their_friction_and_of_limits() -> None:
    """Two wheels at given 3 rad/s on springs to the housing: 7 N*m that rub, 50 N*m that slip."""
    motion, [rubbed, slipped] = asked(
        "duration: 2\nstart: {speeds: {e: 3, o: 3}}\nspeeds: {e: 3, o: 3}\nlimits: {s: 50}",
        "inertias: {e: 2, o: 2}\nsprings:\n"
        "  r: {links: [e, housing], stiffness: 100 N*m/rad, friction: 7 N*m}\n"
        "  s: {links: [o, housing], stiffness: 100 N*m/rad}\n",
        *("heat[r]", "heat[s]"),
    )
    assert rubbed == pytest.approx(7 * 3 * motion.time, rel=1e-9, abs=1e-9)
    assert slipped == pytest.approx(np.maximum(150 * motion.time - 25, 0), rel=1e-9, abs=1e-6)


def test_a_vehicle_goes_by_its_radius_and_rolling_takes_of_the_power() -> None:
    """90 kg*m^2 are 1000 kg on .3 m, which roll with .01 g: F = m a."""
    road = "{road: {mass: 1000, radius: 0.3, rolling: 0.01}}"
    text = f"duration: 2\nstart: {{speeds: {{o: 10}}}}\ntorques: {{o: {road}}}"
    columns = *(f"vehicle_{one}[o]" for one in ("speed", "acceleration", "jerk")), "powers[o]"
    motion, [speed, acceleration, jerk, power] = asked(text, "inertias: {o: 90}\n", *columns)
    rolling = 0.01 * 9.81
    assert speed == pytest.approx(3 - rolling * motion.time, rel=1e-9)
    assert acceleration == pytest.approx(np.full_like(speed, -rolling), rel=1e-9)
    assert not jerk.any()
    assert power == pytest.approx(-1000 * rolling * speed, rel=1e-9)


def test_formulas_see_the_acceleration_of_a_link_without_inertia_behind_a_damper() -> None:
    """Its integral is the change of the speed; spring and damper share what the link carries."""
    motion, [speed] = asked(
        "duration: 1\nstart: {speeds: {o: 1, m: 1}}\nstates: {v: {rate: \"acceleration('m')\"}}",
        OSCILLATOR.replace("600 N*m/rad}", "600 N*m/rad, damping: 30 N*m*s/rad}"),
        "states[v]",
    )
    assert speed == pytest.approx(motion.speeds[:, 0] - motion.speeds[0, 0], abs=1e-8)


def test_columns_of_a_control_are_its_states_and_temperatures() -> None:
    """dx/dt = 2; 600 W heat 50 J/K: 12 K/s."""
    _, [state, temperature] = asked(
        "duration: 2\nstart: {speeds: {o: 20}}\nspeeds: {o: 20}\ncontrols: {B: 30}\n"
        "states: {x: {start: 1, rate: 2}}",
        "inertias: {o: 1}\n"
        "shift_elements: {B: {links: [o, housing], friction: {heat_capacity: 50 J/K, "
        "cooling: 0, ambient: 20}}}\n",
        *("states[x]", "temperatures[B]"),
    )
    assert (state[0], state[-1]) == pytest.approx((1.0, 5.0), rel=1e-9)
    assert (temperature[0], temperature[-1]) == pytest.approx((20.0, 44.0), rel=1e-8)


SET = """inertias: {sun: 0.5, ring: 0.7, carrier: 0.8}
mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -1.5}}
"""


def test_the_reduced_inertia_is_that_of_all_links_but_the_output() -> None:
    """Tarasik, figure 2: J_a + J_b (w_b/w_a)^2 by (3), at speeds that are given over time."""
    for sun, carrier, printed in (
        ((500, 200), (0, 900), {0: 0.811111, 1: 0.723162, 2: 0.647049, 3: 0.584538, 5: 0.508642}),
        ((1500, 1200), (600, 1200), {0: 0.5, 5: 0.513317, 10: 0.557143, 20: 0.765089, 30: 1.2}),
    ):
        given = [f"[[0, {begin} rpm], [30, {end} rpm]]" for begin, end in (sun, carrier)]
        text = f"duration: 30\nspeeds: {{sun: {given[0]}, carrier: {given[1]}}}"
        motion, [reduced] = asked(text, SET, "reduced_inertia[]", step=1)
        for time, inertia in printed.items():
            assert reduced[motion.time == time] == pytest.approx(inertia, abs=6e-7)
    text = "duration: 1\nspeeds: {sun: [[0, 0], [1, 10]], carrier: 1}"
    _, [reduced] = asked(text, SET, "reduced_inertia[]")
    assert np.isnan(reduced).tolist() == [True] + [False] * (len(reduced) - 1)  # at rest


CONVERTER = "inertias: {p: 1, t: 1}\n"
POINTS = "[[0, 2.5, 0.003], [1, 1, 0], [1.5, 1, -0.001]]"


def test_a_converter_tells_its_ratios_and_what_its_turbine_gives() -> None:
    """Speed ratio w_T/w_P; power out by power in: K i, 1/(K i) in overrun, 0 where both take it."""
    for pump, turbine, expected in (
        # K = 2.5 - 1.5 i and lambda = .003 (1 - i) between the points; by hand
        (200, 140, (0.7, 0.7 * 1.45, 0.0009 * 200**2, 1.45)),
        (200, 0, (0.0, 0.0, 0.003 * 200**2, 2.5)),
        (200, 250, (1.25, 1 / 1.25, -0.0005 * 200**2, 1.0)),
        (200, 200, (1.0, 1.0, 0.0, 1.0)),
        (-200, -140, (0.7, 0.7 * 1.45, -0.0009 * 200**2, 1.45)),
        (200, -20, (-0.1, 0.0, 0.003 * 200**2, 2.5)),
    ):
        ratio, efficiency, taken, factor = expected
        text = f"duration: 1\nspeeds: {{p: {pump}, t: {turbine}}}"
        given = f"{CONVERTER}converters: {{TC: {{links: [p, t], points: {POINTS}}}}}\n"
        motion, found = asked(text, given, "ratio[TC]", "efficiency[TC]")
        torques = dict(zip(motion.devices, motion.torques[-1], strict=True))
        assert [one[-1] for one in found] == pytest.approx([ratio, efficiency], abs=1e-12)
        assert torques["TC"] == pytest.approx(taken, abs=1e-9)
        assert torques["TC.turbine"] == pytest.approx(factor * taken, abs=1e-9)
        # each torque holds its link at a given speed
        assert torques["p"] == pytest.approx(taken, abs=1e-9)
        assert torques["t"] == pytest.approx(-factor * taken, abs=1e-9)


def test_a_converter_of_a_scenario_or_in_place_of_a_mechanism_has_the_same_columns() -> None:
    """K i = (2.5 - 1.5 i) i; the turbine gives K lambda w_P^2."""
    text = "duration: 1\nspeeds: {p: 200, t: 140}"
    kind = "{kind: converter, first: p, second: t, speed_ratio: 0.7, "
    for scenario, case in (
        (f"{text}\nconverters: {{TC: {{links: [p, t], points: {POINTS}}}}}", CONVERTER),
        (text, f"{CONVERTER}mechanisms: {{TC: {kind}points: {POINTS}}}}}\n"),
    ):
        assert "TC.turbine" in rows_of_kind("device", written(scenario, case))
        motion, found = asked(scenario, case, "ratio[TC]", "efficiency[TC]")
        assert [one[-1] for one in found] == pytest.approx([0.7, 0.7 * 1.45])
        given = motion.torques[-1, motion.devices.index("TC.turbine")]
        assert given == pytest.approx(1.45 * 0.0009 * 200**2)


PACK = """inertias: {o: 2}
shift_elements:
  A: {links: [o, housing]}
  B: {links: [o, housing], friction: {coefficient: 0.1, radius: 0.1, area: 0.02, surfaces: 4}}
"""


def test_a_column_without_values_gets_a_warning() -> None:
    scenario = "duration: 1\nstart: {speeds: {o: 9}}\ncontrols: {A: 3, B: 1000 Pa}"

    def said(*columns: str, case: str = PACK) -> list[tuple[str, str]]:
        return [(one.id, one.text) for one in asked(scenario, case, *columns)[0].messages]

    assert said("heat_per_area[B]") == said("heat[A]", "heat_per_area[B]") == []
    assert said("heat_per_area[A]", case=f"{PACK}allow: [W896]\n") == []
    missing = "has no value; give an `area` in `friction` of the shift element"
    for columns in (("heat_per_area[A]",), ("slip_power_per_area[A]", "heat_per_area[B]")):
        assert said(*columns) == [("W896", f"column {columns[0]} {missing}")]
    [(_, both)] = said("heat_per_area[A]", "slip_power_per_area[A]")
    assert both.startswith("columns heat_per_area[A], slip_power_per_area[A] have no value")


def test_slip_power_and_heat_by_the_area_of_a_pack() -> None:
    """100 kPa on .02 m^2, .1 m, 4 surfaces, .1: 80 N*m at 50 rad/s on 4 x .02 m^2."""
    text = "duration: 2\nstart: {speeds: {o: 50}}\nspeeds: {o: 50}\ncontrols: {B: 100 kPa, A: 5}"
    columns = "slip_power_per_area[B]", "heat_per_area[B]", "slip_power_per_area[A]"
    motion, [power, heat, unknown] = asked(text, PACK, *columns)
    assert power == pytest.approx(np.full_like(motion.time, 80 * 50 / 0.08), rel=1e-9)
    assert heat == pytest.approx(power * motion.time, rel=1e-9, abs=1e-9)
    assert heat[-1] == pytest.approx(motion.energy.heat_per_area["B"])
    assert np.isnan(unknown).all()


def test_what_there_is_not_is_reported() -> None:
    assert AskedAnswer._fields == tuple(TABLES)  # JSON has a key for each table
    scenario = written(f"duration: 1\n{AT_REST}", WHEEL)
    for column, said in (
        (("jerk", "o"), "a run has no table `jerk`; did you mean `jerks`?"),
        (("jerks", "p"), "a run has no link `p`, expected one of o"),
        (("states", "x"), "a run has no state `x`"),
    ):
        with pytest.raises(CaseError) as caught:
            simulate(scenario, columns=[column])
        assert caught.value.problems[0].message == said


@seeds_with_slow(2, 6, 40)
def test_changes_are_those_of_the_speeds_and_powers_are_work(seed: int) -> None:
    """Between instants v grows by (a0 + a1) h/2 - (j1 - j0) h^2/12: Euler and Maclaurin."""
    scenario = random_run(seeded(seed), losses=True)
    links = scenario.case.link_names[: scenario.case.own_links]
    columns = [(one, link) for one in ("accelerations", "jerks", "powers") for link in links]
    motion = simulate(scenario, step=scenario.duration / 1000, columns=columns)
    lengths = np.diff(motion.time)
    inside = lengths > 0
    for speed, link in zip(motion.speeds.T, links, strict=False):
        acceleration, jerk = (motion.asked[one][link] for one in ("accelerations", "jerks"))
        sums = (acceleration[1:] + acceleration[:-1]) / 2
        grown = lengths * sums - lengths**2 * np.diff(jerk) / 12
        apart = np.abs(np.diff(speed) - grown)[inside]
        assert apart.max() < 1e-7 * max(1.0, float(np.abs(speed).max()))
    power = np.sum([*motion.asked["powers"].values()], axis=0)
    work = float((lengths * (power[1:] + power[:-1])).sum()) / 2
    resisted = sum(heat for name, heat in motion.energy.heat.items() if name in links)
    assert work == pytest.approx(motion.energy.work - resisted, rel=1e-4, abs=1e-2)
