"""Springs with points in the commands of `vstatics torsion`: which slope each takes, and says."""

import math

import pytest

from tests.torsion.cli.torsional import document, said

DAMPER = """\
links: [engine, disc, wheel]
inertias: {engine: 0.5, wheel: 2}
mechanisms: {pair: {first: disc, second: wheel, ratio: 1.5}}
springs: {damper: {links: [engine, disc], points: [[0, 0], [0.02, 0], [0.12, 30], [0.22, 90]]}}
load: {torque: 20 N*m}
"""
"""Play, 300 N*m/rad up to 30 N*m, then 600."""
ASKED = {
    "modes": (), "reduce": ("--to", "engine"), "simplify": ("--links", "1"),
    "identify": ("--omega", "5"), "damping": ("--decrements", "damper=.2"),
}  # fmt: skip


@pytest.mark.parametrize("command", ASKED)
def test_commands_tell_the_slope_that_they_take(command: str) -> None:
    for options, slope, torque in (
        ((), 300, 20), (("--torque", "45 N*m"), 600, 45), (("--torque", "-0.01 kN*m"), 300, -10),
    ):  # fmt: skip
        made = said(command, *ASKED[command], *options, text=DAMPER)
        note = f"note: springs.damper.points: gear 1: {slope} N*m/rad at {torque} N*m"
        assert (made.status, note in made.err) == (0, True), options


def test_a_torque_is_that_of_the_slope_and_has_its_unit() -> None:
    """0.5 kg*m^2, and 2 kg*m^2 behind a ratio of 1.5; in play the spring is open."""
    for torque, slope in (("20", 300.0), ("45", 600.0)):
        [gear] = document("modes", "--torque", torque, text=DAMPER)["gears"]
        omega = math.sqrt(slope * (1 / 0.5 + 1.5**2 / 2))
        assert gear["modes"][0]["omega"] == pytest.approx(omega)
        assert gear["slopes"] == {"damper": pytest.approx(slope)}
    made = said("modes", "--torque", "0", text=DAMPER)
    assert "gear 1: in play, so it is open, at 0 N*m" in made.err
    assert not said("modes", "-q", text=DAMPER).err
    assert said("modes", "--torque", "5 rpm", text=DAMPER).is_wrong_use("read '5 rpm'")


def test_gears_with_an_equal_slope_share_its_note() -> None:
    """The damper carries the torque of the input in each gear, and of the load of the last one."""
    gears = "gears: {a: [], b: [], c: {load: {torque: 45 N*m}}}"
    notes = [line for line in said("modes", text=DAMPER + gears).err.splitlines() if "note" in line]
    assert [note.partition("points: ")[2] for note in notes] == [
        "gears a and b: 300 N*m/rad at 20 N*m", "gear c: 600 N*m/rad at 45 N*m",
    ]  # fmt: skip


CONVERTER = """\
links: [engine, pump, turbine]
inertias: {engine: 0.9, pump: 0.25, turbine: 3}
load: {speed: 1500 rpm, torque: 500 N*m}
converters: {TC: {links: [pump, turbine], points: [[0, 2, 8e-3], [.9, 1, 4e-3], [1, 1, 0]]}}
springs: {dmf: {links: [engine, pump], points: [[0, 0], [0.1, 60], [0.35, 900]]}}
gears: {"1": {speed_ratios: {TC: 0.99}}}
"""
"""At .99 and 1500 rpm the pump takes 4e-4 (50 pi)^2 = 9.87 N*m: 600 N*m/rad."""
BY_WORKING_POINT = {
    "modes": (),
    "response": ("--at", "engine", "--orders", "1", "--speed", "300:600:2"),
    "reduce": ("--to", "engine"),
}


@pytest.mark.parametrize("command", BY_WORKING_POINT)
def test_a_damper_before_a_converter_carries_what_the_pump_takes(command: str) -> None:
    made = said(command, *BY_WORKING_POINT[command], text=CONVERTER)
    assert "gear 1: 600 N*m/rad at 9.8696 N*m" in made.err
    assert "the load brings 500 N*m to the pump of TC, which at the speed ratio 0.99" in made.err
    assert made.err.count("the load brings") == 1
    agreeing = CONVERTER.replace("500 N*m", "9.8696 N*m")
    assert "the load brings" not in said(command, *BY_WORKING_POINT[command], text=agreeing).err


def test_torque_and_speed_ratio_may_contradict_each_other() -> None:
    call = ("modes", "--torque", "500", "--speed-ratio", "TC=.95")
    told = said(*call, text=CONVERTER).err
    assert "at the speed ratio 0.95 and 1500 rpm takes 49.348 N*m" in told
    [gear] = document("modes", "--speed-ratio", "TC=.95", text=CONVERTER)["gears"]
    root = math.sqrt(600 * (1 / 0.9 + 1 / 0.25))
    assert gear["modes"][0]["omega"] == pytest.approx(root)


def test_dry_friction_that_is_left_out_or_linearised_is_reported() -> None:
    """Once, and not where nothing is damped: compliances have no friction."""
    text = DAMPER.replace("[0.22, 90]]", "[0.22, 90]], friction: 4 N*m").replace("20 N*m", "8 N*m")
    for command, told in (
        ("modes", "linear vibration omits the dry friction of damper"),
        ("response", "the dry friction M of damper, 4 N*m, counts as the damper"),
    ):
        made = said(command, *BY_WORKING_POINT[command], text=text)
        assert made.err.count(f"springs.damper.friction: {told}") == 1
        assert "dry friction" not in said(command, *BY_WORKING_POINT[command], text=DAMPER).err
    assert "dry friction" not in said("reduce", "--to", "engine", text=text).err
