"""`speed` and `w` are one variable in formulas of scenarios and of cases."""

from __future__ import annotations

import math
import re

import pytest

from tests.chance import count, seeded
from tests.simulation.control.written import faults, simulated
from vstatics import solve
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.readers import loads
from vstatics.simulation.run import simulate
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import constant
from vstatics.simulation.scenario.parts import ControlState, Scenario, Start

FORMS = (
    "-0.2*{}",
    "-0.01*{}*abs({})",
    "-3*tanh({}/5) + t",
    "min(4, 50/max(abs({}), 1)) - 0.1*{}",
    "-2*({} > 3) - 0.1*{}",
    "5 - {}^2/100",
)


@pytest.mark.parametrize("seed", range(count(12, 200)))
def test_a_scenario_has_the_same_motion_with_either_name(seed: int) -> None:
    rng = seeded(seed)
    form, begin = rng.choice(FORMS), rng.uniform(-20, 20)
    ends = [
        simulated(
            f"duration: 1\nstart: {{speeds: {{e: {begin!r}, o: 0}}}}\ncontrols: {{C: 2}}\n"
            f'torques: {{e: "{form.replace("{}", name)}"}}\n'
        ).speeds[-1]
        for name in ("speed", "w")
    ]
    assert ends[0].tolist() == ends[1].tolist()


def test_the_speed_has_its_sign_in_a_scenario_under_either_name() -> None:
    """2 dw/dt = -0.4 w from -10 rad/s."""
    motion = simulated(
        'duration: 1\nstart: {speeds: {e: -10, o: 0}}\ncontrols: {C: 0}\ntorques: {e: "-0.4*w"}\n'
    )
    assert motion.speeds[-1, 0] == pytest.approx(-10 * math.exp(-0.2))


def test_a_number_or_a_state_of_the_name_w_stays_what_it_is() -> None:
    motion = simulated(
        "duration: 1\nstart: {speeds: {e: 5, o: 0}}\ncontrols: {C: 0}\nnumbers: {w: 3}\n"
        'torques: {e: "w - speed"}\n'
    )
    assert motion.speeds[-1, 0] == pytest.approx(3 + 2 * math.exp(-1 / 2))
    motion = simulated(
        "duration: 1\nstart: {speeds: {e: 5, o: 0}}\ncontrols: {C: 0}\n"
        'states: {w: {rate: "2 + 0*w"}}\ntorques: {e: w}\n'
    )
    assert motion.speeds[-1, 0] == pytest.approx(5 + 1 / 2)  # 2 dw/dt = 2 t


def test_from_python_w_is_the_speed_and_no_state() -> None:
    case = loads("links: [a]\ninertias: {a: 2}")
    scenario = Scenario(case, 1.0, Start(speeds={1: -10.0}), torques=((1, Formula("-0.4*w")),))
    assert simulate(scenario).speeds[-1, 0] == pytest.approx(-10 * math.exp(-0.2))
    with pytest.raises(CaseError, match="expected another name"):
        simulate(scenario._replace(states=(ControlState("w", constant(1.0)),)))


def test_where_a_formula_has_no_own_speed_the_words_say_what_to_write() -> None:
    [fault] = faults('duration: 1\nstart: {speeds: {e: 1, o: 0}}\ncontrols: {C: "3*w"}\n')
    assert "read `w`, expected a formula of t; name what it is of, as in speed('e')" in fault


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


@pytest.mark.parametrize(
    ("drag", "message"),
    [
        ("0.3 + 2e-3*n", "a formula of w: read `n` in it, expected a number, the speed w in rad/s"),
        ("0.5*v", "a formula of w: read `v` in it"),
        ("sqrt(x)", "a formula of w: read `x` in it"),
        ("3 N", "a formula of the speed `w` is allowed too"),
        ("3 lbf*ftt", "a formula of the speed `w` is allowed too"),
    ],
)
def test_a_wrong_drag_is_refused_with_the_name_of_the_variable(drag: str, message: str) -> None:
    with pytest.raises(ReadError, match=re.escape(message)):
        loads(LOSSY % drag)


@pytest.mark.parametrize(
    "drag", ['"0.5 + 0.1*w"', '"0.5 + 0.1*abs(speed)"', "[[0, 0.5], [100, 10.5]]"]
)
def test_a_shaft_with_a_drag_over_its_speed_needs_no_load_in_a_run(drag: str) -> None:
    """dw/dt = 1 - 0.5 - 0.1 w, so w(1 s) = 5 (1 - exp(-0.1)); statics still asks for the load."""
    case = f"links: [a]\ninertias: {{a: 1}}\ndrag: {{a: {drag}}}\n"
    motion = simulated("duration: 1\nstart: {speeds: {a: 0}}\ntorques: {a: 1}\n", case)
    assert motion.speeds[-1, 0] == pytest.approx(5 * (1 - math.exp(-0.1)), rel=1e-6)
    with pytest.raises(CaseError, match="expected a `load` with both"):
        solve(loads(case))
