"""A number that is typed into a field of a page, as people write it in their language."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.accessibility import serious_faults
from vstatics import loads, solve
from vstatics.report import gather
from vstatics.report.live.page import OUTSIDE, live_page
from vstatics.texts import speaking, table

SET = """\
links: [sun, ring, carrier]
load: {speed: 3000 rpm, torque: 100 N*m}
mechanisms: {P: {first: sun, second: ring, third: carrier, ratio: -4, efficiency: .97}}
shift_elements: {B: [ring, housing]}
gears: {low: [B]}
"""
"""Its ring is held: the ratio between sun and carrier is 1 - u."""
FIELD = 'input.field[data-path="P.ratio"]'


@pytest.fixture(params=["de"])
def page(browser: Any, request: pytest.FixtureRequest, without_pictures: None) -> Iterator[Any]:
    """The page in a language, in a browser of that language."""
    del without_pictures
    with speaking(request.param):
        made = live_page(gather(solve(loads(SET)), has_marks=True))
    context = browser.new_context(locale=request.param)
    window = context.new_page()
    window.on("pageerror", lambda error: pytest.fail(str(error)))
    window.set_content(made)
    yield window
    context.close()


def ratio(page: Any) -> float:
    cell = page.locator('td[data-result="ratio"]').first
    return float(cell.get_attribute("data-number") or "nan")


def typed(page: Any, text: str, field: str = FIELD) -> None:
    """By keys, in place of what stands there."""
    page.locator(field).press("Control+A")
    page.keyboard.press("Delete")
    page.keyboard.type(text)


@pytest.mark.parametrize("page", ["en", "de", "ru"], indirect=True)
def test_a_comma_is_the_decimal_point_in_every_language(page: Any) -> None:
    texts = {"-2,6": -2.6, "-2.6": -2.6, "\u22123,25": -3.25, "\u2013,5": -0.5, " -1e1 ": -10.0}
    for text, u in texts.items():
        typed(page, text)
        assert ratio(page) == pytest.approx(1 - u, rel=1e-12), text
        page.keyboard.press("Tab")
        assert float(page.input_value(FIELD)) == u  # shows what was read
    assert page.locator(".unread").count() == 0


def test_what_is_no_number_is_told_at_its_field_and_changes_nothing(page: Any) -> None:
    for text in ("-2,6,1", "-1,000.5", "", "3e", "1e999", "two"):
        typed(page, "-3")
        page.keyboard.press("Tab")
        typed(page, text)
        page.keyboard.press("Tab")
        assert ratio(page) == pytest.approx(4), text
        assert page.input_value(FIELD) == text
        note = page.locator(f'[id="{page.get_attribute(FIELD, "aria-describedby")}"]')
        assert "-3" in note.inner_text()
        assert page.get_attribute(FIELD, "aria-invalid") == "true"
    assert not serious_faults(page)
    typed(page, "-3,5")
    assert ratio(page) == pytest.approx(4.5)
    assert page.locator(".unread").count() == 0
    typed(page, "x")
    page.locator("#revert").click()
    assert page.input_value(FIELD) == "-4"
    assert page.locator(".unread").count() == 0


def test_a_number_that_no_case_can_have_is_told_in_the_language(page: Any) -> None:
    typed(page, "1,2", FIELD.replace("ratio", "efficiency"))
    told = page.locator("#outside").inner_text(), page.locator("#why-outside").inner_text()
    assert told[0] == table("de")[OUTSIDE]
    assert told[1].startswith("P Wirkungsgrad = 1.2: erwartet eine Zahl über 0")
    page.locator("#revert").click()


def test_the_keys_up_and_down_change_a_field(page: Any) -> None:
    """There and back, by a step that suits it; what is pasted is read, too."""
    before = ratio(page)
    for key, change in (("ArrowUp", -0.1), ("ArrowDown", 0.0), ("ArrowDown", 0.1)):
        page.locator(FIELD).press(key)
        assert ratio(page) == pytest.approx(before + change, abs=1e-12)
    page.locator(FIELD).press("Control+A")
    page.keyboard.insert_text("-5,5")
    assert ratio(page) == pytest.approx(6.5)
    page.locator("#revert").click()
    assert ratio(page) == before == 5
