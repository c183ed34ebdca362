"""Numbers with a unit in a case: `2100 rpm`, `1.3*400 Nm`, `120 PS`."""

from __future__ import annotations

import math
import re
from typing import Self

from vstatics.errors import nearest
from vstatics.model.shape import UNITS
from vstatics.readers.named.arithmetic import ARITHMETIC, calculated, expected
from vstatics.readers.named.units import LONGEST, Quantity, unit

QUANTITY = rf"^{ARITHMETIC}[*·]? *(1? */ *)?[A-Za-zА-я°][-A-Za-zА-я0-9*·⋅×./^ ⁻¹]{{0,39}}$"
"""A number with a unit, as a pattern for ECMAScript."""

EXAMPLES: dict[Quantity, str] = {
    "speed": "`2100 rpm` or `220 rad/s`",
    "torque": "`1200 N*m` or `885 lbf*ft`",
    "power": "`120 kW` or `160 hp`",
}
_USUAL: dict[Quantity, tuple[str, ...]] = {
    "speed": ("rpm", "rad/s", "rev/min", "rev/s", "1/min", "deg/s"),
    "torque": ("N*m", "kN*m", "MN*m", "N*mm", "N*cm", "lbf*ft", "lbf*in", "kgf*m", "kgf*cm"),
    "power": ("kW", "W", "MW", "hp", "PS"),
}
_MEANT = {
    **dict.fromkeys(("1s", "s1", "s", "hz"), "rev/s` or `rad/s"),
    "kgm": "kgf*m",
    "kgcm": "kgf*cm",
}
"""What is meant by units that are no speed or torque, without the signs in them."""


def quantity(text: str, kind: Quantity, or_else: str = "") -> float:
    """A speed in rpm, a torque in N*m or a power in kW.

    Parameters
    ----------
    text : str
        A number, or a calculation, and its unit.
    kind : {"speed", "torque", "power"}
    or_else : str
        What could stand there besides, for the message.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> quantity("3000 1/min", "speed"), quantity("1.3*400 Nm", "torque")
    (3000.0, 520.0)
    >>> quantity("100 lbf*ft", "torque"), quantity("75 PS", "power")
    (135.58179483314004, 55.1624062...)
    """
    number, behind = calculated(text) if _has_digits(text) else (0.0, "")
    found, size = unit(behind)
    if found != kind:
        other = f"; this is a {found}" if found else _hint(behind, kind)
        such = f"expected a {kind} with its unit, such as {EXAMPLES[kind]}"
        raise ValueError(f"{such}{or_else}{other}")
    value = number * size
    if not math.isfinite(value):
        raise ValueError(f"expected a {kind} that is not so large")
    return value


def _has_digits(text: str) -> bool:
    return any(sign in "0123456789" for sign in text)


def _hint(read: str, kind: Quantity) -> str:
    """The usual unit, where another way to write it was read."""
    if "," in read:
        return " (with a decimal point)"
    letters = _letters(read)
    alike = (usual for usual in _USUAL[kind] if _letters(usual) == letters)
    meant = next(alike, _MEANT.get(letters))
    return f"; did you mean `{meant}`?" if meant else nearest(read[:LONGEST], _USUAL[kind])


def _letters(text: str) -> str:
    return re.sub(r"[\W_]", "", text).casefold()


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
    >>> relative("1/500", "torque"), relative("3 N*m", "torque")
    (0.002, 3.0)
    """
    if _has_digits(text):
        value, behind = calculated(text)
        if not behind:
            return value
    if not any(sign.isalpha() for sign in text):
        raise ValueError(expected(text))
    return WithUnit(quantity(text, kind, f", or one relative to the input {kind}"), kind)
