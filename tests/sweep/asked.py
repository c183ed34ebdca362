"""Expressions about variants of a set, and what they give."""

from functools import partial
from typing import Any

import numpy as np
import pytest

from vstatics import Gear, Mechanism, ReadError, ShiftElement, Transmission, solve
from vstatics.core.errors import Problem
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.expressions import Expression, read_expression
from vstatics.sweep.variants.targets import target

SET = Transmission(
    3,
    [ShiftElement(1, 2, "F"), ShiftElement(2, 0, "4-5")],
    [Mechanism(1, 2, 3, -2.5, 0.96)],
    [Gear([1], name="2"), Gear([2], name="1R"), Gear(name="N")],
    link_names=("вал", "ring 1", "in"),
)
"""A set with sun, ring and carrier: locked in `2`, the ring held in `1R`, free in `N`."""


RATIOS = np.array([-2.0, -2.5, -3.0])
VALUES = RATIOS[:, None]
HELD = 1 - RATIOS
"""Ratio sun to carrier with the ring held, from (w1 - w3)/(0 - w3) = u."""
VARIED = [target("D1.ratio", SET)]
RESULTS = solve(SET, ratios=VALUES)


def expression(text: str) -> Expression:
    return read_expression(text, SET, VARIED, "--out")


def value(text: str) -> Any:
    return expression(text)(RESULTS, VALUES)


def number(text: str) -> float:
    """The value of an expression that is the same for all variants."""
    values = value(text)
    assert values.shape == (3,)
    assert len(set(values.tolist())) == 1 or np.isnan(values).all()
    return float(values[0])


def problem(text: str, option: str = "--where") -> Problem:
    reader = read_columns if option == "--out" else partial(read_expression, option=option)
    with pytest.raises(ReadError) as caught:
        reader(text, SET, VARIED)
    (told,) = caught.value.problems
    return told


def marked(text: str, option: str = "--where") -> str:
    place = problem(text, option).place
    assert place is not None
    assert (place.file, place.line, place.text) == (option, 1, text)
    return text[place.column - 1 :]
