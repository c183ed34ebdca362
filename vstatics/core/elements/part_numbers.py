"""Numbers of components of a case by path, such as `P1.teeth.sun` or `C1.capacity`.

A case with other numbers is created and checked anew.
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
"""Keys not listed by this module, because a sweep varies them without creating a new case."""
_TORQUE = "relative_torque"


class PartNumber(NamedTuple):
    """Number of a gear set, shift element or mechanism, or a common number of all gear sets."""

    keys: Keys
    """Keys of the number in a case file, such as `("elements", "P1", "teeth", "sun")`."""
    kind: str
    """Kind of the number in the declaration of the key, such as ``count``."""

    @property
    def measure(self) -> Measure | None:
        """Quantity that determines the unit of the number; None without a unit."""
        if self.kind == _TORQUE:
            return "si_torque"
        return self.kind if self.kind in get_args(Measure) else None  # type: ignore[return-value] # as it says

    @property
    def expected(self) -> str:
        """Permitted values in words, for messages."""
        return "a whole number" if self.kind == "count" else "a finite number"

    def impossible(self, values: Floats) -> Booleans:
        """Return flags that mark values that are never valid for the number."""
        wrong = ~np.isfinite(values)
        return wrong | (values != np.rint(values)) if self.kind == "count" else wrong

    def written(self, value: float) -> float:
        """Convert a value in SI units to the unit in which the component stores the value."""
        if self.kind == _TORQUE:
            return OfLoad(value, 1.0)
        return int(value) if self.kind == "count" else value


def part_numbers(case: Transmission) -> dict[str, PartNumber]:
    """Return the numbers of all components by path, including numbers that the case omits.

    >>> from vstatics import Gear
    >>> from vstatics.core.elements import Drawing, Element, transmission
    >>> links, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> drawing = Drawing(3, [Element("P1", "planetary", links, teeth)])
    >>> part_numbers(transmission(drawing, gears=[Gear()]))["P1.teeth.sun"]
    PartNumber(keys=('elements', 'P1', 'teeth', 'sun'), kind='count')
    """
    return {dotted(by_name(keys)): PartNumber(keys, leaf.kind) for keys, leaf in _numbers(case)}


def _numbers(case: Transmission) -> Iterator[tuple[Keys, Leaf]]:
    """Yield keys and declarations of the numbers of all components."""
    for key, parts in _tree(case).items():
        if key == "mesh_efficiency":
            yield from numbers_below(MESH_EFFICIENCY, parts, (key,)) if drawing_of(case) else ()
            continue
        for name, part in parts.items():
            for keys, leaf in numbers_below(_shape(key, part), part, (key, name)):
                if len(keys) > 3 or keys[2] not in _ELSEWHERE:
                    yield keys, leaf


def _shape(key: str, part: Any) -> Shape:
    if key == "elements":
        return ELEMENT.records[part["kind"]]
    return declared.MECHANISM if key == "mechanisms" else declared.ELEMENT


def own_part_number(case: Transmission, number: PartNumber) -> float | None:
    """Return the value of a number in a case; None if the case omits the number."""
    parts: Any = _tree(case)
    value: float | None = reduce(value_at, number.keys, parts)
    return value


def _tree(case: Transmission) -> dict[str, Any]:
    """Return the components of a case, by key in a case file. Gear sets are mappings (records)."""
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
    """Return the case with other values of some numbers.

    Parameters
    ----------
    case : Transmission
    numbers : sequence of PartNumber
    values : sequence of float
        Values of the numbers, in SI units.

    Raises
    ------
    CaseError
        If the case with these numbers is not valid.

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
        _element(element.name, tree["elements"][element.name], case.link_names)
        if element.name in changed
        else element
        for element in drawing.elements
    ]
    drawn = replace(
        drawing,
        elements=elements,
        mechanisms=mechanisms,
        mesh_efficiency=tree["mesh_efficiency"],
    )
    return case.replace(shift_elements=shift_elements, drawing=drawn)


def _element(name: str, record: Mapping[str, Any], link_names: Sequence[str]) -> Element:
    """Return the gear set of a record. A key with the value None is omitted."""
    given = {key: value for key, value in record.items() if value is not None}
    for kind in ("suns", "rings"):
        wheels = given[kind]
        given[kind] = [wheel if isinstance(wheel, Mapping) else wheel._asdict() for wheel in wheels]
    return element_of(name, given, link_names)


def _put(part: Any, keys: Keys, number: float) -> Any:
    """Return a component with the number at `keys`, which can lead into mappings, replaced."""
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
    """Return whether the gear sets to which the numbers belong can be assembled."""
    return are_assembled(
        case, {number.keys[1] for number in numbers if number.keys[0] == "elements"}
    )


def are_assembled(case: Transmission, names: Collection[str]) -> bool:
    """Return whether gear sets can be assembled, apart from warnings that the case suppresses."""
    elements = drawing.elements if (drawing := drawing_of(case)) else ()
    faults = [fault for element in elements if element.name in names for fault in misfits(element)]
    return all(fault in case.untold for fault in faults)
