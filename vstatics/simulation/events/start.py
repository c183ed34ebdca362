"""Speeds, angles and twists at the start, calculated from the given values."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from vstatics.core.errors import CaseError, Problem, listed, spoken
from vstatics.core.model.laws import without_loads
from vstatics.core.model.open_converters import with_open_converters
from vstatics.core.model.transmission import Gear
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.scenario.laws import constant
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.system.curves import is_limited
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.structure import null, solved, split_motions
from vstatics.simulation.tolerances import MOVING_LINK, STANDING


def with_all_converters(scenario: Scenario) -> Scenario:
    """Return the scenario with all converters of the case, including open converters.

    Raises
    ------
    CaseError
        If a converter has no performance coefficient (lambda).
    """
    before = scenario.case
    try:
        case = with_open_converters(before)
    except CaseError as error:
        problems = [problem._replace(path=("case", *problem.path)) for problem in error.problems]
        raise CaseError(problems) from None
    named = {converter.name for converter in before.converters} if scenario.converters else set()
    moved = {
        converter.name: converter for converter in case.converters if converter.name not in named
    }
    names = [mechanism.name for mechanism in case.mechanisms]
    ratios = {
        names.index(before.mechanisms[number - 1].name) + 1: ratio
        for number, ratio in scenario.speed_ratios.items()
    }
    converters = (moved | {converter.name: converter for converter in scenario.converters}).values()
    return scenario._replace(case=case, converters=tuple(converters), speed_ratios=ratios)


def with_fixed_ratios(scenario: Scenario) -> Scenario:
    """Return the scenario with gear pairs instead of variators of constant ratio.

    The pairs have the ratios of the start gear. Variators that move or have the ratio 0 remain.
    """
    case, name = scenario.case, scenario.start.gear
    if not any(mechanism.kind for mechanism in case.mechanisms):
        return scenario
    gear = next((candidate for candidate in case.gears if candidate.name == name), Gear())
    ratios = dict(enumerate(case.gear_ratios(gear), 1))
    moving = dict(scenario.speed_ratios)
    for number, mechanism in enumerate(case.mechanisms, 1):
        if mechanism.kind and not ratios[number]:
            moving.setdefault(number, constant(0.0))  # a gear pair cannot have the ratio 0
    others = dict.fromkeys(moving, 1.0)  # any ratio will do, since these pairs are not used
    pairs = case.as_pairs(gear._replace(speed_ratios={**gear.speed_ratios, **others}))
    assert pairs is not None  # noqa: S101 - no ratio is 0, and converters are left out
    return scenario._replace(case=pairs, speed_ratios=moving)


def start_gear(scenario: Scenario) -> Gear | None:
    """Return the start gear with its locked freewheels engaged, None without a start gear.

    Raises
    ------
    CaseError
    """
    name = scenario.start.gear
    if name is None:
        return None
    case = scenario.case
    try:
        number = case.gear_number(name)
    except ValueError as error:
        raise CaseError("E610", str(error), ("start", "gear")) from None
    gear = case.gears[number - 1]
    if not case.freewheels:
        return gear
    from vstatics.core.statics.points.laws import without_laws
    from vstatics.core.statics.solve import solve

    if any(without_loads(case)):  # laws cannot be evaluated
        case = without_laws(case)
    # Only the engaged shift elements are used, because the drag torques are valid at one speed.
    return gear._replace(engaged=solve(case).gear_at(number - 1).gear.engaged)


def start_speeds(system: MotionSystem, gear: Gear | None) -> Floats:
    """Return the speeds of all links at t = 0 [rad/s].

    Raises
    ------
    CaseError
        If given speeds contradict each other, or do not determine all other speeds.
    """
    scenario = system.scenario
    case, start = scenario.case, scenario.start
    links = len(system.names)
    held = [*start.engaged, *(gear.engaged if gear else ())]
    rows = fixed_rows(system)
    rows += [system.by_element[number - 1].row for number in held]
    given = {link: speed.at(0.0) for link, speed in scenario.speeds.items()}
    _check_ties(system, given)
    for link, speed in start.speeds.items():
        known = given.setdefault(link, speed)
        if abs(known - speed) > STANDING * max(1.0, abs(known)):
            raise CaseError(
                "E674",
                f"read {speed:g} rad/s, but `speeds` gives {known:g} rad/s at t = 0",
                ("start", "speeds", case.link_name(link)),
            )
    if gear is not None and (start.speed or not scenario.speeds):
        given.setdefault(case.gear_input(gear), start.speed)
    values = [0.0] * len(rows)
    for link, speed in given.items():
        rows.append(np.eye(links)[link - 1])
        values.append(speed)
    matrix, wanted = system.rows(rows), np.array(values)
    speeds = solved(matrix, wanted) if rows else np.zeros(links)
    scale = max(1.0, largest(wanted))
    if largest(matrix @ speeds - wanted) > STANDING * scale:
        raise CaseError([_contradicting_speed(system, matrix, wanted, given)])
    open_still = null(matrix)
    if open_still.shape[1]:
        speeds = _filled_in(system, speeds, open_still, scale)
    if backward := list(_backward(system, speeds, open_still, scale)):
        raise CaseError(backward)
    return speeds


def given_angles(system: MotionSystem) -> tuple[Floats, Floats]:
    """Return the angles of links and twists of springs at t = 0 [rad].

    Rigid mechanisms tie angles as they tie speeds, and the twist of a spring is the angle between
    its ends unless it can slip. Undetermined values are 0.

    Raises
    ------
    CaseError
        If given twists and angles contradict each other, or leave open how springs share a twist.
    """
    start, links = system.scenario.start, np.eye(len(system.names))
    twists = np.array([start.twists.get(spring.name, 0.0) for spring in system.springs])
    tied = {} if start.settled else {n: s for n, s in enumerate(system.springs) if not s.may_slip}
    given = [
        (("angles", system.names[link - 1]), links[link - 1], angle)
        for link, angle in start.angles.items()
    ]
    given += [
        (("twists", spring.name), spring.row, start.twists[spring.name])
        for spring in tied.values()
        if spring.name in start.twists
    ]
    if not given:
        return np.zeros(len(links)), twists
    rows = [*(mesh.row for mesh in system.meshes), *(row for _, row, _ in given)]
    values = np.array([*(0.0 for _ in system.meshes), *(value for *_, value in given)])
    matrix = system.rows(rows)
    if contradiction := _contradiction(matrix, values, len(system.meshes)):
        place, expected = contradiction
        path, _, angle = given[place]
        raise CaseError(
            "E649",
            f"read {angle:g} rad, but the other angles and twists, and the mechanisms between "
            f"them, give {expected:g} rad",
            ("start", *path),
        )
    open_still, angles = null(matrix), solved(matrix, values)
    loose = []
    for number, spring in tied.items():
        if spring.name in start.twists:
            continue
        if largest(spring.row @ open_still) > MOVING_LINK:
            loose.append(spring)
        else:
            twists[number] = spring.row @ angles
    matrix = np.vstack([matrix, system.rows(spring.row for spring in loose)])
    values = np.append(values, np.zeros(len(loose)))
    angles = solved(matrix, values)
    if largest(matrix @ angles - values) > STANDING * max(1.0, largest(values)):
        names = spoken([spring.name for spring in loose])
        raise CaseError(
            "E726",
            f"the given twists do not determine how {names} share the remaining twist: give more "
            "twists",
            ("start", "twists"),
        )
    is_open = np.abs(null(matrix)).max(axis=1, initial=0.0) > MOVING_LINK
    return np.where(is_open, 0.0, angles), twists


def _contradiction(matrix: Floats, values: Floats, certain: int) -> tuple[int, float] | None:
    """Return the first equation, if any, that contradicts earlier ones, and its expected value.

    The first `certain` equations are taken as correct, and the index counts from there.
    """
    for count in range(certain + 1, len(values) + 1):
        rows, wanted = matrix[:count], values[:count]
        if largest(rows @ solved(rows, wanted) - wanted) > STANDING * max(1.0, largest(wanted)):
            return count - 1 - certain, float(rows[-1] @ solved(rows[:-1], wanted[:-1]))
    return None


def fixed_rows(system: MotionSystem) -> list[Floats]:
    """Return the constraint rows of all mechanisms, and of moving variators at t = 0."""
    rows = [mesh.row for mesh in system.meshes]
    return rows + [system.contacts[variator.contact].row for variator in system.variators]


def _check_ties(system: MotionSystem, given: Iterable[int]) -> None:
    rows = fixed_rows(system)
    for link in given:
        before = null(system.rows(rows))
        rows.append(np.eye(len(system.names))[link - 1])
        if null(system.rows(rows)).shape[1] == before.shape[1]:
            name = system.case.link_name(link)
            raise CaseError(
                "E673",
                f"the gear train holds {name}, or its speed follows from other given speeds: give "
                "only one of them",
                ("speeds", name),
            )


def _backward(
    system: MotionSystem, speeds: Floats, free: Floats, scale: float
) -> Iterator[Problem]:
    """Yield a problem for each freewheel that should lock but slips backward at the start.

    A slip that depends on links without inertia can jump, so it is allowed.
    """
    _, light = split_motions(system.heavy, free)
    for contact in system.contacts:
        if largest(contact.row @ light) > MOVING_LINK:
            continue
        slip = float(contact.row @ speeds)
        if contact.one_way and slip < -STANDING * scale and not is_limited(contact, 0.0):
            yield Problem(
                "E612",
                f"{contact.name} slips by {slip:g} rad/s at the start, but a freewheel "
                "holds in this direction: expected a slip of 0 or more",
                ("start",),
            )


def _filled_in(system: MotionSystem, speeds: Floats, free: Floats, scale: float) -> Floats:
    """Return speeds in which undetermined values keep springs untwisted and freewheels locked.

    Motions without inertia need no given speed, because the torques at t = 0 determine them.
    """
    heavy, _ = split_motions(system.heavy, free)
    rows = system.rows(
        spring.row for spring in system.springs if spring.element is None and not spring.is_damper
    )
    bent = rows @ free
    moved = np.abs(bent).max(axis=1, initial=0.0) > MOVING_LINK
    bent, missing = bent[moved], -(rows @ speeds)[moved]
    loose, idle = split_motions(system.heavy, free @ null(bent) if len(bent) else free)
    if loose.shape[1]:
        raise _left_open(
            system, loose, ": give the speed of one more link, or one more engaged shift element"
        )
    part = solved(bent, missing) if len(bent) else np.zeros(free.shape[1])
    if heavy.shape[1] and largest(bent @ part - missing) > STANDING * scale:
        raise _left_open(
            system,
            heavy,
            ", as springs on both sides have different speeds: give the speed of one more link",
        )
    filled = speeds + free @ part
    freewheels = system.rows(contact.row for contact in system.contacts if contact.one_way)
    if idle.shape[1] and len(freewheels):
        filled += idle @ solved(freewheels @ idle, -freewheels @ filled)
    return filled


def _left_open(system: MotionSystem, motions: Floats, hint: str) -> CaseError:
    moving = np.flatnonzero(np.abs(motions).max(axis=1) > MOVING_LINK)
    names = listed([system.names[index] for index in moving], 6)
    return CaseError("E613", f"the start does not determine the speed of {names}{hint}", ("start",))


def _contradicting_speed(
    system: MotionSystem, matrix: Floats, wanted: Floats, given: dict[int, float]
) -> Problem:
    contradiction = _contradiction(matrix, wanted, len(wanted) - len(given))
    if contradiction is None:
        return Problem(
            "E615", "the given speeds contradict each other: give fewer speeds", ("start",)
        )
    place, expected = contradiction
    link, speed = [*given.items()][place]
    return Problem(
        "E614",
        f"read a speed of {speed:g} rad/s of {system.case.link_name(link)}, but the other "
        f"speeds and the engaged shift elements give {expected:g} rad/s",
        ("start", "speeds", link),
    )
