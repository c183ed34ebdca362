"""Largest values, and margins of shift elements with a capacity."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics
from tests.core.summary.capacities import CASE, case
from tests.core.summary.gearboxes import assert_largest, differential, summary_of
from vstatics import CaseError, Gear, Load, Mechanism, ReadError, ShiftElement, Transmission, solve
from vstatics.core.readers.named.reader import read_json, read_yaml
from vstatics.core.summary import summarize
from vstatics.core.summary.extremes import margins, needed_capacities
from vstatics.core.writers import deck, named


def test_a_margin_is_the_capacity_by_the_larger_torque() -> None:
    """300/(200 * 2.5/3.5); 600/(200 * 2.5), and twice that with half the load."""
    clutch, brake = margins(solve(case()))
    nan = float("nan")
    assert clutch.by_gear == pytest.approx([nan, nan, 2.1, nan], nan_ok=True)
    assert brake.by_gear == pytest.approx([1.2, 2.4, nan, nan], nan_ok=True)
    assert (clutch.gear, brake.gear) == ("direct", "low")
    assert brake.least == pytest.approx(1.2)


def test_a_capacity_needs_no_load_when_it_is_relative() -> None:
    text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", "").replace("300 N*m", "1.5")
    clutch, brake = margins(solve(case(text)))
    assert clutch.least == pytest.approx(2.1)
    assert brake.least == pytest.approx(1.2)


def test_a_capacity_with_a_unit_is_related_to_the_load_of_the_case() -> None:
    assert case().shift_elements[0].capacity == pytest.approx(1.5)
    for load in ("", "load: {speed: 1000 rpm}\n"):
        text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", load)
        with pytest.raises(ReadError, match="read 300 N"):
            case(text)


@pytest.mark.parametrize("capacity", ["0", "-3", "0 N*m", "-3 N*m"])
def test_a_capacity_is_above_0(capacity: str) -> None:
    with pytest.raises(ReadError, match="expected a torque above 0"):
        case(CASE.replace("300 N*m", capacity))


def test_a_capacity_is_above_0_in_the_library_too() -> None:
    wrong = case().shift_elements[0]._replace(capacity=-1.0)
    with pytest.raises(CaseError, match="expected a torque above 0"):
        replace(case(), shift_elements=[wrong])


def test_capacities_are_written_and_read_again() -> None:
    own = case()
    assert read_yaml(named.write_yaml(own).encode(), "again.yaml").case == own
    assert read_json(named.write_json(own).encode(), "again.json").case == own
    assert "capacity of shift element C" in deck.lost(own)


def test_margins_are_shown() -> None:
    said = vstatics("summary", "-", stdin=CASE.encode())
    lines = [line.split() for line in said.out.splitlines()]
    assert ["C", "300.0", "2.100", "direct"] in lines
    assert ["B", "600.0", "1.200", "low"] in lines
    made = json_answer("summary", "-", stdin=CASE.encode())
    assert made["margins"][1] == {
        "element": "B",
        "capacity": 3.0,
        "by_gear": [pytest.approx(1.2), pytest.approx(2.4), None, None],
        "least": pytest.approx(1.2),
        "gear": "low",
    }


def test_largest_values_of_a_differential_worked_by_hand() -> None:
    """The brake holds the ring with -u = 2.5; the planet has p = (u + 1)/2 = -.75."""
    found = summarize(solve(differential())).largest
    carrier = 1 / 3.5
    [planet] = found["planet_speeds"]
    assert_largest(planet, (1 - carrier) / -0.75, "low")
    clutch, brake = found["torques"]
    assert_largest(brake, -2.5, "low")
    assert_largest(clutch, 2.5 / 3.5, "direct")
    assert found["lossy_torques"][1].value == pytest.approx(-2.5 * 0.96)
    open_clutch, open_brake = found["slip_speeds"]
    assert (open_clutch.value, open_clutch.gear) == (1, "low")
    assert (open_brake.value, open_brake.gear) == (1, "direct")


def test_of_equal_values_the_first_gear_is_named() -> None:
    """In the TH400 the direct clutch carries the whole input torque in R alone; forward in 1, 2."""
    forward = summary_of("simpson-th400.yaml").largest["torques"][0]
    assert_largest(forward, 1, "1")


def test_with_a_load_the_gear_of_the_largest_torque_may_be_another() -> None:
    """In gear direct, of little torque, the load is a hundred times as large."""
    made = vstatics("summary", "-", "-f", "json", stdin=LOADED.encode())
    found = made.json["largest"]
    assert found["torques"][0] == {"row": "C", "value": pytest.approx(2.5 / 3.5), "gear": "direct"}
    brake, clutch = found["torques_Nm"][1], found["torques_Nm"][0]
    assert brake["value"] == pytest.approx(-2.5 * 100)
    assert clutch["value"] == pytest.approx(10000 * 2.5 / 3.5)
    assert found["slip_speeds_rpm"][0]["value"] == pytest.approx(2100)


LOADED = """\
links: 3
load: {speed: 2100 rpm, torque: 100 N*m}
shift_elements: {C: [1, 2], B: [2, housing]}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5, efficiency: 0.96}}
gears: {low: {engaged: [B]}, direct: {engaged: [C], load: {torque: 10000 N*m}}}
"""


def test_a_gear_that_is_tied_up_has_no_largest_torque() -> None:
    """Its brakes hold the input itself; the torque of F in the other gear is 2.5/3.5."""
    case = Transmission(
        links=3,
        shift_elements=[ShiftElement(1, 2, "F"), ShiftElement(2, 0, "T")],
        mechanisms=[Mechanism(1, 2, 3, -2.5)],
        gears=[Gear([1], name="direct"), Gear([1, 2], name="tied")],
    )
    clutch, brake = summarize(solve(case)).largest["torques"]
    assert_largest(clutch, 2.5 / 3.5, "direct")
    assert math.isnan(brake.value)


def test_a_planet_whose_teeth_are_not_known_is_named_without_a_speed(tmp_path: Path) -> None:
    """The long planet has (86 - 34)/2 = 26 teeth, so 28/86 86/26 of the input; the short is open."""
    file = tmp_path / "set.yaml"
    file.write_text(
        "links: [s, l, c, r]\noutput: r\nelements: {R: {kind: ravigneaux, small_sun: s, "
        "large_sun: l, carrier: c, ring: r, teeth: {small_sun: 28, large_sun: 34, ring: 86}}}\n"
        "shift_elements: {B: [c, housing]}\ngears: {1: [B]}\n",
        encoding="utf-8",
    )
    said = vstatics("summary", file).out
    assert re.search(r"^R\.short +-$", said, re.MULTILINE)
    assert re.search(r"^R\.long +1\.077  1$", said, re.MULTILINE)


def test_needed_capacities_are_the_largest_torques_with_the_reserve() -> None:
    """Ring held: -u of the input, 250 N*m of 100."""
    elements = [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")]
    gears = [Gear([2], name="low"), Gear([1])]
    case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], gears, load=Load(torque=-100.0))
    _, brake = needed_capacities(solve(case), 1.2)
    assert (brake.element, brake.gear) == ("B", "low")
    assert (brake.capacity, brake.capacity_Nm) == pytest.approx((3.0, 300.0))


def test_needed_capacities_are_at_the_loads_of_the_gears() -> None:
    """-u of 100 N*m in `low`, of 300 N*m in `much`: no load of the case has to tell them."""
    elements = [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")]
    low = Gear([2], name="low", load=Load(torque=100.0))
    gears = [low, low._replace(name="much", load=Load(torque=300.0))]
    case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], gears)
    clutch, brake = needed_capacities(solve(case), 1.2)
    assert brake.gear == "much"
    assert (brake.capacity, brake.capacity_Nm) == pytest.approx((3.0, 900.0))
    assert (clutch.gear, clutch.capacity_Nm) == ("", 0)
