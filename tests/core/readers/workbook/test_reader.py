"""Cases in workbooks: what a person types in a spreadsheet program is read; faults name cells."""

import datetime as dt
import io
import re
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from hypothesis import given, settings

import vstatics as library
from tests.chance import count
from tests.commands import ID, SHIPPED, json_answer, vstatics
from tests.strategies import ANY_NUMBER, ODD_NAMES, transmissions
from vstatics import Gear, Mechanism, ReadError, ShiftElement, Transmission
from vstatics.core import readers
from vstatics.core.writers import workbook

BOX: dict[str, list[list[Any]]] = {
    "case": [["path", "value"], ["name", "three-speed box"], ["load.speed", "3000 rpm"]],
    "links": [["name"], ["engine"], ["sun"], ["ring"], ["carrier"], ["axle"]],
    "shift_elements": [
        ["name", "first", "second", "capacity"],
        ["C1", "engine", "sun", None],
        ["C2", "engine", "ring", 1.5],
        ["B1", "ring", "housing", None],
    ],
    "mechanisms": [
        ["name", "first", "second", "third", "ratio", "efficiency"],
        ["set", "sun", "ring", "carrier", "-78/30", 0.97],
        ["pair", "carrier", "axle", None, -3.5, 0.98],
    ],
    "gears": [
        ["name", "C1", "C2", "B1", "load.torque"],
        ["low", "x", None, "x", "400 N*m"],
        ["direct", "X", "x", None, None],
    ],
}
SAME = """\
name: three-speed box
links: [engine, sun, ring, carrier, axle]
load: {speed: 3000 rpm}
shift_elements:
  C1: [engine, sun]
  C2: {links: [engine, ring], capacity: 1.5}
  B1: [ring, housing]
mechanisms:
  set: {first: sun, second: ring, third: carrier, ratio: -78/30, efficiency: 0.97}
  pair: {first: carrier, second: axle, ratio: -3.5, efficiency: 0.98}
gears:
  low: {engaged: [C1, B1], load: {torque: 400 N*m}}
  direct: [C1, C2]
"""


def typed(change: Callable[[Any], object] = lambda _: None) -> bytes:
    """The box as somebody types it, with something else."""
    book = openpyxl.Workbook()
    book.remove(book.worksheets[0])
    for name, rows in BOX.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    change(book)
    made = io.BytesIO()
    book.save(made)
    return made.getvalue()


def with_cells(cells: dict[str, Any]) -> bytes:
    """The box with other cells, by names as gears!C4."""

    def change(book: Any) -> None:
        for place, value in cells.items():
            sheet, _, cell = place.partition("!")
            book[sheet][cell] = value

    return typed(change)


def faults(data: bytes) -> list[str]:
    with pytest.raises(ReadError) as caught:
        readers.read(data, "box.xlsx")
    return [ID.sub("", str(one)) for one in caught.value.problems]


def read(data: bytes) -> Transmission:
    return readers.read(data, "box.xlsx").case


def test_sheets_say_what_yaml_says() -> None:
    assert read(typed()) == library.loads(SAME)


def test_a_list_stands_in_a_cell_and_items_in_brackets() -> None:
    load = {"case!A4": "load.torque", "case!B4": "300 N*m"}
    points = {**load, "case!A5": "drag.sun", "case!B5": "[[0, 0.5], [100, 2]]"}
    items = {**load, "case!A5": "drag.sun[1]", "case!B5": "[0, 0.5]"}
    items |= {"case!A6": "drag.sun[2]", "case!B6": "[100, 2]"}
    text = SAME.replace("3000 rpm}", "3000 rpm, torque: 300 N*m}")
    expected = library.loads(text + "drag: {sun: [[0, 0.5], [100, 2]]}")
    assert read(with_cells(points)) == read(with_cells(items)) == expected


def test_a_shift_table_may_mark_what_is_engaged_and_what_is_not() -> None:
    for engaged, not_engaged in (
        *[(1, 0), (1.0, 0.0), ("1", "0"), (True, False), ("TRUE", "FALSE")],
        *[("x", "-"), ("\u0445", "\u2013"), ("\u0425", "\u2014"), ("\u00d7", "\u2212")],
        # UgnisSoftware/react-spreadsheet-import/pull/48; `●` and `·` are in the tables of `run`
        *[("●", "·"), ("✓", ""), ("Yes", "No"), ("да", "нет")],
    ):
        marks = {"x": engaged, "-": not_engaged}
        table: dict[str, Any] = {"gears!A4": "neutral"}
        for row, shift in ((2, "x-x"), (3, "xx-"), (4, "---")):
            pairs = zip("BCD", shift, strict=True)
            table |= {f"gears!{column}{row}": marks[one] for column, one in pairs}
        assert read(with_cells(table)) == library.loads(SAME + "  neutral: []\n"), engaged


def test_other_sheets_and_empty_rows_do_not_matter() -> None:
    def more(book: Any) -> None:
        book.create_sheet("Notes").append(["=1/0", "whatever"])
        book["mechanisms"].insert_rows(3)
        book["gears"]["XFD1048576"] = " "  # the last cell: atviriduomenys/spinta/pull/310
        book["links"].title = "Links "  # dondi/GRNsight#732; backslashes: python-excel/xlrd#96

    assert read(typed(more).replace(b"xl/work", b"xl\\work")) == library.loads(SAME)


FAULTS: tuple[tuple[str, Any, str], ...] = (
    ("mechanisms!E2", "much", "mechanisms!E2: error: mechanisms.set.ratio: read 'much'"),
    ("mechanisms!C3", "axel", "mechanisms!C3: error: mechanisms.pair.second: read 'axel'"),
    ("mechanisms!F1", "eficiency", "mechanisms!F1: error: unknown heading `eficiency`, expected a "
     "key; did you mean `efficiency`?"),
    ("mechanisms!G1", "ratio", "mechanisms!G1: error: the heading `ratio` is there twice"),
    ("mechanisms!G2", 3, "mechanisms!G2: error: read `3`, but its column has no heading"),
    ("mechanisms!A2", None, "mechanisms!A2: error: the name is missing"),
    ("mechanisms!A3", "set", "mechanisms!A3: error: the name `set` is given twice"),
    ("mechanisms!E3", None, "mechanisms!A3: error: mechanisms.pair: `ratio` is missing"),
    ("mechanisms!E3", dt.date(2026, 3, 2), "mechanisms!E3: error: read a date"),
    ("mechanisms!E3", "=78/30", "mechanisms!E3: error: a formula without its value"),
    ("mechanisms!E3", "#DIV/0!", "mechanisms!E3: error: read #DIV/0!"),
    ("mechanisms!E3", '"[1', "mechanisms!E3: error: not YAML"),
    ("gears!C1", "C3", "gears!C1: error: unknown heading `C3`, expected a key or the name "),
    ("gears!D3", "y", "gears!D3: error: read `y`, expected `x` or 1, nothing or 0"),
    ("gears!E1", "load.torqe", "gears!E2: error: gears.low.load: unknown key `torqe`"),
    ("links!A1", "name[" + "1" * 5000 + "]", "links!A1: error: "),
    ("links!A1", "names", "links!A1: error: expected the heading `name`"),
    ("links!B3", "sun", "links!B3: error: read `sun`, expected names of links alone"),
    ("case!A3", "lod.speed", "case!A3: error: unknown key `lod`; did you mean `load`?"),
    ("case!A3", "load..speed", "case!A3: error: `load..speed`: read nothing"),
    ("case!A3", "name", "case!A3: error: `name` is given twice"),
    ("case!A3", "name.x", "case!A3: error: `name` is given as a whole, too"),
    ("case!B3", None, "case!A3: error: expected a path and a value"),
    ("case!D3", "mine", "case!D3: error: read `mine`, but the columns after path and value"),
)  # fmt: skip
"""Cell, what is written there, place and words of the error."""


def test_a_fault_is_reported_at_its_cell() -> None:
    for cell, value, said in FAULTS:
        told = faults(with_cells({cell: value}))
        assert any(one.startswith(f"box.xlsx:{said}") for one in told), told


def test_all_faults_are_reported_at_once_with_their_cells_in_json(tmp_path: Path) -> None:
    file = tmp_path / "box.xlsx"
    file.write_bytes(with_cells({"mechanisms!E2": "much", "gears!D3": "y"}))
    said = vstatics("check", file)
    assert re.findall(r"box.xlsx:(\S+): error", said.err) == ["mechanisms!E2", "gears!D3"]
    places = [(one["file"], one["line"], one["column"]) for one in json_answer("check", file)]
    assert places == [(str(file), 2, 5), (str(file), 3, 4)]


def test_a_mistyped_sheet_and_a_cell_merged_over_rows_are_reported() -> None:
    def renamed(book: Any) -> None:
        book["gears"].title = "gear"

    said = "box.xlsx:gear!A1: error: unknown sheet `gear`; did you mean `gears`?"
    assert said in faults(typed(renamed))
    [merged] = faults(typed(lambda book: book["mechanisms"].merge_cells("F2:F3")))
    assert merged.startswith("box.xlsx:mechanisms!F2: error: F2:F3 are merged into one cell")


def test_what_is_no_case_is_refused() -> None:
    assert "a workbook: it is damaged or has another f" in faults(b"PK\x03\x04 and no more")[0]
    bomb = io.BytesIO()
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("xl/workbook.xml", b" " * 60_000_000)
    assert "60 MB when unpacked, expected at most 10" in faults(bomb.getvalue())[0]
    [far] = faults(with_cells({"mechanisms!XFD7": 1}))
    assert far.endswith("sheet `mechanisms`: expected at most 10000 rows and 500 columns")


def test_a_workbook_is_run_and_converted_there_and_back(tmp_path: Path) -> None:
    yaml, book = tmp_path / "box.yaml", tmp_path / "box.xlsx"
    yaml.write_text(SAME, "utf-8")
    assert vstatics("convert", yaml, book) == (0, "", "")
    first = book.read_bytes()
    assert vstatics("convert", yaml, book) == (0, "", "")
    assert book.read_bytes() == first  # no date in it
    assert vstatics("run", book) == vstatics("run", yaml)
    assert vstatics("convert", book, tmp_path / "back.yaml") == (0, "", "")
    assert library.load(tmp_path / "back.yaml") == library.load(yaml)
    rows = openpyxl.load_workbook(book)["gears"].iter_rows(values_only=True)
    assert [list(row) for row in rows] == [
        ["name", "C1", "C2", "B1", "load.torque"],
        ["low", "x", None, "x", "400.0 N*m"],
        ["direct", "x", "x", None, None],
    ]


@pytest.mark.slow
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_a_shipped_case_is_kept(path: Path) -> None:
    case = library.load(path)
    assert read(workbook.write(case)) == case


@pytest.mark.slow
@settings(max_examples=count(10, 75))
@given(transmissions(ANY_NUMBER, torsional=True))
def test_what_is_written_is_read_again(case: Transmission) -> None:
    assert read(workbook.write(case)) == case


ODD = ["speeds", "_x0041_", '"speeds"', "coast", "both'\"", *ODD_NAMES]


@pytest.mark.parametrize("names", [ODD[:2], ODD[2:]])
def test_odd_names_and_orders_are_kept(names: list[str]) -> None:
    """Of engaged elements, too, whose order no order of columns can keep."""
    orders = [[1, 2], [2, 1], [2], []]
    for name in names:
        case = Transmission(
            3,
            [ShiftElement(1, 2, name), ShiftElement(2, 0, "other")],
            [Mechanism(1, 2, 3, -2.5, name=f"{name}-")],
            [Gear(one, name=f"{name}{one}", speeds={2: 0.5} if not one else {}) for one in orders],
            name=name,
            link_names=["first", name, "third"],
            inertias={2: 0.1},
        )
        assert read(workbook.write(case)) == case, name
