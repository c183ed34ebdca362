"""The glossary has the words that the program says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from vstatics.core.texts import rows

GLOSSARY = Path(__file__).parents[3] / "docs" / "glossary.md"


def cells() -> Iterator[dict[str, str]]:
    """The first word of each language, by row."""
    for line in GLOSSARY.read_text(encoding="utf-8").splitlines():
        row = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(row) == 3 and row[0] not in {"English", "---"}:
            words = (cell.partition(",")[0].lower() for cell in row[:2])
            yield dict(zip(("en", "ru"), words, strict=True))


def test_the_first_word_of_a_cell_is_the_one_that_the_program_says() -> None:
    """Four terms are of documents alone."""
    said: dict[str, set[str]] = {}
    for row in rows():
        said.setdefault(row["en"].lower(), set()).add(row["ru"].lower())
    terms = list(cells())
    for term in terms:
        known = said.get(term["en"])
        assert known is None or term["ru"] in known, term
    foreign = {term["en"] for term in terms if term["en"] not in said}
    assert foreign == {"willis equation", "sensitivity", "rolling power", "coupling power"}


def test_a_term_has_one_row_and_two_languages() -> None:
    terms = list(cells())
    assert all(all(term.values()) for term in terms)
    assert len({term["en"] for term in terms}) == len(terms)
    for term in terms:
        assert re.search("[а-яё]|кпд", term["ru"]), term
