"""A page that follows its file is, number by number, the one that is made anew of that file."""

import random
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES
from tests.page.serve.windows import Program, Window

pytestmark = pytest.mark.slow
SHOWN = """[...document.querySelectorAll("main :is(h2, h3, th, td, dd, li, p, [data-of-case])")]
  .filter((one) => !one.closest("#change, [data-awaited]"))
  .map((one) => [one.localName, one.textContent, one.className.replace("chosen", ""),
    ...["result", "row", "gear", "number", "value", "links", "unit", "scaled", "ofCase", "repeats"]
      .map((name) => one.dataset[name])])"""


def test_a_page_that_follows_its_file_is_as_one_that_is_made_anew(
    browser: Any, tmp_path: Path
) -> None:
    """Numbers; then a load that comes and goes, units: what is patched, and what can not be."""
    file = tmp_path / "ford-10r80.yaml"
    shutil.copy(CASES / file.name, file)
    text = file.read_text("utf-8")
    load = "load: {{speed: {} rpm, torque: 300 N*m}}\n"
    program = Program(file)
    here = Window(browser, program)
    here.page.wait_for_timeout(1500)
    here.page.evaluate("window.cell = document.querySelector('#tables td[data-result]')")

    def is_as_new(text: str, units: str = "relative") -> None:
        revision = here.page.get_attribute("html", "data-revision")
        file.write_text(text, "utf-8")
        here.until(f"document.documentElement.dataset.revision > {revision}")
        here.page.wait_for_selector("html[data-ready]")
        here.page.select_option("#units", units)
        new = Window(browser, program)
        new.page.select_option("#units", units)
        assert here.page.evaluate(SHOWN) == new.page.evaluate(SHOWN)
        new.context.close()

    for sun in random.Random(31).sample(range(40, 50), 3):  # noqa: S311 - no secret
        is_as_new(text.replace("sun: 45", f"sun: {sun}"))
        assert here.page.evaluate("window.cell?.isConnected")  # where they were
    is_as_new(text + load.format(2000))
    is_as_new(text + load.format(2500), "si")
    is_as_new(text.replace("sun: 45", "sun: 46") + load.format(2500), "si")
    is_as_new(text)
    here.context.close()
