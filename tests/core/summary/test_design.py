"""The design table: ratios, steps and spread."""

import math
from itertools import pairwise

import pytest

from tests.commands import LOCKED, NEUTRAL, ROOT, json_answer, json_file, vstatics
from tests.core.summary.gearboxes import differential, summary_of
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.summary import summarize
from vstatics.core.summary.design_table import design

PUBLISHED = json_file(ROOT / "tests" / "published" / "zf-8hp70.json")["ratio"]


def test_steps_and_spread_are_those_of_the_published_ratios() -> None:
    """ZF 8HP70 as printed to four digits; see tests/published/zf-8hp70.json."""
    zf = summary_of("zf-8hp70.yaml")
    forward = [PUBLISHED[str(gear)] for gear in range(1, 9)]
    lines = {line.gear: line for line in zf.design.gears}
    for gear, (one, other) in zip("1234567", pairwise(forward), strict=True):
        assert lines[gear].next == str(int(gear) + 1)
        assert lines[gear].step == pytest.approx(one / other, abs=2e-4)
    assert zf.design.spread == pytest.approx(7.04, abs=0.01)  # the maker's figure
    assert lines["8"].next == lines["R"].next == ""
    assert math.isnan(lines["R"].step)


def test_a_neutral_gear_has_no_step_and_is_no_neighbour() -> None:
    made = json_answer("summary", "-", stdin=NEUTRAL.encode())
    neutral, low = made["gears"]
    assert (neutral["ratio"], neutral["state"], low["state"]) == (None, "open", "")
    assert made["transitions"] == []
    for form, end in (("text", "  neutral"), ("markdown", "| neutral |"), ("csv", ",open")):
        said = vstatics("summary", "-", "-f", form, stdin=NEUTRAL.encode()).out.splitlines()
        states = ("neutral", "open", "neutral |")
        assert {line[-len(end) :] for line in said if line.endswith(states)} == {end}
    assert made["sensitivity"]["D"] == [None, pytest.approx(2.5 / 3.5)]


def test_a_locked_gear_has_a_ratio_and_no_efficiency() -> None:
    made = json_answer("summary", "-", stdin=LOCKED.encode())
    [line] = made["gears"]
    assert line["ratio"] == pytest.approx(0.004 / 1.004)  # (u - 1)/u, driven from its slow end
    assert (line["efficiency"], line["state"]) == (None, "locked")


def test_operating_points_have_no_step_and_no_part_in_the_spread() -> None:
    """Ratios 3.5 and 1 are gears; the point between counts for neither."""
    low, direct = differential().gears
    point = Gear(speeds={2: 0.5}, kind="point", name="point")
    summary = summarize(solve(differential().replace(gears=[low, point, direct])))
    assert [line.next for line in summary.design.gears] == ["direct", "", ""]
    assert math.isnan(summary.design.gears[1].step)
    assert summary.design.spread == pytest.approx(3.5)
    assert [(one.start, one.end) for one in summary.transitions] == [("low", "direct")]


def test_a_ratio_of_0_has_no_step() -> None:
    """1/1e-310 overflows, so the output has no finite speed."""
    made = design(solve(Transmission(2, [], [Mechanism(1, 2, 0, 1e-310)], [Gear()])))
    assert math.isnan(made.spread)
    assert math.isnan(made.gears[0].step)
