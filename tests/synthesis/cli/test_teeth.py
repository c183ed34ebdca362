"""`vstatics synth teeth`: what it shows, what it writes, what it is asked for wrongly."""

from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, Said, vstatics
from tests.core.cli.test_schemas import validator
from vstatics import load, solve

BELAZ = CASES / "belaz7516.yaml"
GOLDEN = ("--ratios", "2=4,4=2.01", "--ratios", "5=1.4925,R2=-5.12")
RANGES = ("--range", "sun=15:60,planet=14:60", "--range", "ring=1:121", "--planets", "3,4,5,6")


def said(*options: str, case: Path = BELAZ) -> Said:
    return vstatics("synth", "teeth", case, *options)


def document(*options: str, case: Path = BELAZ) -> dict[str, Any]:
    made: dict[str, Any] = said(*options, "-f", "json", case=case).json
    assert list(validator("teeth").iter_errors(made)) == []
    return made


def test_the_document_has_twenty_solutions() -> None:
    """The best is that of tests/synthesis/teeth/test_teeth.py."""
    solutions = document(*GOLDEN, *RANGES)["solutions"]
    assert len(solutions) == 20
    best = solutions[0]
    assert list(best) == ["teeth", "planets", "gears", "error"]
    assert best["teeth"]["P3"] == {"sun": 15, "ring": 45, "planet": 15}
    assert best["planets"]["P3"] == 3
    errors = [one["error"] for one in solutions]
    assert errors == sorted(errors)


def test_the_case_that_is_written_has_the_ratios(tmp_path: Path) -> None:
    """Of a set, and of a pair with given axes: 40 + 65 teeth."""
    file, box = tmp_path / "teeth.yaml", tmp_path / "box.yaml"
    text = "links: 4\nmechanisms:\n  P: {first: 1, second: 2, third: 3, ratio: -2}\n"
    text += "  G: {first: 3, second: 4, ratio: -1.6}\nshift_elements: {B: [2, housing]}\n"
    box.write_text(text + "gears: {low: [B]}\n", "utf-8")
    answer = said("--ratios", "low=-5.6875", "--centre", "G=52.5", "--write", str(file), case=box)
    assert answer.status == 0, answer.err
    assert solve(load(file)).ratio.tolist() == pytest.approx([-5.6875], rel=1e-3)


def test_many_gears_of_a_set_continue_in_the_next_row() -> None:
    """The triple gears of the Model T have six toothed gears."""
    printed = said("--range", "all=20:34", case=CASES / "ford-model-t.yaml").out
    assert max(map(len, printed.splitlines())) <= 80
    table = printed.partition("\nTeeth\n")[2].partition("\n\n")[0].splitlines()
    assert [line[:12] for line in table[1:]] == ["triple gears", *[" " * 12] * (len(table) - 2)]
    gears = "driven gear", "low sun", "reverse sun", "B", "D", "E"
    assert all(f" {gear} " in " ".join(table) for gear in gears)


def test_one_module_of_all_gears_is_given_once() -> None:
    asked = "--ratios", "2=4.3217", "--range", "sun=14:58,planet=14:58,ring=20:70"
    printed = said(*asked, "--planets", "3", "--modules", "2.5", "--largest-diameter", "400").out
    assert ("2.5" in printed, "sun 2.5" in printed) == (True, False)


def test_wrong_use() -> None:
    for options, message in (
        (("--ratios", "9=3"), "no gear or gear set `9`; gears are 1, 2"),
        (("--ratios", "2=-4"), "expected a ratio above 0"),
        (("--ratios", "P1=2.03"), "did you mean -2.03?"),
        (("--range", "sin=17:20"), "no toothed gear `sin`; did you mean `sun`?"),
        (("--range", "sun=20:17"), "the smaller number first"),
        (("--range", "sun=17.5:20"), "expected whole numbers of teeth"),
        (("--planets", "0"), "from 1 to"),
        (("--centre", "P1=52"), "no external gear pair `P1`"),
        (("--largest-diameter", "220"), "give --modules"),
        (("--shift", "3"), "expected 0 to 2 teeth"),
        (("--modules", "2,,3"), "read `2,,3`"),
        (("--clearance", "-1"), "0 or more"),
    ):
        answer = said(*options)
        assert answer.is_wrong_use(message)


def test_no_teeth_and_what_excludes_most() -> None:
    """Six planets need a sun about as large as they are: (1 + p) sin 30° > p + 2.5 at p = 1."""
    answer = said("--ratios", "P1=-2", "--range", "P1.sun=12:13", "-f", "json")
    assert (answer.status, answer.json) == (1, {"solutions": []})
    assert "most are excluded by: undercut" in answer.err
    ranges = ["--planets", "6", "--range", "sun=14:19,planet=14:22"]
    assert "excluded by: neighbouring planets" in said("--ratios", "P1=-2", *ranges).err
    ranges = ["--range", "sun=20,planet=20,ring=61:70"]
    assert said("--ratios", "P1=-2", *ranges).err.endswith("excluded by: coaxial\n")


def test_few_teeth_and_a_target_far_away() -> None:
    """Nothing is left to try once the best is known."""
    ranges = ("--range", "sun=14:58,planet=14:58,ring=20:70", "--planets", "3")
    made = document("--ratios", "2=4.3217", *ranges, "--clearance", "2.5", "--error", "absolute")
    assert made["solutions"]


def test_the_ranges_hold_the_own_teeth_and_what_is_beyond_them_is_reported() -> None:
    """P3 of BelAZ-7516 has 15 teeth on sun and planet; no other has fewer than 17."""
    answer = said("--ratios", "2=20,P4=-2", "--dry-run", "-f", "json")
    asked = answer.json
    ranges = asked["ranges"]
    assert asked["kinds"] == {"P3": "planetary", "P4": "planetary"}
    assert {name: one["sun"]["from"] for name, one in ranges.items()} == {"P3": 15, "P4": 17}
    assert "warning: gear 2 cannot have 20: within the bounds its ratio is" in answer.err
