"""Variators and converters, locked up or not: closed forms by hand, the balance of power."""

import math
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from tests.chance import examples, seeded
from tests.core.writers.again import is_read_again
from tests.trains import random_train
from vstatics import CaseError, Gear, Load, Mechanism, ReadError, ShiftElement, Transmission, solve
from vstatics.core.model.laws import PointLaw
from vstatics.core.model.springs import Spring, between
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
    state = results.gear(1)
    assert [one.power for one in state.powers() if (one.member, one.number) == ("second", 2)] == [0]
    assert state.member_torques(lossy=True)[1] == pytest.approx({"first": 0, "second": -2})


def test_a_converter_multiplies_torque_in_both_tables() -> None:
    for i, k in ((0, 2.4), (0.4, 1.7), (0.8, 1), (0.9, 1), (1, 1)):
        results = solve(Transmission(2, [], [CONVERTER], [Gear(speed_ratios={1: i})]))
        assert results.torques[0, -1] == results.lossy_torques[0, -1] == pytest.approx(k)
        assert results.efficiency[0] == pytest.approx(k * i)
        assert results.losses[0, 0] == pytest.approx(1 - k * i)
        assert abs(results.power_balance[0]) < 1e-12
    # a variator that would gain power has no torques
    results = solve(Transmission(2, [], [CONVERTER], [Gear(speed_ratios={1: 1.2})]))
    assert math.isnan(results.torques[0, -1])
    assert "converter TC would gain power" in results.messages[0].text


@pytest.mark.parametrize(("drag", "on_pump"), [(2, -1), (0.5, math.nan)])
def test_drag_can_reverse_the_power_through_a_converter(drag: float, on_pump: float) -> None:
    """If the engine gives less than its drag, the turbine drives the pump beyond i = 1."""
    text = f"""
links: [engine, turbine]
load: {{speed: 100 rad/s, torque: 1 N*m}}
drag: {{engine: {drag} N*m}}
mechanisms: {{TC: {{kind: converter, first: engine, second: turbine, speed_ratio: 1.2}}}}
"""
    results = solve(loads(text.replace("1.2", "1.2, points: [[0, 2], [1, 1], [2, 1]]")))
    wanted = pytest.approx([on_pump, on_pump], nan_ok=True)
    assert results.lossy_torques_Nm[0].tolist() == wanted
    assert {m.id for m in results.messages} == {"W418" if math.isnan(on_pump) else "W422"}


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
    for point, said in (
        ("2.4, 3.1e-3", "expected lambda in all points or in none"),
        ("2.4, x", r"points\[1\]\[3\]"),
        ("2.4, 1, 1", "expected 2 numbers"),
    ):
        with pytest.raises(CaseError, match=said):
            loads(text.format(points=f"[[0, {point}], [.8, 1]]"))


def test_a_converter_outside_its_points_has_the_last_one_and_one_note_tells_it() -> None:
    """K = 2.4 below the first point at .1, K = 1 above the last one at .8."""
    narrow = CONVERTER._replace(points=((0.1, 2.4), (0.8, 1.0)))
    gears = [Gear(speed_ratios={1: i}, name=name) for name, i in [("a", 0.05), ("b", 0.9)]]
    case = Transmission(2, [], [narrow], gears)
    results = solve(case)
    assert results.torques[:, -1].tolist() == [2.4, 1]
    notes = [(one.id, one.gear, one.text[:27]) for one in results.messages]
    assert notes == [("N414", gear, "outside the points of TC, t") for gear in "ab"]
    inside = case.replace(gears=[Gear(speed_ratios={1: i}) for i in (0.1, 0.8)])
    assert solve(inside).messages == solve(case.replace(allow=["N414"])).messages == ()
    points = solve(case, vary={"gears.a.speed_ratios.TC": [0.05, 0.1, 0.8, 0.9]}).points
    assert points is not None
    assert points.outside["TC"].T.tolist() == [[True, False, False, True], [True] * 4]
    at_loads = solve(case.replace(load=Load(1000, 50)), vary={"load.torque": [10.0, 90.0]}).points
    assert at_loads is not None
    assert at_loads.outside["TC"].tolist() == [[True, True]] * 2


def test_ratios_vary_beside_a_speed_ratio_that_only_gears_give() -> None:
    """The ratio of both in a row is that of the pair over the speed ratio, which may be 0."""
    gears = [Gear(speed_ratios={1: 0.5}), Gear(speed_ratios={1: 0.25})]
    for part in (VARIATOR, CONVERTER):
        free = part._replace(ratio=math.nan)
        case = Transmission(3, [], [free, Mechanism(2, 3, 0, 3)], gears)
        found = solve(case, ratios=[[math.nan, 2.0], [math.nan, -4.0]])
        assert found.ratio.tolist() == [[4, 8], [-8, -16]]
        dragged = [gear._replace(drag={2: PointLaw([(0, 0.5), (500, 1.0)])}) for gear in gears]
        loaded = case.replace(load=Load(1000, 50), gears=dragged)
        assert solve(loaded, ratios=[[math.nan, 2.0]]).ratio.tolist() == [[4, 8]]
        still = case.replace(mechanisms=[free._replace(ratio=0.0), case.mechanisms[1]])
        assert solve(still, ratios=[[0.0, 2.0]]).ratio.tolist() == [[4, 8]]
        with pytest.raises(CaseError, match=r"read nan in variant 0, expected a finite ratio"):
            solve(case, ratios=[[0.5, math.nan]])


def with_converter(case: Transmission, *, damper: bool) -> Transmission:
    """The case with a converter before its input, locked up in its gears, as by a damper's plate.

    Its last gears are the same ones through the converter.
    """
    engine, plate = case.links + 1, case.links + 2
    turbine = case.input
    lock_up = ShiftElement(engine, plate if damper else turbine, "LU", drag=0.01)
    springs = [*case.springs, Spring(between(plate, turbine), stiffness=1e3)]
    converter = Mechanism(engine, turbine, 0, math.nan, kind="converter", points=POINTS, name="TC")
    number, place = len(case.mechanisms) + 1, len(case.shift_elements) + 1
    locked = [one._replace(engaged=[*one.engaged, place]) for one in case.gears]
    ratios, all_gears = {number: 1.0}, enumerate(case.gears)
    slipping = [one._replace(name=f"{n}C", speed_ratios=ratios) for n, one in all_gears]
    return replace(
        case,
        links=plate if damper else engine,
        link_names=(),
        shift_elements=[*case.shift_elements, lock_up],
        mechanisms=[*case.mechanisms, converter],
        springs=springs if damper else case.springs,
        gears=[*locked, *slipping],
        input=engine,
    )


@examples(12, 40, 600)
def test_a_locked_up_converter_is_as_none(examples: int) -> None:
    chance, seen = seeded(0), 0
    for number in range(examples):
        case = random_train(chance, regular=chance.random() < 0.8)
        if any(gear.input or case.input in gear.torques for gear in case.gears):
            continue  # it is another port then
        bare, results = solve(case), solve(with_converter(case, damper=number % 2 == 0))
        gears, devices = len(case.gears), len(case.shift_elements)
        inner = [*range(devices), *range(devices + 1, devices + 1 + len(case.mechanisms)), -1]
        for name in ("torques", "lossy_torques"):
            own = getattr(results, name)[:gears]
            expected = np.delete(getattr(bare, name), np.s_[devices + len(case.mechanisms) : -1], 1)
            np.testing.assert_allclose(own[:, inner], expected, rtol=1e-9, atol=1e-9)
            converter = own[:, devices + 1 + len(case.mechanisms)]
            assert (converter[~np.isnan(converter)] == 0).all()
        for name in ("ratio", "efficiency", "power_balance"):
            own, other = getattr(results, name)[:gears], getattr(bare, name)
            np.testing.assert_allclose(own, other, rtol=1e-9, atol=1e-9)
        for name in ("missing", "excess", "consistent", "balanced", "locked", "tied_up"):
            assert getattr(results, name)[:gears].tolist() == getattr(bare, name).tolist(), name
        seen += int(np.isfinite(bare.efficiency).sum())
    assert seen > examples / 2


BOX = """
links: [engine, turbine, ring, output]
load: {{speed: 2200 rpm, torque: 250 N*m}}
shift_elements: {{B: [ring, housing], C: [turbine, ring], LU: [engine, turbine]}}
mechanisms:
  TC: {{kind: {kind}, first: engine, second: turbine{own}}}
  set: {{first: turbine, second: ring, third: output, ratio: -2.5, efficiency: 0.97}}
gears: {{low: {{engaged: [B], speed_ratios: {{TC: {low}}}}}, locked: {locked}}}
"""
IN_BOX = {"kind": "converter", "own": ", points: [[0, 2.2, .006], [.85, 1, .0045]]", "low": 0.8}


def test_a_locked_up_converter_needs_no_speed_ratio_and_has_no_other_than_1() -> None:
    """A speed ratio varies where the converter works, so only there."""
    case = loads(BOX.format(**IN_BOX, locked="[B, LU]"))
    results = solve(case)
    assert results.ratio.round(9).tolist() == [4.375, 3.5]
    assert results.efficiency[1] == pytest.approx(3.425 / 3.5)
    assert [one for one in results.messages if one.gear == "locked"] == []
    varied = solve(case, vary={"TC.speed_ratio": [0.5, 0.8]})
    assert varied.ratio.round(9).tolist() == [[7, 3.5], [4.375, 3.5]]
    given = "{{engaged: [B, LU], speed_ratios: {{TC: {}}}}}"
    same = solve(loads(BOX.format(**IN_BOX, locked=given.format(1))))
    assert same.lossy_torques.tolist() == results.lossy_torques.tolist()
    with pytest.raises(CaseError, match="its speed ratio is 1: release its lock-up") as caught:
        loads(BOX.format(**IN_BOX, locked=given.format(0.9)))
    assert caught.value.problems[0].id == "E455"


def test_a_speed_ratio_that_ties_a_gear_up_is_named() -> None:
    numbers = {"kind": "variator", "own": "", "low": 0.8}
    case = loads(BOX.format(**numbers, locked="{engaged: [B, LU], speed_ratios: {TC: .8}}"))
    [said] = [one.text for one in solve(case).messages if one.id == "E452"]
    assert "LU, TC at the speed ratio 0.8 and the input speed contradict" in said
    assert "give TC another speed ratio" in said


def test_what_a_converter_takes_is_what_the_load_brings() -> None:
    """The pump takes lambda w^2; a load of that torque is in balance, another one is told."""
    w = 2200 * math.pi / 30
    able = (0.006 + (0.0045 - 0.006) * 0.8 / 0.85) * w**2
    for torque, ids in ((able, []), (-able, ["W418"]), (1.1 * able, ["W431"]), (300, ["W431"])):
        text = BOX.format(**IN_BOX, locked="[B, LU]").replace("250 N*m", f"{torque} N*m")
        messages = solve(loads(text)).messages
        assert [one.id for one in messages if one.gear == "low"] == ids
        assert [one.id for one in messages if one.gear == "locked"] == []


def test_open_converters_of_a_case_have_no_speed_ratio_in_statics() -> None:
    text = """
links: [engine, turbine, out]
mechanisms: {pair: {first: turbine, second: out, ratio: 2}}
shift_elements: {LU: [engine, turbine]}
converters: {TC: {links: [engine, turbine], points: [[0, 2, .004], [1, 1, 0]]}}
gears: {open: {engaged: [], speed_ratios: {TC: .6}}, locked: {engaged: [LU], speed_ratios: {TC: 1}}}
"""
    told = {(one.id, one.gear) for one in solve(loads(text)).messages}
    assert told == {("W414", "open"), ("N415", "open")}


def test_a_link_that_is_none_is_reported_beside_a_converter() -> None:
    """Whether the converter is bypassed is asked of links that are known to be some."""
    ends = {"element": 2, "mechanism": 2, "spring": 2}
    for wrong, part, ratios in product((99, -7, 2.5), ends, ({}, {1: 0.7})):
        own: dict[str, Any] = {**ends, part: wrong}
        converter = Mechanism(1, own["mechanism"], 0, 0.8, kind="converter", points=POINTS)
        spring = Spring({own["spring"]: 1, 1: -1}, stiffness=1.0)
        elements, gears = [ShiftElement(1, own["element"])], [Gear([1], speed_ratios=ratios)]
        with pytest.raises(CaseError) as caught:
            Transmission(2, elements, [converter], gears, springs=[spring])
        assert any(f"{wrong}" in one.message for one in caught.value.problems)


COUPLINGS = """links: [engine, turbine, output]
shift_elements: {L: [engine, turbine]}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, speed_ratio: 0.8, points: [[0, 2], [1, 1]]}
  TD: {kind: converter, first: engine, second: output, speed_ratio: 0.5, points: [[0, 3], [1, 1]]}
  pair: {first: turbine, second: output, ratio: 2}
gears: {"1": {open: [TD]}, "2": {open: [TC]}, "3": {engaged: [L], open: [TD]}}
"""


def test_the_filled_one_of_two_couplings_drives() -> None:
    """K = 1.2 at i = 0.8 before a pair of 2, and K = 2 at i = 0.5; what is open does nothing."""
    case = loads(COUPLINGS)
    results = solve(case)
    assert results.ratio.tolist() == pytest.approx([2.5, 2, 2])
    assert results.lossy_output_torque.tolist() == pytest.approx([2.4, 2, 2])
    assert results.lossy_torques[:, 1:3].tolist() == [[1, 0], [0, 1], [0, 0]]
    assert results.messages == ()
    assert solve(loads(COUPLINGS.replace("[L], open: [TD]", "[L], open: [TC, TD]"))).ratio[2] == 2
    assert case.gears[0].open == (2,)
    assert is_read_again(case)


def test_only_converters_can_be_open() -> None:
    for given, message in (
        ("open: [pair]", "pair is not a converter"),
        ("open: [L]", "the name of a mechanism: TC, TD, pair"),
        ("open: [TC, TC]", "TC is listed twice"),
        ("open: [TC], speed_ratios: {TC: 0.8}", "TC also has a speed ratio in this gear"),
        ("open: TC", "expected a list of converters"),
    ):
        with pytest.raises(ReadError, match=rf"gears\.1\.open.*{message}"):
            loads(COUPLINGS.replace("open: [TD]", given, 1))
