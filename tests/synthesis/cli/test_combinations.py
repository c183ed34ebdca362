"""`vstatics synth combinations`: what it writes, what it refuses, what it makes of a case."""

from __future__ import annotations

import csv
import json
import re
from itertools import permutations
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from tests.commands import CASES, Said, vstatics
from tests.core.cli.test_schemas import validator
from vstatics import load, solve
from vstatics.core.cli.shared import estimates

BELAZ = CASES / "belaz7516.yaml"
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


def entries(*arguments: object) -> list[dict[str, Any]]:
    document = said(*arguments, "-f", "json").json
    assert [*validator("combinations").iter_errors(document)] == []
    assert list(document) == ["combinations"]
    found: list[dict[str, Any]] = document["combinations"]
    return found


def test_json_has_the_shape_that_is_promised() -> None:
    """BelAZ-7516, ratios by Willis with p = 67/33, 67/33, 3, 2.04: Evseenko's gearbox."""
    found = entries(BELAZ)
    assert len(found) == 15
    gears = [one for one in found if one["ratio"] is not None]
    keys = ["engaged", "kind", "ratio", "free"]
    assert [list(one) for one in gears] == [[*keys, "torques"]] * 8
    assert [list(one) for one in found if one not in gears] == [keys] * 7
    assert {key: found[0][key] for key in keys} == {
        "engaged": ["F1", "F2"],
        "kind": "direct",
        "ratio": 1.0,
        "free": False,
    }
    ratios = [one["ratio"] for one in found[3:6]]
    assert ratios == pytest.approx([1 + 3, 1 - 3 * 2.04, 1 + 33 / 67], rel=1e-12)
    assert found[1] == {"engaged": ["F1", "T1"], "kind": "blocked", "ratio": None, "free": False}
    lines = said(BELAZ, "-f", "jsonl").out.splitlines()
    assert list(map(json.loads, lines)) == found
    assert [*validator("combinations").iter_errors(found[0])] == []


def test_ports_have_a_block_each() -> None:
    """A differential, Willis with u = -2.5: (1 - u) and its inverse with the ring held."""
    document = said(DIFFERENTIAL, "--ports", "1:3, 3:1", "-f", "json").json
    assert [*validator("combinations").iter_errors(document)] == []
    blocks = document["ports"]
    assert [(one["input"], one["output"]) for one in blocks] == [("1", "3"), ("3", "1")]
    ratios = [[each["ratio"] for each in one["combinations"]] for one in blocks]
    assert ratios == [pytest.approx([1, 3.5]), pytest.approx([1, 1 / 3.5])]
    lines = said(DIFFERENTIAL, "--ports", "1:3", "--ports", "3:1", "-f", "jsonl").out
    assert [json.loads(line) for line in lines.splitlines()] == blocks
    assert [*validator("combinations").iter_errors(blocks[0])] == []
    shown = said(DIFFERENTIAL, "--ports", "3:1").out
    assert "Combinations, 3 to 1\n" in shown


def test_all_ports_are_all_ordered_pairs_and_have_no_brakes_of_auto() -> None:
    found = said(DIFFERENTIAL, "--ports", "all", "--shift-elements", "auto", "-f", "json").json
    pairs = [(one["input"], one["output"]) for one in found["ports"]]
    assert pairs == [*permutations("123", 2)]
    for one in found["ports"]:
        [brake] = {"1", "2", "3"} - {one["input"], one["output"]}
        engaged = [each["engaged"][0] for each in one["combinations"]]
        assert len(engaged) == 4
        own = "T" if brake == "2" else f"T-{brake}"
        assert [name for name in engaged if name.startswith("T")] == [own]


def test_tables_have_torques_and_slip_as_json_has() -> None:
    """Of one element a number, of several their list in the order of the names."""
    for case, count in ((CASES / "umdm.yaml", 19), (BELAZ, 15)):
        options = ("--shift-elements", "auto") if count == 19 else ()
        found = entries(case, *options)
        text = said(case, *options, "-f", "csv", "--raw").out
        rows = [row for row in csv.DictReader(text.splitlines()) if row["table"] == "combinations"]
        assert len(rows) == len(found) == count
        for row, one in zip(rows, found, strict=True):
            torques = [float(number) for number in row["torques"].split(",") if number]
            assert torques == list(one.get("torques", {}).values())
            assert (float(row["slip"]) if row["slip"] else None) == one.get("slip")


@pytest.mark.parametrize("form", ["text", "markdown", "latex"])
def test_texts_have_torques_and_slip(form: str) -> None:
    """A clutch between 1 and 2: torque u/(u - 1) = 2.5/3.5, slip 1.4 while 3 stands."""
    shown = said(DIFFERENTIAL, "-f", form).out
    row = next(line for line in shown.splitlines() if "direct" in line)
    assert all(word in shown for word in ("torques", "slip"))
    assert re.search(r"\.714\D+1\.400", row)


def test_a_workbook_has_torques_and_slip(tmp_path: Path) -> None:
    assert said(DIFFERENTIAL, "-o", tmp_path / "a.xlsx").status == 0
    sheets = openpyxl.load_workbook(tmp_path / "a.xlsx").worksheets
    rows = [row for sheet in sheets for row in sheet.iter_rows(values_only=True)]
    assert next(row for row in rows if row[1:2] == ("direct",))[-2:] == pytest.approx(
        (2.5 / 3.5, 1.4)
    )


@pytest.mark.parametrize("form", ["json", "jsonl"])
def test_sorted_by_torque(form: str) -> None:
    """Direct drives first; torque times slip is 1, so these are by falling slip."""
    text = said(
        CASES / "umdm.yaml", "--shift-elements", "auto", "--sort", "torques", "-f", form
    ).out
    lines = map(json.loads, text.splitlines()) if form == "jsonl" else json.loads(text).values()
    found = [*lines] if form == "jsonl" else next(iter(lines))
    assert [one["kind"] for one in found] == ["direct"] * 15 + ["gear"] * 4
    slips = [abs(one["slip"]) for one in found[:15]]
    assert slips == sorted(slips, reverse=True)
    torques = [abs(*one["torques"].values()) for one in found[15:]]
    assert torques == sorted(torques)
    assert sorted(map(str, found)) == sorted(
        map(str, entries(CASES / "umdm.yaml", "--shift-elements", "auto"))
    )
    table = said(
        CASES / "umdm.yaml", "--shift-elements", "auto", "--sort", "torques", "-f", "csv"
    ).out
    named = [row["engaged"] for row in csv.DictReader(table.splitlines())][:19]
    assert named == [*(one["engaged"][0] for one in found)]


def test_sets_without_a_torque_come_last_when_sorted() -> None:
    found = entries(BELAZ, "--sort", "torques")
    kinds = [one["kind"] for one in found]
    assert kinds == ["direct", *["gear"] * 7, *["parking"] * 6, "blocked"]
    block = said(BELAZ, "--ports", "all", "--sort", "torques", "-f", "json").json["ports"][0]
    order = ["direct", "gear", "neutral", "parking", "blocked"]
    kinds = [one["kind"] for one in block["combinations"]]
    assert kinds == sorted(kinds, key=order.index)


@pytest.mark.parametrize(
    ("ports", "why"),
    [
        ("1:4", "no link '4'"),
        ("1", "read `1`, expected `all` alone, or two links as IN:OUT"),
        ("2:2", "read `2:2`, expected two different links"),
        ("all,1:2", "read `all`, expected `all` alone"),
    ],
)
def test_ports_that_are_none(ports: str, why: str) -> None:
    refused = said(DIFFERENTIAL, "--ports", ports)
    assert refused.is_wrong_use(f"Invalid value for --ports: {why}")


def test_ports_are_of_no_one_case(tmp_path: Path) -> None:
    for more in (("--dry-run",), ("--write", tmp_path / "gears.yaml")):
        refused = said(DIFFERENTIAL, "--ports", "all", *more)
        assert refused.is_wrong_use("--ports: without")


def test_options_are_repeated_or_hold_commas() -> None:
    several = entries(BELAZ, "--engaged", "1", "--engaged", "3,1")
    assert [len(one["engaged"]) for one in several] == [1] * 6 + [3] * 20
    some = entries(BELAZ, "--shift-elements", "T1,T3", "--shift-elements", "F1")
    assert [one["engaged"] for one in some] == [["F1", "T1"], ["F1", "T3"], ["T1", "T3"]]


def test_names_with_commas_and_strange_letters(tmp_path: Path) -> None:
    text = BELAZ.read_text("utf-8").replace("F1: [", "'a,\\\"b': [").replace("F1", "'a,\\\"b'")
    (tmp_path / "box.yaml").write_text(text, encoding="utf-8")
    found = entries(tmp_path / "box.yaml", "--shift-elements", 'a,\\"b', "--shift-elements", "F2")
    assert [one["engaged"] for one in found] == [['a,\\"b', "F2"]]
    found = entries(tmp_path / "box.yaml", "--shift-elements", 'F2,"a,\\""b"')
    assert [one["engaged"] for one in found] == [['a,\\"b', "F2"]]


def test_a_table_for_people(tmp_path: Path) -> None:
    shown = said(BELAZ)
    assert "T1, T4   gear     -7.642     ·   -0.493, 9.134     -\n" in shown.out
    assert "parking             6\n" in shown.out
    said(BELAZ, "-o", tmp_path / "out.csv", "--shift-elements", "auto")
    assert (tmp_path / "out.csv").read_text("utf-8").count("\n") > 325


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
    file = tmp_path / "all.yaml"
    found = entries(CASES / "simpson.yaml", "--shift-elements", "auto", "--write", file)
    ratios = sorted(one["ratio"] for one in found if one["ratio"] is not None)
    assert sorted(solve(load(file)).ratio.tolist()) == pytest.approx(ratios)


def test_freewheels_hold_or_the_gear_is_left_out(tmp_path: Path) -> None:
    """By L the ring can't turn backward, which the sun makes it do; M would overrun then."""
    box, gears = tmp_path / "box.yaml", tmp_path / "gears.yaml"
    box.write_text(FREEWHEELS, encoding="utf-8")
    found = entries(box, "--write", gears)
    kinds = [(one["engaged"], one["kind"]) for one in found]
    assert kinds == [(["L"], "gear"), (["M"], "direct"), (["C"], "direct")]
    case = load(gears)
    assert [list(gear.engaged) for gear in case.gears] == [[], [3]]
    assert solve(case).ratio == pytest.approx([3.5, 1])


def test_a_freewheel_that_overruns_gives_no_gear(tmp_path: Path) -> None:
    """By L the carrier would be kept from lagging behind the ring, which turns backward."""
    box, gears = tmp_path / "box.yaml", tmp_path / "gears.yaml"
    lines = [line for line in FREEWHEELS.splitlines() if " M:" not in line]
    box.write_text("\n".join(lines).replace("[2, housing]", "[3, 2]"), encoding="utf-8")
    done = said(box, "--write", gears)
    assert "left out, as freewheels do not hold: low" in done.err
    assert [gear.name for gear in load(gears).gears] == ["C"]


def test_gears_that_leave_links_free_are_left_out_and_told(tmp_path: Path) -> None:
    """With all gears free they are taken; a second set is held by D alone."""
    file = tmp_path / "gears.yaml"
    (tmp_path / "two.yaml").write_text(FREE, encoding="utf-8")
    done = said(tmp_path / "two.yaml", "--engaged", "1", "--write", file)
    assert "left out" not in done.err
    assert [gear.name for gear in load(file).gears] == ["A", "B"]
    done = said(tmp_path / "two.yaml", "--engaged", "1,2", "--write", file)
    assert "left out: 2 gears with other links undetermined" in done.err
    assert [gear.name for gear in load(file).gears] == ["A+D", "B+D"]


def test_how_many_how_large_how_long() -> None:
    shown = said(
        CASES / "driveline-8hp70.yaml", "--shift-elements", "auto", "--dry-run", "--engaged", "2"
    )
    assert "combinations  21528\n" in shown.out  # C(208, 2)
    assert [line.split()[0] for line in shown.out.splitlines()] == [
        "elements", "engaged", "combinations", "size", "time",
    ]  # fmt: skip
    assert said(BELAZ, "--dry-run").out.splitlines()[0] == "elements      6: F1, F2, T1, T2, T3, T4"


def test_an_estimate_as_json(tmp_path: Path) -> None:
    """C(208, 2) combinations, as text tells."""
    file = tmp_path / "estimate.json"
    asked = (
        CASES / "driveline-8hp70.yaml",
        "--shift-elements",
        "auto",
        "--engaged",
        "2",
        "--dry-run",
    )
    assert said(*asked, "-o", file).out == ""
    known = json.loads(file.read_text("utf-8"))
    assert [*validator("combinations").iter_errors(known)] == []
    assert list(known) == ["elements", "engaged", "count", "bytes", "seconds"]
    assert (len(known["elements"]), known["engaged"], known["count"]) == (208, [2], 21528)
    assert said(BELAZ, "--dry-run", "-f", "jsonl").out.count("\n") == 1


WRONG = {
    ("--engaged", "7"): "read 7 engaged shift elements, expected 0 to 6",
    ("--engaged", "two"): "read `two`, expected a whole number of shift elements",
    ("--engaged", ""): "read ``, expected a whole number",
    ("--engaged", "-1"): "read `-1`",
    ("--shift-elements", "T11"): "no shift element `T11`",
    ("--shift-elements", "auto,F1"): "expected `auto` alone",
    ("--shift-elements", "Auto"): "did you mean `auto`",
    ("--write", "gears.txt"): "cannot determine the format of gears.txt",
    ("--write", str(BELAZ)): "would be overwritten",
    ("--write", "a.json", "-o", "a.json"): "expected another file",
}


@pytest.mark.parametrize("options", WRONG)
def test_wrong_use(options: tuple[str, ...]) -> None:
    done = said(BELAZ, *options)
    assert done.is_wrong_use(WRONG[options])


def test_too_many_are_told_with_what_helps() -> None:
    done = said(CASES / "driveline-8hp70.yaml", "--shift-elements", "auto")
    assert done.fails("208 shift elements have 75760620 combinations", "see --dry-run")
    done = said(BELAZ, "--shift-elements", "auto", "--engaged", "13", "--at-most", "100000000")
    assert done.is_wrong_use("text is for 200000 rows at most, not for 10400600")


def test_what_has_no_room_is_refused_before_it_begins(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(estimates, "free_room", lambda _: 1000)
    done = said(BELAZ, "-f", "jsonl", "-o", tmp_path / "found.jsonl")
    assert done.fails("but 1 kB are free there: expected --engaged or --shift-elements")
    assert not list(tmp_path.iterdir())


def test_nothing_to_choose_from() -> None:
    done = said(CASES / "power-split.yaml")
    assert done.fails(
        "2 engaged shift elements leave one degree of freedom", "see --shift-elements"
    )


def test_no_gear_to_write(tmp_path: Path) -> None:
    done = said(BELAZ, "--engaged", "0", "--write", tmp_path / "none.yaml")
    assert done.fails("no combination of shift elements gives a gear")
    assert not list(tmp_path.iterdir())
