"""Options that hold several values: `5,7`, or by names: `shaft=.03,damper=.2`."""

from __future__ import annotations

import re
from collections.abc import Iterable

_ITEM = re.compile(r'\s*(?:"(?P<quoted>(?:[^"]|"")+)"\s*|(?P<name>[^",=][^,=]*))=(?P<value>[^,=]*)')
"""A name with its value; a name in double quotes may have commas in it."""


def separated(texts: Iterable[str]) -> list[str]:
    """The values of an option that is given several times, or holds commas.

    >>> separated(["5, 7", "6"])
    ['5', '7', '6']
    """
    return [one.strip() for text in texts for one in text.split(",")]


def named_values(text: str, expected: str = "NAME=NUMBER") -> list[tuple[str, str]]:
    """Names with their values, between which commas stand.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> named_values('shaft=.03, "a, b"=.2')
    [('shaft', '.03'), ('a, b', '.2')]
    """
    found = []
    at = 0
    while at <= len(text):
        item = _ITEM.match(text, at)
        if item is None or text[item.end() : item.end() + 1] not in ("", ","):
            message = f"read {text[at : at + 40]!r}, expected {expected} with commas between"
            raise ValueError(f"{message}; a name with commas in double quotes: '\"a, b\"=.2'")
        quoted = item["quoted"]
        name = quoted.replace('""', '"') if quoted else item["name"].strip()
        found.append((name, item["value"].strip()))
        at = item.end() + 1
    return found
