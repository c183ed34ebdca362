"""`vstatics sweep` of natural frequencies: every format, jobs, --resume, a table, a sweep file."""

from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics
from tests.installed import needs

CASE = """\
links: [engine, disc, wheel]
inertias: {engine: 0.15, disc: 0.01, wheel: 1.5}
springs:
  damper: {links: [engine, disc], compliance: 84e-5, damping: 3.2}
  shaft: {links: [disc, wheel], stiffness: 9 kN*m/rad}
"""
OMEGA = "omega[1,1],omega[2,1]/omega[1,1]"


@pytest.fixture(autouse=True)
def _case(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE, "utf-8")


def test_the_numbers_are_those_of_torsion_modes() -> None:
    [gear] = json_answer("torsion", "modes", "box.yaml")["gears"]
    low, high = (mode["omega"] for mode in gear["modes"])
    asked = ("--vary", "damper.compliance=84e-5", "--out", OMEGA)
    row = vstatics("sweep", "box.yaml", *asked, "-f", "jsonl").json
    assert row["omega[1,1]"] == pytest.approx(low, rel=1e-11)
    assert row["omega[2,1]/omega[1,1]"] == pytest.approx(high / low, rel=1e-11)


HELD = """\
links: 3
inertias: {1: 1, 3: 1}
springs: {s: {links: [2, 3], stiffness: 5}}
shift_elements: {B: [2, housing], P: [3, housing]}
mechanisms: {pair: {first: 1, second: 2, third: housing, ratio: -2}}
"""
"""The brake B holds the second wheel, and so the input."""


@needs("torsion")
def test_a_gear_whose_input_is_held_vibrates_and_one_without_motion_does_not() -> None:
    """One mass of 1 kg*m^2 on the spring: the square root of its stiffness."""
    for gear, rows in (
        ("[B]", ["0,1,ok,1", "1,4,ok,2"]),
        ("[B, P]", ["0,1,tied up,", "1,4,tied up,"]),
    ):
        Path("held.yaml").write_text(f"{HELD}gears: {{low: {gear}}}\n", "utf-8")
        said = vstatics("sweep", "held.yaml", "--vary", "s.stiffness=1,4", "--out", "omega")
        assert said.out.splitlines()[1:] == rows
        assert said.status == ("no variant has a solution" in said.err) == (gear != "[B]")
