"""What single parts must fulfil: links, shift elements, mechanisms; problems with paths."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.errors import Path, Problem
from vstatics.model.fields import TransmissionFields
from vstatics.model.parts import ELEMENT_KINDS, HOUSING, Mechanism, OfLoad, ShiftElement


def called(case: TransmissionFields, link: int) -> str:
    """The name of a link, or its number."""
    if link == HOUSING:
        return "0 (the housing)"
    return case.link_names[link - 1] if 0 < link <= len(case.link_names) else str(link)


def is_number(number: object, last: int, first: int = HOUSING) -> bool:
    """Whether something is the number of a link or an element; a name, say, is none."""
    return hasattr(number, "__index__") and first <= number <= last  # type: ignore[operator]


def of_link(link: int, path: Path, links: int, lowest: int = HOUSING) -> Iterator[Problem]:
    """A number that a link has."""
    if not is_number(link, links, lowest):
        expected = f"a link number from 1 to {links}"
        if lowest == HOUSING:
            expected += " (0 is the housing)"
        housing = " (the housing)" if link == HOUSING else ""
        yield Problem(f"read {link!r}{housing}, expected {expected}", path)


def of_element(case: TransmissionFields, element: ShiftElement, path: Path) -> Iterator[Problem]:
    """The links, the kind, the drag and the capacity of a shift element."""
    first, second, links = element.first, element.second, case.own_links
    if not (is_number(first, links) and is_number(second, links)):
        yield from of_link(first, (*path, "first"), links)
        yield from of_link(second, (*path, "second"), links)
    if first == second:
        message = f"joins link {called(case, first)} to itself, expected two different links"
        yield Problem(message, (*path, "second"))
    elif element.kind:
        yield from _kind(element, (*path, "kind"))
    yield from of_drag(element.drag, element, (*path, "drag"))
    if element.capacity is not None and not 0 < _told(element.capacity) < math.inf:
        message = f"read {element.capacity:g}, expected a torque above 0"
        yield Problem(message, (*path, "capacity"))
    if not 1 <= element.static < math.inf:
        yield Problem(f"read {element.static:g}, expected 1 or more", (*path, "static"))
    if element.friction is not None:
        from vstatics.model.friction import of_friction  # others do without

        yield from of_friction(element.friction, (*path, "friction"))


def _told(torque: float) -> float:
    """A torque as it was given."""
    return torque.given if isinstance(torque, OfLoad) else torque


def of_drag(torque: float, element: ShiftElement | None, path: Path) -> Iterator[Problem]:
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


def of_mechanism(mechanism: Mechanism, path: Path, links: int) -> Iterator[Problem]:
    """The links and the numbers of a mechanism."""
    members = [link for link in mechanism.links if link != HOUSING]
    if not all(is_number(link, links) for link in members):
        for member, link in zip(("first", "second", "third"), mechanism.links, strict=True):
            yield from of_link(link, (*path, member), links)
    if not members:
        yield Problem("all three links are the housing, expected at least one link", path)
    if len(set(members)) < len(members):
        yield Problem(f"links {mechanism.links}: expected different links", path)
    ratio = mechanism.ratio
    if not math.isfinite(ratio):
        yield Problem(f"read {ratio}, expected a finite number", (*path, "ratio"))
    elif ratio == 0:
        yield Problem("read 0, expected a ratio other than 0", (*path, "ratio"))
    yield from of_efficiency(mechanism.efficiency, (*path, "efficiency"))
    yield from of_back_efficiency(mechanism.back_efficiency, (*path, "back_efficiency"))
    planet_ratio = mechanism.planet_ratio
    if planet_ratio is not None and (planet_ratio == 0 or not math.isfinite(planet_ratio)):
        message = f"read {planet_ratio:g}, expected a finite ratio other than 0"
        yield Problem(message, (*path, "planet_ratio"))


def of_efficiency(value: float, path: Path) -> Iterator[Problem]:
    """The efficiency of a mechanism, an element or a mesh."""
    if not 0 < value <= 1:
        yield Problem(f"read {value:g}, expected an efficiency above 0 and up to 1", path)


def of_back_efficiency(value: float | None, path: Path) -> Iterator[Problem]:
    """The efficiency of power that flows back, if it is another one."""
    if value is not None and not 0 <= value <= 1:
        message = f"read {value:g}, expected an efficiency from 0 (self-locking) to 1"
        yield Problem(message, path)


def doubtful(mechanism: Mechanism, path: Path) -> Iterator[Problem]:
    """What may be meant, but may be a mistake too."""
    ratio = mechanism.ratio
    if mechanism.third == HOUSING:
        return
    if ratio == 1:
        message = (
            "with ratio 1 the first link turns as the second whatever the third does, which takes "
            "torque by losses only"
        )
        yield Problem(message, (*path, "ratio"), severity="note")
    if mechanism.planet_ratio is None and not mechanism.is_plain(ratio):
        yield Problem(
            f"ratio {ratio:g} is not that of a plain planetary set: there is no "
            "planet speed without a planet ratio",
            path,
            severity="note" if ratio == -1 else "warning",  # as bevel differentials have it
        )
