"""What a sweep is of, as it is read from files: a case, or a scenario and its case."""

from __future__ import annotations

from dataclasses import replace

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import files
from vstatics.cli.frame.documents import case_of, is_a
from vstatics.cli.frame.problems import Telling
from vstatics.errors import Problem, ReadError
from vstatics.sweep.options import PlacedFile
from vstatics.sweep.variants.subject import Document, Subject, VariedScenario

ReadSubject = tuple[Subject, list[Problem]]
"""A case or a scenario, and what is doubtful of the case."""


def read_subject(file: str, input_format: readers.Format | None, telling: Telling) -> ReadSubject:
    """Read the case or the scenario of a sweep, and print the warnings.

    Raises
    ------
    ReadError
        If it can't be read; with the problems to print.
    """
    try:
        data, name = files.read_input(file)
    except ReadError as error:
        if not isinstance(file, PlacedFile):
            raise
        message = f"{file} {error.problems[0].message}"
        raise ReadError([Problem("E018", message, place=file.place)]) from None
    if input_format is None and is_a("scenario", data, name):
        return read_scenario_subject(Document(data, name), telling)
    reading = arguments.read_data(data, name, input_format, telling)
    return reading.case, list(reading.warnings)


def read_scenario_subject(
    scenario: Document,
    telling: Telling,
    case: str | None = None,
    case_format: readers.Format | None = None,
) -> ReadSubject:
    """Read the case of a scenario, that which it names or another, and both together."""
    from vstatics.simulation.scenario.file import read_scenario

    of_case = Document(*case_of(read_scenario(*scenario), case))
    subject = VariedScenario(scenario, of_case, case_format=case_format)
    try:
        reading = subject.own.reading
    except ReadError as error:
        raise ReadError(telling.printed(error.problems)) from None
    arguments.show_problems(reading.warnings, telling, subject.case.file)
    return subject, list(reading.warnings)


def spare(subject: Subject, output: str | None) -> None:
    """Refuse an output that would write over the case of a scenario.

    Raises
    ------
    UsageError
    """
    if isinstance(subject, VariedScenario):
        files.spare([subject.case.file], output)


def check_options(subject: Subject, *, coast: bool | None, idle: str | None) -> None:
    """Refuse options that say something about gears, where a scenario tells what happens.

    Raises
    ------
    UsageError
    """
    if isinstance(subject, VariedScenario) and (coast is not None or idle is not None):
        option = "--coast" if coast else "--idle" if coast is None else "--drive"
        raise click.UsageError(f"{option} is for a case; a scenario says itself what happens.")


def limited(subject: Subject, limit: float | None) -> Subject:
    """A scenario each run of which may take so many seconds.

    Raises
    ------
    UsageError
        Of a case, which has no runs.
    """
    if limit is None:
        return subject
    if not isinstance(subject, VariedScenario):
        raise click.UsageError("--limit is for a scenario: a case has no runs.")
    return replace(subject, limit=limit)
