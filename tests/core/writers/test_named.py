"""A case written as YAML or JSON and read again is the same case, to the last bit."""

import json

import yaml
from hypothesis import example, given, settings

from tests.chance import count
from tests.core.writers.again import is_read_again
from tests.strategies import ANY_NUMBER, ODD_NAMES, transmissions
from vstatics import loads
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.writers.named import mapping, write_json, write_yaml


def differential(**other: object) -> Transmission:
    parts: dict[str, object] = {
        "links": 3,
        "shift_elements": [ShiftElement(1, 2), ShiftElement(0, 2)],
        "mechanisms": [Mechanism(1, 2, 3, ratio=-2.5)],
        "gears": [Gear([1]), Gear([2])],
    }
    return Transmission(**{**parts, **other})  # type: ignore[arg-type]


@settings(max_examples=count(10, 75))
@given(transmissions(ANY_NUMBER, torsional=True))
@example(differential(description="\x85 \u2028 \u2029 \ufeff \x00 \x1b \t\r\n \r"))
@example(differential(description="\n", source=" \n x\n\n"))
@example(differential(description="a long one " * 100, source="long " * 100 + "\nand two lines"))
@example(differential(gears=[Gear([1], speeds={2: 1e-05, 3: 1e300}, torques={1: 5e-324})]))
@example(differential(gears=[Gear(name="long " * 60 + "name")]))
def test_what_is_written_is_read_again(case: Transmission) -> None:
    assert is_read_again(case)


def test_odd_names_stay_what_they_are() -> None:
    for name in ODD_NAMES:
        gears = [Gear([1], {2: 0.5}, name=name), Gear([1, 2], torques={2: 1.5}, name="other")]
        case = differential(
            name=name,
            link_names=["first", name, "third"],
            shift_elements=[ShiftElement(1, 2, name), ShiftElement(2, 0, "other")],
            mechanisms=[Mechanism(1, 2, 3, -2.5, name=name)],
            gears=gears,
        )
        assert is_read_again(case), name


def test_typographic_blanks_are_kept() -> None:
    for blank in "\u00a0\u2007\u3000":
        for text in (blank, f"{blank}x{blank}", f"{blank}\n", f"a{blank}b"):
            case = differential(source=text, description=text)
            assert is_read_again(case), ascii(text)


def test_defaults_are_left_out() -> None:
    assert mapping(differential()) == {
        "links": 3,
        "shift_elements": {"F1": [1, 2], "T2": ["housing", 2]},
        "mechanisms": {"D1": {"first": 1, "second": 2, "third": 3, "ratio": -2.5}},
        "gears": {"1": {"engaged": ["F1"]}, "2": {"engaged": ["T2"]}},
    }


def test_everything_else_is_written_in_the_order_of_reading() -> None:
    text = """
name: N
description: D
source: S
links: [sun, ring, carrier]
input: carrier
output: ring
idle: published
coast: true
load: {speed: 2100.0 rpm, torque: 0.5 N*m}
mechanisms:
  D1: {first: sun, second: housing, third: ring, ratio: -2.5, efficiency: 0.9, planet_ratio: -0.5}
  D2: {first: carrier, second: sun, ratio: 2.0}
gears: {R: {speeds: {sun: 2.0}, torques: {carrier: 1.0}, input: carrier, output: sun}}
"""
    expected, written = yaml.safe_load(text), mapping(loads(text))
    assert written == expected
    assert list(written) == list(expected)


def test_yaml_looks_as_one_would_write_it() -> None:
    case = differential(description="Two\nlines\n", gears=[Gear([1], {3: 0.5}), Gear([2])])
    assert (
        write_yaml(case)
        == """\
description: |
  Two
  lines
links: 3
shift_elements:
  F1: [1, 2]
  T2: [housing, 2]
mechanisms:
  D1: {first: 1, second: 2, third: 3, ratio: -2.5}
gears:
  '1': {engaged: [F1], speeds: {3: 0.5}}
  '2': {engaged: [T2]}
"""
    )


def test_json_is_indented_keeps_letters_and_has_the_data_of_yaml() -> None:
    case = differential(name="Дифференциал", coast=True)
    text = write_json(case)
    assert text.startswith('{\n  "name": "Дифференциал",\n  "links": 3,\n')
    assert text.endswith("}\n")
    assert yaml.safe_load(write_yaml(case)) == json.loads(text) == mapping(case)
