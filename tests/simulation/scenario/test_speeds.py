"""Speeds in formulas: names of the variable, and speeds of vehicles in conditions."""

import math
from pathlib import Path

import pytest

from tests.chance import each_seed, seeded
from tests.rejects import rejects
from tests.simulation.control.written import faults, simulated
from vstatics import CaseError, ReadError, loads, solve
from vstatics.simulation import Formula, Scenario, Start, constant, load_scenario, simulate
from vstatics.simulation.scenario.parts import ControlState

REST = "duration: 1\nstart: {speeds: {e: 5, o: 0}}\ncontrols: {C: 0}\n"


def test_w_is_the_speed_with_its_sign_but_where_it_is_something_else() -> None:
    """2 dw/dt = -0.4 w; from -5 rad/s where its sign counts."""
    slowed = "-0.4*w", "-0.4*speed", "0.4*abs(w) - 0.8*w"
    for given, expected in (
        *((f'torques: {{e: "{torque}"}}', 5 * math.exp(-0.2)) for torque in slowed),
        # a number or a state of the name w stays what it is: 2 dw/dt = 2 t
        ('numbers: {w: 3}\ntorques: {e: "w - speed"}', 3 + 2 * math.exp(-1 / 2)),
        ('states: {w: {rate: "2 + 0*w"}}\ntorques: {e: w}', 5 + 1 / 2),
    ):
        assert simulated(f"{REST}{given}\n").speeds[-1, 0] == pytest.approx(expected)
        if "-0.4" in given:
            back = simulated(f"{REST}{given}\n".replace("{e: 5", "{e: -5"))
            assert back.speeds[-1, 0] == pytest.approx(-expected)


def test_from_python_w_is_the_speed_and_no_state() -> None:
    case = loads("links: [a]\ninertias: {a: 2}")
    scenario = Scenario(case, 1.0, Start(speeds={1: -10.0}), torques=((1, Formula("-0.4*w")),))
    assert simulate(scenario).speeds[-1, 0] == pytest.approx(-10 * math.exp(-0.2))
    with pytest.raises(CaseError, match="expected another name"):
        simulate(scenario._replace(states=(ControlState("w", constant(1.0)),)))


def test_where_a_formula_has_no_own_speed_the_words_say_what_to_write() -> None:
    [fault] = faults('duration: 1\nstart: {speeds: {e: 1, o: 0}}\ncontrols: {C: "3*w"}\n')
    assert (
        "read `w`, expected a formula of t; name the link or component, as in speed('e')" in fault
    )


LOSSY = """links: [a, b]
load: {speed: 100 rad/s, torque: 10 N*m}
drag: {a: "%s"}
mechanisms: {g: {first: a, second: b, ratio: 2}}
gears: {"1": []}
"""


def test_a_drag_of_a_case_has_the_same_losses_with_either_name() -> None:
    """0.5 + 0.005 * 100 N*m at 100 rad/s: 1 of 10 N*m."""
    for name in ("speed", "w"):
        results = solve(loads(LOSSY % f"0.5 + 0.005*abs({name})"))
        assert results.efficiency.tolist() == pytest.approx([0.9])


def test_a_wrong_drag_is_refused_with_the_name_of_the_variable() -> None:
    unknown = "a formula of w: read `n` in it, expected a number, the speed w in rad/s"
    for drag, message in (
        ("0.3 + 2e-3*n", unknown), ("sqrt(x)", "a formula of w: read `x` in it"),
        ("3 N", "a formula of the speed `w` is allowed too"),
    ):  # fmt: skip
        with rejects(ReadError, message):
            loads(LOSSY % drag)


def test_a_shaft_with_a_drag_over_its_speed_needs_no_load_in_a_run() -> None:
    """dw/dt = 1 - 0.5 - 0.1 w, so w(1 s) = 5 (1 - exp(-0.1)); statics still asks for the load."""
    for drag in ('"0.5 + 0.1*w"', '"0.5 + 0.1*abs(speed)"', "[[0, 0.5], [100, 10.5]]"):
        case = f"links: [a]\ninertias: {{a: 1}}\ndrag: {{a: {drag}}}\n"
        motion = simulated("duration: 1\nstart: {speeds: {a: 0}}\ntorques: {a: 1}\n", case)
        assert motion.speeds[-1, 0] == pytest.approx(5 * (1 - math.exp(-0.1)), rel=1e-6)
        with pytest.raises(CaseError, match="expected a `load` with both"):
            solve(loads(case))


CASE = "{links: [wheel, other], inertias: {wheel: 90, other: 1}}"
UNITS = {"km/h": 1 / 3.6, "mph": 0.44704, "m/s": 1.0}
"""In m/s; 1 mile is 1609.344 m (International Yard and Pound, 1959)."""


def scenario(folder: Path, when: str, radius: float, torque: float = 200.0) -> Path:
    """A wheel that a constant torque speeds up from rest, without resistance."""
    (folder / "case.yaml").write_text(CASE)
    file = folder / "run.yaml"
    file.write_text(f"""
case: case.yaml
duration: 100
start: {{speeds: {{wheel: 0, other: 0}}}}
torques: {{wheel: [{torque!r}, {{road: {{mass: 1000, radius: {radius!r}}}}}]}}
set: {{seen: 0}}
sequences: {{s: [{{when: "{when}", set: {{seen: 1}}}}]}}
""")
    return file


@each_seed(20, 300)
def test_a_condition_is_met_when_the_vehicle_has_its_speed(seed: int, tmp_path: Path) -> None:
    """Constant acceleration: w = M t/J, and the vehicle has v = r w."""
    rng = seeded(4900 + seed)
    radius, unit = rng.uniform(0.2, 0.6), rng.choice(list(UNITS))
    speed = rng.randint(1, 40)
    forms = (
        "speed('wheel') > {0} {1}; {0}{1} < speed('wheel'); "
        "abs(speed('wheel')) >= {0} {1} and t > 0; -speed('wheel') < -{0} {1}"
    )
    when = rng.choice(forms.format(speed, unit).split("; "))
    run = simulate(load_scenario(scenario(tmp_path, when, radius)))
    [event] = run.events
    assert event.time == pytest.approx(speed * UNITS[unit] / radius * 90 / 200, rel=1e-9)


def test_other_speeds_are_refused(tmp_path: Path) -> None:
    for when, said in (
        ("speed('other') > 5 km/h", "next to speed.. of a link with a `road`; links .*: wheel"),
        ("t > 5 mph", "read `5 mph`, the speed of a vehicle, expected it next to speed"),
        ("speed('wheel') > 5 km/h + 3 km/h", "alone on one side of a comparison"),
        ("speed('wheel') > 5 kg", "read `kg` after `5`, expected an operator"),
    ):
        with pytest.raises(ReadError, match=f"run.yaml:7:.*{said}"):
            load_scenario(scenario(tmp_path, when, 0.3))
