"""Explanations of gears, and whether they hold."""

import json
import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest

from tests.shipped import shipped_results
from vstatics.core.explain import Explanation, explain_gear
from vstatics.core.explain.sums import System, in_numbers
from vstatics.core.tables.answer import plain_data


def explained(name: str, gear: str) -> Explanation:
    results = shipped_results(name)
    return explain_gear(results, gear)


def equations(system: System | None) -> list[str]:
    assert system is not None
    return [" ".join(in_numbers(equation)) for equation in system.equations]


def holds(system: dict[str, Any]) -> None:
    """The equations of a system in JSON are true at the values beside them."""
    values = system["values"]
    for equation in system["equations"]:
        used = [term for term in equation["terms"] if term["coefficient"]]
        if all(values[term["unknown"]] is not None for term in used):
            terms = [term["coefficient"] * values[term["unknown"]] for term in used]
            size = sum(map(abs, terms)) + abs(equation["right"])
            assert math.fsum(terms) == pytest.approx(equation["right"], abs=1e-12 * max(1, size))


def value(made: dict[str, Any]) -> Fraction:
    """A formula in JSON at the values of its symbols, by Python's own arithmetic."""
    given = (*made["symbols"], *made["speeds"])
    names = {one["symbol"]: Fraction(one["value"]) for one in given}
    return Fraction(eval(made["expression"], {"__builtins__": {}}, names))  # noqa: S307


def check(results: Any, numbers: Sequence[int]) -> None:
    for number in numbers:
        made = plain_data(explain_gear(results, number + 1))
        one = json.loads(json.dumps(made, allow_nan=False))
        for name in ("speeds", "torques", "lossy"):
            if one[name] is not None:
                holds(one[name])
        made = one["formula"]
        if made is not None:
            ratio = one["ratio"] if made["left"] == "i" else one["speeds"]["values"][made["left"]]
            assert float(value(made)) == pytest.approx(ratio, rel=1e-8, abs=1e-12)
        else:  # a formula is missing only where there is no ratio
            assert one["reason"]
            assert one["ratio"] is None
