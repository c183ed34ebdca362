"""Numbers of the parts of a case by their keys in YAML: `P1.teeth.sun`, `C1.capacity`.

A variant is the case with such parts in place of its own, made and checked as any other.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from typing import Any, NamedTuple, TypeAlias, get_args

import numpy as np

from vstatics.core.elements.drawing import Drawing, drawing_of
from vstatics.core.elements.element import Element
from vstatics.core.elements.keys import ELEMENT, MESH_EFFICIENCY, element_of, record_of
from vstatics.core.elements.teeth.doubtful_teeth import misfits
from vstatics.core.model import keys
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.shape import ByKey, ByName, Leaf, ListOf, Measure, Shape
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.sweep.variants.targets import NAMES

Way: TypeAlias = tuple[str | int, ...]
"""Keys, and places of items from 0."""

_ELSEWHERE = (*NAMES, "speed_ratio")
"""Keys of a part whose numbers `targets` and `statics.points.paths` know."""
_TORQUE = "relative_torque"
_NUMBERS = ("number", "count", _TORQUE, *get_args(Measure))


class PartNumber(NamedTuple):
    """A number of an element, of a shift element or mechanism, or that all elements have."""

    way: Way
    """From the parts of the case to the number: `("elements", 0, "teeth", "sun")`."""
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
    PartNumber(way=('elements', 0, 'teeth', 'sun'), kind='count')
    """
    return {
        ".".join((*name, *map(str, below))): PartNumber((*way, *inner), kind)
        for name, way, shape, part in _parts(case)
        for below, inner, kind in _leaves(shape, part)
        if len(below) > 1 or below[0] not in _ELSEWHERE
    }


def _parts(case: Transmission) -> Iterator[tuple[tuple[str, ...], Way, Shape, Any]]:
    """Parts by their names: where they stand, their shape and what they are."""
    drawing = drawing_of(case)
    for n, element in enumerate(case.shift_elements):
        yield (element.name,), ("shift_elements", n), keys.ELEMENT, element
    for n, mechanism in enumerate(drawing.mechanisms if drawing else case.mechanisms):
        yield (mechanism.name,), ("mechanisms", n), keys.MECHANISM, mechanism
    if drawing:
        yield ("mesh_efficiency",), ("mesh_efficiency",), MESH_EFFICIENCY, drawing.mesh_efficiency
        for n, one in enumerate(drawing.elements):
            yield (one.name,), ("elements", n), ELEMENT.records[one.kind], record_of(one)


def _leaves(shape: Shape, part: Any) -> Iterator[tuple[Way, Way, str]]:
    """The numbers below a part: its keys as they are typed, the way there, the kind of leaf."""
    below: list[tuple[str | int, str | int, Shape]] = []
    match shape:
        case Leaf(kind=kind) if kind in _NUMBERS:
            yield (), (), kind
        case ByKey(keys=known, make=make) if part is not None or make is dict:
            below = [(key.name, key.name, key.shape) for key in known]
        case ByName(item=item):
            below = [(name, name, item) for name in part or ()]
        case ListOf(item=item):
            below = [(n + 1, n, item) for n in range(len(part or ()))]
    for typed, key, inner in below:
        for names, way, leaf in _leaves(inner, _below(part, key)):
            yield (typed, *names), (key, *way), leaf


def _below(part: Any, key: str | int) -> Any:
    """What a part has under a key, None if that is nothing."""
    if isinstance(part, Element):
        part = record_of(part)
    if isinstance(key, int) and not isinstance(part, Mapping):
        return part[key]
    return part.get(key) if isinstance(part, Mapping) else getattr(part, str(key), None)


def own_part_number(case: Transmission, number: PartNumber) -> float | None:
    """A number as the case has it; None if it leaves it out."""
    parts: Any = _tree(case)
    own: float | None = reduce(_below, number.way, parts)
    return own


def _tree(case: Transmission) -> dict[str, Any]:
    """The parts of a case by the first key of their ways."""
    drawing = drawing_of(case) or Drawing(case.links, (), case.mechanisms)
    names = ("elements", "mechanisms", "mesh_efficiency")
    drawn = {name: getattr(drawing, name) for name in names}
    return {"shift_elements": case.shift_elements, **drawn}


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
        tree = _put(tree, number.way, number.written(value), case.link_names)
    shift_elements, drawing = tree.pop("shift_elements"), drawing_of(case)
    if drawing is None:
        return case.replace(shift_elements=shift_elements, mechanisms=tree["mechanisms"])
    return case.replace(shift_elements=shift_elements, drawing=replace(drawing, **tree))


def _put(part: Any, way: Way, number: float, link_names: Sequence[str]) -> Any:
    """A part with another number somewhere below it."""
    if not way:
        return number
    if isinstance(part, Element):
        record = {key: one for key, one in record_of(part).items() if one is not None}
        for kind in ("suns", "rings"):
            record[kind] = [wheel._asdict() for wheel in record[kind]]
        return element_of(part.name, _put(record, way, number, link_names), link_names)
    key, *others = way
    below = _put(_below(part, key), tuple(others), number, link_names)
    if isinstance(key, int):
        return [*part[:key], below, *part[key + 1 :]]
    if part is None or isinstance(part, Mapping):
        return {**(part or {}), key: below}
    return part._replace(**{key: below})


def is_assembled(case: Transmission, numbers: Sequence[PartNumber]) -> bool:
    """Whether the elements to which numbers belong can be put together with their teeth."""
    elements = drawing.elements if (drawing := drawing_of(case)) else ()
    owners = {number.way[1] for number in numbers if number.way[0] == "elements"}
    return are_assembled(case, {one.name for n, one in enumerate(elements) if n in owners})


def are_assembled(case: Transmission, names: Collection[str]) -> bool:
    """Whether the elements of such names can be put together with their teeth."""
    elements = drawing.elements if (drawing := drawing_of(case)) else ()
    found = [fault for one in elements if one.name in names for fault in misfits(one)]
    return all(one in case.untold for one in found)
