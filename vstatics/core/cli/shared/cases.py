"""What commands share: their arguments, and reading and calculating each case."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, get_args

import click
from click.core import ParameterSource

from vstatics.core import readers
from vstatics.core.cli.shared import documents, files
from vstatics.core.cli.shared.documents import DocumentOfCase
from vstatics.core.cli.shared.options import Command, completing, gathered
from vstatics.core.cli.shared.patterns import expanded
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import above_0, allowable, value, wrong_value
from vstatics.core.errors import DOUBTS, CaseError, Problem, ReadError, not_allowed, of_file
from vstatics.core.extras import broken
from vstatics.core.jobs.files import STDIN_NAME
from vstatics.core.model.checks import hints
from vstatics.core.model.transmission import IdleConvention, Transmission
from vstatics.core.readers.kinds import document_function
from vstatics.core.readers.reading import Reading
from vstatics.core.tables.suffixes import suffix_of
from vstatics.core.texts import Language

if TYPE_CHECKING:
    from vstatics.core.statics.results import Results

argument, optional_argument = (
    click.argument(
        "cases",
        nargs=-1,
        required=required,
        type=click.Path(),
        metavar="CASE...",
        callback=lambda _, __, cases: tuple(expanded(cases)),
    )
    for required in (True, False)
)
"""Cases of a command, and of one that may do without; patterns among them are expanded."""
files_from = click.option(
    "--files-from",
    type=click.Path(),
    metavar="FILE",
    help="More cases: one a line, # begins a comment; or ended by NUL; - is standard input.",
)
input_format = click.option(
    "--from",
    "input_format",
    type=click.Choice(list(readers.READERS)),
    help="Format of the input; else told by the suffix, then by the content.",
)
coast = click.option(
    "--coast/--drive",
    default=None,
    help="Power enters at the output (engine braking), or at the input; else as the case says.",
)
idle = click.option(
    "--idle",
    type=click.Choice(get_args(IdleConvention)),
    help="Sign of idle mechanisms; else as the case says.",
)
quiet = click.option(
    "-q",
    "--quiet",
    is_flag=True,
    help="Errors only: no warnings, notes, progress; no count where all is well.",
)
strict = click.option(
    "--strict", is_flag=True, help="Warnings make the exit status 1, too; notes do not."
)
allow = click.option(
    "--allow",
    multiple=True,
    metavar="ID",
    callback=value(allowable),
    shell_complete=completing(lambda: DOUBTS),
    help="Warnings or notes that are not told, as W201 or W201,N318; may be given several times.",
)
limit = click.option(
    "--limit",
    type=float,
    callback=value(above_0),
    metavar="SECONDS",
    help="So long a run may take by the clock; then it stops, with what it has.",
)
"""Of the commands that run scenarios."""
some_gears = click.option(
    "--gear",
    "gears",
    multiple=True,
    metavar="G",
    help="This gear only, by its name, or the third by '#3'; may be given several times.",
)


class RequiredUnless(click.Option):
    """An option that a command can't do without, unless another one is given."""

    def __init__(self, *names: Any, unless: str = "", **named: Any) -> None:
        super().__init__(*names, **named)
        self.unless = unless

    def get_help_record(self, ctx: click.Context) -> tuple[str, str] | None:
        """As click has it, with what makes it needless."""
        said = super().get_help_record(ctx)
        other = self._other(ctx)
        if said is None or other is None:
            return said
        return said[0], said[1].replace("[required]", f"[required without {other.opts[-1]}]")

    def process_value(self, ctx: click.Context, value: Any) -> Any:
        """As click does it; one that is missing is told with what may stand in its place."""
        try:
            return super().process_value(ctx, value)
        except click.MissingParameter:
            if (other := self._other(ctx)) is None:
                raise
            this, that = (f"{one.opts[-1]} {one.metavar or ''}".rstrip() for one in (self, other))
            message = f"Expected {this}, or {that} in its place."
            raise click.MissingParameter(message, ctx, self) from None

    def _other(self, ctx: click.Context) -> click.Option | None:
        """The option that makes it needless."""
        options = (one for one in ctx.command.params if isinstance(one, click.Option))
        return next((one for one in options if one.name == self.unless), None)

    def value_is_missing(self, value: Any) -> bool:
        """Whether it is needed, and not given."""
        context = click.get_current_context()
        is_given = context.get_parameter_source(self.unless) not in (None, ParameterSource.DEFAULT)
        other = is_given and context.params.get(self.unless)
        return not other and super().value_is_missing(value)


def required_output(says: str, unless: str = "") -> Callable[[Command], Command]:
    """The option for a file that a command can't do without, unless it has an eager other one."""
    return click.option(
        "-o",
        "--output",
        type=click.Path(),
        required=True,
        metavar="FILE",
        help=says,
        cls=RequiredUnless,
        unless=unless,
    )


def language(of: str, *more: str) -> Callable[[Command], Command]:
    """The option for the language of something, which may have more than the usual ones."""
    return click.option(
        "--lang",
        type=click.Choice([*get_args(Language), *more]),
        default="en",
        show_default=True,
        help=f"Language of {of}.",
    )


class CalculatedCase(NamedTuple):
    """What became of a case: results, or only problems."""

    file: str
    results: Results | None
    problems: list[Problem]
    data: bytes = b""
    """What was read."""
    telling: Telling = Telling()
    scenario: DocumentOfCase | None = None
    """That which names the case, where the command takes one."""
    is_run: bool = False
    """Whether its run is shown."""
    locate: Callable[[Problem], Problem] | None = None
    """Gives a problem of the model its place in the file."""

    def located(self, error: CaseError) -> ReadError:
        """Return an error about the model with places in the file of the case."""
        problems = error.problems if self.locate is None else map(self.locate, error.problems)
        return ReadError(each if each.place else each.in_file(self.file) for each in problems)

    @property
    def failed(self) -> bool:
        """Whether the case is in error, a gear is tied up, or what is told makes it fail."""
        if self.results is None or (self.results.failed and not self.is_run):
            return True
        return self.telling.fails(self.problems)

    def with_told(self, more: Sequence[Problem]) -> CalculatedCase:
        """The same, with what is told of what is shown."""
        return self._replace(problems=[*self.problems, *more])


class CaseOptions(NamedTuple):
    """How cases are read and calculated; what is None is as the case says."""

    input_format: readers.Format | None = None
    coast: bool | None = None
    idle: IdleConvention | None = None
    telling: Telling = Telling()
    scenarios: bool = False
    """Whether a scenario may stand for its case."""
    of_runs: bool = False
    """Whether its run is shown then, of which faults of gears are none."""
    of_vibration: bool = False
    """Whether vibration is shown, in which a converter without a speed ratio is open."""

    @property
    def on_page(self) -> CaseOptions:
        """The same where a page tells notes, which are not printed."""
        return self._replace(telling=self.telling._replace(notes=True, on_page=True))


telling = gathered("telling", Telling, quiet, strict, allow)
"""The options of what is printed and what fails."""
settings = gathered("settings", CaseOptions, input_format, coast, idle, telling)
"""The options of how cases are read, calculated and told."""


def gear_number(case: Transmission, asked: str, option: str = "--gear") -> int:
    """The number of a gear from 1: the one of this name, else the one of this number.

    Raises
    ------
    BadParameter
        If there is none; it tells the option that asked, and the nearest name.
    """
    with wrong_value(option):
        return case.gear_number(asked)


def gear_indices(case: Transmission, asked: Sequence[str], option: str = "--gear") -> Sequence[int]:
    """The indices of the gears that are asked for, each once; all where none is.

    Raises
    ------
    BadParameter
        If there is no such gear.
    """
    numbers = dict.fromkeys(gear_number(case, one, option) for one in asked)
    return [number - 1 for number in numbers] or range(len(case.gears))


def calculate(cases: Sequence[str], settings: CaseOptions) -> Iterator[CalculatedCase]:
    """Read and calculate each case, print its problems, and go on after a bad one."""
    check_streams(cases)
    for file in cases:
        outcome = calculate_one(file, settings)
        show_problems(outcome.problems, settings.telling, outcome.file)
        yield outcome


def outside_notes(names: Sequence[str], case: Transmission, file: str) -> list[Problem]:
    """Which laws were asked outside their points, if any and nobody allowed it."""
    from vstatics.core.statics.diagnosis import outside_message

    found = not_allowed([outside_message(names)] if names else [], case.untold)
    return [of_file(one.id, file, one.text) for one in found]


def show_problems(problems: Sequence[Problem], telling: Telling, name: str) -> None:
    """Print problems of a file on stderr, and that it fails by what is not printed."""
    files.show(telling.printed(problems))
    files.show(telling.quiet_failure(problems, name))


def named(cases: tuple[str, ...], files_from: str | None) -> list[str]:
    """All cases, of arguments and of the list.

    Raises
    ------
    UsageError
        If there is none, or standard input is to be two things.
    ReadError
        If the list can't be read.
    """
    if files_from is None:
        if not cases:
            raise click.UsageError("Missing argument 'CASE...'.")
        names = [*cases]
    else:
        if files_from == files.STDIN and files.STDIN in cases:
            raise click.UsageError("standard input (-) is the list of cases, and no case")
        names = [*cases, *files.read_names(files_from)]
    check_streams(names)
    return names


def check_streams(cases: Sequence[str]) -> None:
    """Standard input can be one case only."""
    if cases.count(files.STDIN) > 1:
        raise click.UsageError("standard input (-) can be read once")


def check_order(case: str, table: str) -> None:
    """A case stands before the table in CSV that belongs to it."""
    if suffix_of(case) == ".csv" != suffix_of(table):
        raise click.UsageError(f"the case stands first, then the CSV file: {table} {case}")


def calculate_one(
    file: str,
    settings: CaseOptions,
    texts: Mapping[str, bytes] = documents.NO_TEXTS,
    *,
    regular: bool = False,
) -> CalculatedCase:
    """Read and calculate a case; whatever goes wrong with it is a problem of this case.

    Texts replace the content of the files of their names. `regular` refuses pipes and devices.
    """
    from vstatics.core.checking import located_messages  # needless for help

    name, data = STDIN_NAME if file == files.STDIN else file, b""
    scenario, locate = None, None
    try:
        data, name = _content(file, texts, regular=regular)
        with_case = settings.scenarios and document_function("read_with_case", data, name)
        if with_case:
            read: DocumentOfCase = with_case(data, name, settings.input_format, texts=texts)
            scenario = read.allowing(settings.telling.allow)
            reading = scenario.reading
        else:
            reading = readers.read(data, name, settings.input_format)
            reading = reading.allowing(settings.telling.allow)
        opens = settings.of_vibration or (settings.of_runs and scenario is not None)
        locate = reading.locate
        results = _solved(reading, settings, opens=opens)
        notes = map(reading.locate, hints(reading.case)) if settings.telling.notes else ()
        each = settings.telling.each_gear
        found = located_messages(reading, results, each_gear=each)
        if settings.of_runs and scenario is not None:
            found = (one._replace(id="N004") for one in found)
        problems = not_allowed([*reading.warnings, *notes, *found], reading.case.untold)
    except ReadError as error:
        no_case = documents.no_case(data, name, "read_with_case" * settings.scenarios)
        results, problems = None, no_case or error.problems
    except Exception as error:  # noqa: BLE001 - the other cases are to go on
        results, problems = None, [unexpected(name, error)]
    told = settings.telling.told(problems)
    is_run = settings.of_runs and scenario is not None
    return CalculatedCase(name, results, told, data, settings.telling, scenario, is_run, locate)


def _content(file: str, texts: Mapping[str, bytes], *, regular: bool) -> tuple[bytes, str]:
    if file in texts:
        return texts[file], file
    return files.read_input(file, regular=regular)


def _solved(reading: Reading, settings: CaseOptions, *, opens: bool) -> Results:
    """The results of a case, converters without a speed ratio open in it if that is asked.

    Raises
    ------
    ReadError
        If a law of it gives no torque that can be, with its place.
    """
    from vstatics.core.model.open_converters import with_needed_ratios
    from vstatics.core.statics.solve import solve  # needless for help

    try:
        case = with_needed_ratios(reading.case) if opens else reading.case
        return solve(case, coast=settings.coast, idle=settings.idle)
    except CaseError as error:
        raise ReadError(map(reading.locate, error.problems)) from None


def read_data(
    data: bytes, name: str, input_format: readers.Format | None, telling: Telling
) -> Reading:
    """Read the case of a command that does not show its results, and print its warnings.

    Raises
    ------
    ReadError
        If it can't be read; with the problems to print.
    """
    try:
        reading = readers.read(data, name, input_format).allowing(telling.allow)
    except ReadError as error:
        raise ReadError(telling.printed(documents.no_case(data, name) or error.problems)) from None
    show_problems(reading.warnings, telling, name)
    return reading


def unexpected(name: str, error: Exception) -> Problem:
    """The problem that the program itself has a fault, with the line to look at.

    A package that can't be imported is none of it.
    """
    if why := broken(error):
        return of_file("E014", name, why)
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    where = ""
    if trace is not None:
        where = f" in {os.path.basename(trace.tb_frame.f_code.co_filename)}:{trace.tb_lineno}"  # noqa: PTH119
    text = " ".join(f"{type(error).__name__}: {error}".split())
    message = f"an error of vstatics, please report it with this case: {text}{where}"
    return of_file("E002", name, message)
