"""Numbers of the parts of a case by their keys in YAML: `P1.teeth.sun`, `C1.capacity`.

A variant is the case with other such parts, created and checked like any case.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from typing import Any, NamedTuple, get_args

import numpy as np

from vstatics.core.elements.drawing import Drawing, drawing_of
from vstatics.core.elements.element import Element
from vstatics.core.elements.keys import ELEMENT, MESH_EFFICIENCY, element_of, record_of
from vstatics.core.elements.teeth.doubtful_teeth import misfits
from vstatics.core.model import keys as declared
from vstatics.core.model.declared_numbers import numbers_below, value_at
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.paths import Keys, by_name, dotted
from vstatics.core.model.shape import Leaf, Measure, Shape
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats

_ELSEWHERE = (
    *("ratio", "efficiency", "stiffness", "compliance", "damping", "inertia", "speed_ratio"),
)
"""Keys of a part whose numbers vary without another case."""
_TORQUE = "relative_torque"


class PartNumber(NamedTuple):
    """A number of an element, of a shift element or mechanism, or that all elements have."""

    keys: Keys
    """In the document: `("elements", "P1", "teeth", "sun")`."""
    kind: str
    """Of its leaf in the declaration of keys."""

    @property
    def measure(self) -> Measure | None:
        """What it is measured in; None for a number without a unit."""
        if self.kind == _TORQUE:
            return "si_torque"
        return self.kind if self.kind in get_args(Measure) else None  # type: ignore[return-value] # as it says

    @property
    def expected(self) -> str:
        """What may stand there."""
        return "a whole number" if self.kind == "count" else "a finite number"

    def impossible(self, values: Floats) -> Booleans:
        """Which values can't stand there, whatever stands beside them."""
        wrong = ~np.isfinite(values)
        return wrong | (values != np.rint(values)) if self.kind == "count" else wrong

    def written(self, value: float) -> float:
        """A value in SI as its part has it."""
        if self.kind == _TORQUE:
            return OfLoad(value, 1.0)
        return int(value) if self.kind == "count" else value


def part_numbers(case: Transmission) -> dict[str, PartNumber]:
    """All such numbers of a case by their paths, those too that it leaves out.

    >>> from vstatics import Gear
    >>> from vstatics.core.elements import Drawing, Element, transmission
    >>> links, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> drawing = Drawing(3, [Element("P1", "planetary", links, teeth)])
    >>> part_numbers(transmission(drawing, gears=[Gear()]))["P1.teeth.sun"]
    PartNumber(keys=('elements', 'P1', 'teeth', 'sun'), kind='count')
    """
    return {dotted(by_name(keys)): PartNumber(keys, leaf.kind) for keys, leaf in _numbers(case)}


def _numbers(case: Transmission) -> Iterator[tuple[Keys, Leaf]]:
    """Return the keys of all numbers of parts, with their declarations."""
    for key, parts in _tree(case).items():
        if key == "mesh_efficiency":
            yield from numbers_below(MESH_EFFICIENCY, parts, (key,)) if drawing_of(case) else ()
            continue
        for name, part in parts.items():
            for keys, leaf in numbers_below(_shape(key, part), part, (key, name)):
                if len(keys) > 3 or keys[2] not in _ELSEWHERE:
                    yield keys, leaf


def _shape(key: str, part: Any) -> Shape:
    """Return the declared keys of a part."""
    if key == "elements":
        return ELEMENT.records[part["kind"]]
    return declared.MECHANISM if key == "mechanisms" else declared.ELEMENT


def own_part_number(case: Transmission, number: PartNumber) -> float | None:
    """Return a number as the case has it; None if it leaves it out."""
    parts: Any = _tree(case)
    own: float | None = reduce(value_at, number.keys, parts)
    return own


def _tree(case: Transmission) -> dict[str, Any]:
    """Return the parts of a case by their keys in a document, elements as records."""
    drawing = drawing_of(case) or Drawing(case.links, (), case.mechanisms)
    return {
        "shift_elements": {element.name: element for element in case.shift_elements},
        "mechanisms": {mechanism.name: mechanism for mechanism in drawing.mechanisms},
        "mesh_efficiency": drawing.mesh_efficiency,
        "elements": {element.name: record_of(element) for element in drawing.elements},
    }


def with_part_numbers(
    case: Transmission, numbers: Sequence[PartNumber], values: Sequence[float]
) -> Transmission:
    """The case with other numbers of its parts.

    Parameters
    ----------
    case : Transmission
    numbers : sequence of PartNumber
    values : sequence of float
        In SI.

    Raises
    ------
    CaseError
        If there can be no such case.

    Examples
    --------
    >>> from vstatics import Gear
    >>> from vstatics.core.elements import Element, transmission
    >>> links, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> drawing = Drawing(3, [Element("P1", "planetary", links, teeth)])
    >>> case = transmission(drawing, gears=[Gear()])
    >>> sun = part_numbers(case)["P1.teeth.sun"]
    >>> case.mechanisms[0].ratio, with_part_numbers(case, [sun], [25.0]).mechanisms[0].ratio
    (-2.5, -3.0)
    """
    tree: Any = _tree(case)
    for number, value in zip(numbers, values, strict=True):
        tree = _put(tree, number.keys, number.written(value))
    changed = {number.keys[1] for number in numbers if number.keys[0] == "elements"}
    shift_elements, mechanisms = ([*tree[key].values()] for key in ("shift_elements", "mechanisms"))
    drawing = drawing_of(case)
    if drawing is None:
        return case.replace(shift_elements=shift_elements, mechanisms=mechanisms)
    elements = [
        _element(one.name, tree["elements"][one.name], case.link_names)
        if one.name in changed
        else one
        for one in drawing.elements
    ]
    drawn = replace(
        drawing,
        elements=elements,
        mechanisms=mechanisms,
        mesh_efficiency=tree["mesh_efficiency"],
    )
    return case.replace(shift_elements=shift_elements, drawing=drawn)


def _element(name: str, record: Mapping[str, Any], link_names: Sequence[str]) -> Element:
    """Return the element of a record, without the keys that it leaves out."""
    given = {key: value for key, value in record.items() if value is not None}
    for kind in ("suns", "rings"):
        wheels = given[kind]
        given[kind] = [one if isinstance(one, Mapping) else one._asdict() for one in wheels]
    return element_of(name, given, link_names)


def _put(part: Any, keys: Keys, number: float) -> Any:
    """Return a part with another number somewhere below it."""
    if not keys:
        return number
    key, *others = keys
    below = _put(value_at(part, key), tuple(others), number)
    if isinstance(part, list):
        return [*part[: int(key) - 1], below, *part[int(key) :]]
    if part is None or isinstance(part, Mapping):
        return {**(part or {}), key: below}
    return part._replace(**{key: below})


def is_assembled(case: Transmission, numbers: Sequence[PartNumber]) -> bool:
    """Whether the elements to which numbers belong can be put together with their teeth."""
    return are_assembled(
        case, {number.keys[1] for number in numbers if number.keys[0] == "elements"}
    )


def are_assembled(case: Transmission, names: Collection[str]) -> bool:
    """Whether the elements of such names can be put together with their teeth."""
    elements = drawing.elements if (drawing := drawing_of(case)) else ()
    found = [fault for one in elements if one.name in names for fault in misfits(one)]
    return all(one in case.untold for one in found)
