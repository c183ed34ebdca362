"""Pages in another language have no English words but those of the case."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.chance import with_slow
from tests.commands import CASES, vstatics
from tests.core.texts.test_pages import SHOWN, left, names, of_case, words_of
from tests.page.serve.windows import Program, Window
from vstatics.core.texts import table

OTHERS = """zf-8hp70 toyota-p410 driveline-8hp70 ford-10r80 scenarios/tarasik-box moskvich412
scenarios/moskvich-start self-locking power-split wheel-hub ravigneaux-gf4a"""


def document_of(page: str) -> dict[str, Any]:
    found = re.search(r'<script type="application/json" id="result">(.*?)</script>', page)
    assert found
    made: dict[str, Any] = json.loads(found[1])
    return made


def page_of(case: str, *options: str) -> str:
    return vstatics("report", case, *options, "-o", "-", "-q").out


@pytest.mark.parametrize(
    "case", with_slow([SHOWN], (CASES / f"{name}.yaml" for name in OTHERS.split()))
)
def test_a_page_has_no_english_words(case: object) -> None:
    page = page_of(str(case), "--lang", "ru")
    assert '<html lang="ru">' in page
    assert left(words_of(page), of_case(document_of(page))) == set()


def test_a_page_of_two_cases_has_no_english_words() -> None:
    both = SHOWN, str(CASES / "zf-8hp70.yaml")
    page = vstatics("report", *both, "--lang", "ru", "-o", "-", "-q").out
    sides = document_of(page).values()
    known = {*names([side["file"] for side in sides])}.union(*map(of_case, sides))
    assert left(words_of(page), known) == set()


SAID = """() => {
  for (const one of document.querySelectorAll("script:not(#result)")) one.remove();
  return document.documentElement.outerHTML;
}"""


@pytest.mark.slow
def test_a_page_that_is_served_has_no_english_words(browser: Any, tmp_path: Path) -> None:
    """Nor do a picture that came later and a state that was shown in its place; errors stay."""
    file = Path(shutil.copy(SHOWN, tmp_path))
    running = Program(file, "serve", "--lang", "ru")
    here = Window(browser, running)
    here.until("document.querySelector('[data-awaited]:not(.pale) svg')")
    text = file.read_text("utf-8")
    file.write_text(text.replace("-73/35", "-74/35", 1), "utf-8")
    here.until("document.documentElement.dataset.revision > 1")
    assert here.page.locator("main [data-changed]").count() > 0
    here.page.evaluate("document.getElementById('equations').scrollIntoView()")
    here.until("document.querySelector('#equations [data-awaited]:not(.pale) pre')")
    file.write_text(text.replace("gears:", "gaers:"), "utf-8")
    here.state("error")
    assert "simpson.yaml:" in (told := here.page.inner_text("#errors"))
    assert "error: unknown" in told
    here.page.evaluate("document.getElementById('errors').textContent = ''")
    page = here.page.evaluate(SAID)
    assert not here.errors
    here.context.close()
    assert running.end() == (0, "")
    said = words_of(page)
    assert {"Сохранить", "Взять файл"} <= {*said.split("\n")}
    assert left(said, of_case(document_of(page))) == set()


def test_a_page_says_the_same_with_other_words() -> None:
    english, page = page_of(SHOWN), page_of(SHOWN, "--lang", "ru")
    assert document_of(page) == document_of(english)
    for kept in (r' id="[^"]*"', r' href="[^"]*"', r'data-value="[^"]*"', r'data-gear="[^"]*"'):
        assert set(re.findall(kept, page)) == set(re.findall(kept, english)), kept
    english_lines, lines = ({*words_of(one).split("\n")} for one in (english, page))
    said = {row for row, other in table("ru").items() if row != other}
    known = of_case(document_of(page))
    both = {one for one in english_lines & lines & said if left(one, known)}
    assert both == set()


def test_names_that_are_english_words_stay(tmp_path: Path) -> None:
    case = tmp_path / "names.yaml"
    case.write_text(
        "links: [input, speed, output]\nload: {speed: 1000 rpm}\n"
        "shift_elements: {brake: [speed, housing], clutch: [input, speed]}\n"
        "mechanisms: {Gears: {first: input, second: speed, third: output, ratio: -2}}\n"
        "gears: {ratio: [brake], efficiency: [clutch]}\n"
    )
    for command, *more in (("run", "--pretty"), ("summary",), ("explain",), ("report", "-o", "-")):
        made = vstatics(command, case, "--lang", "ru", *more).out
        text = words_of(made) if command == "report" else made
        for name in ("output", "Gears", "ratio"):
            assert re.search(rf"\b{name}\b", text), (command, name)
        if command == "summary":
            assert re.search(r"(?m)^ratio +3\.000 +efficiency", text)
            assert "тормоз" not in text
