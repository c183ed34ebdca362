"""The suffix of -o tells the format, in every command; what it does not tell is refused."""

import csv
import json
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from tests.commands import CASES, MZKT, json_answer, json_file, vstatics
from tests.processes import names
from vstatics import load, solve

pytestmark = pytest.mark.usefixtures("folder")
ZF = CASES / "zf-8hp70.yaml"
COMMANDS = ("run", "flow", "summary", "explain")
EACH = pytest.mark.parametrize("command", COMMANDS)
FORMATS = {
    "json": ("json", "{\n"),
    "jsonl": ("jsonl", '{"'),
    "csv": ("csv", "table,"),
    "md": ("markdown", "# "),
    "tex": ("latex", "\\"),
    "JSON": ("json", "{\n"),
}
"""Suffix, its format, and how a file begins."""


def sheets(path: str) -> dict[str, list[tuple[Any, ...]]]:
    book = openpyxl.load_workbook(path)
    return {sheet.title: list(sheet.iter_rows(values_only=True)) for sheet in book}


@EACH
def test_the_suffix_tells_the_format(command: str) -> None:
    for suffix, (form, begin) in FORMATS.items():
        assert vstatics(command, ZF, "-o", f"new.{suffix}").all == ""
        expected = vstatics(command, ZF, "-f", form).out
        assert Path(f"new.{suffix}").read_text("utf-8") == expected
        assert expected.startswith(begin)
        assert vstatics(command, ZF, "-f", suffix.lower()).out == expected
    text = vstatics(command, ZF).out
    for name in ("new", "new.lst", "NEW.TXT"):
        assert vstatics(command, ZF, "-o", name).all == ""
        assert Path(name).read_text("utf-8") == text
    assert vstatics(command, ZF, "-f", "json", "-o", "json").status == 0
    assert Path("json").read_bytes() == Path("new.json").read_bytes()


@EACH
def test_another_suffix_is_refused_before_anything_is_read(
    command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = vstatics(command, "nowhere.yaml", "-o", "new.xls")
    assert said.is_wrong_use("new.xls: no format has this suffix here: expected")
    assert ".json .jsonl .ndjson .csv .md .tex .xlsx" in said.err
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    said = vstatics(command, "nowhere.yaml", "-o", "new.xlsx")
    extra = 'pip install ".[xlsx]" in the source folder, or pip install openpyxl'
    assert (said.status, said.all) == (1, f"XLSX needs the package openpyxl: {extra}\n")
    assert names() == []


REFUSED = {
    f"report {MZKT} -o new.txt": "new.txt: no format has this suffix here: expected .html .htm",
    f"report {MZKT} {ZF} {MZKT} -o new.html": "a page shows one case or two: for more",
    f"plot {MZKT} {ZF} {MZKT} --kind plan -o new.pdf": "give a directory (new/)",
    f"plot {MZKT} --kind plan -o new.gif": "expected .svg .png .pdf",
    f"sweep {MZKT} --vary D1.ratio=-2 -o new.txt": "cannot determine the format of new.txt",
    f"sweep {MZKT} --vary D1.ratio=-2 -o new.png": "or --format; `vstatics plot` draws pictures",
    f"convert {MZKT} new.txt": "cannot determine the format of new.txt",
    f"run {MZKT} -f json -o new.csv": "-f json is not the format of new.csv",
    f"flow {MZKT} -f json -o new.txt": "expected .json",
    f"summary {MZKT} -f text -o new.md": "expected .txt or .lst or .out",
    f"run {MZKT} -f json --digits 4": "to json, which has all digits",
    f"flow {MZKT} -o new.csv --digits 4": "to csv, which has all digits",
    f"run {MZKT} --raw": "--raw applies to CSV only",
    f"run {MZKT} --digits 0": "1<=x<=15",
}


@pytest.mark.parametrize("line", REFUSED, ids=lambda line: line.replace(str(CASES), ""))
def test_what_does_not_go_together_is_refused(line: str) -> None:
    assert vstatics(*line.split()).is_wrong_use(REFUSED[line])
    assert names() == []


@pytest.mark.slow
@EACH
def test_several_cases_are_one_file_or_a_file_each(command: str) -> None:
    Path("bad.yaml").write_text("links: 3\n", "utf-8")
    for suffix in ("json", "jsonl"):
        assert vstatics(command, ZF, "bad.yaml", MZKT, "-o", f"all.{suffix}").status == 1
    documents = json_file(Path("all.json"))
    lines = Path("all.jsonl").read_text("utf-8").splitlines()
    assert documents == [*map(json.loads, lines)]
    assert [document["file"] for document in documents] == [ZF.name, "bad.yaml", MZKT.name]
    assert set(documents[1]) == {"file", "case", "errors"}
    assert documents[2] == json_answer(command, MZKT)
    assert vstatics(command, ZF, MZKT, "-f", "json", "-o", "new/").status == 0
    assert json_file(Path("new", "mzkt7922.json")) == documents[2]
    if command in ("flow", "explain"):
        apart = [f"==> {case} <==\n{vstatics(command, case).out}" for case in (ZF, MZKT)]
        assert vstatics(command, ZF, MZKT).out == "\n".join(apart)


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
    sizes = []
    for name, gears in (("all", []), ("two", ["--gear", "2", "--gear", "R"])):
        assert vstatics("plot", ZF, "-k", "lever", *gears, "-o", f"{name}.svg").status == 0
        sizes.append(sum(len(file.read_bytes()) for file in Path().glob(f"{name}*.svg")))
    assert sizes[0] > 2 * sizes[1]
    said = vstatics("plot", ZF, "-k", "stick", "--gear", "1", "--gear", "2", "-o", "x.svg")
    assert said.fails("this picture shows one gear at a time")


def test_gears_may_be_several_and_each_is_listed_once() -> None:
    for command in ("flow", "explain"):
        said = vstatics(command, MZKT, "--gear", "6", "--gear", "2", "--gear", "6", "-f", "json")
        assert [one["gear"] for one in said.json["gears"]] == ["6", "2"]
    said = vstatics("flow", MZKT, ZF, "--gear", "8", "-f", "json")
    lacking, flow = said.json
    assert said.status == 1
    assert lacking["errors"] == [f"{MZKT}: error: no gear '8'; gears are 1, 2, 3, 4, 5, 6 [E090]"]
    assert [gear["gear"] for gear in flow["gears"]] == ["8"]
    assert vstatics("flow", MZKT, "--gear", "8").status == 2


def test_cases_are_summed_up_side_by_side() -> None:
    """Ratios of the first gears as the files under cases/ cite them; a bad case is left out."""
    Path("bad.yaml").write_text("links: 3\n", "utf-8")
    said = vstatics("summary", ZF, "bad.yaml", MZKT, CASES / "zf-6hp26.yaml", "-f", "csv")
    heading, first, *_ = csv.reader(said.out.splitlines())
    assert said.status == 1
    assert heading[:5] == ["table", "gear", "ratio A", "ratio B", "ratio C"]
    assert list(map(float, first[2:5])) == pytest.approx([4.696, 6.23, 4.171], abs=1e-3)


def test_a_workbook_of_a_case_has_a_sheet_for_each_table() -> None:
    """Numbers are those of the library, as numbers, shown with the digits asked for.

    The file is the same every time.
    """
    for name in ("new.xlsx", "again.xlsx"):
        vstatics("run", ZF, "-o", name, "--digits", "2")
    assert Path("new.xlsx").read_bytes() == Path("again.xlsx").read_bytes()
    found, results = sheets("new.xlsx"), solve(load(ZF))
    heading, *rows = found["speeds"]
    assert heading == ("link", *(gear.name for gear in results.case.gears))
    for row, expected in zip(rows, results.speeds.T.tolist(), strict=True):
        assert row[1:] == pytest.approx(expected, rel=1e-15)
    assert ("speeds", "Speeds of the links [speeds]") in found["tables"]
    assert found["idle"][1][1] in (True, False)
    assert openpyxl.load_workbook("new.xlsx")["gears"]["C2"].number_format == "0.00"


@pytest.mark.slow
def test_a_workbook_of_several_cases_has_the_file_of_each() -> None:
    vstatics("run", ZF, ZF, MZKT, "-o", "new.xlsx")
    rows = sheets("new.xlsx")["gears"]
    assert rows[0][:2] == ("case", "gear")
    cases = [row[0] for row in rows]
    assert [cases.count(name) for name in ("case", str(ZF), str(MZKT))] == [1, 2 * 9, 6]
