"""Checks of a transmission as a whole: errors, warnings and notes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.core.annexes import KEYS, module_of_key, not_installed
from vstatics.core.errors import CaseError, Path, Problem, spoken
from vstatics.core.model.carried import CaseKey, installed_keys
from vstatics.core.model.fields import MOST_CYLINDERS, TransmissionFields
from vstatics.core.model.part_checks import (
    called,
    doubtful,
    no_unit,
    of_element,
    of_gear,
    of_link,
    of_link_drag,
    of_load,
    of_mechanism,
    of_missing_ratios,
    sets_side_by_side,
)
from vstatics.core.model.parts import (
    Damping,
    Law,
    Mechanism,
    OfLoad,
    ShiftElement,
    element_names,
    mechanism_name,
    mechanism_names,
)
from vstatics.core.model.springs import spring_names
from vstatics.core.suggestions import why_not_allowed

MOST_FREEWHEELS = 8
"""Largest number of freewheels in a case.

The solver can try all combinations of holding freewheels in every gear: at most 2^8.
"""
LARGE_DRAG = 0.05
"""Largest plausible relative drag torque; a larger number was probably meant in N*m. [-]"""
LARGE_TWIST = 12.0
"""Largest plausible twist of a spring, about two turns. [rad]"""
LARGE_DAMPING = 2.0
"""Damping ratio from which % was probably meant; parts of gearboxes have 0.01 to 0.1. [-]"""
LARGE_SLIP = 5.0
"""Largest plausible relative slip; a larger number was probably meant in rpm or rad/s. [-]"""


def problems(case: TransmissionFields) -> Iterator[Problem]:
    """Yield every error of a case, in the order of parts."""
    yield from _sizes(case)
    yield from _drawn(case)
    yield from _names(case)
    yield from _ports(case)
    for number, element in enumerate(case.shift_elements, 1):
        yield from of_element(case, element, ("shift_elements", number))
    if len(case.freewheels) > MOST_FREEWHEELS:
        message = f"{len(case.freewheels)} freewheels, expected {MOST_FREEWHEELS} at most"
        path = ("shift_elements", case.freewheels[MOST_FREEWHEELS])
        yield Problem("E215", message, path)
    for number, mechanism in enumerate(case.mechanisms, 1):
        yield from of_mechanism(mechanism, ("mechanisms", number), case.links)
    yield from _in_motion(case)
    yield from _cylinders(case)
    yield from of_load(case.load, ())
    yield from of_link_drag(case, case.drag, ())
    for number, gear in enumerate(case.gears, 1):
        path = ("gears", number)
        yield from of_gear(case, gear, path)
        if gear.load:
            yield from of_load(gear.load, path)
    yield from of_missing_ratios(case, open_too=False)
    if any(gear.balance is not None for gear in case.gears):
        from vstatics.core.model.laws import of_balances  # costs start-up time

        yield from of_balances(case)
    for number, identity in enumerate(case.allow, 1):
        if why := why_not_allowed(identity):
            yield Problem("E299", why, ("allow", number))
    if case.idle not in ("exact", "published"):
        yield Problem("E201", f"read {case.idle!r}, expected `exact` or `published`", ("idle",))


def _in_motion(case: TransmissionFields) -> Iterator[Problem]:
    """Yield errors in data for simulation and vibration, and in data of annexes."""
    parts: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    elastic = any(part.stiffness is not None or part.damping for part in parts)
    if _moves(case) or case.converters or elastic:
        from vstatics.core.model.torsional_checks import of_torsion  # costs start-up time

        yield from of_torsion(case)
    if case.links <= max(_most_links(case), 2):  # checks of annexes list all links in memory
        for key in carried_keys(case):
            yield from key.problems(case)


def carried_keys(case: TransmissionFields) -> list[CaseKey]:
    """Return the declarations of the keys of annexes under which a case has data."""
    names = [name for name in KEYS if getattr(case, name) not in (None, {})]
    for name in names:
        if not module_of_key(name):
            raise CaseError("E014", not_installed(name, KEYS[name]))
    return installed_keys(names) if names else []


def left_out(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes about data that simulation and vibration ignore."""
    for key in carried_keys(case):
        yield from key.left_out(case)


def _cylinders(case: TransmissionFields) -> Iterator[Problem]:
    number = case.cylinders
    if number is not None and not (number == int(number) and 1 <= number <= MOST_CYLINDERS):
        message = f"read {number:g} cylinders, expected a whole number from 1 to {MOST_CYLINDERS}"
        yield Problem("E740", message, ("cylinders",))


def _moves(case: TransmissionFields) -> bool:
    """Return whether a case has springs, inertias or masses, and so needs no gears."""
    return bool(case.springs or case.inertias or case.masses)


def doubts(case: TransmissionFields) -> Iterator[Problem]:
    """Yield warnings about a case that has no errors."""
    yield from doubtful_mechanisms(case)
    for key in carried_keys(case):
        yield from key.doubts(case)
    yield from case.derived(_bare_drags)
    yield from _bare_slips(case)
    yield from _bare_twists(case)


def doubtful_mechanisms(case: TransmissionFields) -> Iterator[Problem]:
    """Yield warnings about single mechanisms, which do not depend on other parts of the case."""
    for number, mechanism in _own_mechanisms(case):
        yield from doubtful(mechanism, ("mechanisms", number))


def _bare_slips(case: TransmissionFields) -> Iterator[Problem]:
    """Warn about unitless slips that are probably in rpm or rad/s."""
    for number, gear in enumerate(case.gears, 1):
        for owner, slip in gear.slip.items():
            if abs(slip) > LARGE_SLIP and not isinstance(slip, OfLoad):
                speed = case.gear_load(gear).speed
                size = "" if speed is None else f", {slip * speed:g} rpm"
                yield Problem(
                    "W440",
                    f"the slip of {case.shift_elements[owner - 1].name} has no unit, so it is "
                    f"{slip:g} times the input speed{size}; if it is meant in rpm, write "
                    f"`{slip:g} rpm`",
                    ("gears", number, "slip", owner),
                )


def _bare_twists(case: TransmissionFields) -> Iterator[Problem]:
    """Note unitless twists that are probably in degrees, and damping ratios probably in %."""
    for number, spring in enumerate(case.springs, 1):
        largest = max((abs(point[0]) for point in spring.points), default=0.0)
        if largest > LARGE_TWIST and not case.is_straight(spring):
            yield no_unit(largest, "rad", "a spring", ("springs", number, "points"))
    for key in ("springs", "mechanisms", "shift_elements"):
        for number, part in enumerate(getattr(case, key), 1):
            given = part.damping
            if isinstance(given, Damping) and (ratio := given.loss_factor / 2) >= LARGE_DAMPING:
                message = f"read a damping ratio of {ratio:g}, more than most parts can have"
                hint = f"write a ratio in % as `{ratio:g}%`"
                yield Problem("N205", f"{message}: {hint}", (key, number, "damping"))


def _bare_drags(case: TransmissionFields) -> list[Problem]:
    """Warn about unitless drags that are probably in N*m: large, or next to drags with a unit."""
    elements = {number: element.drag for number, element in enumerate(case.shift_elements, 1)}
    paths = {number: ("shift_elements", number, "drag") for number in elements}
    torque = case.load.torque if case.load else None
    of_case: dict[int, Path] = {link: ("drag", link) for link in case.drag}
    problems = [
        *_bare(case, of_case, case.drag, torque),
        *_bare(case, paths, elements, torque),
    ]
    for number, gear in enumerate(case.gears, 1):
        for key, drags in (("drag", gear.drag), ("open_drag", gear.open_drag)):
            if drags:
                of_gear = {part: ("gears", number, key, part) for part in drags}
                problems += _bare(case, of_gear, drags, case.gear_load(gear).torque)
    return problems


def _bare(
    case: TransmissionFields,
    paths: Mapping[int, Path],
    drags: Mapping[int, float],
    torque: float | None,
) -> Iterator[Problem]:
    """Warn about drags without a unit that are probably in N*m; `torque` is the input torque."""
    bare = {part: drag for part, drag in drags.items() if not isinstance(drag, Law | OfLoad)}
    has_units = len(bare) < len(drags)
    for part, drag in bare.items():
        if drag > LARGE_DRAG or (drag and has_units):
            path = paths[part]
            is_link = "drag" in path[:-1]
            name = case.link_name(part) if is_link else case.shift_elements[part - 1].name
            size = "" if torque is None else f", {drag * abs(torque):g} N*m"
            yield Problem(
                "W440",
                f"the drag of {name} has no unit, so it is {drag:g} of the input torque{size}; "
                f"if it is meant in N*m, write `{drag:g} N*m`",
                path,
            )


def hints(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes on shared planets, assumed input directions, repeated gears and ignored data."""
    sets = (
        (number, mechanism.name or mechanism_name(number), mechanism.third, mechanism.links[:2])
        for number, mechanism in _own_mechanisms(case)
        if mechanism.efficiency != 1
    )
    for number, other in sets_side_by_side(sets):
        yield Problem(
            "N202",
            f"shares a central gear and the carrier with {other}: if they also share planets, the "
            "losses of this form are not exact; give the planets as one gear set (example: "
            "`vstatics new -t ravigneaux`), or each mesh as a mechanism",
            ("mechanisms", number),
        )
    yield from _turning(case)
    yield from _twins(case)
    if case.springs:
        yield from notes_on_vibration(case)


def notes_on_vibration(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes about data that vibration ignores, and springs that never twist in vibration.

    A spring at the input causes no note, because the motion of the input can be given. A given
    inertia of 0 causes no note either, because it is deliberate.
    """
    yield from left_out(case)
    connections, known = case.connections, {case.input, *case.heavy}
    for number, spring in enumerate(case.springs, 1):
        for link in spring.form:
            if connections[link] == 1 and link not in known:
                yield Problem(
                    "N207",
                    f"nothing else acts on link {case.link_name(link)}, which has no inertia, so "
                    "the spring never twists in vibration; give the link an inertia",
                    ("springs", number),
                )


def _turning(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes about gears with another input link than the case, assumed to turn forward."""
    for number, gear in enumerate(case.gears if case.freewheels else (), 1):
        if gear.input not in (None, case.input) and not case.input_turns(gear):
            yield Problem(
                "N201",
                f"the input, link {case.link_name(case.gear_input(gear))}, is assumed to turn "
                "forward, which affects the freewheels; write `input_turns: forward` or `backward`",
                ("gears", number),
            )


def _twins(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes about gears that repeat a gear under another name."""
    names: dict[str, str] = {}
    for number, gear in enumerate(case.gears, 1):
        content = repr(gear._replace(name="", engaged=tuple(sorted(gear.engaged))))
        name = names.setdefault(content, gear.name)
        if name != gear.name and gear.engaged and gear.kind != "neutral":
            message = f"repeats gear {name}: expected other engaged shift elements or other data"
            yield Problem("N206", message, ("gears", number))


def _own_mechanisms(case: TransmissionFields) -> list[tuple[int, Mechanism]]:
    """Return the mechanisms that are not derived from gear sets, with their numbers."""
    return list(enumerate(case.mechanisms, 1))[case.own_mechanisms]


def _sizes(case: TransmissionFields) -> Iterator[Problem]:
    """Check the numbers of links, gears and names."""
    moves, most = _moves(case), _most_links(case)
    if case.links < (1 if moves else 2):
        expected = "at least 1 link" if moves else "at least 2 links (input and output)"
        yield Problem("E202", f"read {case.links}, expected {expected}", ("links",))
    elif case.links > max(most, 2):
        message = f"read {case.links} links, but {_counted(case)} can connect at most {most}"
        yield Problem("E203", message, ("links",))
    if case.link_names and len(case.link_names) != case.links:
        message = f"{case.links} links, but {len(case.link_names)} names of links"
        yield Problem("E204", message, ("link_names",))
    if not case.gears and case.shift_elements and not moves:
        message = (
            "`gears` is missing or empty: expected the shift elements that each "
            "gear engages, such as"
        )
        yield Problem("E205", f"{message} `gears: {{{_first_gear(case)}}}`", ("gears",))


def _most_links(case: TransmissionFields) -> int:
    """Return the largest number of links that the components of a case can connect.

    The number of links is limited to this, so that a short text cannot claim much memory.
    """
    joined = 2 * len(case.shift_elements) + 3 * len(case.mechanisms)
    return joined + sum(len(spring.twist) for spring in case.springs) + len(case.heavy)


def _first_gear(case: TransmissionFields) -> str:
    named = zip(case.shift_elements, element_names(case.shift_elements), strict=True)
    names = [name for element, name in named if not element.is_freewheel]
    count = max(case.links - len(case.mechanisms) - 1, 1)
    words = (name if name.isidentifier() else f'"{name}"' for name in names[:count])
    return f'"1": [{", ".join(words)}]'


def _counted(case: TransmissionFields) -> str:
    parts = [f"{len(case.shift_elements)} shift elements", f"{len(case.mechanisms)} mechanisms"]
    parts += [f"{len(case.springs)} springs"] * bool(case.springs)
    return spoken(parts + [f"{len(case.heavy)} inertias"] * bool(case.heavy))


def _names(case: TransmissionFields) -> Iterator[Problem]:
    """Check that names are single lines of text, different for all parts of a kind."""
    gears = [gear.name or str(number) for number, gear in enumerate(case.gears, 1)]
    yield from _distinct(case.link_names, "link_names", "link")
    yield from _distinct(element_names(case.shift_elements), "shift_elements", "shift element")
    yield from _distinct(mechanism_names(case.mechanisms), "mechanisms", "mechanism")
    yield from _distinct(gears, "gears", "gear")
    if case.springs:
        yield from _distinct(spring_names(case.springs), "springs", "spring")
    for number, name in enumerate(case.link_names, 1):
        if name in ("0", "housing"):
            message = f"`{name}` is the housing, expected another name for link {number}"
            yield Problem("E206", message, ("link_names", number))
    if case.name and not _is_name(case.name):
        yield Problem("E207", f"read {case.name!r}, expected one line of text", ("name",))


def _drawn(case: TransmissionFields) -> Iterator[Problem]:
    """Check that a case has as many mechanisms as were derived from the drawing."""
    if case.drawing is None:
        return
    count = sum(len(device.mechanisms) for device in case.drawing.devices)
    if len(case.mechanisms) != count:
        message = (
            f"read {len(case.mechanisms)}, but the gear sets have {count}; change the gear sets"
        )
        yield Problem("E208", message, ("mechanisms",))


def _outputs(case: TransmissionFields) -> Iterator[Problem]:
    """Check that several outputs are different links, with `output` first and without the input."""
    for number, link in enumerate(case.outputs, 1):
        path = ("outputs", number)
        yield from of_link(link, path, case.own_links, lowest=1)
        if link in case.outputs[: number - 1]:
            yield Problem(
                "E209",
                f"link {called(case, link)} is listed twice, expected each output once",
                path,
            )
        if link == case.input and number > 1:
            yield Problem(
                "E210", f"link {called(case, link)} is the input, expected another link", path
            )
    if case.outputs and case.output not in (0, case.outputs[0]):
        first, given = (called(case, link) for link in (case.outputs[0], case.output))
        message = f"the first output is {first}, but `output` is {given}; remove one of them"
        yield Problem("E211", message, ("outputs",))


def _distinct(names: Sequence[str], part: str, kind: str) -> Iterator[Problem]:
    seen: dict[str, int] = {}
    for number, name in enumerate(names, 1):
        if not _is_name(name):
            message = (
                f"{name!r} is not a name: expected one line of text without blanks at its ends"
            )
            yield Problem("E212", message, (part, number))
        elif name in seen:
            message = f"{kind} {number} has the name of {kind} {seen[name]}, expected another name"
            yield Problem("E213", message, (part, number))
        seen.setdefault(name, number)


def _is_name(name: str) -> bool:
    return bool(name) and name == name.strip() and name.isprintable()


def _ports(case: TransmissionFields) -> Iterator[Problem]:
    yield from of_link(case.input, ("input",), case.own_links, lowest=1)
    if case.output or not case.outputs:  # otherwise the first of `outputs` is the output
        yield from of_link(case.main_output, ("output",), case.own_links, lowest=1)
    yield from _outputs(case)
    if case.input == case.main_output and not (_moves(case) and case.links == 1):
        yield Problem(
            "E214",
            f"input and output are both link {called(case, case.input)}, expected two links",
            ("output",),
        )
