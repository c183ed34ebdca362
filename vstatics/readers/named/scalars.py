"""What single values mean: numbers, link numbers, switches, speeds and torques with units.

Python's own conversions take more (`1_000`, `nan`, `٣`) than a case should.
"""

from __future__ import annotations

import math
import re
import warnings
from functools import cache
from typing import TYPE_CHECKING, Literal, Self

from vstatics.model.shape import UNITS

if TYPE_CHECKING:
    import pint

DECIMAL = r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?"
NUMBER = rf"^{DECIMAL}( */ *{DECIMAL})?$"
"""A decimal number or a fraction of two, as a pattern for Python and ECMAScript."""

LINK_NUMBER = "^(0|[1-9][0-9]*)$"
"""Plain digits; `010` would be 8 to some readers of YAML."""

_NUMBER = re.compile(NUMBER.removesuffix("$") + r"\Z")
_LINK_NUMBER = re.compile(LINK_NUMBER.removesuffix("$") + r"\Z")
_MOST_DIGITS = 9

Quantity = Literal["speed", "torque"]

QUANTITY = rf"^{DECIMAL} *[A-Za-z](\^-?[1-3](?![0-9])|[*](?![*])|[A-Za-z /()·]){{0,30}}$"
"""A number with a unit; no powers of powers, which could keep a library busy for ever."""

EXAMPLES: dict[Quantity, str] = {
    "speed": "`2100 rpm` or `220 rad/s`",
    "torque": "`1200 N*m` or `885 lbf*ft`",
}
_ANGLES = ("revolution", "turn", "radian", "degree")
_TEXT = re.compile(QUANTITY.removesuffix("$") + r"\Z")
_MEANT = {
    unit: meant
    for meant, units in {
        "N*m": ("nm", "n.m", "n-m", "н*м", "нм", "н·м"),
        "rpm": ("1/min", "min^-1", "min-1", "/min", "u/min", "r/min", "об/мин"),
    }.items()
    for unit in units
}
"""What is meant by units that the library reads as something else or not at all."""


def number(text: str) -> float:
    """A decimal number or a fraction.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> number("-2.5e-1"), number("-96/39") == -96 / 39
    (-0.25, True)
    """
    if not _NUMBER.match(text):
        comma = " (with a decimal point)" if "," in text else ""
        raise ValueError(f"expected a number or a fraction such as -96/39{comma}")
    parts = [float(part) for part in text.split("/")]
    if parts[1:] == [0]:
        raise ValueError("expected a denominator other than 0")
    value = parts[0] / parts[1] if len(parts) == 2 else parts[0]
    if not math.isfinite(value):
        raise ValueError("expected a number that is not so large")
    return value


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
    if not _NUMBER.match(text) or number(text) < 0:
        raise ValueError("expected a share of 0 or more")
    return number(text)


def flag(text: str, *, plain: bool) -> bool:
    """A switch, `true` or `false` without quotes."""
    if not plain or text not in ("true", "false"):
        raise ValueError("expected `true` or `false`" + ("" if plain else " without quotes"))
    return text == "true"


@cache
def _registry() -> pint.UnitRegistry:  # type: ignore[type-arg]
    import pint  # costs start-up time

    return pint.UnitRegistry()


def quantity(text: str, kind: Quantity) -> float:
    """A speed in rpm or a torque in N*m.

    Parameters
    ----------
    text : str
        A number and its unit.
    kind : {"speed", "torque"}

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> quantity("2100 rpm", "speed"), round(quantity("100 lbf*ft", "torque"), 3)
    (2100.0, 135.582)
    """
    expected = f"expected a {kind} with its unit, such as {EXAMPLES[kind]}{_hint(text, kind)}"
    if not _TEXT.match(text):
        raise ValueError(expected)
    units = _registry()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = units.parse_expression(text.replace("·", "*"))
            value = float(found.to(UNITS[kind]).magnitude)
    except Exception:  # noqa: BLE001 - whatever the library cannot read
        raise ValueError(expected) from None
    # 1/min and Hz leave open whether turns or radians are meant
    if kind == "speed" and not any(angle in str(found.units) for angle in _ANGLES):
        raise ValueError(expected)
    if not math.isfinite(value):
        raise ValueError(f"{expected}, and finite")
    return value


def _hint(text: str, kind: Quantity) -> str:
    """The usual unit, where another way to write it was read."""
    figure, unit = re.match(r"([-+0-9.eE]*) *(.*)", text, re.DOTALL).groups()  # type: ignore[union-attr]
    meant = _MEANT.get(unit.lower())
    return f"; did you mean `{figure} {meant}`?" if figure and meant == UNITS[kind] else ""


class WithUnit(float):
    """A speed in rpm or a torque in N*m, where others are relative to the input's."""

    quantity: Quantity

    def __new__(cls, value: float, quantity: Quantity) -> Self:
        """Keep what it is the value of."""
        made = super().__new__(cls, value)
        made.quantity = quantity
        return made

    def __format__(self, spec: str) -> str:
        return f"{super().__format__(spec)} {UNITS[self.quantity]}"


def relative(text: str, kind: Quantity) -> float:
    """A speed or torque relative to that of the input, or one with its unit.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> relative(".002", "torque"), relative("3 N*m", "torque")
    (0.002, 3.0)
    """
    try:
        return number(text)
    except ValueError as error:
        if not any(letter.isalpha() for letter in text):
            raise
        try:
            return WithUnit(quantity(text, kind), kind)
        except ValueError as with_unit:
            raise ValueError(f"{with_unit}, or one relative to the input {kind}") from error
