"""Converters without a speed ratio in files and commands: messages, answers, wrong inputs."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.core.writers.again import is_read_again
from vstatics import CaseError, solve
from vstatics.core.readers import loads
from vstatics.core.statics import signs
from vstatics.core.writers.deck_limits import check_deck

CASE = """links: [engine, turbine, output]
load: {speed: 200 rad/s, torque: 100 N*m}
shift_elements: {L: [engine, turbine]}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2, 0.002], [1, 1, 0]]}
  pair: {first: turbine, second: output, ratio: -3}
gears: {"1": {}, "2": {engaged: [L]}, "3": {load: {torque: 90 N*m}}}
"""
"""The pump takes T at i = 1 - T/80 N*m, as lambda = T/200^2."""


def test_a_load_beyond_the_points_leaves_the_gear_without_torques() -> None:
    """80 N*m are taken at stall; the speeds of engine and pump stay known."""
    results = solve(loads(CASE))
    assert [said.id for said in results.messages] == ["W431", "W431"]
    assert results.messages[0].text.endswith("; at the input speed it takes 0 to 80 N*m")
    assert results.speeds[0, 0] == 1
    for array in (results.speeds[0, 1:], results.lossy_torques[0, 1:], results.ratio[[0, 2]]):
        assert all(map(math.isnan, array))
    assert results.status(1).name == results.gear(1).status.name == "no torques"
    assert (results.ratio[1], results.status(2).name) == (-3, "")
    at_stall = solve(loads(CASE.replace("100 N", "80 N")))
    assert (at_stall.speed_ratio[0, 0], at_stall.lossy_output_torque[0]) == (0, -6)


def test_a_turbine_that_drives_only_its_drag_has_a_closed_form() -> None:
    """K = 2 - i and lambda w^2 = 80 (1 - i): 60 N*m at i = 0.5, with 40 N*m on the pump."""
    text = CASE.replace("{first: turbine", "{first: engine") + "drag: {turbine: 60 N*m}\n"
    results = solve(loads(text))
    assert results.speed_ratio[[0, 2], 0] == pytest.approx(0.5, abs=1e-13)
    assert results.lossy_output_torque_Nm == pytest.approx([-180, -120, -150])


def test_json_and_sheet_have_the_ratio_of_each_gear_that_is_sought(folder: Path) -> None:
    """20 N*m are taken at 1 - 20/80; an open or bypassed converter has none."""
    text = CASE.replace("100 N", "20 N").replace('"3": {', '"3": {open: [TC], ')
    (folder / "box.yaml").write_text(text)
    found = {"TC": {"speed_ratio": pytest.approx(0.75), "others": []}}
    answer = json.loads(vstatics("run", "box.yaml", "-f", "json").out)
    assert answer["converters"] == [found, {"TC": None}, {"TC": None}]
    opened = text.replace('"1": {}, ', "").replace("[L]}", "[L], open: [TC]}")
    (folder / "locked.yaml").write_text(opened)
    locked = json.loads(vstatics("run", "locked.yaml", "-f", "json").out)
    assert locked["converters"] == [{"TC": None}, {"TC": None}]
    sheet = " ".join(vstatics("explain", "box.yaml", "--worksheet", "--gear", "1").out.split())
    assert "M = lambda(i) w |w|" in sheet
    assert "TC: i = 0.75, lambda = 0.0005 N*m*s^2, w = 200 rad/s, M = 20 N*m." in sheet
    given = text.replace("second: turbine,", "second: turbine, speed_ratio: 0.75,")
    (folder / "box.yaml").write_text(given)
    assert "converters" not in json.loads(vstatics("run", "box.yaml", "-f", "json").out)


def test_it_is_written_as_it_was_read_and_no_deck_has_it() -> None:
    case = loads(CASE)
    assert is_read_again(case)
    with pytest.raises(CaseError, match="TC"):
        check_deck(case)
    given = loads(CASE.replace('"1": {}', '"1": {speed_ratios: {TC: 0.5}}'))
    assert solve(given).speed_ratio[0, 0] == 0.5
    varied = solve(case, vary={"TC.speed_ratio": [0.25, 0.5]})
    assert varied.speed_ratio[:, 0, 0].tolist() == [0.25, 0.5]


def test_inputs_without_a_ratio_are_reported(folder: Path) -> None:
    for old, new, message in (
        (", 0.002], [1, 1, 0]", "], [1, 1]", "for all gears, or lambda in its points"),
        ("load: {speed: 200 rad/s, torque: 100 N*m}", "", "gears.1: the speed ratio of TC"),
        (", torque: 100 N*m", "", "has no torque: expected a `load` with both"),
        ("pair: {", "TD: {kind: converter, points: [[0, 2, 1], [1, 1, 0]], ", "TC and TD"),
        ("[0, 2, 0.002], [1, 1, 0]", "[1, 1, 0], [0, 2, 0.002]", "points must ascend"),
        ("[0, 2, 0.002]", "[0, 2, -0.002]", "a lambda of 0 or more"),
        ("[0, 2, 0.002]", "[0, 2, 0]", "at no speed ratio from 0 to 1"),
        ("torque: 100 N*m", "torque: -20 N*m", "needs points beyond i = 1"),
    ):
        text = CASE.replace(old, new)
        text = text.replace(", ratio: -3", "") if "TD" in new else text
        text = text if new else text.replace("load: {torque: 90 N*m}", "")
        (folder / "box.yaml").write_text(text)
        said = vstatics("run", "box.yaml")
        assert said.status == (0 if "i = 1" in message or "ratio from" in message else 1)
        assert message in said.err


def test_a_slipping_lock_up_clutch_carries_what_the_pump_does_not_take() -> None:
    """At i = 0.9 and 200 rad/s the pump takes 0.002 * 0.1 * 200^2 = 8 N*m; when open, nothing."""
    case = loads(CASE.replace("{engaged: [L]}", "{slip: {L: 0.1}}"))
    for opened, pump in (((), 8), ((1,), 0)):
        results = solve(case.replace(gears=[case.gears[1]._replace(open=opened)]))
        clutch = 0.1 * (100 - pump) * 200 / 1000
        assert results.slip_losses_kW[0, 0] == pytest.approx(clutch)
        assert not results.messages


def test_a_slip_that_varies_can_be_0_where_the_clutch_is_engaged() -> None:
    """The pump takes 0.002 * slip * 200 N*m of 100 N*m, and nothing without slip."""
    for slip in (0, 0.1):
        case = loads(CASE.replace("{engaged: [L]}", f"{{slip: {{L: {slip}}}}}"))
        results = solve(case, vary={"gears.2.slip.L": [0.0, 10.0, 20.0]})
        assert results.lossy_torques_Nm[:, 1, 0].tolist() == pytest.approx([100, 96, 92])


def test_a_slip_with_which_the_clutch_would_drive_has_the_right_remedy() -> None:
    """At i = 0.1 and 200 rad/s the pump takes 72 N*m, more than the load; below 0 the clutch drives."""
    for slip, torque, side in ((180, 50, "nearer to"), (-5, 50, "above"), (5, -50, "below")):
        text = CASE.replace("[1, 1, 0]", "[1, 1, 0], [1.2, 1, -0.002]")
        text = text.replace("{engaged: [L]}", f"{{slip: {{L: {slip} rad/s}}}}")
        messages = solve(loads(text.replace("100 N*m", f"{torque} N*m"))).messages
        [said] = [said.text for said in messages if said.id == "W438"]
        assert said.endswith(f"only a slip {side} 0 is possible")


def test_a_torque_at_which_a_converter_would_gain_power_is_explained(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """From i = 1 to 1/0.98 the pump would give more power than the turbine receives: 0 to -20 N*m."""
    monkeypatch.setattr(signs, "_search", None)  # no signs of other mechanisms can help
    points = "[[0, 2, 0.02], [1, 0.98, 0], [1.2, 0.98, -0.02]]"
    converter = f"{{kind: converter, first: e, second: t, points: {points}}}"
    for torque, explained in ((-1, [True]), (-30, []), (-300, [False])):
        load = f"load: {{speed: 100 rad/s, torque: {torque} N*m}}"
        case = loads(f"links: [e, t]\n{load}\nmechanisms: {{TC: {converter}}}\n")
        texts = [said.text for said in solve(case).messages if said.id == "W431"]
        assert [text.endswith("its torque ratio is below 1/i") for text in texts] == explained


def test_a_slip_without_its_unit_is_explained() -> None:
    """A slip of 60, meant in rpm, is 60 times the input speed, so i = -59 is below the points."""
    far = "a slip of 60 is 60 times the input speed"
    for slip, ending in (("60", far), ("201 rad/s", "points")):
        messages = solve(loads(CASE.replace("{engaged: [L]}", f"{{slip: {{L: {slip}}}}}"))).messages
        [said] = [said for said in messages if said.gear == "2"]
        assert (said.id, said.text.endswith(ending)) == ("W431", True)


def test_a_clutch_slips_before_or_behind_the_converter() -> None:
    """The pump takes 0.002 (1 - i) w^2 = 10 N*m at w = 100 or 200 rad/s; K = 2 - i."""
    text = """links: [engine, pump, turbine, output]
load: {speed: 200 rad/s, torque: 10 N*m}
shift_elements: {K: [engine, pump], L: [turbine, output], B: [housing, turbine]}
mechanisms:
  TC: {kind: converter, first: pump, second: turbine, points: [[0, 2, 0.002], [1, 1, 0]]}
gears:
  before: {engaged: [L], slip: {K: 100 rad/s}}
  behind: {engaged: [K], slip: {L: 20 rad/s}}
  at rest: {engaged: [L], slip: {K: 200 rad/s}}
  braked: {engaged: [K, L], slip: {B: -175 rad/s}}
"""
    results = solve(loads(text))
    assert results.speed_ratio[[0, 1, 3], 0].tolist() == pytest.approx([0.5, 0.875, 0.875])
    assert results.lossy_output_torque_Nm[:2].tolist() == pytest.approx([15, 11.25])
    assert results.efficiency[:2].tolist() == pytest.approx([15 * 50 / 2000, 11.25 * 155 / 2000])
    point = solve(loads(text.replace("[0, 2, 0.002], [1, 1, 0]", "[0.5, 1.5, 0.001]")))
    assert point.lossy_output_torque_Nm[0] == pytest.approx(15)
    for outcome, gears in ((results, ["at rest"]), (point, ["behind", "at rest", "braked"])):
        assert [said.gear for said in outcome.messages if said.id == "W431"] == gears
    driving = solve(loads(text.replace("L: 20", "L: -20"))).messages
    [said] = [said.text for said in driving if said.gear == "behind"]
    assert said.endswith("only a slip above 0 is possible")


def test_a_reversed_freewheel_is_named_when_the_lock_up_clutch_slips() -> None:
    """The turbine turns at 0.9 of the input speed, so the freewheel would slip by -0.9."""
    text = CASE.replace("turbine]}", "turbine], F: {kind: freewheel, links: [housing, turbine]}}")
    said = str(solve(loads(text.replace("{engaged: [L]}", "{slip: {L: 0.1}}"))).messages)
    assert "conflict: freewheel F can neither overrun (its slip would be -0.9," in said


def test_a_given_ratio_that_contradicts_a_slip_has_a_remedy() -> None:
    text = CASE.replace("second: turbine,", "second: turbine, speed_ratio: 0.8,")
    case = loads(text.replace("{engaged: [L]}", "{slip: {L: 0.1}}"))
    [said] = [said.text for said in solve(case).messages if said.id == "E452"]
    remedy = "remove the slip of L or remove the speed ratio of TC, which the slip then determines"
    assert said.endswith(f"as given; {remedy}")


def test_a_pump_that_no_clutch_relieves_is_named() -> None:
    """At w = 50 rad/s and i = 10/50 the pump takes 0.002 (1 - i) w^2 = 4 N*m of 10 N*m."""
    text = """links: [engine, pump, turbine]
load: {speed: 200 rad/s, torque: 10 N*m}
shift_elements: {K: [engine, pump], B: [turbine, housing]}
mechanisms:
  TC: {kind: converter, first: pump, second: turbine, points: [[0, 2, 0.002], [1, 1, 0]]}
gears: {stall: {slip: {K: 150 rad/s, B: 10 rad/s}}}
"""
    [said] = solve(loads(text)).messages
    assert (said.id, "the pump of TC takes 4 N*m, and no clutch" in said.text) == ("W418", True)
