"""The reasons of signs."""

import math
import re

import pytest

from tests.commands import SHIPPED
from tests.core.explain.explained import explained
from tests.shipped import shipped_results
from vstatics import exercise, load, solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.given import given
from vstatics.core.explain.signs import signs_of
from vstatics.core.explain.text import write
from vstatics.core.model.transmission import Gear, Mechanism, Transmission

RULE = re.compile(r"M \(w_first - w_third\) ([<>]) 0")


def test_signs_have_a_reason() -> None:
    """Published IX of gear 6: +1 +1 +1; D1 has no torque there, D3 turns as one piece."""
    unloaded = "unloaded: no torque; x by the convention `published`"
    signs = explained("mzkt7922.dat", "6").signs
    assert [(sign.sign, sign.why) for sign in signs] == [
        (1, unloaded),
        (1, "power enters by the first link"),
        (1, unloaded),
    ]
    [first, _, third] = explain_gear(shipped_results("mzkt7922.dat", coast=True), 1).signs
    assert (first.sign, third.sign) == (-1, -1)
    assert first.why == "coasting, power leaves by the first link"


def test_drag_decides_a_sign_where_nothing_else_loads_the_mechanism() -> None:
    """Drag .1 on the second link of a pair of ratio -1.5 takes .1/1.5 from its first."""
    pairs = [Mechanism(1, 2, 0, -3.0, 0.98), Mechanism(1, 3, 0, -1.5, 0.9)]
    case = Transmission(3, [], pairs, [Gear(drag={3: 0.1})], output=2)
    main, side = explain_gear(solve(case), 1).signs
    assert side.torque == side.power == pytest.approx(0.1 / 1.5)
    assert main.torque == pytest.approx(1 - 0.1 / 1.5)
    assert (side.sign, side.why) == (1, "power enters by the first link")


@pytest.mark.slow
@pytest.mark.parametrize("coast", [None, False, True])
def test_the_rule_as_it_is_printed_gives_the_sign_of_every_shipped_gear(coast: bool | None) -> None:
    """By its own sign `> 0` or `< 0`, driving and coasting; other signs are told on a sheet."""
    read = 0
    for path in SHIPPED:
        results = solve(load(path), coast=coast)
        for place in range(len(results.case.gears)):
            sheet = list(given(results, place))
            told = {row[0] for grid in sheet if grid.key == "idle" for row in grid.texts}
            for sign in signs_of(results.gear_at(place)):
                if sign.mechanism in told or math.isnan(sign.sign) or sign.efficiency == 1:
                    continue
                [rule] = {found[1] for grid in sheet if (found := RULE.search(grid.title))}
                read += rule == "<"
                assert (sign.power > 0 if rule == ">" else sign.power < 0) == (sign.sign > 0)
                assert sign.power != 0
    assert read > 400 or not coast


def test_the_rule_holds_when_coasting_too() -> None:
    """A pair that is driven from its second link: M = 1 and w_1 = 1, yet x = -1."""
    case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0, 0.9)], [Gear()])
    for coast, x, printed in ((False, 1, "> 0"), (True, -1, "< 0, as the unit of M is negative")):
        results = solve(case, coast=coast)
        made = explain_gear(results, 1)
        assert (made.signs[0].power, made.signs[0].sign) == (1, x)
        for said in (write([made]), exercise(results, 1).worksheet()):
            assert f"M (w_first - w_third) {printed}" in " ".join(said.split())
