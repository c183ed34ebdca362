"""The tools of a page in a browser: units, rows of a link, files.

Sizes of units are those of NIST SP 811: 1 lbf*ft is 1.355 817 948 N*m, 1 hp is 745.699 87 W.
"""

import csv
import io
import json
import math
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.page.serve.windows import looked_through, served
from vstatics import load, solve
from vstatics.core.flow.power import flows
from vstatics.core.tables.csv import unguarded
from vstatics.core.tables.quantities import BY_NAME, RELATIVE
from vstatics.core.tables.values import tables

pytestmark = pytest.mark.slow
BURST_MS = 1100
"""Chromium saves ten files of a page within a second, and drops what comes more."""
LBF_FT, HP = 1.355817948, 0.74569987
BOX = """\
name: "@box"
links: ["=1+1", ring, "-out", aside]
shift_elements: {B1: [ring, housing], C1: ["=1+1", ring]}
mechanisms:
  P1: {first: "=1+1", second: ring, third: "-out", ratio: -2.5, efficiency: 0.97}
  P2: {first: ring, second: aside, ratio: -1.25, efficiency: 0.98}
output: "-out"
gears: {low: [B1], direct: [C1], pushed: {engaged: [B1], coast: true}}
load: {speed: 3000 rpm, torque: 400 N*m}
"""
SIZE = {"width": 1280, "height": 900}
CELLS = """(key) => [...document.querySelectorAll(`main td[data-result="${key}"]`)].map(
  (one) => [one.dataset.row ?? "", one.dataset.gear, one.dataset.number, one.textContent])"""

TEETH = """() => [...document.querySelectorAll(".power tr")]
  .filter((one) => one.cells[0].textContent === "teeth")
  .map((one) => [...one.cells].slice(1).map((cell) => cell.textContent))"""


def opened(browser: Any, folder: Path, text: str) -> Any:
    made = folder / "page.html"
    made.write_text(text, "utf-8")
    window = browser.new_page(viewport=SIZE, accept_downloads=True)
    window.on("pageerror", lambda error: pytest.fail(str(error)))
    window.goto(made.as_uri())
    return window


@pytest.fixture(scope="module")
def box(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("box") / "box.yaml"
    file.write_text(BOX, "utf-8")
    return file


@pytest.fixture
def page(browser: Any, box: Path) -> Iterator[Any]:
    with served(browser, box, viewport=SIZE, accept_downloads=True) as here:
        yield here.page


def seen(page: Any, key: str) -> dict[tuple[str, str], float]:
    """The numbers that stand in a table, by row and gear."""
    return {
        (row, gear): float(text.replace("\N{MINUS SIGN}", "-"))
        for row, gear, _, text in page.evaluate(CELLS, key)
        if text not in ("", "\N{EN DASH}")
    }


def chosen(page: Any, units: str) -> None:
    page.select_option("#units", units)


def test_numbers_are_shown_in_the_chosen_units_and_keep_theirs(page: Any, box: Path) -> None:
    results = solve(load(box))
    told = {one.quantity.name: one for one in tables(results)}
    before = {one.name: page.evaluate(CELLS, one.name) for one in RELATIVE}
    sizes = {"rpm": 1.0, "Nm": LBF_FT, "kW": HP}
    for units in ("si", "us"):
        chosen(page, units)
        for one in RELATIVE:
            if not one.with_load or one.rows == "one":
                continue
            table = told.get(f"{one.name}_{one.with_load}")
            if table is None:
                continue
            by = sizes[one.with_load] if units == "us" else 1.0
            own = dict(zip(table.rows, table.values.tolist(), strict=True))
            columns = list(table.columns)
            shown = seen(page, one.name)
            assert shown
            for (row, gear), number in shown.items():
                wanted = own[row][columns.index(gear)] / by
                assert number == pytest.approx(wanted, rel=1e-5, abs=0.06), (one.name, row, gear)
    chosen(page, "relative")
    assert {one.name: page.evaluate(CELLS, one.name) for one in RELATIVE} == before


def test_headings_tell_the_unit_and_a_table_stands_once(page: Any) -> None:
    title = page.locator("#tables h3", has_text="Speeds of the links").first
    for units, said in (("relative", "links [speeds]"), ("si", "links, rpm [speeds]")):
        chosen(page, units)
        assert title.text_content() == f"Speeds of the {said}"
        assert page.locator("#tables h3:visible", has_text="Speeds of the links").count() == 1
    chosen(page, "us")
    heads = [one.text_content() for one in page.locator("#largest-values th:visible").all()]
    assert {"slip, rpm", "torque, lbf*ft", "with losses, lbf*ft"} <= {*heads}
    torque = page.locator(".overview .unit")
    assert torque.text_content() == "lbf*ft"


def test_powers_of_teeth_are_in_the_unit_of_their_column(page: Any, box: Path) -> None:
    """As the page has them in kW that does not calculate: `vstatics flow`."""
    powers = [
        [one.power, with_losses.power]
        for flow in flows(solve(load(box)))
        if flow.ideal and flow.lossy
        for one, with_losses in zip(flow.ideal.teeth, flow.lossy.teeth, strict=True)
        if one.device.name == "P1"  # the other carries nothing
    ]
    assert powers
    kilowatts = 3000 * 400 * math.pi / 30 / 1000
    for units, by in (("si", kilowatts), ("us", kilowatts / HP), ("relative", 1.0)):
        chosen(page, units)
        shown = [[float(one or 0) for one in row[:2]] for row in page.evaluate(TEETH)]
        wanted = [[by * one for one in row] for row in powers]
        assert np.array(shown) == pytest.approx(np.array(wanted), abs=6e-4)


def test_without_a_load_nothing_but_relative_numbers_can_be_chosen(
    browser: Any, tmp_path: Path
) -> None:
    case = Path(shutil.copy(CASES / "simpson.yaml", tmp_path))
    disabled = "[...document.querySelectorAll('#units option')].map((one) => one.disabled)"
    with served(browser, case) as here:
        assert here.page.evaluate(disabled) == [False, True, True]


def test_of_two_cases_one_without_a_load_has_no_number_in_units(
    browser: Any, box: Path, tmp_path: Path
) -> None:
    other = tmp_path / "other.yaml"
    other.write_text(BOX[: BOX.index("load:")].replace("-2.5", "-3"), "utf-8")
    window = opened(browser, tmp_path, vstatics("report", box, other, "-o", "-").out)
    cell = """([label]) => document.querySelector(
      `td[data-case=${label}][data-result=speeds][data-row="-out"][data-gear=low]`).textContent"""
    assert [window.evaluate(cell, [one]) for one in "AB"] == ["0.286", "0.250"]  # 1/3.5, 1/4
    chosen(window, "si")
    assert [window.evaluate(cell, [one]) for one in "AB"] == ["857.1", "\N{EN DASH}"]
    window.close()


def test_rows_of_a_link_are_left_and_escape_brings_all_back(page: Any) -> None:
    rows = """(key) => [...document.querySelector(`main td[data-result="${key}"]`).closest("tbody").rows]
      .filter((one) => !one.hidden).map((one) => one.cells[0].textContent)"""
    every = page.evaluate(rows, "torques")
    page.fill("#links", "aside")
    assert page.evaluate(rows, "speeds") == ["aside"]
    assert page.evaluate(rows, "torques") == ["P2"]
    assert page.evaluate(rows, "slip_speeds") == []
    hidden = page.locator("main tbody tr[hidden]").count()
    assert page.text_content("#hidden-rows") == f"rows hidden: {hidden}"
    page.fill("#links", "nobody")
    assert page.text_content("#hidden-rows") == "no link nobody"
    assert page.evaluate(rows, "torques") == every
    page.fill("#links", "ring")
    assert set(page.evaluate(rows, "torques")) == {"B1", "C1", "P1", "P2"}
    page.press("#links", "Escape")
    assert page.evaluate(rows, "torques") == every
    assert page.locator("main tbody tr[hidden]").count() == 0


def downloaded(page: Any, button: Any) -> str:
    with page.expect_download() as waiting:
        button.click()
    return Path(waiting.value.path()).read_text("utf-8")


def test_tables_are_saved_with_all_digits_whatever_is_shown(page: Any, box: Path) -> None:
    """The numbers of `run -f csv`; what begins as a formula is a text in a spreadsheet."""
    lines = csv.DictReader(io.StringIO(vstatics("run", box, "-f", "csv").out))
    wanted = {(one["table"], unguarded(one["row"]), one["gear"]): one["value"] for one in lines}
    chosen(page, "us")
    for key in ("speeds", "slip_speeds", "torques", "lossy_torques", "losses"):
        section = page.locator("section.table", has=page.locator(f'td[data-result="{key}"]'))
        text = downloaded(page, section.locator("[data-save=csv]"))
        [_, *gears], *rows = csv.reader(io.StringIO(text))
        assert not any(name.startswith(("=", "-")) for name, *_ in rows)
        for name, *numbers in rows:
            told = [float(wanted[key, unguarded(name), gear] or "nan") for gear in gears]
            np.testing.assert_array_equal([float(number or "nan") for number in numbers], told)
        made = json.loads(downloaded(page, section.locator("[data-save=json]")))
        assert made["title"].startswith(BY_NAME[key].title.replace("-1", "\u22121"))
        for row, (name, *numbers) in zip(made["rows"], rows, strict=True):
            assert row == [unguarded(name), *(float(n) if n else None for n in numbers)]
    page.wait_for_timeout(BURST_MS)
    loaded = page.locator("#largest-values [data-save=csv]:visible").last
    assert downloaded(page, loaded).startswith(
        "shift element,slip,gear,torque,gear,with losses,gear\n"
    )


def test_the_page_saves_the_result(page: Any, box: Path) -> None:
    saved = json.loads(downloaded(page, page.locator("#tools [data-save=json]")))
    assert {**saved, "file": "box.yaml"} == json_answer("run", box)


def test_a_picture_is_saved_as_it_stands_in_colours_of_paper(browser: Any, tmp_path: Path) -> None:
    case = Path(shutil.copy(CASES / "simpson.yaml", tmp_path))
    with served(browser, case, accept_downloads=True) as here:
        looked_through(here)
        window = here.page
        window.emulate_media(color_scheme="dark")
        figures = window.locator("main figure:visible:has(svg)")
        assert figures.count() > 2
        for figure in figures.all():
            text = downloaded(window, figure.locator("[data-save=svg]"))
            root = ET.fromstring(text)  # noqa: S314 - our own
            assert root.tag == "{http://www.w3.org/2000/svg}svg"
            assert "var(" not in text
            words = ["".join(one.itertext()) for one in root.iter() if one.tag.endswith("}text")]
            assert words == figure.locator("svg text").all_text_contents()
            assert "#1a1a1a" in text or "rgb(26, 26, 26)" in text  # the ink of paper
