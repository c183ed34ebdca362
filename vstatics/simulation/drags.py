"""What drags in a scenario: links, open shift elements, freewheels that overrun."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.errors import CaseError, Problem
from vstatics.model.parts import OfLoad
from vstatics.model.transmission import Gear, Transmission
from vstatics.simulation.programme import newton_metres


class DragTorque(NamedTuple):
    """What drags."""

    is_element: bool
    """Whether it is a shift element, not a link."""
    number: int
    """Of the element or the link."""
    torque: float
    """[N*m]"""


def drags(case: Transmission, gear: Gear | None) -> Iterator[DragTorque]:
    r"""What drags, in a gear or without one.

    Raises
    ------
    CaseError
        Of a drag that has no unit.

    Examples
    --------
    A drag of the case holds without a gear, too:

    >>> from vstatics.readers import loads
    >>> case = loads("links: [a]\ninertias: {a: 1}\ndrag: {a: 0.1}\nload: {torque: 20 N*m}")
    >>> list(drags(case, None))
    [DragTorque(is_element=False, number=1, torque=2.0)]
    """
    problems = []
    open_drag = gear.open_drag if gear else _of_all_gears([one.open_drag for one in case.gears])
    items = [
        (True, number, open_drag.get(number, element.drag), element.name)
        for number, element in enumerate(case.shift_elements, 1)
    ]
    of_links = gear.drag if gear else _of_all_gears([one.drag for one in case.gears])
    items += [(False, link, drag, case.link_name(link)) for link, drag in of_links.items()]
    found = []
    for is_element, number, drag, name in items:
        torque = abs(newton_metres(drag, case) or 0.0)
        if math.isnan(torque):
            message = (
                f"the drag of {name} is {drag:g} of the input torque, which a scenario does not "
                "have: give it with its unit, such as `3 N*m`, or a `load` with a torque"
            )
            problems.append(Problem(message))
        elif torque:
            found.append(DragTorque(is_element, number, torque))
    if problems:
        raise CaseError(problems)
    yield from found


def _of_all_gears(by_gear: Sequence[Mapping[int, float]]) -> dict[int, float]:
    """The drag that is the same in all gears, as that of the case is."""
    first, *others = by_gear
    return {
        part: drag
        for part, drag in first.items()
        if all(part in one and _given(one[part]) == _given(drag) for one in others)
    }


def _given(torque: float) -> float:
    """A torque as it was given, whatever load it is related to."""
    return torque.given if isinstance(torque, OfLoad) else torque
