"""What springs, inertias, fatigue strengths, a dumped clutch must fulfil; problems with paths."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from vstatics.errors import Path, Problem, nearest, quoted
from vstatics.model.clutch_dump import NEEDED, NUMBERS
from vstatics.model.converters import Converter
from vstatics.model.fields import TransmissionFields
from vstatics.model.part_checks import called, expect, of_characteristic, of_link
from vstatics.model.parts import HOUSING, Damping, damping, element_name, mechanism_name
from vstatics.model.springs import Spring, ends, spring_name


def of_torsion(case: TransmissionFields) -> Iterator[Problem]:
    """The inertias and springs of a case, what is elastic of its devices, and their names."""
    for link, inertia in case.inertias.items():
        path = ("inertias", link)
        yield from of_link(link, path, case.own_links, lowest=1)
        yield from not_negative(inertia, "an inertia", path)
    for number, spring in enumerate(case.springs, 1):
        yield from _of_spring(case, spring, ("springs", number))
    for number, element in enumerate(case.shift_elements, 1):
        yield from of_elastic(element.stiffness, element.damping, ("shift_elements", number))
    for number, mechanism in enumerate(case.mechanisms, 1):
        yield from of_elastic(mechanism.stiffness, mechanism.damping, ("mechanisms", number))
    for number, converter in enumerate(case.converters, 1):
        yield from of_converter(converter, ("converters", number), case.own_links)
    yield from _of_names(case)


def _of_spring(case: TransmissionFields, spring: Spring, path: Path) -> Iterator[Problem]:
    twist = dict(spring.twist)
    if len(twist) < len(spring.twist):
        link = next(iter(twist))
        message = f"joins link {called(case, link)} to itself, expected two different links"
        yield Problem("E218", message, (*path, "second"))
        return
    shaft = ends(twist)
    for link, part in twist.items():
        place = ("second" if link == shaft[1] else "first",) if shaft else ("twist", link)
        yield from of_link(link, (*path, *place), case.own_links)
        right = math.isfinite(part) and (part != 0 or link == HOUSING)
        what = "a finite coefficient other than 0"
        yield from expect(part, what, (*path, *place), right=right)
    if not any(link != HOUSING for link in twist):
        message = "the twist is empty, expected at least one link with its coefficient"
        yield Problem("E251", message, (*path, "twist"))
    if spring.points:
        yield from _of_points(spring, path)
    given = (spring.stiffness, spring.compliance)
    if given.count(None) == 2 and not spring.points:
        message = "there is no `stiffness`, no `compliance` and no `points`, expected one of them"
        yield Problem("E252", message, path)
    elif None not in given:
        yield Problem("E253", "read both `stiffness` and `compliance`, expected one of them", path)
    if spring.compliance is not None:
        yield from above_0(spring.compliance, "a compliance", (*path, "compliance"))
    yield from of_elastic(spring.stiffness, spring.damping, path, always=True)
    if spring.limit is not None:
        yield from above_0(spring.limit, "a torque", (*path, "limit"))
    yield from not_negative(spring.friction, "a torque", (*path, "friction"))


def _of_points(spring: Spring, path: Path) -> Iterator[Problem]:
    """Twists that rise, torques that do not fall, and nothing beside them that they exclude."""
    here = (*path, "points")
    for number, point in enumerate(spring.points, 1):
        for place, value in enumerate(point, 1):
            right = math.isfinite(value)
            yield from expect(value, "a finite number", (*here, number, place), right=right)
    for number, (one, other) in enumerate(pairwise(spring.points), 2):
        rises = other[0] > one[0]
        if not (rises and other[1] >= one[1]):
            place, expected = (2, "torques that do not fall") if rises else (1, "twists that rise")
            message = f"read {other[place - 1]:g} behind {one[place - 1]:g}, expected {expected}"
            yield Problem("E690", message, (*here, number, place))
    first, last = spring.points[0], spring.points[-1]
    if first[0] >= 0 and (*first,) != (0, 0):
        message = f"read {first[0]:g}, {first[1]:g}, expected [0, 0] first, or a twist below 0"
        yield Problem("E691", message, (*here, 1))
    if not last[1] > first[1]:
        yield Problem("E692", "expected two points at least, and a torque that rises", here)
    given = {name: getattr(spring, name) is not None for name in ("stiffness", "compliance")}
    given |= {"limit": spring.limit is not None, "damping": damping(spring.damping).loss_factor > 0}
    for name, read in given.items():
        if read:
            what = "a loss factor or ratio" if name == "damping" else f"`{name}`"
            yield Problem("E693", f"read {what} beside `points`, expected none", (*path, name))


def of_converter(converter: Converter, path: Path, links: int) -> Iterator[Problem]:
    """What is wrong with a converter between two of so many links."""
    for place, link in zip(("first", "second"), converter.links, strict=True):
        yield from of_link(link, (*path, place), links, lowest=1)
    if converter.pump == converter.turbine:
        yield Problem("E638", "expected two different links, pump and turbine", (*path, "links"))
    yield from of_characteristic(converter.points, (*path, "points"), numbers=3)


def of_elastic(
    stiffness: float | None, damping: Damping | float, path: Path, *, always: bool = False
) -> Iterator[Problem]:
    """The stiffness and damping of a device; what is rigid (unless `always` elastic) has none."""
    if stiffness is not None:
        yield from above_0(stiffness, "a stiffness", (*path, "stiffness"))
    viscous, loss_factor = damping if isinstance(damping, Damping) else (damping, 0.0)
    here = (*path, "damping")
    yield from not_negative(viscous, "a damping", (*here, "viscous"))
    yield from not_negative(loss_factor, "a loss factor", (*here, "loss_factor"))
    if (viscous or loss_factor) and stiffness is None and not always:
        yield Problem(
            "E254", "there is a damping without `stiffness`: what is rigid can't be damped", here
        )


def above_0(number: float, what: str, path: Path) -> Iterator[Problem]:
    """A finite number above 0."""
    if not 0 < number < math.inf:
        yield Problem("E255", f"read {number:g}, expected {what} above 0", path)
    elif 1 / number == math.inf:
        yield Problem("E256", f"read {number:g}, expected {what} that is not so small", path)


def not_negative(number: float, what: str, path: Path) -> Iterator[Problem]:
    """A finite number of 0 or more."""
    return expect(number, f"{what} of 0 or more", path, right=0 <= number < math.inf)


def _of_names(case: TransmissionFields) -> Iterator[Problem]:
    """Torques and energies are told by names, so everything that has one is called otherwise."""
    taken: dict[str, str] = {}
    for number, element in enumerate(case.shift_elements, 1):
        taken[element.name or element_name(number, element)] = "a shift element"
    rows: dict[str, str] = {}
    for what, name, path, members in _devices(case):
        if name in taken:
            message = f"`{name}` is the name of {taken[name]} too, expected another"
            yield Problem("E257", message, path)
        taken.setdefault(name, what)
        rows |= {f"{name}.{member}": f"a member of {name}" for member in members}
    names = [spring.name or spring_name(number) for number, spring in enumerate(case.springs, 1)]
    for number, name in enumerate(names, 1):
        if other := taken.get(name) or rows.get(name):
            message = f"`{name}` is the name of {other} too, expected another"
            yield Problem("E257", message, ("springs", number))
    taken |= dict.fromkeys(names, "a spring")
    for number, converter in enumerate(case.converters, 1):
        if other := taken.get(converter.name) or rows.get(converter.name):
            message = f"`{converter.name}` is the name of {other} too, expected another"
            yield Problem("E257", message, ("converters", number))


def _devices(case: TransmissionFields) -> Iterator[tuple[str, str, Path, Sequence[str]]]:
    """Mechanisms and drawn elements: what each is, its name, its path, names of its members."""
    if case.drawing is None:
        for number, mechanism in enumerate(case.mechanisms, 1):
            name = mechanism.name or mechanism_name(number)
            yield "a mechanism", name, ("mechanisms", number), ()
        return
    given = len(case.drawing.devices) - len(case.drawing.mechanisms)
    for number, device in enumerate(case.drawing.devices):
        what = "an element" if number < given else "a mechanism"
        members = [member.name for member in device.members]
        members += [planet.name.removeprefix(f"{device.name}.") for planet in device.planets]
        yield what, device.name, ("mechanisms", device.mechanisms[0] + 1), members


def of_dump(case: TransmissionFields) -> Iterator[Problem]:
    """Links that there are, each once, and numbers above 0."""
    dump = case.dump
    if dump is None:
        return
    seen: dict[int, str] = {}
    for name, links in dump.masses.items():
        if not links and name in NEEDED:
            yield Problem("E259", "there is no link, expected one at least", ("dump", name))
        for number, link in enumerate(links, 1):
            path: Path = ("dump", name, number)
            yield from of_link(link, path, case.own_links, lowest=1)
            if link in seen:
                message = f"link {called(case, link)} is in {seen[link]} already"
                yield Problem("E260", f"{message}, expected each link once", path)
            seen.setdefault(link, name)
    if dump.to is not None:
        yield from of_link(dump.to, ("dump", "to"), case.own_links, lowest=1)
    for name in NUMBERS:
        value = getattr(dump, name)
        if value is not None:
            right = value > 0 and (value < math.inf or name == "M_phi")
            yield from expect(value, "a number above 0", ("dump", name), right=right)


_STRENGTHS = {
    "endurance": "an endurance",
    "exponent": "an exponent",
    "cycles": "a number of cycles",
    "diameter": "a diameter",
    "section_modulus": "a section modulus",
    "sum": "a sum of damages",
}
_PARTS = {"asymmetry": "an asymmetry", "threshold": "a threshold"}


def of_fatigue(case: TransmissionFields) -> Iterator[Problem]:
    """What is wrong in the fatigue strengths of a case."""
    names = [*_device_names(case)]
    for number, (name, fatigue) in enumerate(case.fatigue.items(), 1):
        path = ("fatigue", number)
        if name not in names:
            hint = nearest(name, names) or ", expected the name of a spring or another device"
            yield Problem("E880", f"there is no device {quoted(name)}{hint}", path)
        if (fatigue.diameter is None) == (fatigue.section_modulus is None):
            read = "neither `diameter` nor" if fatigue.diameter is None else "both `diameter` and"
            message = f"read {read} `section_modulus`, expected one of them"
            yield Problem("E881", message, path)
        for key, value in fatigue._asdict().items():
            if key in _PARTS:
                yield from not_negative(value, _PARTS[key], (*path, key))
            elif value is not None:
                yield from above_0(value, _STRENGTHS[key], (*path, key))


def _device_names(case: TransmissionFields) -> Iterable[str]:
    """Of shift elements, mechanisms and springs, as they will be filled in."""
    for number, element in enumerate(case.shift_elements, 1):
        yield element.name or element_name(number, element)
    for number, mechanism in enumerate(case.mechanisms, 1):
        yield mechanism.name or mechanism_name(number)
    for number, spring in enumerate(case.springs, 1):
        yield spring.name or spring_name(number)
