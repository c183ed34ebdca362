"""Drags without a unit that seem to be in N*m: beside such with a unit, or above 0.05."""

import json
from random import Random
from typing import Any

from tests.chance import count, seeded
from tests.commands import vstatics
from vstatics.core.readers import read

UNITS = ("2 N*m", "0.05*w", "1 + 0.01*w", "1", [[0, 0], [200, 3]], [["0 rpm", "1 N*m"]])
"""Drags in N*m; the text `"1"` is a bare number."""
SMALL, LARGE, NONE = (0.002, 0.05, "1/100"), (0.0501, 3, "0.3", "1"), (0, "0")


def random_table(chance: Random, owners: list[str], bare_ones: set[str]) -> dict[str, Any]:
    """A table of drags; owners that are to be warned about are added to a set."""
    kinds = {owner: chance.choice(("unit", "small", "large", "none")) for owner in owners}
    if chance.random() < 0.5:  # else hardly any table is without a warning
        kind = chance.choice(("unit", "small"))
        kinds = dict.fromkeys(owners, kind)
    units = [one for one in UNITS if one != "1"]
    forms = {"unit": units, "small": SMALL, "large": LARGE, "none": NONE}
    mixed = "unit" in kinds.values()
    doubtful = ("large", "small") if mixed else ("large",)
    bare_ones |= {owner for owner, kind in kinds.items() if kind in doubtful}
    return {owner: chance.choice(forms[kind]) for owner, kind in kinds.items()}


def test_exactly_such_drags_are_named() -> None:
    """Links of the case, links of a gear, shift elements, open shift elements of a gear."""
    chance, quiet, examples = seeded(46), 0, count(120, 3000)
    for _ in range(examples):
        expected: list[set[str]] = [set(), set(), set(), set()]
        links = chance.sample(["a", "b", "c"], chance.randint(0, 3))
        of_elements = random_table(chance, ["C", "D", "E"], expected[1])
        ends = {"C": ["a", "b"], "D": ["b", "c"], "E": ["c", "housing"]}
        data = {
            "links": ["a", "b", "c"],
            "load": {"speed": "1000 rpm", "torque": chance.choice(("200 N*m", "-20 N*m"))},
            "drag": random_table(chance, links, expected[0]),
            "shift_elements": {n: {"links": ends[n], "drag": of_elements[n]} for n in of_elements},
            "mechanisms": {"s": {"first": "a", "second": "b", "third": "c", "ratio": -2}},
            "gears": {
                "low": {
                    "engaged": ["E"],
                    "drag": random_table(chance, ["a", "c"], expected[2]),
                    "open_drag": random_table(chance, ["C"], expected[3]),
                }
            },
        }
        warnings = read(json.dumps(data).encode(), "case.json").warnings
        told = [one for one in warnings if one.id == "W440"]
        at = [one.message.partition(":")[0] for one in told]
        heads = ("drag.{}", "shift_elements.{}.drag", "gears.low.drag.{}", "gears.low.open_drag.{}")
        pairs = zip(heads, expected, strict=True)
        wanted = {head.format(name) for head, names in pairs for name in names}
        assert set(at) == wanted, data
        assert len(at) == len(wanted)
        quiet += not wanted
    assert quiet > examples / 50


BARE = """\
links: [a, b]
load: {speed: 1000 rpm, torque: 200 N*m}
drag: {a: "1 + 0.01*w", b: 0.3}
mechanisms: {g: {first: a, second: b, ratio: 2}}
gears: {"1": []}
"""


def test_the_warning_has_the_place_and_the_torque() -> None:
    """0.3 of 200 N*m are 60 N*m."""
    said = vstatics("run", "-", stdin=BARE.encode())
    assert said.status == 0
    assert said.err.count("3:25: warning: drag.b: the drag of b has no unit") == 1
    assert "0.3 of the input torque, 60 N*m; if it is meant in N*m, write `0.3 N*m`" in said.err
    allowed = vstatics("run", "-", "--allow", "W440", stdin=BARE.encode())
    assert "W440" not in allowed.all
    assert "has no unit" not in allowed.all


def test_a_slip_far_beyond_the_input_speed_probably_lacks_its_unit() -> None:
    """Up to 5 times the input speed is possible, for example if the load turns backward."""
    text = BARE.replace('drag: {a: "1 + 0.01*w", b: 0.3}', "shift_elements: {C: [a, housing]}")
    text = text.replace('"1": []', "low: {slip: {C: SLIP}}")
    for slip, size in (("60", "60 times the input speed, 60000 rpm; if"), ("-5.1", "-5.1 times")):
        [said] = read(text.replace("SLIP", slip).encode(), "case.yaml").warnings
        assert said.message.startswith("gears.low.slip.C: ")
        assert f"the slip of C has no unit, so it is {size}" in said.message
        assert said.id == "W440"
    for slip in ("5", "-1.3", "900 rpm"):
        assert not read(text.replace("SLIP", slip).encode(), "case.yaml").warnings
