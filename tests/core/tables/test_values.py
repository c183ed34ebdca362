"""Tables in rpm, N*m and kW, and numbers with units in a case."""

import math

import pytest

from tests.core.elements.element_texts import SET, changed, loaded, problems, shown
from vstatics.core.writers.named import mapping

KW = math.pi / 30 / 1000
"""1 N*m at 1 rpm."""


def test_a_gear_has_a_load_of_its_own() -> None:
    """1 lbf*ft is 1.35581795 N*m; 100 PS are 73.549875 kW, at 955 rpm 735.4 N*m."""
    text = changed("low: {engaged: [B]}", "low: {engaged: [B], load: {torque: 100 lbf*ft}}")
    found = shown("load: {speed: 100 rad/s, torque: 1 kN*m}" + text)
    assert found["torques_Nm"].values[-1] == pytest.approx([3.5 * 135.581795, 1000])
    assert found["speeds_rpm"].values[0] == pytest.approx([954.929659] * 2)  # 100*30/pi
    text = text.replace("torque: 100 lbf*ft", "power: 100 PS, speed: 955 rpm")
    found = shown("load: {speed: 1000 rpm, torque: 1 kN*m}" + text)
    assert found["torques_Nm"].values[-1, 0] == pytest.approx(3.5 * 73.549875 / (955 * KW))
    assert found["input_power_kW"].values[0, 0] == pytest.approx(73.549875)
    only = shown("load: {speed: 1000 rpm}" + SET)
    assert "speeds_rpm" in only
    assert not {"torques_Nm", "losses_kW", "input_power_kW"} & only.keys()
    alone = changed("low: {engaged: [B]}", "low: {speeds: {ring: 300 rpm}}")
    assert any("there is no input speed to relate it to" in told for told in problems(alone))


def test_torques_that_are_given_with_a_unit_are_shown_as_given() -> None:
    for coast in ("false", "true"):
        text = changed("low: {engaged: [B]}", "low: {engaged: [B], torques: {ring: 12 N*m}}")
        found = shown(f"coast: {coast}\nload: {{speed: 2000 rpm, torque: 300 N*m}}" + text)
        # ring held by B: what the set gives to the ring, and what is put on it
        ring = dict(zip(found["torques_Nm"].rows, found["torques_Nm"].values[:, 0], strict=True))
        assert ring["B"] - 12 == pytest.approx(-ring["P1.ring"])


def test_a_load_that_is_none_is_reported_once() -> None:
    text = changed("low: {engaged: [B]}", "low: {engaged: [B], torques: {ring: 3 N*m}}")
    for load, words in (
        ("{power: 90 kW, speed: 3000 rpm, torque: 300 N*m}", "300 N*m at 3000 rpm are 94.248 kW"),
        ("{power: 90 kW}", "load: read `power` alone, expected a speed or a torque as well"),
        ("{power: 90 kW, speed: 0 rpm}", "load: read a power, speed or torque of 0, expected"),
        ("{power: 90, speed: 3000 rpm}", "load.power: read '90', expected a power with its unit"),
        ("{power: 0 kW, speed: 3 rpm}", "load: read a power, speed or torque of 0, expected"),
    ):
        [told] = [one for one in problems(f"load: {load}" + text) if "error" in one]
        assert told.startswith("case.yaml:1:")
        assert words in told


def test_a_load_is_written_as_it_was_given() -> None:
    """Power beside a speed, which it outlives; of a torque beside it speed and torque."""
    case = loaded("load: {power: 2 kW, speed: 500 rpm}" + SET)
    assert mapping(case)["load"] == {"speed": "500.0 rpm", "power": "2.0 kW"}
    case = loaded("load: {power: 2 kW, torque: 50 N*m}" + SET)
    assert mapping(case)["load"] == {"speed": f"{2 / 50 / KW!r} rpm", "torque": "50.0 N*m"}
