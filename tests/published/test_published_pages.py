"""The figures of the pages in docs/sources: each that no example there shows."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.commands import ROOT
from tests.published.pages import SOURCES, Row, rounded, rows
from tests.published.test_published_starts import (
    TABLE_3_9,
    TABLE_3_11,
    Dumped,
    chain_of,
    of_table_3_9,
    one_spring,
)
from tests.published.test_published_umdm import TABLE_1, TABLE_1_NUMBERS
from tests.published.vehicle_dynamics_cells import cells
from tests.simulation.boxes import RPM
from tests.torsion.book import scheme
from tests.torsion.table_3_8 import TABLE_3_8
from tests.torsion.test_simplification_tables import GEARS
from tests.torsion.test_table_2_10 import APART, PUBLISHED
from vstatics.core.model.springs import Spring, between
from vstatics.core.model.transmission import Gear, ShiftElement, Transmission
from vstatics.simulation import simulate
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.parts import Capacity, Scenario, Start
from vstatics.torsion.clutch.dumped import dump
from vstatics.torsion.reduction.scheme import natural_frequencies

HERE = Path(__file__).parent
MZKT: dict[str, Any] = json.loads((HERE / "mzkt7922.json").read_text(encoding="utf-8"))


def test_cells_of_the_listing_that_are_wrong_in_print() -> None:
    """All that the published numbers know, with what is printed and what is right."""
    known = {
        f"{one['table']}({one['row']},{gear})": (one["printed"], one["here"])
        for one in MZKT["corrections"]
        for gear in one["gears"]
    }
    idle = MZKT["idle"]
    right = MZKT[idle["table"]][idle["row"] - 1][idle["gears"][0] - 1]
    known[f"{idle['table']}({idle['row']},{idle['gears'][0]})"] = idle["printed"], right
    told = {
        row["cell"]: (float(row["printed"]), float(row["here"]))
        for row in rows("visual-statics", "Cells of the listing")
    }
    assert told == known


def test_cells_of_vehicle_dynamics_that_are_wrong_in_print() -> None:
    found = cells()
    for row in rows("vehicle-dynamics", "Cells that are wrong in print"):
        own = found[row["table"], row["cell"]]
        assert rounded(own, row["here"]) == row["here"], row
        assert own != pytest.approx(float(row["printed"]), rel=0.004), row


def test_frequencies_that_differ_are_the_misprints_of_the_page() -> None:
    """Of the trucks that are counted; the row that is not read is not counted."""
    told = {
        row["cell"]
        for row in rows("vehicle-dynamics", "Cells that are wrong in print")
        if row["table"] == "2.10"
    }
    counted = {
        f"{name} {GEARS[gear]}, {number}"
        for name, truck in PUBLISHED.items()
        for gear, omegas in enumerate(truck["omegas"])
        for number, _ in enumerate(omegas or [], 1)
    }
    assert told & counted == {f"{name} {GEARS[gear - 1]}, {at}" for name, gear, at in APART}
    page = (SOURCES / "vehicle-dynamics.md").read_text(encoding="utf-8")
    of_trucks, of_moskvich = len(counted), 48
    assert f"six trucks | {of_trucks - len(APART)} of {of_trucks} within" in page
    assert f"| 2.5, frequencies | {of_moskvich - 1} of {of_moskvich} within" in page
    method = (ROOT / "docs/method.md").read_text(encoding="utf-8")
    assert f"({of_trucks + of_moskvich} natural frequencies" in method
    assert f"[{len(APART) + 1} of them misprints]" in method


GAZ = [line for line in TABLE_3_8 if line.vehicle == "ГАЗ-53А"]
GAZ_RATIOS = (6.48, 3.09, 1.71, 1.0)


def test_measured_torques_of_a_dumped_clutch() -> None:
    """GAZ-53A, table 3.2: no dump is below what was measured; a motion has the torque of the page."""
    for row in rows("vehicle-dynamics", "Largest torques that were measured"):
        number = GEARS.index(row["gear"])
        speed = float(row["rpm"]) * RPM / GAZ_RATIOS[number]
        line = GAZ[number]._replace(given=GAZ[number].given._replace(omega1=speed))
        made = dump(line.given)
        assert (made.case, rounded(made.max_torque / 1000, "0.00")) == (row["case"], row["dump"])
        peak = simulate(one_spring(line)).peaks["S1"].torque / 1000
        assert rounded(peak, "0.00") == row["simulate"], row
        assert float(row["measured"]) < min(peak, made.max_torque / 1000)


MAZ_RATIOS = (6.17, 3.4, 1.79, 1.0)


def test_measured_torques_of_a_truck_with_many_masses() -> None:
    """MAZ-504, table 3.2: 1780 rpm, a clutch of 1.2 kN*m."""
    for row in rows("vehicle-dynamics", "Largest torques that were measured", 1):
        gear = GEARS.index(row["gear"])
        motion = simulate(chain_of(Dumped("500", gear + 1, {}), 1200, 1780))
        peak = motion.peaks["Y34"].torque * MAZ_RATIOS[gear] / 1000
        assert rounded(peak, "0.00") == row["simulate"]


DAMPING = {"1": TABLE_3_9["scheme"]["K"], "2": [0.005, 0.022, 0.006, 0.032, 0.926, 0.387]}
"""Table 3.10."""
STARTS = rows("vehicle-dynamics", "Starts")


@pytest.mark.slow
@pytest.mark.parametrize("row", STARTS, ids=lambda row: row["variant"])
def test_starts_of_a_car(row: Row, monkeypatch: pytest.MonkeyPatch) -> None:
    """Table 3.9: the printed numbers, and those of the program as the page has them."""
    monkeypatch.setitem(TABLE_3_9["scheme"], "K", DAMPING[row["damping"]])
    rate, speed = float(row["K [1/s]"]), float(row["omega [rad/s]"])
    found = of_table_3_9(
        {
            "params": {
                "MC0": float(row["M_C0"]),
                "Mphi": 1e4 if row["M_phi"] == "-" else float(row["M_phi"]),
                "w0": speed,
                "K": rate,
                "T": 0.6 if rate < 10 else 0.45 if speed < 300 else 0.3,
            }
        }
    )
    known = {one["variant"]: one["published"] for one in TABLE_3_9["cases"]}
    for shaft, key in (("input shaft", "M_PV"), ("half-shafts", "Y_po")):
        printed, here = row[f"{shaft}, printed"], row[f"{shaft}, here"]
        assert rounded(found[key], "0") == here
        if row["variant"] in known:
            assert float(printed) == known[row["variant"]][key]
        if printed != "-":
            assert float(here) == pytest.approx(float(printed), rel=0.04)


def test_starts_of_the_page() -> None:
    """Table 3.11: printed numbers and those of the program as the page has them."""
    assert len(STARTS) == 17
    dumps = {(f"{one.vehicle} {GEARS[one.gear - 1]}"): one for one in TABLE_3_11}
    for row in rows("vehicle-dynamics", "Starts", 1):
        one = dumps[row["vehicle"]]
        peak = simulate(chain_of(one)).peaks[row["shaft"]].torque / 1000
        assert (one.peaks[row["shaft"]], rounded(peak, "0.00")) == (
            float(row["printed"]),
            row["here"],
        )


RATIOS = (9.95, 5.23, 3.44, 2.44, 2.91, 1.52, 1.0, 0.73)
"""Of the gearbox of both trucks."""
FIRST_MASSES = {
    "KrAZ, J_OK": (252, 82.9, 44.7, 30.5, 25.1, 10.4, 7.35, 5.23),
    "MAZ, J_OK": (249, 78.5, 41.3, 27.1, 21.7, 7.04, 3.95, 2.83),
    "MAZ, J_CD": (256, 85.5, 48.3, 34.1, 28.7, 14.0, 10.9, 9.81),
}
"""Of table 2.17, J*10, with J_CD of gear IV as the page corrects it."""
AXLES = {"KrAZ": (1.29, 23.9e-5, 5.30e-5, 7690, 8.4), "MAZ": (1.28, 5.98e-5, 5.35e-5, 7660, 8.44)}
"""Of both trucks: J_K, E_T, E_K, M_phi, and the ratio of the final drive."""
TABLE_3_13 = {
    "KrAZ": (6.77, 6.50, 5.57, 4.67, 5.26, 2.90, 1.84, 1.28),
    "MAZ": (6.78, 6.47, 5.56, 4.42, 5.09, 2.72, 1.72, 1.24),
}
TRUCKS = rows("vehicle-dynamics-cases", "Two 6x4 trucks (tables 2.17, 3.13)")


def torque_of_an_axle(column: str, gear: int) -> float:
    """Half of the largest torque of the first spring, for one of the two axles [kN*m]."""
    wheels, first, tyres, grip, final = AXLES[column[: column.index(",")]]
    ratio = RATIOS[gear]
    inertias = (5.29 * ratio**2, FIRST_MASSES[column][gear] / 10, wheels, 44e3 * 0.51**2 / final**2)
    case = Transmission(
        4,
        [ShiftElement(1, 2, "clutch", static=1.25)],
        [],
        [Gear()],
        inertias=dict(enumerate(inertias, 1)),
        springs=[
            Spring(between(2, 3), compliance=first, name="T"),
            Spring(between(3, 4), compliance=tyres, name="K", limit=grip),
        ],
    )
    control = Capacity(Formula(f"0.8*2500*{ratio}*(1 - exp(-150*t))"))
    start = Start(speeds={1: 2100 / ratio * RPM, 2: 0.0, 3: 0.0, 4: 0.0})
    return simulate(Scenario(case, 0.5, start, {1: control})).peaks["T"].torque / 2000


@pytest.mark.slow
@pytest.mark.parametrize("row", TRUCKS, ids=lambda row: row["gear"])
def test_two_trucks_with_two_axles(row: Row) -> None:
    """Table 3.13 by table 2.17; print and calculation as the page has them."""
    gear = TRUCKS.index(row)
    for truck, printed in TABLE_3_13.items():
        assert float(row[f"{truck}, printed"]) == printed[gear]
    for column in FIRST_MASSES:
        assert rounded(torque_of_an_axle(column, gear), "0.00") == row[column]


TABLE_P2_3 = {
    "VAZ-2101": (
        (1.36, 0.061, 0.032, 0.064, 4.04, 4060, 1560, 316),
        (1.36, 0.076, 0.086, 0.17, 10.7, 1530, 587, 119),
        (1.36, 0.105, 0.204, 0.408, 25.6, 648, 246, 50),
        (1.36, 0.172, 0.452, 0.91, 56.8, 295, 111, 22.5),
    ),
    "Moskvich-412": (
        (1.52, 0.047, 0.044, 0.07, 5.45, 1670, 1520, 210),
        (1.52, 0.064, 0.130, 0.2, 15.9, 577, 519, 71.8),
        (1.52, 0.099, 0.306, 0.5, 37.5, 247, 220, 30.5),
    ),
    "ZIL-130": (
        (9.87, 0.644, 0.086, 0.248, 10.5, 2890, 519, 426),
        (9.87, 0.746, 0.252, 0.818, 34.6, 885, 157, 129),
        (9.87, 1.09, 0.904, 2.60, 111, 278, 49, 40.3),
        (9.87, 1.78, 2.19, 6.32, 270, 115, 20.2, 16.6),
        (9.87, 3.16, 4.74, 13.6, 583, 54.1, 9.46, 7.69),
    ),
    "MAZ-500A": (
        (37, 1.90, 0.078, 0.775, 29.2, 423, 247, 171),
        (37, 2.22, 0.253, 2.53, 95.2, 131, 76.2, 52),
        (37, 3.38, 0.927, 9.34, 349, 37.8, 20.8, 14.3),
        (37, 5.41, 2.15, 21.8, 806, 16.9, 8.96, 6.18),
        (37, 8.89, 4.85, 50.3, 1830, 8.66, 3.96, 2.73),
    ),
}
"""J_D, J_T, J_p, J_K, J_A by 10, E_T, E_p, E_K by 1e-5, gear by gear."""
MEASURED = {
    "VAZ-2101": (12.8, 18.8, 27.4, 39.2),
    "Moskvich-412": (15.2, 22.7, 32.1),
    "ZIL-130": (5.88, 8.83, 14.4, 18.9, 26.6),
    "MAZ-500A": (8.08, 10.5, 19.6, 25, 32.1),
}
"""Tables P2.1 and P2.2."""


def test_measured_frequencies() -> None:
    """The page has all of them, beside those of the parameters of table P2.3."""
    told = rows("vehicle-dynamics-cases", "Measured frequencies (tables P2.1 to P2.3)")
    known = [(car, gear) for car, omegas in MEASURED.items() for gear in range(len(omegas))]
    assert [(row["vehicle"], row["gear"]) for row in told] == [
        (car, GEARS[gear]) for car, gear in known
    ]
    for row, (car, gear) in zip(told, known, strict=True):
        *masses, shaft, axle, tyres = TABLE_P2_3[car][gear]
        engine, driven, casing, wheels, vehicle = (mass / 10 for mass in masses)
        springs = [
            {"twist": {1: 1, 2: -1, 3: -1}, "compliance": shaft},
            {"twist": {2: 1}, "compliance": axle},
            {"twist": {3: 1, 4: -1}, "compliance": tyres},
        ]
        own = natural_frequencies(
            scheme([engine + driven, casing, wheels, vehicle], springs, 1e-5)
        )[0]
        measured = MEASURED[car][gear]
        assert float(row["measured"]) == measured
        assert rounded(own, "0.00") == row["here"]
        assert f"{(own / measured - 1) * 100:+.1f}" == row["difference, %"]


def test_table_1_of_the_umdm() -> None:
    """The page has the printed signs, and ratios of the program that agree with them."""
    found = {}
    for row in rows("umdm", "Table 1"):
        signs = dict(zip("145678", row["printed"].split(), strict=True))
        own = {brake: sign.replace("±", "+-") for brake, sign in signs.items() if sign != "."}
        ratios = dict(zip(own, row["ratios here"].split(), strict=True))
        assert own == TABLE_1[row["ports"]]
        found[row["ports"]] = {brake: float(value) for brake, value in ratios.items()}
        assert all(
            ("-" if value < 0 else "+") in own[one] for one, value in found[row["ports"]].items()
        )
    assert found == TABLE_1_NUMBERS
