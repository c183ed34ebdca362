"""Files of clutches that are dumped."""

import math

import pytest

from tests.rejects import rejects
from tests.torsion.table_3_8 import TABLE_3_8
from vstatics.core.errors import ReadError
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


def test_a_fault_is_told_with_its_place() -> None:
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
