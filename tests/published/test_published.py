"""Every shipped case against what is printed of it elsewhere, or follows from it by hand.

The numbers are in the JSON files beside this one: ratios as their source prints them, and facts with
the closed form that gives them. None was made by this program.
"""

import ast
import operator
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import vstatics
from tests.commands import json_file
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.result_arrays import ARRAYS, row_names
from vstatics.core.statics.results import Results

HERE = Path(__file__).parent
CASES = HERE.parents[1] / "cases"
WITH_OWN_TEST = {"mzkt7922"}

DOCUMENTS: dict[str, Any] = {
    path.stem: json_file(path)
    for path in sorted(HERE.glob("*.json"))
    if path.stem not in WITH_OWN_TEST
}
DIGITS_OF_A_CLOSED_FORM = 10

OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
}


def evaluated(node: ast.AST) -> float:
    """An expression of numbers."""
    match node:
        case ast.Expression(body=body):
            return evaluated(body)
        case ast.Constant(value=int() | float() as value):
            return value
        case ast.BinOp(left=left, op=operation, right=right):
            return OPERATORS[type(operation)](evaluated(left), evaluated(right))
        case ast.UnaryOp(op=operation, operand=operand):
            return OPERATORS[type(operation)](evaluated(operand))
    raise ValueError(ast.dump(node))


def half_a_unit(decimals: int) -> float:
    """Half a unit of the last printed digit, and the rounding of the calculation."""
    return 0.5 * 10.0**-decimals + 1e-12


@pytest.fixture(scope="module")
def solved() -> Callable[[str], Results]:
    """Results of the case of a document, each solved once."""
    known: dict[str, Results] = {}

    def get(name: str) -> Results:
        if name not in known:
            document = DOCUMENTS[name]
            case = vstatics.load(CASES / document["case"])
            known[name] = vstatics.solve(replace(case, coast=document.get("coast", case.coast)))
        return known[name]

    return get


def quantity(results: Results, fact: dict[str, Any]) -> float:
    """The calculated value that a fact speaks of."""
    case, of, name = results.case, fact.get("of", ""), fact["quantity"]
    gear = [gear.name for gear in case.gears].index(fact["gear"])
    if name in ("torque", "lossy_torque"):  # of a mesh too, on its first wheel
        torques = getattr(results.gear(gear + 1), f"{name}s").on_first_link
        return plain(torques[[*case.devices, "output"].index(of)])
    if name == "speed":  # of a planet that is a link, too
        return plain(results.gear(gear + 1).speeds[case.link_names.index(of)])
    if name == "planet_speed":  # of a mesh: that of its planet
        element, _, mesh = of.partition(".")
        of = f"{element}.{mesh.split('-')[-1]}" if mesh else of
    many = f"{name}s" if f"{name}s" in ARRAYS else name
    rows = row_names(case, ARRAYS[many].rows)
    array = getattr(results, many)
    return float(array[gear, rows.index(of)] if rows else array[gear])


@pytest.mark.parametrize("name", DOCUMENTS)
def test_printed_ratios(solved: Callable[[str], Results], name: str) -> None:
    printed, tolerance = DOCUMENTS[name]["ratio"], half_a_unit(DOCUMENTS[name]["decimals"])
    ratios = {gear: quantity(solved(name), {"gear": gear, "quantity": "ratio"}) for gear in printed}
    assert ratios == pytest.approx(printed, rel=0, abs=tolerance)


@pytest.mark.parametrize("name", DOCUMENTS)
def test_facts(solved: Callable[[str], Results], name: str) -> None:
    for fact in DOCUMENTS[name]["facts"]:
        tolerance = half_a_unit(fact.get("decimals", DIGITS_OF_A_CLOSED_FORM))
        expected = pytest.approx(fact["value"], rel=0, abs=tolerance)
        assert quantity(solved(name), fact) == expected, fact


@pytest.mark.parametrize("name", DOCUMENTS)
def test_closed_forms_give_the_numbers_beside_them(name: str) -> None:
    facts = [fact for fact in DOCUMENTS[name]["facts"] if "form" in fact]
    values = {fact["form"]: evaluated(ast.parse(fact["form"], mode="eval")) for fact in facts}
    expected = {fact["form"]: fact["value"] for fact in facts}
    assert values == pytest.approx(expected, rel=0, abs=half_a_unit(DIGITS_OF_A_CLOSED_FORM))


@pytest.mark.parametrize("name", DOCUMENTS)
def test_power_balance_closes(solved: Callable[[str], Results], name: str) -> None:
    results = solved(name)
    there = results.consistent
    assert results.power_balance[there] == pytest.approx(0, abs=1e-9)
    assert not results.failed


@pytest.mark.parametrize("name", DOCUMENTS)
def test_every_gear_has_a_number(name: str) -> None:
    document = DOCUMENTS[name]
    case = vstatics.load(CASES / document["case"])
    told = {*document["ratio"], *(fact["gear"] for fact in document["facts"])}
    assert told == {gear.name for gear in case.gears}


def test_every_shipped_case_is_published() -> None:
    shipped = {path.name for path in CASES.glob("*.yaml") if path.stem not in WITH_OWN_TEST}
    assert shipped == {document["case"] for document in DOCUMENTS.values()}
    for document in DOCUMENTS.values():
        assert document["source"]
        assert document["what"]
