"""What a page shows while sliders have moved follows them, or is pale."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, vstatics

STALE = r"""() => {
  const slider = document.querySelector('input.slider[data-path="P4.teeth.ring"]');
  slider.value = 100;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  const texts = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const stale = [];
  for (let text = texts.nextNode(); text; text = texts.nextNode()) {
    const one = text.parentElement;
    if (!/\d\.\d/.test(text.data) || one.closest("script, style, svg, #change, [data-result]")) continue;
    let shown = one.checkVisibility() ? 1 : 0;
    for (let up = one; up; up = up.parentElement) shown *= Number(getComputedStyle(up).opacity);
    if (shown > 0.9) stale.push(`${one.closest("section[id]").id}: ${text.data.trim()}`);
  }
  return stale;
}"""


@pytest.mark.slow
def test_no_number_is_shown_as_if_it_followed(browser: Any, tmp_path: Path) -> None:
    made = tmp_path / "live.html"
    assert vstatics("report", CASES / "zf-8hp70.yaml", "--live", "-o", made).status == 0
    page = browser.new_page()
    page.goto(made.as_uri())
    assert page.evaluate(STALE) == []
