"""`vstatics synth box --gears`: what is asked, and what can't be."""

import itertools

import pytest

from tests.commands import vstatics

COUNTS = ("--sets", 2, "--shift-elements", 4, "--engaged", 2, "--own-input")


@pytest.mark.slow
def test_what_is_told_has_the_steps_that_are_wanted() -> None:
    asked = (*COUNTS, "--gears", "3:4", "--spread", "2:4", "--step-ratios", "1.3:1.8")
    said = vstatics("synth", "box", *asked, "--ratios=-2.3:-2.1", "-f", "json", "-j", 1)
    listing = said.json
    assert listing["found"] > 0
    for box in listing["boxes"]:
        *forward, last = (gear["ratio"] for gear in box["gears"].values())
        assert -2.3 <= last <= -2.1
        steps = [one / other for one, other in itertools.pairwise(forward)]
        assert all(1.3 <= step <= 1.8 for step in steps)
        assert 2 <= forward[0] / forward[-1] <= 4


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (("--gears", "x"), "expected how many, such as 6:8"),
        (("--gears", "1"), "read 1:1, expected numbers from 2 to 24"),
        (("--gears", "7"), "read 7 gears, but 4 elements with 2 engaged give 6 gears at most"),
        (
            ("--gears", "3", "--step-ratios", "1.8:1.2"),
            "--step-ratios: read 1.8:1.2, expected two numbers from",
        ),
        (("--ratios", 3, "--falling"), "describe --gears"),
        ((), "Missing option '--ratios'"),
    ],
)
def test_what_can_not_be_asked(given: tuple[object, ...], told: str) -> None:
    said = vstatics("synth", "box", *COUNTS, *given)
    assert said.is_wrong_use(told)
