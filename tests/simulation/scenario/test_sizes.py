"""Numbers that nothing has are refused where they stand."""

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.commands import Said, vstatics

CASE = """\
inertias: {in: 1, out: 2}
shift_elements: {C: {links: [in, out], capacity: 60 N*m}}
springs: {S: {links: [out, housing], stiffness: 1e3, damping: 0.1}}
gears: {"1": [C]}
"""
SCENARIO = """\
case: case.yaml
duration: 1
start: {speeds: {in: 30, out: 0}}
controls: {C: [[0, 10], [.5, 20]]}
torques: {in: 15, out: {road: {mass: 20, radius: .3}}}
"""


Change = Callable[..., Said]


@pytest.fixture
def said(folder: Path) -> Change:
    """What a command says of both files, of which one has a text replaced."""

    def answer(old: str, new: str, command: str = "simulate") -> Said:
        for name, text in (("case.yaml", CASE), ("scenario.yaml", SCENARIO)):
            (folder / name).write_text(text.replace(old, new))
        return vstatics(command, "scenario.yaml", "-f", "json")

    return answer


def test_a_number_that_nothing_has(said: Change) -> None:
    """Told at its key or right there."""
    for old, new, read in (
        ("in: 1,", "in: 1e20,", "1e+20"), ("out: 2}", "out: 1e-40}", "1e-40"),
        ("capacity: 60", "capacity: 6e60", "6e+60"), ("duration: 1", "duration: 1e-90", "1e-90"),
        ("stiffness: 1e3", "stiffness: 1e98", "1e+98"), ("in: 15", "in: 15e90", "1.5e+91"),
        ("damping: 0.1", "damping: 1e-98", "1e-98"), ("radius: .3", "radius: 3e16", "3e+16"),
        ("in: 30", "in: 3e30", "3e+30"), ("[.5, 20]", "[.5, 1e-30]", "1e-30"),
        ("in: 15", 'in: "1e20*(t > 1)"', "1e+20"),
        ("in: 15", 'in: "-15*sign(speed - 1e-200)"', "1e-200"),
        ("C: [[0, 10], [.5, 20]]", 'C: "10 + 1e-40*t"', "1e-40"),
    ):  # fmt: skip
        shown = said(old, new)
        assert shown.status == 1
        [first, *_] = shown.err.splitlines()
        file, line, column, *_ = first.split(":")
        at = Path(file).read_text().splitlines()[int(line) - 1].index(new)
        assert int(column) - 1 in (at, at + new.index(" ") + 1)
        assert f"read {read}, expected " in first


TORQUE, CAPACITY = "scenario.yaml:5:11: error: torques.in: ", "scenario.yaml:4:12: error: controls."
LARGEST = "expected 1e+15 at most"


def test_what_is_no_number_or_too_large(said: Change) -> None:
    """With 1e-13 of the largest inertia a speed would have no certain digit."""
    for old, new, place, told in (
        ("in: 1,", "in: 1e-13,", "case.yaml:1:12: error: inertias.in: read 1e-13, expected at",
         "the largest inertia, 2: leave it out"),
        *(("in: 15", f"in: {law}", TORQUE, ", expected a number")
          for law in ("1/0", '"1/0"', '"0/0"', '"15/(t - t)"', '"exp(1e4)"')),
        *(("in: 15", f'in: "{law}"', TORQUE, LARGEST)
          for law in ("10^20*(t > .5)", "exp(100*t)", "1/(.5 - t)^9")),
        *(("[[0, 10], [.5, 20]]", law, CAPACITY, "")
          for law in ('"1/0"', '"0/0"', '"1e300*1e300"', '"10^20*t"')),
    ):  # fmt: skip
        assert said(old, new).fails(place, told), new
    shown = said("in: 15", 'in: "15/(1 - 1)"', "check")
    assert "read `15/(1 - 1)`, which is inf" in shown.all


def test_a_start_speed_may_be_0_but_for_rounding(said: Change) -> None:
    """At rest, 15 N*m are above the 10 of the clutch: it speeds up."""
    for speed in (-2.9e-16, 5e-324, -1e-300):
        assert said("in: 30", f"in: {speed}").is_without_messages()
