"""Shifts between the gears of a found gearbox, and the direction of load on shift elements."""

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
    """Return the number of pairs of non-adjacent gears that differ by a single shift element.

    >>> skip_shifts([(0, 1), (0, 2), (0, 3), (1, 2)])
    3
    """
    pairs = combinations(enumerate(gears), 2)
    return sum(
        second - first > 1 and len(set(engaged_1) ^ set(engaged_2)) == 2
        for (first, engaged_1), (second, engaged_2) in pairs
    )


def reversing(gears: Sequence[GearFigures]) -> tuple[str, ...]:
    """Return the shift elements with positive torque in some gears and negative in other gears."""
    torques = _by_element([gear.torques for gear in gears])
    return tuple(name for name, values in torques.items() if min(values) < 0 < max(values))


def one_way(gears: Sequence[GearFigures], brakes: Sequence[str]) -> tuple[str, ...]:
    """Return the brakes that a one-way clutch could replace.

    Whenever the brake is engaged, it prevents rotation of its link in the same direction. Whenever
    the brake is open, its link rotates in the opposite direction or is at rest.

    Examples
    --------
    The link is pushed forward while it is held, and rotates backward or is at rest while it is
    free:

    >>> nothing = {}, {}, {}, 0.0, 0.0
    >>> gears = [GearFigures({"T": 2.0}, {}, *nothing), GearFigures({}, {"T": -0.5}, *nothing)]
    >>> one_way(gears, ["T"]), one_way([*gears, GearFigures({}, {"T": 0.5}, *nothing)], ["T"])
    (('T',), ())
    """
    torques = _by_element([gear.torques for gear in gears])
    slips = _by_element([gear.slips for gear in gears])
    return tuple(
        name
        for name in brakes
        if name in torques and _is_one_way(torques[name], slips.get(name, ()))
    )


def _is_one_way(torques: Sequence[float], slips: Sequence[float]) -> bool:
    return any(
        all(way * torque > 0 for torque in torques) and all(way * slip <= 0 for slip in slips)
        for way in (1, -1)
    )


def _by_element(gears: Sequence[Mapping[str, float]]) -> dict[str, list[float]]:
    by_name: dict[str, list[float]] = {}
    for gear in gears:
        for name, value in gear.items():
            by_name.setdefault(name, []).append(value)
    return by_name


def beyond(box: FoundBox, known_ratios: Sequence[float]) -> tuple[float, ...]:
    """Return the further ratios that other combinations of as many shift elements give.

    Parameters
    ----------
    box : FoundBox
    known_ratios : sequence of float
        Ratios of the gears of the gearbox. [-]

    Examples
    --------
    A gear set with a brake on the ring, and a clutch that locks up the set:

    >>> from vstatics.synthesis.boxes.box import HELD
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((0,),), 0.0)
    >>> beyond(box, [3.0])
    (1.0,)
    """
    sets = [*combinations(range(len(box.elements)), len(box.gears[0]))]
    ratios = [ratio for ratio in set_ratios(box, sets).tolist() if not math.isnan(ratio)]
    # Digits after the twelfth are rounding noise.
    further = [float(f"{ratio:.12g}") for ratio in _once(sorted(ratios), known_ratios)]
    return tuple(further[place] for place in in_order(further))


def _once(ratios: Sequence[float], known_ratios: Sequence[float]) -> Iterator[float]:
    """Yield ascending ratios that differ from the previous ratio and from all known ratios."""
    last = math.nan
    for ratio in ratios:
        near = SAME_FITTED_RATIO * abs(ratio)
        if not abs(ratio - last) <= near and all(
            abs(ratio - known) > near for known in known_ratios
        ):
            yield ratio
        last = ratio
