"""Files of clutches that are dumped, and the command that shows them."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest

from tests.commands import json_answer, vstatics
from tests.core.cli.test_schemas import validator
from tests.torsion.table_3_8 import TABLE_3_8
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


def said(text: str, *options: str) -> Any:
    return vstatics("torsion", "dump", "-", *options, stdin=text.encode())


def test_numbers_are_read_as_they_are_written() -> None:
    [line] = [one for one in TABLE_3_8 if (one.vehicle, one.gear) == ("ЗИЛ-130", 2)]
    assert read_dump(GOOD.encode(), "dump.yaml").given == line.given
    other = GOOD.replace("71.3e-5", "84e-5").replace("3362", "9e4").replace("16.6", "83/5")
    given = read_dump(other.encode(), "dump.yaml").given
    assert (given.E, given.M_C0, given.J1) == (84e-5, 9e4, 16.6)


def test_units_are_read() -> None:
    """ЗИЛ-130 again, with an engine at 780.2 rpm of the propshaft."""
    text = GOOD.replace("16.6", "166000 kg*cm^2").replace("71.3e-5", "0.713 rad/(kN*m)")
    text = text.replace("3362", "3.362 kN*m").replace("81.7", f"{81.7 * 30 / math.pi} rpm")
    made = read_dump(text.encode(), "dump.yaml").given
    assert made == pytest.approx(read_dump(GOOD.encode(), "dump.yaml").given)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("J1: 16.6", "J1: 0", "1:5: error: J1: read 0, expected a number above 0"),
        ("J3: 0.716", "J3: -1", "3:5: error: J3: read -1, expected a number of 0 or more"),
        ("E: 71.3e-5", "E: .nan", "6:4: error: E: read '.nan', expected a compliance"),
        ("E: 71.3e-5", "E: .inf", "6:4: error: E: read '.inf', expected a compliance"),
        ("E: 71.3e-5", "E: 1e999", "6:4: error: E: "),
        ("E: 71.3e-5", "E:", "6:3: error: E: read nothing, expected a compliance"),
        ("J4: 1.36", "J4: -.inf", "4:5: error: J4: read '-.inf', expected an inertia"),
        (
            "M_phi: 3760",
            "M_phi: 3760 kg",
            "8:8: error: M_phi: read '3760 kg', expected a torque in N*m, bare or with its unit; this is a mass",
        ),
        ("J2: 0.538\n", "", "1:1: error: `J2` is missing"),
        ("omega1", "omega", "9:1: error: unknown key `omega`; did you mean `omega1`?"),
        ("J1: 16.6", "J2: 1", "J2"),
        (GOOD, "[1, 2]", "1:1: error: read a list, expected a clutch that is dumped"),
        (GOOD, "", "the file is empty, expected a clutch that is dumped"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(old: str, new: str, message: str) -> None:
    answer = said(GOOD.replace(old, new))
    assert answer.gives_nothing(message)


def test_all_that_is_wrong_is_told_in_one_run() -> None:
    answer = said(GOOD.replace("16.6", "0").replace("0.538", "-1"))
    assert answer.err.count("error: ") == 2


def test_numbers_too_large_for_a_torque_are_an_error_of_the_file() -> None:
    answer = said(
        GOOD.replace("3362", "1e308").replace("71.3e-5", "1e308").replace("81.7", "1e308")
    )
    assert answer.fails("<stdin>:1:1: error: the numbers are too large or too small")


def test_the_command_shows_a_table_for_people() -> None:
    answer = said(GOOD)
    assert answer.status == 0
    assert re.search("^largest torque +5878.944  as M_C0$", answer.out, re.MULTILINE)
    assert "case V2 is on the safe side, by 17 to 23 %" in answer.out
    assert "compared with a measurement by 42 %" in answer.out


def test_json_has_what_the_library_has(tmp_path: Path) -> None:
    file = tmp_path / "dump.yaml"
    file.write_text(GOOD, encoding="utf-8")
    made = json_answer("torsion", "dump", file)
    assert made["case"] == "V2"
    assert made["max_torque"] == pytest.approx(5879, rel=1e-3)
    assert made["max_torque_simplified"] == pytest.approx(5213, rel=1e-3)
    assert made["input_shaft_torque"] == pytest.approx(4442, rel=1e-3)
    assert made["dynamic_factor"] == made["max_torque"] / (0.8 * 3362)
    assert "engagement" not in made
    made = said(GOOD, "-f", "json", "--rate", "50").json
    assert made["engagement"].keys() == {"rate", "factor"}


def test_json_fits_its_schema() -> None:
    for options in ((), ("--rate", "50")):
        made = said(GOOD, "-f", "json", *options).json
        assert list(validator("dump").iter_errors(made)) == []


@pytest.mark.parametrize("suffix", ["csv", "md", "tex", "xlsx", "jsonl"])
def test_every_format_can_be_written(suffix: str, tmp_path: Path) -> None:
    file = tmp_path / f"dump.{suffix}"
    answer = said(GOOD, "-o", str(file))
    assert answer.status == 0
    assert file.stat().st_size > 0


def test_clamped_wheels_are_written_as_infinite() -> None:
    made = said(GOOD.replace("1.36", ".inf"), "-f", "json").json
    assert made["case"] == "V1"


@pytest.mark.parametrize(
    "options",
    [["--rate", "0"], ["--rate", "nan"], ["--rate", "inf"], ["-o", "./"], ["-f", "png"]],
)
def test_wrong_use(options: list[str]) -> None:
    answer = said(GOOD, *options)
    assert answer.status == 2


def test_a_mistyped_command_of_the_group_gets_the_nearest_one() -> None:
    answer = vstatics("torsion", "dmup", "dump.yaml")
    assert answer.is_wrong_use("there is no command `dmup`; did you mean `dump`?")
