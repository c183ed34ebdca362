"""`vstatics torsion identify` and `damping`."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from tests.commands import Said, vstatics
from tests.torsion.vibration.test_measured import DRIVELINE
from vstatics import loads
from vstatics.torsion.vibration.measured import damping, identify


def said(command: str, *options: str, text: str = DRIVELINE) -> Any:
    return vstatics("torsion", command, "-", "--gear", "4", *options, stdin=text.encode())


def test_identify_in_json_has_what_the_library_has() -> None:
    made = said("identify", "--omega", "41.4", "--decrement", ".554", "-f", "json").json
    expected = identify(loads(DRIVELINE), "4", 41.4, 0.554)
    for key in ("omega", "compliances", "dampings"):
        assert made[key] == getattr(expected, key), key
    made = said("identify", "--omega", "160", "--mode", "2", "-f", "json").json
    assert made["omega"] == identify(loads(DRIVELINE), "4", 160, mode=2).omega
    assert made["dampings"] == {}


def test_damping_in_json_has_what_the_library_has() -> None:
    expected = damping(loads(DRIVELINE), "4", {"prop, shaft": 0.03, "tyre": 0.2}, 83.3)
    for written in ('"prop, shaft"=.03,tyre=.2', '  tyre = 2e-1 , "prop, shaft" = 0.03 '):
        made = said("damping", "--omega", "83.3", "--decrements", written, "-f", "json").json
        assert (made["omega"], made["dampings"]) == (83.3, expected.dampings)
        assert made["decrement"] == pytest.approx(expected.decrement)
        assert made["messages"] == []
    made = said("damping", "--decrements", "final drive=.1", "-f", "json").json
    assert made["dampings"].keys() == {"final drive"}


WRONG = [
    ["identify"], ["damping"],
    *(["identify", "--omega", one] for one in ("0", "-1", "nan", "inf", "x", "1e-300")),
    *(["identify", "--omega", "1", "--mode", one] for one in ("0", "99")),
    *(["identify", "--omega", "1", "--decrement", one] for one in ("-1", "nan")),
    ["identify", "--omega", "1", "--gear", "5"],
    ["damping", "--decrements", "tyre=.1", "--omega", "0"],
    *(
        ["damping", "--decrements", one]
        for one in (
            "", "tyre", "tyre=", "=.1", "tyre=-1", "tyre=nan", "tyre=inf", "tyre=.1,", '"tyre=.1',
            "tyre=.1,tyre=.2", "tyre=.1;damper=.2", '"tyre"x=.1', '""=.1', "pair=.1", "I=.1",
            "prop, shaft=.1",
        )
    ),
]  # fmt: skip


def test_wrong_use() -> None:
    for options in WRONG:
        assert said(*options).is_wrong_use(), options


def test_what_the_case_does_not_have_is_reported_with_its_place() -> None:
    answer = said("damping", "--decrements", "tyer=.1")
    assert answer.is_wrong_use("no elastic component `tyer`; did you mean `tyre`?")
    text = "links: 2\ninertias: {1: 1}\nmechanisms: {D: {first: 1, second: 2, ratio: 3}}\n"
    answer = said("damping", "--decrements", "D=.1", text=text + "gears: {4: []}\n")
    assert answer.fails("<stdin>:4:9: error: gear 4: nothing elastic connects the inertias")


SWING = """\
inertias: {a: 0.4, b: 0.1}
springs: {shaft: {links: [a, b], stiffness: 1000}}
"""


def swinging(rows: Sequence[tuple[float, float]], *more: str) -> Said:
    Path("swing.yaml").write_text(SWING, "utf-8")
    text = "note,time [ms],M [kN*m]\n" + "".join(f"x,{t},{m}\n" for t, m in rows)
    Path("record.csv").write_text(text, "utf-8")
    words = ("swing.yaml", "--record", "record.csv", "--column", "M", *more)
    return vstatics("torsion", "identify", *words)


@pytest.mark.usefixtures("folder")
def test_a_record_tells_frequency_and_decrement() -> None:
    """100 rad/s on J = .08 kg*m^2 is a compliance of 1/800, the damping delta/(pi E omega)."""
    decrement = 0.3
    decay = decrement / 20 / math.pi
    rows = [(t, 2 + math.exp(-decay * t) * math.cos(0.1 * t)) for t in range(400)]
    made = swinging(rows, "-f", "json").json
    assert made["measured"] == pytest.approx(100, rel=1e-4)
    assert made["decrement"] == pytest.approx(decrement, rel=1e-3)
    assert made["compliances"]["shaft"] == pytest.approx(1 / 800, rel=2e-4)
    assert made["dampings"]["shaft"] == pytest.approx(decrement / math.pi * 800 / 100, rel=2e-3)
    assert made["mean_line"][3] == pytest.approx(2, abs=0.01)
    assert len(made["amplitudes"]) == len(made["mean_line"]) == 10
    assert "Recorded 100 rad/s, decrement 0.3" in swinging(rows).out
    peaks = "160,-51.148655,109.233977,-12.588199,79.944530,9.659249"
    words = ("swing.yaml", "--peaks", peaks, "--period", f"{math.pi / 50!r}", "-f", "json")
    made = vstatics("torsion", "identify", *words).json
    assert made["measured"] == pytest.approx(100)
    assert made["decrement"] == pytest.approx(0.55, abs=1e-7)


@pytest.mark.usefixtures("folder")
def test_records_that_tell_nothing() -> None:
    for rows, message in (
        ([(0, 1), (1, 2), (2, 3)], "record.csv:1:1: error: M: read 0 extremes of a vibration"),
        ([(0, 1), (1, 2), (1, 3)], "record.csv:4:1: error: read the time 0.001 s, expected asc"),
        ([(0, 1), (1, math.nan)], "record.csv:3:1: error: M: read 'nan', expected a finite numb"),
        ([(t, (-2) ** t if t else 0) for t in range(9)], "record.csv:1:1: error: M: the decre"),
    ):
        found = swinging(rows)
        assert (found.status, found.err[: len(message)]) == (1, message)


@pytest.mark.usefixtures("folder")
def test_one_way_to_tell_what_was_measured() -> None:
    why = "expected --omega (and --decrement), --peaks with --period, or"
    for more in (("--omega", "3"), ("--decrement", ".1"), ("--peaks", "1,-1"), ("--period", "2")):
        assert swinging([(0, 1), (1, 2)], *more).is_wrong_use(why), more
