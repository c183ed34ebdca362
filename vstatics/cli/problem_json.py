"""Problems as JSON, for editors and CI: ``vstatics check -f json``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from vstatics.errors import Problem, Severity
from vstatics.writers import plain_json
from vstatics.writers.record_schema import Schema, list_of, schema_of


class ProblemRecord(NamedTuple):
    """A problem as it stands in JSON."""

    file: str
    """As it was called, `<stdin>` for standard input."""
    line: int | None
    """From 1; None for the file as a whole."""
    column: int | None
    severity: Severity
    message: str


def records(file: str, problems: Iterable[Problem]) -> Iterator[ProblemRecord]:
    """The problems of a file.

    >>> from vstatics.errors import Place
    >>> list(records("a.yaml", [Problem("read 0", place=Place("a.yaml", 3, 7))]))
    [ProblemRecord(file='a.yaml', line=3, column=7, severity='error', message='read 0')]
    """
    for problem in problems:
        name, line, column = problem.place[:3] if problem.place else (file, 0, 0)
        yield ProblemRecord(
            name, line or None, column if line else None, problem.severity, problem.message
        )


def text(problems: Iterable[ProblemRecord]) -> str:
    """An array, a line for each problem."""
    lines = [plain_json.line(one._asdict()).rstrip("\n") for one in problems]
    return "[\n" + ",\n".join(lines) + "\n]\n" if lines else "[]\n"


def json_schema() -> Schema:
    """The schema of that array."""
    number: Schema = {"type": ["integer", "null"], "minimum": 1}
    one = schema_of(ProblemRecord, line=number, column=number)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "check.schema.json",
        "title": "Problems of cases, by vstatics check",
        **list_of(one),
    }
