"""Largest values, and margins of shift elements with a capacity."""

import math
import re
from dataclasses import replace

import pytest

from tests.commands import json_answer, vstatics
from tests.core.summary.capacities import CASE, case
from tests.core.summary.gearboxes import assert_largest, differential, summary_of
from tests.core.writers.again import is_read_again
from vstatics import CaseError, Gear, Load, ReadError, solve
from vstatics.core.summary import summarize
from vstatics.core.summary.extremes import margins, needed_capacities
from vstatics.core.summary.tables import summary_grids
from vstatics.core.writers import deck

LOAD = "load: {speed: 1000 rpm, torque: 200 N*m}\n"


def test_a_margin_is_the_capacity_by_the_larger_torque() -> None:
    """300/(200 * 2.5/3.5); 600/(200 * 2.5), and twice that with half the load."""
    clutch, brake = margins(solve(case()))
    nan = float("nan")
    assert clutch.by_gear == pytest.approx([nan, nan, 2.1, nan], nan_ok=True)
    assert brake.by_gear == pytest.approx([1.2, 2.4, nan, nan], nan_ok=True)
    assert (clutch.gear, brake.gear) == ("direct", "low")
    assert brake.least == pytest.approx(1.2)
    said = vstatics("summary", "-", stdin=CASE.encode()).out.splitlines()
    rows = [["C", "300.0", "2.100", "direct"], ["B", "600.0", "1.200", "low"]]
    assert [line.split() for line in said if line.split() in rows] == rows
    made = json_answer("summary", "-", stdin=CASE.encode())["margins"][1]
    by_gear = [pytest.approx(1.2), pytest.approx(2.4), None, None]
    least = {"least": pytest.approx(1.2), "gear": "low"}
    assert made == {"element": "B", "capacity": 3.0, "by_gear": by_gear} | least


def test_a_capacity_is_relative_or_related_to_the_load_of_the_case() -> None:
    relative = case(CASE.replace(LOAD, "").replace("300 N*m", "1.5"))
    assert [one.least for one in margins(solve(relative))] == pytest.approx([2.1, 1.2])
    assert case().shift_elements[0].capacity == pytest.approx(1.5)
    for load in ("", "load: {speed: 1000 rpm}\n"):
        with pytest.raises(ReadError, match="read 300 N"):
            case(CASE.replace(LOAD, load))


def test_a_capacity_is_above_0() -> None:
    for capacity in ("0", "-3", "0 N*m", "-3 N*m"):
        with pytest.raises(ReadError, match="expected a torque above 0"):
            case(CASE.replace("300 N*m", capacity))
    wrong = case().shift_elements[0]._replace(capacity=-1.0)
    with pytest.raises(CaseError, match="expected a torque above 0"):
        replace(case(), shift_elements=[wrong])


def test_capacities_are_written_and_read_again() -> None:
    own = case()
    assert is_read_again(own)
    assert "capacity of shift element C" in deck.lost(own)


def test_largest_values_of_a_differential_worked_by_hand() -> None:
    """The brake holds the ring with -u = 2.5; the planet has p = (u + 1)/2 = -.75."""
    found = summarize(solve(differential())).largest
    [planet] = found["planet_speeds"]
    assert_largest(planet, (1 - 1 / 3.5) / -0.75, "low")
    clutch, brake = found["torques"]
    assert_largest(brake, -2.5, "low")
    assert_largest(clutch, 2.5 / 3.5, "direct")
    assert found["lossy_torques"][1].value == pytest.approx(-2.5 * 0.96)
    assert [(one.value, one.gear) for one in found["slip_speeds"]] == [(1, "low"), (1, "direct")]


def test_of_equal_values_the_first_gear_is_named() -> None:
    """In the TH400 the forward clutch carries the whole input torque in gears 1 and 2."""
    assert_largest(summary_of("simpson-th400.yaml").largest["torques"][0], 1, "1")


def test_with_a_load_the_gear_of_the_largest_torque_may_be_another() -> None:
    """In gear direct, of little torque, the load is a hundred times as large."""
    low, direct = differential().gears
    gears = [low, direct._replace(load=Load(torque=10000.0))]
    found = summarize(solve(differential().replace(gears=gears, load=Load(2100.0, 100.0)))).largest
    assert_largest(found["torques"][0], 2.5 / 3.5, "direct")
    assert [one.value for one in found["torques_Nm"]] == pytest.approx([10000 * 2.5 / 3.5, -250])
    assert found["slip_speeds_rpm"][0].value == pytest.approx(2100)


def test_tables_of_relative_numbers_say_so_beside_tables_in_units() -> None:
    def titles(load: Load | None) -> list[str]:
        grids = summary_grids(summarize(solve(differential().replace(load=load))))
        return [grid.title for grid in grids if grid.title.startswith("Largest")]

    planets, elements = "planet speeds relative to the carrier", "slip and torque of shift"
    expected = [f"Largest {planets}", f"Largest {elements} elements"]
    assert titles(None) == expected
    units = [f"{title}, {unit}" for title, unit in zip(expected, ("rpm", "rpm, N*m"), strict=True)]
    assert titles(Load(2100.0, 100.0)) == [*(f"{title}, input = 1" for title in expected), *units]


def test_a_gear_that_is_tied_up_has_no_largest_torque() -> None:
    """Its brakes hold the input itself; the torque of C in the other gear is 2.5/3.5."""
    gears = [Gear([1], name="direct"), Gear([1, 2], name="tied")]
    clutch, brake = summarize(solve(differential().replace(gears=gears))).largest["torques"]
    assert_largest(clutch, 2.5 / 3.5, "direct")
    assert math.isnan(brake.value)


def test_a_planet_whose_teeth_are_not_known_is_named_without_a_speed() -> None:
    """The long planet has (86 - 34)/2 = 26 teeth: 28/86 86/26 of the input; the short is open."""
    text = (
        "links: [s, l, c, r]\noutput: r\nelements: {R: {kind: ravigneaux, small_sun: s, "
        "large_sun: l, carrier: c, ring: r, teeth: {small_sun: 28, large_sun: 34, ring: 86}}}\n"
        "shift_elements: {B: [c, housing]}\ngears: {1: [B]}\n"
    )
    said = vstatics("summary", "-", stdin=text.encode()).out
    assert re.search(r"^R\.short +-$", said, re.MULTILINE)
    assert re.search(r"^R\.long +1\.077  1$", said, re.MULTILINE)


def test_needed_capacities_are_the_largest_torques_with_the_reserve() -> None:
    """The brake on the ring carries -u = 2.5 times the input torque of the case or of the gear.

    As a block, the set transmits 1/(1 - u) = 1/3.5 of the input torque, and the clutch the remainder.
    Capacities relative to the input torque need no load.
    """
    clutch, brake = needed_capacities(solve(differential(load=Load(torque=-100.0))), 1.2)
    assert (brake.element, brake.gear) == ("B", "low")
    assert clutch.capacity == pytest.approx(1.2 * 2.5 / 3.5)
    assert clutch.gear == "direct"
    assert (brake.capacity, brake.capacity_Nm) == pytest.approx((3.0, 300.0))
    low = Gear([2], name="low", load=Load(torque=100.0))
    gears = [low, low._replace(name="much", load=Load(torque=300.0))]
    clutch, brake = needed_capacities(solve(differential().replace(gears=gears)), 1.2)
    assert brake.gear == "much"
    assert (brake.capacity, brake.capacity_Nm) == pytest.approx((3.0, 900.0))
    assert (clutch.gear, clutch.capacity_Nm) == ("", 0)
