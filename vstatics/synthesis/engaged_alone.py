"""What one set of engaged elements does, by the elimination that gears are solved with.

It takes longer than `engaged_kinds`, but eliminates what is engaged together with the
mechanisms, in the order that loses least: for sets in which that may lose too many digits.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from vstatics.model.transmission import HOUSING, Transmission
from vstatics.numerics.elimination import RIGHT, Equation, solve
from vstatics.numerics.traced import plain
from vstatics.statics.matrix import ON_ELEMENT, columns
from vstatics.synthesis.engaged_kinds import EngagedKind
from vstatics.synthesis.speed_forms import Pair


class KindAlone(NamedTuple):
    """What a set of elements does; a direct drive is not told from another gear."""

    kind: EngagedKind
    ratio: float
    """NaN where there is none. [-]"""
    free: bool


def kind_alone(case: Transmission, engaged: Iterable[Pair]) -> KindAlone:
    """What a set of elements does, each given by the links that it joins.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> kind_alone(case, [(2, 0)]).ratio, kind_alone(case, [(1, 0)]).kind.word
    (3.5, 'blocked')
    """
    own = columns(case, [one.ratio for one in case.mechanisms])[len(case.shift_elements) :]
    rows: list[Equation] = [{link - 1: part for link, part in column.items()} for column in own]
    for pair in engaged:
        joined = zip(pair, ON_ELEMENT, strict=True)
        rows.append({link - 1: float(part) for link, part in joined if link != HOUSING})
    of_input, of_output = case.input - 1, case.output - 1
    turned = solve([*rows, {of_input: 1.0, RIGHT: 1.0}], case.links)
    if not turned.consistent:
        still: list[Equation] = [*rows, {of_input: 1.0}]
        output_turns = solve([*still, {of_output: 1.0, RIGHT: 1.0}], case.links).consistent
        missing = solve(still, case.links).missing
        return KindAlone(EngagedKind.BLOCKED, math.nan, missing > output_turns)
    speed = float(plain(turned.values[of_output]))
    if math.isnan(speed):
        return KindAlone(EngagedKind.NEUTRAL, math.nan, turned.missing > 1)
    free = turned.missing > 0
    if speed == 0:
        return KindAlone(EngagedKind.PARKING, math.nan, free)
    return KindAlone(EngagedKind.GEAR, 1 / speed, free)
