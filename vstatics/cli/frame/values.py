"""Values of options: several with commas, by names, pairs, calculations such as 73/35."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

import click

from vstatics.errors import CaseError, quoted
from vstatics.readers.named.scalars import number

Value = TypeVar("Value")


def pair(text: str, example: str = "-4:-1.5") -> tuple[float, float]:
    """Both bounds, or the one number that both are.

    Raises
    ------
    ValueError

    Examples
    --------
    >>> pair("-4:-1.5"), pair("-2")
    ((-4.0, -1.5), (-2.0, -2.0))
    """
    low, colon, high = text.partition(":")
    try:
        return number(low), number(high if colon else low)
    except ValueError:
        raise ValueError(f"expected LOW:HIGH, such as {example}, or one number") from None


def named(
    option: str, texts: Sequence[str], shape: str, read: Callable[[str], Value]
) -> dict[str, Value]:
    """The values of an option by their names; it may be given several times.

    Raises
    ------
    BadParameter
    """
    found: dict[str, Value] = {}
    for text in texts:
        try:
            for name, value in named_values(text, shape):
                if name in found:
                    raise ValueError(f"{name} is given twice")  # noqa: TRY301
                try:
                    found[name] = read(value)
                except ValueError as error:
                    raise ValueError(f"{name}: read {quoted(value)}, {error}") from None
        except ValueError as error:
            raise click.BadParameter(str(error), param_hint=f"--{option}") from None
    return found


@contextmanager
def wrong_use(options: Sequence[str]) -> Iterator[None]:
    """Tell problems whose path begins with the name of an option as wrong use of that.

    Raises
    ------
    UsageError
    CaseError
        Where there are only others.
    """
    try:
        yield
    except CaseError as error:
        of_options = [one for one in error.problems if one.path[:1] and one.path[0] in options]
        if not of_options:
            raise
        lines = [f"Invalid value for --{one.path[0]}: {one.message}" for one in of_options]
        raise click.UsageError("\n".join(lines)) from None


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
