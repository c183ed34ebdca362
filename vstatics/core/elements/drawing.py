"""Drawing of a case as gear sets, and the devices for which results are listed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from vstatics.core.arguments import refusing
from vstatics.core.elements.element import DrawingFields
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.lower import DrawnPart, parts
from vstatics.core.errors import Problem
from vstatics.core.groups import grouped
from vstatics.core.model.parts import HOUSING, Member, OwnDevice, Planet, WheelOfPlanet
from vstatics.core.model.transmission import ShiftElement, Transmission


@dataclass(frozen=True)
class Drawing(DrawingFields):
    """Drawing of a case as gear sets; see `DrawingFields` for the parameters.

    Examples
    --------
    >>> from vstatics.core.elements.element import Element
    >>> teeth = {"sun": 30, "ring": 75}
    >>> members = {"sun": 1, "ring": 2, "carrier": 3}
    >>> drawing = Drawing(3, [Element("P", "planetary", members, teeth)])
    >>> [(device.name, [member.name for member in device.members]) for device in drawing.devices]
    [('P', ['sun', 'ring', 'carrier'])]
    """

    @cached_property
    def parts(self) -> Sequence[DrawnPart]:
        """Gear sets and further mechanisms, each with the mechanisms derived for the solver."""
        return parts(self)

    @cached_property
    def devices(self) -> Sequence[OwnDevice]:
        """Gear sets and mechanisms for which results are listed, in the order of `parts`."""
        return tuple(_devices(self.parts))

    def ratio_range(self, index: int) -> tuple[float, float]:
        """Return the bounds of a mechanism's ratio [-], which depend on the kind of gear set.

        >>> from vstatics.core.elements.element import Element
        >>> members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
        >>> Drawing(3, [Element("P", "planetary", members, teeth)]).ratio_range(0)
        (-inf, -1.0)
        """
        drawn = [(part.element, lowered) for part in self.parts for lowered in part.lowered]
        element, lowered = drawn[index]
        return lowered.ratio_range(element) if element else (-math.inf, math.inf)

    def problems(self) -> Iterator[Problem]:
        """Yield every error of the gear sets, in the order of the gear sets."""
        from vstatics.core.elements.checks import problems  # the import costs start-up time

        return problems(self)

    def lowered(self, link_names: Sequence[str]) -> dict[str, Any]:
        """Return the fields of `Transmission` that follow from the drawing, such as its mechanisms.

        Parameters
        ----------
        link_names : sequence of str
            Names of the links of the case; a missing name is replaced by the link number.
        """
        numbers = [str(number) for number in range(len(link_names) + 1, self.links + 1)]
        planets = [f"{part.name}.{planet}" for part in self.parts for planet in part.planet_links]
        return {
            "links": self.links + len(planets),
            "link_names": [*link_names, *numbers, *planets],
            "mechanisms": [lowered.mechanism for part in self.parts for lowered in part.lowered],
            "drawing": self,
            "_lowered": self,
        }


@refusing()
def transmission(
    drawing: Drawing,
    *,
    shift_elements: Sequence[ShiftElement] = (),
    link_names: Sequence[str] = (),
    **others: Any,
) -> Transmission:
    """Return the transmission of a drawing.

    Parameters
    ----------
    drawing : Drawing
        Gear sets with their teeth.
    shift_elements : sequence of ShiftElement, optional
        Clutches, brakes and freewheels.
    link_names : sequence of str, optional
        Names of the links of the case, without planets.
    **others
        Further arguments of `Transmission`: gears, input, output and others.

    Returns
    -------
    Transmission
        Transmission with links and mechanisms that follow from the drawing.

    Raises
    ------
    CaseError
        The error contains all problems of the gear sets and of the other arguments.

    Examples
    --------
    >>> from vstatics.core.elements import Element
    >>> from vstatics.core.model.transmission import Gear
    >>> from vstatics.core.statics.solve import solve
    >>> sets = Element("P", "planetary", {"sun": 1, "ring": 2, "carrier": 3},
    ...                {"sun": 30, "ring": 75})
    >>> case = transmission(Drawing(3, [sets]), shift_elements=[ShiftElement(2)],
    ...                     gears=[Gear([1])])
    >>> solve(case).ratio
    array([3.5])
    """
    return Transmission(
        drawing.links, shift_elements, (), link_names=link_names, drawing=drawing, **others
    )


def drawing_of(case: Transmission) -> Drawing | None:
    """Return the drawing of a case; None for a case without gear sets."""
    return case.drawing if isinstance(case.drawing, Drawing) else None


def parts_of(case: Transmission) -> Sequence[DrawnPart]:
    """Return the gear sets and mechanisms of a case with or without gear sets."""
    return (drawing_of(case) or Drawing(case.links, (), case.mechanisms)).parts


def _devices(drawn: Sequence[DrawnPart]) -> Iterator[OwnDevice]:
    number = 0
    for part in drawn:
        numbers = tuple(range(number, number + len(part.lowered)))
        number += len(part.lowered)
        places = grouped(
            (member, (index, place))
            for index, lowered in zip(numbers, part.lowered, strict=True)
            for place, member in enumerate(lowered.members)
        )
        members = [Member(name, link, tuple(places[name])) for name, link in part.members.items()]
        yield OwnDevice(
            part.name,
            numbers,
            tuple(members),
            tuple(_planets(part, numbers, places)),
            _meshes(part),
        )


def _meshes(part: DrawnPart) -> tuple[bool, ...]:
    """Return for each mesh of a gear set whether the teeth of its first gear are known."""
    if part.element is None or not part.planet_links:
        return ()
    group = group_of(part.element)
    firsts = [lowered.members[0] for lowered in part.lowered]
    return tuple(first not in group.planets or group.is_known(first) for first in firsts)


def _planets(
    part: DrawnPart, numbers: Sequence[int], places: Mapping[str, Sequence[tuple[int, int]]]
) -> Iterator[Planet]:
    element, mechanism = part.element, part.lowered[0].mechanism
    if element is not None and isinstance(element.shape, Planetary):
        group = group_of(element)
        follows_ratio = len(numbers) == len(group.planets) == 1 and mechanism.planet_ratio is None
        for train in group.trains:
            wheels = tuple(
                WheelOfPlanet(
                    wheel.link,
                    places[wheel.member][0][0],
                    float(group.relative(wheel, train)),
                )
                for wheel in group.wheels_of(train)
            )
            for planet, speed in train.items():
                yield Planet(
                    f"{part.name}.{planet}",
                    numbers[0] if follows_ratio else -1,
                    mechanism.ratio,
                    wheels,
                    group.carrier,
                    float(speed) if group.is_known(planet) else math.nan,
                )
    elif element is not None and mechanism.planet_ratio is not None:
        yield Planet(f"{part.name}.{element.shape.toothed[1]}", numbers[0])
    elif element is None and (mechanism.third != HOUSING or mechanism.planet_ratio is not None):
        yield Planet(f"{part.name}.planet", numbers[0])
