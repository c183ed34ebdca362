"""The page in a browser: what its keys, rows and buttons do, and what it is like in print.

The gears of the small case: a sun, a held ring and 1 + 2.5 between sun and carrier, then 1.
"""

import csv
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest

from tests.accessibility import serious_faults
from tests.commands import CASES
from tests.page.report.pages import NASTY_CASE, report, write

pytestmark = pytest.mark.slow
LOW, DIRECT = "low <1>", "dir%/'ect"
TEN_SPEED, POWER_SPLIT, OLD_DECK = "ford-10r80.yaml", "power-split.yaml", "mzkt7922.dat"
TRUCK = "tarasik-truck.yaml"
LEAST_LETTERS = 7.0
"""Least size of letters in pictures on a telephone. [CSS px]"""
DESK, PHONE = {"width": 1280, "height": 900}, {"width": 390, "height": 844}


class Opened:
    """A page in a window."""

    def __init__(self, browser: Any, file: Path, end: str = "", **window: Any) -> None:
        self.context = browser.new_context(viewport=window.pop("viewport", DESK), **window)
        self.context.grant_permissions(["clipboard-read", "clipboard-write"])
        self.window = self.context.new_page()
        self.errors: list[str] = []
        self.window.on("pageerror", lambda error: self.errors.append(str(error)))
        self.window.goto(file.as_uri() + end)

    def shown(self) -> set[str]:
        """Gears of which something is in sight."""
        parts = "[...document.querySelectorAll('div[data-gear]')].filter((one) => !one.hidden)"
        return set(self.window.evaluate(f"{parts}.map((one) => one.dataset.gear)"))

    def names(self, label: str) -> list[str]:
        """The rows of a table."""
        rows = self.window.locator(f'[aria-label="{label}"] tbody th')
        return [str(name) for name in rows.all_text_contents()]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("small")
    made = folder / "out.html"
    made.write_text(report(write(folder, NASTY_CASE)), "utf-8")
    return made


@pytest.fixture
def page(browser: Any, file: Path, request: pytest.FixtureRequest) -> Iterator[Opened]:
    opened = Opened(browser, file, getattr(request, "param", ""))
    yield opened
    assert not opened.errors
    opened.context.close()


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Files of shipped cases, each made when it is asked for."""
    folder = tmp_path_factory.mktemp("shipped")

    class Made(dict[str, Path]):
        def __missing__(self, case: str) -> Path:
            self[case] = folder / f"{case}.html"
            self[case].write_text(report(CASES / case), "utf-8")
            return self[case]

    return Made()


ENCODED = quote(DIRECT, safe="")


@pytest.mark.parametrize(
    ("page", "gear"),
    [("", LOW), (f"#gear={ENCODED}", DIRECT), (f"#flow={ENCODED}", DIRECT)],
    indirect=["page"],
)
def test_the_address_chooses_a_gear(page: Opened, gear: str) -> None:
    assert page.shown() == {gear}
    assert page.window.locator(".chooser [aria-current]").all_text_contents() == [gear]
    assert page.window.locator("tr.chosen th").all_text_contents() == [gear]


@pytest.mark.parametrize("page", ["#gear=99"], indirect=True)
def test_a_gear_that_is_not_there_is_put_right_in_the_address(page: Opened) -> None:
    status = page.window.locator("[role=status]")
    assert page.window.url.endswith(f"#gear={quote(LOW, safe='')}")
    assert status.text_content() == f"There is no gear 99, this is gear {LOW}"
    page.window.keyboard.press("ArrowRight")
    page.window.evaluate("location.hash = '#flow=98%'")
    says = "document.querySelector('[role=status]').textContent"
    page.window.wait_for_function(f"{says}.includes('98%')")
    assert page.shown() == {DIRECT}
    assert page.window.url.endswith(f"#gear={quote(DIRECT, safe=chr(39))}")
    page.window.evaluate("location.hash = '#tables'")
    assert page.window.url.endswith("#tables")


def test_the_bar_tells_the_keys_where_they_work(browser: Any, page: Opened, file: Path) -> None:
    assert "\u2190 \u2192" in page.window.locator(".chooser").inner_text()
    assert "left and right" in (page.window.locator(".chooser").get_attribute("title") or "")
    page.window.emulate_media(media="print")
    assert not page.window.locator(".chooser").is_visible()
    without = Opened(browser, file, java_script_enabled=False)
    assert "\u2190" not in without.window.locator(".chooser").inner_text()
    without.context.close()


def test_keys_step_through_the_gears(page: Opened) -> None:
    for key, gear in (("Left", LOW), ("Right", DIRECT), ("Right", DIRECT), ("Left", LOW)):
        page.window.keyboard.press(f"Arrow{key}")
        assert page.shown() == {gear}
    page.window.keyboard.press("ArrowRight")
    assert page.window.url.endswith(f"#gear={quote(DIRECT, safe=chr(39))}")
    assert page.window.locator("[role=status]").text_content() == f"Gear {DIRECT}"


@pytest.mark.parametrize("case", [TEN_SPEED, POWER_SPLIT, OLD_DECK])
def test_a_narrow_page_has_wide_tables_that_scroll_and_fade(
    browser: Any, reports: dict[str, Path], case: str
) -> None:
    page = Opened(browser, reports[case], viewport=PHONE)
    assert page.window.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    before = page.shown()
    page.window.keyboard.press("Shift+ArrowRight")
    page.window.locator(".scroll[tabindex]").first.focus()
    page.window.keyboard.press("ArrowRight")
    assert page.shown() == before
    for name in (".chooser", "#gears .scroll") if case == TEN_SPEED else ():
        wide = page.window.locator(name)
        assert "more" in (wide.get_attribute("class") or "").split()
        wide.evaluate("(one) => { one.scrollLeft = one.scrollWidth; }")
        page.window.locator(f"{name}:not(.more)").wait_for(state="attached")
    page.context.close()


def test_letters_of_pictures_can_be_read_on_a_phone(browser: Any, reports: dict[str, Path]) -> None:
    page = Opened(browser, reports[TRUCK], viewport=PHONE)
    sizes = page.window.evaluate("""() => [...document.querySelectorAll("figure text")]
      .filter((text) => text.checkVisibility() && text.textContent.trim())
      .map((text) => [text.getScreenCTM(), parseFloat(getComputedStyle(text).fontSize)])
      .map(([{ c, d }, size]) => Math.hypot(c, d) * size)""")
    assert min(sizes) > LEAST_LETTERS
    page.context.close()


def test_headings_of_narrow_tables_are_short_and_aligned_with_their_columns(
    browser: Any, reports: dict[str, Path]
) -> None:
    """At most three lines of 1.45 times 16 px; the first column is aligned like its heading."""
    page = Opened(browser, reports[TRUCK])
    highest = """Math.max(...[...document.querySelectorAll("section.table > h3")]
      .map((head) => head.getBoundingClientRect().height))"""
    assert page.window.evaluate(highest) <= 3 * 1.45 * 16 + 1
    aligned = """[...document.querySelectorAll("main table")].map((table) =>
      ["thead tr:last-child > th:first-child", "tbody th"].map((cell) =>
        getComputedStyle(table.querySelector(cell)).textAlign))"""
    assert all(head == body for head, body in page.window.evaluate(aligned))
    page.context.close()


def test_a_row_of_the_table_chooses_its_gear(page: Opened) -> None:
    rows = page.window.locator("#gears tbody tr")
    rows.nth(1).locator("td").last.click()
    assert page.shown() == {DIRECT}
    rows.nth(0).locator("a").press("Enter")
    assert page.shown() == {LOW}
    page.window.keyboard.press("ArrowRight")
    assert page.shown() == {DIRECT}
    assert page.window.evaluate("document.activeElement.dataset.choose") == DIRECT


def test_what_is_read_stays_where_it_is(browser: Any, reports: dict[str, Path]) -> None:
    """Pictures above it have another height in another gear."""
    page = Opened(browser, reports[POWER_SPLIT])
    top = "document.getElementById('equations').getBoundingClientRect().top"
    page.window.evaluate("document.getElementById('equations').scrollIntoView()")
    before = page.window.evaluate(top)
    page.window.keyboard.press("ArrowRight")
    assert page.window.evaluate(top) == pytest.approx(before, abs=1)
    page.context.close()


def test_a_click_on_a_heading_sorts(page: Opened) -> None:
    """3.5 in the first gear, 1 in the other."""
    button = page.window.locator("#gears th [role=button]", has_text="ratio")
    heading = page.window.locator("#gears th", has_text="ratio")
    for said in ("ascending", "descending", "none"):
        button.click()
        order = [DIRECT, LOW] if said == "ascending" else [LOW, DIRECT]
        assert page.names("Ratios, steps, efficiencies") == order
        assert heading.get_attribute("aria-sort") == said


def test_rows_that_are_set_in_are_sorted_below_their_own(page: Opened) -> None:
    """The ring, the second link, is held: power enters by the first and leaves by the third.

    Of the power that enters u/(u - 1), so less than all, goes through the teeth.
    """
    head = page.window.locator("[id^='flow=']:not([hidden]) th [role=button]").nth(1)
    first, second, third = "first: <b>in</b>", 'second: r"ing', "third: out'"
    as_written = [first, second, third, "teeth"]
    downward = [first, "teeth", second, third]
    for order in (as_written, downward[::-1], downward, as_written):
        names = page.names(f"Power in gear {LOW}")
        assert names == ["links", "<b>in</b>", "out'", "mechanisms", "D&", *order]
        head.click()


def test_a_table_is_copied_with_all_digits(page: Opened) -> None:
    copy = "[aria-label^='Copy CSV: Torques without losses'][aria-label$='[torques]']"
    page.window.locator(copy).click()
    copied = page.window.evaluate("navigator.clipboard.readText()")
    head, *rows = csv.reader(io.StringIO(copied))
    assert head == ["torque of", LOW, DIRECT]
    shown = {name: [float(cell) if cell else None for cell in row] for name, *row in rows}
    result = json.loads(page.window.locator("#result").text_content() or "")
    said = dict(zip(shown, result["torques"], strict=True))
    said["<C>"][0] = said["B"][1] = None  # what is open is blank
    assert shown == said
    assert "\u2212" not in copied
    assert any(cell < 0 for row in shown.values() for cell in row if cell is not None)


def test_engaged_without_torque_is_0_in_the_copy_and_open_is_blank(
    browser: Any, reports: dict[str, Path]
) -> None:
    """Ford 10R80, gear 1: A, B, D, E are engaged, D carries nothing; C and F are open."""
    page = Opened(browser, reports[TEN_SPEED])
    page.window.locator("[aria-label^='Copy CSV: Torques without losses']").first.click()
    copied = csv.reader(io.StringIO(page.window.evaluate("navigator.clipboard.readText()")))
    first = {name: gears[0] for name, *gears in copied}
    assert {name: first[name] for name in "CFD"} == {"C": "", "F": "", "D": "0"}
    assert float(first["A"]) != 0
    page.context.close()


@pytest.mark.parametrize("case", [TEN_SPEED, POWER_SPLIT, OLD_DECK])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_serious_fault_of_accessibility(
    browser: Any, reports: dict[str, Path], case: str, scheme: str
) -> None:
    """By the rules of axe-core."""
    page = Opened(browser, reports[case], color_scheme=scheme)
    assert not serious_faults(page.window)
    page.context.close()


def test_an_equation_that_is_wrapped_goes_on_below_itself(
    browser: Any, reports: dict[str, Path]
) -> None:
    """Not below the names of the links, where it would read as that of another link."""
    page = Opened(browser, reports[TEN_SPEED], "#gear=2", viewport=PHONE)
    [left, starts] = page.window.evaluate("""() => {
      const lines = [...document.querySelectorAll("[id='equations=2'] pre span:not(.whole)")];
      const boxes = lines.map((line) => {
        const text = document.createRange();
        text.selectNodeContents(line);
        const rows = [...text.getClientRects()].filter((one) => one.width > 0);
        return rows.map((one) => one.left);
      });
      return [boxes[0][0], boxes.flatMap((own) => own.slice(1))];
    }""")
    assert starts
    assert min(starts) > left + 60  # more than a dozen letters
    page.context.close()


@pytest.mark.parametrize("media", ["screen", "print"])
def test_what_is_muted_is_no_larger_than_what_it_belongs_to(
    browser: Any, reports: dict[str, Path], media: str
) -> None:
    page = Opened(browser, reports[TEN_SPEED])
    page.window.emulate_media(media=media)
    size = "parseFloat(getComputedStyle(one).fontSize)"
    found = {
        name: page.window.evaluate(f"Math.{end}(...[...document.querySelectorAll('{name}')].map((one) => {size}))")
        for name, end in (
            (".source", "max"), (".told:not(.source)", "min"), (".overview dt", "max"),
            (".overview dd", "min"), (".explained .note", "max"), (".explained h4", "min"),
            ("p.note", "max"), ("body", "min"), ("h2", "max"), ("h1", "min"),
        )
    }  # fmt: skip
    sizes = list(found.values())
    assert all(one <= other for one, other in zip(sizes[::2], sizes[1::2], strict=True)), found
    page.context.close()


@pytest.mark.parametrize("case", [TEN_SPEED, POWER_SPLIT, OLD_DECK])
def test_print_has_numbers_a_running_title_and_no_page_of_headings_only(
    browser: Any, reports: dict[str, Path], case: str
) -> None:
    pypdf = pytest.importorskip("pypdf")
    page = Opened(browser, reports[case])
    title = page.window.title()
    heads = {text.strip() for text in page.window.locator("h1, h2, h3, h4").all_text_contents()}
    printed = pypdf.PdfReader(io.BytesIO(page.window.pdf(prefer_css_page_size=True))).pages
    page.context.close()
    for number, sheet in enumerate(printed, 1):
        lines = [line.strip() for line in sheet.extract_text().splitlines() if line.strip()]
        assert title in lines
        assert f"{number} / {len(printed)}" in lines
        rest = [line for line in lines if line not in (title, f"{number} / {len(printed)}")]
        assert [line for line in rest if line not in heads], rest
        assert rest[-1] not in heads
