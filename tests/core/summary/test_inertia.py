"""The inertia of a gear at its input, and the acceleration that a torque gives it."""

from __future__ import annotations

import csv
import io
import math

import pytest

from tests.commands import CASES, MZKT, json_answer, vstatics
from vstatics import Gear, Load, Mechanism, ShiftElement, Spring, Transmission, loads, solve
from vstatics.core.model.transmission import SpeedOf
from vstatics.core.summary import summarize
from vstatics.core.summary.inertia import reduced_inertias

BOX = CASES / "tarasik-box.yaml"
INERTIAS = {
    "1": 7.041434,
    "2": 10.820837,
    "3": 14.741460,
    "4": 27.973937,
    "5": 47.1,
    "6": 100.058008,
    "R1": 6.878793,
    "R2": 10.458527,
}
ACCELERATIONS = {
    "1": 170.419842,
    "2": 97.241908,
    "3": 61.255805,
    "4": 21.768664,
    "5": 6.369427,
    "6": -2.908760,
    "R1": 252.133635,
    "R2": 176.871320,
}
"""Of the box of seven links for 1500 N*m at its input and -1200 N*m at its output: an integration
of the equations of motion with locked clutches, another program, which tells six decimals."""


def document(*arguments: object) -> dict[str, list[dict[str, float]]]:
    made: dict[str, list[dict[str, float]]] = json_answer(*arguments)
    return made


def by_gear(lines: list[dict[str, float]], field: str) -> dict[float, float]:
    return {line["gear"]: line[field] for line in lines}


@pytest.mark.parametrize("torque", ["-1200", "-1.2 kN*m", "-1200 N*m"])
def test_the_box_of_seven_links(torque: str) -> None:
    lines = document("summary", BOX, "--output-torque", torque)["inertia"]
    assert by_gear(lines, "inertia") == pytest.approx(INERTIAS, abs=5.1e-7, rel=0)
    assert by_gear(lines, "acceleration") == pytest.approx(ACCELERATIONS, abs=5.1e-7, rel=0)


def test_a_load_alone_accelerates() -> None:
    """By 1500 N*m and the inertias above."""
    lines = document("summary", BOX)["inertia"]
    expected = {gear: 1500 / inertia for gear, inertia in INERTIAS.items()}
    assert by_gear(lines, "acceleration") == pytest.approx(expected, rel=1e-7)


def test_every_format_has_the_table() -> None:
    plain = vstatics("summary", BOX, "--output-torque=-1200").out
    table = plain.partition("Inertia at the input, acceleration of the input\n")[2]
    assert table.splitlines()[:2] == [
        "gear  inertia, kg*m^2  acceleration, rad/s^2",
        "1               7.041                170.420",
    ]
    assert "| 1 | 7.041 | 170.420 |" in vstatics(
        "summary", BOX, "--output-torque=-1200", "-f", "markdown"
    ).out.replace("  ", " ").replace("  ", " ")
    written = vstatics("summary", BOX, "--output-torque=-1200", "-f", "csv").out
    rows = [row for row in csv.reader(io.StringIO(written)) if "inertia" in row]
    found = [float(cell) for row in rows for cell in row if cell.startswith("170.41984")]
    assert found == pytest.approx([ACCELERATIONS["1"]], abs=5.1e-7, rel=0)


def test_cases_side_by_side() -> None:
    out = vstatics("summary", BOX, CASES / "moskvich412.yaml").out
    table = out.partition("Inertia at the input, acceleration of the input\n")[2]
    heading, first, *_ = table.splitlines()
    assert heading.split("  ")[-1].strip() == "acceleration, rad/s^2 A"
    assert first.split()[:2] == ["1", "7.041"]
    assert "Inertia at the input" not in vstatics("summary", MZKT, MZKT).out


def test_a_case_without_inertias_has_no_table() -> None:
    assert "inertia" not in document("summary", MZKT)
    assert "Inertia" not in vstatics("summary", MZKT).out


def test_a_torque_that_is_none_is_refused() -> None:
    said = vstatics("summary", BOX, "--output-torque", "3 kg")
    assert said.is_wrong_use("read '3 kg', expected a torque in N*m, bare or with its unit")


@pytest.mark.parametrize(
    ("seconds", "inertia"),
    [
        (0, 0.811111),
        (1, 0.723162),
        (2, 0.647049),
        (3, 0.584538),
        (4, 0.537639),
        (5, 0.508642),
        (500 / 85, 0.5),
    ],
)
def test_a_set_while_its_brake_slips(seconds: float, inertia: float) -> None:
    """Tarasik 2018, the example of figure 2: n_in = 500 - 10 t, n_out = 30 t rpm, K = -1.5."""
    ratio = 30 * seconds / (500 - 10 * seconds)
    case = Transmission(
        3,
        [],
        [Mechanism(1, 2, 3, -1.5)],
        [Gear(speeds={3: ratio})],
        inertias={1: 0.5, 2: 0.7},
        load=Load(torque=40),
    )
    [line] = reduced_inertias(solve(case))
    assert line.inertia == pytest.approx(inertia, abs=5.1e-7)
    assert math.isnan(line.acceleration) or seconds == 0  # who holds the output is not told


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
    case = Transmission(
        3,
        [],
        [Mechanism(2, 3, 0, 4.0)],
        [],
        inertias={1: 0.5, 3: 8},
        springs=[Spring({1: 1, 2: -1}, stiffness=100)],
    )
    [line] = reduced_inertias(solve(case))
    assert line.inertia == 1.0


def test_a_speed_that_is_not_determined_counts_if_something_heavy_has_it() -> None:
    def inertia(**more: object) -> float:
        case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], **more)  # type: ignore[arg-type]
        [line] = reduced_inertias(solve(case))
        return line.inertia

    assert inertia(inertias={1: 0.5}) == 0.5
    assert inertia(inertias={1: 0.5, 2: 0, 3: 0}) == 0.5
    assert math.isnan(inertia(inertias={1: 0.5, 2: 0.1}))


def accelerations(gears: list[Gear], **more: object) -> list[float]:
    """Of gears 2 to 1 with a further link at the ratio 4; 0.5 kg*m^2 at the input, 100 N*m."""
    case = Transmission(
        3,
        [ShiftElement(3)],
        [Mechanism(1, 2, 0, 2.0), Mechanism(1, 3, 0, 4.0)],
        gears,
        output=2,
        inertias={1: 0.5},
        load=Load(torque=100),
        **more,  # type: ignore[arg-type]
    )
    return [line.acceleration for line in summarize(solve(case), output_torque=-80).inertias]


def test_torques_of_a_gear_count() -> None:
    assert accelerations([Gear(), Gear(torques={3: -0.4})]) == [(100 - 40) / 0.5, (60 - 10) / 0.5]


def test_coasting_turns_the_torque_of_the_load() -> None:
    assert accelerations([Gear()], coast=True) == [(-100 - 40) / 0.5]


def test_who_drives_at_a_given_speed_has_an_unknown_torque() -> None:
    case = Transmission(
        3,
        [],
        [Mechanism(1, 2, 3, -2.5)],
        [Gear(speeds={2: 0}), Gear(speeds={2: 0.5}), Gear(speeds={2: SpeedOf(3, 0.5)})],
        inertias={1: 0.5},
        load=Load(torque=100),
    )
    found = [line.acceleration for line in reduced_inertias(solve(case))]
    assert found == pytest.approx([200, math.nan, math.nan], nan_ok=True)


def test_gears_of_their_own_load() -> None:
    assert accelerations([Gear(load=Load(torque=200))]) == [(200 - 40) / 0.5]


@pytest.mark.parametrize("battery", [-2.0, 1.5])
def test_a_machine_that_a_battery_balances_accelerates_with_the_engine(battery: float) -> None:
    """By its power, 1800 W of 2 kW that it takes, or 1.5/.9 kW where it charges."""
    case = loads(f"""
links: [MG1, output, engine, MG2]
input: engine
output: output
load: {{speed: 2000 rpm, torque: 110 N*m}}
mechanisms:
  set: {{first: MG1, second: output, third: engine, ratio: -2.6, efficiency: .98}}
  pair: {{first: MG2, second: output, ratio: 2.63, efficiency: .98}}
inertias: {{engine: .15, MG2: .03, output: 5}}
shift_elements: {{B: [MG1, housing]}}
gears: {{drive: {{engaged: [B], balance: {{MG2: .9, battery: {battery} kW}}}}}}
""")
    [line] = reduced_inertias(solve(case), output_torque=-100)
    output = 3.6 / 2.6
    machine = -battery * (0.9 if battery < 0 else 1 / 0.9) * 1000 / (2000 * math.pi / 30)
    inertia = 0.15 + output**2 * (5 + 0.03 * 2.63**2)
    expected = (110 + machine - 100 * output) / inertia
    assert (line.inertia, line.acceleration) == pytest.approx((inertia, expected), rel=1e-9)
