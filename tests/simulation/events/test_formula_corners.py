"""Jumps of formulas along which a motion slides."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from vstatics.simulation.events.formula_corners import FormulaCorners
from vstatics.simulation.events.margins import LargeSizes
from vstatics.simulation.events.meetings import CornerPlace


def test_fewer_jumps_of_which_one_is_left_already_do_not_count_as_all_jumps() -> None:
    """The motion slides along a and b, which do not hold it; next it tries b and c."""
    a, b, c = (CornerPlace(0, number) for number in range(3))
    corner: Any = SimpleNamespace(compared=[SimpleNamespace(at=lambda *_: (0.0, 0.0))] * 3)
    corners: Any = object.__new__(FormulaCorners)
    corners.all, corners.slides_from, corners.fewer = [corner], 1.0, [[b, c]]
    corners.slides = {a: SimpleNamespace(share=0, near=1.0), b: SimpleNamespace(share=1, near=1.0)}
    jumps = [(np.ones(1), np.ones((1, 1)))] * 2
    equations: Any = SimpleNamespace(
        time=1.0,
        changes=SimpleNamespace(seen_at=lambda *_: ()),
        rates=lambda *_: ((), ()),
        share=lambda *_: np.array([2.0, 2.0]),
        sliding=SimpleNamespace(steps=lambda *_: jumps),
        system=SimpleNamespace(scenario=SimpleNamespace(span=1.0)),
    )
    asked = equations, np.zeros(1), LargeSizes(1.0, 1.0), np.ones(1)
    assert corners.kept(*asked) == [b, c]
    equations.share = lambda *_: np.zeros(2)
    assert corners.kept(*asked) is None
