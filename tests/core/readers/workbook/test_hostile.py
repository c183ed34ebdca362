"""Workbooks of any size and kind: the same cells as openpyxl reads, or an error soon."""

import datetime as dt
import io
import time
import tracemalloc
import zipfile
from typing import Any

import openpyxl
import pytest
from openpyxl.utils.datetime import MAC_EPOCH, WINDOWS_EPOCH

from tests.chance import examples, seeded
from tests.commands import CASES, vstatics
from tests.core.readers.workbook.test_reader import faults, read, typed
from vstatics import load
from vstatics.core.errors import ReadError
from vstatics.core.readers.workbook.cells import MOST_SHEET_CELLS, read_sheets

SECONDS, MEMORY = 5, 400 * 2**20


@examples(10, 30, 600)
def test_cells_are_those_that_openpyxl_reads(examples: int) -> None:
    rng = seeded(17)
    values = (None, True, False, 1e300, 0.1 + 0.2, " текст ", "a & <b>", "line\nline", "_x000D_")
    for _ in range(examples):
        book = openpyxl.Workbook()
        written: Any = book.active
        size = rng.randint(1, 8), rng.randint(1, 30)
        for _ in range(rng.randint(0, 60)):
            value = rng.choice((*values, "78/30", "", rng.uniform(-9, 9), rng.randint(-99, 99)))
            written.cell(rng.randint(1, size[0]), rng.randint(1, size[1]), value)
        data = io.BytesIO()
        book.save(data)
        [sheet] = read_sheets(data.getvalue(), "a.xlsx", ["Sheet"])
        found = {(one.row, one.column): one.text for row in sheet.rows for one in row}
        expected = {}
        again: Any = openpyxl.load_workbook(data).active
        for row in again.iter_rows():
            for cell in row:
                if cell.value is not None and str(cell.value).strip():
                    text = str(cell.value).strip() if isinstance(cell.value, str) else None
                    value = str(cell.value).lower() if isinstance(cell.value, bool) else None
                    expected[cell.row, cell.column] = text or value or repr(cell.value)
        assert found == expected


def test_a_number_with_a_format_of_dates_is_refused() -> None:
    def with_ratio(value: object, form: str = "", first: dt.datetime = WINDOWS_EPOCH) -> bytes:
        def changed(book: Any) -> None:
            book.epoch = first
            book["mechanisms"]["E3"] = value
            if form:
                book["mechanisms"]["E3"].number_format = form

        return typed(changed)

    for value, form in ((46083, "yyyy-mm-dd"), (0.5, "h:mm"), (1.5, "[h]:mm")):
        assert any("read a date or time" in one for one in faults(with_ratio(value, form))), form
    for form in ("General", '0.00 "days"', "[Red]0.00", "0.0E+00"):
        assert read(with_ratio(2.5, form)).mechanisms[1].ratio == 2.5
    day = dt.datetime(2026, 3, 2, 12)  # noqa: DTZ001
    for first in (WINDOWS_EPOCH, MAC_EPOCH):
        assert any("2026-03-02 12:00:00" in one for one in faults(with_ratio(day, first=first)))


ERROR = '<c t="e"><v>x</v></c>'
SHEET = "<worksheet><sheetData>{}</sheetData>{}</worksheet>"
STYLES = "<styleSheet><fonts>{}</fonts><cellXfs><xf numFmtId='0'/></cellXfs></styleSheet>"
HOSTILE: dict[str, tuple[str, str, str]] = {
    "styles": ("xl/styles.xml", STYLES.format("<font/>" * 2_000_000), ""),
    "cells": ("SHEET", SHEET.format("<row>" + "<c/>" * 3_000_000 + "</row>", ""), "at most"),
    "grid": ("SHEET", SHEET.format(("<row>" + "<c/>" * 400 + "</row>") * 2000, ""), "200000 cells"),
    "rows": (
        "SHEET",
        SHEET.format("<row/>" * 999_999 + "<row><c><v>1</v></c></row>", ""),
        "10000 rows",
    ),
    "merged": ("SHEET", SHEET.format("", '<mergeCell ref="A1:B2"/>' * 300_000), "are merged"),
    "errors": ("SHEET", SHEET.format(f"<row>{ERROR * 400}</row>" * 400, ""), "expected a number"),
    "deep": ("SHEET", "<a>" * 3_000_000, "nested deeper"),
    "text": ("SHEET", SHEET.format("x" * 9_900_000, ""), ""),
    "backwards": ("SHEET", SHEET.format('<row r="2"/><row r="1"/>', ""), "not in order"),
    "doctype": ("SHEET", "<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", "a document type"),
    "texts": ("xl/sharedStrings.xml", "<sst>" + "<si/>" * 1_900_000 + "</sst>", ""),
    # As spreadsheets save ="" (catamphetamine/read-excel-file#45).
    "formula": ("SHEET", SHEET.format('<row><c t="str"><f>""</f><v/></c></row>', ""), ""),
    "index": ("SHEET", SHEET.format('<row><c t="s"><v>-1</v></c></row>', ""), "no text or format"),
}


def _with_part(path: str, content: str) -> bytes:
    """A good workbook with another part."""
    made = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(typed())) as old,
        zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as new,
    ):
        sheet = next(name for name in old.namelist() if name.startswith("xl/worksheets/"))
        parts: dict[str, Any] = {name: old.read(name) for name in old.namelist()}
        parts[sheet if path == "SHEET" else path] = content
        for name, part in parts.items():
            new.writestr(name, part)
    return made.getvalue()


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_workbook_takes_little_time_and_memory(name: str) -> None:
    path, content, said = HOSTILE[name]
    data, told = _with_part(path, content), ""
    is_traced = name in ("texts", "merged")
    if is_traced:
        tracemalloc.start()
    begin = time.process_time()
    try:
        read(data)
    except ReadError as error:
        told = str(error)
    if is_traced:
        assert tracemalloc.get_traced_memory()[1] < MEMORY
        tracemalloc.stop()
    else:
        assert time.process_time() - begin < SECONDS
    assert said in told if said else not told or "MB, expected" in told


@pytest.mark.slow
def test_a_full_sheet_is_read() -> None:
    rows = ("<row>" + "<c><v>1</v></c>" * 400 + "</row>") * (MOST_SHEET_CELLS // 400)
    [sheet, *_] = read_sheets(_with_part("SHEET", SHEET.format(rows, "")), "a.xlsx", ["case"])
    assert sum(map(len, sheet.rows)) == MOST_SHEET_CELLS


def test_a_workbook_is_read_without_the_package_that_writes_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Any
) -> None:
    file = tmp_path / "simpson.xlsx"
    assert vstatics("convert", CASES / "simpson.yaml", file).status == 0
    monkeypatch.setattr(openpyxl, "load_workbook", None)
    assert load(file) == load(CASES / "simpson.yaml")
