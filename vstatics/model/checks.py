"""What a transmission as a whole must fulfil, and what is doubtful about it."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from vstatics.errors import Path, Problem, spoken, why_not_allowed
from vstatics.model.fields import MOST_CYLINDERS, TransmissionFields
from vstatics.model.part_checks import (
    called,
    doubtful,
    of_element,
    of_gear,
    of_link,
    of_load,
    of_mechanism,
    of_missing_ratios,
    sets_side_by_side,
)
from vstatics.model.parts import (
    Mechanism,
    ShiftElement,
    element_names,
    mechanism_name,
    mechanism_names,
)
from vstatics.model.springs import spring_names
from vstatics.model.vehicle import Vehicle, beside_engine, of_vehicle

MOST_FREEWHEELS = 8
"""All sets of them are tried in every gear."""


def problems(case: TransmissionFields) -> Iterator[Problem]:
    """Every error of a case, in the order of its parts."""
    yield from _sizes(case)
    yield from _drawn(case)
    yield from _names(case)
    yield from _ports(case)
    for number, element in enumerate(case.shift_elements, 1):
        yield from of_element(case, element, ("shift_elements", number))
    yield from _freewheels(case)
    for number, mechanism in enumerate(case.mechanisms, 1):
        yield from of_mechanism(mechanism, ("mechanisms", number), case.links)
    parts: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    elastic = any(part.stiffness is not None or part.damping for part in parts)
    if _moves(case) or case.converters or elastic:
        from vstatics.model.torsional_checks import of_torsion  # costs start-up time

        yield from of_torsion(case)
    if case.dump is not None or case.fatigue:
        from vstatics.model.torsional_checks import of_dump, of_fatigue  # likewise

        yield from of_dump(case)
        yield from of_fatigue(case)
    yield from of_vehicle(case.vehicle)
    yield from _cylinders(case)
    yield from of_load(case.load, ())
    for number, gear in enumerate(case.gears, 1):
        path = ("gears", number)
        yield from of_gear(case, gear, path)
        if gear.load:
            yield from of_load(case.gear_load(gear), path)
    yield from of_missing_ratios(case, open_too=False)
    yield from _laws(case)
    for number, identity in enumerate(case.allow, 1):
        if why := why_not_allowed(identity):
            yield Problem("E299", why, ("allow", number))
    if case.idle not in ("exact", "published"):
        yield Problem("E201", f"read {case.idle!r}, expected `exact` or `published`", ("idle",))


def _cylinders(case: TransmissionFields) -> Iterator[Problem]:
    number = case.cylinders
    if number is not None and not (number == int(number) and 1 <= number <= MOST_CYLINDERS):
        message = f"read {number:g} cylinders, expected a whole number from 1 to {MOST_CYLINDERS}"
        yield Problem("E740", message, ("cylinders",))


def _laws(case: TransmissionFields) -> Iterator[Problem]:
    """Drags and efficiencies that depend on speed or torque need a load."""
    if case.depends:
        from vstatics.model.laws import of_balances, without_loads  # costs start-up time

        yield from without_loads(case)
        yield from of_balances(case)


def _moves(case: TransmissionFields) -> bool:
    """Whether it is a case by its springs or inertias alone."""
    return bool(case.springs or case.inertias or case.masses)


def doubts(case: TransmissionFields) -> Iterator[Problem]:
    """The warnings alone, of a case that has no error."""
    for number, mechanism in _not_drawn(case):
        yield from doubtful(mechanism, ("mechanisms", number))
    if case.vehicle is not None:
        yield from _mass_twice(case, case.vehicle)
        yield from _units_forgotten(case.vehicle)
        yield from _machines_beside(case)
    for name, one in case.fatigue.items():
        if one.diameter and one.diameter > THICKEST_SHAFT:
            yield _no_unit(one.diameter, "m", "a shaft", ("fatigue", name, "diameter"))


LARGEST_WHEEL, THICKEST_SHAFT = 2.5, 1.0
"""Radius of the largest tyres of dumpers with a margin; a diameter. [m]"""
FASTEST_ENGINE = 3000.0
"""No engine or motor of a vehicle turns as fast, 28,600 rpm. [rad/s]"""


def _units_forgotten(vehicle: Vehicle) -> Iterator[Problem]:
    """Numbers in mm or rpm that were written without their unit."""
    if vehicle.radius > LARGEST_WHEEL:
        yield _no_unit(vehicle.radius, "m", "a wheel", ("vehicle", "radius"))
    fastest = max((speed for speed, _ in vehicle.engine), default=0.0)
    if fastest > FASTEST_ENGINE:
        yield _no_unit(fastest, "rad/s", "an engine", ("vehicle", "engine"))


def _no_unit(value: float, unit: str, what: str, path: Path) -> Problem:
    message = f"read {value:g} {unit}, more than {what} has: a bare number is in {unit}"
    return Problem("N205", message, path)


def _machines_beside(case: TransmissionFields) -> Iterator[Problem]:
    """Gears in which a vehicle is not driven."""
    for number, gear in enumerate(case.gears, 1):
        if why := beside_engine(gear, case.link_name):
            message = (
                f"it has {why}: power passes by more than engine and output, so nothing of "
                "`vehicle` is told in this gear"
            )
            yield Problem("W890", message, ("gears", number))


MASS_AGAIN = 0.5
"""Wheels and shafts have some hundredths of the inertia of the vehicle; this part is its mass."""


def _mass_twice(case: TransmissionFields, vehicle: Vehicle) -> Iterator[Problem]:
    """Outputs, with what is geared to them, that have about the inertia of the vehicle."""
    outputs = case.outputs or (case.output,)
    mass = vehicle.mass * (vehicle.radius / vehicle.final_drive) ** 2
    inertias = {
        link: case.inertias[link] * speed**2
        for link, speed in _speeds_behind(case, outputs).items()
        if case.inertias.get(link)
    }
    total = sum(inertias.values())
    if total >= MASS_AGAIN * mass:
        given = sorted(inertias, key=lambda link: -inertias[link])
        names = spoken([case.link_name(link) for link in given])
        reduced = "" if {*given} <= {*outputs} else " by the speed of the output"
        message = (
            f"{names} {'has' if len(given) == 1 else 'have'} {total:.4g} kg*m^2{reduced}, and the "
            f"mass of the vehicle is {mass:.4g} kg*m^2 there, mass*(radius/final_drive)^2, which "
            "`vehicle` adds by itself: it counts twice; leave it out of `inertias`"
        )
        yield Problem("W202", message, ("inertias", next(iter(given))))


def _speeds_behind(case: TransmissionFields, outputs: Sequence[int]) -> dict[int, float]:
    """Speeds of outputs, and of what pairs of wheels join to them, by that of the output.

    What pairs join to an input past the outputs is the side of the engine, as in a box of one
    gear: a flywheel may have half of the mass of the vehicle there.
    """
    ends = {*outputs, 0}
    inputs = [link for gear in case.gears if (link := case.gear_input(gear)) not in ends]
    before = _geared(case, inputs, ends)
    found = _geared(case, outputs, {0})
    return {link: speed for link, speed in found.items() if link in outputs or link not in before}


def _geared(
    case: TransmissionFields, starts: Sequence[int], ends: Collection[int]
) -> dict[int, float]:
    """Speeds of what pairs join to some links, by theirs; the way there does not pass `ends`."""
    found, new, pairs = dict.fromkeys(starts, 1.0), [*starts], list(_pairs(case))
    while new:
        link = new.pop()
        for one, other, speed in pairs:
            if one == link and other not in found and other not in ends:
                found[other] = found[link] * speed
                new.append(other)
    return found


def _pairs(case: TransmissionFields) -> Iterator[tuple[int, int, float]]:
    """Links that one mechanism joins at a fixed ratio, and the speed of the second by the first's.

    So does a set whose third link is the housing.
    """
    for one in case.mechanisms:
        parts = {one.first: 1.0, one.second: -one.ratio, one.third: one.ratio - 1}
        turning = [(link, part) for link, part in parts.items() if link and part]
        if not one.kind and len(turning) == 2:
            (first, of_first), (second, of_second) = turning
            yield first, second, -of_first / of_second
            yield second, first, -of_second / of_first


def hints(case: TransmissionFields) -> Iterator[Problem]:
    """Notes on what a case leaves to be guessed."""
    yield from _sharing(case)
    yield from _turning(case)


def _turning(case: TransmissionFields) -> Iterator[Problem]:
    """Gears with an input of their own, and freewheels that ask which way it turns."""
    for number, gear in enumerate(case.gears if case.freewheels else (), 1):
        if gear.input not in (None, case.input) and not case.input_turns(gear):
            message = (
                f"the input, link {case.link_name(case.gear_input(gear))}, is taken to turn "
                "forward, on which freewheels depend; say `input_turns: forward` or `backward`"
            )
            yield Problem("N201", message, ("gears", number))


def _sharing(case: TransmissionFields) -> Iterator[Problem]:
    """Mechanisms that look as if planets were shared, whose losses are then doubtful.

    Such mechanisms have the third link and one wheel in common, and losses.
    """
    sets = (
        (number, one.name or mechanism_name(number), one.third, one.links[:2])
        for number, one in _not_drawn(case)
        if one.efficiency != 1
    )
    for number, other in sets_side_by_side(sets):
        message = (
            f"shares a wheel and the carrier with {other}: if they share planets too, the "
            "losses of this form are not exact; give the set as an element, or each mesh as a "
            "mechanism (example: `vstatics check --explain N202`)"
        )
        yield Problem("N202", message, ("mechanisms", number))


def _not_drawn(case: TransmissionFields) -> list[tuple[int, Mechanism]]:
    """Mechanisms, the last ones, that were not made from elements, which are checked as such."""
    return list(enumerate(case.mechanisms, 1))[case.own_mechanisms]


def _sizes(case: TransmissionFields) -> Iterator[Problem]:
    """Sizes that devices can fill; so no case asks for more memory than its text holds."""
    joined = 2 * len(case.shift_elements) + 3 * len(case.mechanisms)
    joined += sum(len(spring.twist) for spring in case.springs) + len(case.heavy)
    moves = _moves(case)
    if case.links < (1 if moves else 2):
        expected = "at least 1 link" if moves else "at least 2 links (input and output)"
        yield Problem("E202", f"read {case.links}, expected {expected}", ("links",))
    elif case.links > max(joined, 2):
        yield Problem(
            "E203",
            f"read {case.links} links, but {_counted(case)} can join {joined} at most",
            ("links",),
        )
    if case.link_names and len(case.link_names) != case.links:
        message = f"{case.links} links, but {len(case.link_names)} names of links"
        yield Problem("E204", message, ("link_names",))
    if not case.gears and not moves:
        yield Problem("E205", "there is no gear, expected at least one", ("gears",))


def _counted(case: TransmissionFields) -> str:
    """What can join links, in words."""
    parts = [f"{len(case.shift_elements)} shift elements", f"{len(case.mechanisms)} mechanisms"]
    parts += [f"{len(case.springs)} springs"] * bool(case.springs)
    return spoken(parts + [f"{len(case.heavy)} inertias"] * bool(case.heavy))


def _names(case: TransmissionFields) -> Iterator[Problem]:
    """Names are one line of text, and each is the only one of its kind."""
    gears = [gear.name or str(number) for number, gear in enumerate(case.gears, 1)]
    yield from _distinct(case.link_names, "link_names", "link")
    yield from _distinct(element_names(case.shift_elements), "shift_elements", "shift element")
    yield from _distinct(mechanism_names(case.mechanisms), "mechanisms", "mechanism")
    yield from _distinct(gears, "gears", "gear")
    yield from _distinct(spring_names(case.springs), "springs", "spring")
    for number, name in enumerate(case.link_names, 1):
        if name in ("0", "housing"):
            message = f"`{name}` is the housing, expected another name for link {number}"
            yield Problem("E206", message, ("link_names", number))
    if case.name and not _is_name(case.name):
        yield Problem("E207", f"read {case.name!r}, expected one line of text", ("name",))


def _drawn(case: TransmissionFields) -> Iterator[Problem]:
    """As many mechanisms as the drawing has: they follow from it."""
    if case.drawing is None:
        return
    count = sum(len(device.mechanisms) for device in case.drawing.devices)
    if len(case.mechanisms) != count:
        message = f"read {len(case.mechanisms)}, but the drawing has {count}; change the drawing"
        yield Problem("E208", message, ("mechanisms",))


def _outputs(case: TransmissionFields) -> Iterator[Problem]:
    """Several outputs: different links, `output` first, the input not among them."""
    for number, link in enumerate(case.outputs, 1):
        path = ("outputs", number)
        yield from of_link(link, path, case.own_links, lowest=1)
        if link in case.outputs[: number - 1]:
            yield Problem("E209", f"link {called(case, link)} is an output twice", path)
        if link == case.input and number > 1:
            yield Problem("E210", f"link {called(case, link)} is the input, expected another", path)
    if case.outputs and case.output not in (0, case.outputs[0]):
        first, given = (called(case, link) for link in (case.outputs[0], case.output))
        message = f"the first output is {first}, but `output` is {given}; leave one of them out"
        yield Problem("E211", message, ("outputs",))


def _distinct(names: Sequence[str], part: str, kind: str) -> Iterator[Problem]:
    if len(set(names)) == len(names) and all(map(_is_name, names)):
        return
    seen: dict[str, int] = {}
    for number, name in enumerate(names, 1):
        if not _is_name(name):
            message = f"{name!r} is no name: expected one line of text, no blanks at its ends"
            yield Problem("E212", message, (part, number))
        elif name in seen:
            message = f"{kind} {number} has the name `{name}` of {kind} {seen[name]}"
            yield Problem("E213", message, (part, number))
        seen.setdefault(name, number)


def _is_name(name: str) -> bool:
    return bool(name) and name == name.strip() and name.isprintable()


def _ports(case: TransmissionFields) -> Iterator[Problem]:
    yield from of_link(case.input, ("input",), case.own_links, lowest=1)
    yield from of_link(case.main_output, ("output",), case.own_links, lowest=1)
    yield from _outputs(case)
    if case.input == case.main_output and not (_moves(case) and case.links == 1):
        yield Problem(
            "E214", f"input and output are both link {called(case, case.input)}", ("output",)
        )


def _freewheels(case: TransmissionFields) -> Iterator[Problem]:
    """No more of them than can be tried."""
    numbers = case.freewheels
    if len(numbers) > MOST_FREEWHEELS:
        message = f"{len(numbers)} freewheels, expected {MOST_FREEWHEELS} at most"
        yield Problem("E215", message, ("shift_elements", numbers[MOST_FREEWHEELS]))
