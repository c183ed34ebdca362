"""The reasons of signs."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import pytest

from tests.commands import CASES
from tests.core.explain.explained import explained
from tests.shipped import shipped_results
from vstatics import Results, exercise, load, solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.given import given
from vstatics.core.explain.signs import signs_of
from vstatics.core.explain.text import write
from vstatics.core.model.transmission import Gear, Mechanism, Transmission

RULE = re.compile(r"M \(w_first - w_third\) ([<>]) 0")


def test_signs_have_a_reason() -> None:
    """Published IX of gear 6: +1 +1 +1; D1 has no torque there, D3 turns as one piece."""
    signs = explained("mzkt7922.dat", "6").signs
    assert [sign.sign for sign in signs] == [1, 1, 1]
    assert [sign.why for sign in signs] == [
        "unloaded: no torque; x by the convention `published`",
        "power enters by the first link",
        "unloaded: no torque; x by the convention `published`",
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


def shipped_gears() -> Iterator[tuple[Results, int]]:
    for path in sorted((*CASES.glob("*.yaml"), *CASES.glob("*.dat"))):
        for coast in (None, False, True):
            results = solve(load(path), coast=coast)
            for place in range(len(results.case.gears)):
                yield results, place


@pytest.mark.slow
def test_the_rule_as_it_is_printed_gives_the_sign_of_every_shipped_gear() -> None:
    """By its own sign `> 0` or `< 0`, driving and coasting; other signs are told on a sheet."""
    read = 0
    for results, place in shipped_gears():
        state = results.gear_at(place)
        sheet = list(given(results, place))
        told = {row[0] for grid in sheet if grid.key == "idle" for row in grid.texts}
        for sign in signs_of(state):
            if sign.mechanism in told or math.isnan(sign.sign) or sign.efficiency == 1:
                continue
            [rule] = {found[1] for grid in sheet if (found := RULE.search(grid.title))}
            read += rule == "<"
            assert (sign.power > 0 if rule == ">" else sign.power < 0) == (sign.sign > 0)
            assert sign.power != 0
    assert read > 400


def test_the_rule_holds_when_coasting_too() -> None:
    """A pair that is driven from its second link: M = 1 and w_1 = 1, yet x = -1."""
    case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0, 0.9)], [Gear()])
    for coast, x, printed in ((False, 1, "> 0"), (True, -1, "< 0, as the unit of M is negative")):
        results = solve(case, coast=coast)
        explained_gear = explain_gear(results, 1)
        assert (explained_gear.signs[0].power, explained_gear.signs[0].sign) == (1, x)
        for said in (write([explained_gear]), exercise(results, 1).worksheet()):
            assert f"M (w_first - w_third) {printed}" in " ".join(said.split())


def test_coasting_turns_the_signs() -> None:
    results = shipped_results("mzkt7922.dat", coast=True)
    [first, _, third] = explain_gear(results, 1).signs
    assert (first.sign, third.sign) == (-1, -1)
    assert first.why == "coasting, power leaves by the first link"
