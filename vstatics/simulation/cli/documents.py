"""Scenario files in commands: reading with their cases, checks, and sweeps."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from vstatics.core import extras, readers
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CaseOptions, show_problems, unexpected
from vstatics.core.cli.shared.documents import NO_TEXTS, is_a, no_case
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed, plural
from vstatics.core.tables.grid import Grid
from vstatics.simulation.scenario.file import ScenarioDocument, ScenarioFile, read_scenario
from vstatics.simulation.scenario.parts import Scenario

if TYPE_CHECKING:
    from vstatics.simulation.variants.subject import VariedScenario


def read_with_case(
    data: bytes,
    name: str,
    input_format: readers.Format | None = None,
    case: str | None = None,
    output: str | None = None,
    texts: Mapping[str, bytes] = NO_TEXTS,
) -> ScenarioFile:
    """Read a scenario with the case that it names, or with another case.

    `texts` replaces the contents of files, by name.

    Raises
    ------
    ReadError
    UsageError
        If the case would be overwritten by the output, or if scenario and case are swapped.
    """
    document = _document(data, name, case)
    text, named = case_of(document, case, output, texts)
    try:
        reading = readers.read(text, named, input_format)
    except ReadError as error:
        raise ReadError(no_case(text, named) or error.problems) from None
    read = document.with_case(reading)
    if read.samples:
        from vstatics.simulation.variants.numbers import ScenarioNumbers, sampled_numbers
        from vstatics.sweep.variants.subject import Document

        of_scenario, of_case = Document(data, name), Document(text, named)
        sampled_numbers(ScenarioNumbers(of_scenario, of_case, case_format=input_format))
    return read


def _document(data: bytes, name: str, case: str | None) -> ScenarioDocument:
    try:
        return read_scenario(data, name)
    except ReadError:
        if case and is_a("scenario", *files.read_input(case)):
            message = f"expected the scenario first, then the case: {case} {name}"
            raise click.UsageError(message) from None
        raise


def case_of(
    document: ScenarioDocument,
    case: str | None = None,
    output: str | None = None,
    texts: Mapping[str, bytes] = NO_TEXTS,
) -> tuple[bytes, str]:
    """Return the bytes and the name of the case of a scenario.

    Raises
    ------
    ReadError
        If the case cannot be read, with the place at which the scenario names it.
    UsageError
        If the output would overwrite the case.
    """
    file = case or document.case_file
    if not file:
        raise document.no_case("no file of a case is named: expected `case: FILE`")
    files.spare([file], output)
    if file in texts:
        return texts[file], file
    try:
        data, name = files.read_input(file, regular=not case)
    except ReadError as error:
        if case:
            raise
        raise document.no_case(f"{file} {error.problems[0].message}") from None
    if not case:
        document.refuse_foreign(data, name)
    return data, name


def read_swept_document(
    data: bytes,
    name: str,
    telling: Telling,
    case: str | None = None,
    case_format: readers.Format | None = None,
) -> tuple[VariedScenario, list[Problem]]:
    """Read a scenario, and its own or another case, as the subject of a sweep."""
    from vstatics.simulation.variants.subject import VariedScenario
    from vstatics.sweep.variants.subject import Document

    of_case = Document(*case_of(_document(data, name, case), case))
    subject = VariedScenario(Document(data, name), of_case, case_format=case_format)
    try:
        scenario_file = subject.own
    except ReadError as error:
        raise ReadError(telling.printed(error.problems)) from None
    doubts = scenario_file.allowing(telling.allow).doubts
    problems = [*scenario_file.reading.warnings, *doubts]
    show_problems(problems, telling, subject.case.file)
    return subject, problems


TRIED, LONG = 1.0, 60.0
"""Processor time of a trial run, and estimated time above which a note is printed. [s]"""


def check_document(
    data: bytes, file: str, options: CaseOptions
) -> tuple[str, list[Problem], bool, Grid | None]:
    """Return name, problems, True for a failed check, and summary of a scenario."""
    try:
        read = read_with_case(data, file, options.input_format)
        read = read.allowing(options.telling.allow)
        tried = not_allowed(_tried(read.scenario), read.scenario.case.untold)
        doubts = [*read.doubts, *map(read.locate, tried)]
        problems = options.telling.told([*read.reading.warnings, *doubts])
    except ReadError as error:
        return file, error.problems, True, None
    except Exception as error:  # noqa: BLE001 - the other files are still checked
        return file, [unexpected(file, error)], True, None
    failed = any(problem.severity == "error" for problem in problems)
    if failed:
        return file, problems, True, None
    scenario = read.scenario
    counts = {
        "control": len(scenario.controls or ()),
        "torque": len(scenario.torques),
        "converter": len(scenario.converters),
        "shift": len(scenario.shifts or ()),
    }
    parts = [f"{count} {plural(noun, count)}" for noun, count in counts.items() if count]
    inputs = ", ".join(parts) or "nothing happens"
    summary = Grid(f"{file}: {scenario.duration:g} s, {inputs}", (), ())
    return file, problems, options.telling.fails(problems), summary


def _tried(scenario: Scenario) -> list[Problem]:
    """Return the problems of a trial run that fails or would take long; empty without scipy."""
    if extras.missing("simulation", "a simulation"):
        return []
    from vstatics.core.cli.shared.estimates import duration_text
    from vstatics.simulation.bounds import Pace
    from vstatics.simulation.run import simulate

    pace = Pace(scenario.duration, TRIED)
    try:
        simulate(scenario._replace(targets={}), watch=pace)
    except CaseError as error:
        return error.problems
    if pace.needed <= LONG:
        return []
    needed = duration_text(pace.needed) if pace.needed < math.inf else "no end in sight"
    return [
        Problem(
            "N001",
            f"the run takes long ({needed}): `vstatics simulate --limit SECONDS` ends it earlier",
            ("duration",),
        )
    ]
