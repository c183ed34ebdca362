"""The wanted ratios of a box as they are typed: a number or a range for each gear, tolerances."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.cli.shared.values import named, pair, separated, told, wrong_value
from vstatics.core.errors import quoted, spoken
from vstatics.core.readers.named.scalars import number
from vstatics.core.suggestions import nearest
from vstatics.synthesis.boxes.box import COARSEST
from vstatics.synthesis.gears.names import in_order, names_of_gears


class WantedRatio(NamedTuple):
    """The ratio of a gear: a number, to be met within a tolerance, or a range."""

    middle: float
    """[-]"""
    width: float | None = None
    """Half of ln(one end/the other end) of a range. [-]"""


def wanted_ratio(text: str) -> WantedRatio:
    """A ratio, or a range of ratios of one sign with either end first.

    Raises
    ------
    ValueError

    Examples
    --------
    >>> wanted_ratio("3.5"), wanted_ratio("8:2").middle, round(wanted_ratio("-4:-2").middle, 6)
    (WantedRatio(middle=3.5, width=None), 4.0, -2.828427)
    """
    if ":" not in text:
        return WantedRatio(number(text))
    one, other = pair(text, "5.8:6.2")
    if one * other <= 0 or one == other:
        raise ValueError("expected two different ratios of one sign, such as 5.8:6.2")
    return WantedRatio(math.copysign(math.sqrt(one * other), one), abs(math.log(one / other)) / 2)


class WantedTolerances(NamedTuple):
    """The largest |ln(i/wanted)| of gears: in general, and of some by name."""

    general: float
    """[-]"""
    by_gear: Mapping[str, float]
    """[-]"""


def wanted_tolerances(default: float) -> Callable[[Sequence[str]], WantedTolerances]:
    """Reads tolerances; the default is that in general where only others are given.

    >>> wanted_tolerances(0.01)(["1=.04,R=.2"])
    WantedTolerances(general=0.01, by_gear={'1': 0.04, 'R': 0.2})
    """

    def read(texts: Sequence[str]) -> WantedTolerances:
        given = separated(texts)
        alone = [text for text in given if "=" not in text]
        if len(alone) > 1:
            raise ValueError(f"read {quoted(alone[1])}, expected one number, and GEAR=T of others")
        by_gear = named("GEAR=T", _tolerance)([text for text in given if "=" in text])
        return WantedTolerances(told(_tolerance)(alone[0]) if alone else default, by_gear)

    return read


def _tolerance(text: str) -> float:
    found = number(text)
    if not 0 < found <= COARSEST:
        raise ValueError(f"expected a number above 0, up to {COARSEST:g}")
    return found


class WantedGears(NamedTuple):
    """The gears of a box, as its search has them."""

    targets: tuple[float, ...]
    """Ratios, the middles of ranges. [-]"""
    tolerance: float
    """[-]"""
    tolerances: tuple[float, ...]
    """Of each gear, where they are not the same. [-]"""


def wanted_gears(targets: Sequence[WantedRatio], tolerance: WantedTolerances) -> WantedGears:
    """Ratios with their tolerances.

    Raises
    ------
    BadParameter
        If there is no gear of a name, or it has a range of its own.

    Examples
    --------
    >>> ratios = [WantedRatio(3.0), WantedRatio(1.0, 0.05), WantedRatio(-2.0)]
    >>> wanted_gears(ratios, WantedTolerances(0.01, {"R": 0.2})).tolerances
    (0.01, 0.05, 0.2)
    """
    middles = tuple(one.middle for one in targets)
    names = names_of_gears(middles)
    ranges = {name for name, one in zip(names, targets, strict=True) if one.width is not None}
    with wrong_value("--tolerance"):
        for name in tolerance.by_gear:
            if name not in names:
                in_turn = [names[place] for place in in_order(middles)]
                hint = nearest(name, names) or f"; expected {spoken(in_turn, 'or')}"
                raise ValueError(f"read {quoted(name)}, but there is no such gear{hint}")
            if name in ranges:
                raise ValueError(f"{name}: expected none, as its ratio is a range")
    if not tolerance.by_gear and not ranges:
        return WantedGears(middles, tolerance.general, ())
    of_gears = tuple(
        tolerance.by_gear.get(name, tolerance.general) if one.width is None else one.width
        for name, one in zip(names, targets, strict=True)
    )
    return WantedGears(middles, tolerance.general, of_gears)
