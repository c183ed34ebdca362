"""What commands of one case share: its problems at their places, one text of it out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import click

from vstatics.cli.frame import files, texts
from vstatics.cli.frame.cases import CalculatedCase
from vstatics.cli.frame.formats import Destination, OutputOptions
from vstatics.cli.frame.problems import Telling
from vstatics.errors import CaseError, Problem, ReadError, of_file
from vstatics.readers.reading import Reading
from vstatics.tables.grid import Grid
from vstatics.writers import plain_json
from vstatics.writers.plain_json import plain_data


@contextmanager
def problems_of(reading: Reading) -> Iterator[None]:
    """Tell problems of a case at their places in its file.

    Raises
    ------
    ReadError
    """
    try:
        yield
    except CaseError as error:
        raise ReadError([_placed(one, reading) for one in error.problems]) from None


def _placed(problem: Problem, reading: Reading) -> Problem:
    """A problem at its place; one of what was asked for is of the file as a whole."""
    located = reading.locate(problem)
    if problem.path or located.place is None:
        return located
    return of_file(located.place.file, problem.message)


def file_name(file: str) -> str:
    """How a file is spoken of that the command was given."""
    return files.STDIN_NAME if file == files.STDIN else file


def show(
    file: str,
    to: Destination,
    title: str,
    grids: Callable[[], Iterable[Grid]],
    document: Callable[[], dict[str, Any]],
) -> None:
    """Write what a command has of one case, in the format that is asked for."""
    name = file_name(file)
    shown = texts.CaseOutput([title or name], {}, grids, lambda: plain_data(document()))
    form = texts.OutputForm(to.form, to.style)
    files.write_data(texts.alone(CalculatedCase(name, None, []), shown, form), to.output)


def show_alone(
    file: str,
    to: Destination,
    name: str,
    grids: Callable[[], Iterable[Grid]],
    document: Callable[[], dict[str, Any]],
) -> None:
    """Write what there is of one case; the document in JSON has what it has, and no more."""
    as_json = {
        "json": lambda _: f"{plain_json.text(document())}\n",
        "jsonl": lambda _: plain_json.line(document()),
    }
    shown = texts.CaseOutput([name or file_name(file)], as_json, grids, document)
    outcome = CalculatedCase(file_name(file), None, [])
    form = texts.OutputForm(to.form, to.style)
    files.write_data(texts.alone(outcome, shown, form), to.output)


def tell(problems: Sequence[Problem], telling: Telling, file: str) -> None:
    """Print problems on stderr."""
    files.show(telling.printed(problems))
    files.show(telling.quiet_failure(problems, file_name(file)))


def warnings_of(messages: Iterable[str], file: str) -> list[Problem]:
    """Warnings about a file as a whole."""
    return [of_file(file, one)._replace(severity="warning") for one in messages]


def one_text(wanted: OutputOptions, inputs: Sequence[str]) -> Destination:
    """Where the result goes; a directory is for several, of which there are none."""
    to = wanted.destination(inputs)
    if to.is_folder:
        raise click.UsageError(f"one case gives one text: expected -o FILE, not {to.output}")
    return to
