"""What gears and loads must fulfil; problems with paths."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from vstatics.errors import Path, Problem, type_and_value
from vstatics.model.fields import TransmissionFields
from vstatics.model.part_checks import called, is_number, of_drag, of_link
from vstatics.model.parts import DIRECTIONS, GEAR_KINDS, Gear, Load, ShiftElement, SpeedOf


def of_gear(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    """What a gear engages and gives."""
    if gear.engaged:
        yield from _engaged(case.shift_elements, gear.engaged, (*path, "engaged"))
    ends = gear.input or case.input, gear.output or case.main_output
    for end, link in (("input", gear.input), ("output", gear.output)):
        if link is not None:
            yield from of_link(link, (*path, end), case.own_links, lowest=1)
    if ends[0] == ends[1] and (gear.input is not None or gear.output is not None):
        yield Problem(f"input and output are both link {called(case, ends[0])}", path)
    yield from _turning(case, gear, (*path, "input_turns"))
    yield from _dragging(case, gear, path)
    if gear.kind not in GEAR_KINDS:
        yield Problem(f"read {gear.kind!r}, expected `gear` or `point`", (*path, "kind"))
    if gear.speeds or gear.torques:
        yield from _given(case, gear, ends, path)


def _given(
    case: TransmissionFields, gear: Gear, ends: tuple[int, int], path: Path
) -> Iterator[Problem]:
    """Given speeds and torques, of links that have neither by themselves."""
    yield from _speeds(case, gear.speeds, (*path, "speeds"))
    yield from _finite(gear.torques, (*path, "torques"), case.own_links)
    if ends[0] in gear.speeds:
        message = f"link {called(case, ends[0])} is the input, whose speed is 1; expected another"
        yield Problem(message, (*path, "speeds", ends[0]))
    for link in gear.torques:
        if link == ends[1]:
            message = f"link {called(case, link)} is the output, whose torque is calculated"
            yield Problem(f"{message}; expected another link", (*path, "torques", link))
        elif link in gear.speeds:
            message = f"link {called(case, link)} has a given speed, so its torque is calculated"
            yield Problem(f"{message}; give one of the two", (*path, "torques", link))


def _turning(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    """The way in which the input turns, which is also that of the load."""
    said = gear.input_turns
    if not said:
        return
    by_load = case.input_turns(gear._replace(input_turns=""))
    if said not in DIRECTIONS:
        expected = " or ".join(f"`{direction}`" for direction in DIRECTIONS)
        yield Problem(f"read {said!r}, expected {expected}", path)
    elif by_load and said != by_load:
        message = (
            f"read `{said}`, but by the load of this gear the input turns {by_load}; expected "
            "a load of its own whose signs agree, or this left out"
        )
        yield Problem(message, path)


def of_load(load: Load | None, path: Path) -> Iterator[Problem]:
    """A load that is one, and of which power enters."""
    if not isinstance(load or Load(), Load):
        message = f"read {type_and_value(load)}, expected a Load, in rpm and N*m"
        yield Problem(message, (*path, "load"))
        return
    load = load or Load()
    for quantity, value in load._asdict().items():
        if isinstance(value, str):
            message = f"read {value!r}, expected a number, in rpm and N*m"
            yield Problem(message, (*path, "load", quantity))
            return
        if value is not None and (value == 0 or not math.isfinite(value)):
            message = f"read {value:g}, expected a finite number other than 0"
            yield Problem(message, (*path, "load", quantity))
    if (load.speed or 0) * (load.torque or 0) < 0:
        message = (
            f"read {load.torque:g} N*m at {load.speed:g} rpm, so power would leave at the input; "
            "expected equal signs (`coast: true` turns the torque by itself)"
        )
        yield Problem(message, (*path, "load"))


def _dragging(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    """The drag that a gear gives, of links and of open elements."""
    for link, torque in gear.drag.items():
        yield from of_link(link, (*path, "drag", link), case.own_links, lowest=1)
        yield from of_drag(torque, None, (*path, "drag", link))
    elements = case.shift_elements
    for number, torque in gear.open_drag.items():
        inner = (*path, "open_drag", number)
        if is_number(number, len(elements), 1):
            yield from of_drag(torque, elements[number - 1], inner)
        else:
            expected = f"the number of a shift element, from 1 to {len(elements)}"
            yield Problem(f"read {number!r}, expected {expected}", inner)


def _engaged(
    elements: Sequence[ShiftElement], engaged: Sequence[int], path: Path
) -> Iterator[Problem]:
    seen: set[int] = set()
    for position, element in enumerate(engaged, 1):
        if not is_number(element, len(elements), 1):
            expected = f"the number of a shift element, from 1 to {len(elements)}"
            yield Problem(f"read {element!r}, expected {expected}", (*path, position))
            continue
        message = f"element {elements[element - 1].name or element} is"
        if element in seen:
            message += " engaged twice, expected each once"
            yield Problem(message, (*path, position))
        elif elements[element - 1].is_freewheel:
            message += " a freewheel, which finds by itself whether it holds; leave it out"
            yield Problem(message, (*path, position))
        seen.add(element)


def _speeds(
    case: TransmissionFields, speeds: Mapping[int, float | SpeedOf], path: Path
) -> Iterator[Problem]:
    """Given speeds: numbers, or those of other links."""
    numbers = {link: one for link, one in speeds.items() if not isinstance(one, SpeedOf)}
    yield from _finite(numbers, path, case.own_links)
    for link, speed in speeds.items():
        if not isinstance(speed, SpeedOf):
            continue
        inner = (*path, link)
        yield from of_link(link, inner, case.own_links, lowest=1)
        yield from of_link(speed.link, inner, case.own_links, lowest=1)
        if speed.factor == 0 or not math.isfinite(speed.factor):
            message = f"read a factor of {speed.factor:g}, expected a finite one other than 0"
            yield Problem(f"{message}; a link that stands has the speed 0", inner)
        if speed.link == link:
            message = f"the speed of link {called(case, link)} is given by itself"
            yield Problem(f"{message}, expected another link", inner)


def _finite(values: Mapping[int, float], path: Path, links: int) -> Iterator[Problem]:
    for link, value in values.items():
        yield from of_link(link, (*path, link), links, lowest=1)
        if not math.isfinite(value):
            yield Problem(f"read {value}, expected a finite number", (*path, link))
