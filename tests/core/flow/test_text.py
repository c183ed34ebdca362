"""The power flow as text."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.commands import LOCKED, NEUTRAL, TIED_UP, vstatics
from tests.core.flow.worked import only
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.flow.power import flows
from vstatics.core.flow.text import text
from vstatics.core.model.parts import Load
from vstatics.core.readers.named.reader import read_yaml


def test_a_gear_without_power_says_why(tmp_path: Path) -> None:
    [tied, _] = flows(solve(read_yaml(TIED_UP.encode(), "x").case))
    assert (tied.ideal, tied.lossy, tied.note) == (None, None, "tied up")
    [neutral, _] = flows(solve(read_yaml(NEUTRAL.encode(), "x").case))
    assert (neutral.ideal, neutral.note) == (None, "torques do not balance")
    locked = only(read_yaml(LOCKED.encode(), "x").case)
    assert locked.ideal is not None
    assert (locked.lossy, locked.note) == (None, "self-locking")
    assert "with losses: self-locking" in text(locked)
    (tmp_path / "tied.yaml").write_text(TIED_UP, encoding="utf-8")
    said = vstatics("flow", tmp_path / "tied.yaml")
    assert said.status == 1
    assert said.out.startswith("gear both: tied up, so there is no power to show\n\ngear low ")


def test_a_load_gives_kilowatts() -> None:
    """2000 rpm * pi/30 * 500 N*m = 104.720 kW; the pair of efficiency .95 loses 5.236 kW."""
    loaded = Transmission(
        2, [], [Mechanism(1, 2, 0, 4.0, 0.95, name="pair")], [Gear()], load=Load(2000.0, 500.0)
    )
    assert only(loaded).kilowatts == pytest.approx(104.7197551)
    assert only(replace(loaded, coast=True)).kilowatts == pytest.approx(104.7197551)
    [line] = [line for line in text(only(loaded)).splitlines() if "pair" in line]
    assert line.split() == ["pair", "1.000", "1.000", "104.720", "0.0500", "5.236", "100.0%"]


def test_the_command_shows_one_gear_by_name_or_number(tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(NEUTRAL, encoding="utf-8")
    by_name = vstatics("flow", file, "--gear", "low")
    assert by_name.status == 0
    assert by_name.out.startswith("gear low ")
    assert vstatics("flow", "-", "--gear", "2", stdin=file.read_bytes()).out == by_name.out
    wrong = vstatics("flow", file, "--gear", "lwo")
    assert wrong.is_wrong_use("no gear 'lwo'; did you mean `low`?")
