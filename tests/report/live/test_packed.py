"""A page that was packed is the same page once it is open, and small enough to be sent."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from tests.commands import CASES
from tests.report.live.test_core import SHIPPED
from tests.report.pages import report
from vstatics.report.live.packed import packed

MAIN = "document.querySelector('main').outerHTML"
MOST = 700_000
SCENARIOS = sorted(f"scenarios/{one.name}" for one in (CASES / "scenarios").glob("*.yaml"))


def _content(chance: Random, long: int) -> str:
    """Words of any letters, some of which come again, near and far."""
    words = ["".join(chance.choices("abc\u03c9\u4e2d\U0001f600 ", k=chance.randint(1, 90)))]
    while sum(map(len, words)) < long:
        word = "".join(chr(chance.choice([chance.randint(97, 122), chance.randint(200, 9000)])))
        words.append(chance.choice([word * chance.randint(1, 40), *chance.sample(words, 1)]))
    return "".join(words)


def test_a_packed_page_opens_as_the_page_that_it_was(browser: Any) -> None:
    """Long texts and short ones, repetitions, letters of any size."""
    chance = Random(31)  # noqa: S311
    window = browser.new_page()
    for sizes in ((0, 1, 5), (300, 70_000, 40), (120_000,)):
        sections = "".join(
            f'<section id="s{n}"><h2>S{n}</h2><p>{_content(chance, long)}</p></section>'
            for n, long in enumerate(sizes)
        )
        page = f"<!DOCTYPE html><body><main>{sections}</main></body>"
        window.set_content(page)
        expected = window.evaluate(MAIN)
        small = packed(page, frozenset({"s1"}))
        window.set_content(small)
        assert window.evaluate(MAIN) == expected
    assert len(small) < len(page) / 2
    window.close()


@pytest.mark.slow
@pytest.mark.parametrize("name", [*SHIPPED, *SCENARIOS])
def test_the_page_of_all_that_is_shipped_has_less_than_700_kilobytes(name: str) -> None:
    size = len(report(CASES / name, "--live").encode())
    assert size < MOST, size
