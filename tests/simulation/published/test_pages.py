"""Figures of the pages in docs/sources that a simulation calculates."""

import re

import pytest

from tests.published.pages import Row, rounded, rows
from tests.simulation.boxes import RPM
from tests.simulation.published.test_published_starts import (
    TABLE_3_9,
    TABLE_3_11,
    chain_of,
    of_table_3_9,
    one_spring,
)
from tests.simulation.test_closed_forms import links
from tests.torsion.book import TABLE_3_8
from tests.torsion.test_simplification_tables import GEARS
from vstatics import ShiftElement, Spring
from vstatics.core.model.springs import between
from vstatics.simulation import Capacity, Formula, Scenario, Start, simulate
from vstatics.torsion.clutch.dumped import dump

GAZ = [line for line in TABLE_3_8 if line.vehicle == "ГАЗ-53А"]
GAZ_RATIOS = (6.48, 3.09, 1.71, 1.0)


def test_measured_torques_of_a_dumped_clutch() -> None:
    """GAZ-53A, table 3.2: no dump is below what was measured; motions have torques of the page."""
    count = 0
    for row in rows("vehicle-dynamics", "Largest torques that were measured"):
        number = GEARS.index(row["gear"])
        for rpm, measured, dumped, simulated in re.findall(
            r"(\d+): ([\d.]+)/([\d.]+)/([\d.]+)", " ".join(row.values())
        ):
            speed = float(rpm) * RPM / GAZ_RATIOS[number]
            line = GAZ[number]._replace(given=GAZ[number].given._replace(omega1=speed))
            largest = dump(line.given).max_torque / 1000
            peak = simulate(one_spring(line)).peaks["S1"].torque / 1000
            assert (rounded(largest, "0.00"), rounded(peak, "0.00")) == (dumped, simulated), row
            assert float(measured) < min(peak, largest)
            count += 1
    assert count == 12


MAZ_RATIOS = (6.17, 3.4, 1.79, 1.0)


def test_measured_torques_of_a_truck_with_many_masses() -> None:
    """MAZ-504, table 3.2: 1780 rpm, a clutch of 1.2 kN*m."""
    for row in rows("vehicle-dynamics", "Largest torques that were measured", 1):
        gear = GEARS.index(row["gear"])
        [of] = [one for one in TABLE_3_11 if (one.vehicle, one.gear) == ("500", gear + 1)]
        motion = simulate(chain_of(of, 1200, 1780))
        peak = motion.peaks["Y34"].torque * MAZ_RATIOS[gear] / 1000
        assert rounded(peak, "0.00") == row["simulate"]


DAMPING = {"1": TABLE_3_9["scheme"]["K"], "2": [0.005, 0.022, 0.006, 0.032, 0.926, 0.387]}
"""Table 3.10."""
STARTS = rows("vehicle-dynamics", "Starts")


@pytest.mark.slow
@pytest.mark.parametrize("row", STARTS, ids=lambda row: row["variant"])
def test_starts_of_a_car(row: Row, monkeypatch: pytest.MonkeyPatch) -> None:
    """Table 3.9: the printed numbers, and those of the program as the page has them."""
    variant = row["variant"]
    damping = "2" if variant in {"1.7", "1.10"} else "1"
    monkeypatch.setitem(TABLE_3_9["scheme"], "K", DAMPING[damping])
    rate, speed = float(row["K [1/s]"]), 607 if variant in {"1.6", "1.7", "1.12", "2.5"} else 262
    grip = 1e4 if variant in {"1.8", "1.9", "1.10", "1.11", "1.12"} else 130
    duration = 0.6 if rate < 10 else 0.45 if speed < 300 else 0.3
    params = {"MC0": {"1": 182, "2": 130}[variant[0]], "Mphi": grip, "w0": speed, "K": rate}
    found = of_table_3_9({"params": {**params, "T": duration}})
    known = {one["variant"]: one["published"] for one in TABLE_3_9["cases"]}
    for shaft, key in (("input shaft", "M_PV"), ("half-shafts", "Y_po")):
        printed, here = row[shaft].split("/")
        assert rounded(found[key], "0") == here
        if variant in known:
            assert float(printed) == known[variant][key]
        if printed != "-":
            assert float(here) == pytest.approx(float(printed), rel=0.04)


def test_starts_of_the_page() -> None:
    """Table 3.11: printed numbers and those of the program as the page has them."""
    assert len(STARTS) == 17
    dumps = {(one.vehicle, GEARS[one.gear - 1]): one for one in TABLE_3_11}
    count = 0
    for row in rows("vehicle-dynamics", "Starts", 1):
        for vehicle in ("500", "200"):
            one = dumps[vehicle, row["gear"]]
            peaks = simulate(chain_of(one)).peaks
            for shaft, printed, here in re.findall(r"(Y\d+) ([\d.]+)/([\d.]+)", row[vehicle]):
                peak = peaks[shaft].torque / 1000
                assert (one.peaks[shaft], rounded(peak, "0.00")) == (float(printed), here)
                count += 1
    assert count == 11


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
    springs = (
        Spring(between(2, 3), compliance=first, name="T"),
        Spring(between(3, 4), compliance=tyres, name="K", limit=grip),
    )
    clutch = ShiftElement(1, 2, "clutch", static=1.25)
    case = links(*inertias, elements=(clutch,), springs=springs)
    control = Capacity(Formula(f"0.8*2500*{ratio}*(1 - exp(-150*t))"))
    start = Start(speeds={1: 2100 / ratio * RPM, 2: 0.0, 3: 0.0, 4: 0.0})
    return simulate(Scenario(case, 0.5, start, {1: control})).peaks["T"].torque / 2000


@pytest.mark.slow
@pytest.mark.parametrize("row", TRUCKS, ids=lambda row: row["gear"])
def test_two_trucks_with_two_axles(row: Row) -> None:
    """Table 3.13 by table 2.17; print and calculation as the page has them."""
    gear = TRUCKS.index(row)
    for truck, printed in TABLE_3_13.items():
        columns = [column for column in FIRST_MASSES if column.startswith(truck)]
        own = [rounded(torque_of_an_axle(column, gear), "0.00") for column in columns]
        assert row[truck] == "/".join([f"{printed[gear]:.2f}", *own])
