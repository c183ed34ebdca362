"""Clutches that are dumped in cases: read, written, in the schema; what is wrong with them."""

import json
import math
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator

from tests.commands import ROOT, json_file
from vstatics import ClutchDump, ReadError, Transmission, loads
from vstatics.core.writers import named
from vstatics.core.writers.deck import lost

WITHOUT = """\
inertias: {engine: 0.14, disc: 0.0044, shaft: 0.01, wheels: 1.7, vehicle: 105}
springs:
  half-shafts: {links: [shaft, wheels], compliance: 4e-3}
  tyres: {links: [wheels, vehicle], compliance: 3e-4}
mechanisms: {box: {first: disc, second: shaft, ratio: 3.75}}
shift_elements: {clutch: [engine, disc]}
gears: {I: [clutch]}
dump: {%s}
"""
DUMP = (
    "J1: [engine], J2: [disc], J3: [shaft], J4: [wheels], J5: [vehicle], "
    "M_C0: 142, M_phi: 1.4 kN*m, omega1: 586, to: shaft"
)
CASE = WITHOUT % DUMP


def test_a_dump_is_read_by_links() -> None:
    case = loads(CASE)
    names = ["shaft", "wheels", "vehicle", "disc", "engine"]
    assert list(case.link_names) == names
    assert case.dump == ClutchDump((5,), (4,), (1,), (2,), (3,), 142.0, 586.0, 1400.0, to=1)


def test_what_may_be_left_out() -> None:
    dump = "J1: [engine], J2: [disc], J5: [vehicle], M_C0: 142, omega1: 5596 rpm"
    made = ClutchDump.of(loads(WITHOUT % dump))
    assert made is not None
    assert (made.J3, made.J4, made.M_phi, made.E, made.to) == ((), (), math.inf, None, None)
    assert made.omega1 == pytest.approx(586, rel=1e-3)
    assert made.link == made.J2[0]


def test_it_comes_back_from_what_is_written() -> None:
    for torque in ("M_phi: 1.4 kN*m", "M_phi: .inf", "M_phi: null", "M_phi: 1, E: 84e-5"):
        case = loads(CASE.replace("M_phi: 1.4 kN*m", torque))
        for text in (named.write_yaml(case), named.write_json(case)):
            assert loads(text) == case
            assert "inf" not in text.lower()
        assert Transmission.from_dict(named.mapping(case)) == case
        assert "dump" in lost(case)
        assert "dump" not in lost(case.replace(dump=None))


def test_the_schema_takes_what_is_read_and_written() -> None:
    schema = json_file(ROOT / "schemas" / "case.schema.json")
    validator: Any = Draft202012Validator(schema)
    validator.validate(yaml.safe_load(CASE))
    validator.validate(yaml.safe_load(CASE.replace("1.4 kN*m", ".inf")))
    validator.validate(json.loads(named.write_json(loads(CASE))))
    assert not validator.is_valid(yaml.safe_load(CASE.replace("[engine],", "[],")))
    assert not validator.is_valid(yaml.safe_load(CASE.replace("M_C0: 142", "M_C0: 0")))
    assert not validator.is_valid(yaml.safe_load(CASE.replace("M_C0: 142, ", "")))


def test_what_is_wrong_is_told_with_its_place() -> None:
    for old, new, at, message in (
        (f"{{{DUMP}}}", "[1]", "[1]", "dump: read a list, expected a mapping with `J1`, `J2`"),
        ("[engine]", "[engin]", "engin]", "dump.J1[1]: read 'engin', expected the name of a link"),
        ("[engine]", "[housing]", "hous", "dump.J1[1]: read 0 (the housing), expected a link"),
        ("[engine]", "engine", "engine", "dump.J1: read 'engine', expected a list of links"),
        ("[engine]", "[]", "[]", "dump.J1: read no link, expected at least one"),
        ("[shaft]", "[shaft, disc]", "disc], J4", "dump.J3[2]: link disc is already in J2, "),
        ("[shaft]", "[shaft, shaft]", "shaft], J4", "dump.J3[2]: link shaft is already in J3"),
        ("J1: [engine], ", "", "{J2", "`J1` is missing"),
        ("M_C0", "M_C", "M_C:", "unknown key `M_C`; did you mean `M_C0`?"),
        ("142", "0", "0, M", "dump.M_C0: read 0, expected a number above 0"),
        ("142", ".inf", ".inf", "dump.M_C0: read '.inf', expected a torque in N*m"),
        ("142", "142 rpm", "142 rpm", "dump.M_C0: read '142 rpm', expected a torque in N*m, bare"),
        ("1.4 kN*m", "-.inf", "-.inf", "dump.M_phi: read '-.inf', expected a torque in N*m"),
        ("1.4 kN*m", "0", "0, omega1", "dump.M_phi: read 0, expected a number above 0"),
        ("586", "-5", "-5", "dump.omega1: read -5, expected a number above 0"),
        ("to: shaft", "E: 0", "0}", "dump.E: read 0, expected a number above 0"),
        ("to: shaft", "to: shift", "shift", "dump.to: read 'shift', expected the name of a link"),
        ("to: shaft", "to: 0", "0}", "dump.to: read 0 (the housing), expected a link number from"),
        ("to: shaft", "E: 1 N*m/rad", "1 N", "dump.E: read '1 N*m/rad', expected a compliance in"),
    ):
        start = CASE.index("dump:")
        text = CASE[:start] + CASE[start:].replace(old, new, 1)
        with pytest.raises(ReadError) as caught:
            loads(text)
        [problem] = caught.value.problems
        assert message in str(problem)
        assert problem.place is not None
        assert problem.place.text[problem.place.column - 1 :].startswith(at)


def test_a_dump_in_a_drawn_case() -> None:
    case = loads("""\
elements:
  set: {kind: planetary, sun: disc, ring: housing, carrier: shaft, teeth: {sun: 30, ring: 60}}
shift_elements: {clutch: [engine, disc]}
gears: {1: [clutch]}
input: engine
output: shaft
dump: {J1: [engine], J2: [disc], J5: [shaft], M_C0: 200, omega1: 400}
""")
    assert loads(named.write_yaml(case)) == case
    made = ClutchDump.of(case)
    assert made is not None
    assert [case.link_name(links[0]) for links in (made.J1, made.J5)] == ["engine", "shaft"]
