"""`vstatics torsion identify` and `damping`."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.cli.torsion.torsional import STUCK
from tests.commands import vstatics
from tests.torsion.vibration.test_measured import DRIVELINE
from vstatics import loads
from vstatics.torsion.vibration.measured import damping, identify


def said(command: str, *options: str, text: str = DRIVELINE) -> Any:
    return vstatics("torsion", command, "-", *options, stdin=text.encode())


def test_identify_in_json_has_what_the_library_has() -> None:
    options = ("--gear", "4", "--omega", "41.4", "--decrement", ".554", "-f", "json")
    answer = said("identify", *options)
    assert answer.status == 0
    made = json.loads(answer.out)
    expected = identify(loads(DRIVELINE), "4", 41.4, 0.554)
    assert made["omega"] == expected.omega
    assert made["compliances"] == expected.compliances
    assert made["dampings"] == expected.dampings


def test_identify_takes_a_mode() -> None:
    answer = said("identify", "--gear", "4", "--omega", "160", "--mode", "2", "-f", "json")
    made = json.loads(answer.out)
    assert made["omega"] == identify(loads(DRIVELINE), "4", 160, mode=2).omega
    assert made["dampings"] == {}


@pytest.mark.parametrize(
    "written",
    ['"prop, shaft"=.03,tyre=.2', '  tyre = 2e-1 , "prop, shaft" = 0.03 '],
)
def test_damping_in_json_has_what_the_library_has(written: str) -> None:
    options = ("--gear", "4", "--omega", "83.3", "--decrements", written, "-f", "json")
    answer = said("damping", *options)
    assert answer.status == 0
    made = json.loads(answer.out)
    expected = damping(loads(DRIVELINE), "4", {"prop, shaft": 0.03, "tyre": 0.2}, 83.3)
    assert made["omega"] == 83.3
    assert made["dampings"] == expected.dampings
    assert made["decrement"] == pytest.approx(expected.decrement)
    assert made["messages"] == []


def test_a_name_with_blanks_needs_no_quotes() -> None:
    answer = said("damping", "--gear", "4", "--decrements", "final drive=.1", "-f", "json")
    assert json.loads(answer.out)["dampings"].keys() == {"final drive"}


def test_tables_for_people() -> None:
    answer = said("identify", "--gear", "4", "--omega", "41.4", "--decrement", ".554")
    assert "measured 41.4" in answer.out
    assert "damping [N*m*s/rad]" in answer.out
    answer = said("damping", "--gear", "4", "--decrements", "tyre=.2")
    assert "\nmode " in answer.out


@pytest.mark.parametrize(
    "options",
    [
        ["identify", "--gear", "4"],
        ["identify", "--omega", "1"],
        ["identify", "--gear", "5", "--omega", "1"],
        *(["identify", "--gear", "4", "--omega", one] for one in ("0", "-1", "nan", "inf", "x")),
        ["identify", "--gear", "4", "--omega", "1e-300"],
        ["identify", "--gear", "4", "--omega", "1", "--mode", "0"],
        ["identify", "--gear", "4", "--omega", "1", "--mode", "99"],
        ["identify", "--gear", "4", "--omega", "1", "--decrement", "-1"],
        ["identify", "--gear", "4", "--omega", "1", "--decrement", "nan"],
        ["damping", "--gear", "4"],
        ["damping", "--gear", "4", "--decrements", "tyre=.1", "--omega", "0"],
        *(
            ["damping", "--gear", "4", "--decrements", one]
            for one in (
                *("", "tyre", "tyre=", "=.1", "tyre=-1", "tyre=nan", "tyre=inf", "tyre=.1,"),
                *("tyre=.1,tyre=.2", "tyre=.1;damper=.2", '"tyre=.1', '"tyre"x=.1', '""=.1'),
                *("tyer=.1", "pair=.1", "I=.1", "prop, shaft=.1"),
            )
        ),
    ],
)
def test_wrong_use(options: list[str]) -> None:
    answer = said(*options)
    assert (answer.status, answer.out) == (2, "")


def test_a_mistyped_device_gets_the_nearest_one() -> None:
    answer = said("damping", "--gear", "4", "--decrements", "tyer=.1")
    assert "no elastic device `tyer`; did you mean `tyre`?" in answer.err


def test_a_gear_that_is_tied_up_is_told_with_its_place() -> None:
    answer = said("identify", "--gear", "stuck", "--omega", "1", text=STUCK)
    assert (answer.status, answer.out) == (1, "")
    assert "<stdin>:5:19: error: gear stuck: tied up" in answer.err


def test_a_case_without_anything_elastic_is_told() -> None:
    text = """\
links: 2
inertias: {1: 1}
mechanisms: {D: {first: 1, second: 2, ratio: 3}}
gears: {1: []}
"""
    answer = said("damping", "--gear", "1", "--decrements", "D=.1", text=text)
    assert answer.status == 1
    assert "<stdin>:4:9: error: gear 1: nothing elastic joins inertias" in answer.err
