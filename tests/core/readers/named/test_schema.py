"""The JSON Schema of a case: up to date, valid, and of one mind with the reader."""

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from jsonschema import Draft202012Validator

from tests.chance import count
from tests.commands import CASES
from tests.installed import needs
from tests.strategies import transmissions
from vstatics.core import readers
from vstatics.core.elements.keys import DRAWN
from vstatics.core.errors import ReadError
from vstatics.core.model.transmission import Gear, Mechanism, Transmission
from vstatics.core.readers.named.schema import json_schema
from vstatics.core.writers.named import mapping

VALIDATOR = Draft202012Validator(json_schema())


def changed(line: str) -> Any:
    """The MZKT 7922 with other values at paths; a path alone is left out, `all` is the case."""
    document = yaml.safe_load((CASES / "mzkt7922.yaml").read_text("utf-8"))
    document["gears"]["tow"] = {"engaged": ["T1"], "speeds": {"5": 0.5}, "torques": {"3": -0.2}}
    for change in line.split(" & "):
        path, _, text = change.strip().partition(": ")
        *above, last = path.split(".")
        place = document
        for key in above:
            place = place[key]
        if path == "all":
            document = yaml.safe_load(text)
        elif text:
            place[last] = yaml.safe_load(text)
        else:
            del place[last]
    return document


def is_read(document: object) -> bool:
    try:
        readers.read(json.dumps(document).encode(), "case.json")
    except ReadError:
        return False
    return True


GOOD = r"""
name: 7922 & description: "two\nlines" & source: ""
name & input & output & idle
shift_elements: null & gears: {"1": null}
shift_elements & gears: {N: {}}
coast: true
links: "6"
links: ["1", "2", "3", "4", "5", out] & output: out & shift_elements.F5: [4, out]
    & mechanisms.D3.third: out
mechanisms.D1.ratio: "-.8E0" & mechanisms.D1.efficiency: 19/20
mechanisms.D1.planet_ratio: null & mechanisms.D1.back_efficiency: 0
gears.tow.input: 6 & gears.tow.output: "1"
shift_elements.T1: {kind: brake, links: [2, 0]} & shift_elements.F2: {links: [2, 3], drag: 1/100}
shift_elements.T3: {kind: null, links: [3, housing], drag: null}
shift_elements.L: {kind: freewheel, links: [4, 0]}
shift_elements.K: {links: [4, 5], capacity: 7/2}
gears.1.drag: {"5": 0.1} & gears.1.open_drag: {F2: 1/50, T3: 0}
inertias: {"1": 0.15, "5": 150 kg*cm^2, "6": "84e-5"}
springs: {shaft: {links: [1, 2], compliance: 84.0e-5, damping: 3.2}}
springs: {s: {links: [4], stiffness: 9 kN*m/rad, damping: {ratio: 0.02}}}
springs: {axle: {twist: {"1": 1, "3": -1/2, "4": -1}, stiffness: "9e4"}}
all: {springs: {s: {links: [a], stiffness: 3}}}
gears & springs: {s: {links: [1, 2], stiffness: 3}}
springs: {} & inertias: {}
springs: null & inertias: null
shift_elements.T1: {links: [2, 0], stiffness: 100000, damping: {viscous: 3}}
mechanisms.D1.stiffness: 90000 & mechanisms.D1.damping: {loss_factor: 0.1}
"""
BAD = """
gaers: {}
mechanisms.D1.ratoi: 1
gears.1.engage: []
links
mechanisms | mechanisms: null
gears | gears: {} | gears: [] | gears.1: T1 | gears: {"": {}}
links: 1 | links: six | links: [[a], b]
idle: publish
coast: "true"
name: []
mechanisms.D1.first: -1 | mechanisms.D1.first: 1.5
shift_elements.T1: [2] | shift_elements.T1: [2, 0, 0] | shift_elements.T1: 2
mechanisms.D1.ratio | mechanisms.D1.ratio: 0 | mechanisms.D1.ratio: abc
mechanisms.D1.ratio: "1_0" | mechanisms.D1.ratio: [1] | mechanisms.D1.ratio: null
mechanisms.D1.back_efficiency: 1.5 | mechanisms.D1.efficiency: 0 | mechanisms.D1.efficiency: 94
mechanisms.D1.planet_ratio: 0 | mechanisms.D1.stiffness: 0
shift_elements.T1: {kind: brake} | shift_elements.T1: {links: [1, 2, 3]} | shift_elements.T1: {links: [2]}
shift_elements.T1: {kind: ratchet, links: [2, 0]}
shift_elements.T1: {links: [2, 0], drag: -1} | shift_elements.T1: {links: [2, 0], capacity: 0}
gears.1.drag: {"5": -0.1} | gears.1.open_drag: [1] | gears.1.engaged: T1
gears.1.engaged: [T1, T1] | gears.1.speeds: [1] | gears.1.torques: {"5": large}
gears & springs: {} | gears & springs: null
springs: [] | springs: {s: 474} | springs: {s: {links: [1], stiffness: 0}}
springs: {s: {links: [1], compliance: -1}}
springs: {s: {links: [1], stiffness: 1, damping: {ratio: -1}}}
springs: {s: {links: [1], stiffness: 1, damping: [1]}} | springs: {s: {links: [], stiffness: 1}}
springs: {s: {twist: {"1": up}, stiffness: 1}}
inertias: {"1": -1} | inertias: {"1": heavy} | inertias: [1, 2]
"""


@pytest.mark.parametrize(("table", "is_good"), [(GOOD, True), (BAD, False)], ids=["good", "bad"])
def test_schema_and_reader_accept_the_same_documents(table: str, *, is_good: bool) -> None:
    lines = table.replace("\n    ", " ").strip().replace(" | ", "\n").splitlines()
    documents = {line: changed(line) for line in lines}
    expected = (is_good, is_good)
    said = {line: (is_read(one), VALIDATOR.is_valid(one)) for line, one in documents.items()}
    assert said == dict.fromkeys(lines, expected)


@needs("torsion", "vehicle")
@pytest.mark.parametrize("file", sorted(CASES.glob("*.yaml")), ids=lambda f: f.name)
def test_shipped_cases_are_valid(file: Path) -> None:
    assert VALIDATOR.is_valid(yaml.safe_load(file.read_text("utf-8")))


@settings(max_examples=count(8, 60))
@given(transmissions(torsional=True))
def test_written_cases_are_valid(case: Transmission) -> None:
    document = json.loads(json.dumps(mapping(case)))
    assert VALIDATOR.is_valid(document)


def test_it_is_a_schema_that_describes_every_key_and_has_the_defaults_of_the_model() -> None:
    schema = json_schema()
    Draft202012Validator.check_schema(schema)
    mechanism = schema["properties"]["mechanisms"]["additionalProperties"]
    _, gear = schema["properties"]["gears"]["additionalProperties"]["anyOf"]
    for record in (schema, mechanism, gear):
        assert all(key["description"] for key in record["properties"].values())
    case = Transmission(2, [], [Mechanism(1, 2, 0, 2)], [Gear()])
    for model, record in ((case, schema), (case.mechanisms[0], mechanism)):
        keys = record["properties"]
        for name in keys.keys() - {"drag", "speed_ratio", *(key.name for key in DRAWN)}:
            assert keys[name].get("default", getattr(model, name)) == getattr(model, name)
