"""What is told of a gear of a found box: torques, speeds, losses, drag."""

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
    """Figures of a gear, by input speed, input torque and input power."""

    torques: Mapping[str, float]
    """By engaged element what its first link gives to it, without losses. [-]"""
    slips: Mapping[str, float]
    """By open element the speed of its first link less that of its second. [-]"""
    carriers: Mapping[str, float]
    """By set the speed of its carrier. [-]"""
    planets: Mapping[str, float]
    """By set the speed of the planets at its sun against the carrier. [-]"""
    losses: Mapping[str, float]
    """By set; their sum is 1 - efficiency. [-]"""
    circulating: float
    """Power that goes round, with losses. [-]"""
    drag: float
    """The sum over open elements of ``|slip|`` times capacity. [-]"""


class BoxGear(NamedTuple):
    """A gear of a found box."""

    name: str
    engaged: tuple[str, ...]
    ratio: float
    target: float
    figures: GearFigures


def without_noise(names: Iterable[str], values: Iterable[float]) -> dict[str, float]:
    """Values by name; what is smaller than rounding is 0.

    >>> without_noise("ab", [1e-12, -2.0])
    {'a': 0.0, 'b': -2.0}
    """
    return {
        name: 0.0 if abs(value) < NO_FIGURE else value
        for name, value in zip(names, values, strict=True)
    }


def with_drag(gears: Sequence[GearFigures]) -> list[GearFigures]:
    """The gears of a box with their drag.

    The capacity of an element is the largest torque that it has in any of them.

    >>> first = GearFigures({"A": 2.0}, {"B": -0.5}, {}, {}, {}, 0.0, math.nan)
    >>> second = GearFigures({"B": 3.0}, {"A": 1.0}, {}, {}, {}, 0.0, math.nan)
    >>> [one.drag for one in with_drag([first, second])]
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
    """The mean of the drag of gears by their weights, 1 of those that have none.

    >>> mean_drag({"1": 2.0, "2": 0.0}, {"1": 3.0})
    1.5
    """
    own = {name: weights.get(name, 1.0) for name in gears}
    return math.fsum(own[name] * gears[name] for name in gears) / math.fsum(own.values())


def check_weights(gears: Iterable[str], weights: Mapping[str, float]) -> None:
    """Refuse weights that are of no gear, below 0, or all 0.

    Raises
    ------
    CaseError
        With ``weights`` as its path.

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
        problems = [Problem("E796", "read 0 for all gears, expected one above 0", ("weights",))]
    if problems:
        raise CaseError(problems)


def check_search_weights(search: BoxSearch, weights: Mapping[str, float]) -> None:
    """Refuse weights that are of no gear of any box that may be found, or all 0 in one.

    Raises
    ------
    CaseError
        With ``weights`` as its path.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.box import WantedSequence
    >>> search = BoxSearch(2, 4, 2, (), sequence=WantedSequence(3, 4, (1, 9), (1, 9)))
    >>> check_search_weights(search, {"4": 2.0})
    >>> check_search_weights(search, {"1": 0.0, "2": 0.0, "3": 0.0})
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: weights: read 0 for all gears, expected one above 0 [E796]
    """
    wanted = search.sequence
    fewest, most = (0, 0) if wanted is None else (wanted.least, wanted.most)
    check_weights(names_of_mean([*search.targets, *[1.0] * most]), weights)
    least = names_of_mean([*search.targets, *[1.0] * fewest])  # more gears have these, too
    check_weights(least, {name: weights[name] for name in least if name in weights})
