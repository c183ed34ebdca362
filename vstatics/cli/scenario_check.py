"""What `vstatics check` says of a scenario."""

from __future__ import annotations

from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, unexpected
from vstatics.cli.simulate import read_document
from vstatics.errors import Problem, ReadError, plural
from vstatics.simulation.scenario import Scenario
from vstatics.simulation.scenario_checks import scenario_doubts
from vstatics.tables.grid import Grid, text


def check_scenario(file: str, options: CaseOptions) -> tuple[str, list[Problem], bool, Grid | None]:
    """The name of a scenario, its problems and those of its case, whether it fails, what it has."""
    try:
        read = read_document(*files.read_input(file), options.input_format)
        doubts = map(read.locate, scenario_doubts(read.scenario))
        problems = options.telling.told([*read.reading.warnings, *doubts])
    except ReadError as error:
        return file, error.problems, True, None
    except Exception as error:  # noqa: BLE001 - the other files are to go on
        return file, [unexpected(file, error)], True, None
    return file, problems, options.telling.fails(problems), _summary(file, read.scenario)


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
