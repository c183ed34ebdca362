"""Numbers that nothing has are refused where they stand."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.commands import vstatics

CASE = """\
links: [in, out]
inertias: {in: 1, out: 2}
shift_elements: {C: {links: [in, out], capacity: 60 N*m}}
springs: {S: {links: [out, housing], stiffness: 1e3, damping: 0.1}}
gears: {"1": [C]}
"""
SCENARIO = """\
case: case.yaml
duration: 1
start: {speeds: {in: 30, out: 0}}
controls: {C: [[0, 10], [.5, 20]]}
torques: {in: 15, out: {road: {mass: 100, radius: .3}}}
"""


@pytest.mark.parametrize(
    ("old", "new", "read"),
    [
        ("in: 1,", "in: 1e20,", "1e+20"),
        ("out: 2}", "out: 1e-40}", "1e-40"),
        ("capacity: 60", "capacity: 6e60", "6e+60"),
        ("stiffness: 1e3", "stiffness: 1e98", "1e+98"),
        ("damping: 0.1", "damping: 1e-98", "1e-98"),
        ("duration: 1", "duration: 1e-90", "1e-90"),
        ("in: 30", "in: 3e30", "3e+30"),
        ("[.5, 20]", "[.5, 1e-30]", "1e-30"),
        ("in: 15", "in: 15e90", "1.5e+91"),
        ("radius: .3", "radius: 3e16", "3e+16"),
        ("in: 15", 'in: "1e20*(t > 1)"', "1e+20"),
        ("in: 15", 'in: "-15*sign(speed - 1e-200)"', "1e-200"),
        ("C: [[0, 10], [.5, 20]]", 'C: "10 + 1e-40*t"', "1e-40"),
    ],
)
def test_a_number_that_nothing_has(tmp_path: Path, old: str, new: str, read: str) -> None:
    """Told at its key or right there."""
    places = set()
    for name, text in (("case.yaml", CASE), ("scenario.yaml", SCENARIO)):
        changed = text.replace(old, new)
        (tmp_path / name).write_text(changed)
        for number, line in enumerate(changed.splitlines(), 1):
            if new in line:
                at = line.index(new)
                columns = at, at + new.index(" ") + 1
                places |= {f"{tmp_path}/{name}:{number}:{column + 1}: error" for column in columns}
    said = vstatics("simulate", tmp_path / "scenario.yaml")
    assert said.status == 1
    [first, *_] = said.err.splitlines()
    assert first.partition(": error")[0] + ": error" in places
    assert f"read {read}, expected " in first


def test_inertias_that_are_unlike(tmp_path: Path) -> None:
    """1e-12 of the largest: its speed would have no certain digit."""
    (tmp_path / "case.yaml").write_text(CASE.replace("in: 1,", "in: 1e-13,"))
    (tmp_path / "scenario.yaml").write_text(SCENARIO)
    said = vstatics("simulate", tmp_path / "scenario.yaml")
    assert "case.yaml:2:12: error: inertias.in: read 1e-13, expected at least" in said.err
    assert "the largest inertia, 2: leave it out" in said.err


@pytest.mark.parametrize("law", ["1/0", '"1/0"', '"0/0"', '"15/(t - t)"', '"exp(1e4)"'])
def test_a_torque_that_is_no_number(tmp_path: Path, law: str) -> None:
    (tmp_path / "case.yaml").write_text(CASE)
    (tmp_path / "scenario.yaml").write_text(SCENARIO.replace("in: 15", f"in: {law}"))
    said = vstatics("simulate", tmp_path / "scenario.yaml", "-f", "json")
    assert said.fails(f"{tmp_path}/scenario.yaml:5:11: error: torques.in: ", ", expected a number")


def test_check_tells_a_constant_that_is_no_number(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE)
    (tmp_path / "scenario.yaml").write_text(SCENARIO.replace("in: 15", 'in: "15/(1 - 1)"'))
    said = vstatics("check", tmp_path / "scenario.yaml")
    assert said.fails("scenario.yaml:5:11: error: torques.in: read `15/(1 - 1)`, which is inf")


@pytest.mark.parametrize("law", ["10^20*(t > .5)", "exp(100*t)", "1/(.5 - t)^9"])
def test_a_torque_that_becomes_larger_than_any(tmp_path: Path, law: str) -> None:
    (tmp_path / "case.yaml").write_text(CASE)
    (tmp_path / "scenario.yaml").write_text(SCENARIO.replace("in: 15", f'in: "{law}"'))
    said = vstatics("simulate", tmp_path / "scenario.yaml", "-f", "json")
    assert said.status == 1
    assert re.search(
        r"scenario\.yaml:5:11: error: .* expected 1e\+15 at most$", said.err, re.MULTILINE
    )


@pytest.mark.parametrize("speed", [-2.9e-16, 5e-324, -1e-300])
def test_a_start_speed_may_be_0_but_for_rounding(tmp_path: Path, speed: float) -> None:
    """At rest, 15 N*m are above the 10 of the clutch: it speeds up."""
    (tmp_path / "case.yaml").write_text(CASE)
    text = SCENARIO.replace("in: 30", f"in: {speed}")
    (tmp_path / "scenario.yaml").write_text(text)
    said = vstatics("simulate", tmp_path / "scenario.yaml", "-f", "json")
    assert said.status == 0
    assert said.err == ""


@pytest.mark.parametrize("law", ['"1/0"', '"0/0"', '"1e300*1e300"', '"10^20*t"'])
def test_a_capacity_that_is_no_number(tmp_path: Path, law: str) -> None:
    (tmp_path / "case.yaml").write_text(CASE)
    text = SCENARIO.replace("[[0, 10], [.5, 20]]", law)
    (tmp_path / "scenario.yaml").write_text(text)
    said = vstatics("simulate", tmp_path / "scenario.yaml")
    assert said.fails(f"{tmp_path}/scenario.yaml:4:12: error: controls.C: ")
