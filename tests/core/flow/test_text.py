"""The power flow as text and as JSON."""

from dataclasses import replace

import pytest

from tests.commands import LOCKED, NEUTRAL, TIED_UP, json_answer, vstatics
from tests.core.flow.worked import only
from vstatics import Gear, Mechanism, Transmission, loads, solve
from vstatics.core.flow.power import flows
from vstatics.core.flow.text import text
from vstatics.core.model.parts import Load


def test_a_gear_without_power_says_why() -> None:
    [tied, _] = flows(solve(loads(TIED_UP)))
    assert (tied.ideal, tied.lossy, tied.note) == (None, None, "tied up")
    [neutral, _] = flows(solve(loads(NEUTRAL)))
    assert (neutral.ideal, neutral.note) == (None, "torques do not balance")
    locked = only(loads(LOCKED))
    assert locked.ideal is not None
    assert (locked.lossy, locked.note) == (None, "self-locking")
    assert "with losses: self-locking" in text(locked)
    said = vstatics("flow", "-", stdin=TIED_UP.encode())
    assert said.status == 1
    assert said.out.startswith("gear both: tied up, so there is no power to show\n\ngear low ")


def test_a_load_gives_kilowatts() -> None:
    """2000 rpm * pi/30 * 500 N*m = 104.720 kW; the pair of efficiency .95 loses 5.236 kW."""
    pair = Mechanism(1, 2, 0, 4.0, 0.95, name="pair")
    loaded = Transmission(2, [], [pair], [Gear()], load=Load(2000.0, 500.0))
    for case in (loaded, replace(loaded, coast=True)):
        assert only(case).kilowatts == pytest.approx(104.7197551)
    [line] = [line for line in text(only(loaded)).splitlines() if "pair" in line]
    assert line.split() == ["pair", "1.000", "1.000", "104.720", "0.0500", "5.236", "100.0%"]


def test_json_has_the_numbers_of_the_library() -> None:
    """The differential has -2.5 and .96, its second link is held: the third gives .9714."""
    [neutral, low] = json_answer("flow", "-", stdin=NEUTRAL.encode())["gears"]
    assert (neutral["ideal"], neutral["note"]) == (None, "torques do not balance")
    assert low["lossy"]["leaving"] == pytest.approx(3.4 / 3.5)
    [loss] = low["lossy"]["losses"]
    assert [*loss] == ["kind", "number", "name", "power", "share"]
    assert [*loss.values()] == ["mechanism", 1, "D", pytest.approx(0.1 / 3.5), 1]
    assert low["input_link_kW"] is None
