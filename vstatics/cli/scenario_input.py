"""A scenario that a command takes, with the case that it names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics import readers
from vstatics.cli import files
from vstatics.errors import ReadError

if TYPE_CHECKING:
    from vstatics.simulation.scenario_file import ScenarioFile


def read_document(
    data: bytes,
    name: str,
    input_format: readers.Format | None = None,
    case: str | None = None,
    output: str | None = None,
) -> ScenarioFile:
    """A scenario of a text, with the case that it names, or that is given.

    Raises
    ------
    ReadError
    UsageError
        If the case would be overwritten by the output.
    """
    from vstatics.simulation.scenario_file import read_scenario

    document = read_scenario(data, name)
    file = case or document.case_file
    if not file:
        raise document.no_case("`case` is missing: the file of the case")
    files.spare([file], output)
    try:
        text, named = files.read_input(file)
    except ReadError as error:
        if case:
            raise
        raise document.no_case(f"{file} {error.problems[0].message}") from None
    return document.with_case(readers.read(text, named, input_format))
