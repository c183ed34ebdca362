"""Common code of commands for a single case: reading, places of problems, output."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases, files, formats, texts
from vstatics.core.cli.shared.cases import check_streams, read_data, show_problems
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.formats import Destination, OutputOptions
from vstatics.core.cli.shared.options import gathered, needs
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import FILE
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed, of_file
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.reading import Reading
from vstatics.core.tables.answer import Answer
from vstatics.core.tables.grid import Grid


@contextmanager
def problems_of(reading: Reading) -> Iterator[None]:
    """Run the block; add places in the file to problems of a case in the block.

    Raises
    ------
    ReadError
    """
    try:
        yield
    except ReadError:
        raise
    except CaseError as error:
        raise ReadError([_placed(problem, reading) for problem in error.problems]) from None


def _placed(problem: Problem, reading: Reading) -> Problem:
    """Return a problem with its place: the whole file if the problem has no path."""
    located = reading.locate(problem)
    if problem.path or located.place is None:
        return located
    return problem.in_file(located.place.file)


class CaseAnswer(NamedTuple):
    """Answer of a command about a case. The function `grids` creates its tables when needed."""

    grids: Callable[[], Iterable[Grid]]
    answer: Answer
    """Record for JSON."""
    problems: Sequence[Problem] = ()
    failed: bool = False
    """True if the command fails without an error among the problems."""
    write: Callable[[], bool] | None = None
    """Function that writes a further file, and returns whether it could write everything."""


class OneCase(NamedTuple):
    """Case and output options of a command for a single case."""

    case: str
    wanted: OutputOptions
    input_format: readers.Format | None
    telling: Telling
    coast: bool | None = None
    """True if power enters at the output; None for the setting of the case."""
    static_torque: float | None = None
    """Input torque; None for the input torque of the case. [N*m]"""

    def destination(self, *others: str) -> Destination:
        """Return the destination of the output, which must not be the case or another input.

        Raises
        ------
        UsageError
        """
        inputs = [self.case, *others]
        check_streams(inputs)
        return one_text(self.wanted, inputs)

    def read(self, *given: tuple[bytes, str]) -> Reading:
        """Read the case from its file or from a text, and print the warnings.

        Raises
        ------
        ReadError
        """
        [text] = given or [files.read_input(self.case)]
        return read_data(*text, self.input_format, self.telling)

    def answer(
        self,
        calculate: Callable[[Reading], CaseAnswer],
        to: Destination | None = None,
        extra: str = "",
        *given: tuple[bytes, str],
    ) -> int:
        """Read the case, calculate and write the answer, and return the exit status.

        Parameters
        ----------
        calculate : callable
            Function that returns the answer. Its problems get their places in the file.
        to : Destination, optional
            Output; None to determine it from the options.
        extra : str
            Name of the command, and of the optional package that it needs.
        *given : tuple of (bytes, str)
            Text of the case and name of its file, if the command has already read it.

        Raises
        ------
        ReadError, UsageError
        """
        to = to or self.destination()
        if extra:
            needs(extra, f"vstatics {extra}")
        reading = self.read(*given)
        case = reading.case
        with problems_of(reading):
            case = case.with_coast(self.coast).with_torque(self.static_torque)
            reading = reading._replace(case=case)
            answer = calculate(reading)
        answer = answer._replace(problems=not_allowed(answer.problems, reading.case.untold))
        if case.masses:
            answer = answer._replace(grids=partial(_in_both_units, case, answer.grids))
        tell(answer.problems, self.telling._replace(notes=True), self.case)
        is_complete = answer.write is None or answer.write()
        show(self.case, to, case.name, answer)
        fails = self.telling.fails([*reading.warnings, *answer.problems])
        return FAILED if answer.failed or fails or not is_complete else DONE


def _in_both_units(case: Transmission, grids: Callable[[], Iterable[Grid]]) -> Iterator[Grid]:
    from vstatics.core.tables.straight import in_both_units  # few cases need it

    return in_both_units(case, grids())


of_case = (formats.options(*formats.TABLES), cases.input_format, cases.telling)
"""Options of each command for a single case: output, input format and messages."""
one_case = gathered("request", OneCase, click.argument("case", type=FILE), *of_case)
"""Decorator that adds the case and these options to a command, as argument `request`."""


def show(file: str, to: Destination, title: str, answer: CaseAnswer) -> None:
    """Write an answer about a case in the requested format."""
    name = file_name(file)
    shown = texts.CaseOutput([title or name], {}, answer.grids, lambda: answer.answer)
    files.write_pages(texts.alone(name, shown, to), to.output)


def tell(problems: Sequence[Problem], telling: Telling, file: str) -> None:
    """Print problems on stderr."""
    show_problems(problems, telling, file_name(file))


def warnings_of(identity: str, messages: Iterable[str], file: str) -> list[Problem]:
    """Return warnings about a whole file."""
    return [of_file(identity, file, message) for message in messages]


def one_text(wanted: OutputOptions, inputs: Sequence[str]) -> Destination:
    """Return the destination for a single case, which must not be a directory."""
    to = wanted.destination(inputs)
    if to.is_folder:
        raise click.UsageError(f"one case has one output: expected -o FILE, not {to.output}")
    return to
