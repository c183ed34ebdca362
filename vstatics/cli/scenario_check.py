"""What `vstatics check` says of a scenario."""

from __future__ import annotations

from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, unexpected
from vstatics.cli.scenario_input import read_document
from vstatics.errors import CaseError, Problem, ReadError, plural
from vstatics.extras import missing
from vstatics.simulation.scenario import Scenario
from vstatics.simulation.scenario_checks import scenario_doubts
from vstatics.tables.grid import Grid, text

_BEGINNING = 1e-9
"""So much of the duration is tried."""


def check_scenario(file: str, options: CaseOptions) -> tuple[str, list[Problem], bool, Grid | None]:
    """The name of a scenario, its problems and those of its case, whether it fails, what it has."""
    try:
        read = read_document(*files.read_input(file), options.input_format)
        found = [*scenario_doubts(read.scenario), *_of_start(read.scenario)]
        problems = options.telling.told([*read.reading.warnings, *map(read.locate, found)])
    except ReadError as error:
        return file, error.problems, True, None
    except Exception as error:  # noqa: BLE001 - the other files are to go on
        return file, [unexpected(file, error)], True, None
    failed = any(one.severity == "error" for one in problems)
    shown = None if failed else _summary(file, read.scenario)
    return file, problems, failed or options.telling.fails(problems), shown


def _of_start(scenario: Scenario) -> list[Problem]:
    """Why it can't begin, as far as that takes no run; nothing where scipy is not installed."""
    if missing("simulation", "a simulation"):
        return []
    from vstatics.simulation.run import simulate

    try:
        simulate(scenario._replace(duration=_BEGINNING * scenario.duration, targets={}))
    except CaseError as error:
        return error.problems
    return []


def _summary(file: str, scenario: Scenario) -> Grid:
    """What a scenario has, in a line."""
    counts = {
        "control": len(scenario.controls or ()),
        "torque": len(scenario.torques),
        "converter": len(scenario.converters),
        "shift": len(scenario.shifts or ()),
    }
    parts = [f"{count} {plural(noun, count)}" for noun, count in counts.items() if count]
    told = ", ".join(parts) or "nothing happens"
    return Grid(f"{file}: {scenario.duration:g} s, {told}", [text(""), text("")], [])
