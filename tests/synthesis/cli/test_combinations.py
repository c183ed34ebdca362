"""`vstatics synth combinations`: what it writes, what it refuses, what it makes of a case."""

import csv
import json
import re
from itertools import permutations
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, Said, json_file, vstatics
from tests.core.cli.test_schemas import validator
from vstatics import load, solve
from vstatics.core.cli.shared import estimates

BELAZ = CASES / "belaz7516.yaml"
UMDM = (CASES / "umdm.yaml", "--shift-elements", "auto")
DRIVELINE = (CASES / "driveline-8hp70.yaml", "--shift-elements", "auto")
DIFFERENTIAL = CASES / "differential.yaml"
"""Links 1 to 3, a clutch, and a brake on 2."""
FREEWHEELS = """\
links: 3
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5}}
shift_elements:
  L: {kind: freewheel, links: [2, housing]}
  M: {kind: freewheel, links: [1, 2]}
  C: [1, 2]
gears: {low: {}}
"""
FREE = """\
links: 5
output: 3
mechanisms:
  P: {first: 1, second: 2, third: 3, ratio: -2.5}
  Q: {first: 4, second: 5, third: 3, ratio: -2}
shift_elements: {A: [2, housing], B: [1, 2], D: [4, housing]}
gears: {N: {}}
"""
"""Nothing but D holds the second set."""


def said(*arguments: object) -> Said:
    return vstatics("synth", "combinations", *arguments)


def documents(*arguments: object) -> Any:
    """The value of the only key of the JSON document; JSON lines are its items."""
    document = said(*arguments, "-f", "json").json
    [found] = document.values()
    lines = said(*arguments, "-f", "jsonl").out.splitlines()
    assert [json.loads(line) for line in lines] == found
    for one in (document, found[0]):
        assert [*validator("combinations").iter_errors(one)] == []
    return found


def table(*arguments: object) -> list[dict[str, str]]:
    text = said(*arguments, "-f", "csv", "--raw").out
    return [one for one in csv.DictReader(text.splitlines()) if one["table"] == "combinations"]


def test_json_has_the_shape_that_is_promised() -> None:
    """The kinds and ratios are those of tests/synthesis/gears/test_gears.py."""
    found = documents(BELAZ)
    keys = ["engaged", "kind", "ratio", "free"]
    with_ratio = [list(one) for one in found if one["ratio"] is not None]
    assert with_ratio == [[*keys, "torques"]] * 8
    assert [list(one) for one in found if one["ratio"] is None] == [keys] * 7
    assert found[1] == {"engaged": ["F1", "T1"], "kind": "blocked", "ratio": None, "free": False}


def test_ports_have_a_block_each() -> None:
    """A differential, Willis with u = -2.5: (1 - u) and its inverse with the ring held."""
    blocks = documents(DIFFERENTIAL, "--ports", "1:3, 3:1")
    assert blocks == documents(DIFFERENTIAL, "--ports", "1:3", "--ports", "3:1")
    assert [(one["input"], one["output"]) for one in blocks] == [("1", "3"), ("3", "1")]
    ratios = [[each["ratio"] for each in one["combinations"]] for one in blocks]
    assert ratios == [pytest.approx([1, 3.5]), pytest.approx([1, 1 / 3.5])]
    assert "Combinations, 3 to 1\n" in said(DIFFERENTIAL, "--ports", "3:1").out


def test_all_ports_are_all_ordered_pairs_and_have_no_brakes_of_auto() -> None:
    found = documents(DIFFERENTIAL, "--ports", "all", "--shift-elements", "auto")
    assert [(one["input"], one["output"]) for one in found] == [*permutations("123", 2)]
    for one in found:
        [brake] = {"1", "2", "3"} - {one["input"], one["output"]}
        engaged = [each["engaged"][0] for each in one["combinations"]]
        assert len(engaged) == 4
        own = "T" if brake == "2" else f"T-{brake}"
        assert [name for name in engaged if name.startswith("T")] == [own]


@pytest.mark.parametrize(("asked", "count"), [(UMDM, 19), ((BELAZ,), 15)])
def test_tables_have_torques_and_slip_as_json_has(asked: tuple[object, ...], count: int) -> None:
    """Of one element a number, of several their list in the order of the names."""
    found, rows = documents(*asked), table(*asked)
    assert len(rows) == len(found) == count
    for row, one in zip(rows, found, strict=True):
        torques = [float(number) for number in row["torques"].split(",") if number]
        assert torques == list(one.get("torques", {}).values())
        assert (float(row["slip"]) if row["slip"] else None) == one.get("slip")


def test_texts_have_torques_and_slip() -> None:
    """A clutch between 1 and 2: torque u/(u - 1) = 2.5/3.5, slip 1.4 while 3 stands."""
    for form in ("text", "markdown", "latex"):
        shown = said(DIFFERENTIAL, "-f", form).out
        row = next(line for line in shown.splitlines() if "direct" in line)
        assert all(word in shown for word in ("torques", "slip"))
        assert re.search(r"\.714\D+1\.400", row)
    shown = said(BELAZ).out
    assert "T1, T4   gear     -7.642     ·   -0.493, 9.134     -\n" in shown
    assert "parking             6\n" in shown


def test_sorted_by_torque() -> None:
    """Direct drives first; torque times slip is 1, so these are by falling slip."""
    found = documents(*UMDM, "--sort", "torques")
    assert [one["kind"] for one in found] == ["direct"] * 15 + ["gear"] * 4
    slips = [abs(one["slip"]) for one in found[:15]]
    assert slips == sorted(slips, reverse=True)
    torques = [abs(*one["torques"].values()) for one in found[15:]]
    assert torques == sorted(torques)
    assert sorted(map(str, found)) == sorted(map(str, documents(*UMDM)))
    kinds = [one["kind"] for one in documents(BELAZ, "--sort", "torques")]  # without one: last
    assert kinds == ["direct", *["gear"] * 7, *["parking"] * 6, "blocked"]
    named = [row["engaged"] for row in table(*UMDM, "--sort", "torques")]
    assert named == [one["engaged"][0] for one in found]


def test_options_are_repeated_or_hold_commas(tmp_path: Path) -> None:
    several = documents(BELAZ, "--engaged", "1", "--engaged", "3,1")
    assert [len(one["engaged"]) for one in several] == [1] * 6 + [3] * 20
    some = documents(BELAZ, "--shift-elements", "T1,T3", "--shift-elements", "F1")
    assert [one["engaged"] for one in some] == [["F1", "T1"], ["F1", "T3"], ["T1", "T3"]]
    text = BELAZ.read_text("utf-8").replace("F1: [", "'a,\\\"b': [").replace("F1", "'a,\\\"b'")
    (tmp_path / "box.yaml").write_text(text, "utf-8")
    for names in (('a,\\"b', "--shift-elements", "F2"), ('F2,"a,\\""b"',)):
        [found] = documents(tmp_path / "box.yaml", "--shift-elements", *names)
        assert found["engaged"] == ['a,\\"b', "F2"]


@pytest.mark.parametrize("suffix", [".yaml", ".json", ".dat"])
def test_gears_as_a_case(tmp_path: Path, suffix: str) -> None:
    """With the gears of BelAZ as the shipped case has them, under their names."""
    file = tmp_path / f"gears{suffix}"
    done = said(BELAZ, "--write", file)
    assert done.status == (1 if suffix == ".dat" else 0)  # a deck keeps no description
    case, own = load(file), load(BELAZ)
    pairs = zip(own.gears, solve(own).ratio.tolist(), strict=True)
    expected = {gear.name: ratio for gear, ratio in pairs}
    assert [gear.name for gear in case.gears] == ["1", "2", "3", "4", "5", "6", "R1", "R2"]
    assert solve(case).ratio == pytest.approx([expected[gear.name] for gear in case.gears])


def test_all_elements_as_a_case(tmp_path: Path) -> None:
    """Each gear of the file has the ratio that its combination was said to have."""
    asked = CASES / "simpson.yaml", "--shift-elements", "auto", "--write", tmp_path / "all.yaml"
    ratios = sorted(one["ratio"] for one in documents(*asked) if one["ratio"] is not None)
    assert sorted(solve(load(tmp_path / "all.yaml")).ratio.tolist()) == pytest.approx(ratios)


def test_freewheels_hold_or_the_gear_is_left_out(tmp_path: Path) -> None:
    """By L the ring can't turn backward, which the sun makes it do; M would overrun then.

    As a freewheel from 3 to 2 L would keep the carrier from lagging behind the ring.
    """
    box, gears = tmp_path / "box.yaml", tmp_path / "gears.yaml"
    box.write_text(FREEWHEELS, "utf-8")
    kinds = [(one["engaged"], one["kind"]) for one in documents(box, "--write", gears)]
    assert kinds == [(["L"], "gear"), (["M"], "direct"), (["C"], "direct")]
    assert [list(gear.engaged) for gear in load(gears).gears] == [[], [3]]
    assert solve(load(gears)).ratio == pytest.approx([3.5, 1])
    lines = [line for line in FREEWHEELS.splitlines() if " M:" not in line]
    box.write_text("\n".join(lines).replace("[2, housing]", "[3, 2]"), "utf-8")
    done = said(box, "--write", gears)
    assert "left out, as freewheels do not hold: low" in done.err
    assert [gear.name for gear in load(gears).gears] == ["C"]


def test_gears_that_leave_links_free_are_left_out_and_named(tmp_path: Path) -> None:
    """With all gears free they are taken; a second set is held by D alone."""
    box, gears = tmp_path / "box.yaml", tmp_path / "gears.yaml"
    box.write_text(FREE, "utf-8")
    assert "left out" not in said(box, "--engaged", "1", "--write", gears).err
    assert [gear.name for gear in load(gears).gears] == ["A", "B"]
    done = said(box, "--engaged", "1,2", "--write", gears)
    assert "left out: 2 gears with other links undetermined" in done.err
    assert [gear.name for gear in load(gears).gears] == ["A+D", "B+D"]


def test_a_dry_run_says_how_many_how_large_how_long(tmp_path: Path) -> None:
    """C(208, 2) combinations."""
    shown = said(*DRIVELINE, "--dry-run", "--engaged", "2").out
    assert "combinations  21528\n" in shown
    rows = [line.split()[0] for line in shown.splitlines()]
    assert rows == ["elements", "engaged", "combinations", "size", "time"]
    assert said(BELAZ, "--dry-run").out.startswith("elements      6: F1, F2, T1, T2, T3, T4\n")
    file = tmp_path / "estimate.json"
    assert said(*DRIVELINE, "--engaged", "2", "--dry-run", "-o", file).out == ""
    known = json_file(file)
    assert [*validator("combinations").iter_errors(known)] == []
    assert list(known) == ["elements", "engaged", "count", "bytes", "seconds"]
    assert (len(known["elements"]), known["engaged"], known["count"]) == (208, [2], 21528)
    assert said(BELAZ, "--dry-run", "-f", "jsonl").out.count("\n") == 1


def test_wrong_use() -> None:
    for options, message in (
        (("--engaged", "7"), "read 7 engaged shift elements, expected 0 to 6"),
        (("--engaged", "two"), "read `two`, expected a whole number of shift elements"),
        (("--engaged", "-1"), "read `-1`"),
        (("--shift-elements", "T11"), "no shift element `T11`"),
        (("--shift-elements", "auto,F1"), "expected `auto` alone"),
        (("--shift-elements", "Auto"), "did you mean `auto`"),
        (("--write", "gears.txt"), "cannot determine the format of gears.txt"),
        (("--write", str(BELAZ)), "would be overwritten"),
        (("--write", "a.json", "-o", "a.json"), "expected another file"),
        (("--ports", "J1:J9"), "Invalid value for --ports: no link 'J9'"),
        (("--ports", "1"), "read `1`, expected `all` alone, or two links as IN:OUT"),
        (("--ports", "2:2"), "read `2:2`, expected two different links"),
        (("--ports", "all,1:2"), "read `all`, expected `all` alone"),
        (("--ports", "all", "--dry-run"), "--ports cannot be combined"),
        (("--ports", "all", "--write", "gears.yaml"), "--ports cannot be combined"),
    ):
        assert said(BELAZ, *options).is_wrong_use(message)


def test_what_cannot_be_done_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    done = said(*DRIVELINE)
    assert done.fails("208 shift elements have 75760620 combinations", "see --dry-run")
    done = said(BELAZ, "--shift-elements", "auto", "--engaged", "13", "--at-most", "100000000")
    assert done.is_wrong_use("text is for 200000 rows at most, not for 10400600")
    done = said(CASES / "power-split.yaml")
    assert done.fails("2 engaged shift elements leave one degree", "see --shift-elements")
    done = said(BELAZ, "--engaged", "0", "--write", tmp_path / "none.yaml")
    assert done.fails("no combination of shift elements gives a gear")
    monkeypatch.setattr(estimates, "free_room", lambda _: 1000)
    done = said(BELAZ, "-f", "jsonl", "-o", tmp_path / "found.jsonl")
    assert done.fails("but only 1 kB are free there: expected --engaged or --shift-elements")
    assert not list(tmp_path.iterdir())
