"""Documents that are more than a case: a scenario, with the case that it names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics import readers
from vstatics.cli.frame import files
from vstatics.errors import ReadError

if TYPE_CHECKING:
    from vstatics.simulation.scenario.file import ScenarioDocument, ScenarioFile


def scenario_with_case(
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
    from vstatics.simulation.scenario.file import read_scenario

    document = read_scenario(data, name)
    text, named = case_of(document, case, output)
    read = document.with_case(readers.read(text, named, input_format))
    if read.samples:
        from vstatics.sweep.build import sampled_numbers
        from vstatics.sweep.variants.subject import Document, VariedScenario

        own, of_case = Document(data, name), Document(text, named)
        sampled_numbers(VariedScenario(own, of_case, case_format=input_format))
    return read


def case_of(
    document: ScenarioDocument, case: str | None = None, output: str | None = None
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
    try:
        return files.read_input(file)
    except ReadError as error:
        if case:
            raise
        raise document.no_case(f"{file} {error.problems[0].message}") from None
