"""Speeds and torques with units, as they are written: `2100 rpm`, `1200 N*m`."""

from __future__ import annotations

import math
import re
import warnings
from functools import cache
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    import pint

Quantity = Literal["speed", "torque"]

UNITS: dict[Quantity, str] = {"speed": "rpm", "torque": "N*m"}
EXAMPLES: dict[Quantity, str] = {
    "speed": "`2100 rpm` or `220 rad/s`",
    "torque": "`1200 N*m` or `885 lbf*ft`",
}
_ANGLES = ("revolution", "turn", "radian", "degree")
_TEXT = re.compile(r"[+-]?[0-9.]+([eE][+-]?[0-9]+)? *[A-Za-z][A-Za-z0-9 */^()·-]{0,30}\Z")


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
    expected = f"expected a {kind} with its unit, such as {EXAMPLES[kind]}"
    if not _TEXT.match(text):
        raise ValueError(expected)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = _registry().parse_expression(text.replace("·", "*"))
            value = float(found.to(UNITS[kind]).magnitude)
    except Exception:  # noqa: BLE001 - whatever the library cannot read
        raise ValueError(expected) from None
    # 1/min and Hz leave open whether turns or radians are meant
    if kind == "speed" and not any(angle in str(found.units) for angle in _ANGLES):
        raise ValueError(expected)
    if value == 0 or not math.isfinite(value):
        raise ValueError(f"{expected}, finite and not 0")
    return value
