"""Springs with points in the commands of `vstatics torsion`: which slope each takes, and says."""

from __future__ import annotations

import math

import pytest

from tests.cli.torsion.torsional import document, said

DAMPER = """\
links: [engine, disc, wheel]
inertias: {engine: 0.5, wheel: 2}
mechanisms: {pair: {first: disc, second: wheel, ratio: 1.5}}
springs: {damper: {links: [engine, disc], points: [[0, 0], [0.02, 0], [0.12, 30], [0.22, 90]]}}
load: {torque: 20 N*m}
"""
"""Play, 300 N*m/rad up to 30 N*m, then 600."""
ASKED = {
    "modes": (),
    "reduce": ("--to", "engine"),
    "simplify": ("--links", "1"),
    "identify": ("--omega", "5"),
    "damping": ("--decrements", "damper=.2"),
}


def omega(slope: float) -> float:
    """Of 0.5 kg*m^2, and 2 kg*m^2 behind a ratio of 1.5."""
    return math.sqrt(slope * (1 / 0.5 + 1.5**2 / 2))


@pytest.mark.parametrize("command", ASKED)
@pytest.mark.parametrize(
    ("options", "slope", "torque"),
    [((), 300, 20), (("--torque", "45 N*m"), 600, 45), (("--torque", "-0.01 kN*m"), 300, -10)],
)
def test_commands_tell_the_slope_that_they_take(
    command: str, options: tuple[str, ...], slope: float, torque: float
) -> None:
    made = said(command, *ASKED[command], *options, text=DAMPER)
    note = f"note: springs.damper.points: gear 1: {slope} N*m/rad at {torque} N*m"
    assert made.status == 0
    assert note in made.err


def test_modes_are_those_of_the_slope() -> None:
    for torque, slope in (("20", 300.0), ("45", 600.0)):
        [gear] = document("modes", "--torque", torque, text=DAMPER)["gears"]
        assert gear["modes"][0]["omega"] == pytest.approx(omega(slope))
        assert gear["slopes"] == {"damper": pytest.approx(slope)}


def test_the_resonance_is_that_of_the_slope_under_the_load() -> None:
    asked = ("--at", "engine", "--orders", "1", "--speed", "100:1000:2")
    [gear] = document("response", *asked, text=DAMPER)["gears"]
    [met] = gear["resonances"]
    assert met["speed"] * math.pi / 30 == pytest.approx(omega(300))


def test_in_play_the_spring_is_open() -> None:
    made = said("modes", "--torque", "0", text=DAMPER)
    assert "gear 1: in play, so it is open, at 0 N*m" in made.err
    [gear] = document("modes", "--torque", "0", text=DAMPER)["gears"]
    assert (gear["rigid_modes"], gear["modes"]) == (2, [])


def test_quiet_tells_no_slope_and_a_torque_has_its_unit() -> None:
    assert not said("modes", "-q", text=DAMPER).err
    wrong = said("modes", "--torque", "5 rpm", text=DAMPER)
    assert wrong.status == 2
    assert "read '5 rpm'" in wrong.err
