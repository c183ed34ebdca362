"""Checks of the numbers, tables, states and sequences of a scenario."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import chain, pairwise

from vstatics.core.errors import Path, Problem, quoted, spoken
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.suggestions import nearest
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, Points
from vstatics.simulation.scenario.parts import ControlState, Scenario, SequenceStep
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
        place: Path = ("speed_ratios", mechanism.name)
        if mechanism.kind != "variator":
            yield Problem("E678", f"{mechanism.name} is no variator, expected one", place)
        yield from _of_speed(ratio, place)
    for sequence in scenario.sequences:
        if not sequence.steps:
            place = ("sequences", sequence.name)
            yield Problem("E685", "read no steps, expected one at least", place)
    for path, step in placed_steps(scenario):
        yield from _of_step(step, scenario, path)


def placed_steps(scenario: Scenario) -> Iterator[tuple[Path, SequenceStep]]:
    """Yield the steps of all sequences, each with the place in the document."""
    for sequence in scenario.sequences:
        for number, step in enumerate(sequence.steps, 1):
            yield ("sequences", sequence.name, number), step


def _of_state(state: ControlState, path: Path) -> Iterator[Problem]:
    for name, value in (("start", state.start), ("min", state.least), ("max", state.most)):
        if math.isnan(value) or (name == "start" and math.isinf(value)):
            yield Problem("E654", f"read {value:g}, expected a number", (*path, name))
    if state.least > state.most:
        message = f"read {state.most:g}, expected at least {state.least:g}, its min"
        yield Problem("E684", message, (*path, "max"))
    elif message := state.beyond(state.start):
        yield Problem("E684", message, (*path, "start"))


def _of_speed(speed: Curve, path: Path) -> Iterator[Problem]:
    """Yield the problems of a given speed, which must be continuous with a known slope."""
    if isinstance(speed, Formula):
        if any(speed.jumps("t")) or not speed.has_slope:
            fault = "jumps" if speed.has_slope else "has no slope that can be told"
            yield Problem("E689", f"the speed {fault}, expected one that changes steadily", path)
        return
    if not speed.x:
        yield Problem("E651", "expected points, one at least, each of two numbers", path)
    for number, (before, after) in enumerate(pairwise(speed.x), 2):
        if after <= before:
            wanted = "points in the order of the time, without a jump"
            message = f"read {after:g} behind {before:g}, expected {wanted}"
            yield Problem("E653", message, (*path, number))
            break
    if not all(map(math.isfinite, [*speed.x, *speed.y])):
        yield Problem("E654", "read what is no number, expected numbers", path)


def _of_step(step: SequenceStep, scenario: Scenario, path: Path) -> Iterator[Problem]:
    if not (step.settings or step.shift or step.dogs):
        yield Problem("E686", "nothing is done, expected `set`, `shift` or `dog`", path)
    if not step.within > 0:
        yield Problem("E640", f"read {step.within:g}, expected a time above 0", (*path, "within"))
    if not 0 <= step.wait < math.inf:
        yield Problem("E640", f"read {step.wait:g}, expected a time of 0 or more", (*path, "wait"))
    known = [*scenario.settings, *(state.name for state in scenario.states)]
    for name in step.settings:
        if name not in known:
            hint = nearest(name, known)
            hint = hint or (f"; there are {spoken(known)}" if known else "; there are none")
            message = f"read {quoted(name)}, expected a name of `set` or a state{hint}"
            yield Problem("E687", message, (*path, "set", name))
    for state in scenario.states:
        value = step.settings.get(state.name)
        if isinstance(value, Points) and (message := state.beyond(value.y[0])):
            yield Problem("E684", message, (*path, "set", state.name))
    elements = scenario.case.shift_elements
    for number in step.dogs:
        if 0 < number <= len(elements) and elements[number - 1].kind != "dog_clutch":
            message = f"{elements[number - 1].name} is no dog clutch, expected one"
            yield Problem("E688", message, (*path, "dog", number))


def table_problems(tables: Mapping[str, LookupTable]) -> Iterator[Problem]:
    """Yield the problems of tables: rows and columns must ascend, values be finite.

    Examples
    --------
    >>> for problem in table_problems({"engine": LookupTable((2.0, 1.0), ((1.0,), (3.0,)))}):
    ...     print(problem)
    tables.engine[2]: read 1 behind 2, expected rows in ascending order [E653]
    """
    for name, table in tables.items():
        path: Path = ("tables", name)
        may_jump = table.variables == 1
        for number, (before, after) in enumerate(pairwise(table.x), 2):
            if after < before or (after == before and not may_jump):
                message = f"read {after:g} behind {before:g}, expected rows in ascending order"
                yield Problem("E653", message, (*path, *(() if may_jump else ("rows",)), number))
                break
        for before, after in pairwise(table.columns):
            if after <= before:
                message = f"read {after:g} behind {before:g}, expected columns in ascending order"
                yield Problem("E653", message, (*path, "columns"))
                break
        if not all(map(math.isfinite, [*table.x, *table.columns, *chain(*table.values)])):
            yield Problem("E654", "read what is no number, expected numbers", path)
