"""Single values: numbers, link numbers, switches.

Python's conversions are not used directly, because they accept texts (`1_000`, `nan`, `٣`) that a
case must not contain.
"""

from __future__ import annotations

import re

from vstatics.core.readers.named.arithmetic import DIMENSIONLESS, dimensionless, slip_or_percent

NUMBER = rf"^{DIMENSIONLESS}$"
"""Regular expression of a number or calculation, for JSON Schema."""

LINK_NUMBER = "^(0|[1-9][0-9]*)$"
"""Pattern of digits without a leading zero, because some YAML parsers convert `010` to 8."""

INFINITE = frozenset((".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF"))
"""Spellings of infinity in YAML 1.1 and 1.2."""

_LINK_NUMBER = re.compile(LINK_NUMBER.removesuffix("$") + r"\Z")
_MOST_DIGITS = 9


def number(text: str) -> float:
    """Return a decimal number, a calculation, a percentage or a ratio of two numbers.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> number("-2.5e-1"), number("-96/39") == -96 / 39, number("98%"), number("3.55:1")
    (-0.25, True, 0.98, 3.55)
    """
    return dimensionless(text)


def link_number(text: str) -> int | None:
    """Return a link number, or `None` if the text is not a link number.

    >>> link_number("12"), link_number("0x10")
    (12, None)
    """
    if not _LINK_NUMBER.match(text):
        return None
    if len(text) > _MOST_DIGITS:
        raise ValueError(f"expected a number of at most {_MOST_DIGITS} digits")
    return int(text)


def count(text: str) -> int:
    """Return a whole number of at least 1, such as a number of teeth.

    Zeros after the point are allowed, because pandas writes whole numbers as floats if a column
    has gaps.

    Parameters
    ----------
    text : str
        Decimal number.

    Returns
    -------
    int

    Raises
    ------
    ValueError
        If the text is not a whole number from 1.

    Examples
    --------
    >>> count("48"), count("48.0")
    (48, 48)
    >>> count("-70")  # standards count the teeth of internal gears as negative
    Traceback (most recent call last):
    ValueError: expected a whole number from 1 (without a sign, even for a ring gear)
    """
    digits, _, decimals = text.partition(".")
    number = None if decimals.strip("0") else link_number(digits)
    if not number:
        sign = " (without a sign, even for a ring gear)" * text.startswith(("-", "+"))
        raise ValueError(f"expected a whole number from 1{sign}")
    return number


def share(text: str) -> float:
    """Return a share. All shares together can have any sum.

    >>> share("3/2")
    1.5
    """
    try:
        value = number(text)
    except ValueError:
        value = -1.0
    if value < 0:
        raise ValueError(f"expected a share of 0 or more{slip_or_percent(text)}")
    return value


def flag(text: str, *, plain: bool) -> bool:
    """Return the value of a switch: `true` or `false`, without quotes."""
    if not plain or text not in ("true", "false"):
        raise ValueError("expected `true` or `false`" + ("" if plain else " without quotes"))
    return text == "true"
