"""Checks of the numbers, tables, states and sequences of a scenario."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, pairwise

from vstatics.core.errors import Path, Problem, quoted, spoken
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.suggestions import nearest
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, Points
from vstatics.simulation.scenario.parts import ControlState, Scenario, SequenceStep, placed_steps
from vstatics.simulation.scenario.words import name_problems


def control_problems(scenario: Scenario) -> Iterator[Problem]:
    """Yield the problems of settings, states, given speeds and ratios, and sequences.

    Examples
    --------
    >>> from vstatics import Transmission
    >>> from vstatics.simulation.scenario.laws import constant
    >>> case = Transmission(1, [], [], [], inertias={1: 2.0})
    >>> state = ControlState("p", constant(1.0), start=3.0, most=2.0)
    >>> for problem in control_problems(Scenario(case, 1.0, states=(state,))):
    ...     print(problem)
    states.p.start: read 3, expected at most 2, its max [E684]
    """
    settings, states = scenario.settings, [state.name for state in scenario.states]
    yield from name_problems("set", [*settings], ())
    yield from name_problems("states", states, [*settings])
    for name, value in settings.items():
        if not math.isfinite(value):
            yield Problem("E654", f"read {value:g}, expected a number", ("set", name))
    for state in scenario.states:
        yield from _of_state(state, ("states", state.name))
    for link, speed in scenario.speeds.items():
        yield from _of_speed(speed, ("speeds", scenario.case.link_name(link)))
    for number, ratio in scenario.speed_ratios.items():
        mechanism = scenario.case.mechanisms[number - 1]
        place = ("speed_ratios", mechanism.name)
        if mechanism.kind != "variator":
            yield Problem("E678", f"{mechanism.name} is not a variator, expected a variator", place)
        yield from _of_speed(ratio, place)
    for sequence in scenario.sequences:
        if not sequence.steps:
            place = ("sequences", sequence.name)
            yield Problem("E685", "read no steps, expected at least one", place)
    for path, step in placed_steps(scenario):
        yield from _of_step(step, scenario, path)


def of_range(value: float, what: str, path: Path, *, above_0: bool = False) -> Iterator[Problem]:
    """Yield a problem for a number that is negative or not finite."""
    if not (0 < value < math.inf or (value == 0 and not above_0)):
        least = "above 0" if above_0 else "of 0 or more"
        yield Problem("E640", f"read {value:g}, expected {what} {least}", path)


def ascending(
    values: Sequence[float], expected: str, path: Path, *, strictly: bool = False
) -> Iterator[Problem]:
    """Yield a problem for the first number below its predecessor, or equal to it if `strictly`."""
    for number, (before, after) in enumerate(pairwise(values), 2):
        if after < before or (strictly and after == before):
            yield Problem(
                "E653", f"read {after:g} after {before:g}, expected {expected}", (*path, number)
            )
            return


def _of_state(state: ControlState, path: Path) -> Iterator[Problem]:
    for name, value in (("start", state.start), ("min", state.least), ("max", state.most)):
        if math.isnan(value) or (name == "start" and math.isinf(value)):
            yield Problem("E654", f"read {value:g}, expected a number", (*path, name))
    if state.least > state.most:
        yield Problem(
            "E684",
            f"read {state.most:g}, expected at least {state.least:g}, its min",
            (*path, "max"),
        )
    elif message := state.beyond(state.start):
        yield Problem("E684", message, (*path, "start"))


def _of_speed(speed: Curve, path: Path) -> Iterator[Problem]:
    """Yield the problems of a given speed, which must be continuous with a known derivative."""
    if isinstance(speed, Formula):
        if any(speed.jumps("t")) or not speed.has_slope:
            fault = "jumps" if speed.has_slope else "has no known slope"
            yield Problem(
                "E689", f"the speed {fault}, expected a speed that changes steadily", path
            )
        return
    if not speed.x:
        yield Problem("E651", "expected at least one point, each of two numbers", path)
    expected = "points in the order of the time, without a jump"
    yield from ascending(speed.x, expected, path, strictly=True)
    if not all(map(math.isfinite, [*speed.x, *speed.y])):
        yield Problem("E654", "read a value that is not a number, expected numbers", path)


def _of_step(step: SequenceStep, scenario: Scenario, path: Path) -> Iterator[Problem]:
    if not (step.settings or step.shift or step.dogs):
        yield Problem("E686", "the step has no action, expected `set`, `shift` or `dog`", path)
    if not step.within > 0:
        yield Problem("E640", f"read {step.within:g}, expected a time above 0", (*path, "within"))
    yield from of_range(step.wait, "a time", (*path, "wait"))
    known = scenario.value_names
    for name in step.settings:
        if name not in known:
            hint = nearest(name, known)
            hint = hint or (f"; there are {spoken(known)}" if known else "; there are none")
            yield Problem(
                "E687",
                f"read {quoted(name)}, expected a name of `set` or a state{hint}",
                (*path, "set", name),
            )
    for state in scenario.states:
        value = step.settings.get(state.name)
        if isinstance(value, Points) and (message := state.beyond(value.y[0])):
            yield Problem("E684", message, (*path, "set", state.name))
    elements = scenario.case.shift_elements
    for number in step.dogs:
        if 0 < number <= len(elements) and elements[number - 1].kind != "dog_clutch":
            yield Problem(
                "E688",
                f"{elements[number - 1].name} is not a dog clutch, expected a dog clutch",
                (*path, "dog", number),
            )


def table_problems(tables: Mapping[str, LookupTable]) -> Iterator[Problem]:
    """Yield the problems of lookup tables: breakpoints must ascend, and values must be finite.

    Examples
    --------
    >>> for problem in table_problems({"engine": LookupTable((2.0, 1.0), ((1.0,), (3.0,)))}):
    ...     print(problem)
    tables.engine[2]: read 1 after 2, expected rows in ascending order [E653]
    """
    for name, table in tables.items():
        path = ("tables", name)
        may_jump = table.variables == 1
        rows = path if may_jump else (*path, "rows")
        yield from ascending(table.x, "rows in ascending order", rows, strictly=not may_jump)
        expected = "columns in ascending order"
        for problem in ascending(table.columns, expected, path, strictly=True):
            yield problem._replace(path=(*path, "columns"))
        if not all(map(math.isfinite, [*table.x, *table.columns, *chain(*table.values)])):
            yield Problem("E654", "read a value that is not a number, expected numbers", path)
