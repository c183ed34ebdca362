"""What `run` and `check` share: their arguments, and reading and calculating each case."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import click

from vstatics import readers, statics
from vstatics.cli import files
from vstatics.errors import Problem, ReadError
from vstatics.model import IdleConvention
from vstatics.readers.reading import Reading
from vstatics.results import Results

argument = click.argument("cases", nargs=-1, required=True, type=click.Path(), metavar="CASE...")
input_format = click.option(
    "--from",
    "input_format",
    type=click.Choice(list(readers.READERS)),
    help="Format of the input; else told by the suffix, then by the content.",
)


class Outcome(NamedTuple):
    """What became of a case: results, or only problems."""

    file: str
    results: Results | None
    problems: list[Problem]

    @property
    def failed(self) -> bool:
        """Whether the case is in error or a gear is tied up."""
        return self.results is None or self.results.failed


def calculate(
    cases: Sequence[str],
    form: readers.Format | None,
    coast: bool | None = None,
    idle: IdleConvention | None = None,
) -> Iterator[Outcome]:
    """Read and calculate each case, print its problems, and go on after a bad one.

    `coast` and `idle` override the case's own.
    """
    if cases.count(files.STDIN) > 1:
        raise click.UsageError("standard input (-) can be read once")
    for file in cases:
        outcome = _calculate(file, form, coast, idle)
        files.show(outcome.problems)
        yield outcome


def _calculate(
    file: str, form: readers.Format | None, coast: bool | None, idle: IdleConvention | None
) -> Outcome:
    name = files.STDIN_NAME if file == files.STDIN else file
    try:
        reading = readers.read(*files.read_input(file), form)
    except ReadError as error:
        return Outcome(name, None, error.problems)
    results = statics.solve(reading.case, coast=coast, idle=idle)
    return Outcome(name, results, [*reading.warnings, *_located(reading, results)])


def _located(reading: Reading, results: Results) -> Iterator[Problem]:
    """The messages of a result as problems at the place of their gear."""
    numbers = {gear.name: number for number, gear in enumerate(results.case.gears, 1)}
    for message in results.messages:
        if message.gear:
            place = reading.locate(Problem("", ("gears", numbers[message.gear]))).place
            text = f"gear {message.gear}: {message.text}"
            yield Problem(text, place=place, severity=message.severity)
