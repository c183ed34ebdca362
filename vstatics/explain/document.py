"""Explanations as plain data, ready for JSON; NaN becomes None."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from vstatics.explain.equations import System
from vstatics.explain.explanation import Explanation
from vstatics.explain.formula import Formula
from vstatics.explain.sums import in_numbers, in_symbols
from vstatics.model.transmission import Transmission

VERSION = 1


def write(case: Transmission, explained: Sequence[Explanation]) -> str:
    """Explanations of gears as one JSON object."""
    plain = {
        "format": "vstatics-explanation",
        "version": VERSION,
        "case": case.name,
        "gears": [document(one) for one in explained],
    }
    return json.dumps(plain, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def document(one: Explanation) -> dict[str, Any]:
    """An explanation as a plain mapping.

    An equation has its text in symbols and in numbers, and its terms to calculate with;
    `right` is its right side.
    """
    plain: dict[str, Any] = one._asdict() | {
        "matrix": one.matrix.tolist(),
        "speeds": _system(one.speeds),
        "torques": None if one.torques is None else _system(one.torques),
        "lossy": None if one.lossy is None else _system(one.lossy),
        "signs": [sign._asdict() for sign in one.signs],
        "together": [body._asdict() for body in one.together],
        "formula": None if one.formula is None else _formula(one.formula),
    }
    cleaned: dict[str, Any] = _without_nan(plain)
    return cleaned


def _system(system: System) -> dict[str, Any]:
    equations = [
        {
            "of": equation.of,
            "symbols": " ".join(in_symbols(equation)),
            "numbers": " ".join(in_numbers(equation)),
            "terms": [term._asdict() for term in equation.terms],
            "right": equation.right,
        }
        for equation in system.equations
    ]
    return {"equations": equations, "values": dict(system.values)}


def _formula(formula: Formula) -> dict[str, Any]:
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


def _without_nan(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_nan(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_without_nan(one) for one in value]
    return None if isinstance(value, float) and value != value else value  # noqa: PLR0124 - NaN
