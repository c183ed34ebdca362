"""The page on paper: at most ten sheets that can be read, and what cuts or adds to them."""

from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, SCENARIOS, SHIPPED, vstatics
from tests.page.report.pages import NASTY, NASTY_CASE, Page, report, write
from tests.page.report.printed import PrintedSheet, printed
from tests.shipped import shipped_results
from vstatics.core.tables.html import Markup
from vstatics.page.report.asked import AskedPage
from vstatics.page.report.page_pictures import pictures
from vstatics.page.report.parts import on_paper, side_by_side
from vstatics.pictures.paged.drawn import Drawn

MOST_SHEETS = 10
LEAST_LETTERS, ROUNDED = 7.0, 0.05
"""Of pictures. [pt]"""
ON_THE_SCREEN = {"Lever diagram", "Equations", "Kinematic plan", "Shifts", "Input", "Tables"}
ON_THE_SCREEN |= {"Conventions"}
"""Sections that are not printed where nobody asks for them."""


def sheets(browser: Any, folder: Path, case: object, *options: str) -> list[PrintedSheet]:
    file = folder / "printed.html"
    vstatics("report", case, "-o", file, "-q", *options)
    return printed(browser, file)


def lines(sheets: list[PrintedSheet]) -> list[str]:
    return [line for sheet in sheets for line in sheet.lines]


def headings(text: str, *, paper: bool = True) -> list[str]:
    """Of the sections of a page, or of those that are printed."""
    page = Page(text)
    heads = [one.text for one in page.all("h2")]
    looks = [one.attributes.get("class") for one in page.all("section") if "id" in one.attributes]
    return [head for head, look in zip(heads, looks, strict=True) if not (paper and look)]


@pytest.mark.slow
@pytest.mark.parametrize("case", [*SHIPPED, *SCENARIOS], ids=lambda file: file.name)
def test_a_shipped_case_has_at_most_ten_sheets_that_can_be_read(
    browser: Any, tmp_path: Path, case: Path
) -> None:
    shipped, least = sheets(browser, tmp_path, case), LEAST_LETTERS - ROUNDED
    assert 0 < len(shipped) <= MOST_SHEETS
    assert {one for sheet in shipped for one in sheet.letters if one[1] < least} == set()


@pytest.mark.slow
def test_all_prints_what_the_screen_shows_and_nothing_twice(browser: Any, tmp_path: Path) -> None:
    case = write(tmp_path, NASTY_CASE)
    some, every = (lines(sheets(browser, tmp_path, case, *end)) for end in ([], ["--all"]))
    heads = headings(report(case), paper=False)
    assert set(heads) >= ON_THE_SCREEN - {"Lever diagram"}
    printed_heads = [head for head in heads if head not in ON_THE_SCREEN]
    assert [line for line in some if line in heads] == printed_heads
    assert [line for line in every if line in heads] == heads
    looks = [one.attributes.get("class") or "" for one in Page(report(case, "--all")).all("div")]
    assert not [look for look in looks if look.split(" ")[0] == "paper"]


@pytest.mark.usefixtures("without_pictures")
def test_sections_cut_the_screen_and_the_print_and_stand_in_the_order_of_the_page(
    tmp_path: Path,
) -> None:
    case = write(tmp_path, NASTY_CASE)
    every = headings(report(case), paper=False)
    assert headings(report(case)) == [one for one in every if one not in ON_THE_SCREEN]
    made = report(case, "--sections", "tables,gears", "--sections", "input")
    assert headings(made) == headings(made, paper=False) == ["Gears", "Input", "Tables"]
    assert headings(report(case, "--all")) == every


@pytest.mark.usefixtures("without_pictures")
def test_gears_cut_all_that_is_of_a_gear_and_change_no_number() -> None:
    case = CASES / "zf-8hp70.yaml"
    whole, cut = Page(report(case)), Page(report(case, "--gears", "R,3"))
    assert list(cut.table("Ratios, steps")) == ["3", "R"]
    for name in ("Ratios, steps", "Speeds of the links", "Largest slip and torque"):
        full = whole.table(name)
        for row, cells in cut.table(name).items():
            assert all(full[row][key].text == cell.text for key, cell in cells.items())
    assert list(cut.table("Speeds of the links")["sun 1-2"]) == ["link", "3", "R"]
    assert {one.attributes.get("data-gear") for one in cut.all("div")} == {None, "3", "R"}
    choices = [one.attributes.get("data-choose") for one in cut.all("a") if "nav" in one.inside]
    assert [one for one in choices if one] == ["3", "R"]
    assert "7.043, gear 1 to 8" in [one.text for one in cut.all("dd")]
    linked = {one.attributes.get("data-choose") for one in cut.all("a")} - {None}
    assert linked == {"3", "R"}
    assert "Shown of 9 gears: R, 3." in "".join(one.text for one in cut.all("p"))
    assert cut.data == whole.data


@pytest.mark.usefixtures("without_pictures")
def test_a_stamp_stands_at_the_head_escaped_and_only_where_it_is_asked_for(tmp_path: Path) -> None:
    case = write(tmp_path, NASTY_CASE)
    assert 'class="stamp"' not in report(case)
    stamp = f'author={NASTY},project=P-7 <b>,"of, by"=-3'
    made = report(case, "--stamp", stamp, "--stamp", "date=2026-11-26")
    assert NASTY not in made
    shown = [one for one in Page(made).all("dl") if one.attributes.get("class") == "stamp"]
    assert [one.text for one in shown] == [f"author{NASTY}projectP-7 <b>of, by-3date2026-11-26"]
    assert shown[0].inside[-1] == "header"


def test_wrong_options_are_reported(tmp_path: Path) -> None:
    case = write(tmp_path, NASTY_CASE)
    for options, why in {
        "--sections flows": "read `flows`, did you mean `flow`?",
        "--sections x": "read `x`, expected overview, run, gears",
        "--gears 9": "9",
        "--gears=,,": "''",
        "--stamp author": "expected NAME=TEXT",
        "--stamp a=b,a=c": "a is given twice",
        "--all --sections flow": "what it names is printed",
    }.items():
        assert vstatics("report", case, "-o", "-", *options.split()).is_wrong_use(why), options


@pytest.mark.usefixtures("without_pictures")
def test_ports_are_listed_where_there_are_more_than_an_input_and_an_output() -> None:
    for case, has_ports in (("zf-8hp70.yaml", False), ("power-split.yaml", True)):
        heads = [one.text for one in Page(report(CASES / case)).all("h3")]
        assert any(one.startswith("Ports") for one in heads) == has_ports


def test_what_has_no_room_on_paper_is_reported() -> None:
    """By the sizes of sheets: 240 mm are 680 pt."""
    low, high = (f'<svg viewBox="0 0 200 {size}"></svg>' for size in (100, 500))
    flow = Drawn("flow", [Markup(high)] * 4)
    shown = on_paper(flow, "Power flow", most=3)
    assert shown.count("<svg") == 3
    assert "1 more sheet with --all." in shown
    assert "--all" not in on_paper(flow, "Power flow")
    gears = list("1234R")
    few = side_by_side(gears, [Drawn("stick", [Markup(high)])] * 5)
    assert few.count("<svg") == 4
    assert "Not printed: diagram of gear R; --all prints all of them." in few
    assert side_by_side(gears, [Drawn("stick", [Markup(low)])] * 5).count("<svg") == 5


def test_stick_diagrams_of_gears_are_printed_once() -> None:
    results, both = shipped_results("simpson-th400.yaml"), ["overview", "gears"]
    for asked, is_large in (
        (AskedPage(both), False),
        (AskedPage(), False),
        (AskedPage(["overview"]), True),
        (AskedPage(both, prints_all=True), True),
    ):
        found = pictures(results, asked)
        assert (found.bare_stick is None, bool(found.small_sticks)) == (is_large, not is_large)


@pytest.mark.slow
def test_pictures_are_of_the_gears_that_are_shown() -> None:
    made = Page(report(CASES / "zf-8hp70.yaml", "--gears", "R,3", "--sections", "flow,gears"))
    labels = {label for one in made.all("svg") if (label := one.attributes.get("aria-label"))}
    own = {f"Stick diagram, gear {gear}, small" for gear in "3R"}
    assert labels == {f"Power flow, gear {gear}" for gear in "3R"} | own
