"""What a transmission must fulfil before it can be calculated.

Each check yields `Problem`s with the path of the value in the model; the readers
turn a path into a place in their text. Messages say what was read and what was
expected; the reader puts the name of the field before them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from vstatics.errors import Path, Problem
from vstatics.parts import (
    ELEMENT_KINDS,
    HOUSING,
    Gear,
    Load,
    Mechanism,
    ShiftElement,
    element_name,
    mechanism_name,
)

if TYPE_CHECKING:
    from vstatics.model import Transmission

MOST_FREEWHEELS = 8
"""All sets of them are tried in every gear."""


def problems(case: Transmission) -> Iterator[Problem]:
    """Every error and warning of a case, in the order of its parts."""
    yield from _sizes(case)
    yield from _names(case)
    yield from _ports(case)
    for number, element in enumerate(case.shift_elements, 1):
        yield from _element(case, element, ("shift_elements", number))
    yield from _freewheels(case)
    drawn = _drawn(case)
    for number, mechanism in enumerate(case.mechanisms, 1):
        yield from _mechanism(mechanism, ("mechanisms", number), case.links)
        if number > drawn:
            yield from _doubtful(mechanism, ("mechanisms", number))
    yield from _load(case.load, (), has_freewheels=bool(case.freewheels))
    for number, gear in enumerate(case.gears, 1):
        yield from _gear(case, gear, ("gears", number))
        if gear.load:
            freewheels = bool(case.freewheels)
            yield from _load(case.gear_load(gear), ("gears", number), has_freewheels=freewheels)
    if case.idle not in ("exact", "published"):
        yield Problem(f"read {case.idle!r}, expected `exact` or `published`", ("idle",))


def doubts(case: Transmission) -> Iterator[Problem]:
    """The warnings alone, of a case that has no error."""
    drawn = _drawn(case)
    for number, mechanism in enumerate(case.mechanisms[drawn:], drawn + 1):
        yield from _doubtful(mechanism, ("mechanisms", number))


def hints(case: Transmission) -> Iterator[Problem]:
    """Notes on mechanisms that look as if planets were shared, whose losses are then doubtful.

    Such mechanisms have the third link and one wheel in common, and losses.
    """
    seen: dict[tuple[int, int], str] = {}
    drawn = _drawn(case)
    for number, mechanism in enumerate(case.mechanisms[drawn:], drawn + 1):
        if mechanism.third == HOUSING or mechanism.efficiency == 1:
            continue
        wheels = [link for link in mechanism.links[:2] if link != HOUSING]
        others = [seen[mechanism.third, link] for link in wheels if (mechanism.third, link) in seen]
        if others:
            message = (
                f"shares a wheel and the carrier with {others[0]}: if they share planets too, the "
                "losses of this form are not exact; give the set as an element, or each mesh as a "
                "mechanism (docs/elements.md)"
            )
            yield Problem(message, ("mechanisms", number), severity="note")
        for link in wheels:
            seen.setdefault((mechanism.third, link), mechanism.name or mechanism_name(number))


def _drawn(case: Transmission) -> int:
    """How many mechanisms, the first ones, were made from elements that are checked as such."""
    return len(case.mechanisms) - len(case.drawing.mechanisms) if case.drawing else 0


def _sizes(case: Transmission) -> Iterator[Problem]:
    """Sizes that devices can fill; so no case asks for more memory than its text holds."""
    joined = 2 * len(case.shift_elements) + 3 * len(case.mechanisms)
    if case.links < 2:
        message = f"read {case.links}, expected at least 2 links (input and output)"
        yield Problem(message, ("links",))
    elif case.links > max(joined, 2):
        yield Problem(
            f"read {case.links} links, but {len(case.shift_elements)} shift elements and "
            f"{len(case.mechanisms)} mechanisms can join {joined} at most",
            ("links",),
        )
    if case.link_names and len(case.link_names) != case.links:
        message = f"{case.links} links, but {len(case.link_names)} names of links"
        yield Problem(message, ("link_names",))
    if not case.gears:
        yield Problem("there is no gear, expected at least one", ("gears",))


def _names(case: Transmission) -> Iterator[Problem]:
    """Names are one line of text, and each is the only one of its kind."""
    elements = [e.name or element_name(n, e) for n, e in enumerate(case.shift_elements, 1)]
    mechanisms = [m.name or mechanism_name(n) for n, m in enumerate(case.mechanisms, 1)]
    gears = [gear.name or str(number) for number, gear in enumerate(case.gears, 1)]
    yield from _distinct(case.link_names, "link_names", "link")
    yield from _distinct(elements, "shift_elements", "shift element")
    yield from _distinct(mechanisms, "mechanisms", "mechanism")
    yield from _distinct(gears, "gears", "gear")
    for number, name in enumerate(case.link_names, 1):
        if name in ("0", "housing"):
            message = f"`{name}` is the housing, expected another name for link {number}"
            yield Problem(message, ("link_names", number))
    if case.name and not _is_name(case.name):
        yield Problem(f"read {case.name!r}, expected one line of text", ("name",))


def _distinct(names: Sequence[str], part: str, kind: str) -> Iterator[Problem]:
    if len(set(names)) == len(names) and all(map(_is_name, names)):
        return
    seen: dict[str, int] = {}
    for number, name in enumerate(names, 1):
        if not _is_name(name):
            message = f"{name!r} is no name: expected one line of text, no blanks at its ends"
            yield Problem(message, (part, number))
        elif name in seen:
            message = f"{kind} {number} has the name `{name}` of {kind} {seen[name]}"
            yield Problem(message, (part, number))
        seen.setdefault(name, number)


def _is_name(name: str) -> bool:
    return bool(name) and name == name.strip() and name.isprintable()


def _ports(case: Transmission) -> Iterator[Problem]:
    yield from _link(case.input, ("input",), case.links, lowest=1)
    yield from _link(case.output or case.links, ("output",), case.links, lowest=1)
    if case.input == (case.output or case.links):
        yield Problem(f"input and output are both link {_called(case, case.input)}", ("output",))


def _called(case: Transmission, link: int) -> str:
    """The name of a link, or its number."""
    if link == HOUSING:
        return "0 (the housing)"
    return case.link_names[link - 1] if 0 < link <= len(case.link_names) else str(link)


def _is_number(number: object, last: int, first: int = HOUSING) -> bool:
    """Whether something is the number of a link or an element; a name, say, is none."""
    return hasattr(number, "__index__") and first <= number <= last  # type: ignore[operator]


def _link(link: int, path: Path, links: int, lowest: int = HOUSING) -> Iterator[Problem]:
    if not _is_number(link, links, lowest):
        expected = f"a link number from 1 to {links}"
        if lowest == HOUSING:
            expected += " (0 is the housing)"
        housing = " (the housing)" if link == HOUSING else ""
        yield Problem(f"read {link!r}{housing}, expected {expected}", path)


def _element(case: Transmission, element: ShiftElement, path: Path) -> Iterator[Problem]:
    first, second, links = element.first, element.second, case.links
    if not (_is_number(first, links) and _is_number(second, links)):
        yield from _link(first, (*path, "first"), links)
        yield from _link(second, (*path, "second"), links)
    if first == second:
        message = f"joins link {_called(case, first)} to itself, expected two different links"
        yield Problem(message, (*path, "second"))
    elif element.kind:
        yield from _kind(element, (*path, "kind"))
    yield from _drag(element.drag, element, (*path, "drag"))


def _drag(torque: float, element: ShiftElement | None, path: Path) -> Iterator[Problem]:
    """The drag torque of a link or of an element."""
    if not 0 <= torque < math.inf:
        message = f"read {torque:g}, expected a torque of 0 or more: drag opposes any motion"
        yield Problem(message, path)
    elif torque and element is not None and element.kind == "dog_clutch":
        yield Problem(f"read {torque:g}, but a dog clutch does not drag when it is open", path)


def _kind(element: ShiftElement, path: Path) -> Iterator[Problem]:
    """A kind that is one, and that the links of the element suit."""
    to_housing = HOUSING in (element.first, element.second)
    if element.kind not in ELEMENT_KINDS:
        kinds = ", ".join(f"`{kind}`" for kind in ELEMENT_KINDS)
        yield Problem(f"read {element.kind!r}, expected one of {kinds}", path)
    elif element.kind == "brake" and not to_housing:
        message = "a brake holds a link against the housing, expected `clutch` for two links"
        yield Problem(message, path)
    elif element.kind == "clutch" and to_housing:
        message = "a clutch joins two links, expected `brake` for a link and the housing"
        yield Problem(message, path)


def _freewheels(case: Transmission) -> Iterator[Problem]:
    """No more of them than can be tried."""
    numbers = [n for n, element in enumerate(case.shift_elements, 1) if element.is_freewheel]
    if len(numbers) > MOST_FREEWHEELS:
        message = f"{len(numbers)} freewheels, expected {MOST_FREEWHEELS} at most"
        yield Problem(message, ("shift_elements", numbers[MOST_FREEWHEELS]))


def _mechanism(mechanism: Mechanism, path: Path, links: int) -> Iterator[Problem]:
    members = [link for link in mechanism.links if link != HOUSING]
    if not all(_is_number(link, links) for link in members):
        for member, link in zip(("first", "second", "third"), mechanism.links, strict=True):
            yield from _link(link, (*path, member), links)
    if not members:
        yield Problem("all three links are the housing, expected at least one link", path)
    if len(set(members)) < len(members):
        yield Problem(f"links {mechanism.links}: expected different links", path)
    ratio = mechanism.ratio
    if not math.isfinite(ratio):
        yield Problem(f"read {ratio}, expected a finite number", (*path, "ratio"))
    elif ratio == 0:
        yield Problem("read 0, expected a ratio other than 0", (*path, "ratio"))
    elif ratio == 1 and len(members) == 3:
        message = "read 1, which joins the first link to the second and leaves the third loose"
        yield Problem(f"{message}; expected another ratio with three links", (*path, "ratio"))
    yield from _efficiencies(mechanism, path)
    given = mechanism.planet_ratio
    if given is not None and (given == 0 or not math.isfinite(given)):
        message = f"read {given:g}, expected a finite ratio other than 0"
        yield Problem(message, (*path, "planet_ratio"))


def _efficiencies(mechanism: Mechanism, path: Path) -> Iterator[Problem]:
    efficiency, back = mechanism.efficiency, mechanism.back_efficiency
    if not 0 < efficiency <= 1:
        message = f"read {efficiency:g}, expected an efficiency above 0 and up to 1"
        yield Problem(message, (*path, "efficiency"))
    if back is not None and not 0 <= back <= 1:
        message = f"read {back:g}, expected an efficiency from 0 (self-locking) to 1"
        yield Problem(message, (*path, "back_efficiency"))


def _doubtful(mechanism: Mechanism, path: Path) -> Iterator[Problem]:
    """What may be meant, but is likely to be a mistake."""
    ratio = mechanism.ratio
    if mechanism.third == HOUSING:
        return
    if ratio == 1 and HOUSING in mechanism.links:
        message = "ratio 1 leaves the third link loose"
        yield Problem(f"{message}; is another ratio meant?", (*path, "ratio"), severity="warning")
    if mechanism.planet_ratio is None and not mechanism.is_plain(ratio):
        yield Problem(
            f"ratio {ratio:g} is not that of a plain planetary set: there is no "
            "planet speed without a planet ratio",
            path,
            severity="warning",
        )


def _gear(case: Transmission, gear: Gear, path: Path) -> Iterator[Problem]:
    if gear.engaged:
        yield from _engaged(case.shift_elements, gear.engaged, (*path, "engaged"))
    ends = gear.input or case.input, gear.output or case.output or case.links
    for end, link in (("input", gear.input), ("output", gear.output)):
        if link is not None:
            yield from _link(link, (*path, end), case.links, lowest=1)
    if ends[0] == ends[1] and (gear.input is not None or gear.output is not None):
        yield Problem(f"input and output are both link {_called(case, ends[0])}", path)
    yield from _dragging(case, gear, path)
    if not gear.speeds and not gear.torques:
        return
    yield from _given(gear.speeds, (*path, "speeds"), case.links)
    yield from _given(gear.torques, (*path, "torques"), case.links)
    if ends[0] in gear.speeds:
        message = f"link {_called(case, ends[0])} is the input, whose speed is 1; expected another"
        yield Problem(message, (*path, "speeds", ends[0]))
    for link in gear.torques:
        if link == ends[1]:
            message = f"link {_called(case, link)} is the output, whose torque is calculated"
            yield Problem(f"{message}; expected another link", (*path, "torques", link))
        elif link in gear.speeds:
            message = f"link {_called(case, link)} has a given speed, so its torque is calculated"
            yield Problem(f"{message}; give one of the two", (*path, "torques", link))


def _load(load: Load | None, path: Path, *, has_freewheels: bool) -> Iterator[Problem]:
    load = load or Load()
    for quantity, value in load._asdict().items():
        if value is not None and (value == 0 or not math.isfinite(value)):
            message = f"read {value}, expected a finite number other than 0"
            yield Problem(message, (*path, "load", quantity))
    if (load.speed or 0) * (load.torque or 0) < 0:
        message = (
            f"read {load.torque:g} N*m at {load.speed:g} rpm, so power would leave at the input; "
            "expected equal signs (`coast: true` turns the torque by itself)"
        )
        yield Problem(message, (*path, "load"))
    elif has_freewheels and min(load.speed or 1, load.torque or 1) < 0:
        message = (
            "the input turns backward, but freewheels are settled for an input that turns "
            "forward; expected a speed and a torque above 0, with the links of the freewheels "
            "exchanged if the input does turn backward"
        )
        yield Problem(message, (*path, "load"))


def _dragging(case: Transmission, gear: Gear, path: Path) -> Iterator[Problem]:
    """The drag that a gear gives, of links and of open elements."""
    for link, torque in gear.drag.items():
        yield from _link(link, (*path, "drag", link), case.links, lowest=1)
        yield from _drag(torque, None, (*path, "drag", link))
    elements = case.shift_elements
    for number, torque in gear.open_drag.items():
        inner = (*path, "open_drag", number)
        if _is_number(number, len(elements), 1):
            yield from _drag(torque, elements[number - 1], inner)
        else:
            expected = f"the number of a shift element, from 1 to {len(elements)}"
            yield Problem(f"read {number!r}, expected {expected}", inner)


def _engaged(
    elements: Sequence[ShiftElement], engaged: Sequence[int], path: Path
) -> Iterator[Problem]:
    seen: set[int] = set()
    for position, element in enumerate(engaged, 1):
        if not _is_number(element, len(elements), 1):
            expected = f"the number of a shift element, from 1 to {len(elements)}"
            yield Problem(f"read {element!r}, expected {expected}", (*path, position))
        elif element in seen:
            name = elements[element - 1].name or str(element)
            message = f"element {name} is engaged twice, expected each once"
            yield Problem(message, (*path, position))
        elif elements[element - 1].is_freewheel:
            name = elements[element - 1].name or str(element)
            message = f"element {name} is a freewheel, which finds by itself whether it holds"
            yield Problem(f"{message}; leave it out", (*path, position))
        seen.add(element)


def _given(values: Mapping[int, float], path: Path, links: int) -> Iterator[Problem]:
    for link, value in values.items():
        yield from _link(link, (*path, link), links, lowest=1)
        if not math.isfinite(value):
            yield Problem(f"read {value}, expected a finite number", (*path, link))
