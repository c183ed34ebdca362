"""The pages that calculate, for whoever has no mouse, another sight, or a narrow window."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.accessibility import serious_faults
from tests.commands import CASES
from tests.page.serve.served import BOX
from tests.page.serve.windows import Program, Window, looked_through, served

pytestmark = pytest.mark.slow
SERVED = "moskvich412.yaml", "mzkt7922.dat", "scenarios/tarasik-set-lock.yaml"
PHONE = {"width": 390, "height": 844}


@pytest.fixture(params=SERVED)
def shipped(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    copy: Path = shutil.copytree(CASES, tmp_path / "cases") / request.param
    return copy


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_served_page_has_no_serious_fault_whatever_it_shows(
    browser: Any, shipped: Path, scheme: str
) -> None:
    here = Window(browser, Program(shipped), color_scheme=scheme)
    looked_through(here)
    assert not serious_faults(here.page)
    text = shipped.read_bytes()
    if here.page.locator("input.field:enabled").count():
        field = here.page.locator("input.field:enabled").first
        field.fill(str(float(field.input_value()) + 1))
        here.until("!document.getElementById('save').hidden")
        looked_through(here)
        assert not serious_faults(here.page)
        shipped.write_bytes(text + b"# by somebody else\n")
        here.state("conflict")
        assert not serious_faults(here.page)
        here.page.click("#take-file")
    shipped.write_bytes(b"no case\n")
    here.state("error")
    assert not serious_faults(here.page)
    here.context.close()


def test_a_served_page_fits_a_telephone(browser: Any, shipped: Path) -> None:
    here = Window(browser, Program(shipped), viewport=PHONE)
    width = "document.documentElement.scrollWidth"
    looked_through(here)
    assert here.page.evaluate(width) <= PHONE["width"]
    shipped.write_bytes(b"an: error of a line that is longer than a telephone is wide; " * 9)
    here.state("error")
    assert here.page.evaluate(width) <= PHONE["width"]
    here.context.close()


def test_fields_continue_below_and_do_not_exceed_the_width(browser: Any, tmp_path: Path) -> None:
    copy: Path = shutil.copytree(CASES, tmp_path / "cases") / "scenarios" / "8hp70-upshift.yaml"
    with served(browser, copy) as here:
        for size in ({"width": 1280, "height": 900}, PHONE):
            here.page.set_viewport_size(size)
            [own, all_] = here.page.evaluate(
                "(({ clientWidth, scrollWidth }) => [clientWidth, scrollWidth])"
                "(document.querySelector('.fields'))"
            )
            assert all_ <= own


def test_an_error_does_not_cover_the_field_with_the_focus(window: Callable[[], Window]) -> None:
    here = window()
    here.page.set_viewport_size({"width": 390, "height": 500})
    field = "document.querySelector('input.field[data-path=\"P1.efficiency\"]')"
    here.page.evaluate(f"{field}.focus({{ preventScroll: true }})")
    here.page.evaluate(f"{field}.scrollIntoView({{ block: 'end' }})")
    here.page.keyboard.type("7")
    here.state("error")
    top = "document.getElementById('panel').getBoundingClientRect().top"
    here.until(f"{field}.getBoundingClientRect().bottom <= {top}")


def test_all_can_be_done_by_keys(program: Program, window: Callable[[], Window]) -> None:
    here = window()
    keys = here.page.keyboard

    def to(selector: str, key: str = "Tab") -> None:
        """Tab until something has the focus."""
        for _ in range(200):
            if here.page.evaluate(f"document.activeElement.matches('{selector}')"):
                style = "getComputedStyle(document.activeElement)"
                assert here.page.evaluate(f"{style}.outlineStyle") != "none"
                return
            keys.press(key)
        pytest.fail(f"no key leads to {selector}")

    to('input.slider[data-path="P1.efficiency"]')
    keys.press("ArrowLeft")
    here.until("!document.getElementById('save').hidden")
    value = float(here.field("P1.efficiency"))
    assert value < 0.97
    to("#save", "Shift+Tab")
    keys.press("Enter")
    here.until("document.getElementById('save').hidden")
    saved = program.file.read_text("utf-8")
    assert saved == BOX.replace("0.97", str(value))
    to("#undo")
    keys.press("Space")
    here.until("!document.getElementById('save').hidden")
    assert float(here.field("P1.efficiency")) == 0.97
    to("#revert", "Shift+Tab")
    keys.press("Enter")
    here.until("document.getElementById('save').hidden")
    assert float(here.field("P1.efficiency")) == value
    program.file.write_text(BOX, "utf-8")
    field = "document.querySelector('input.field[data-path=\"P1.efficiency\"]')"
    here.until(f"{field}.value === '0.97'")
