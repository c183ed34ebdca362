"""Units in which a case may give speeds and torques: `2100 rpm`, `885 lbf*ft`."""

from __future__ import annotations

import math
import re
import warnings
from functools import cache
from typing import TYPE_CHECKING, Literal, Self

from vstatics.model.shape import UNITS
from vstatics.readers.named.scalars import DECIMAL, number

if TYPE_CHECKING:
    import pint

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
