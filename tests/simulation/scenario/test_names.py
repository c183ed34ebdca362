"""Names that strict readers of YAML 1.1 take for true or false, and formulas without a number."""

import re

import pytest
import yaml

from tests.chance import each_seed, seeded
from tests.simulation.control.written import faults, simulated, written
from vstatics import loads
from vstatics.core.writers.named import write_json, write_yaml

SHORT = ("n", "y", "N", "Y")
TRUTH = re.compile(
    r"^(y|Y|yes|Yes|YES|n|N|no|No|NO|true|True|TRUE|false|False|FALSE|on|On|ON|off|Off|OFF)$"
)
"""Booleans of https://yaml.org/type/bool.html."""


REST = "duration: 1\nstart: {speeds: {e: 0, o: 0}}\n"


@pytest.mark.parametrize("quote", ["", "'", '"'])
@pytest.mark.parametrize("name", SHORT)
def test_a_short_name_is_one_of_a_number_state_or_table(name: str, quote: str) -> None:
    """2 dw/dt = 3 + 4 t, with the number 3, and the state that rises by 4 in a second."""
    key = f"{quote}{name}{quote}"
    for given, torque in (
        (f"numbers: {{{key}: 4}}\nstates: {{p: {{rate: {name}}}}}", "3 + p"),
        (f"set: {{{key}: 4}}\nstates: {{p: {{rate: {name}}}}}", "3 + p"),
        (f"states: {{{key}: {{rate: 4}}}}", f"3 + {name}"),
        (f"tables: {{{key}: [[0, 0], [1, 4]]}}", f"3 + {name}(t)"),
    ):
        motion = simulated(f'{REST}controls: {{C: 0}}\n{given}\ntorques: {{e: "{torque}"}}\n')
        assert motion.speeds[-1, 0] == pytest.approx((3 + 2) / 2)


@pytest.mark.parametrize("name", ["on", "off", "yes", "no", "On", "TRUE", "false"])
def test_a_name_that_pyyaml_takes_for_true_or_false_is_refused(name: str) -> None:
    for quote in ("", "'"):
        [fault] = faults(f"{REST}numbers: {{{quote}{name}{quote}: 1}}\n")
        assert f"`{name}` is true or false in YAML, expected another name" in fault


@each_seed(20, 300)
def test_names_of_a_case_are_read_back_and_no_strict_reader_takes_them_for_truth(seed: int) -> None:
    rng = seeded(seed)
    words = [*SHORT, "on", "off", "yes", "No", "a", "b c"]
    first, second, third, element, spring, gear = rng.sample(words, 6)
    text = f"""links: ["{first}", "{second}", "{third}"]
inertias: {{"{first}": 1, "{second}": 2}}
shift_elements: {{"{element}": ["{first}", "{second}"]}}
springs: {{"{spring}": {{links: ["{second}", "{third}"], stiffness: 3}}}}
gears: {{"{gear}": ["{element}"]}}
"""
    case = loads(text)
    assert list(case.link_names) == [first, second, third]
    for write in (write_yaml, write_json):
        assert loads(write(case)) == case
    plain = [
        event.value
        for event in yaml.parse(write_yaml(case), Loader=yaml.SafeLoader)
        if isinstance(event, yaml.ScalarEvent) and not event.style
    ]
    assert not [one for one in plain if TRUTH.match(one)]


@pytest.mark.parametrize("name", SHORT)
def test_links_and_elements_of_a_run_have_short_names(name: str) -> None:
    case = f"""links: [{name}, b]
inertias: {{{name}: 2, b: 3}}
shift_elements: {{"{name}{name}": {{links: [{name}, b]}}}}
gears: {{{name}: ["{name}{name}"]}}
"""
    motion = simulated(
        f"duration: 1\nstart: {{gear: {name}, speed: 5}}\n"
        f"torques: {{{name}: \"5 - speed('{name}')\"}}\n",
        case,
    )
    assert motion.speeds[-1].tolist() == pytest.approx([5.0, 5.0])


def test_a_formula_that_never_is_a_number_is_refused_before_the_run() -> None:
    for formula in ("t + 7/0", "7/0 + t", "t/0", "speed*0/0", "w/0", "angle/0", "sqrt(-1 - t)"):
        [fault] = faults(f'{REST}torques: {{e: "{formula}"}}\n')
        assert "and at all other times, expected a number" in fault
        if "t" in formula.replace("sqrt", ""):
            for key in ("states: {p: {rate: '%s'}}", "controls: {C: '%s'}"):
                assert len(faults(f"{REST}{key % formula}\n")) == 1


@pytest.mark.parametrize("formula", ["1/t", "sqrt(t - 0.5)", "1/speed", "t*max(speed, 0)"])
def test_a_formula_that_is_a_number_at_times_is_read(formula: str) -> None:
    written(f'{REST}torques: {{e: "{formula}"}}\n')
