"""Torque converters of a case in YAML and JSON."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.commands import vstatics
from vstatics.core.errors import ReadError
from vstatics.core.model.converters import Converter
from vstatics.core.model.open_converters import with_open_converters
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.named.reader import read_json, read_yaml
from vstatics.core.writers.named import write_json, write_yaml

CASE = """links: [engine, turbine, out]
mechanisms: {pair: {first: turbine, second: out, ratio: 2}}
inertias: {engine: 0.4, turbine: 0.2}
converters: {TC: {links: [engine, turbine], points: [[0, 2.5, 3 N*m*s^2], [1, 1, 0]]}}
gears: {"1": {speed_ratios: {TC: 0.6}}}
"""


def loaded(text: str) -> Transmission:
    return read_yaml(text.encode(), "case.yaml").case


def test_a_converter_is_read_with_its_ratio_and_written_as_it_was() -> None:
    case = loaded(CASE)
    assert case.converters == (Converter("TC", 1, 2, ((0.0, 2.5, 3.0), (1.0, 1.0, 0.0))),)
    assert case.gears[0].speed_ratios == {2: 0.6}  # behind the one mechanism
    assert loaded(write_yaml(case)) == case
    assert read_json(write_json(case).encode(), "case.json").case == case


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        ("[engine, turbine], p", "[engine, engine], p", "4:26", "two different links"),
        ("[engine, turbine], p", "[engine, housing], p", "4:35", "a link number from 1 to 3"),
        ("[engine, turbine], p", "[engine, turbin], p", "4:35", "did you mean `turbine`"),
        ("[1, 1, 0]", "[0, 1, 0]", "4:76", "must ascend"),
        ("[1, 1, 0]", "[1, -1, 0]", "4:79", "a torque ratio of 0 or more"),
        ("[1, 1, 0]", "[.9, 1, -2]", "4:83", "a lambda of 0 or more up to i = 1"),
        ("[1, 1, 0]", "[1, 1]", "4:75", "expected 3 numbers"),
        ("converters: {TC", "converters: {pair", "4:14", "`pair` is also the name of a mechanism"),
        ("{TC: 0.6}", "{TK: 0.6}", "5:30", "the name of a mechanism: pair, TC"),
        ("{TC: 0.6}", "{TC: .inf}", "5:34", "expected a number"),
    ],
)
def test_a_fault_is_told_at_its_place(old: str, new: str, place: str, message: str) -> None:
    with pytest.raises(ReadError) as caught:
        loaded(CASE.replace(old, new))
    assert f"case.yaml:{place}: " in str(caught.value)
    assert message in str(caught.value)


def test_a_converter_is_not_written_to_a_deck() -> None:
    from vstatics.core.errors import CaseError
    from vstatics.core.writers.deck_limits import check_deck

    case = loaded(CASE)
    with pytest.raises(CaseError, match="the converter of TC"):
        check_deck(case)


def test_a_mechanism_of_its_kind_with_lambda_is_one_of_them() -> None:
    """Its ratio in a gear is then that of the converter; other mechanisms keep theirs."""
    case = loaded("""links: [engine, turbine, out]
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2.5, 3], [1, 1, 0]]}
  belt: {kind: variator, first: turbine, second: out}
gears: {"1": {speed_ratios: {TC: 0.6, belt: 2}}}
""")
    opened = with_open_converters(case)
    assert [one.name for one in opened.mechanisms] == ["belt"]
    assert opened.converters == (Converter("TC", 1, 2, ((0.0, 2.5, 3.0), (1.0, 1.0, 0.0))),)
    assert opened.gears[0].speed_ratios == {1: 2.0, 2: 0.6}


def test_without_lambda_a_scenario_and_vibration_refuse_it(
    tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(str(tmp_path))
    with open("box.yaml", "w") as file:  # noqa: PTH123
        file.write("""links: [engine, turbine]
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2.5], [1, 1]]}
inertias: {engine: 1, turbine: 1}
gears: {"1": {speed_ratios: {TC: 0.6}}}
""")
    with open("s.yaml", "w") as file:  # noqa: PTH123
        file.write("{case: box.yaml, duration: 1, start: {speeds: {engine: 9, turbine: 1}}}")
    for asked in (["torsion", "modes", "box.yaml"], ["simulate", "s.yaml"]):
        said = vstatics(*asked)
        assert said.fails("box.yaml:3:65: error: ", "TC has no lambda")


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    "asked",
    [
        ["torsion", "modes", "box.yaml"],
        ["torsion", "modes", "box.yaml", "--speed-ratio", "TC=.6"],
        ["simulate", "s.yaml"],
    ],
)
def test_without_a_speed_ratio_it_vibrates_and_moves_as_one_of_converters(asked: list[str]) -> None:
    """Statics cannot be had of it, and says so at the gear."""
    common = """links: [engine, turbine, shaft]
shift_elements: {K: [turbine, shaft]}
inertias: {engine: 0.5, turbine: 0.1, shaft: 2}
gears: {"1": [K]}
load: {speed: 1000 rpm, torque: 5 N*m}
"""
    points = "points: [[0, 2.4, 1.0e-3], [0.5, 1.6, 1.0e-3], [1, 1, 0]]"
    one = f"mechanisms: {{TC: {{kind: converter, first: engine, second: turbine, {points}}}}}\n"
    other = f"converters: {{TC: {{links: [engine, turbine], {points}}}}}\n"
    Path("s.yaml").write_text("""case: box.yaml
duration: 0.5
torques: {engine: 100, shaft: -20}
start: {speeds: {engine: 100, turbine: 20}, engaged: [K]}
""")
    said = []
    for converter in (one, other):
        Path("box.yaml").write_text(common + converter)
        said.append(vstatics(*asked, "-f", "json"))
    assert [(one.status, one.out) for one in said] == [(0, said[1].out)] * 2
    Path("box.yaml").write_text(common + one)
    statics = vstatics("run", "box.yaml")
    assert statics.fails("box.yaml:4:9: error: gears.1: `speed_ratio` of converter TC is missing")
