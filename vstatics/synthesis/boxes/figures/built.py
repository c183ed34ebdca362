"""Conversion of a case to the record of a found gearbox; the inverse of `case`."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import partial
from typing import NamedTuple

from vstatics.core.elements.lower import DrawnPart
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.model.parts import HOUSING, Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.boxes.case_sets import GROUP, case_mechanisms
from vstatics.synthesis.structures.scheme import SetScheme

OF_SETS = ("planetary", "double_planet", "ravigneaux", GROUP)
"""Kinds of gear sets of a case that correspond to planetary gear sets of a found gearbox."""


class _CaseSet(NamedTuple):
    """Gear set of a case. The central gear with fewer teeth is the sun."""

    links: tuple[int, int, int]
    """Numbers of the links of sun, carrier and ring in the case."""
    ratio: float


def built_box(case: Transmission) -> FoundBox | None:
    """Return a case as a found gearbox.

    Return None if the case has other components than found gearboxes.

    A gearbox has only planetary gear sets, brakes and clutches. One-way clutches are left out; a
    brake or clutch between the same links is engaged instead. Only the gears that engage the
    largest number of shift elements are kept.

    Parameters
    ----------
    case : Transmission

    Examples
    --------
    >>> from vstatics.core.examples import example
    >>> box = built_box(example("simpson"))
    >>> box.scheme.code, box.input, box.output, box.elements
    ('0-1-2-0-3-1', 4, 1, ((4, 2), (4, 0), (0, -1), (3, -1)))
    >>> built_box(example("two-stage")) is None
    True
    """
    lowered = on_own_links(case)
    drawn = [part for part in lowered.parts for _ in part.lowered]
    pairs = [*zip(drawn, case_mechanisms(lowered), strict=True)]
    held = {HOUSING, *(mechanism.first for part, mechanism in pairs if _is_held(part))}
    sets = [_case_set(mechanism, held) for part, mechanism in pairs if _is_of_set(part, mechanism)]
    is_more = len(sets) + len(held) - 1 < len(pairs)
    if is_more or not sets or case.springs or case.outputs:
        return None
    number: dict[int, int] = {}
    for link in (link for found_set in sets for link in found_set.links):
        number.setdefault(link, len(number))
    scheme = SetScheme(tuple((number[a], number[h], number[b]) for (a, h, b), _ in sets))
    joined_links = (link for element in case.shift_elements for link in element.links)
    for link in (case.input, case.output, *joined_links):  # shafts without a member of a gear set
        if link not in held and link != HOUSING:
            number.setdefault(link, len(number))
    elements = _elements(case, number, held)
    is_shifted = any(gear.engaged for gear in case.gears)
    if not is_shifted or case.output not in number or None in elements.values():
        return None
    names = [*elements]
    gears = [tuple(map(names.index, gear)) for gear in _gears(case, names)]
    joined = tuple(ends for ends in elements.values() if ends)
    ratios = tuple(ratio for _, ratio in sets)
    ports = number[case.input], number[case.output]
    return FoundBox(scheme, number.get(HOUSING), *ports, joined, ratios, tuple(gears), 0.0)


def _is_held(part: DrawnPart) -> bool:
    return part.element is not None and part.element.kind == "held"


def _is_of_set(part: DrawnPart, mechanism: Mechanism) -> bool:
    """Check whether a mechanism of a case is a planetary gear set with a sun and a ring."""
    if part.element is None:
        return (mechanism.third != HOUSING or mechanism.is_set) and not mechanism.kind
    return part.element.kind in OF_SETS


def _case_set(mechanism: Mechanism, held: Collection[int]) -> _CaseSet:
    """Return sun, carrier and ring of a gear set; permanently held links become the housing."""
    first, second, third = (HOUSING if link in held else link for link in mechanism.links)
    if abs(mechanism.ratio) < 1:
        return _CaseSet((second, third, first), 1 / mechanism.ratio)
    return _CaseSet((first, third, second), mechanism.ratio)


def _elements(
    case: Transmission, number: Mapping[int, int], held: Collection[int]
) -> dict[int, tuple[int, int] | None]:
    """Return the links of each shift element.

    None marks a shift element at a link outside the gearbox.
    """
    ends: dict[int, tuple[int, int] | None] = {}
    for place, element in enumerate(case.shift_elements, 1):
        if element.is_freewheel:
            continue
        links = sorted(element.links, key=lambda link: link in held)
        free = [number.get(link) for link in links if link not in held]
        first, second = [*free, HELD][:2]
        ends[place] = None if first is None or second is None else (first, second)
    return ends


def _gears(case: Transmission, elements: Collection[int]) -> Iterator[tuple[int, ...]]:
    """Yield the engaged elements of each gear with the largest number of engaged elements."""
    parallel = [place for place in map(partial(_parallel_element, case), case.freewheels) if place]
    most = max((len(gear.engaged) for gear in case.gears), default=0)
    for gear in case.gears:
        engaged = {*gear.engaged}
        spare = [place for place in parallel if place not in engaged]
        # A spare element replaces the holding freewheel.
        if len(engaged) == most - 1 and len(spare) == 1:
            engaged |= {*spare}
        is_own = case.gear_input(gear) == case.input and case.gear_output(gear) == case.output
        if len(engaged) == most and is_own and engaged.issubset(elements):
            yield tuple(sorted(engaged))


def _parallel_element(case: Transmission, freewheel: int) -> int | None:
    links = {*case.shift_elements[freewheel - 1].links}
    others = enumerate(case.shift_elements, 1)
    return next(
        (n for n, element in others if {*element.links} == links and not element.is_freewheel), None
    )
