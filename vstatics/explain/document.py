"""Explanations as JSON, with all digits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.explain.equations import System
from vstatics.explain.explanation import Explanation
from vstatics.explain.formula import RatioFormula
from vstatics.explain.sums import in_numbers, in_symbols
from vstatics.model.transmission import Transmission
from vstatics.writers.plain_json import plain_data

FORMAT = "vstatics-explanation"
VERSION = 1


def document(case: Transmission, explained: Sequence[Explanation]) -> dict[str, Any]:
    """Explanations of gears as plain data."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "case": case.name,
        "gears": [gear_document(one) for one in explained],
    }


def gear_document(one: Explanation) -> dict[str, Any]:
    """An explanation as plain data.

    An equation has its text in symbols and in numbers, and its terms to calculate with;
    `right` is its right side.
    """
    made: dict[str, Any] = plain_data(
        one._asdict()
        | {
            "matrix": one.matrix.tolist(),
            "speeds": _system(one.speeds),
            "torques": None if one.torques is None else _system(one.torques),
            "lossy": None if one.lossy is None else _system(one.lossy),
            "formula": None if one.formula is None else _formula(one.formula),
        }
    )
    return made


def _system(system: System) -> dict[str, Any]:
    equations = [
        {
            "of": equation.of,
            "symbols": " ".join(in_symbols(equation)),
            "numbers": " ".join(in_numbers(equation)),
            "terms": equation.terms,
            "right": equation.right,
        }
        for equation in system.equations
    ]
    return {"equations": equations, "values": system.values}


def _formula(formula: RatioFormula) -> dict[str, Any]:
    """Each symbol of the expression beside what it stands for."""
    symbols = [
        {"symbol": f"u{number}", **symbol._asdict()}
        for number, symbol in enumerate(formula.symbols, 1)
    ]
    speeds = [
        {"symbol": f"w{number}", "name": name, "value": value}
        for number, (name, value) in enumerate(formula.speeds.items(), 1)
    ]
    return formula._asdict() | {"symbols": symbols, "speeds": speeds}
