"""Entries of equations: numbers with their size."""

from __future__ import annotations

import pytest

from tests.core.numerics.tapes import on_tape, traced
from vstatics.core.numerics import elimination
from vstatics.core.numerics.elimination import RIGHT, Equation
from vstatics.core.numerics.tape import Untraceable


def test_entries_that_nearly_cancel_stand_for_no_other_variant() -> None:
    """x0 + x1 = 1, a x0 + x1 = 2: too little of ``a - 1`` is left where a is 1 + 1e-13."""
    for excess, fits in ((0.5, True), (1e-13, False)):
        (a,) = traced(1 + excess)
        rows: list[Equation] = [{0: a, 1: 1.0, RIGHT: 2.0}, {0: 1.0, 1: 1.0, RIGHT: 1.0}]
        if fits:
            found = elimination.solve(rows, 2)
            assert found.consistent
            assert found.missing == 0
            assert on_tape(found.values[0]).magnitude.value == pytest.approx(2)
        else:
            with pytest.raises(Untraceable):
                elimination.solve(rows, 2)
