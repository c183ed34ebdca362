"""The inertia of a gear at its input, and the acceleration that a torque gives it."""

import math

import pytest

from tests.commands import CASES, MZKT, json_answer, vstatics
from vstatics import Gear, Load, Mechanism, ShiftElement, Spring, Transmission, loads, solve
from vstatics.core.model.transmission import SpeedOf
from vstatics.core.summary import summarize
from vstatics.core.summary.inertia import reduced_inertias

BOX = CASES / "tarasik-box.yaml"
WORKED = {
    "1": (7.041434, 170.419842),
    "2": (10.820837, 97.241908),
    "3": (14.741460, 61.255805),
    "4": (27.973937, 21.768664),
    "5": (47.1, 6.369427),
    "6": (100.058008, -2.908760),
    "R1": (6.878793, 252.133635),
    "R2": (10.458527, 176.871320),
}
"""Inertia and acceleration of the box of seven links for 1500 N*m at its input and -1200 N*m at its
output: an integration of the equations of motion with locked clutches, another program, which tells
six decimals."""


def test_the_box_of_seven_links() -> None:
    """A load alone accelerates by 1500 N*m."""
    for torque in ("-1200", "-1.2 kN*m", "-1200 N*m"):
        for line in json_answer("summary", BOX, "--output-torque", torque)["inertia"]:
            expected = pytest.approx(WORKED[line["gear"]], abs=5.1e-7, rel=0)
            assert (line["inertia"], line["acceleration"]) == expected
    for line in json_answer("summary", BOX)["inertia"]:
        assert line["acceleration"] == pytest.approx(1500 / WORKED[line["gear"]][0], rel=1e-7)
    said = vstatics("summary", BOX, "--output-torque", "3 kg")
    assert said.is_wrong_use("read '3 kg', expected a torque in N*m, bare or with its unit")


def test_texts_have_the_table_of_one_case_and_of_several_if_there_is_one() -> None:
    title = "Inertia at the input, acceleration of the input\n"
    table = vstatics("summary", BOX, "--output-torque=-1200").out.partition(title)[2]
    assert table.splitlines()[:2] == [
        "gear  inertia, kg*m^2  acceleration, rad/s^2",
        "1               7.041                170.420",
    ]
    table = vstatics("summary", BOX, CASES / "moskvich412.yaml").out.partition(title)[2]
    heading, first, *_ = table.splitlines()
    assert heading.split("  ")[-1].strip() == "acceleration, rad/s^2 A"
    assert first.split()[:2] == ["1", "7.041"]
    assert "inertia" not in json_answer("summary", MZKT)
    for cases in ((MZKT,), (MZKT, MZKT)):
        assert "Inertia" not in vstatics("summary", *cases).out


def of(
    mechanisms: list[Mechanism], *gears: Gear, links: int = 3, **more: object
) -> list[tuple[float, float]]:
    case = Transmission(links, [], mechanisms, gears, **more)  # type: ignore[arg-type]
    return [(line.inertia, line.acceleration) for line in reduced_inertias(solve(case))]


def test_a_set_while_its_brake_slips() -> None:
    """Tarasik 2018, the example of figure 2: n_in = 500 - 10 t, n_out = 30 t rpm, K = -1.5."""
    printed = {0.0: 0.811111, 1: 0.723162, 2: 0.647049, 3: 0.584538, 4: 0.537639, 5: 0.508642}
    printed[500 / 85] = 0.5
    gears = [Gear(speeds={3: 30 * t / (500 - 10 * t)}) for t in printed]
    sets, load = [Mechanism(1, 2, 3, -1.5)], Load(torque=40)
    lines = of(sets, *gears, inertias={1: 0.5, 2: 0.7}, load=load)
    assert [found for found, _ in lines] == pytest.approx([*printed.values()], abs=5.1e-7)
    assert all(math.isnan(one) for _, one in lines[1:])  # who holds the output is not told


def test_planets_turn_with_their_carrier_and_about_their_pins() -> None:
    """Sun 30 in, ring 90 held, carrier out at 1/4; the planet of 30 rolls off at -1/4 * 2."""
    case = loads("""
links: [sun, ring, carrier]
inertias: {sun: 0.5}
elements:
  P: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 90},
      planets: 4, planet: {inertia: 1e-3, mass: 0.5, radius: 0.1}}
shift_elements: {B: [ring, housing]}
gears: {low: [B]}
""")
    [line] = reduced_inertias(solve(case))
    assert line.inertia == pytest.approx(0.5 + 4 * (1e-3 * 0.5**2 + 0.5 * 0.1**2 * 0.25**2))


def test_a_shaft_does_not_wind_up() -> None:
    """8 kg*m^2 behind the ratio 4 are 0.5."""
    shaft = Spring({1: 1, 2: -1}, stiffness=100)
    [(inertia, _)] = of([Mechanism(2, 3, 0, 4.0)], inertias={1: 0.5, 3: 8}, springs=[shaft])
    assert inertia == 1.0


def test_a_speed_that_is_not_determined_counts_if_something_heavy_has_it() -> None:
    for inertias, expected in (({}, 0.5), ({2: 0, 3: 0}, 0.5), ({2: 0.1}, math.nan)):
        [(found, _)] = of([Mechanism(1, 2, 3, -2.5)], Gear(), inertias={1: 0.5, **inertias})
        assert found == pytest.approx(expected, nan_ok=True)


def test_torques_of_the_gear_the_load_and_the_output_accelerate() -> None:
    """Ratio 2, a link at the ratio 4; 0.5 kg*m^2 and 100 N*m at the input, -80 at the output."""

    def accelerations(*gears: Gear, **more: object) -> list[float]:
        pairs = [Mechanism(1, 2, 0, 2.0), Mechanism(1, 3, 0, 4.0)]
        known = {"output": 2, "inertias": {1: 0.5}, "load": Load(torque=100), **more}
        case = Transmission(3, [ShiftElement(3)], pairs, gears, **known)  # type: ignore[arg-type]
        return [line.acceleration for line in summarize(solve(case), output_torque=-80).inertias]

    driven = accelerations(Gear(), Gear(torques={3: -0.4}), Gear(load=Load(torque=200)))
    assert driven == [(100 - 40) / 0.5, (60 - 10) / 0.5, (200 - 40) / 0.5]
    assert accelerations(Gear(), coast=True) == [(-100 - 40) / 0.5]


def test_who_drives_at_a_given_speed_has_an_unknown_torque() -> None:
    gears = [Gear(speeds={2: 0}), Gear(speeds={2: 0.5}), Gear(speeds={2: SpeedOf(3, 0.5)})]
    found = of([Mechanism(1, 2, 3, -2.5)], *gears, inertias={1: 0.5}, load=Load(torque=100))
    assert [one for _, one in found] == pytest.approx([200, math.nan, math.nan], nan_ok=True)


def test_a_machine_that_a_battery_balances_accelerates_with_the_engine() -> None:
    """By its power, 1800 W of 2 kW that it takes, or 1.5/.9 kW where it charges."""
    text = """
links: [MG1, output, engine, MG2]
input: engine
output: output
load: {speed: 2000 rpm, torque: 110 N*m}
mechanisms:
  set: {first: MG1, second: output, third: engine, ratio: -2.6, efficiency: .98}
  pair: {first: MG2, second: output, ratio: 2.63, efficiency: .98}
inertias: {engine: .15, MG2: .03, output: 5}
shift_elements: {B: [MG1, housing]}
gears: {drive: {engaged: [B], balance: {MG2: .9, battery: -2 kW}}}
"""
    output = 3.6 / 2.6
    for battery, power in ((-2, 2000 * 0.9), (1.5, -1500 / 0.9)):
        case = loads(text.replace("-2 kW", f"{battery} kW"))
        [line] = reduced_inertias(solve(case), output_torque=-100)
        inertia = 0.15 + output**2 * (5 + 0.03 * 2.63**2)
        expected = (110 + power / (2000 * math.pi / 30) - 100 * output) / inertia
        assert (line.inertia, line.acceleration) == pytest.approx((inertia, expected), rel=1e-9)
