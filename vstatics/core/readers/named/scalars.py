"""What single values mean: numbers, link numbers, switches.

Python's own conversions take more (`1_000`, `nan`, `٣`) than a case should.
"""

from __future__ import annotations

import re

from vstatics.core.readers.named.arithmetic import DIMENSIONLESS, dimensionless, slip

NUMBER = rf"^{DIMENSIONLESS}$"
"""A number, or a calculation of numbers, as a pattern for ECMAScript."""

LINK_NUMBER = "^(0|[1-9][0-9]*)$"
"""Plain digits; `010` would be 8 to some readers of YAML."""

INFINITE = frozenset((".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF"))
"""As YAML 1.1 and 1.2 write it."""

_LINK_NUMBER = re.compile(LINK_NUMBER.removesuffix("$") + r"\Z")
_MOST_DIGITS = 9


def number(text: str) -> float:
    """A decimal number, a fraction, other arithmetic, a percentage or a ratio of two numbers.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> number("-2.5e-1"), number("-96/39") == -96 / 39, number("98%"), number("3.55:1")
    (-0.25, True, 0.98, 3.55)
    """
    return dimensionless(text)


def link_number(text: str) -> int | None:
    """A link number, or none if the text is not one.

    >>> link_number("12"), link_number("0x10")
    (12, None)
    """
    if not _LINK_NUMBER.match(text):
        return None
    if len(text) > _MOST_DIGITS:
        raise ValueError(f"expected a number of at most {_MOST_DIGITS} digits")
    return int(text)


def count(text: str) -> int:
    """A whole number from 1, such as one of teeth.

    >>> count("48")
    48
    """
    number = link_number(text)
    if not number:
        raise ValueError("expected a whole number from 1")
    return number


def share(text: str) -> float:
    """A part of a whole that is the sum of all parts.

    >>> share("3/2")
    1.5
    """
    try:
        value = number(text)
    except ValueError:
        value = -1.0
    if value < 0:
        raise ValueError(f"expected a share of 0 or more{slip(text)}")
    return value


def flag(text: str, *, plain: bool) -> bool:
    """A switch, `true` or `false` without quotes."""
    if not plain or text not in ("true", "false"):
        raise ValueError("expected `true` or `false`" + ("" if plain else " without quotes"))
    return text == "true"
