"""Simplified schemes of Tsitovich and Algin, Vehicle dynamics (1981), as printed."""

from collections.abc import Iterator
from typing import Any

import pytest

from tests.torsion.book import TENTH, chain, percent, scheme, table
from vstatics.torsion.reduction.chain import partial_systems, scheme_of
from vstatics.torsion.reduction.merging import simplify_merging
from vstatics.torsion.reduction.scheme import natural_frequencies
from vstatics.torsion.reduction.simplification import SimplificationRule, simplify

GEARS = ("I", "II", "III", "IV", "V")
RULES: tuple[SimplificationRule, ...] = ("r", "b", "u")


def test_one_link_schemes_of_table_2_6() -> None:
    document = table("table_2_6")
    differences = {}
    for row in document["omega"]:
        for gear, printed in enumerate(row["printed"]):
            compliances = [document["damper"][row["damper"]], *document["compliances"][gear]]
            if row["with reaction"]:
                compliances[3] += document["reaction"][gear]
            given = scheme_of(chain(document["inertias"][gear], compliances))
            [omega] = simplify(given, 1).steps[-1].omegas
            cell = row["damper"], row["with reaction"], GEARS[gear]
            differences[cell] = percent(omega, printed)
    assert len(differences) == 16
    assert {cell for cell, off in differences.items() if off > 0.06} == {
        tuple(cell) for cell in document["slips"]
    }


def test_highest_partial_frequencies_of_table_2_8() -> None:
    count = 0
    for vehicle in table("table_2_8")["vehicles"].values():
        for gear, dampers in enumerate(vehicle["highest"]):
            for state, printed in enumerate(dampers):
                behind = [vehicle[f"J{mass}"][gear] for mass in range(2, 7)]
                inertias = [sum(vehicle["J1"]), *behind]
                others = [vehicle[name][gear] for name in ("E23", "E34", "E45", "E56")]
                compliances = [vehicle["E12"][gear][state], *others]
                systems = partial_systems(chain(inertias, compliances))
                highest = max(system.frequency for system in systems)
                assert highest == pytest.approx(printed, rel=0.0025)
                count += 1
    assert count == 58


def cells_of_p1_2() -> Iterator[tuple[tuple[str, str, int, int], float, float]]:
    """Scheme, rule, number of masses and of the frequency; calculated and printed."""
    for part in table("table_p1_2")["schemes"]:
        given = scheme(part["inertias"], part["springs"], 1e-6)
        name, masses = part["name"], len(part["inertias"])
        rows: list[tuple[str, int, tuple[float, ...], list[float]]] = []
        rows.append(("full", masses, natural_frequencies(given), part["full"]))
        for rule in RULES:
            printed = part["steps"][rule]
            for gone, step in enumerate(simplify(given, len(printed[-1]), rule).steps, 1):
                rows.append((rule, masses - gone, step.omegas, printed[gone - 1]))
        for label, count, omegas, numbers in rows:
            for mode, (omega, number) in enumerate(zip(omegas, numbers, strict=True), 1):
                yield (name, label, count, mode), omega, number


def test_frequencies_of_table_p1_2() -> None:
    cells = [*cells_of_p1_2()]
    off = {cell for cell, omega, printed in cells if percent(omega, printed) > 0.55}
    assert len(cells) == 2 * 6 + 3 * (5 + 4 + 3 + 2 + 1) + 3 * (5 + 4 + 3)
    assert off == {tuple(cell) for cell in table("table_p1_2")["slips"]}


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("part", table("table_p1_2")["schemes"], ids=["a", "b"])
def test_masses_are_removed_in_the_order_of_table_p1_2(
    part: dict[str, Any], rule: SimplificationRule
) -> None:
    given = scheme(part["inertias"], part["springs"], 1e-6)
    steps = simplify(given, len(part["steps"]["r"][-1]), rule).steps
    assert [step.operation for step in steps] == [f"remove {mass}" for mass in part["removed"]]
    if rule == "r":
        found = [step.partial_frequency for step in steps]
        assert found == pytest.approx(part["partial"], rel=0.003)


def test_kamaz_of_table_2_15() -> None:
    """Mass 6 is removed though the rule takes another, then what turns as one; then by the rule."""
    document = table("table_2_15")
    inertias = [inertia * TENTH for inertia in document["inertias"]]
    given = scheme(inertias, document["springs"], 1e-5)
    assert natural_frequencies(given) == pytest.approx(document["full"], rel=0.0035)
    assert simplify(given, 8).steps[0].operation == "remove 3"
    [step] = simplify(given, 8, remove=["6"]).steps
    assert step.omegas == pytest.approx(document["without 6"], rel=0.0035)

    found = simplify_merging(given, 1, None, ["6"], ["5+7", "8+9"])
    first, five, eight, *rest = found.steps
    assert found.rule == "partial"
    operations = [one.operation for one in (first, five, eight)]
    assert operations == ["remove 6", "merge 5 and 7", "merge 8 and 9"]
    assert first.omegas == pytest.approx(document["without 6"], rel=0.0035)
    assert eight.omegas == pytest.approx(document["5+7 and 8+9 as one"], rel=0.0035)
    for step, printed in zip(rest, document["chain"], strict=True):
        assert step.operation == printed["operation"]
        assert step.omegas == pytest.approx(printed["omegas"], rel=0.0035)


P3 = [(part, state) for part in table("tables_p3")["tables"] for state in part["damper"]]


@pytest.mark.parametrize(
    ("part", "state"), P3, ids=[f"{part['name']} {state['compliance']}" for part, state in P3]
)
def test_every_step_of_tables_p3(part: dict[str, Any], state: dict[str, Any]) -> None:
    """Inertias and compliances as printed, to three digits that were calculated with."""
    given = scheme_of(chain(part["inertias"], [state["compliance"], *part["compliances"]]))
    steps = simplify(given, 1).steps
    for step, printed in zip(steps, state["steps"], strict=True):
        assert step.compliances is not None
        found = [j / TENTH for j in step.inertias], [e * 1e5 for e in step.compliances]
        listed = printed["inertias"], printed["compliances"]
        for values, numbers in zip(found, listed, strict=True):
            for value, number in zip(values, numbers, strict=True):
                assert number is None or value == pytest.approx(number, rel=0.008)
