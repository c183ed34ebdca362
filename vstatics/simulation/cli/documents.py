"""Scenarios among the files of commands: read with their cases, checked, and swept."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from vstatics.core import extras, readers
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CaseOptions, show_problems, unexpected
from vstatics.core.cli.shared.documents import NO_TEXTS, no_case
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed, plural
from vstatics.core.tables.grid import Grid
from vstatics.simulation.scenario.checks import scenario_doubts
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
    """A scenario of a text, with the case that it names, or that is given.

    Texts stand in place of what is in the files of their names.

    Raises
    ------
    ReadError
    UsageError
        If the case would be overwritten by the output.
    """
    document = read_scenario(data, name)
    text, named = case_of(document, case, output, texts)
    try:
        reading = readers.read(text, named, input_format)
    except ReadError as error:
        raise ReadError(no_case(text, named) or error.problems) from None
    read = document.with_case(reading)
    if read.samples:
        from vstatics.simulation.variants.numbers import ScenarioNumbers, sampled_numbers
        from vstatics.sweep.variants.subject import Document

        own, of_case = Document(data, name), Document(text, named)
        sampled_numbers(ScenarioNumbers(own, of_case, case_format=input_format))
    return read


def case_of(
    document: ScenarioDocument,
    case: str | None = None,
    output: str | None = None,
    texts: Mapping[str, bytes] = NO_TEXTS,
) -> tuple[bytes, str]:
    """What the file of the case of a scenario holds, and its name.

    Raises
    ------
    ReadError
        If it can't be read; at the place where the scenario names it, if that does.
    UsageError
        If it would be overwritten by the output.
    """
    file = case or document.case_file
    if not file:
        raise document.no_case("`case` is missing: the file of the case")
    files.spare([file], output)
    if file in texts:
        return texts[file], file
    try:
        data, name = files.read_input(file, regular=not case)
    except ReadError as error:
        if case:
            raise
        why = f"{file} {error.problems[0].message}"
        raise document.no_case(why) from None
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
    """Read the case of a scenario, that which it names or another, and both together."""
    from vstatics.simulation.variants.subject import VariedScenario
    from vstatics.sweep.variants.subject import Document

    of_case = Document(*case_of(read_scenario(data, name), case))
    subject = VariedScenario(Document(data, name), of_case, case_format=case_format)
    try:
        reading = subject.own.reading
    except ReadError as error:
        raise ReadError(telling.printed(error.problems)) from None
    show_problems(reading.warnings, telling, subject.case.file)
    return subject, list(reading.warnings)


TRIED, LONG = 1.0, 60.0
"""So long a scenario is tried, and what takes longer by that is told. [s]"""


def check_document(file: str, options: CaseOptions) -> tuple[str, list[Problem], bool, Grid | None]:
    """The name of a scenario, its problems and those of its case, whether it fails, what it has."""
    try:
        read = read_with_case(*files.read_input(file), options.input_format)
        read = read.allowing(options.telling.allow)
        found = [*scenario_doubts(read.scenario), *_tried(read.scenario)]
        found = not_allowed(found, read.scenario.case.untold)
        problems = options.telling.told([*read.reading.warnings, *map(read.locate, found)])
    except ReadError as error:
        return file, error.problems, True, None
    except Exception as error:  # noqa: BLE001 - the other files are to go on
        return file, [unexpected(file, error)], True, None
    failed = any(one.severity == "error" for one in problems)
    shown = None if failed else _scenario_summary(file, read.scenario)
    return file, problems, failed or options.telling.fails(problems), shown


def _tried(scenario: Scenario) -> list[Problem]:
    """Why it can't begin, or that it takes long; nothing where scipy is not installed."""
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
    message = f"a run takes long ({needed}): `vstatics simulate --limit SECONDS` ends it"
    return [Problem("N001", message, ("duration",))]


def _scenario_summary(file: str, scenario: Scenario) -> Grid:
    """What a scenario has, in a line."""
    counts = {
        "control": len(scenario.controls or ()),
        "torque": len(scenario.torques),
        "converter": len(scenario.converters),
        "shift": len(scenario.shifts or ()),
    }
    parts = [f"{count} {plural(noun, count)}" for noun, count in counts.items() if count]
    told = ", ".join(parts) or "nothing happens"
    return Grid(f"{file}: {scenario.duration:g} s, {told}", (), ())
