"""Problems as JSON, for editors and CI: ``vstatics check -f json``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Annotated, NamedTuple

from vstatics.errors import Problem, Severity
from vstatics.tables.answer import Words, line, plain_data


class ProblemRecord(NamedTuple):
    """A problem as it stands in JSON."""

    file: str
    """As it was called, `<stdin>` for standard input."""
    line: Annotated[int, Words(minimum=1)] | None
    """From 1; None for the file as a whole."""
    column: Annotated[int, Words(minimum=1)] | None
    severity: Severity
    message: str


def records(file: str, problems: Iterable[Problem]) -> Iterator[ProblemRecord]:
    """The problems of a file.

    >>> from vstatics.errors import Place
    >>> list(records("a.yaml", [Problem("read 0", place=Place("a.yaml", 3, 7))]))
    [ProblemRecord(file='a.yaml', line=3, column=7, severity='error', message='read 0')]
    """
    for problem in problems:
        name, row, column = problem.place[:3] if problem.place else (file, 0, 0)
        yield ProblemRecord(
            name, row or None, column if row else None, problem.severity, problem.message
        )


def text(problems: Iterable[ProblemRecord]) -> str:
    """An array, a line for each problem."""
    lines = [line(plain_data(one)).rstrip("\n") for one in problems]
    return "[\n" + ",\n".join(lines) + "\n]\n" if lines else "[]\n"
