"""The figures of the pages in docs/sources: each that no example there shows."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.commands import ROOT
from tests.published.pages import SOURCES, rounded, rows
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
from tests.torsion.table_3_8 import TABLE_3_8
from tests.torsion.test_simplification_tables import GEARS
from tests.torsion.test_table_2_10 import APART, PUBLISHED
from vstatics.simulation import simulate
from vstatics.torsion.clutch.dumped import dump

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


def test_starts_of_the_page() -> None:
    """Tables 3.9 and 3.11: printed numbers and those of the program as the page has them."""
    starts = {one["params"]["K"]: one for one in TABLE_3_9["cases"][:5]}
    for row in rows("vehicle-dynamics", "Starts"):
        one = starts[float(row["K [1/s]"])]
        found = of_table_3_9(one)
        for shaft, key in (("input shaft", "M_PV"), ("half-shafts", "Y_po")):
            printed, here = row[f"{shaft}, printed"], row[f"{shaft}, here"]
            assert float(printed) == one["published"][key]
            assert rounded(found[key], "0") == here
    dumps = {(f"{one.vehicle} {GEARS[one.gear - 1]}"): one for one in TABLE_3_11}
    for row in rows("vehicle-dynamics", "Starts", 1):
        one = dumps[row["vehicle"]]
        peak = simulate(chain_of(one)).peaks[row["shaft"]].torque / 1000
        assert (one.peaks[row["shaft"]], rounded(peak, "0.00")) == (
            float(row["printed"]),
            row["here"],
        )


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
