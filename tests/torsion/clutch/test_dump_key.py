"""Dumped clutches in files and in cases: reading, writing, and faults."""

import json
import math
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator

from tests.commands import ROOT, json_file
from tests.rejects import rejects
from tests.torsion.book import TABLE_3_8
from vstatics import ClutchDump, ReadError, Transmission, loads
from vstatics.core.writers import named
from vstatics.core.writers.deck import lost
from vstatics.torsion.clutch.file import read_dump

GOOD = """\
J1: 16.6
J2: 0.538
J3: 0.716
J4: 1.36
J5: 58.3
E: 71.3e-5
M_C0: 3362
M_phi: 3760
omega1: 81.7
"""
"""ЗИЛ-130 in gear II, Tsitovich, Algin, Vehicle dynamics (1981), table 3.7."""


def test_numbers_are_read_as_they_are_written_also_with_units() -> None:
    """ЗИЛ-130, also with an engine at 780.2 rpm of the propshaft."""
    [line] = [one for one in TABLE_3_8 if (one.vehicle, one.gear) == ("ЗИЛ-130", 2)]
    assert read_dump(GOOD.encode(), "dump.yaml").given == line.given
    other = GOOD.replace("71.3e-5", "84e-5").replace("3362", "9e4").replace("16.6", "83/5")
    given = read_dump(other.encode(), "dump.yaml").given
    assert (given.E, given.M_C0, given.J1) == (84e-5, 9e4, 16.6)
    text = GOOD.replace("16.6", "166000 kg*cm^2").replace("71.3e-5", "0.713 rad/(kN*m)")
    text = text.replace("3362", "3.362 kN*m").replace("81.7", f"{81.7 * 30 / math.pi} rpm")
    made = read_dump(text.encode(), "dump.yaml").given
    assert made == pytest.approx(line.given)


def test_a_fault_is_reported_with_its_place() -> None:
    for old, new, message in (
        ("J1: 16.6", "J1: 0", "1:5: error: J1: read 0, expected a number above 0"),
        ("J3: 0.716", "J3: -1", "3:5: error: J3: read -1, expected a number of 0 or more"),
        ("E: 71.3e-5", "E: .nan", "6:4: error: E: read '.nan', expected a compliance"),
        ("E: 71.3e-5", "E: 1e999", "6:4: error: E: "),
        ("E: 71.3e-5", "E:", "6:3: error: E: read nothing, expected a compliance"),
        ("J4: 1.36", "J4: -.inf", "4:5: error: J4: read '-.inf', expected an inertia"),
        ("3760", "3760 kg", "8:8: error: M_phi: read '3760 kg', expected a torque in N*m, bare"),
        ("J2: 0.538\n", "", "1:1: error: `J2` is missing"),
        ("omega1", "omega", "9:1: error: unknown key `omega`; did you mean `omega1`?"),
        ("J1: 16.6", "J2: 1", "J2"),
        (GOOD, "[1, 2]", "1:1: error: read a list, expected a clutch that is dumped"),
        (GOOD, "", "the file is empty, expected a clutch that is dumped"),
    ):
        with rejects(ReadError, message):
            read_dump(GOOD.replace(old, new).encode(), "dump.yaml")


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


def test_what_is_wrong_is_reported_with_its_place() -> None:
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
