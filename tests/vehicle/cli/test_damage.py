"""`vstatics damage`: records, closed forms, and what they refuse."""

from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics

CASE = """\
name: shafts
inertias: {engine: 0.15, hub: 0.01, vehicle: 9}
springs:
  shaft: {links: [engine, hub], stiffness: 9e4}
  half-shaft: {links: [hub, vehicle], stiffness: 9e3}
fatigue:
  shaft: {section_modulus: 4e-6, endurance: 100 MPa, exponent: 3, cycles: 4e6, threshold: 0}
"""
BOTH = CASE + "  half-shaft: {diameter: 42 mm, endurance: 100 MPa, exponent: 3, cycles: 4e6}\n"
EXAMPLE = (-200, 100, -300, 500, -100, 300, -400, 400, -200)
"""ASTM E1049-85, 5.4.4, in 100 N*m."""
RECORD = "time,torques[shaft]\n" + "".join(f"{n},{one}\n" for n, one in enumerate(EXAMPLE))


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "case.yaml").write_text(CASE, "utf-8")
    (folder / "both.yaml").write_text(BOTH, "utf-8")
    (folder / "record.csv").write_text(RECORD, "utf-8")


def test_a_record() -> None:
    """The damage is that of tests/vehicle/damage/test_devices.py."""
    found = json_answer("damage", "case.yaml", "record.csv")
    assert found["format"] == "vstatics-damage"
    shaft = found["damage"]["shaft"]
    assert shaft["damage"] == pytest.approx(5.341796875e-7, rel=1e-12)
    assert shaft["repeats"] == pytest.approx(1 / 5.341796875e-7, rel=1e-12)
    assert sum(one["count"] for one in shaft["cycles"]) == 4
    assert {(one["range"], one["mean"]) for one in shaft["cycles"]} >= {(900.0, 50.0)}
    assert json_answer("damage", "record", "case.yaml", "record.csv") == found
    assert "5.342e-07" in vstatics("damage", "case.yaml", "record.csv").out


@pytest.mark.parametrize("name", ['"torques[""half-shaft""]"', "torques[half-shaft]"])
def test_units_in_headings_and_names_with_or_without_quotes(name: str) -> None:
    rows = [f"x,{one / 1000},{one}" for one in EXAMPLE]
    text = "\n".join([f"note,torques[shaft] [kN*m],{name}", *rows, "", ""])
    Path("record.csv").write_text(text, "utf-8")
    found = json_answer("damage", "both.yaml", "record.csv")["damage"]
    assert [*found] == ["shaft", "half-shaft"]
    assert found["shaft"]["damage"] == pytest.approx(5.341796875e-7, rel=1e-12)
    assert found["half-shaft"]["cycles"] == found["shaft"]["cycles"]
    assert found["half-shaft"]["cycles"][-1] == {"range": 900.0, "mean": 50.0, "count": 0.5}
    assert found["half-shaft"]["repeats"] is None


def test_a_device_that_was_not_recorded_is_left_out() -> None:
    found = vstatics("damage", "both.yaml", "record.csv", "-f", "json")
    assert [*found.json["damage"]] == ["shaft"]
    assert 'record.csv:1:1: warning: there is no column `torques["half-shaft"]`' in found.err
    assert vstatics("damage", "both.yaml", "record.csv", "--allow", "W880").err == ""


def test_records_that_are_none() -> None:
    for record, message in (
        ("time,torques[shafd]\n0,1\n1,2\n", "1:1: error: there is no column `torques["),
        ("torques[shaft]\n5\n5\n", "1:1: error: no torque of a component with `fatigue`"),
        ("torques[shaft]\n5\nnan\n", "3:1: error: torques[shaft]: read 'nan'"),
        ("torques[shaft],torques[shaft] [kN*m]\n1,2\n", "1:1: error: torques[shaft]: read two co"),
        ("t,torques[shaft]\n1,5\n2,\n", "3:1: error: torques[shaft]: read ''"),
        ("t,torques[shaft]\n1,5\n2\n", "3:1: error: torques[shaft]: read ''"),
        ("torques[shaft] [kW]\n5\n6\n", "1:1: error: torques[shaft]: read the unit 'kW'"),
        ("torques[shaft]\n1e300\n-1e300\n", "1:1: error: torques of `shaft` are too lar"),
        ("torques[shaft]\n1e308\n-1e308\n", "1:1: error: torques of `shaft` are too lar"),
        ("", "1:1: error: the file is empty, expected a record"),
    ):
        Path("record.csv").write_text(record, "utf-8")
        assert vstatics("damage", "case.yaml", "record.csv").fails(f"record.csv:{message}")
    Path("case.yaml").write_text(CASE.partition("fatigue")[0], "utf-8")
    assert vstatics("damage", "case.yaml", "record.csv").fails("the case has no `fatigue`")


def test_rayleigh() -> None:
    """The numbers are those of tests/vehicle/damage/test_rayleigh.py."""
    stresses = ["--endurance", "100MPa", "--deviation", "60e3 kPa"]
    words = ["damage", "rayleigh", "--exponent", "3", "--cycles", "4e6"]
    by_km = json_answer(*words, *stresses, "--per-km", "100")
    alone = json_answer(*words, *stresses)
    assert by_km["integral"] == pytest.approx(3.6191919, rel=1e-7)
    assert by_km["life"] == pytest.approx(51167.55, rel=1e-7)
    assert alone["life"] == pytest.approx(5116755, rel=1e-6)
    twice = json_answer(*words, *stresses, "--sum", "2")
    assert twice["life"] == pytest.approx(2 * alone["life"])
    assert "life [km]" in vstatics(*words, *stresses, "--per-km", "100").out
    bare = json_answer(*words, "--endurance", "100", "--deviation", "60")
    assert bare == pytest.approx(alone), "only the quotient of stresses counts"


def test_resize() -> None:
    words = "damage", "resize", "--diameter"
    by_ratio = json_answer(*words, "42 mm", "--ratio", "2.9")
    assert by_ratio["diameter"] == pytest.approx(56.454, abs=5e-4)
    by_parts = json_answer(*words, "42", "--torque", "2.9", "--repeats", f"{1 / 2.9!r}")
    assert by_parts["diameter"] == pytest.approx(by_ratio["diameter"])
    assert "reduced_compliance" not in by_parts
    assert "diameter [mm]" in vstatics(*words, "42 mm", "--ratio", "2.9").out


def test_wrong_use() -> None:
    for words, message in (
        ("resize --diameter 42", "expected --ratio, or --torque and --repeats"),
        ("resize --diameter 42 --ratio 2 --torque 3", "expected --ratio, or --torque and --rep"),
        ("resize --diameter 0 --ratio 2", "': read 0, expected a number above 0"),
        ("resize --diameter 42kg --ratio 2", "this is a mass"),
        ("resize --diameter 42 --ratio 2 --exponent 1e-9", "to give a diameter"),
        ("rayleigh --endurance 1 --deviation 1 --exponent 3 --cycles 0", "--cycles"),
        ("rayleigh --endurance 1 --deviation 1m --exponent 3 --cycles 1", "this is a length"),
        ("rayleigh --endurance 1 --deviation 1 --exponent 1e9 --cycles 1", "too large"),
        ("rayleigh --endurance 9 --deviation 6MPa --exponent 3 --cycles 1", "of both, or of none"),
        ("case.yaml", "RECORD.csv"),
    ):
        assert vstatics("damage", *words.split()).is_wrong_use(message)


STRENGTH = "{section_modulus: 4e-6, endurance: 100e6, exponent: 3, cycles: 4e6}"
BOX = f"""\
links: [a, b, c]
input: a
output: c
gears: {{on: []}}
elements: {{pair: {{kind: gear_pair, first: a, second: b, teeth: {{first: 20, second: 61}}}}}}
inertias: {{a: 1, c: 2}}
springs: {{s: {{links: [b, c], stiffness: 100, damping: 1}}}}
fatigue: {{pair: {STRENGTH}, s: {STRENGTH}}}
"""


@pytest.mark.parametrize(("stiffness", "is_warned"), [("", True), (", stiffness: 1e6", False)])
def test_a_rigid_device_has_no_life_under_random_torques(stiffness: str, is_warned: bool) -> None:
    """`torsion random` tells which device with a strength is left out, and what would mend it."""
    Path("noise.yaml").write_text("white: 1")
    Path("box.yaml").write_text(BOX.replace("second: 61}", f"second: 61}}{stiffness}"))
    made = vstatics("torsion", "random", "box.yaml", "--at", "a", "--input", "noise.yaml")
    assert ("`pair` is rigid or disengaged, so it has no life" in made.err) == is_warned
    assert "`s`" not in made.err
