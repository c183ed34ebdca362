"""Names that strict readers of YAML 1.1 take for true or false, and formulas without a number."""

from __future__ import annotations

import re

import pytest
import yaml

from tests.chance import count, seeded
from tests.simulation.control.written import faults, simulated, written
from vstatics.core.readers import loads
from vstatics.core.writers.named import write_json, write_yaml

SHORT = ("n", "y", "N", "Y")
TRUTH = re.compile(
    r"^(y|Y|yes|Yes|YES|n|N|no|No|NO|true|True|TRUE|false|False|FALSE|on|On|ON|off|Off|OFF)$"
)
"""Booleans of https://yaml.org/type/bool.html."""


@pytest.mark.parametrize("quote", ["", "'", '"'])
@pytest.mark.parametrize("name", SHORT)
def test_a_short_name_is_one_of_a_number_state_or_table(name: str, quote: str) -> None:
    """2 dw/dt = 3 + 4 t, with the number 3, and the state that rises by 4 in a second."""
    key = f"{quote}{name}{quote}"
    start = "duration: 1\nstart: {speeds: {e: 0, o: 0}}\ncontrols: {C: 0}\n"
    for given in (f"numbers: {{{key}: 4}}", f"set: {{{key}: 4}}"):
        text = f'{start}{given}\nstates: {{p: {{rate: {name}}}}}\ntorques: {{e: "3 + p"}}\n'
        assert simulated(text).speeds[-1, 0] == pytest.approx((3 + 2) / 2)
    text = f'{start}states: {{{key}: {{rate: 4}}}}\ntorques: {{e: "3 + {name}"}}\n'
    assert simulated(text).speeds[-1, 0] == pytest.approx((3 + 2) / 2)
    text = f'{start}tables: {{{key}: [[0, 0], [1, 4]]}}\ntorques: {{e: "3 + {name}(t)"}}\n'
    assert simulated(text).speeds[-1, 0] == pytest.approx((3 + 2) / 2)


@pytest.mark.parametrize("name", ["on", "off", "yes", "no", "On", "TRUE", "false"])
def test_a_name_that_pyyaml_takes_for_true_or_false_is_refused(name: str) -> None:
    text = "duration: 1\nstart: {speeds: {e: 0, o: 0}}\n"
    for quote in ("", "'"):
        [fault] = faults(f"{text}numbers: {{{quote}{name}{quote}: 1}}\n")
        assert f"`{name}` is true or false in YAML, expected another name" in fault


@pytest.mark.parametrize("seed", range(count(20, 300)))
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
        f"duration: 1\nstart: {{gear: {name}, speed: 5}}\ntorques: {{{name}: \"5 - speed('{name}')\"}}\n",
        case,
    )
    assert motion.speeds[-1].tolist() == pytest.approx([5.0, 5.0])


@pytest.mark.parametrize(
    "formula", ["t + 7/0", "7/0 + t", "t/0", "speed*0/0", "w/0", "angle/0", "sqrt(-1 - t)"]
)
def test_a_formula_that_never_is_a_number_is_refused_before_the_run(formula: str) -> None:
    text = "duration: 1\nstart: {speeds: {e: 0, o: 0}}\n"
    [fault] = faults(f'{text}torques: {{e: "{formula}"}}\n')
    assert "and at all other times, expected a number" in fault
    if "t" in formula.replace("sqrt", ""):
        for key in ("states: {p: {rate: '%s'}}", "controls: {C: '%s'}"):
            assert len(faults(f"{text}{key % formula}\n")) == 1


@pytest.mark.parametrize("formula", ["1/t", "sqrt(t - 0.5)", "1/speed", "t*max(speed, 0)"])
def test_a_formula_that_is_a_number_at_times_is_read(formula: str) -> None:
    written(f'duration: 1\nstart: {{speeds: {{e: 0, o: 0}}}}\ntorques: {{e: "{formula}"}}\n')
