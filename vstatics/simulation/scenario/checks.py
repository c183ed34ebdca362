"""Checks of a scenario, its laws, points and formulas before the calculation.

The path of a problem contains names, and numbers from 1: ``("controls", "FH")``, ``("torques",
"out", 2)`` for the second of several laws, ``("shifts", 1, "to")``. The calculation itself reports
further problems, such as contradictory start speeds.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from vstatics.core.errors import CaseError, Path, Problem, ReadError, listed, quoted, spoken
from vstatics.core.model.checks import left_out
from vstatics.core.model.converters import Converter
from vstatics.core.model.parts import HOUSING
from vstatics.core.model.springs import SpringLimit
from vstatics.core.model.torsional_checks import of_converter
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.suggestions import nearest
from vstatics.simulation.scenario.conditions import StepCondition
from vstatics.simulation.scenario.control_checks import ascending, control_problems, of_range
from vstatics.simulation.scenario.formula import (
    OF_EVENTS,
    OF_MOTION,
    OF_TORQUES,
    SHORT_SPEED,
    Formula,
    Vocabulary,
    formula_tree,
)
from vstatics.simulation.scenario.formula_code import VARIABLES
from vstatics.simulation.scenario.laws import Points, Resistance, Road, SpeedPoints, TorqueLaw
from vstatics.simulation.scenario.parts import (
    Capacity,
    Control,
    Scenario,
    Shift,
    Start,
    placed_laws,
    placed_steps,
)
from vstatics.simulation.scenario.programme import bare_capacities, cut_controls
from vstatics.simulation.scenario.sizes import size_problems
from vstatics.simulation.scenario.words import elastic_names, vocabulary
from vstatics.simulation.tolerances import LARGEST_NUMBER, MISSING_MASS, WHOLE_TURNS

_TRIED_TIMES = 1001
_FUNCTIONS: Mapping[str | int, Sequence[str]] = {
    **dict.fromkeys(("controls", "torques", "limits"), OF_MOTION),
    **dict.fromkeys(("speeds", "speed_ratios"), ()),
    **dict.fromkeys(("states", "set"), (*OF_MOTION, *OF_TORQUES)),
    "when": (*OF_MOTION, *OF_TORQUES, *OF_EVENTS),
}
"""Functions of the motion that formulas can use, by key of the scenario or of a sequence step."""


def check_scenario(scenario: Scenario) -> None:
    """Reject an impossible scenario.

    Raises
    ------
    CaseError
        With every problem.
    """
    if problems := list(scenario_problems(scenario)):
        raise CaseError(problems)


def scenario_problems(scenario: Scenario) -> Iterator[Problem]:
    """Yield all problems of a scenario.

    Examples
    --------
    >>> from vstatics import Gear, ShiftElement
    >>> from vstatics.simulation.scenario.laws import constant
    >>> case = Transmission(2, [ShiftElement(1, 2)], [], [Gear()])
    >>> controls = {1: Capacity(constant(30.0), -1.0)}
    >>> scenario = Scenario(case, 0.0, Start(speeds={1: 0.0, 2: 0.0}), controls)
    >>> for problem in scenario_problems(scenario):
    ...     print(problem)
    duration: read 0, expected a time above 0 [E640]
    controls.F1.scale: read -1, expected a scale of 0 or more [E640]
    """
    yield from size_problems(scenario)
    yield from of_range(scenario.duration, "a time", ("duration",), above_0=True)
    yield from _of_start(scenario)
    yield from _of_controls(scenario.controls or {}, scenario.case, scenario.duration)
    yield from _of_torques(scenario)
    yield from _of_limits(scenario)
    yield from _of_converters(scenario.converters, scenario.case)
    yield from _of_shifts(scenario)
    for link in scenario.speeds:
        yield from _of_link(link, scenario.case, ("speeds", _name(scenario.case, link)))
    yield from control_problems(scenario)
    for path, step in placed_steps(scenario):
        if step.shift is not None:
            yield from _of_gear(step.shift.to, scenario.case, (*path, "shift", "to"))
            yield from of_range(step.shift.overlap, "a time", (*path, "shift", "overlap"))
    yield from _of_formulas(scenario)
    yield from _of_speeds(scenario.targets, scenario.case, "targets")
    if scenario.static is not None:
        yield from _of_gear(scenario.static.gear, scenario.case, ("static", "gear"))
        if not 0 < abs(scenario.static.torque) < math.inf:
            message = f"read {scenario.static.torque:g}, expected a torque other than 0"
            yield Problem("E640", message, ("static", "torque"))


def scenario_doubts(scenario: Scenario) -> Iterator[Problem]:
    """Yield warnings and notes about a scenario, for example on a shift after the end."""
    case = scenario.case
    yield from bare_capacities(case)
    yield from cut_controls(scenario)
    yield from left_out(case)
    yield from _elastic_losses(case)
    yield from _kept_ratios(scenario)
    yield from _single_turns(scenario)
    for number, shift in enumerate(scenario.shifts or (), 1):
        if shift.at >= scenario.duration:
            yield Problem(
                "W603",
                f"begins at {shift.at:g} s, but the scenario ends at {scenario.duration:g} s: it "
                "never happens",
                ("shifts", number, "at"),
            )
    for link, law in scenario.torques:
        if isinstance(law, Road) and 0 < link <= case.links:
            mass, inertia = law.mass * law.radius**2, case.inertias.get(link, 0.0)
            if inertia < mass * (1 - MISSING_MASS):
                yield Problem(
                    "W604",
                    f"the case has an inertia of {inertia:g} kg*m^2 on this link, and `road` "
                    f"adds none: expected {mass:g} for a mass of {law.mass:g} kg and wheels with "
                    f"a radius of {law.radius:g} m",
                    ("torques", _name(case, link)),
                )


def _kept_ratios(scenario: Scenario) -> Iterator[Problem]:
    """Yield a note on each variator that does not take the speed ratio of a later gear."""
    case, start = scenario.case, scenario.start.gear
    ratios = {gear.name: case.gear_ratios(gear) for gear in case.gears}
    shifts: list[tuple[Path, Shift]] = [
        (("shifts", number), shift) for number, shift in enumerate(scenario.shifts or (), 1)
    ]
    shifts += [
        ((*path, "shift"), step.shift) for path, step in placed_steps(scenario) if step.shift
    ]
    for path, shift in shifts:
        pairs = zip(ratios.get(start or "", ()), ratios.get(shift.to, ()), strict=False)
        for index, (kept, other) in enumerate(pairs):
            part = case.mechanisms[index]
            if part.kind == "variator" and kept != other and index + 1 not in scenario.speed_ratios:
                text = f"{part.name} keeps the speed ratio {kept:g} of the start gear"
                message = f"{text}, not {other:g} of gear {shift.to}; give `speed_ratios` over time"
                yield Problem("N615", message, (*path, "to"))


def _single_turns(scenario: Scenario) -> Iterator[Problem]:
    """Yield a note on torques whose points span whole turns of their link, but do not repeat.

    >>> ends = ((1, 6.283), (2, 9.42), (2, 0.01))  # one turn, one and a half, and a part of a turn
    >>> torques = [(link, Points((0.0, end), (5.0, 1.0), "angle")) for link, end in ends]
    >>> from vstatics import Gear
    >>> case = Transmission(2, [], [], [Gear()])
    >>> scenario = Scenario(case, 9.0, Start(speeds={1: 1.0}), {}, torques=torques)
    >>> [(problem.id, problem.path) for problem in _single_turns(scenario)]
    [('N616', ('torques', '1'))]
    """
    for link, law in scenario.torques:
        if isinstance(law, Points) and law.over == "angle":
            turns = (law.x[-1] - law.x[0]) / (2 * math.pi)
            if round(turns) and abs(turns - round(turns)) < WHOLE_TURNS:
                last = f"beyond the last point the torque stays {law.y[-1]:g} N*m"
                text = f"points over whole turns do not repeat: {last}"
                yield Problem("N616", text, ("torques", _name(scenario.case, link)))


def _elastic_losses(case: Transmission) -> Iterator[Problem]:
    """Yield a note on elastic mechanisms, whose losses a run leaves out."""
    lossy = [
        number
        for number, part in enumerate(case.mechanisms, 1)
        if part.stiffness is not None and {part.efficiency, part.back_efficiency} - {1.0, None}
    ]
    if lossy:
        names = listed([case.mechanisms[number - 1].name for number in lossy], 6)
        yield Problem(
            "N614",
            f"a scenario omits the losses of elastic mechanisms ({names}); for both, remove the "
            "`stiffness`, and add a link and a spring in series",
            ("case", "mechanisms", lossy[0], "stiffness"),
        )


def _of_start(scenario: Scenario) -> Iterator[Problem]:
    start, case = scenario.start, scenario.case
    by_speeds = bool(start.speeds) or bool(start.engaged)
    if start.gear is None and not (by_speeds or scenario.speeds or start.speed):
        yield Problem("E628", "expected `gear`, or `speeds` that determine all others", ("start",))
    if start.gear is not None:
        if by_speeds:
            names = [
                element.name
                for gear in case.gears
                if gear.name == start.gear and not start.engaged
                for element in case.elements_at(gear.engaged)
            ]
            instead = f": instead of `gear`, write `engaged: [{', '.join(names)}]`" * bool(names)
            freewheels = ", ".join(element.name for element in case.elements_at(case.freewheels))
            if names and freewheels:
                instead += f", and add freewheels that hold ({freewheels})"
            message = "read `gear` together with `speeds` or `engaged`, expected one or the other"
            yield Problem("E629", message + instead, ("start",))
        yield from _of_gear(start.gear, case, ("start", "gear"))
    elif start.speed:
        yield Problem("E630", "read `speed` without `gear`, expected both", ("start", "speed"))
    yield from of_finite([start.speed], "a speed", ("start", "speed"))
    for key, numbers in (("speeds", start.speeds), ("angles", start.angles)):
        yield from _of_speeds({n: [number] for n, number in numbers.items()}, case, "start", key)
    yield from _of_twists(start, case)
    for place, element in enumerate(start.engaged, 1):
        yield from _of_element(element, case, ("start", "engaged", place))


def _of_twists(start: Start, case: Transmission) -> Iterator[Problem]:
    """Yield the problems of start twists: unknown names, infinite numbers, and use of `settled`."""
    names = elastic_names(case)
    for name, twist in start.twists.items():
        path = ("start", "twists", name)
        if name not in names:
            hint = nearest(name, names) or f"; there are {listed(names, 12) or 'none'}"
            yield Problem("E671", f"read {quoted(name)}, expected the name of a spring{hint}", path)
        yield from of_finite([twist], "a twist", path)
    if start.twists and start.settled:
        yield Problem(
            "E648",
            "read both `twists` and `settled`, which calculates them: expected one of the two",
            ("start", "twists"),
        )


def _of_controls(
    controls: Mapping[int, Control], case: Transmission, duration: float
) -> Iterator[Problem]:
    for number, control in controls.items():
        problems = list(_of_element(number, case, ("controls", str(number))))
        yield from problems
        if problems:
            continue
        element = case.shift_elements[number - 1]
        path = ("controls", element.name)
        if element.is_freewheel:
            yield Problem(
                "E631",
                "read a control of a freewheel, which holds without a control: remove it",
                path,
            )
        elif isinstance(control, Capacity) and element.kind == "dog_clutch":
            yield Problem(
                "E632",
                "read the capacity of a dog clutch, which has no friction: expected the times "
                "at which it closes and opens, such as {dog: [[1.5, closed], [2, open]]}",
                path,
            )
        elif isinstance(control, Capacity):
            yield from _of_capacity(control, duration, path)
        else:
            yield from of_times([time for time, _ in control.points], (*path, "dog"))


def _never_a_number(law: object, duration: float, path: Path) -> Iterator[Problem]:
    """Yield a problem if a formula is infinite or NaN at every sampled time, speed and angle."""
    if not isinstance(law, Formula) or law.seen or not 0 < duration < math.inf:
        return
    times = np.linspace(0.0, duration, _TRIED_TIMES)
    speeds, angles = 1e3 * np.sin(7.3 * np.arange(_TRIED_TIMES)), np.cos(np.arange(_TRIED_TIMES))
    with np.errstate(all="ignore"):
        values = law.along(times, speeds, angles)
    if law.variables and not np.isfinite(values).any():
        yield Problem(
            "E633",
            f"is {values[1]:g} at {times[1]:.6g} s and at all other times, expected a number",
            path,
        )


def _of_capacity(control: Capacity, duration: float, path: Path) -> Iterator[Problem]:
    law, scale = control
    yield from of_range(scale, "a scale", (*path, "scale"))
    if isinstance(law, Points):
        if law.over != "time":
            yield Problem("E634", f"read points over {law.over}, expected points over time", path)
        yield from of_points(law, path)
    elif not law.seen and 0 < duration < math.inf:
        times = np.linspace(0.0, duration, _TRIED_TIMES)
        with np.errstate(all="ignore"):
            values = law.along(times, 0.0, 0.0) * scale
        wrong = np.flatnonzero(~(np.abs(values) <= LARGEST_NUMBER))
        if len(wrong):
            first = int(wrong[0])
            yield Problem(
                "E633",
                f"is {values[first]:g} at {times[first]:.6g} s, expected a number up to "
                f"{LARGEST_NUMBER:g}",
                path,
            )


def _of_torques(scenario: Scenario) -> Iterator[Problem]:
    laws: dict[int, list[TorqueLaw]] = {}
    for link, law in scenario.torques:
        laws.setdefault(link, []).append(law)
    for link, several in laws.items():
        path = ("torques", _name(scenario.case, link))
        yield from _of_link(link, scenario.case, path)
        for number, law in enumerate(several, 1):
            place = (*path, number) if len(several) > 1 else path
            if isinstance(law, Points):
                yield from of_points(law, place)
            elif isinstance(law, Resistance):
                yield from of_range(law.torque, "a torque", (*place, "resistance"))
            elif isinstance(law, Road):
                yield from _of_road(law, (*place, "road"))


def _of_limits(scenario: Scenario) -> Iterator[Problem]:
    """Yield the problems of torque limits: unknown or unsuitable springs, negative torques."""
    springs = scenario.case.springs
    for number, limit in scenario.limits.items():
        if not 0 < number <= len(springs):
            expected = f"expected 1 to {len(springs)}" if springs else "but the case has none"
            yield Problem("E671", f"read spring {number}, {expected}", ("limits", str(number)))
            continue
        path = ("limits", springs[number - 1].name)
        spring = springs[number - 1]
        if spring.points or spring.strut:
            key = "points" if spring.points else "strut"
            yield Problem("E693", f"read a limit of a spring with `{key}`, expected no limit", path)
        if spring.name in [
            other.limit.of for other in springs if isinstance(other.limit, SpringLimit)
        ]:
            yield Problem(
                "E546",
                f"the limit of another spring follows {quoted(spring.name)}, so no other limit "
                "can be given",
                path,
            )
        yield from _of_capacity(Capacity(limit), scenario.duration, path)
        values = limit.y if isinstance(limit, Points) else ()
        for place, value in enumerate(values, 1):
            if value < 0:
                where = (*path, place, 2) if len(values) > 1 else path
                yield Problem("E635", f"read {value:g}, expected a torque of 0 or more", where)


def _of_converters(converters: Sequence[Converter], case: Transmission) -> Iterator[Problem]:
    names = list(case.devices)
    for converter in converters:
        path = ("converters", converter.name)
        if converter.name in names:
            yield Problem(
                "E637", f"{quoted(converter.name)} is the name of another component", path
            )
        names.append(converter.name)
        yield from of_converter(converter, path, case.links)


def _of_shifts(scenario: Scenario) -> Iterator[Problem]:
    before = 0.0
    for number, shift in enumerate(scenario.shifts or (), 1):
        path = ("shifts", number)
        yield from _of_gear(shift.to, scenario.case, (*path, "to"))
        yield from of_range(shift.at, "a time", (*path, "at"))
        if 0 <= shift.at < before:
            yield Problem(
                "E639",
                f"read {shift.at:g} after {before:g}, expected shifts in the order of time",
                (*path, "at"),
            )
        before = max(before, shift.at)
        yield from of_range(shift.overlap, "a time", (*path, "overlap"))


def _of_speeds(
    speeds: Mapping[int, Sequence[float]], case: Transmission, *place: str
) -> Iterator[Problem]:
    for link, several in speeds.items():
        path = (*place, _name(case, link))
        yield from _of_link(link, case, path)
        yield from of_finite(several, "a speed", path)


def _of_link(link: int, case: Transmission, path: Path) -> Iterator[Problem]:
    if link == HOUSING:
        yield Problem("E641", "read the housing, expected a link that can rotate", path)
    elif not 0 < link <= case.links:
        yield Problem("E642", f"read link {link}, expected 1 to {case.links}", path)


def _of_element(number: int, case: Transmission, path: Path) -> Iterator[Problem]:
    if not 0 < number <= len(case.shift_elements):
        last = len(case.shift_elements)
        expected = f"expected 1 to {last}" if last else "but the case has none"
        yield Problem("E643", f"read shift element {number}, {expected}", path)


def _of_gear(name: str, case: Transmission, path: Path) -> Iterator[Problem]:
    try:
        gear = case.gears[case.gear_number(name) - 1]
    except ValueError:
        names = [gear.name for gear in case.gears]
        hint = nearest(name, names) or f"; gears are {listed(names, 12)}"
        yield Problem("E644", f"read {quoted(name)}, expected the name of a gear{hint}", path)
        return
    slipping = [element.name for element in case.elements_at(gear.slip)]
    if slipping:
        verb = "has" if len(slipping) == 1 else "have"
        message = f"{spoken(slipping)} {verb} a given slip in gear {gear.name}"
        expected = "expected a gear without `slip`; `controls` let its clutches slip in a scenario"
        yield Problem("E646", f"{message}: {expected}", path)


def _name(case: Transmission, link: int) -> str:
    return str(case.link_name(link) if 0 <= link <= case.links else link)


def _of_road(law: Road, path: Path) -> Iterator[Problem]:
    """Yield the problems of a road: invalid numbers, or several vehicle speeds at a wheel speed."""
    problems = [
        *of_range(law.mass, "a mass", (*path, "mass"), above_0=True),
        *of_range(law.radius, "a radius", (*path, "radius"), above_0=True),
        *of_range(law.by_torque, "a number", (*path, "radius", "by_torque")),
        *_of_rolling(law.rolling, (*path, "rolling")),
        *of_range(law.drag_area, "an area", (*path, "drag_area")),
    ]
    if not -1 <= law.slope <= 1:
        problems.append(
            Problem(
                "E645",
                f"read {law.slope:g}, expected the sine of an angle, from -1 to 1",
                (*path, "slope"),
            )
        )
    yield from problems
    if not problems and law.wheel and not law.wheel.is_single:
        yield Problem(
            "E722",
            f"read {law.by_torque:g} m/(N*m), expected a smaller number: a speed of the wheels "
            "would belong to several velocities",
            (*path, "radius", "by_torque"),
        )


def _of_rolling(rolling: float | SpeedPoints, path: Path) -> Iterator[Problem]:
    if not isinstance(rolling, tuple):
        yield from of_range(rolling, "a coefficient", path)
        return
    before = -math.inf
    for number, (speed, part) in enumerate(rolling, 1):
        here = (*path, "points", number)
        yield from of_range(speed, "a speed", (*here, 1))
        yield from of_range(part, "a coefficient", (*here, 2))
        if not speed > before:
            yield Problem(
                "E889", f"read {speed:g} after {before:g}, expected ascending speeds", (*here, 1)
            )
        before = speed
    if not rolling:
        yield Problem("E889", "read no point, expected at least one", (*path, "points"))


def _of_formulas(scenario: Scenario) -> Iterator[Problem]:
    """Yield the problems of all formulas; the allowed names depend on the key of a formula."""
    names = scenario.value_names
    converters = [converter.name for converter in scenario.converters]
    words = vocabulary(scenario.case, values=names, converters=converters)
    for path, placed in placed_laws(scenario):
        law = placed.formula if isinstance(placed, StepCondition) else placed
        functions = _FUNCTIONS[path[3] if path[0] == "sequences" else path[0]]
        known = words.only(*functions) if functions else Vocabulary()
        variables = VARIABLES if path[0] == "torques" else ("t",)
        problems = list(of_formula(law, variables, path, known))
        yield from problems
        # `_of_capacity` checks the numbers of controls and limits
        if not problems and path[0] not in ("controls", "limits"):
            yield from _never_a_number(law, scenario.duration, path)


def of_formula(
    law: object, names: Sequence[str], path: Path, words: Vocabulary
) -> Iterator[Problem]:
    """Yield the problems of a formula: wrong syntax, unknown names, or an infinite constant."""
    if not isinstance(law, Formula):
        return
    try:
        if law.tree is None:  # a formula with a tree was already checked when it was read
            formula_tree(Excerpt(law.text, "formula"), names, words)
            if SHORT_SPEED in words.values and "speed" in law.variables:
                yield Problem(
                    "E680",
                    f"`{SHORT_SPEED}` is the speed in {quoted(law.text)}, but also a state or "
                    "number: expected another name for it",
                    path,
                )
        if not (law.seen or law.variables) and not math.isfinite(value := law.at(0.0)):
            yield Problem(
                "E723", f"read {quoted(law.text)}, which is {value:g}, expected a number", path
            )
    except ReadError as error:
        yield from (problem._replace(path=path, place=None) for problem in error.problems)


def of_points(points: Points, path: Path) -> Iterator[Problem]:
    """Yield the problems of a law by points.

    Problems are missing points, unequal numbers of abscissas and ordinates, infinite numbers or
    NaN, and abscissas that decrease.
    """
    if not points.x or len(points.x) != len(points.y):
        yield Problem("E651", "expected at least one point, each of two numbers", path)
    yield from of_finite([*points.x, *points.y], "a number", path)
    yield from ascending(points.x, f"points in the order of the {points.over}", path)


def of_times(times: Sequence[float], path: Path) -> Iterator[Problem]:
    """Yield the problems of times, such as missing, infinite or decreasing times."""
    if not times:
        yield Problem("E652", "read no times, expected at least one", path)
    yield from of_finite(times, "a time", path)
    yield from ascending(times, "times in their order", path)


def of_finite(values: Sequence[float], expected: str, path: Path) -> Iterator[Problem]:
    """Yield a problem for the first number that is infinite or NaN, if any."""
    for value in values:
        if not math.isfinite(value):
            yield Problem("E654", f"read {value:g}, expected {expected} that is finite", path)
            return
