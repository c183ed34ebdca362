"""The case that a command of `vstatics synth` has found, as a file that other commands take."""

from __future__ import annotations

from collections.abc import Iterable

import click

from vstatics.core import readers
from vstatics.core.cli.shared import files
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.jobs.files import missing_folder
from vstatics.core.model.transmission import Transmission
from vstatics.core.writers.saving import case_data

written_case = click.option(
    "--write",
    "target",
    type=click.Path(),
    metavar="FILE",
    help="Also write what is found as a case: YAML, JSON or deck by the suffix. A file that is "
    "there is replaced.",
)
"""The option for it; the command gets `target`."""


def case_format(target: str, inputs: Iterable[str], output: str | None = None) -> str:
    """The format of the case to write, by its suffix; refused before anything is calculated.

    Raises
    ------
    UsageError
        If the suffix is none, or what is read or written besides would be written over.
    ReadError
        If its directory is not there.
    """
    files.spare(inputs, target)
    if output is not None and target == output:
        message = f"read {target} twice, expected another file for the case (--write) than for -o"
        raise click.UsageError(message)
    form = readers.format_of_name(target)
    if form is None:
        message = f"can't tell the format of {target}: expected a suffix such as .yaml, .json, .dat"
        raise click.BadParameter(message, param_hint="--write")
    if problem := missing_folder(target):
        raise ReadError([problem])
    return form


def write_case(case: Transmission, target: str, form: str) -> bool:
    """Write a case, whole or not at all; tell what the format can't keep.

    Returns
    -------
    bool
        Whether it keeps all.

    Raises
    ------
    ReadError
        If what is left of it would be another case, or it can't be written.
    """
    try:
        data, lost = case_data(case, form)
    except CaseError as error:
        raise ReadError(one.in_file(target) for one in error.problems) from error
    files.write_data(data, target)
    for what in lost:
        files.say(f"{target}: not kept: {what}")
    return not lost
