"""The reasons of signs."""

from __future__ import annotations

import math

import pytest

from tests.commands import CASES
from tests.explain.explained import explained
from vstatics import load, solve
from vstatics.explain import explain_gear
from vstatics.model.transmission import Gear, Mechanism, Transmission


def test_signs_have_a_reason() -> None:
    """Published IX of gear 6: +1 +1 +1; D1 has no torque there, D3 turns as one piece."""
    signs = explained("mzkt7922.dat", "6").signs
    assert [sign.sign for sign in signs] == [1, 1, 1]
    assert [sign.why for sign in signs] == [
        "idle: no torque; x by the convention `published`",
        "power enters by the first link",
        "idle: no torque; x by the convention `published`",
    ]


def test_drag_decides_a_sign_where_nothing_else_loads_the_mechanism() -> None:
    """Drag .1 on the second link of a pair of ratio -1.5 takes .1/1.5 from its first."""
    case = Transmission(
        3,
        [],
        [
            Mechanism(1, 2, 0, -3.0, 0.98, name="main"),
            Mechanism(1, 3, 0, -1.5, 0.9, name="side"),
        ],
        [Gear(drag={3: 0.1})],
        output=2,
    )
    main, side = explain_gear(solve(case), 1).signs
    assert side.torque == side.power == pytest.approx(0.1 / 1.5)
    assert main.torque == pytest.approx(1 - 0.1 / 1.5)
    assert (side.sign, side.why) == (1, "power enters by the first link")


def test_an_efficiency_multiplies_or_divides_by_the_direction_of_power() -> None:
    """Equation 4 of the source, u eta^x; all sets of the 8HP carry power in gear 5."""
    for sign in explained("zf-8hp70.yaml", "5").signs:
        assert sign.lossy_ratio == pytest.approx(sign.ratio * 0.98**sign.sign)
        assert math.copysign(1, sign.power) == sign.sign


def test_coasting_turns_the_signs() -> None:
    results = solve(load(CASES / "mzkt7922.dat"), coast=True)
    [first, _, third] = explain_gear(results, 1).signs
    assert (first.sign, third.sign) == (-1, -1)
    assert first.why == "coasting, power leaves by the first link"
