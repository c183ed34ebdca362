"""Options that hold several values: `5,7`, or by names: `shaft=.03,damper=.2`."""

from __future__ import annotations

import re
from collections.abc import Iterable

_ITEM = re.compile(r'\s*(?:"(?P<quoted>(?:[^"]|"")+)"\s*|(?P<name>[^",=][^,=]*))=(?P<value>[^,=]*)')
"""A name with its value; a name in double quotes may have commas in it."""


_ALONE = re.compile(r'\s*(?:"(?P<quoted>(?:[^"]|"")+)"\s*(?=,|\Z)|(?P<name>[^,]*))')
"""A value without a name; one in double quotes may have commas in it."""


def separated(texts: Iterable[str]) -> list[str]:
    """The values of an option that is given several times, or holds commas.

    >>> separated(["5, 7", "6"]), separated(['F1, "a, b" ,"c"d,'])
    (['5', '7', '6'], ['F1', 'a, b', '"c"d', ''])
    """
    found = []
    for text in texts:
        at = 0
        while at <= len(text):
            item = _ALONE.match(text, at)
            assert item is not None  # noqa: S101 - for mypy: a name may be empty here
            found.append(_unquoted(item["quoted"]) or item["name"].strip())
            at = item.end() + 1
    return found


def _unquoted(quoted: str | None) -> str:
    """A name without its double quotes; two of them in it are one."""
    return (quoted or "").replace('""', '"')


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
        name = _unquoted(item["quoted"]) or item["name"].strip()
        found.append((name, item["value"].strip()))
        at = item.end() + 1
    return found
