"""What stands in a cell of CSV: no text that a spreadsheet would calculate."""

import csv
import io
import json
import re
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.commands import vstatics
from vstatics.core.tables.csv import guarded, unguarded

NAMES = ["=cmd|' /C calc'!A0", "+SUM(A1)", "-2+3", "@now", "=1+1"]
"""As spreadsheets take them for formulas (OWASP, CSV Injection)."""
HOSTILE = f"""\
name: "=1+1"
links: [engine, out, {json.dumps(NAMES[0])}]
output: out
shift_elements: {{{json.dumps(NAMES[1])}: [{json.dumps(NAMES[0])}, housing]}}
mechanisms:
  {json.dumps(NAMES[3])}: {{first: engine, second: {json.dumps(NAMES[0])}, third: out, ratio: -2}}
gears: {{{json.dumps(NAMES[2])}: {{engaged: [{json.dumps(NAMES[1])}]}}}}
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "box.yaml"
    path.write_text(HOSTILE, "utf-8")
    return path


def cells(text: str) -> list[str]:
    return [cell for row in csv.reader(io.StringIO(text)) for cell in row]


@given(st.text(st.characters(codec="utf-8")))
def test_what_was_guarded_is_read_as_it_was(text: str) -> None:
    assert unguarded(guarded(text)) == text
    assert guarded(text)[:1] not in {"=", "@", "\t", "\r"}


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_stay_numbers(number: float) -> None:
    for text in (repr(number), f"{number:.12g}", f"{number:+.3e}", f"{number:.2f}"):
        assert guarded(text) == text


def test_what_is_no_number_for_a_spreadsheet_is_text() -> None:
    for text in ("+1_000", "-1e", "-inf", "+", "-1,5", "-1 + 2", "+٣"):
        assert guarded(text) == f"'{text}"


def test_names_of_a_case_are_no_formulas(case: Path) -> None:
    """In the CSV of one case or of several, and in a workbook; what begins so is a number."""
    two = case.with_name("two.yaml")
    two.write_text(HOSTILE, "utf-8")
    for command in ("run", "flow", "summary", "explain"):
        for cases in ([case], [case, two]):
            said = vstatics(command, *cases, "-f", "csv")
            assert said.status == 0
            begun = [one for one in cells(said.out) if one[:1] in {*"=+-@\t\r"}]
            assert all(re.fullmatch(r"-[\d.]+(e[-+]\d+)?", one) for one in begun)
            raw = cells(vstatics(command, *cases, "-f", "csv", "--raw").out)
            assert [unguarded(one) for one in cells(said.out)] == raw
            assert {"@now", "-2+3"} & set(raw)
        made = case.with_name(f"{command}.xlsx")
        assert vstatics(command, case, "-o", made).status == 0
        book = openpyxl.load_workbook(made)
        in_book = [cell for sheet in book for row in sheet for cell in row]
        assert {cell.data_type for cell in in_book} <= {"s", "inlineStr", "n", "b"}  # none is "f"
        assert "@now" in [cell.value for cell in in_book]


def test_headings_of_a_sweep_are_no_formulas(tmp_path: Path, case: Path) -> None:
    asked: tuple[Any, ...] = ("sweep", case, "--vary", "@now.ratio=-2,-3", "--out", "-ratio[#1]")
    said = vstatics(*asked, "-o", tmp_path / "new.csv")
    assert said.status == 0, said.err
    lines = (tmp_path / "new.csv").read_text("utf-8").splitlines()
    assert lines[0] == "variant,'@now.ratio,status,'-ratio[#1]"
    assert vstatics(*asked, "--raw").out.splitlines()[0] == "variant,@now.ratio,status,-ratio[#1]"
    assert vstatics(*asked, "--raw", "-o", tmp_path / "new.npz").status == 2


def test_a_table_of_variants_is_read_with_apostrophes_and_without(case: Path) -> None:
    table = case.with_name("variants.csv")
    for heading in ("@now.ratio", "'@now.ratio"):
        table.write_text(f"{heading}\n-2.5\n-96/39\n'-96/39\n", "utf-8")
        said = vstatics("sweep", case, "--variants", table, "--out", "ratio[#1]", "-f", "jsonl")
        values = [json.loads(line)["@now.ratio"] for line in said.out.splitlines()]
        assert values == pytest.approx([-2.5, -96 / 39, -96 / 39])
