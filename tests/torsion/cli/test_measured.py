"""`vstatics torsion identify` and `damping`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from tests.commands import Said, vstatics
from tests.torsion.cli.torsional import STUCK
from tests.torsion.vibration.test_measured import DRIVELINE
from vstatics import loads
from vstatics.torsion.vibration.measured import damping, identify


def said(command: str, *options: str, text: str = DRIVELINE) -> Any:
    return vstatics("torsion", command, "-", *options, stdin=text.encode())


def test_identify_in_json_has_what_the_library_has() -> None:
    options = ("--gear", "4", "--omega", "41.4", "--decrement", ".554", "-f", "json")
    answer = said("identify", *options)
    assert answer.status == 0
    made = answer.json
    expected = identify(loads(DRIVELINE), "4", 41.4, 0.554)
    assert made["omega"] == expected.omega
    assert made["compliances"] == expected.compliances
    assert made["dampings"] == expected.dampings


def test_identify_takes_a_mode() -> None:
    answer = said("identify", "--gear", "4", "--omega", "160", "--mode", "2", "-f", "json")
    made = answer.json
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
    made = answer.json
    expected = damping(loads(DRIVELINE), "4", {"prop, shaft": 0.03, "tyre": 0.2}, 83.3)
    assert made["omega"] == 83.3
    assert made["dampings"] == expected.dampings
    assert made["decrement"] == pytest.approx(expected.decrement)
    assert made["messages"] == []


def test_a_name_with_blanks_needs_no_quotes() -> None:
    answer = said("damping", "--gear", "4", "--decrements", "final drive=.1", "-f", "json")
    assert answer.json["dampings"].keys() == {"final drive"}


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
    assert answer.is_wrong_use()


def test_a_mistyped_device_gets_the_nearest_one() -> None:
    answer = said("damping", "--gear", "4", "--decrements", "tyer=.1")
    assert "no elastic component `tyer`; did you mean `tyre`?" in answer.err


def test_a_gear_that_is_tied_up_is_told_with_its_place() -> None:
    answer = said("identify", "--gear", "stuck", "--omega", "1", text=STUCK)
    assert answer.gives_nothing("<stdin>:5:19: error: gear stuck: tied up")


def test_a_case_without_anything_elastic_is_told() -> None:
    text = """\
links: 2
inertias: {1: 1}
mechanisms: {D: {first: 1, second: 2, ratio: 3}}
gears: {1: []}
"""
    answer = said("damping", "--gear", "1", "--decrements", "D=.1", text=text)
    assert answer.fails("<stdin>:4:9: error: gear 1: nothing elastic connects the inertias")


SWING = """\
inertias: {a: 0.4, b: 0.1}
springs: {shaft: {links: [a, b], stiffness: 1000}}
"""


def swinging(rows: Sequence[tuple[float, float]], *more: str) -> Said:
    Path("swing.yaml").write_text(SWING, encoding="utf-8")
    text = "note,time [ms],M [kN*m]\n" + "".join(f"x,{t},{m}\n" for t, m in rows)
    Path("record.csv").write_text(text, encoding="utf-8")
    words = ("swing.yaml", "--record", "record.csv", "--column", "M", *more)
    return vstatics("torsion", "identify", *words)


@pytest.mark.usefixtures("folder")
def test_a_record_tells_frequency_and_decrement() -> None:
    """100 rad/s on J = .08 kg*m^2 is a compliance of 1/800, the damping delta/(pi E omega)."""
    decrement = 0.3
    rows = [
        (t, 2 + math.exp(-decrement * t / 20 / math.pi) * math.cos(0.1 * t)) for t in range(400)
    ]
    made = swinging(rows, "-f", "json").json
    assert made["measured"] == pytest.approx(100, rel=1e-4)
    assert made["decrement"] == pytest.approx(decrement, rel=1e-3)
    assert made["compliances"]["shaft"] == pytest.approx(1 / 800, rel=2e-4)
    damping = decrement / math.pi * 800 / 100
    assert made["dampings"]["shaft"] == pytest.approx(damping, rel=2e-3)
    assert made["mean_line"][3] == pytest.approx(2, abs=0.01)
    assert len(made["amplitudes"]) == len(made["mean_line"]) == 10
    assert "Recorded 100 rad/s, decrement 0.3" in swinging(rows).out


@pytest.mark.usefixtures("folder")
def test_peaks_tell_the_same() -> None:
    Path("swing.yaml").write_text(SWING, encoding="utf-8")
    peaks = "160,-51.148655,109.233977,-12.588199,79.944530,9.659249"
    words = ("swing.yaml", "--peaks", peaks, "--period", f"{math.pi / 50!r}", "-f", "json")
    made = vstatics("torsion", "identify", *words).json
    assert made["measured"] == pytest.approx(100)
    assert made["decrement"] == pytest.approx(0.55, abs=1e-7)
    assert made["mean_line"][0] == pytest.approx(41.734167, abs=1e-6)


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([(0, 1), (1, 2), (2, 3)], "record.csv:1:1: error: M: read 0 extremes of a vibration"),
        ([(0, 1), (1, 2), (1, 3)], "record.csv:4:1: error: read the time 0.001 s, expected asc"),
        ([(0, 1), (1, math.nan)], "record.csv:3:1: error: M: read 'nan', expected a finite numb"),
        ([(0, 0), *((t, (-2) ** t) for t in range(1, 9))], "record.csv:1:1: error: M: the decre"),
        ([], "record.csv:1:1: error: M: read 0 extremes"),
    ],
)
def test_records_that_tell_nothing(rows: list[tuple[float, float]], message: str) -> None:
    found = swinging(rows)
    assert found.status == 1
    assert found.err.startswith(message)


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    "more", [["--omega", "3"], ["--decrement", ".1"], ["--peaks", "1,-1"], ["--period", "2"]]
)
def test_one_way_to_tell_what_was_measured(more: list[str]) -> None:
    found = swinging([(0, 1), (1, 2)], *more)
    assert found.is_wrong_use("expected --omega (and --decrement), --peaks with --period, or")
