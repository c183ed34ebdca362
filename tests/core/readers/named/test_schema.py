"""The JSON Schema of a case: up to date, valid, and of one mind with the reader."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from jsonschema import Draft202012Validator

from tests.chance import count
from tests.commands import ROOT
from tests.installed import needs
from tests.strategies import transmissions
from vstatics.core.elements.keys import DRAWN
from vstatics.core.errors import ReadError
from vstatics.core.model.transmission import Gear, Mechanism, Transmission
from vstatics.core.readers.named.reader import read_json
from vstatics.core.readers.named.schema import json_schema
from vstatics.core.writers.named import mapping

VALIDATOR = Draft202012Validator(json_schema())

SAMPLE = """
name: MZKT 7922
links: 6
input: 1
output: 6
idle: published
shift_elements:
  T1: [2, housing]
  F2: [2, 3]
  T3: [3, 0]
  T4: [5, 0]
  F5: [4, 6]
mechanisms:
  D1: {first: 1, second: 2, third: 4, ratio: -0.8, efficiency: 0.94, planet_ratio: 0.9}
  D2: {first: 1, second: 3, third: 4, ratio: 2.6, efficiency: 0.95, planet_ratio: 2.6}
  D3: {first: 4, second: 5, third: 6, ratio: -96/39, efficiency: 0.97}
gears:
  "1": {engaged: [T1, T4]}
  tow: {engaged: [T1], speeds: {"5": 0.5}, torques: {"3": -0.2}}
"""

Change = Callable[[Any], object]


def accepted_by_reader(document: object) -> bool:
    try:
        read_json(json.dumps(document).encode(), "case.json")
    except ReadError:
        return False
    return True


def changed(change: Change) -> Any:
    document = copy.deepcopy(yaml.safe_load(SAMPLE))
    change(document)
    return document


def test_it_is_a_schema() -> None:
    Draft202012Validator.check_schema(json_schema())


@needs("torsion", "vehicle")
@pytest.mark.parametrize("file", sorted((ROOT / "cases").glob("*.yaml")), ids=lambda f: f.name)
def test_shipped_cases_are_valid(file: Path) -> None:
    assert VALIDATOR.is_valid(yaml.safe_load(file.read_text(encoding="utf-8")))


def test_every_key_is_described() -> None:
    schema = json_schema()
    mechanism = schema["properties"]["mechanisms"]["additionalProperties"]
    _, gear = schema["properties"]["gears"]["additionalProperties"]["anyOf"]
    for record in (schema, mechanism, gear):
        assert all(key["description"] for key in record["properties"].values())


def test_defaults_are_those_of_the_model() -> None:
    case = Transmission(2, [], [Mechanism(1, 2, 0, 2)], [Gear()])
    schema = json_schema()
    for model, keys in (
        (case, schema["properties"]),
        (
            case.mechanisms[0],
            schema["properties"]["mechanisms"]["additionalProperties"]["properties"],
        ),
    ):
        for name in keys.keys() - {"drag", "speed_ratio", *(key.name for key in DRAWN)}:
            key = keys[name]
            assert key.get("default", getattr(model, name)) == getattr(model, name)


GOOD: dict[str, Change] = {
    "as it is": lambda c: c,
    "no shift elements": lambda c: c.update(shift_elements=None, gears={"1": None}),
    "no shift elements at all": lambda c: (c.pop("shift_elements"), c.update(gears={"N": {}})),
    "keys left out": lambda c: [c.pop(key) for key in ("name", "input", "output", "idle")],
    "coast": lambda c: c.update(coast=True),
    "links as text": lambda c: c.update(links="6"),
    "link names": lambda c: (
        c.update(links=["1", "2", "3", "4", "5", "out"], output="out")
        or c["shift_elements"].update(F5=[4, "out"])
        or c["mechanisms"]["D3"].update(third="out")
    ),
    "number as text": lambda c: c["mechanisms"]["D1"].update(ratio="-.8E0"),
    "efficiency as fraction": lambda c: c["mechanisms"]["D1"].update(efficiency="19/20"),
    "no planet ratio": lambda c: c["mechanisms"]["D1"].update(planet_ratio=None),
    "ends of a gear": lambda c: c["gears"]["tow"].update(input=6, output="1"),
    "kinds": lambda c: c["shift_elements"].update(
        T1={"kind": "brake", "links": [2]},
        F2={"links": [2, 3], "drag": "1/100"},
        T3={"kind": None, "links": [3, "housing"], "drag": None},
        L={"kind": "freewheel", "links": [4, 0]},
        K={"links": [4, 5], "capacity": "7/2"},
    ),
    "drag": lambda c: c["gears"]["1"].update(drag={"5": 0.1}, open_drag={"F2": "1/50", "T3": 0}),
    "worm": lambda c: c["mechanisms"]["D1"].update(back_efficiency=0),
    "inertias": lambda c: c.update(inertias={"1": 0.15, "5": "150 kg*cm^2", "6": "84e-5"}),
    "springs": lambda c: c.update(
        springs={
            "shaft": {"links": [1, 2], "compliance": 84e-5, "damping": 3.2},
            "support": {"links": [4], "stiffness": "9 kN*m/rad", "damping": {"ratio": 0.02}},
            "axle": {"twist": {"1": 1, "3": "-1/2", "4": -1}, "stiffness": "9e4"},
        }
    ),
    "springs alone": lambda c: (
        c.clear(),
        c.update(springs={"s": {"links": ["a"], "stiffness": 3}}),
    ),
    "springs without gears": lambda c: (
        c.pop("gears"),
        c.update(springs={"s": {"links": [1, 2], "stiffness": 3}}),
    ),
    "no springs": lambda c: c.update(springs={}, inertias={}),
    "springs null": lambda c: c.update(springs=None, inertias=None),
    "elastic devices": lambda c: (
        c["shift_elements"].update(T1={"links": [2], "stiffness": 1e5, "damping": {"viscous": 3}}),
        c["mechanisms"]["D1"].update(stiffness=9e4, damping={"loss_factor": 0.1}),
    ),
    "texts": lambda c: c.update(name=7922, description="two\nlines", source=""),
}

BAD: dict[str, Change] = {
    "unknown key": lambda c: c.update(gaers={}),
    "unknown key of a mechanism": lambda c: c["mechanisms"]["D1"].update(ratoi=1),
    "unknown key of a gear": lambda c: c["gears"]["1"].update(engage=[]),
    "links missing": lambda c: c.pop("links"),
    "mechanisms missing": lambda c: c.pop("mechanisms"),
    "mechanisms null": lambda c: c.update(mechanisms=None),
    "gears missing": lambda c: c.pop("gears"),
    "gears empty": lambda c: c.update(gears={}),
    "gears a list": lambda c: c.update(gears=[]),
    "gear a word": lambda c: c["gears"].update({"1": "T1"}),
    "empty name of a gear": lambda c: c["gears"].update({"": {}}),
    "one link": lambda c: c.update(links=1),
    "links a word": lambda c: c.update(links="six"),
    "links with a list inside": lambda c: c.update(links=[["a"], "b"]),
    "idle": lambda c: c.update(idle="publish"),
    "coast": lambda c: c.update(coast="true"),
    "name a list": lambda c: c.update(name=[]),
    "negative link": lambda c: c["mechanisms"]["D1"].update(first=-1),
    "link 1.5": lambda c: c["mechanisms"]["D1"].update(first=1.5),
    "one end": lambda c: c["shift_elements"].update(T1=[2]),
    "three ends": lambda c: c["shift_elements"].update(T1=[2, 0, 0]),
    "ends not a list": lambda c: c["shift_elements"].update(T1=2),
    "ratio missing": lambda c: c["mechanisms"]["D1"].pop("ratio"),
    "ratio 0": lambda c: c["mechanisms"]["D1"].update(ratio=0),
    "ratio a word": lambda c: c["mechanisms"]["D1"].update(ratio="abc"),
    "ratio with underscore": lambda c: c["mechanisms"]["D1"].update(ratio="1_0"),
    "ratio a list": lambda c: c["mechanisms"]["D1"].update(ratio=[1]),
    "ratio null": lambda c: c["mechanisms"]["D1"].update(ratio=None),
    "efficiency back above 1": lambda c: c["mechanisms"]["D1"].update(back_efficiency=1.5),
    "element without links": lambda c: c["shift_elements"].update(T1={"kind": "brake"}),
    "element of three links": lambda c: c["shift_elements"].update(T1={"links": [1, 2, 3]}),
    "element of an unknown kind": lambda c: c["shift_elements"].update(
        T1={"kind": "ratchet", "links": [2]}
    ),
    "drag of an element below 0": lambda c: c["shift_elements"].update(
        T1={"links": [2], "drag": -1}
    ),
    "capacity 0": lambda c: c["shift_elements"].update(T1={"links": [2], "capacity": 0}),
    "drag below 0": lambda c: c["gears"]["1"].update(drag={"5": -0.1}),
    "open drag a list": lambda c: c["gears"]["1"].update(open_drag=[1]),
    "efficiency 0": lambda c: c["mechanisms"]["D1"].update(efficiency=0),
    "efficiency above 1": lambda c: c["mechanisms"]["D1"].update(efficiency=94),
    "planet ratio 0": lambda c: c["mechanisms"]["D1"].update(planet_ratio=0),
    "engaged not a list": lambda c: c["gears"]["1"].update(engaged="T1"),
    "engaged twice": lambda c: c["gears"]["1"].update(engaged=["T1", "T1"]),
    "speeds a list": lambda c: c["gears"]["1"].update(speeds=[1]),
    "no springs and no gears": lambda c: (c.pop("gears"), c.update(springs={})),
    "springs null and no gears": lambda c: (c.pop("gears"), c.update(springs=None)),
    "springs a list": lambda c: c.update(springs=[]),
    "a spring a number": lambda c: c.update(springs={"s": 474}),
    "stiffness 0": lambda c: c.update(springs={"s": {"links": [1], "stiffness": 0}}),
    "compliance below 0": lambda c: c.update(springs={"s": {"links": [1], "compliance": -1}}),
    "damping below 0": lambda c: c.update(
        springs={"s": {"links": [1], "stiffness": 1, "damping": {"ratio": -1}}}
    ),
    "damping a list": lambda c: c.update(
        springs={"s": {"links": [1], "stiffness": 1, "damping": [1]}}
    ),
    "a spring of no links": lambda c: c.update(springs={"s": {"links": [], "stiffness": 1}}),
    "a twist of words": lambda c: c.update(springs={"s": {"twist": {"1": "up"}, "stiffness": 1}}),
    "an inertia below 0": lambda c: c.update(inertias={"1": -1}),
    "an inertia a word": lambda c: c.update(inertias={"1": "heavy"}),
    "inertias a list": lambda c: c.update(inertias=[1, 2]),
    "stiffness of a mechanism 0": lambda c: c["mechanisms"]["D1"].update(stiffness=0),
    "torque a word": lambda c: c["gears"]["1"].update(torques={"5": "large"}),
}


@pytest.mark.parametrize("name", GOOD)
def test_good_documents_are_accepted_by_both(name: str) -> None:
    document = changed(GOOD[name])
    assert accepted_by_reader(document)
    assert VALIDATOR.is_valid(document)


@pytest.mark.parametrize("name", BAD)
def test_bad_documents_are_refused_by_both(name: str) -> None:
    document = changed(BAD[name])
    assert not accepted_by_reader(document)
    assert not VALIDATOR.is_valid(document)


@settings(max_examples=count(8, 60))
@given(transmissions(torsional=True))
def test_written_cases_are_valid(case: Transmission) -> None:
    document = json.loads(json.dumps(mapping(case)))
    assert VALIDATOR.is_valid(document)
