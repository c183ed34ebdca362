"""Translation of the program's texts. The code contains the English texts.

`tr` returns a text in the current language, which `speaking` selects. The file `table.txt` contains
a row with the translations of each English text. Texts contain named fields for numbers and names,
because word order depends on the language. A text without a row stays English.

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
from typing import Literal

Language = Literal["en", "ru"]

_SPOKEN: ContextVar[Language] = ContextVar("language", default="en")
FORMS = "|"
"""Separator between the singular and plural forms of a text. Russian has two plural forms."""


@contextmanager
def speaking(language: Language) -> Iterator[None]:
    """Run the block with all texts translated into a language."""
    before = _SPOKEN.set(language)
    try:
        yield
    finally:
        _SPOKEN.reset(before)


def spoken() -> Language:
    """Return the current language."""
    return _SPOKEN.get()


def tr(text: str, /, **places: object) -> str:
    """Return a text in the current language.

    Parameters
    ----------
    text : str
        English text, with its forms separated by `FORMS` if it depends on a number `count`.
    **places
        Values of the named fields.

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
    """Return a text in any language; see `tr`.

    >>> translated("efficiency", "ru")
    'КПД'
    """
    chosen = text if language == "en" else table(language).get(text, text)
    if not places:
        return chosen
    count = places.get("count")
    if isinstance(count, int):
        forms = chosen.split(FORMS)
        chosen = forms[min(_form(count, language), len(forms) - 1)]
    return chosen.format(**places)


def _form(count: int, language: Language) -> int:
    """Return the index of the grammatical form for a number."""
    if language != "ru":
        return int(count != 1)
    if count % 10 == 1 and count % 100 != 11:
        return 0
    return 1 if count % 10 in (2, 3, 4) and count % 100 not in (12, 13, 14) else 2


_IN_BRACKETS = r"(.+) \[(.+)\]"


def heading(text: str) -> str:
    """Return the translated heading of a column, which can end with a unit.

    >>> with speaking("ru"):
    ...     heading("speed, rpm"), heading("time [s]"), heading("efficiency")
    ('скорость, об/мин', 'время [с]', 'КПД')
    """
    language = _SPOKEN.get()
    if language == "en":
        return text
    if text in table(language):
        return tr(text)
    if parts := re.fullmatch(_IN_BRACKETS, text):
        return f"{heading(parts[1])} [{tr(parts[2])}]"
    name, comma, unit = text.rpartition(", ")
    return f"{heading(name)}, {tr(unit)}" if comma else tr(text)


def title(text: str) -> str:
    """Return the translated title of a table, except a JSON key in brackets at the end.

    >>> with speaking("ru"):
    ...     title("Power lost in the mechanisms [losses]")
    'Потери мощности в механизмах [losses]'
    """
    parts = re.fullmatch(_IN_BRACKETS, text)
    if parts is None or text in table(_SPOKEN.get()):
        return heading(text)
    return f"{heading(parts[1])} [{parts[2]}]"


def labelled(text: str) -> str:
    """Return a translated text; if unknown, only the label before the colon is translated.

    >>> with speaking("ru"):
    ...     labelled("sun: ring"), labelled("lost: meshes")
    ('солнечная шестерня: ring', 'потери: зацепления')
    """
    if _SPOKEN.get() == "en" or text in table(_SPOKEN.get()):
        return tr(text)
    label, colon, name = text.partition(": ")
    return f"{tr(label)}{colon}{name}"


@cache
def table(language: Language) -> Mapping[str, str]:
    """Return the translations into a language, by English text."""
    return {row["en"]: row[language] for row in rows()}


@cache
def rows() -> list[dict[str, str]]:
    """Return the rows of the table: a text in each language, in which \\n stands for a new line."""
    from importlib import resources  # costs start-up time

    source = resources.files(__package__).joinpath("table.txt").read_text(encoding="utf-8")
    text = "\n".join(line for line in source.splitlines() if not line.startswith("#"))
    return [_row(block) for block in text.split("\n\n") if block.strip()]


def _row(block: str) -> dict[str, str]:
    said = (line.partition(": ") for line in block.strip("\n").splitlines())
    return {language: text.replace(r"\n", "\n") for language, _, text in said}
