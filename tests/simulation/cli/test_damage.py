"""Damage of a run, of samples, of sweeps: two masses that swing on a shaft, in closed form."""

import csv
import math
from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics
from tests.installed import needs

pytestmark = needs("vehicle")

CASE = """\
inertias: {a: 0.4, b: 0.1}
springs: {shaft: {links: [a, b], stiffness: 800}}
fatigue: {shaft: {section_modulus: 1 cm^3, endurance: 100 MPa, exponent: 3, cycles: 1e6}}
"""
SCENARIO = """\
case: case.yaml
duration: 2
start: {speeds: {a: 10, b: 0}}
samples: {start.speeds.a: {uniform: [9, 11]}}
"""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "case.yaml").write_text(CASE, "utf-8")
    (folder / "run.yaml").write_text(SCENARIO, "utf-8")


def test_of_a_run() -> None:
    """80 sin(100 t) N*m, as J = .08 kg*m^2: 63 halves of 160 N*m in 200 rad, 80 MPa each.

    What begins and ends stays below the threshold of 60 MPa.
    """
    shaft = json_answer("simulate", "run.yaml", "--damage")["damage"]["shaft"]
    halves = math.floor(200 / math.pi - 0.5)  # 63
    assert shaft["damage"] == pytest.approx(halves / 2 * 0.8**3 / 1e6, rel=3e-3)
    assert shaft["largest_stress"] == pytest.approx(80e6, rel=1e-9)
    assert "damage" not in json_answer("simulate", "run.yaml")
    assert "\nDamage\n" in vstatics("simulate", "run.yaml", "--damage").out


def test_a_record_of_the_run_says_the_same() -> None:
    vstatics("simulate", "run.yaml", "-o", "run.csv")
    recorded = json_answer("damage", "case.yaml", "run.csv")["damage"]
    assert recorded == json_answer("simulate", "run.yaml", "--damage")["damage"]


def test_of_samples_and_sweeps() -> None:
    """Damage grows with the third power of the speed at the start, if all cycles count."""
    Path("case.yaml").write_text(CASE.replace("1e6", "1e6, threshold: 0"), "utf-8")
    words = ("simulate", "run.yaml", "--samples", "5")
    told = json_answer(*words, "--damage")["results"]
    assert told["damage[shaft]"]["variants"] == 5
    assert told == json_answer(*words)["results"]
    asked = json_answer(*words, "--damage", "--out", "work+1")["results"]
    assert [*asked] == ["work+1", "damage[shaft]"]
    vary = "start.speeds.a=5,10,20"
    vstatics("sweep", "run.yaml", "--vary", vary, "--out", "damage[shaft]", "-o", "out.csv")
    rows = [*csv.DictReader(Path("out.csv").read_text("utf-8").splitlines())]
    by_speed = [float(one["damage[shaft]"]) / float(one["start.speeds.a"]) ** 3 for one in rows]
    assert by_speed == pytest.approx([by_speed[0]] * 3, rel=1e-6)


def test_what_tells_no_damage() -> None:
    damage = ("simulate", "run.yaml", "--damage")
    for more in (["--method", "tarasik"], ["-o", "run.csv"]):
        assert vstatics(*damage, *more).is_wrong_use("--damage is")
    Path("case.yaml").write_text(CASE.partition("fatigue")[0], "utf-8")
    told = json_answer("simulate", "run.yaml", "--samples", "3")["results"]
    assert {*told} == {"abs(peaks)[shaft]", "kinetic", "elastic"}
    for more in ([], ["--samples", "3"]):
        found = vstatics(*damage, *more)
        assert found.status == 1
        assert found.err.startswith("case.yaml:1:1: error: the case has no `fatigue`")
