"""Options of `vstatics synth box`: ranges and tolerances as typed, sequences, parts to keep."""

import itertools
import math

import pytest

from tests.commands import vstatics
from vstatics.synthesis.cli.box import ratios as typed

KEEP = ("--keep", "cases/simpson.yaml")
RATIOS = ("--ratios", "2.48,1.48,1,-2.09")
COUNTS = ("--sets", 2, "--shift-elements", 4, "--engaged", 2, "--own-input")


def gears(ratios: str, tolerance: str) -> typed.WantedGears:
    ranges = [typed.wanted_ratio(one) for one in ratios.split(",")]
    return typed.wanted_gears(ranges, typed.wanted_tolerances(0.01)([tolerance]))


def test_a_number_is_the_range_of_its_tolerance() -> None:
    by_range = gears(f"{3.5 * math.exp(0.02)}:{3.5 * math.exp(-0.02)},{-2.0 * math.e}:-2", ".01")
    by_tolerance = gears(f"3.5,{-2 * math.exp(0.5)}", ".01,1=.02,R=.5")
    assert by_range.targets == pytest.approx(by_tolerance.targets, rel=1e-14)
    assert by_range.tolerances == pytest.approx(by_tolerance.tolerances, rel=1e-13)
    assert gears("3,1", ".02") == typed.WantedGears((3.0, 1.0), 0.02, ())


def test_gears_are_named_by_falling_ratio_however_they_stand() -> None:
    one = gears("1,-4:-2.5,5.8:6.2,2.4", "2=.03,.02,3=.04")
    other = gears("6.2:5.8,2.4,1,-2.5:-4", ".02,3=.04,2=.03")
    assert sorted(other.tolerances) == pytest.approx(sorted(one.tolerances))
    assert sorted(other.targets) == pytest.approx(sorted(one.targets))
    widths = 0.04, math.log(4 / 2.5) / 2, math.log(6.2 / 5.8) / 2, 0.03
    assert one.tolerances == pytest.approx(widths)


@pytest.mark.slow
def test_boxes_of_a_sequence_have_the_steps_that_are_wanted() -> None:
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


@pytest.mark.slow
def test_a_gearbox_that_keeps_all_is_found() -> None:
    said = vstatics("synth", "box", *KEEP, *RATIOS, "-f", "json", "-j", 1)
    assert (said.status, said.json["searched"], said.json["found"]) == (0, 1, 1)


def test_options_that_need_others() -> None:
    for given, status, told in (
        ((*KEEP, *RATIOS, "--sets", 2), 2, "--sets follows from the case of --keep"),
        ((*KEEP, *RATIOS, "--free", "sets=1"), 2, "read `sets`, expected shift-elements=N"),
        ((*KEEP, *RATIOS, "--free", "elements=x"), 2, "expected a number from 0 to 12"),
        (("--keep", "cases/none.yaml", *RATIOS), 1, "none.yaml"),
        (("--keep", "cases/two-stage.yaml", *RATIOS), 1, "P0 is not a planetary gear set"),
        (RATIOS, 2, "Missing option '--sets'"),
        (COUNTS, 2, "Missing option '--ratios'"),
    ):
        said = vstatics("synth", "box", *given)
        assert (said.status, told in said.err) == (status, True)
