"""What a page shows while sliders have moved follows them, or is pale."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, vstatics

STALE = r"""([path, value]) => {
  const slider = document.querySelector(`input.slider[data-path="${path}"]`);
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  const texts = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const followers = "script, style, svg, #change, #input dl, [data-result]:not([data-result=events], [data-result=frequencies])";
  const stale = [];
  for (let text = texts.nextNode(); text; text = texts.nextNode()) {
    const one = text.parentElement;
    if (!/\d\.\d/.test(text.data) || one.closest(followers)) continue;
    let shown = one.checkVisibility() ? 1 : 0;
    for (let up = one; up; up = up.parentElement) shown *= Number(getComputedStyle(up).opacity);
    if (shown > 0.9) stale.push(`${one.closest("section[id]").id}: ${text.data.trim()}`);
  }
  return stale;
}"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "path", "value"),
    [
        ("zf-8hp70", "P4.teeth.ring", 100),
        ("driveline-8hp70", "P4.teeth.ring", 100),
        ("scenarios/tarasik-set-lock", "set.ratio", -1.4),
    ],
)
def test_no_number_is_shown_as_if_it_followed(
    browser: Any, tmp_path: Path, name: str, path: str, value: float
) -> None:
    made = tmp_path / "live.html"
    assert vstatics("report", CASES / f"{name}.yaml", "--live", "-o", made).status <= 1
    page = browser.new_page()
    page.goto(made.as_uri())
    assert page.locator("#revert").is_hidden()
    assert page.evaluate(STALE, [path, value]) == []
    assert page.locator("#revert").is_visible()
