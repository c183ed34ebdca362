"""Subject of a sweep, read from files: a case, or a scenario with the case."""

from __future__ import annotations

import re
from contextlib import suppress

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.documents import case_document
from vstatics.core.readers.kinds import document_function
from vstatics.core.readers.named.node_numbers import child
from vstatics.core.readers.named.nodes import Mapping, Node, Scalar
from vstatics.core.readers.reading import Reading
from vstatics.sweep.options import PlacedFile, SweepOptions
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.variants.subject import Document
from vstatics.sweep.variants.table_file import headings

_LOAD = re.compile(r"(?<![\w.])load\.(speed|torque)\b")
_STAND_INS = {"speed": "1000 rpm", "torque": "100 N*m"}
ReadSubject = tuple[Subject, list[Problem]]
"""Case or scenario of a sweep, and the warnings about the case."""


def read_subject(
    options: SweepOptions, input_format: readers.Format | None, telling: Telling
) -> ReadSubject:
    """Read the case or scenario of a sweep, and print the warnings.

    A case need not contain a load whose speed or torque varies.

    Raises
    ------
    ReadError
        If the file cannot be read; with the problems to print.
    """
    file = options.case or ""
    try:
        data, name = files.read_input(file, regular=isinstance(file, PlacedFile))
    except ReadError as error:
        if not isinstance(file, PlacedFile):
            raise
        message = f"{file} {error.problems[0].message}"
        raise ReadError("E018", message, place=file.place) from None
    if input_format is None and (
        read_document := document_function("read_swept_document", data, name)
    ):
        subject, doubts = read_document(data, name, telling)
        return subject, doubts
    try:
        reading = arguments.read_data(data, name, input_format, telling)
    except ReadError:
        completed = _with_load(Document(data, name), input_format, options)
        if completed is None:
            raise
        reading = completed.allowing(telling.allow)
        arguments.show_problems(reading.warnings, telling, name)
    return reading.case, list(reading.warnings)


def _with_load(
    case: Document, input_format: readers.Format | None, options: SweepOptions
) -> Reading | None:
    """Read a case without a load by inserting a placeholder for a varied load."""
    varied = [text.text for text in options.vary]
    with suppress(OSError, ReadError):
        if options.variants is not None:
            varied.append(headings(options.variants))
        halves = sorted({half for text in varied for half in _LOAD.findall(text)})
        document = case_document(*case, input_format) if halves else None
        root = document and document.root
        if document and isinstance(root, Mapping) and not child(root, "load"):
            placeholders: list[tuple[Scalar, Node]] = [
                (Scalar(half, 1, 1), Scalar(_STAND_INS[half], 1, 1)) for half in halves
            ]
            load = Scalar("load", 1, 1), Mapping(placeholders, 1, 1)
            return document.reading(root._replace(entries=[*root.entries, load]))
    return None


def spare(subject: Subject, output: str | None) -> None:
    """Refuse an output file that would overwrite the case of a scenario.

    Raises
    ------
    UsageError
    """
    if not isinstance(subject, Transmission):
        files.spare([subject.case_file], output)


def check_options(subject: Subject, *, coast: bool | None, idle: str | None) -> None:
    """Refuse `coast` and `idle` for a scenario, whose simulation determines the operation.

    Raises
    ------
    UsageError
    """
    if not isinstance(subject, Transmission) and (coast is not None or idle is not None):
        option = "--coast" if coast else "--unloaded" if coast is None else "--drive"
        raise click.UsageError(f"{option} is for a case: a scenario defines the operation itself.")


def limited(subject: Subject, limit: float | None) -> Subject:
    """Return a scenario with a limited time for each run.

    Raises
    ------
    UsageError
        If the subject is a case, which has no runs.
    """
    if limit is None:
        return subject
    if isinstance(subject, Transmission):
        raise click.UsageError("--limit is for a scenario: a case has no runs.")
    return subject.limited(limit)
