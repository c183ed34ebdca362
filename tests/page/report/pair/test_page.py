"""Two cases on one page: every number of both, and what differs by what is other in the cases.

Expected numbers are those of `run -f json` of each case, and the ratio 1 - u of a planetary set.
"""

import math
from pathlib import Path
from typing import Any

import pytest

from tests.chance import count, seeded
from tests.commands import CASES, SHIPPED, TIED_UP, vstatics
from tests.page.report.pages import Element, Page
from tests.page.report.printed import printed
from vstatics import load, solve
from vstatics.core.tables.values import tables

BOX = """\
name: box
links: [sun, ring, carrier]
shift_elements: {B1: [ring, housing], C1: [sun, ring], B2: [sun, housing]}
mechanisms: {P1: {first: sun, second: ring, third: carrier, ratio: -2.5, efficiency: 0.97}}
gears: {low: [B1], direct: [C1]}
load: {speed: 3000 rpm, torque: 400 N*m}
"""
OTHER = BOX.replace("-2.5", "-3").replace("direct: [C1]", "third: {engaged: [C1]}")


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    made = [tmp_path / "old.yaml", tmp_path / "new.yaml"]
    for file, text in zip(made, (BOX, OTHER), strict=True):
        file.write_text(text, "utf-8")
    return made


@pytest.fixture
def _without_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vstatics.page.report.pair.page._pictures", lambda _: [])


def compared(*files: Path) -> Page:
    said = vstatics("report", *files, "-o", "-")
    assert said.status == 0, said.err
    return Page(said.out)


def numbers(page: Page, case: str) -> dict[tuple[str, ...], float | None]:
    """Of a case: what stands on the page, by table, row and gear."""
    found: dict[tuple[str, ...], float | None] = {}
    for one in page.all("td"):
        marks = {key: text or "" for key, text in one.attributes.items()}
        if marks.get("data-case") == case and "data-result" in marks:
            place = [marks.get(f"data-{key}", "") for key in ("result", "row", "gear")]
            number = marks["data-number"]
            found[tuple(place)] = float(number) if number else None
    return found


def results(file: Path) -> dict[tuple[str, ...], float | None]:
    """The same as the program calculates it, of tables that a page has."""
    return {
        (one.quantity.name, "" if one.quantity.rows == "one" else row, gear): (
            None if math.isnan(number) else number
        )
        for one in tables(solve(load(file)))
        if one.quantity.columns == "gears" and one.quantity.kind is float
        for row, values in zip(one.rows, one.values.tolist(), strict=True)
        for gear, number in zip(one.columns, values, strict=True)
    }


def row(page: Page, result: str, gear: str) -> dict[str, Element]:
    """The cells of both cases for a result of gears."""
    wanted = {"data-result": result, "data-gear": gear}
    cells = [one for one in page.all("td") if wanted.items() <= one.attributes.items()]
    return {str(one.attributes["data-case"]): one for one in cells}


@pytest.mark.usefixtures("_without_pictures")
def test_each_number_of_both_stands_there_and_what_differs_is_marked(files: list[Path]) -> None:
    page = compared(*files)
    for case, file in zip("AB", files, strict=True):
        assert numbers(page, case).items() >= results(file).items()
    both = row(page, "ratio", "low")
    assert [float(both[one].attributes["data-number"] or "") for one in "AB"] == [1 + 2.5, 1 + 3]
    assert all("differs" in (both[one].attributes["class"] or "") for one in "AB")
    changes = [one.text for one in page.all("tr") if one.text.startswith("change")]
    assert any(f"+{100 * (4 / 3.5 - 1):.2f} %" in one for one in changes)


@pytest.mark.usefixtures("_without_pictures")
def test_changes_of_the_case_are_listed_and_gears_of_one_alone(files: list[Path]) -> None:
    page = compared(*files)
    paths = [one.text for one in page.all("tr")]
    assert "P1.ratio\u22122.5\u22123.0" in paths
    notes = [one.text for one in page.all("p")]
    assert {"Only A has gear direct.", "Only B has gear third."} <= {*notes}
    assert [page.data[one]["file"] for one in "AB"] == ["old.yaml", "new.yaml"]
    same = compared(files[0], files[0])
    assert not [one for one in same.all("td") if "differs" in (one.attributes.get("class") or "")]
    assert any("The cases are the same" in one.text for one in same.all("p"))


@pytest.mark.slow
@pytest.mark.usefixtures("_without_pictures", "without_pictures")
def test_a_file_compares_and_a_directory_has_a_page_each(files: list[Path], tmp_path: Path) -> None:
    made = vstatics("report", *files, "-o", tmp_path / "both.html", "--stamp", "author=Me")
    assert made.status == 0
    assert '<dl class="stamp">' in (tmp_path / "both.html").read_text("utf-8")
    assert vstatics("report", *files, "-o", f"{tmp_path}/each/").status == 0
    assert {one.name for one in (tmp_path / "each").glob("*.html")} == {"new.html", "old.html"}
    for wrong in (["--gears", "low"], [files[0]]):
        assert vstatics("report", *files, "-o", tmp_path / "no.html", *wrong).status == 2
    bad, tied = tmp_path / "bad.yaml", tmp_path / "tied.yaml"
    bad.write_text(BOX.replace("ratio: -2.5", "ratoi: 2"), "utf-8")
    tied.write_text(TIED_UP, "utf-8")
    assert vstatics("report", files[0], bad, "-o", tmp_path / "no.html").status == 1
    assert not (tmp_path / "no.html").exists()
    assert vstatics("report", files[0], tied, "-o", tmp_path / "tied.html").status == 1
    assert (tmp_path / "tied.html").exists()


@pytest.mark.slow
@pytest.mark.usefixtures("_without_pictures")
def test_shipped_cases_lose_no_number_beside_one_another() -> None:
    chance = seeded(31)
    for _ in range(count(5, 60)):
        files = chance.sample(SHIPPED, 2)
        page = compared(*files)
        for case, file in zip("AB", files, strict=True):
            shown = numbers(page, case)
            assert shown.items() >= results(file).items(), file


@pytest.mark.slow
def test_long_tables_fill_the_paper_and_notes_stay_with_them(browser: Any, tmp_path: Path) -> None:
    made, cases = (
        tmp_path / "two.html",
        [CASES / f"{name}.yaml" for name in ("zf-8hp70", "ford-10r80")],
    )
    assert vstatics("report", *cases, "-o", made).status == 0
    sheets = printed(browser, made)
    assert "Changes" in sheets[0].lines
    last = [[line for line in sheet.lines if " / " not in line][-1] for sheet in sheets]
    assert not [line for line in last if line.startswith("Only B has")]


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_fits_a_phone_and_paper(browser: Any, files: list[Path], width: int) -> None:
    said = vstatics("report", CASES / "gm-8l90.yaml", CASES / "zf-8hp70.yaml", "-o", "-")
    made = files[0].with_suffix(".html")
    made.write_text(said.out, "utf-8")
    window = browser.new_page(viewport={"width": width, "height": 844})
    errors: list[str] = []
    window.on("pageerror", lambda error: errors.append(str(error)))
    window.goto(made.as_uri())
    assert window.evaluate("document.documentElement.scrollWidth") <= width
    assert window.locator("[data-case] svg").count() >= 2  # a stick diagram of each
    window.emulate_media(media="print")
    window.set_viewport_size({"width": math.floor(182 / 25.4 * 96), "height": 1000})
    wide = """[...document.querySelectorAll("main table")].filter((one) => (
      one.checkVisibility() && one.getBoundingClientRect().right > innerWidth)).length"""
    assert window.evaluate(wide) == 0
    assert not errors
    window.close()
