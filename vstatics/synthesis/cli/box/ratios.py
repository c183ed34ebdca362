"""Options for the wanted ratios: a number or a range for each gear, with tolerances."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.cli.shared.values import named, separated, told, wrong_value
from vstatics.core.errors import quoted, spoken
from vstatics.core.readers.named.scalars import number
from vstatics.core.suggestions import nearest
from vstatics.synthesis.boxes.box import COARSEST
from vstatics.synthesis.cli.values import pair
from vstatics.synthesis.gears.names import in_order, names_of_gears


class WantedRatio(NamedTuple):
    """Wanted ratio of a gear: a number with a tolerance, or a range."""

    middle: float
    """Ratio, or geometric mean of both ends of a range. [-]"""
    width: float | None = None
    """Half the logarithmic width of a range, ``|ln(first end/second end)|/2``; None for a number.
    [-]
    """


def wanted_ratio(text: str) -> WantedRatio:
    """Read a ratio, or a range of ratios with equal signs, with either end first.

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
    first, second = pair(text, "5.8:6.2")
    if first * second <= 0 or first == second:
        raise ValueError("expected two different ratios of one sign, such as 5.8:6.2")
    middle = math.copysign(math.sqrt(first * second), first)
    return WantedRatio(middle, abs(math.log(first / second)) / 2)


class WantedTolerances(NamedTuple):
    """Largest deviations ``|ln(i/wanted)|`` of gear ratios."""

    general: float
    """Tolerance of gears without a separate tolerance. [-]"""
    by_gear: Mapping[str, float]
    """Tolerances of single gears, by the name of the gear. [-]"""


def wanted_tolerances(default: float) -> Callable[[Sequence[str]], WantedTolerances]:
    """Return a parser of tolerances, with a default for the general tolerance.

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
    tolerance = number(text)
    if not 0 < tolerance <= COARSEST:
        raise ValueError(f"expected a number above 0, up to {COARSEST:g}")
    return tolerance


class WantedGears(NamedTuple):
    """Wanted gears as fields of `BoxSearch`."""

    targets: tuple[float, ...]
    """Wanted ratios, or geometric means of wanted ranges. [-]"""
    tolerance: float
    """Tolerance of gears without a separate tolerance. [-]"""
    tolerances: tuple[float, ...]
    """Tolerance of each gear; empty if `tolerance` is valid for all. [-]"""


def wanted_gears(targets: Sequence[WantedRatio], tolerance: WantedTolerances) -> WantedGears:
    """Combine wanted ratios with tolerances.

    Raises
    ------
    BadParameter
        If the gear of a tolerance does not exist, or its ratio is a range.

    Examples
    --------
    >>> ratios = [WantedRatio(3.0), WantedRatio(1.0, 0.05), WantedRatio(-2.0)]
    >>> wanted_gears(ratios, WantedTolerances(0.01, {"R": 0.2})).tolerances
    (0.01, 0.05, 0.2)
    """
    middles = tuple(target.middle for target in targets)
    names = names_of_gears(middles)
    ranges = {name for name, target in zip(names, targets, strict=True) if target.width is not None}
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
        tolerance.by_gear.get(name, tolerance.general) if target.width is None else target.width
        for name, target in zip(names, targets, strict=True)
    )
    return WantedGears(middles, tolerance.general, of_gears)
