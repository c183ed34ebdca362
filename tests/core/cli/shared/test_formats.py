"""The suffix of -o tells the format, in every command; what it does not tell is refused."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from tests.commands import CASES, MZKT, json_answer, vstatics
from tests.processes import names
from vstatics import load, solve

pytestmark = pytest.mark.usefixtures("folder")

ZF = CASES / "zf-8hp70.yaml"
COMMANDS = ("run", "flow", "summary", "explain")


def sheets(path: str) -> dict[str, list[tuple[Any, ...]]]:
    """The cells of each sheet."""
    book = openpyxl.load_workbook(path)
    return {sheet.title: list(sheet.iter_rows(values_only=True)) for sheet in book}


FORMATS = {
    "json": "json",
    "jsonl": "jsonl",
    "csv": "csv",
    "md": "markdown",
    "tex": "latex",
    "JSON": "json",
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("suffix", FORMATS)
def test_the_suffix_tells_the_format(command: str, suffix: str) -> None:
    assert vstatics(command, ZF, "-o", f"new.{suffix}").all == ""
    expected = vstatics(command, ZF, "-f", FORMATS[suffix]).out
    assert Path(f"new.{suffix}").read_text(encoding="utf-8") == expected
    begins = {"json": "{\n", "jsonl": '{"', "csv": "table,", "md": "# ", "tex": "\\"}
    assert expected.startswith(begins[suffix.lower()])


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["new", "new.txt", "new.lst", "new.out", "NEW.TXT"])
def test_no_suffix_and_those_of_texts_mean_text(command: str, name: str) -> None:
    assert vstatics(command, ZF, "-o", name).all == ""
    assert Path(name).read_text(encoding="utf-8") == vstatics(command, ZF).out


@pytest.mark.parametrize("command", COMMANDS)
def test_another_suffix_is_refused_before_anything_is_read(command: str) -> None:
    said = vstatics(command, "nowhere.yaml", "-o", "new.xls")
    assert (said.status, said.out, names()) == (2, "", [])
    assert "new.xls: no format has this suffix here: expected" in said.err
    assert ".json .jsonl .ndjson .csv .md .tex .xlsx" in said.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ("report", MZKT, "-o", "new.txt"),
            "new.txt: no format has this suffix here: expected .html",
        ),
        (("report", MZKT, ZF, MZKT, "-o", "new.html"), "a page is of one case or two: expected a"),
        (("plot", MZKT, ZF, MZKT, "--kind", "plan", "-o", "new.pdf"), "for several (new/)"),
        (("plot", MZKT, "--kind", "plan", "-o", "new.gif"), "expected .svg .png .pdf"),
        (
            ("sweep", MZKT, "--vary", "D1.ratio=-2", "-o", "new.txt"),
            "cannot determine the format of new.txt",
        ),
        (("convert", MZKT, "new.txt"), "cannot determine the format of new.txt"),
        (("run", MZKT, "-f", "json", "-o", "new.csv"), "-f json is not the format of new.csv"),
        (("flow", MZKT, "-f", "json", "-o", "new.txt"), "expected .json"),
        (("summary", MZKT, "-f", "text", "-o", "new.md"), "expected .txt or .lst or .out"),
        (("run", MZKT, "-f", "json", "--digits", "4"), "to json, which has all digits"),
        (("flow", MZKT, "-o", "new.csv", "--digits", "4"), "to csv, which has all digits"),
        (("run", MZKT, "--raw"), "--raw is for CSV"),
        (("run", MZKT, "--digits", "0"), "1<=x<=15"),
    ],
    ids=lambda given: " ".join(map(str, given[::3])) if isinstance(given, tuple) else "",
)
def test_what_does_not_go_together_is_refused(arguments: tuple[Any, ...], words: str) -> None:
    said = vstatics(*arguments)
    assert (said.status, said.out, names()) == (2, "", [])
    assert words in said.err


def test_a_format_goes_beside_no_suffix_and_its_own() -> None:
    for name in ("new", "new.json"):
        assert vstatics("flow", ZF, "-f", "json", "-o", name).status == 0
        assert json.loads(Path(name).read_text(encoding="utf-8"))["format"] == "vstatics-flow"


@pytest.mark.parametrize("command", COMMANDS)
def test_without_openpyxl_a_workbook_is_refused_at_once(
    command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    said = vstatics(command, "nowhere.yaml", "-o", "new.xlsx")
    message = 'XLSX needs the package openpyxl: pip install ".[xlsx]" in the source folder, or pip install openpyxl\n'
    assert (said.status, said.all, names()) == (1, message, [])


# several cases


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("suffix", ["json", "jsonl"])
def test_several_cases_to_a_name_with_suffix_are_one_file(command: str, suffix: str) -> None:
    Path("bad.yaml").write_text("links: 3\n", encoding="utf-8")
    said = vstatics(command, ZF, "bad.yaml", MZKT, "-o", f"all.{suffix}")
    assert said.status == 1
    text = Path(f"all.{suffix}").read_text(encoding="utf-8")
    documents = json.loads(text) if suffix == "json" else list(map(json.loads, text.splitlines()))
    assert [one["file"] for one in documents] == ["zf-8hp70.yaml", "bad.yaml", "mzkt7922.dat"]
    assert set(documents[1]) == {"file", "case", "errors"}
    alone = json_answer(command, MZKT)
    assert documents[2] == alone


@pytest.mark.slow
@pytest.mark.parametrize("command", ["flow", "explain"])
def test_texts_of_several_cases_stand_below_their_names(command: str) -> None:
    said = vstatics(command, ZF, MZKT)
    apart = [f"==> {case} <==\n{vstatics(command, case).out}" for case in (ZF, MZKT)]
    assert (said.status, said.out) == (0, "\n".join(apart))


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_several_cases_to_a_directory_are_a_file_each(command: str) -> None:
    assert vstatics(command, ZF, MZKT, "-f", "json", "-o", "new/").status == 0
    for case in (ZF, MZKT):
        written = Path("new", case.stem + ".json").read_text(encoding="utf-8")
        assert written == vstatics(command, case, "-f", "json").out


@pytest.mark.slow
def test_several_cases_give_a_picture_and_a_page_each() -> None:
    cases = [CASES / name for name in ("differential.yaml", "wolfrom.yaml")]
    assert vstatics("plot", *cases, "--kind", "structure", "-o", "new/").status == 0
    assert vstatics("report", *cases, "-o", "new").status == 0
    made = sorted(path.name for path in Path("new").glob("[!.]*"))
    assert made == ["differential.html", "differential.svg", "wolfrom.html", "wolfrom.svg"]
    vstatics("plot", cases[1], "--kind", "structure", "-o", "alone.svg")
    assert Path("alone.svg").read_bytes() == Path("new", "wolfrom.svg").read_bytes()


@pytest.mark.slow
def test_a_picture_shows_the_gears_that_are_asked_for() -> None:
    for name, gears in (("all", []), ("two", ["--gear", "2", "--gear", "R"])):
        said = vstatics("plot", ZF, "--kind", "lever", *gears, "-o", f"{name}.svg")
        assert said.status == 0
    sizes = [
        sum(len(one.read_bytes()) for one in Path().glob(f"{name}*.svg")) for name in ("all", "two")
    ]
    assert sizes[0] > 2 * sizes[1]
    said = vstatics("plot", ZF, "-k", "stick", "--gear", "1", "--gear", "2", "-o", "x.svg")
    assert said.fails("this picture shows one gear at a time")


def test_a_case_without_the_gear_that_is_asked_for_fails_alone() -> None:
    said = vstatics("flow", MZKT, ZF, "--gear", "8", "-f", "json")
    lacking, flow = said.json
    assert said.status == 1
    assert lacking["errors"] == [f"{MZKT}: error: no gear '8'; gears are 1, 2, 3, 4, 5, 6 [E090]"]
    assert [gear["gear"] for gear in flow["gears"]] == ["8"]
    assert vstatics("flow", MZKT, "--gear", "8").status == 2


@pytest.mark.parametrize("command", ["flow", "explain"])
def test_gears_may_be_several_and_each_is_told_once(command: str) -> None:
    said = vstatics(command, MZKT, "--gear", "6", "--gear", "2", "--gear", "6", "-f", "json")
    assert [one["gear"] for one in said.json["gears"]] == ["6", "2"]


def test_cases_are_summed_up_side_by_side() -> None:
    """Ratios of the first gears as the files under cases/ cite them."""
    said = vstatics("summary", ZF, MZKT, CASES / "zf-6hp26.yaml", "-f", "csv")
    heading, first, *_ = csv.reader(said.out.splitlines())
    assert heading[:5] == ["table", "gear", "ratio A", "ratio B", "ratio C"]
    assert list(map(float, first[2:5])) == pytest.approx([4.696, 6.23, 4.171], abs=1e-3)


def test_of_cases_side_by_side_one_in_error_does_not_stop_the_others() -> None:
    Path("bad.yaml").write_text("links: 3\n", encoding="utf-8")
    said = vstatics("summary", ZF, "bad.yaml", MZKT)
    assert said.status == 1
    assert said.out == vstatics("summary", ZF, MZKT).out


# workbooks


@pytest.mark.parametrize("command", COMMANDS)
def test_a_workbook_is_the_same_every_time(command: str) -> None:
    for name in ("one.xlsx", "two.xlsx"):
        assert vstatics(command, ZF, "-o", name).all == ""
    assert Path("one.xlsx").read_bytes() == Path("two.xlsx").read_bytes()


def test_a_workbook_of_a_case_has_a_sheet_for_each_table() -> None:
    """Numbers are those of the library, as numbers."""
    vstatics("run", ZF, "-o", "new.xlsx")
    found, results = sheets("new.xlsx"), solve(load(ZF))
    speeds = found["speeds"]
    assert speeds[0] == ("link", *(gear.name for gear in results.case.gears))
    for row, expected in zip(speeds[1:], results.speeds.T.tolist(), strict=True):
        assert row[1:] == pytest.approx(expected, rel=1e-15)
    assert ("speeds", "Speeds of the links [speeds]") in found["tables"]
    assert found["idle"][1][1] in (True, False)


@pytest.mark.slow
def test_a_workbook_of_several_cases_has_the_file_of_each() -> None:
    vstatics("run", ZF, CASES / "zf-8hp70.yaml", MZKT, "-o", "new.xlsx")
    rows = sheets("new.xlsx")["gears"]
    assert rows[0][:2] == ("case", "gear")
    assert [row[0] for row in rows].count(str(MZKT)) == 6
    assert [row[0] for row in rows].count(str(ZF)) == 2 * 9
    assert [row[0] for row in rows].count("case") == 1


def test_a_workbook_shows_the_digits_asked_for_and_keeps_all() -> None:
    vstatics("run", ZF, "-o", "new.xlsx", "--digits", "2")
    cell = openpyxl.load_workbook("new.xlsx")["gears"]["C2"]
    assert cell.number_format == "0.00"
    assert len(repr(cell.value)) > 6
