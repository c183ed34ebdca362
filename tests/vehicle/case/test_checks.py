"""Doubts about the vehicle of a case."""

import math

import pytest

from vstatics import Gear, Load, Mechanism, ReadError, ShiftElement, Transmission, loads, solve
from vstatics.core.model.checks import doubts, hints
from vstatics.core.model.laws import LossUnit, MapLaw
from vstatics.core.model.springs import Spring
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.traction import performance


@pytest.mark.parametrize("output", [2, 3])
@pytest.mark.parametrize("link", [2, 3])
@pytest.mark.parametrize("part", [0.45, 0.55])
def test_the_mass_of_a_vehicle_may_stand_behind_its_tyre(
    output: int, link: int, part: float
) -> None:
    """1200 kg on wheels of .3 m are 108 kg*m^2: those of `inertias` move in runs and vibration."""
    car, tyre = Vehicle(1200, 0.3), Spring({2: 1, 3: -1}, stiffness=1e4)
    case = Transmission(3, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], output=output, springs=[tyre])
    case = case.replace(inertias={1: 0.2, link: part * 108}, vehicle=car)
    is_engine_side = output == 3 and link == 2  # where a flywheel may have as much
    has_mass = part > 0.5 and not is_engine_side
    assert [one.id for one in doubts(case)] == ["W202"] * has_mass
    assert has_mass == ("N607" not in [one.id for one in hints(case)])


def test_a_converter_that_every_gear_bypasses_has_no_speed_ratio_to_stay_at() -> None:
    engaged: dict[str, list[int]] = {"open": [], "locked": [1], "both": [1, 2]}
    converter = Mechanism(1, 2, 0, 0.8, kind="converter", points=((0, 2), (1, 1)))
    sets = [converter, Mechanism(2, 3, 0, 1.0)]
    elements = [ShiftElement(1, 2), ShiftElement(2, 3)]
    for names in ("open", "locked", "open locked", "locked both"):
        gears = [Gear(engaged[name]) for name in names.split()]
        case = Transmission(3, elements, sets, gears, vehicle=Vehicle(1200, 0.3))
        assert [doubt.id for doubt in doubts(case)] == ["W891"] * ("open" in names)


def test_a_speed_ratio_that_the_load_determines_is_not_given() -> None:
    """The pump takes 0.002 (1 - i) w^2, so i = 0.5 at 100 rad/s and 10 N*m."""
    points = ((0, 2, 0.002), (1, 1, 0.0))
    converter = Mechanism(1, 2, 0, math.nan, kind="converter", points=points)
    load = Load(100 * 30 / math.pi, 10)
    case = Transmission(2, [], [converter], [Gear()], load=load, vehicle=Vehicle(1200, 0.3))
    results = solve(case)
    assert results.ratio[0] == pytest.approx(2)
    assert results.messages == ()


@pytest.mark.parametrize(("link", "speed"), [(4, 1 / 4), (5, 1 / 16), (1, 3.0)])
def test_nor_among_those_of_what_is_geared_to_the_output(link: int, speed: float) -> None:
    """Behind the output: a pair of 4, then a hub of a held ring whose carrier is 1/(1 + 3).

    Before it a flywheel may have as much by that speed: nobody knows better.
    """
    behind = [Mechanism(2, 4, 0, 4.0), Mechanism(4, 0, 5, -3.0)]
    sets = [Mechanism(1, 2, 0, 3.0), Mechanism(3, 2, 0, -2.0), *behind]
    car = Vehicle(1200, 0.3, final_drive=16)
    case = Transmission(5, [], sets, [Gear()], output=2, vehicle=car)
    for part in (0.45, 0.55):
        own = part * 1200 * (0.3 / 16) ** 2
        told = [doubt.message for doubt in doubts(case.replace(inertias={link: own / speed**2}))]
        assert len(told) == (part > 0.5 and link != 1)
        for text in told:
            assert text.startswith(f"{link} has {own:.4g} kg*m^2 by the speed of the output")


def test_a_number_without_its_unit_is_reported_where_no_part_is_as_large() -> None:
    """Tyres of the largest dumpers have a radius of 2 m; motors of cars turn at 20,000 rpm.

    Engines in Formula 1 are limited to 15,000 rpm; diesel engines of lorries turn at 1800 rpm.
    """
    text = "links: 2\nmechanisms: {pair: {first: 1, second: 2, ratio: 3}}\ngears: {1: []}\n"
    for vehicle, told in {
        "radius: 300": ["read 300 m, more than a wheel can have"],
        "radius: 300 mm": [],
        "radius: 1.8": [],
        "radius: 0.3, engine: [[900, 900], [1800, 800]]": [
            "read 1800 rad/s, more than an engine can have"
        ],
        "radius: 0.3, engine: [[15000 rpm, 120]]": [],
        "radius: 0.3, machine: {torque: [[20000 rpm, 120]]}": [],
        # in daN/t: github.com/OpenRailAssociation/osrd/pull/17054
        "radius: 0.3, rolling: 12": ["read 12, more than a tyre can have"],
        "radius: 0.3, rolling: 1.2%": [],
        "radius: 0.3}\nbearings: {b: {on: '2', load_per_torque: 1, dynamic: 20}": [
            "read 20 N, less than most bearings can have"
        ],
    }.items():
        case = loads(f"{text}vehicle: {{mass: 1200, {vehicle}}}\n", format="yaml")
        said = [doubt.message for doubt in doubts(case) if doubt.id == "N205"]
        assert [text.split(":")[0] for text in said] == told


@pytest.mark.parametrize(
    "given",
    [
        "radius: 1e-320",
        "radius: 1e308",
        "mass: 1e308",
        "engine: [[1, 1e300]]",
        "engine: [[1e300, 1]]",
        "rolling: {over: speed, points: [[1, 1e300]]}",
        "engine: [[650, 250], [2400 rpm, 420]]",
    ],
)
def test_numbers_that_would_overflow_or_lack_a_unit_are_refused(given: str) -> None:
    vehicle = {"mass": "1200", "radius": "0.3"} | dict([given.split(": ", 1)])
    keys = ", ".join(map(": ".join, vehicle.items()))
    text = f"links: 2\nmechanisms: {{a: {{first: 1, second: 2, ratio: 3}}}}\nvehicle: {{{keys}}}\n"
    with pytest.raises(ReadError, match=rf"vehicle.{given[:4]}.*(1e.15|after 650 rad/s).*E268"):
        loads(text, format="yaml")


@pytest.mark.parametrize(
    ("first", "unit", "warns"),
    [(0, "W", True), (0, "N*m", False), (0.19, "W", True), (0.21, "W", False)],
)
def test_a_loss_that_takes_all_power_near_rest_is_a_doubt(
    first: float, unit: LossUnit, *, warns: bool
) -> None:
    """40 W of the loss are the power of 200 N*m at 0.2 rad/s."""
    loss = MapLaw([0, 200], [[1, 20, 40], [500, 30, 70]], unit)
    car = Vehicle(1000, 0.3, engine=[(first, 200.0), (500.0, 150.0)])
    case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear(loss=loss)], vehicle=car)
    assert ("W892" in [doubt.id for doubt in doubts(case)]) == warns
    assert math.isnan(performance(case).time_to_100) == warns


@pytest.mark.parametrize("key", ["Cd", "wheel_diameter", "traction"])
def test_a_drag_coefficient_and_a_diameter_get_advice(key: str) -> None:
    """The answer "did you mean `drag_area`?" would omit a factor.

    Sources: alternate inputs of vehicles, github.com/NatLabRockies/fastsim/issues/300, and limits
    of traction in pull/256 there.
    """
    text = (
        f"links: 2\nmechanisms: {{a: {{first: 1, second: 2, ratio: 4}}}}\nvehicle: {{{key}: 2.2}}"
    )
    advice = "`drag_area` is the drag coefficient times|`radius` is half|tyres never slip here"
    with pytest.raises(ReadError, match=advice):
        loads(text)
