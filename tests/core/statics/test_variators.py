"""Variators and converters: closed forms written by hand, the balance of power."""

from __future__ import annotations

import math
from typing import Any

import pytest

from vstatics import Gear, Load, Mechanism, Transmission, solve
from vstatics.core.errors import CaseError
from vstatics.core.model.laws import PointLaw
from vstatics.core.readers import loads
from vstatics.core.writers.named import write_yaml

VARIATOR = Mechanism(1, 2, 0, 0.4, 0.86, kind="variator", name="hydro")
POINTS = ((0.0, 2.4), (0.8, 1.0), (1.0, 1.0))
CONVERTER = Mechanism(1, 2, 0, math.nan, kind="converter", points=POINTS, name="TC")


def test_a_variator_that_holds_its_second_link_loses_nothing() -> None:
    parts = [Mechanism(1, 2, 3, -2.0), VARIATOR._replace(ratio=0)]
    results = solve(Transmission(3, [], parts, [Gear()]))
    assert results.speeds[0].tolist() == pytest.approx([1, 0, 1 / 3])
    assert results.lossy_torques[0].tolist() == pytest.approx([1, 0, 3])
    assert results.losses[0].tolist() == [0, 0]
    [given] = [
        one for one in results.gear(1).powers() if one.member == "second" and one.number == 2
    ]
    assert given.power == 0
    assert results.gear(1).member_torques(lossy=True)[1] == pytest.approx(
        {"first": 0, "second": -2}
    )


@pytest.mark.parametrize(("i", "k"), [(0, 2.4), (0.4, 1.7), (0.8, 1), (0.9, 1), (1, 1)])
def test_a_converter_multiplies_torque_in_both_tables(i: float, k: float) -> None:
    results = solve(Transmission(2, [], [CONVERTER], [Gear(speed_ratios={1: i})]))
    assert results.torques[0, -1] == results.lossy_torques[0, -1] == pytest.approx(k)
    assert results.efficiency[0] == pytest.approx(k * i)
    assert results.losses[0, 0] == pytest.approx(1 - k * i)
    assert abs(results.power_balance[0]) < 1e-12


def test_a_converter_that_would_gain_power_has_no_torques() -> None:
    results = solve(Transmission(2, [], [CONVERTER], [Gear(speed_ratios={1: 1.2})]))
    assert math.isnan(results.torques[0, -1])
    assert "converter TC would gain power" in results.messages[0].text


def test_a_gear_without_the_speed_ratio_is_refused() -> None:
    with pytest.raises(CaseError, match="`speed_ratio` of converter TC is missing") as caught:
        Transmission(2, [], [CONVERTER], [Gear()])
    assert caught.value.problems[0].path == ("gears", 1)


def test_points_of_a_converter_ascend() -> None:
    wrong = CONVERTER._replace(points=((0.5, 1.0), (0.2, 2.0)))
    with pytest.raises(CaseError, match="points must ascend"):
        Transmission(2, [], [wrong], [Gear(speed_ratios={1: 0})])


def test_lambda_behind_the_points_of_a_converter_changes_nothing_in_statics() -> None:
    """The points of a scenario's converter serve a case; what is no number is told."""
    text = """
links: [engine, turbine]
mechanisms: {{TC: {{kind: converter, first: engine, second: turbine, points: {points}}}}}
gears: {{a: {{speed_ratios: {{TC: 0.4}}}}}}
"""
    bare = text.format(points="[[0, 2.4], [.8, 1], [1, 1]]")
    known = loads(text.format(points="[[0, 2.4, 3.1e-3], [.8, 1.0, 2.2e-3], [1, 1, 0]]"))
    assert solve(known).torques.tolist() == solve(loads(bare)).torques.tolist()
    assert loads(write_yaml(known)) == known
    with pytest.raises(CaseError, match="expected lambda in all points or in none"):
        loads(text.format(points="[[0, 2.4, 3.1e-3], [.8, 1]]"))
    with pytest.raises(CaseError, match=r"points\[1\]\[3\]"):
        loads(text.format(points="[[0, 2.4, x], [.8, 1]]"))
    with pytest.raises(CaseError, match="expected 2 numbers"):
        loads(text.format(points="[[0, 2.4, 1, 1], [.8, 1]]"))


def test_a_converter_outside_its_points_has_the_last_one_and_one_note_tells_it() -> None:
    # constant outside: K = 2.4 below the first point at .1, K = 1 above the last one at .8
    narrow = CONVERTER._replace(points=((0.1, 2.4), (0.8, 1.0)))
    gears = [Gear(speed_ratios={1: i}, name=name) for name, i in [("a", 0.05), ("b", 0.9)]]
    case = Transmission(2, [], [narrow], gears)
    results = solve(case)
    assert results.torques[:, -1].tolist() == [2.4, 1]
    said = "outside the points of TC, the value of the nearest end point applies"
    notes = [(one.id, one.gear, one.text) for one in results.messages]
    assert notes == [("N414", "a", said), ("N414", "b", said)]
    inside = case.replace(gears=[Gear(speed_ratios={1: i}) for i in (0.1, 0.8)])
    assert solve(inside).messages == solve(case.replace(allow=["N414"])).messages == ()


def test_points_tell_where_a_converter_is_asked_outside_its_points() -> None:
    """In gear `a` its ratio varies, in gear `b` it stands beyond the last point."""
    narrow = CONVERTER._replace(points=((0.1, 2.4), (0.8, 1.0)))
    pair = Mechanism(2, 3, 0, 3, name="pair")
    gears = [Gear(speed_ratios={1: i}, name=name) for name, i in [("a", 0.5), ("b", 0.9)]]
    case = Transmission(3, [], [narrow, pair], gears)
    points = solve(case, vary={"gears.a.speed_ratios.TC": [0.05, 0.1, 0.8, 0.9]}).points
    assert points is not None
    assert points.outside["TC"].T.tolist() == [[True, False, False, True], [True] * 4]
    at_loads = solve(case.replace(load=Load(1000, 50)), vary={"load.torque": [10.0, 90.0]}).points
    assert at_loads is not None
    assert at_loads.outside["TC"].tolist() == [[False, True]] * 2


@pytest.mark.parametrize("kind", ["variator", "converter"])
def test_ratios_vary_beside_a_speed_ratio_that_only_gears_give(kind: Any) -> None:
    """The ratio of both in a row is that of the pair over the speed ratio, which may be 0."""
    points = CONVERTER.points if kind == "converter" else ()
    free = Mechanism(1, 2, 0, math.nan, name="free", kind=kind, points=points)
    gears = [Gear(speed_ratios={1: 0.5}), Gear(speed_ratios={1: 0.25})]
    case = Transmission(3, [], [free, Mechanism(2, 3, 0, 3)], gears)
    found = solve(case, ratios=[[math.nan, 2.0], [math.nan, -4.0]])
    assert found.ratio.tolist() == [[4, 8], [-8, -16]]
    law = PointLaw([(0, 0.5), (500, 1.0)])
    loaded = case.replace(load=Load(1000, 50), gears=[g._replace(drag={2: law}) for g in gears])
    assert solve(loaded, ratios=[[math.nan, 2.0]]).ratio.tolist() == [[4, 8]]
    still = case.replace(mechanisms=[free._replace(ratio=0.0), case.mechanisms[1]])
    assert solve(still, ratios=[[0.0, 2.0]]).ratio.tolist() == [[4, 8]]
    with pytest.raises(CaseError, match=r"read nan in variant 0, expected a finite ratio"):
        solve(case, ratios=[[0.5, math.nan]])
