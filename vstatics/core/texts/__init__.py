"""The texts of this program in other languages; English ones stand where they are said.

`tr` gives a text in the language that is spoken just then, which `speaking` chooses. The English
text is the key of `table.txt`, which has it in every other language. Numbers and names stand in
named places, so that each language orders its words itself. What has no row stays English.

>>> with speaking("ru"):
...     tr("efficiency"), tr("Gear {gear}", gear="R")
('КПД', 'Передача R')
>>> tr("efficiency"), tr("Gear {gear}", gear="R")
('efficiency', 'Gear R')
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib import resources
from typing import Literal

Language = Literal["en", "ru"]

_SPOKEN: ContextVar[Language] = ContextVar("language", default="en")
FORMS = "|"
"""Stands between the forms of a text for one, for several, and in Russian for many."""


@contextmanager
def speaking(language: Language) -> Iterator[None]:
    """Texts that are made within are in a language; those made later are not."""
    before = _SPOKEN.set(language)
    try:
        yield
    finally:
        _SPOKEN.reset(before)


def spoken() -> Language:
    """The language of `tr`."""
    return _SPOKEN.get()


def tr(text: str, /, **places: object) -> str:
    """A text in the language that is spoken.

    Parameters
    ----------
    text : str
        In English. One that depends on a number has its forms, by `count`.
    **places
        What stands in its places.

    Examples
    --------
    >>> tr("{count} warning|{count} warnings", count=2)
    '2 warnings'
    >>> with speaking("ru"):
    ...     [tr("{count} warning|{count} warnings", count=count) for count in (1, 22, 5)]
    ['1 предупреждение', '22 предупреждения', '5 предупреждений']
    """
    return translated(text, _SPOKEN.get(), **places)


def translated(text: str, /, language: Language, **places: object) -> str:
    """A text in a language; see `tr`.

    >>> translated("efficiency", "ru")
    'КПД'
    """
    found = text if language == "en" else table(language).get(text, text)
    if not places:
        return found
    count = places.get("count")
    if isinstance(count, int):
        forms = found.split(FORMS)
        found = forms[min(_form(count, language), len(forms) - 1)]
    return found.format(**places)


def _form(count: int, language: Language) -> int:
    """Which form of a text suits a number."""
    if language != "ru":
        return int(count != 1)
    if count % 10 == 1 and count % 100 != 11:
        return 0
    return 1 if count % 10 in (2, 3, 4) and count % 100 not in (12, 13, 14) else 2


_IN_BRACKETS = re.compile(r"(.+) \[(.+)\]")


def heading(text: str) -> str:
    """What heads a column, whose unit stands behind it.

    >>> with speaking("ru"):
    ...     heading("speed, rpm"), heading("time [s]"), heading("efficiency")
    ('скорость, об/мин', 'время [с]', 'КПД')
    """
    language = _SPOKEN.get()
    if language == "en" or text in table(language):
        return tr(text)
    if found := _IN_BRACKETS.fullmatch(text):
        return f"{heading(found[1])} [{tr(found[2])}]"
    name, comma, unit = text.rpartition(", ")
    return f"{heading(name)}, {tr(unit)}" if comma else tr(text)


def title(text: str) -> str:
    """What stands over a table; a key behind it, as JSON has it, is of no language.

    >>> with speaking("ru"):
    ...     title("Power lost in the mechanisms [losses]")
    'Потери мощности в механизмах [losses]'
    """
    found = _IN_BRACKETS.fullmatch(text)
    if found is None or text in table(_SPOKEN.get()):
        return heading(text)
    return f"{heading(found[1])} [{found[2]}]"


def labelled(text: str) -> str:
    """A text, or one before a name: only what stands before the colon is of the language.

    >>> with speaking("ru"):
    ...     labelled("sun: ring"), labelled("lost: meshes")
    ('солнечная шестерня: ring', 'потери: зацепления')
    """
    if _SPOKEN.get() == "en" or text in table(_SPOKEN.get()):
        return tr(text)
    label, colon, rest = text.partition(": ")
    return f"{tr(label)}{colon}{rest}"


@cache
def table(language: Language) -> Mapping[str, str]:
    """All texts in a language, by the English ones."""
    return {row["en"]: row[language] for row in rows()}


@cache
def rows() -> list[dict[str, str]]:
    """The rows of the table, each a text in every language; a new line in one is told by \\n."""
    source = resources.files(__package__).joinpath("table.txt").read_text(encoding="utf-8")
    kept = "\n".join(line for line in source.splitlines() if not line.startswith("#"))
    return [_row(block) for block in kept.split("\n\n") if block.strip()]


def _row(block: str) -> dict[str, str]:
    said = (line.partition(": ") for line in block.strip("\n").splitlines())
    return {language: text.replace(r"\n", "\n") for language, _, text in said}
