"""Sweeps of a scenario: a variant is the run of its documents, whoever calculates it."""

import math
import pickle
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vstatics
from tests.commands import CASES
from tests.rejects import rejects
from tests.simulation.variants.scenarios import CASE, SCENARIO, subject
from tests.simulation.variants.states import write_scenario
from vstatics import Chunk, ReadError, VariedScenario, load_varied
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import simulate
from vstatics.simulation.variants.samples import sample_plan
from vstatics.sweep import build
from vstatics.sweep.blocks import calculate
from vstatics.sweep.chunk import STATUS, joined
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.runs import piece_of_runs
from vstatics.sweep.variants.scenario_numbers import NumberPath
from vstatics.sweep.variants.subject import Document

OUT = "locks[brake], heat[brake], speeds[carrier], max(abs(slips)), controls.brake.1.2*2"
SLIP = 500 * math.pi / 30 / 1.5
"""Of the ring at the start, by (w_sun - w_c) + 1.5 (w_ring - w_c) = 0. [rad/s]"""


def rows(*vary: str, scenario: bytes = SCENARIO, **more: Any) -> Chunk:
    plan = build.plan(subject(scenario), SweepOptions.of(vary=vary, **{"out": OUT, **more}))
    return calculate(plan, 0, plan.variants.count)


def lock_time(torque: float) -> float:
    """When the brake of the set locks: the deceleration is linear in its torque.

    By the exact matrix of tarasik.md, section 4: without friction the ring gains
    dw = -(w_sun'/1.5) + (2.5/1.5) w_carrier'.
    """
    ring = np.array([-1 / 1.5, 2.5 / 1.5])
    inertia = np.diag([0.5, 0.8]) + 0.7 * np.outer(ring, ring)
    acceleration = np.linalg.solve(inertia, np.array([40.0, -60.0]) + ring * torque)
    return SLIP / float(ring @ acceleration)


def test_teeth_that_do_not_go_together_are_reported_and_the_run_stands() -> None:
    """Planets of a set want (ring - sun)/2 to be whole; the path is that of a sweep of the case."""
    case = CASE.replace(
        b"mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -1.5}}",
        b"elements: {set: {kind: planetary, sun: sun, ring: ring, carrier: carrier, planets: 3,"
        b" efficiency: 1, teeth: {sun: 40, ring: 60}}}",
    )
    vary, out = ["set.teeth.ring=60:66:7"], "locks[brake], set.ratio, set.efficiency"
    made = calculate(build.plan(subject(case=case), SweepOptions.of(vary=vary, out=out)), 0, 7)
    for ring, status in zip(made.values[:, 0].tolist(), made.status, strict=True):
        fits = (ring - 40) % 2 == 0 and (ring + 40) % 3 == 0
        assert STATUS[status] == ("ok" if fits else "not assembled")
    assert made.columns[0, 0] == pytest.approx(lock_time(120.0), rel=1e-6)
    assert np.isfinite(made.columns).all()
    np.testing.assert_allclose(made.columns[:, 1], -made.values[:, 0] / 40, 1e-15)
    assert (made.columns[:, 2] == 1).all()
    for more, said in (
        ([], r"set\.ratio follows from teeth, .* expected teeth such as set\.teeth\.sun"),
        (["set.teeth.ring=60,62"], r"set\.ratio is varied together with teeth that determine it"),
    ):
        with pytest.raises(ReadError, match=said):
            build.plan(subject(case=case), SweepOptions.of(vary=["set.ratio=-2,-3", *more]))


def test_variants_of_one_number_have_the_closed_form() -> None:
    """The published case of 120 N*m locks at .410054006 s."""
    assert lock_time(120.0) == pytest.approx(0.410054006, abs=5e-10)
    made = rows("controls.brake.1.2=100,120,140")
    assert made.headings[0] == "locks[brake]"
    expected = [lock_time(torque) for torque in (100.0, 120.0, 140.0)]
    np.testing.assert_allclose(made.columns[:, 0], expected, rtol=1e-8)
    assert made.columns[1, 1] == pytest.approx(858.815102, abs=1e-6)
    assert made.columns[:, 4].tolist() == [200.0, 240.0, 280.0]
    assert [STATUS[code] for code in made.status] == ["ok"] * 3


def test_a_variant_is_the_run_of_its_scenario() -> None:
    made = rows("controls.brake.scale=.9,1.1", "ring.inertia=.5,.7", out="heat[brake], work")
    varied = subject()
    paths = [varied.target(name) for name in ("controls.brake.scale", "ring.inertia")]
    for values, columns in zip(made.values, made.columns, strict=True):
        motion = simulate(varied.variant(paths, values.tolist()).scenario)
        assert columns.tolist() == [motion.energy.heat["brake"], motion.energy.work]


def test_a_control_above_the_capacity_is_reported_once_for_all_runs_that_have_it() -> None:
    """Of 100, 115, 130 and 145 N*m three are above 110, however the runs are put together."""
    capacity = CASE.replace(b"brake: [ring, housing]", b"brake: {links: [ring, housing], C}")
    held = subject(case=capacity.replace(b"C}", b"capacity: 110 N*m}"))
    plan = build.plan(held, SweepOptions.of(vary=["controls.brake.1.2=100:145:4"], out="heat"))
    for ends in ((0, 4), (0, 2, 4), (0, 1, 2, 3, 4)):
        parts = [calculate(plan, *two) for two in pairwise(ends)]
        [note] = joined(parts[::-1]).noticed
        assert (note.id, note.first, note.variants) == ("N605", 1, 3)
        assert "brake is above the capacity in the case, 110:" in note.text
    assert calculate(plan, 0, 1).noticed == ()


def test_what_cannot_be_is_invalid_and_has_no_numbers() -> None:
    made = rows("controls.brake.1.2=120,nan", "sun.inertia=-.5,.5", where="heat[brake] >= 0")
    assert made.variants.tolist() == [1]
    assert dict(made.counts) == {"ok": 1, "invalid": 3}
    made = rows("sun.inertia=-.5,.5")
    assert [STATUS[code] for code in made.status] == ["invalid", "ok"]
    assert np.isnan(made.columns[0]).all()


def test_a_scenario_in_error_is_reported_at_once() -> None:
    wrong = SCENARIO.replace(b"sun: 40", b"san: 40")
    with pytest.raises(ReadError, match=r"lock\.yaml:7:"):
        rows("duration=1,2", scenario=wrong)


def test_pieces_depend_on_the_plan_alone() -> None:
    assert [piece_of_runs(count) for count in (1, 1000, 65536, 10**6)] == [16, 16, 16, 245]
    plan = build.plan(subject(), SweepOptions.of(vary=["duration=.1:.2:40"]))
    assert (plan.piece, plan.pieces) == (16, 3)
    again = pickle.loads(pickle.dumps(plan))  # noqa: S301 (our own)
    assert again.fingerprint() == plan.fingerprint()
    other = build.plan(subject(SCENARIO + b"# more\n"), SweepOptions.of(vary=["duration=.1:.2:40"]))
    assert other.fingerprint() != plan.fingerprint()


def test_pieces_depend_on_the_points_beside_the_case(tmp_path: Path) -> None:
    points, case = tmp_path / "drag.csv", tmp_path / "set.yaml"
    text = CASE + b"load: {speed: 500 rpm, torque: 40 N*m}\ndrag: {sun: {file: drag.csv}}\n"
    of = Document(SCENARIO, "lock.yaml"), Document(text, str(case))
    made = []
    for torque in (1, 1, 3):
        points.write_text(f"speed [rad/s],torque [N*m]\n0,{torque}\n", "utf-8")
        plan = build.plan(VariedScenario(*of), SweepOptions.of(vary=["duration=.1:.2:40"]))
        made.append(plan.fingerprint())
    assert made[0] == made[1] != made[2]


def test_a_scenario_is_swept_from_python(tmp_path: Path) -> None:
    write_scenario(tmp_path)
    varied = load_varied(str(tmp_path / "lock.yaml"))
    (made,) = vstatics.sweep(varied, {"controls.brake.1.2": [100.0, 140.0]}, out="locks[brake]")
    expected = [[lock_time(100.0)], [lock_time(140.0)]]
    np.testing.assert_allclose(made.columns, expected, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(path.name for path in CASES.glob("scenarios/*.yaml")))
def test_tables_have_a_row_for_all_that_a_run_tells(name: str) -> None:
    """Of the first part of each shipped scenario: sums over rows lose nothing."""
    varied = load_varied(str(CASES / "scenarios" / name))
    scenario = varied.own.scenario
    motion = simulate(scenario._replace(duration=min(scenario.duration, 0.6)))
    assert set(motion.energy.heat) <= set(varied.rows("friction"))
    assert set(motion.energy.losses) <= set(varied.rows("loss"))
    changed = {event.element for event in motion.events if event.event != "step"}
    assert changed <= {*varied.rows("friction"), *varied.rows("loss")}
    assert set(motion.peaks) <= set(varied.rows("device"))
    assert set(varied.rows("link")) <= set(motion.links)
    assert set(varied.rows("device")) == set(motion.devices)


def drawn(scenario: bytes, count: int, **more: Any) -> tuple[Floats, Floats]:
    options = SweepOptions.of(sample=count, **{"out": "heat[brake]", **more})
    plan = sample_plan(subject(scenario), options)
    return plan.variants.block(0, count), calculate(plan, 0, min(count, 4)).columns


def test_samples_have_their_distributions_and_a_seed_gives_the_same() -> None:
    """Means and deviations within 4 standard errors of 4000 numbers."""
    numbers, heat = drawn(SCENARIO, 4000, seed=3)
    scale, torque = numbers.T
    assert scale.mean() == pytest.approx(1.0, abs=4 * 0.05 / math.sqrt(4000))
    assert scale.std() == pytest.approx(0.05, rel=4 / math.sqrt(8000))
    assert torque.mean() == pytest.approx(40.0, abs=4 * 10 / math.sqrt(12 * 4000))
    assert 35 <= torque.min() < 35.1
    assert abs(np.corrcoef(scale, torque)[0, 1]) < 4 / math.sqrt(4000)
    again, same = drawn(SCENARIO, 4000, seed=3)
    np.testing.assert_array_equal(numbers, again)
    np.testing.assert_array_equal(heat, same)
    few, _ = drawn(SCENARIO, 10, seed=3)
    np.testing.assert_array_equal(few, numbers[:10])
    assert (drawn(SCENARIO, 10, seed=4)[0] != few).all()


def test_samples_of_a_number_with_a_unit_are_in_si() -> None:
    """A bare capacity of a case is relative to its load: 3 kN*m is not 3000 bare."""
    case = CASE.replace(b"brake: [ring, housing]", b"brake: {links: [ring], capacity: 3 kN*m}")
    case += b"load: {torque: 100 N*m}\n"
    for element, mean in ((b"brake", b"3000"), (b"brake", b"3 kN*m"), (b"lock-up", b"3 kN*m")):
        given = b"samples: {shift_elements.%s.capacity: {normal: [%s, 0]}}\n" % (element, mean)
        varied = subject(SCENARIO.partition(b"samples")[0] + given, case)
        plan = sample_plan(varied, SweepOptions.of(sample=1))
        (path,) = plan.variants.targets
        assert isinstance(path, NumberPath)
        assert path.unit == "N*m"
        assert path.name == f"shift_elements.{element.decode()}.capacity [N*m]"
        if element == b"brake":
            made = varied.variant([path], plan.variants.block(0, 1)[0].tolist())
            assert made.scenario.case.shift_elements == varied.own.scenario.case.shift_elements


def test_without_deviation_samples_are_the_run_itself() -> None:
    still = SCENARIO.replace(b"[1, 0.05]", b"[1, 0]").replace(b"[35, 45]", b"[40, 40]")
    _, heat = drawn(still, 2)
    assert heat.tolist() == [[simulate(subject().own.scenario).energy.heat["brake"]]] * 2


def test_a_sample_of_a_number_that_there_is_not_is_reported() -> None:
    for before, after, said in (
        (b"controls.brake.scale", b"controls.brak.scale", "no `brak` in `controls`"),
        (b"torques.sun:", b"torques.son:", "did you mean `sun`?"),
    ):
        with rejects(ReadError, said, "lock.yaml:"):
            drawn(SCENARIO.replace(before, after), 2)


def test_a_scenario_without_samples_says_so() -> None:
    with pytest.raises(ReadError, match="the scenario has no `samples`"):
        drawn(SCENARIO.partition(b"samples")[0], 2)
