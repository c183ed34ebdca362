"""Which links of a gear turn together because they are joined, not by coincidence."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import NamedTuple

from vstatics.core.elements.drawing import drawing_of, parts_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.lower import DrawnPart, parts
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.elimination import RIGHT, Equation
from vstatics.core.statics import matrix

GOLDEN = 0.6180339887498949
SHIFTED = 0.05
"""Ratios are shifted by up to this part to tell structure from coincidence."""


class Structure(NamedTuple):
    """The bodies of a gear, and the mechanisms and springs that its speeds need."""

    body: Sequence[int]
    """By link, the housing first: the first of the links that it turns with."""
    needed: Sequence[int]
    """Indices of mechanisms whose equations the others do not imply."""
    springs: Sequence[int]
    """Indices of springs of which this is true."""


class OwnLinks(NamedTuple):
    """A case whose planets are no links: the speeds are the same, losses are not."""

    case: Transmission
    parts: Sequence[DrawnPart]
    """What its elements are then, and its mechanisms."""
    variators: Collection[str] = ()
    """Names of pairs that stand for variators."""

    def is_fixed(self, number: int) -> bool:
        """Whether a mechanism, by its index, has a ratio that is no matter of teeth.

        So it is of a shaft, and of a symmetrical differential, whose ratio is -1; a group of
        planets comes to -1 by its teeth. A ratio of 1 counts too: the third link does not act then.
        That of a variator is set, and by chance the one or the other.
        """
        mechanism = self.case.mechanisms[number]
        if mechanism.name in self.variators:
            return False
        if mechanism.ratio != -1 or mechanism.third == HOUSING:
            return mechanism.ratio == 1
        elements = [part.element for part in self.parts for _ in part.lowered]
        element = elements[number]
        return element is None or not isinstance(element.shape, Planetary)


def as_solved(case: Transmission) -> Transmission:
    """The case, without its drawing where mechanisms of elements were replaced alone.

    >>> from vstatics import example, solve
    >>> case = example("simpson")
    >>> as_solved(case) is case, as_solved(solve(case, ratios=[-2.0, -3.0]).case).drawing
    (True, None)
    """
    drawn = [lowered.mechanism for part in parts_of(case) for lowered in part.lowered]
    drawn[case.own_mechanisms] = case.mechanisms[case.own_mechanisms]
    alike = [one.ratio for one in drawn] == [one.ratio for one in case.mechanisms]
    return case if alike else replace(case, drawing=None)


def on_own_links(case: Transmission) -> OwnLinks:
    """The case on its own links, its elements reduced to mechanisms between their wheels."""
    drawing = drawing_of(case)
    if drawing is None:
        return OwnLinks(case, parts_of(case))
    given = case.mechanisms[case.own_mechanisms]  # pairs for variators, too, not those drawn
    reduced = parts(replace(drawing, mechanisms=given, losses="reduced"))
    plain = replace(
        case,
        links=drawing.links,
        link_names=case.link_names[: drawing.links],
        mechanisms=[lowered.mechanism for part in reduced for lowered in part.lowered],
        drawing=None,
    )
    return OwnLinks(plain, reduced)


def structure(own: OwnLinks, gear: Gear) -> Structure:
    """The bodies of a gear: links whose speeds are one whatever the ratios are.

    Two links are one body if the equations of mechanisms, springs and engaged elements leave
    no other difference than 0, also with all ratios a little shifted.

    Parameters
    ----------
    gear : Gear
        With the freewheels that hold among the engaged elements.

    Examples
    --------
    The brake holds link 2; nothing else turns together.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> [structure(on_own_links(case), gear).body for gear in case.gears]
    [[0, 1, 0, 3], [0, 1, 1, 1]]
    """
    case = own.case
    ratios = [mechanism.ratio for mechanism in case.mechanisms]
    devices = matrix.always_loaded(case, gear)
    first = len(case.shift_elements) + len(ratios)
    mechanisms = [device for device in devices if device < first]
    numbers = _independent(_rows(case, gear, ratios), len(mechanisms))
    shifted = [
        ratio if own.is_fixed(number) else ratio * (1 + SHIFTED * ((number + 1) * GOLDEN % 1))
        for number, ratio in enumerate(ratios)
    ]
    rows = _rows(case, gear, shifted)
    pairs = [(one, other) for one in range(case.links + 1) for other in range(one)]
    sums = [
        {link - 1: factor for link, factor in ((one, 1.0), (other, -1.0)) if link != HOUSING}
        for one, other in pairs
    ]
    solution = elimination.solve([rows[number] for number in numbers], case.links, sums)
    body = list(range(case.links + 1))
    for (one, other), value in zip(pairs, solution.values[case.links :], strict=True):
        if value == 0:
            body[one] = min(body[one], body[other])
    involved = [devices[number] for number in numbers if number < len(devices)]
    return Structure(
        body,
        [device - len(case.shift_elements) for device in involved if device < first],
        [device - first for device in involved if device >= first],
    )


def _rows(case: Transmission, gear: Gear, ratios: Sequence[float]) -> list[Equation]:
    """Equations of mechanisms, then of springs, then of engaged elements."""
    plain = gear._replace(speeds={})
    rows = matrix.speed_rows(case, plain, matrix.columns(case, ratios))[:-1]
    return [{column: value for column, value in row.items() if column != RIGHT} for row in rows]


def _independent(rows: Sequence[Equation], mechanisms: int) -> list[int]:
    """Numbers of rows that do not imply one another; a mechanism is left out first."""
    numbers = list(range(len(rows)))
    while True:
        found = next(elimination.dependencies([rows[number] for number in numbers]), None)
        if found is None:
            return numbers
        involved = [numbers[place] for place in found[0]]
        last = max(involved, key=lambda number: (number < mechanisms, number))
        numbers.remove(last)
