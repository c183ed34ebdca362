"""Figures of a gear of a found gearbox: torques, speeds, losses and drag."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError, Problem, quoted, spoken
from vstatics.core.suggestions import nearest
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.gears.names import names_of_mean
from vstatics.synthesis.tolerances import NO_FIGURE


class GearFigures(NamedTuple):
    """Figures of a gear, divided by input speed, input torque or input power."""

    torques: Mapping[str, float]
    """Torque on each engaged shift element from the first link, without losses. [-]"""
    slips: Mapping[str, float]
    """Slip speed of each disengaged shift element, first link minus second. [-]"""
    carriers: Mapping[str, float]
    """Speed of the carrier of each gear set. [-]"""
    planets: Mapping[str, float]
    """Speed, relative to the carrier, of the planets that mesh with the sun of each gear set. [-]
    """
    losses: Mapping[str, float]
    """Power lost in each gear set; the sum over all sets is 1 - efficiency. [-]"""
    circulating: float
    """Recirculating power, calculated with losses. [-]"""
    drag: float
    """Sum over disengaged shift elements of ``|slip|`` times largest torque in any gear. [-]"""


class BoxGear(NamedTuple):
    """Gear of a found gearbox."""

    name: str
    engaged: tuple[str, ...]
    ratio: float
    target: float
    figures: GearFigures


def without_noise(names: Iterable[str], values: Iterable[float]) -> dict[str, float]:
    """Return values by name, with rounding noise replaced by 0.

    >>> without_noise("ab", [1e-12, -2.0])
    {'a': 0.0, 'b': -2.0}
    """
    return {
        name: 0.0 if abs(value) < NO_FIGURE else value
        for name, value in zip(names, values, strict=True)
    }


def with_drag(gears: Sequence[GearFigures]) -> list[GearFigures]:
    """Return the figures of the gears of a gearbox, completed by the drag.

    The torque capacity of a shift element is taken as its largest torque in any gear.

    >>> first = GearFigures({"A": 2.0}, {"B": -0.5}, {}, {}, {}, 0.0, math.nan)
    >>> second = GearFigures({"B": 3.0}, {"A": 1.0}, {}, {}, {}, 0.0, math.nan)
    >>> [gear.drag for gear in with_drag([first, second])]
    [1.5, 2.0]
    """
    capacity: dict[str, float] = {}
    for gear in gears:
        for name, torque in gear.torques.items():
            capacity[name] = max(capacity.get(name, 0.0), abs(torque))
    return [
        gear._replace(
            drag=math.fsum(abs(slip) * capacity.get(name, 0.0) for name, slip in gear.slips.items())
        )
        for gear in gears
    ]


def mean_drag(gears: Mapping[str, float], weights: Mapping[str, float]) -> float:
    """Return the weighted mean of the drag of gears. A gear without a weight has the weight 1.

    >>> mean_drag({"1": 2.0, "2": 0.0}, {"1": 3.0})
    1.5
    """
    weight = {name: weights.get(name, 1.0) for name in gears}
    return math.fsum(weight[name] * gears[name] for name in gears) / math.fsum(weight.values())


def check_weights(gears: Iterable[str], weights: Mapping[str, float]) -> None:
    """Check that weights belong to gears, are not negative, and are not all 0.

    Raises
    ------
    CaseError
        If a weight is wrong, with the path ``weights``.

    Examples
    --------
    >>> check_weights(["1", "2"], {"3": 1.0})
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: weights: read `3`, but the gears of the mean are 1 and 2 [E796]
    """
    names = [*gears]
    problems = [
        Problem(
            "E796",
            f"read {quoted(name)}, but the gears of the mean are {spoken(names, 'and')}"
            f"{nearest(name, names)}",
            ("weights",),
        )
        for name in weights
        if name not in names
    ]
    problems += [
        Problem("E796", f"{name}: read {weight:g}, expected a number, 0 or above", ("weights",))
        for name, weight in weights.items()
        if not 0 <= weight < math.inf
    ]
    if not problems and not any(weights.get(name, 1.0) for name in names):
        problems = [
            Problem(
                "E796", "read 0 for all gears, expected at least one number above 0", ("weights",)
            )
        ]
    if problems:
        raise CaseError(problems)


def check_search_weights(search: BoxSearch, weights: Mapping[str, float]) -> None:
    """Check weights against the gears that a found gearbox can have.

    Each weight must belong to a possible gear, and no gearbox may have weights of 0 only.

    Raises
    ------
    CaseError
        If a weight is wrong, with the path ``weights``.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.box import WantedSequence
    >>> search = BoxSearch(2, 4, 2, (), sequence=WantedSequence(3, 4, (1, 9), (1, 9)))
    >>> check_search_weights(search, {"4": 2.0})
    >>> check_search_weights(
    ...     search, {"1": 0.0, "2": 0.0, "3": 0.0}
    ... )  # doctest: +NORMALIZE_WHITESPACE
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: weights: read 0 for all gears, expected at least one
    number above 0 [E796]
    """
    wanted = search.sequence
    fewest, most = (0, 0) if wanted is None else (wanted.least, wanted.most)
    check_weights(names_of_mean([*search.targets, *[1.0] * most]), weights)
    # Gearboxes with more gears also have these gears, so checking the smallest number suffices.
    least = names_of_mean([*search.targets, *[1.0] * fewest])
    check_weights(least, {name: weights[name] for name in least if name in weights})
