"""Output of a command of `vstatics synth` as a case file."""

from __future__ import annotations

from collections.abc import Iterable

import click

from vstatics.core import readers
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import OUTPUT, under
from vstatics.core.cli.shared.values import FILE
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.jobs.files import missing_folder
from vstatics.core.model.transmission import Transmission
from vstatics.core.writers.saving import case_data

written_case = under(
    OUTPUT,
    click.option(
        "--write",
        "target",
        type=FILE,
        metavar="FILE",
        help="File for the solution as a case: YAML, JSON or deck by the suffix. An existing file "
        "is replaced.",
    ),
)
"""Option --write. The command receives the value as argument `target`."""


def case_format(target: str, inputs: Iterable[str], output: str | None = None) -> str:
    """Return the format of the case to write, and check the file before the calculation.

    Raises
    ------
    UsageError
        If the suffix is not known, or the file is also an input or the main output.
    ReadError
        If the directory does not exist.
    """
    files.spare(inputs, target)
    if output is not None and target == output:
        message = f"read {target} twice, expected another file for the case (--write) than for -o"
        raise click.UsageError(message)
    form = readers.format_of_name(target)
    if form is None:
        message = (
            f"cannot determine the format of {target}: expected a suffix such as .yaml, .json, .dat"
        )
        raise click.BadParameter(message, param_hint="--write")
    if problem := missing_folder(target):
        raise ReadError([problem])
    return form


def write_case(case: Transmission, target: str, form: str) -> bool:
    """Write a case completely or not at all, and report the data that the format cannot hold.

    Returns
    -------
    bool
        Whether the format holds all data.

    Raises
    ------
    ReadError
        If the case would be a different case without the missing data, or the file cannot be
        written.
    """
    try:
        data, lost = case_data(case, form)
    except CaseError as error:
        raise ReadError(problem.in_file(target) for problem in error.problems) from error
    files.write_data(data, target)
    for data_lost in lost:
        files.say(f"{target}: not kept: {data_lost}")
    return not lost
