"""Figures of the pages in docs/sources that torsion calculates."""

import pytest

from tests.commands import ROOT
from tests.published.pages import SOURCES, rounded, rows
from tests.torsion.book import scheme, table
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
    assert f"- {of_trucks + of_moskvich} published natural frequencies" in method
    assert f"[{len(APART) + 1} of them misprints]" in method


MEASURED = table("table_p2_3")["vehicles"]


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
