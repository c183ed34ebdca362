"""What springs, dampings and inertias must fulfil; problems with paths."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.errors import Path, Problem
from vstatics.model.damping import Damping
from vstatics.model.fields import TransmissionFields
from vstatics.model.part_checks import called, of_link
from vstatics.model.parts import HOUSING, element_name, mechanism_name
from vstatics.model.springs import Spring, spring_name


def of_torsion(case: TransmissionFields) -> Iterator[Problem]:
    """The inertias and springs of a case, and what is elastic of its devices."""
    yield from _of_inertias(case)
    for number, spring in enumerate(case.springs, 1):
        yield from _of_spring(case, spring, ("springs", number))
    for number, element in enumerate(case.shift_elements, 1):
        yield from of_elastic(element.stiffness, element.damping, ("shift_elements", number))
    for number, mechanism in enumerate(case.mechanisms, 1):
        yield from of_elastic(mechanism.stiffness, mechanism.damping, ("mechanisms", number))
    if case.springs:
        yield from _of_names(case)


def _of_inertias(case: TransmissionFields) -> Iterator[Problem]:
    for link, inertia in case.inertias.items():
        path = ("inertias", link)
        yield from of_link(link, path, case.own_links, lowest=1)
        yield from not_negative(inertia, "an inertia", path)


def _of_spring(case: TransmissionFields, spring: Spring, path: Path) -> Iterator[Problem]:
    twist = dict(spring.twist)
    if len(twist) < len(spring.twist):
        link = next(iter(twist))
        message = f"joins link {called(case, link)} to itself, expected two different links"
        yield Problem(message, path)
        return
    for link, part in twist.items():
        yield from of_link(link, (*path, "twist", link), case.own_links)
        if not math.isfinite(part) or (part == 0 and link != HOUSING):
            message = f"read {part:g}, expected a finite coefficient other than 0"
            yield Problem(message, (*path, "twist", link))
    if not any(link != HOUSING for link in twist):
        message = "the twist is empty, expected at least one link with its coefficient"
        yield Problem(message, (*path, "twist"))
    given = (spring.stiffness, spring.compliance)
    if given.count(None) != 1:
        read = "neither" if given.count(None) == 2 else "both"
        yield Problem(f"read {read}, expected either `stiffness` or `compliance`", path)
    if spring.compliance is not None:
        yield from above_0(spring.compliance, "a compliance", (*path, "compliance"))
    yield from of_elastic(spring.stiffness, spring.damping, path, always=True)


def of_elastic(
    stiffness: float | None, damping: Damping | float, path: Path, *, always: bool = False
) -> Iterator[Problem]:
    """The stiffness and damping of a device; what is rigid (unless `always` elastic) has none."""
    if stiffness is not None:
        yield from above_0(stiffness, "a stiffness", (*path, "stiffness"))
    viscous, loss_factor = damping if isinstance(damping, Damping) else (damping, 0.0)
    here = (*path, "damping")
    yield from not_negative(viscous, "a damping", here)
    yield from not_negative(loss_factor, "a loss factor", here)
    if (viscous or loss_factor) and stiffness is None and not always:
        yield Problem("there is a damping without `stiffness`: what is rigid can't be damped", here)


def above_0(number: float, what: str, path: Path) -> Iterator[Problem]:
    """A finite number above 0."""
    if not 0 < number < math.inf or not 0 < 1 / number < math.inf:
        yield Problem(f"read {number:g}, expected {what} above 0", path)


def not_negative(number: float, what: str, path: Path) -> Iterator[Problem]:
    """A finite number of 0 or more."""
    if not 0 <= number < math.inf:
        yield Problem(f"read {number:g}, expected {what} of 0 or more", path)


def _of_names(case: TransmissionFields) -> Iterator[Problem]:
    """Torques are told by names of devices, so springs are called like nothing else."""
    taken: dict[str, str] = {}
    for number, element in enumerate(case.shift_elements, 1):
        taken[element.name or element_name(number, element)] = "shift element"
    for number, mechanism in enumerate(case.mechanisms, 1):
        name = mechanism.name or mechanism_name(number)
        if taken.get(name) == "shift element":
            path: Path = ("mechanisms", number)
            yield Problem(f"`{name}` is the name of a shift element too, expected another", path)
        taken[name] = "mechanism"
    names = [spring.name or spring_name(number) for number, spring in enumerate(case.springs, 1)]
    for number, name in enumerate(names, 1):
        if name in taken:
            message = f"`{name}` is the name of a {taken[name]} too, expected another"
            yield Problem(message, ("springs", number))


def spring_ends(case: TransmissionFields) -> int:
    """How many ends of devices springs have, for the links that they can join."""
    return sum(len(spring.twist) for spring in case.springs)
