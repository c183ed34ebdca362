"""Dynamic factors of runs, by the closed form of the static torques."""

from pathlib import Path

import pytest

from tests.chance import count, seeded
from tests.commands import json_answer, vstatics
from vstatics import ReadError, load_scenario, simulate

CASE = """\
links: [in, lay, half in, out]
inertias: {{in: 0.2, lay: 0.05, out: 4}}
mechanisms: {{pair: {{first: in, second: lay, ratio: -{ratio}, efficiency: {efficiency}}}}}
springs: {{half: {{links: [half in, out], stiffness: 3000, damping: 2}}}}
shift_elements: {{C: [lay, half in], D: [in, out]}}
gears: {{"1": [C], direct: [D]}}
"""
SCENARIO = """\
case: box.yaml
duration: 0.5
start: {gear: "1", speed: 100}
numbers: {top: 200}
torques: {in: "top*(t > 0.1)"}
static: {gear: "1", torque: 150 N*m}
samples: {numbers.top: {uniform: [100, 200]}}
"""


def scenario_of(folder: Path, scenario: str = SCENARIO, **numbers: float) -> Path:
    (folder / "box.yaml").write_text(CASE.format(**{"ratio": 3, "efficiency": 0.96, **numbers}))
    (folder / "run.yaml").write_text(scenario)
    return folder / "run.yaml"


def test_factors_are_largest_torques_divided_by_torques_of_statics(tmp_path: Path) -> None:
    """150 N*m at the pair, and 150 u eta at clutch and spring; the other clutch is open."""
    for seed in range(count(8, 40)):
        random = seeded(seed)
        ratio, efficiency = random.uniform(1, 4), random.uniform(0.8, 1)
        file = scenario_of(tmp_path, ratio=ratio, efficiency=efficiency)
        motion = simulate(load_scenario(file))
        static = {"pair": 150.0, "C": 150 * ratio * efficiency, "half": 150 * ratio * efficiency}
        for name, torque in static.items():
            factor = abs(motion.peaks[name].torque) / torque
            assert motion.dynamic_factors[name] == pytest.approx(factor, rel=1e-12)
        assert motion.dynamic_factors["D"] is None


def test_the_speeds_of_a_start_need_not_belong_to_a_gear(tmp_path: Path) -> None:
    """A constant efficiency needs no speed: 150*3*0.96 at the spring."""
    for start in ('{gear: "1"}', "{speeds: {in: 0, out: 0}}", "{speeds: {in: 9, out: 0}}"):
        text = SCENARIO.replace('{gear: "1", speed: 100}', start)
        motion = simulate(load_scenario(scenario_of(tmp_path, text)))
        factor = abs(motion.peaks["half"].torque) / 432
        assert motion.dynamic_factors["half"] == pytest.approx(factor, rel=1e-12)


def test_a_gear_that_statics_ties_up_has_no_factors_and_a_warning(tmp_path: Path) -> None:
    file = scenario_of(tmp_path)
    case = tmp_path / "box.yaml"
    stop = "springs: {stop: {links: [lay, housing], stiffness: 1}, "
    case.write_text(case.read_text().replace("springs: {", stop))
    motion = simulate(load_scenario(file))
    assert {*motion.dynamic_factors.values()} == {None}
    assert [message.id for message in motion.messages] == ["W605"]


def test_commands_report_factors(tmp_path: Path) -> None:
    file = str(scenario_of(tmp_path))
    answer = json_answer("simulate", file)
    factors = answer["dynamic_factors"]
    assert factors["half"] == pytest.approx(abs(answer["peaks"]["half"]["torque"]) / 432)
    assert factors["D"] is None
    assert "dynamic factor" in vstatics("simulate", file).out
    varied = "--vary", "static.torque=150 N*m,300 N*m"
    rows = vstatics("sweep", file, *varied, "-f", "csv", "--out", "dynamic_factor[half]").out
    first, second = (float(row.split(",")[-1]) for row in rows.splitlines()[1:])
    assert (first, second) == pytest.approx((factors["half"], factors["half"] / 2))
    sampled = vstatics("simulate", file, "--samples", 2, "--out", "dynamic_factor[half]").out
    assert "dynamic_factor[half]" in sampled


def test_a_static_torque_that_cannot_be_is_refused(tmp_path: Path) -> None:
    for static, what in (
        ('{gear: "9", torque: 150}', "read `9`, expected the name of a gear"),
        ('{gear: "1", torque: 0}', "read 0, expected a torque other than 0"),
        ('{gear: "1"}', "`torque` is missing"),
    ):
        text = SCENARIO.replace('{gear: "1", torque: 150 N*m}', static)
        with pytest.raises(ReadError, match=what):
            load_scenario(scenario_of(tmp_path, text))
