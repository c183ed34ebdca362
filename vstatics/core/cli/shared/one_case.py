"""What commands of one case share: its problems at their places, one text of it out."""

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
from vstatics.core.cli.shared.formats import Destination, OutputOptions
from vstatics.core.cli.shared.options import gathered, needs
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed, of_file
from vstatics.core.jobs.files import STDIN_NAME
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.reading import Reading
from vstatics.core.tables.answer import Answer
from vstatics.core.tables.grid import Grid


@contextmanager
def problems_of(reading: Reading) -> Iterator[None]:
    """Tell problems of a case at their places in its file.

    Raises
    ------
    ReadError
    """
    try:
        yield
    except ReadError:
        raise
    except CaseError as error:
        raise ReadError([_placed(one, reading) for one in error.problems]) from None


def _placed(problem: Problem, reading: Reading) -> Problem:
    """A problem at its place; one of what was asked for is of the file as a whole."""
    located = reading.locate(problem)
    if problem.path or located.place is None:
        return located
    return problem.in_file(located.place.file)


def file_name(file: str) -> str:
    """How a file is spoken of that the command was given."""
    return STDIN_NAME if file == files.STDIN else file


class CaseAnswer(NamedTuple):
    """What a command tells of one case; nothing is laid out before it is asked for."""

    grids: Callable[[], Iterable[Grid]]
    answer: Answer
    """What JSON is made of."""
    problems: Sequence[Problem] = ()
    failed: bool = False
    """Whether the command fails, though nothing else does."""
    write: Callable[[], bool] | None = None
    """Writes another file, when the problems are told; whether it keeps all that there is."""


class OneCase(NamedTuple):
    """The case of a command that takes one, and where the answer goes."""

    case: str
    wanted: OutputOptions
    input_format: readers.Format | None
    telling: Telling
    coast: bool | None = None
    """As an option says; as the case says itself where that says nothing."""
    static_torque: float | None = None
    """At the input, likewise. [N*m]"""

    def destination(self, *others: str) -> Destination:
        """Where the answer goes; nothing may be written over the case and other files.

        Raises
        ------
        UsageError
        """
        inputs = [self.case, *others]
        check_streams(inputs)
        return one_text(self.wanted, inputs)

    def read(self, *given: tuple[bytes, str]) -> Reading:
        """Read the case, which may be read as text already, and print its warnings.

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
        """Read the case, tell what is calculated of it, and write that; the exit status.

        Parameters
        ----------
        calculate : callable
            Problems of the case that it raises are told at their places.
        to : Destination, optional
            Where the command has not asked for it itself.
        extra : str
            Without which the command, called so too, can do nothing.
        *given : tuple of (bytes, str)
            The text of the case and the name of its file, where it is read already.

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
            found = calculate(reading)
        found = found._replace(problems=not_allowed(found.problems, reading.case.untold))
        if case.masses:
            found = found._replace(grids=partial(_in_both_units, case, found.grids))
        tell(found.problems, self.telling._replace(notes=True), self.case)
        kept = found.write is None or found.write()
        show(self.case, to, case.name, found)
        fails = self.telling.fails([*reading.warnings, *found.problems])
        return FAILED if found.failed or fails or not kept else DONE


def _in_both_units(case: Transmission, grids: Callable[[], Iterable[Grid]]) -> Iterator[Grid]:
    from vstatics.core.tables.straight import in_both_units  # other cases do without

    return in_both_units(case, grids())


of_case = (formats.options(*formats.TABLES), cases.input_format, cases.telling)
"""Its options, besides that of the direction of power."""
one_case = gathered("one", OneCase, click.argument("case", type=click.Path()), *of_case)
"""The case and the options of a command that takes one; the command gets `one`."""


def show(file: str, to: Destination, title: str, found: CaseAnswer) -> None:
    """Write what a command has of one case, in the format that is asked for."""
    name = file_name(file)
    shown = texts.CaseOutput([title or name], {}, found.grids, lambda: found.answer)
    files.write_pages(texts.alone(name, shown, to), to.output)


def tell(problems: Sequence[Problem], telling: Telling, file: str) -> None:
    """Print problems on stderr."""
    show_problems(problems, telling, file_name(file))


def warnings_of(identity: str, messages: Iterable[str], file: str) -> list[Problem]:
    """Warnings about a file as a whole."""
    return [of_file(identity, file, one) for one in messages]


def one_text(wanted: OutputOptions, inputs: Sequence[str]) -> Destination:
    """Where the result goes; a directory is for several, of which there are none."""
    to = wanted.destination(inputs)
    if to.is_folder:
        raise click.UsageError(f"one case gives one text: expected -o FILE, not {to.output}")
    return to
