"""What the commands of `vstatics torsion` share: a case in, texts of it out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files, texts
from vstatics.cli.cases import CalculatedCase
from vstatics.cli.formats import Destination, OutputOptions
from vstatics.cli.telling import Telling
from vstatics.errors import CaseError, Problem, ReadError, of_file
from vstatics.extras import missing
from vstatics.model.transmission import Transmission
from vstatics.readers.reading import Reading
from vstatics.tables.grid import Grid
from vstatics.writers.plain_json import plain_data


def needs_scipy() -> None:
    """Refuse where the extra is not installed, before anything is read.

    Raises
    ------
    ReadError
    """
    if message := missing("torsion", "vstatics torsion"):
        raise ReadError([Problem(message)])


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


def coasting(reading: Reading, coast: bool | None) -> Reading:
    """A case with the power as an option says; as it says itself where that says nothing."""
    if coast in (None, reading.case.coast):
        return reading
    return reading._replace(case=reading.case.replace(coast=coast))


def gear_names(case: Transmission, asked: Sequence[str]) -> list[str]:
    """The gears that are asked for, each once; all where none is.

    Raises
    ------
    BadParameter
        If there is no such gear.
    """
    return [case.gears[index].name for index in arguments.gear_indices(case, asked)]


def link_name(case: Transmission, asked: str, option: str) -> str:
    """The name of the link that an option asks for.

    Raises
    ------
    BadParameter
        If there is none; it tells the nearest name.
    """
    try:
        return case.link_name(case.link_number(asked))
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint=option) from None


def located(reading: Reading, texts_by_gear: Iterable[tuple[str, str, str]]) -> Iterator[Problem]:
    """Messages as problems at the places of their gears.

    Parameters
    ----------
    texts_by_gear : iterable of tuple
        The name of a gear, a severity, a text.
    """
    numbers = {gear.name: number for number, gear in enumerate(reading.case.gears, 1)}
    for name, severity, message in texts_by_gear:
        place = reading.locate(Problem("", ("gears", numbers[name]))).place
        yield Problem(f"gear {name}: {message}", (), place, severity)  # type: ignore[arg-type]


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


def tell(problems: Sequence[Problem], telling: Telling, file: str) -> None:
    """Print problems on stderr."""
    files.show(telling.printed(problems))
    files.show(telling.quiet_failure(problems, file_name(file)))


def one_text(wanted: OutputOptions, inputs: Sequence[str]) -> Destination:
    """Where the result goes; a directory is for several, of which there are none."""
    to = wanted.destination(inputs)
    if to.is_folder:
        raise click.UsageError(f"one case gives one text: expected -o FILE, not {to.output}")
    return to
