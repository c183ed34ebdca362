"""Checks of springs, inertias and converters; each check yields problems with paths."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from vstatics.core.errors import Path, Problem, quoted
from vstatics.core.model.converters import Converter
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.part_checks import called, expect, of_characteristic, of_link
from vstatics.core.model.parts import HOUSING, Damping, damping, element_names, mechanism_names
from vstatics.core.model.shape import STRAIGHT, UNIT_OF, InUnit
from vstatics.core.model.springs import Spring, SpringLimit, ends, spring_names
from vstatics.core.suggestions import nearest

_TURNING = {straight: turning for turning, straight in STRAIGHT.items()}


def of_torsion(case: TransmissionFields) -> Iterator[Problem]:
    """Check the inertias, springs, converters and elastic components of a case."""
    bodies = ("inertias", "an inertia", case.inertias), ("masses", "a mass", case.masses)
    for key, noun, inertias in bodies:
        for link, inertia in inertias.items():
            yield from of_link(link, (key, link), case.own_links, lowest=1)
            yield from not_negative(inertia, noun, (key, link))
            if key == "masses" and link in case.inertias:
                what = (
                    f"link {called(case, link)} is in `inertias`, too: it either "
                    "rotates or moves straight"
                )
                yield Problem("E540", f"{what}, expected the link in only one of them", (key, link))
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
        message = f"connects link {called(case, link)} to itself, expected two different links"
        yield Problem("E218", message, (*path, "second"))
        return
    shaft = ends(twist)
    for link, part in twist.items():
        place = ("second" if link == shaft[1] else "first",) if shaft else ("twist", link)
        yield from of_link(link, (*path, *place), case.own_links)
        right = math.isfinite(part) and (part != 0 or link == HOUSING)
        yield from expect(part, "a finite coefficient other than 0", (*path, *place), right=right)
    if not any(link != HOUSING for link in twist):
        message = "read an empty twist, expected at least one link with its coefficient"
        yield Problem("E251", message, (*path, "twist"))
    yield from _of_units(case, spring, path)
    yield from _of_elastic_law(case, spring, path)
    if isinstance(spring.limit, SpringLimit):
        yield from _of_followed(case, spring.limit, (*path, "limit"))
    elif spring.limit is not None:
        yield from above_0(spring.limit, "a torque", (*path, "limit"))
    yield from not_negative(spring.friction, "a torque", (*path, "friction"))


def _of_elastic_law(case: TransmissionFields, spring: Spring, path: Path) -> Iterator[Problem]:
    if spring.points:
        yield from _of_points(spring, path)
    if spring.strut:
        yield from _of_strut(case, spring, (*path, "strut"))
    given = (spring.stiffness, spring.compliance)
    damped = damping(spring.damping)
    resists = damped.viscous > 0 or spring.friction > 0
    if spring.is_damper and damped.loss_factor:
        message = "read a loss factor or damping ratio, which needs a `stiffness`"
        yield Problem("E252", f"{message}: expected one", path)
    elif spring.is_damper and given == (None, None) and not resists:
        message = "read none of `stiffness`, `compliance`, `points`, `damping` and `friction`"
        yield Problem("E252", f"{message}, expected one of them", path)
    elif None not in given:
        yield Problem("E253", "read both `stiffness` and `compliance`, expected one of them", path)
    if spring.compliance is not None:
        yield from above_0(spring.compliance, "a compliance", (*path, "compliance"))
    stiffness = None if resists and spring.stiffness == 0 else spring.stiffness
    yield from of_elastic(stiffness, spring.damping, path, always=True)


def _of_points(spring: Spring, path: Path) -> Iterator[Problem]:
    """Check the points of a spring: twists ascend, torques do not fall, other keys agree."""
    here = (*path, "points")
    for number, point in enumerate(spring.points, 1):
        for place, value in enumerate(point, 1):
            right = math.isfinite(value)
            yield from expect(value, "a finite number", (*here, number, place), right=right)
    for number, (previous, point) in enumerate(pairwise(spring.points), 2):
        rises = point[0] > previous[0]
        if not (rises and point[1] >= previous[1]):
            place, expected = (2, "torques that do not fall") if rises else (1, "twists that rise")
            yield Problem(
                "E690",
                f"read {point[place - 1]:g} after {previous[place - 1]:g}, expected {expected}",
                (*here, number, place),
            )
    first, last = spring.points[0], spring.points[-1]
    if first[0] >= 0 and (*first,) != (0, 0):
        message = f"read {first[0]:g}, {first[1]:g}, expected [0, 0] first, or a twist below 0"
        yield Problem("E691", message, (*here, 1))
    if not last[1] > first[1]:
        yield Problem("E692", "expected at least two points, and a torque that rises", here)
    yield from _beside("points", spring, path)


def _beside(key: str, spring: Spring, path: Path) -> Iterator[Problem]:
    """Report keys that `key` (points or strut) excludes."""
    given = {name: getattr(spring, name) is not None for name in ("stiffness", "compliance")}
    given |= {"limit": spring.limit is not None, "damping": damping(spring.damping).loss_factor > 0}
    for name, read in given.items():
        if read:
            what = "a loss factor or ratio" if name == "damping" else f"`{name}`"
            yield Problem(
                "E693", f"read {what} with `{key}`, expected only one of them", (*path, name)
            )


def _of_units(case: TransmissionFields, spring: Spring, path: Path) -> Iterator[Problem]:
    """Check that the units of a spring suit links that rotate or links that move along a line."""
    straight = [link for link in spring.form if link in case.masses]
    named = f"{called(case, straight[0])}, which is in" if straight else "no link of"
    numbers: list[tuple[Path, Any]] = [
        ((name,), getattr(spring, name)) for name in ("stiffness", "compliance", "friction")
    ]
    limit, damped = spring.limit, spring.damping
    numbers += [
        (("limit",), limit.base if isinstance(limit, SpringLimit) else limit),
        (("damping",), damped.viscous if isinstance(damped, Damping) else damped),
    ]
    for number, point in enumerate(spring.points, 1):
        numbers += [(("points", number, place), value) for place, value in enumerate(point, 1)]
    for inner, value in numbers:
        why = f"its twist names {named} `masses`"
        yield from _of_unit(value, why, (*path, *inner), straight=bool(straight))


def _of_unit(value: Any, why: str, path: Path, *, straight: bool) -> Iterator[Problem]:
    measure = value.measure if isinstance(value, InUnit) else None
    expected = measure and (STRAIGHT if straight else _TURNING).get(measure)
    if measure and expected:
        message = f"read a number in {UNIT_OF[measure]}, expected {UNIT_OF[expected]}"
        yield Problem("E541", f"{message}: {why}", path)


def _of_strut(case: TransmissionFields, spring: Spring, path: Path) -> Iterator[Problem]:
    """Check the strut of a spring; a counter chamber with pressure needs all dimensions."""
    strut = spring.strut
    assert strut is not None  # noqa: S101 - by the caller; for mypy
    if not case.is_straight(spring):
        yield Problem(
            "E542",
            "the twist names no link of `masses`, expected at least one: a strut acts "
            "along a straight line",
            path,
        )
    whole = ("pressure", "area", "length", "exponent")
    for name in (*whole, *["counter_length"] * (strut.counter_length is not None)):
        yield from above_0(getattr(strut, name), "a number", (*path, name))
    for name in ("counter_pressure", "counter_area"):
        yield from not_negative(getattr(strut, name), "a number", (*path, name))
    if strut.counter_pressure and not (strut.counter_area and strut.counter_length):
        message = "expected `counter_area` and `counter_length` above 0 with `counter_pressure`"
        yield Problem("E543", message, path)
    elif strut.length > 0:
        least, most = strut.reach
        if not least < strut.at < most:
            message = f"read {strut.at:g}, expected more than {least:g} and less than {most:g} m"
            yield Problem("E544", message, (*path, "at"))
        elif not strut.slope(strut.at) < math.inf:
            yield Problem("E548", "its stiffness is infinite, expected realistic dimensions", path)
    if spring.points:
        yield Problem(
            "E693", "read `points` with `strut`, expected only one of them", (*path[:-1], "points")
        )
    yield from _beside("strut", spring, path[:-1])


def _of_followed(case: TransmissionFields, limit: SpringLimit, path: Path) -> Iterator[Problem]:
    """Check the torque limit of a spring that grows with the torque of another spring.

    The other spring must have neither a limit nor friction.
    """
    yield from not_negative(limit.base, "a torque", (*path, "base"))
    right = math.isfinite(limit.times) and limit.times != 0
    yield from expect(limit.times, "a number other than 0", (*path, "times"), right=right)
    names = spring_names(case.springs)
    if limit.of not in names:
        message = f"read {quoted(limit.of)}, expected the name of a spring"
        yield Problem("E545", f"{message}{nearest(limit.of, names)}", (*path, "of"))
        return
    other = case.springs[names.index(limit.of)]
    if other.limit is not None or other.friction:
        message = (
            f"{quoted(limit.of)} has a limit or friction of its own, expected a "
            "spring without `limit`"
        )
        yield Problem("E546", f"{message} and `friction`", (*path, "of"))


def of_converter(converter: Converter, path: Path, links: int) -> Iterator[Problem]:
    """Check a converter in a case with a given number of links."""
    for place, link in zip(("first", "second"), converter.links, strict=True):
        yield from of_link(link, (*path, place), links, lowest=1)
    if converter.pump == converter.turbine:
        yield Problem("E638", "expected two different links, pump and turbine", (*path, "links"))
    yield from of_characteristic(converter.points, (*path, "points"), numbers=3)


def of_elastic(
    stiffness: float | None, damping: Damping | float, path: Path, *, always: bool = False
) -> Iterator[Problem]:
    """Check the stiffness and damping of a component; with `always`, a stiffness is required."""
    viscous, loss_factor = damping if isinstance(damping, Damping) else (damping, 0.0)
    if stiffness is not None:
        yield from above_0(stiffness, "a stiffness", (*path, "stiffness"))
    here = (*path, "damping")
    if not always:
        yield from _of_unit(viscous, "the component rotates", here, straight=False)
    yield from not_negative(viscous, "a damping", (*here, "viscous"))
    yield from not_negative(loss_factor, "a loss factor", (*here, "loss_factor"))
    if (viscous or loss_factor) and stiffness is None and not always:
        yield Problem(
            "E254", "read a damping without `stiffness`: a rigid component cannot be damped", here
        )


def above_0(number: float, what: str, path: Path) -> Iterator[Problem]:
    """Check that a number and its reciprocal are finite and above 0."""
    if not 0 < number < math.inf:
        yield Problem("E255", f"read {number:g}, expected {what} above 0", path)
    elif 1 / number == math.inf:
        yield Problem("E256", f"read {number:g}, expected {what} that is larger", path)


def not_negative(number: float, what: str, path: Path) -> Iterator[Problem]:
    """Check that a number is finite and 0 or more."""
    return expect(number, f"{what} of 0 or more", path, right=0 <= number < math.inf)


def _of_names(case: TransmissionFields) -> Iterator[Problem]:
    """Check that components have different names, under which torques and energies are listed."""
    taken = dict.fromkeys(element_names(case.shift_elements), "a shift element")
    rows: dict[str, str] = {}
    for what, name, path, members in _devices(case):
        if name in taken:
            yield Problem(
                "E257", f"`{name}` is also the name of {taken[name]}, expected another name", path
            )
        taken.setdefault(name, what)
        rows |= {f"{name}.{member}": f"a member of {name}" for member in members}
    springs = spring_names(case.springs)
    converters = [converter.name for converter in case.converters]
    for key, what, names in (
        ("springs", "a spring", springs),
        ("converters", "a converter", converters),
    ):
        for number, name in enumerate(names, 1):
            if other := taken.get(name) or rows.get(name):
                yield Problem(
                    "E257",
                    f"`{name}` is also the name of {other}, expected another name",
                    (key, number),
                )
        taken |= dict.fromkeys(names, what)


def _devices(case: TransmissionFields) -> Iterator[tuple[str, str, Path, Sequence[str]]]:
    if case.drawing is None:
        for number, name in enumerate(mechanism_names(case.mechanisms), 1):
            yield "a mechanism", name, ("mechanisms", number), ()
        return
    given = len(case.drawing.devices) - len(case.drawing.mechanisms)
    for number, device in enumerate(case.drawing.devices):
        what = "a gear set" if number < given else "a mechanism"
        members = [member.name for member in device.members]
        members += [planet.name.removeprefix(f"{device.name}.") for planet in device.planets]
        yield what, device.name, ("mechanisms", device.mechanisms[0] + 1), members
