"""Links of a gear that rotate together for any ratios, not by coincidence."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from vstatics.core.elements.drawing import drawing_of, parts_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.lower import DrawnPart, parts
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.elimination import RIGHT, Equation
from vstatics.core.statics import matrix

GOLDEN = 0.6180339887498949
"""Golden ratio minus 1. Its multiples modulo 1 are evenly distributed, and shift the ratios."""
SHIFTED = 0.05
"""Largest relative shift of ratios in the test whether equal speeds are a coincidence. [-]"""


class Structure(NamedTuple):
    """Bodies of a gear, and the mechanisms and springs that determine the speeds."""

    body: Sequence[int]
    """Body of each link, housing first, identified by the smallest link number of the body."""
    needed: Sequence[int]
    """Indices of mechanisms with independent equations."""
    springs: Sequence[int]
    """Indices of springs with independent equations."""


class OwnLinks(NamedTuple):
    """Case without planets as links. It has the speeds of the original case, but not the losses."""

    case: Transmission
    parts: Sequence[DrawnPart]
    """Gear sets with their derived mechanisms, and other mechanisms."""
    variators: Collection[str] = ()
    """Names of gear pairs that represent variators."""

    def is_fixed(self, number: int) -> bool:
        """Return whether a mechanism, by index, has a ratio that does not depend on tooth numbers.

        Such mechanisms are shafts, symmetrical differentials of ratio -1, mechanisms of ratio 1
        (whose third link has no effect), variators and converters. Groups of planets of ratio -1
        are not. Gear pairs that represent variators are not included.
        """
        mechanism = self.case.mechanisms[number]
        if mechanism.name in self.variators:
            return False
        if mechanism.kind:
            return True
        if mechanism.ratio != -1 or mechanism.third == HOUSING:
            return mechanism.ratio == 1
        elements = [part.element for part in self.parts for _ in part.lowered]
        element = elements[number]
        return element is None or not isinstance(element.shape, Planetary)


def as_solved(case: Transmission) -> Transmission:
    """Return the case, without its drawing if ratios differ from the ratios of the drawing.

    >>> from vstatics import example, solve
    >>> case = example("simpson")
    >>> as_solved(case) is case, as_solved(solve(case, ratios=[-2.0, -3.0]).case).drawing
    (True, None)
    """
    drawn = [lowered.mechanism for part in parts_of(case) for lowered in part.lowered]
    drawn[case.own_mechanisms] = case.mechanisms[case.own_mechanisms]
    alike = [mechanism.ratio for mechanism in drawn] == [
        mechanism.ratio for mechanism in case.mechanisms
    ]
    return case if alike else _undrawn(case)


def on_own_links(case: Transmission) -> OwnLinks:
    """Return the case with mechanisms between central gears, without planets as links."""
    drawing = drawing_of(case)
    if drawing is None:
        return OwnLinks(case, parts_of(case))
    # These mechanisms include gear pairs for variators, which are not in the drawing.
    given = case.mechanisms[case.own_mechanisms]
    reduced = parts(replace(drawing, mechanisms=given, losses="reduced"))
    plain = _undrawn(
        case,
        links=drawing.links,
        link_names=case.link_names[: drawing.links],
        mechanisms=[lowered.mechanism for part in reduced for lowered in part.lowered],
    )
    return OwnLinks(plain, reduced)


def _undrawn(case: Transmission, **changes: Any) -> Transmission:
    # Fatigue data and bearings refer to members of drawn gear sets, so they are removed.
    changes |= {"drawing": None, "fatigue": {}, "bearings": {}}
    own = len(case.mechanisms[case.own_mechanisms])
    first = len(changes.get("mechanisms", case.mechanisms)) - own
    numbers = {n: first + n for n in range(1, own + len(case.converters) + 1)}
    return replace(case, gears=[gear.renumbered(numbers) for gear in case.gears], **changes)


def structure(on_links: OwnLinks, gear: Gear) -> Structure:
    """Return the bodies of a gear: links whose speeds are equal for any ratios.

    Two links form a body if the equations of mechanisms, springs and engaged shift elements force
    their speeds to be equal, also after all ratios are shifted slightly.

    Parameters
    ----------
    gear : Gear
        Gear in which holding freewheels are listed as engaged.

    Examples
    --------
    The brake holds link 2; no other links rotate together.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> [structure(on_own_links(case), gear).body for gear in case.gears]
    [[0, 1, 0, 3], [0, 1, 1, 1]]
    """
    case = on_links.case
    ratios = [mechanism.ratio for mechanism in case.mechanisms]
    devices = matrix.always_loaded(case, gear)
    first = len(case.shift_elements) + len(ratios)
    mechanisms = [device for device in devices if device < first]
    numbers = _independent(_rows(case, gear, ratios), len(mechanisms))
    shifted = [
        ratio if on_links.is_fixed(number) else ratio * (1 + SHIFTED * ((number + 1) * GOLDEN % 1))
        for number, ratio in enumerate(ratios)
    ]
    rows = _rows(case, gear, shifted)
    pairs = [
        (first_link, second_link)
        for first_link in range(case.links + 1)
        for second_link in range(first_link)
    ]
    sums = [
        {
            link - 1: factor
            for link, factor in ((first_link, 1.0), (second_link, -1.0))
            if link != HOUSING
        }
        for first_link, second_link in pairs
    ]
    solution = elimination.solve([rows[number] for number in numbers], case.links, sums)
    body = list(range(case.links + 1))
    for (first_link, second_link), value in zip(pairs, solution.values[case.links :], strict=True):
        if value == 0:
            body[first_link] = min(body[first_link], body[second_link])
    involved = [devices[number] for number in numbers if number < len(devices)]
    return Structure(
        body,
        [device - len(case.shift_elements) for device in involved if device < first],
        [device - first for device in involved if device >= first],
    )


def _rows(case: Transmission, gear: Gear, ratios: Sequence[float]) -> list[Equation]:
    """Return the speed equations of mechanisms, then springs, then engaged shift elements."""
    plain = gear._replace(engaged=gear.joining, speeds={}, slip={})
    rows = matrix.speed_rows(case, plain, matrix.columns(case, ratios))[:-1]
    return [{column: value for column, value in row.items() if column != RIGHT} for row in rows]


def _independent(rows: Sequence[Equation], mechanisms: int) -> list[int]:
    """Return the indices of independent equations.

    If equations depend on each other, equations of mechanisms are dropped first.
    """
    numbers = list(range(len(rows)))
    while True:
        dependency = next(elimination.dependencies([rows[number] for number in numbers]), None)
        if dependency is None:
            return numbers
        involved = [numbers[place] for place in dependency[0]]
        last = max(involved, key=lambda number: (number < mechanisms, number))
        numbers.remove(last)
