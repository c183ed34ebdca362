"""Torque converters of a case in YAML and JSON."""

from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.core.writers.again import is_read_again
from vstatics import loads
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.model.converters import Converter
from vstatics.core.model.open_converters import with_open_converters
from vstatics.core.writers.deck_limits import check_deck

CASE = """links: [engine, turbine, out]
mechanisms: {pair: {first: turbine, second: out, ratio: 2}}
inertias: {engine: 0.4, turbine: 0.2}
converters: {TC: {links: [engine, turbine], points: [[0, 2.5, 3 N*m*s^2], [1, 1, 0]]}}
gears: {"1": {speed_ratios: {TC: 0.6}}}
"""


def test_a_converter_is_read_with_its_ratio_and_written_as_it_was() -> None:
    case = loads(CASE)
    assert case.converters == (Converter("TC", 1, 2, ((0.0, 2.5, 3.0), (1.0, 1.0, 0.0))),)
    assert case.gears[0].speed_ratios == {2: 0.6}  # behind the one mechanism
    assert is_read_again(case)
    assert loads(CASE.replace("[1, 1, 0]", "[1, 1, -2]")).converters[0].points[1] == (1, 1, -2)
    with pytest.raises(CaseError, match="the converter of TC"):
        check_deck(case)


FAULTS = {
    ("[engine, turbine], p", "[engine, engine], p"): "4:26: .*two different links",
    ("[engine, turbine], p", "[engine, housing], p"): "4:35: .*a link number from 1 to 3",
    ("[engine, turbine], p", "[engine, turbin], p"): "4:35: .*did you mean `turbine`",
    ("[1, 1, 0]", "[0, 1, 0]"): "4:76: .*must ascend",
    ("[1, 1, 0]", "[1, -1, 0]"): "4:79: .*a torque ratio of 0 or more",
    ("[1, 1, 0]", "[.9, 1, -2]"): "4:83: .*a lambda of 0 or more up to i = 1",
    ("[1, 1, 0]", "[1, 1]"): "4:75: .*expected 3 numbers",
    ("converters: {TC", "converters: {pair"): "4:14: .*`pair` is also the name of a mechanism",
    ("{TC: 0.6}", "{TK: 0.6}"): "5:30: .*the name of a mechanism: pair, TC",
    ("{TC: 0.6}", "{TC: .inf}"): "5:34: .*expected a number",
}


def test_a_fault_is_reported_at_its_place() -> None:
    for change, said in FAULTS.items():
        with pytest.raises(ReadError, match=f":{said}"):
            loads(CASE.replace(*change))


def test_a_mechanism_of_its_kind_with_lambda_is_one_of_them() -> None:
    """Its ratio in a gear is then that of the converter; other mechanisms keep theirs."""
    case = loads("""links: [engine, turbine, out]
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2.5, 3], [1, 1, 0]]}
  belt: {kind: variator, first: turbine, second: out}
gears: {"1": {speed_ratios: {TC: 0.6, belt: 2}}}
""")
    opened = with_open_converters(case)
    assert [one.name for one in opened.mechanisms] == ["belt"]
    assert opened.converters == loads(CASE).converters
    assert opened.gears[0].speed_ratios == {1: 2.0, 2: 0.6}


SCENARIO = "{case: box.yaml, duration: .5, start: {speeds: {engine: 9, turbine: 1}}}"
BOX = """links: [engine, turbine]
%s
inertias: {engine: 1, turbine: 1}
gears: {"1": {}}
load: {speed: 1000 rpm, torque: 5 N*m}
"""
POINTS = "points: [[0, 2.4, 1.0e-3], [0.5, 1.6, 1.0e-3], [1, 1, 0]]"


@pytest.mark.parametrize("asked", ["torsion modes box.yaml", "simulate s.yaml"])
def test_without_a_speed_ratio_lambda_moves_a_converter(asked: str, folder: Path) -> None:
    """Without lambda, both commands fail."""
    (folder / "s.yaml").write_text(SCENARIO)
    mechanism = "mechanisms: {TC: {kind: converter, first: engine, second: turbine, %s}}"
    opened = f"converters: {{TC: {{links: [engine, turbine], {POINTS}}}}}"
    said = []
    for converter in (mechanism % POINTS, opened):
        (folder / "box.yaml").write_text(BOX % converter)
        said.append(vstatics(*asked.split(), "-f", "json"))
    assert [(one.status, one.out) for one in said] == [(0, said[1].out)] * 2
    text = BOX.replace("{}}", "{speed_ratios: {TC: 0.6}}}")
    (folder / "box.yaml").write_text(text % (mechanism % "points: [[0, 2.5], [1, 1]]"))
    assert vstatics(*asked.split()).fails("box.yaml:2:", "TC has no lambda")
