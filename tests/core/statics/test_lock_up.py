"""A converter whose links a lock-up clutch joins: it is as if it were not there."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.trains import random_train
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.springs import Spring, between
from vstatics.core.readers import loads

POINTS = ((0.0, 2.2), (0.85, 1.0))
NUMBERS = ("ratio", "efficiency", "power_balance")
STATES = ("missing", "excess", "consistent", "balanced", "locked", "tied_up")


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
    slipping = [
        one._replace(name=f"{n}C", speed_ratios={number: 1}) for n, one in enumerate(case.gears)
    ]
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


@pytest.mark.parametrize("damper", [False, True])
def test_a_locked_up_converter_is_as_none(*, damper: bool) -> None:
    chance, seen = seeded(damper), 0
    for _ in range(count(30, 300)):
        case = random_train(chance, regular=chance.random() < 0.8)
        if any(gear.input or case.input in gear.torques for gear in case.gears):
            continue  # it is another port then
        bare, results = solve(case), solve(with_converter(case, damper=damper))
        gears, devices = len(case.gears), len(case.shift_elements)
        inner = [*range(devices), *range(devices + 1, devices + 1 + len(case.mechanisms)), -1]
        for name in ("torques", "lossy_torques"):
            own = getattr(results, name)[:gears]
            expected = np.delete(getattr(bare, name), np.s_[devices + len(case.mechanisms) : -1], 1)
            np.testing.assert_allclose(own[:, inner], expected, rtol=1e-9, atol=1e-9)
            converter = own[:, devices + 1 + len(case.mechanisms)]
            assert (converter[~np.isnan(converter)] == 0).all()
        for name in NUMBERS:
            own, other = getattr(results, name)[:gears], getattr(bare, name)
            np.testing.assert_allclose(own, other, rtol=1e-9, atol=1e-9)
        for name in STATES:
            assert getattr(results, name)[:gears].tolist() == getattr(bare, name).tolist(), name
        seen += int(np.isfinite(bare.efficiency).sum())
    assert seen > count(30, 300) / 2


BOX = """
links: [engine, turbine, ring, output]
load: {{speed: 2200 rpm, torque: 250 N*m}}
shift_elements: {{B: [ring, housing], C: [turbine, ring], LU: [engine, turbine]}}
mechanisms:
  TC: {{kind: {kind}, first: engine, second: turbine{own}}}
  set: {{first: turbine, second: ring, third: output, ratio: -2.5, efficiency: 0.97}}
gears: {{low: {{engaged: [B], speed_ratios: {{TC: {low}}}}}, locked: {locked}}}
"""
CONVERTER = {"kind": "converter", "own": ", points: [[0, 2.2, .006], [.85, 1, .0045]]", "low": 0.8}


def test_a_locked_up_converter_needs_no_speed_ratio_and_has_no_other_than_1() -> None:
    case = loads(BOX.format(**CONVERTER, locked="[B, LU]"))
    results = solve(case)
    assert results.ratio.round(9).tolist() == [4.375, 3.5]
    assert results.efficiency[1] == pytest.approx(3.425 / 3.5)
    assert [one for one in results.messages if one.gear == "locked"] == []
    given = "{{engaged: [B, LU], speed_ratios: {{TC: {}}}}}"
    same = solve(loads(BOX.format(**CONVERTER, locked=given.format(1))))
    assert same.lossy_torques.tolist() == results.lossy_torques.tolist()
    with pytest.raises(
        CaseError, match="its speed ratio is 1: release its lock-up clutch"
    ) as caught:
        loads(BOX.format(**CONVERTER, locked=given.format(0.9)))
    assert caught.value.problems[0].id == "E455"


def test_a_speed_ratio_varies_where_the_converter_works() -> None:
    case = loads(BOX.format(**CONVERTER, locked="[B, LU]"))
    varied = solve(case, vary={"TC.speed_ratio": [0.5, 0.8]})
    assert varied.ratio.round(9).tolist() == [[7, 3.5], [4.375, 3.5]]


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
        text = BOX.format(**CONVERTER, locked="[B, LU]").replace("250 N*m", f"{torque} N*m")
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


def test_a_gear_without_its_lock_up_clutch_is_bypassed_no_more() -> None:
    case = loads(BOX.format(**CONVERTER, locked="[B, LU]"))
    assert [case.bypassed(gear) for gear in (*case.gears, Gear([1, 2]))] == [set(), {0}, set()]


def test_a_link_that_is_none_is_told_beside_a_converter() -> None:
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
