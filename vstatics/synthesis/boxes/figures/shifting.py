"""How the gears of a found box follow one another, and what its elements have to bear in them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import combinations

from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.chosen_gears import set_ratios
from vstatics.synthesis.boxes.figures.by_gear import GearFigures
from vstatics.synthesis.gears.names import in_order
from vstatics.synthesis.tolerances import SAME_FITTED_RATIO


def skip_shifts(gears: Sequence[Collection[object]]) -> int:
    """The number of pairs of gears, not neighbours, between which one element is exchanged.

    >>> skip_shifts([(0, 1), (0, 2), (0, 3), (1, 2)])
    3
    """
    pairs = combinations(enumerate(gears), 2)
    return sum(
        second - first > 1 and len(set(one) ^ set(other)) == 2
        for (first, one), (second, other) in pairs
    )


def reversing(gears: Sequence[GearFigures]) -> tuple[str, ...]:
    """The elements whose torque has both signs in some gears."""
    torques = _of_elements([gear.torques for gear in gears])
    return tuple(name for name, own in torques.items() if min(own) < 0 < max(own))


def one_way(gears: Sequence[GearFigures], brakes: Sequence[str]) -> tuple[str, ...]:
    """The brakes that a one-way clutch may replace.

    Where it is engaged, the brake keeps its link from turning one way, in all gears the same;
    where it is open, the link turns the other way, or stands.

    Examples
    --------
    The link pushes forward while it is held, and turns backward or stands while it is not:

    >>> nothing = {}, {}, {}, 0.0, 0.0
    >>> gears = [GearFigures({"T": 2.0}, {}, *nothing), GearFigures({}, {"T": -0.5}, *nothing)]
    >>> one_way(gears, ["T"]), one_way([*gears, GearFigures({}, {"T": 0.5}, *nothing)], ["T"])
    (('T',), ())
    """
    torques = _of_elements([gear.torques for gear in gears])
    slips = _of_elements([gear.slips for gear in gears])
    return tuple(
        name
        for name in brakes
        if name in torques and _is_one_way(torques[name], slips.get(name, ()))
    )


def _is_one_way(torques: Sequence[float], slips: Sequence[float]) -> bool:
    """By what a link gives to its brake, and how it turns where that is open."""
    return any(
        all(way * torque > 0 for torque in torques) and all(way * slip <= 0 for slip in slips)
        for way in (1, -1)
    )


def _of_elements(gears: Sequence[Mapping[str, float]]) -> dict[str, list[float]]:
    """By element its values in all gears that have one."""
    found: dict[str, list[float]] = {}
    for gear in gears:
        for name, value in gear.items():
            found.setdefault(name, []).append(value)
    return found


def beyond(box: FoundBox, told: Sequence[float]) -> tuple[float, ...]:
    """Ratios that other combinations of as many elements give, each once, in the order of gears.

    Parameters
    ----------
    box : FoundBox
    told : sequence of float
        The ratios of its gears. [-]

    Examples
    --------
    A set whose ring has a brake, with a clutch that makes it turn as one piece:

    >>> from vstatics.synthesis.boxes.box import HELD
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((0,),), 0.0)
    >>> beyond(box, [3.0])
    (1.0,)
    """
    sets = [*combinations(range(len(box.elements)), len(box.gears[0]))]
    ratios = [one for one in set_ratios(box, sets).tolist() if not math.isnan(one)]
    found = [float(f"{one:.12g}") for one in _once(sorted(ratios), told)]  # the rest is rounding
    return tuple(found[place] for place in in_order(found))


def _once(ratios: Sequence[float], told: Sequence[float]) -> Iterator[float]:
    """Those of ascending ratios that differ from the one before and from all that are told."""
    last = math.nan
    for ratio in ratios:
        near = SAME_FITTED_RATIO * abs(ratio)
        if not abs(ratio - last) <= near and all(abs(ratio - one) > near for one in told):
            yield ratio
        last = ratio
