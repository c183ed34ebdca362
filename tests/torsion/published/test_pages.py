"""Figures of the pages in docs/sources that torsion calculates."""

import pytest

from tests.commands import ROOT
from tests.published.pages import SOURCES, rounded, rows
from tests.torsion.book import scheme
from tests.torsion.published.vehicle_dynamics_cells import cells
from tests.torsion.test_book_vehicles import APART, PUBLISHED
from tests.torsion.test_simplification_tables import GEARS
from vstatics.torsion.reduction.scheme import natural_frequencies


def test_cells_of_vehicle_dynamics_that_are_wrong_in_print() -> None:
    found = cells()
    for row in rows("vehicle-dynamics", "Cells that are wrong in print"):
        table, _, cell = row["cell"].partition(" ")
        own = found[table, cell]
        assert rounded(own, row["here"]) == row["here"], row
        assert own != pytest.approx(float(row["printed"]), rel=0.004), row


def test_frequencies_that_differ_are_the_misprints_of_the_page() -> None:
    """Of the trucks that are counted; the row that is not read is not counted."""
    told = {
        row["cell"].removeprefix("2.10 ")
        for row in rows("vehicle-dynamics", "Cells that are wrong in print")
        if row["cell"].startswith("2.10 ")
    }
    counted = {
        f"{name} {GEARS[gear]}, {number}"
        for name, truck in PUBLISHED.items()
        for gear, omegas in enumerate(truck["omegas"])
        for number, _ in enumerate(omegas or [], 1)
    }
    assert told & counted == {f"{name} {GEARS[gear - 1]}, {at}" for name, gear, at in APART}
    page = (SOURCES / "vehicle-dynamics.md").read_text("utf-8")
    of_trucks, of_moskvich = len(counted), 48
    assert f"six trucks | {of_trucks - len(APART)} of {of_trucks} within" in page
    assert f"| 2.5, frequencies | {of_moskvich - 1} of {of_moskvich} within" in page
    method = (ROOT / "docs/method.md").read_text("utf-8")
    assert f"({of_trucks + of_moskvich} natural frequencies" in method
    assert f"[{len(APART) + 1} of them misprints]" in method


MEASURED = {
    "VAZ-2101": (
        (12.8, 1.36, 0.061, 0.032, 0.064, 4.04, 4060, 1560, 316),
        (18.8, 1.36, 0.076, 0.086, 0.17, 10.7, 1530, 587, 119),
        (27.4, 1.36, 0.105, 0.204, 0.408, 25.6, 648, 246, 50),
        (39.2, 1.36, 0.172, 0.452, 0.91, 56.8, 295, 111, 22.5),
    ),
    "Moskvich-412": (
        (15.2, 1.52, 0.047, 0.044, 0.07, 5.45, 1670, 1520, 210),
        (22.7, 1.52, 0.064, 0.130, 0.2, 15.9, 577, 519, 71.8),
        (32.1, 1.52, 0.099, 0.306, 0.5, 37.5, 247, 220, 30.5),
    ),
    "ZIL-130": (
        (5.88, 9.87, 0.644, 0.086, 0.248, 10.5, 2890, 519, 426),
        (8.83, 9.87, 0.746, 0.252, 0.818, 34.6, 885, 157, 129),
        (14.4, 9.87, 1.09, 0.904, 2.60, 111, 278, 49, 40.3),
        (18.9, 9.87, 1.78, 2.19, 6.32, 270, 115, 20.2, 16.6),
        (26.6, 9.87, 3.16, 4.74, 13.6, 583, 54.1, 9.46, 7.69),
    ),
    "MAZ-500A": (
        (8.08, 37, 1.90, 0.078, 0.775, 29.2, 423, 247, 171),
        (10.5, 37, 2.22, 0.253, 2.53, 95.2, 131, 76.2, 52),
        (19.6, 37, 3.38, 0.927, 9.34, 349, 37.8, 20.8, 14.3),
        (25, 37, 5.41, 2.15, 21.8, 806, 16.9, 8.96, 6.18),
        (32.1, 37, 8.89, 4.85, 50.3, 1830, 8.66, 3.96, 2.73),
    ),
}
"""Measured frequency (tables P2.1 and P2.2), gear by gear; from table P2.3 J_D, J_T, J_p, J_K, J_A
by 10, E_T, E_p, E_K by 1e-5."""


def test_measured_frequencies() -> None:
    """The page has all of them, beside those of the parameters of table P2.3."""
    told = rows("vehicle-dynamics-cases", "Measured frequencies (tables P2.1 to P2.3)")
    assert [row["vehicle"] for row in told] == [*MEASURED]
    for row in told:
        for gear, (measured, *masses, shaft, axle, tyres) in enumerate(MEASURED[row["vehicle"]]):
            engine, driven, casing, wheels, vehicle = (mass / 10 for mass in masses)
            springs = [
                {"twist": {1: 1, 2: -1, 3: -1}, "compliance": shaft},
                {"twist": {2: 1}, "compliance": axle},
                {"twist": {3: 1, 4: -1}, "compliance": tyres},
            ]
            inertias = [engine + driven, casing, wheels, vehicle]
            own, *_ = natural_frequencies(scheme(inertias, springs, 1e-5))
            assert row[GEARS[gear]] == f"{measured:g}/{own:.2f}"
