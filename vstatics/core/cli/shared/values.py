"""Values of options: numbers, pairs, comma-separated lists, values by name.

A function parses each kind of value, or raises ValueError. `value` converts the function to a
callback of click, which reports a wrong value as wrong use of the option.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

import click

from vstatics.core.errors import CaseError, quoted
from vstatics.core.suggestions import why_not_allowed

Value = TypeVar("Value")
Given = TypeVar("Given")

FILE = click.Path(readable=False)
"""Name of a file. The reader reports an unreadable file like a missing file."""


@contextmanager
def wrong_value(option: str | None = None) -> Iterator[None]:
    """Run the block; report a ValueError or a problem without a path as wrong use of an option.

    Parameters
    ----------
    option : str, optional
        Name of the option in the message. A callback of click does not need it.

    Raises
    ------
    BadParameter
    CaseError
        If a problem has a path, and so concerns a part of the case.
    """
    try:
        yield
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint=option) from None
    except CaseError as error:
        if any(problem.path for problem in error.problems):
            raise
        raise click.BadParameter(error.problems[0].message, param_hint=option) from None


def value(
    read: Callable[[Given], Value], option: str | None = None
) -> Callable[[click.Context, click.Parameter, Given], Value | Given]:
    """Return a callback of click that parses the value of an option, if there is a value."""

    def callback(_context: click.Context, _option: click.Parameter, given: Given) -> Value | Given:
        with wrong_value(option):
            return given if given is None else read(given)

    return callback


def allowable(ids: Iterable[str]) -> tuple[str, ...]:
    """Return ids of warnings and notes in upper case. A text can contain several ids with commas.

    Raises
    ------
    ValueError
        If an id belongs to an error, or does not exist.

    Examples
    --------
    >>> allowable(["w201, N318", "W421"])
    ('W201', 'N318', 'W421')
    """
    ids_given = tuple(text.upper() for text in separated(ids))
    for why in filter(None, map(why_not_allowed, ids_given)):
        raise ValueError(why)
    return ids_given


def above_0(given: float) -> float:
    """Return a number unchanged if it is above 0.

    Raises
    ------
    ValueError
    """
    if not 0 < given < math.inf:
        raise ValueError(f"read {given:g}, expected a number above 0")
    return given


def from_0(given: float) -> float:
    """Return a number unchanged if it is 0 or more.

    Raises
    ------
    ValueError
    """
    if not 0 <= given < math.inf:
        raise ValueError(f"read {given:g}, expected a number of 0 or more")
    return given


def numbers(expected: str, least: float = 0.0) -> Callable[[str], list[float]]:
    """Return a parser of comma-separated numbers that are at least `least`.

    >>> numbers("a speed of 0 or more")("600,900")
    [600.0, 900.0]
    """

    def read(text: str) -> list[float]:
        parsed = []
        for part in text.split(","):
            try:
                parsed.append(float(part))
            except ValueError:
                parsed.append(math.nan)
            if not least <= parsed[-1] < math.inf:
                raise ValueError(f"read {part[:20]!r}, expected {expected}")
        return parsed

    return read


def told(read: Callable[[str], Value]) -> Callable[[str], Value]:
    """Return a parser whose error messages also contain the wrong text.

    >>> told(float)("x")
    Traceback (most recent call last):
    ValueError: read `x`, could not convert string to float: 'x'
    """

    def read_text(text: str) -> Value:
        try:
            return read(text)
        except ValueError as error:
            raise ValueError(f"read {quoted(text)}, {error}") from None

    return read_text


def each(read: Callable[[str], Value]) -> Callable[[Iterable[str]], tuple[Value, ...]]:
    """Return a parser of all values of an option, which can be repeated or contain commas.

    >>> each(int)(["5, 7", "6"])
    (5, 7, 6)
    """
    return lambda texts: tuple(map(told(read), separated(texts)))


def shown_speeds(text: str) -> tuple[float, float]:
    """Parse a range of speeds, in rpm or with units, and return the limits in rpm.

    Raises
    ------
    ValueError

    Examples
    --------
    >>> shown_speeds("500:3000"), shown_speeds("0:50 rev/s")
    ((500.0, 3000.0), (0.0, 3000.0))
    """
    from vstatics.core.readers.named.arithmetic import calculated
    from vstatics.core.readers.named.units import quantity

    parts = text.split(":")
    if len(parts) != 2:
        raise ValueError("expected a range of speeds such as 500:3000")
    bare = [part if calculated(part.strip()).behind else f"{part} rpm" for part in parts]
    low, high = (quantity(part.strip(), "speed") for part in bare)
    if not 0 <= low < high < math.inf:
        raise ValueError("expected a speed from 0 on, and a higher speed")
    return low, high


def torque(text: str) -> float:
    """Parse a torque with or without a unit [N*m].

    Raises
    ------
    ValueError

    Examples
    --------
    >>> torque("120"), torque("1.2 kN*m")
    (120.0, 1200.0)
    """
    from vstatics.core.readers.named.si_units import measured

    try:
        return measured(text, "si_torque")
    except ValueError as error:
        raise ValueError(f"read {text!r}, {error}") from None


def named(
    shape: str, read: Callable[[str], Value], shown: Callable[[str], str] = quoted
) -> Callable[[Sequence[str]], dict[str, Value]]:
    """Return a parser of NAME=VALUE pairs, for an option that can be repeated.

    >>> named("GEAR=RATIO", float)(['1=2.5, "a, b"=-3', "3=1"])
    {'1': 2.5, 'a, b': -3.0, '3': 1.0}
    """

    def read_all(texts: Sequence[str]) -> dict[str, Value]:
        values: dict[str, Value] = {}
        for text in texts:
            for name, value in named_values(text, shape):
                if name in values:
                    raise ValueError(f"{name} is given twice")
                try:
                    values[name] = read(value)
                except ValueError as error:
                    raise ValueError(f"{name}: read {shown(value)}, {error}") from None
        return values

    return read_all


_ITEM = r'\s*(?:"(?P<quoted>(?:[^"]|"")+)"\s*|(?P<name>[^",=][^,=]*))=(?P<value>[^,=]*)'
"""Pattern of NAME=VALUE. A name in double quotes can contain commas."""


_ALONE = r'\s*(?:"(?P<quoted>(?:[^"]|"")+)"\s*(?=,|\Z)|(?P<name>[^,]*))'
"""Pattern of a single value. A value in double quotes can contain commas."""


def separated(texts: Iterable[str]) -> list[str]:
    """Return all values of an option, which can be repeated or contain commas.

    >>> separated(["5, 7", "6"]), separated(['F1, "a, b" ,"c"d,'])
    (['5', '7', '6'], ['F1', 'a, b', '"c"d', ''])
    """
    parts = []
    for text in texts:
        at = 0
        while at <= len(text):
            item = re.compile(_ALONE).match(text, at)
            assert item is not None  # noqa: S101 - for mypy: a name can be empty here
            parts.append(_name(item))
            at = item.end() + 1
    return parts


def _name(item: re.Match[str]) -> str:
    """Return a name without double quotes around it; a repeated quote within becomes one quote."""
    return (item["quoted"] or "").replace('""', '"') or item["name"].strip()


def named_values(text: str, expected: str = "NAME=NUMBER") -> list[tuple[str, str]]:
    """Return the pairs of name and value in a text NAME=VALUE,NAME=VALUE.

    Raises
    ------
    ValueError
        If the text does not have this form.

    Examples
    --------
    >>> named_values('shaft=.03, "a, b"=.2')
    [('shaft', '.03'), ('a, b', '.2')]
    """
    pairs: list[tuple[str, str]] = []
    at = 0
    while at <= len(text):
        item = re.compile(_ITEM).match(text, at)
        if item is None or text[item.end() : item.end() + 1] not in ("", ","):
            message = f"read {text[at : at + 40]!r}, expected {expected} with commas between"
            if pairs and text[at - 2 : at - 1].isdigit() and text[at : at + 1].isdigit():
                raise ValueError(f"{message} (and with decimal points)")
            raise ValueError(f"{message}; a name with commas in double quotes: '\"a, b\"=0.2'")
        pairs.append((_name(item), item["value"].strip()))
        at = item.end() + 1
    return pairs
