"""Options of commands that take cases, and the reading and calculation of each case."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, get_args

import click
from click.core import ParameterSource

from vstatics.core import readers
from vstatics.core.cli.shared import documents, files
from vstatics.core.cli.shared.documents import DocumentOfCase
from vstatics.core.cli.shared.options import (
    CALCULATION,
    INPUT,
    MESSAGES,
    OUTPUT,
    Command,
    RenamedOption,
    completing,
    gathered,
    under,
)
from vstatics.core.cli.shared.patterns import expanded
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import FILE, above_0, allowable, value, wrong_value
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed, of_file
from vstatics.core.extras import broken, higher
from vstatics.core.messages.catalogue import causes_of_allowable
from vstatics.core.model.checks import hints
from vstatics.core.model.parts import NOMINAL_LOAD, Load
from vstatics.core.model.transmission import IdleConvention, Transmission
from vstatics.core.readers.reading import Reading
from vstatics.core.start import NamedTuple
from vstatics.core.tables.file_suffixes import suffix_of
from vstatics.core.texts import Language

if TYPE_CHECKING:
    from vstatics.core.statics.results import Results

argument, optional_argument = (
    click.argument(
        "cases",
        nargs=-1,
        required=required,
        type=FILE,
        metavar="CASE...",
        callback=lambda _, __, cases: tuple(expanded(cases)),
    )
    for required in (True, False)
)
"""Arguments of commands: at least one case, or any number of cases. Patterns are expanded."""
files_from = under(
    INPUT,
    click.option(
        "--files-from",
        type=FILE,
        metavar="FILE",
        help="File with names of further cases; `-` is standard input. Give one name per line, "
        "or separate the names by NUL characters. A line that begins with # is a comment.",
    ),
)
input_format = under(
    INPUT,
    click.option(
        "--from",
        "input_format",
        type=click.Choice(readers.FORMATS),
        help="Format of the input.  [default: by the suffix, then by the content]",
    ),
)
coast = under(
    CALCULATION,
    click.option(
        "--coast/--drive",
        default=None,
        help="Side at which power enters: the output (engine braking), or the input.  [default: "
        "as in the case]",
    ),
)
idle = under(
    CALCULATION,
    click.option(
        "--unloaded",
        "idle",
        cls=RenamedOption,
        former=["--idle"],
        type=click.Choice(get_args(IdleConvention)),
        help="Power sign of unloaded mechanisms: 0 (exact), or +1 or -1 as in "
        "the listing of the program Visual-Statics (published).  [default: as in the case]",
    ),
)
quiet = under(
    MESSAGES,
    click.option(
        "-q",
        "--quiet",
        is_flag=True,
        help="Print errors only: no warnings, notes or progress.",
    ),
)
strict = under(
    MESSAGES,
    click.option("--strict", is_flag=True, help="Exit with status 1 if there is a warning."),
)
allow = under(
    MESSAGES,
    click.option(
        "--allow",
        multiple=True,
        metavar="ID,...",
        callback=value(allowable),
        shell_complete=completing(causes_of_allowable),
        help="Suppress these warnings and notes, such as W201,N318. Repeatable.",
    ),
)
limit = under(
    CALCULATION,
    click.option(
        "--limit",
        type=float,
        callback=value(above_0),
        metavar="SECONDS",
        help="Stop each simulation after SECONDS of wall-clock time and keep the results so far.",
    ),
)
"""Option that limits the wall-clock time of a simulation."""
some_gears = under(
    INPUT,
    click.option(
        "--gear",
        "gears",
        multiple=True,
        metavar="G",
        help="Gear to show, by its name, or by its number as '#3'. Repeatable.  [default: all]",
    ),
)


class RequiredUnless(RenamedOption):
    """Option that is required unless another option is given."""

    def __init__(self, *names: Any, unless: str = "", **named: Any) -> None:
        super().__init__(*names, **named)
        self.unless = unless

    def get_help_record(self, ctx: click.Context) -> tuple[str, str] | None:
        """Return the help text of the option, including the name of the other option."""
        record = super().get_help_record(ctx)
        other = self._other(ctx)
        if record is None or other is None:
            return record
        return record[0], record[1].replace("[required]", f"[required without {other.opts[-1]}]")

    def process_value(self, ctx: click.Context, value: Any) -> Any:
        """Return the value. If it is missing, the error also names the other option."""
        try:
            return super().process_value(ctx, value)
        except click.MissingParameter:
            if (other := self._other(ctx)) is None:
                raise
            this, that = (
                f"{option.opts[-1]} {option.metavar or ''}".rstrip() for option in (self, other)
            )
            message = f"Expected {this}, or {that} instead."
            raise click.MissingParameter(message, ctx, self) from None

    def _other(self, ctx: click.Context) -> click.Option | None:
        options = (option for option in ctx.command.params if isinstance(option, click.Option))
        return next((option for option in options if option.name == self.unless), None)

    def value_is_missing(self, value: Any) -> bool:
        """Return whether the option and the other option are both missing."""
        context = click.get_current_context()
        is_given = context.get_parameter_source(self.unless) not in (None, ParameterSource.DEFAULT)
        other = is_given and context.params.get(self.unless)
        return not other and super().value_is_missing(value)


def required_output(says: str, unless: str = "") -> Callable[[Command], Command]:
    """Return the option for an output file, which is required without the option `unless`."""
    return under(
        OUTPUT,
        click.option(
            "-o",
            "--output",
            type=FILE,
            required=True,
            metavar="FILE",
            help=says,
            cls=RequiredUnless,
            unless=unless,
        ),
    )


WORDS = "headings and words; names and messages stay as they are"
"""Help text of --lang for commands that print tables."""


def language(of: str, *more: str) -> Callable[[Command], Command]:
    """Return the option --lang for the language of `of`, with further choices `more`."""
    return under(
        OUTPUT,
        click.option(
            "--lang",
            type=click.Choice([*get_args(Language), *more]),
            default="en",
            show_default=True,
            help=f"Language of {of}.",
        ),
    )


Value = TypeVar("Value")
Steps: TypeAlias = Generator[None, None, Value]
"""Generator that stops after each step of its work and finally returns a value."""


class CalculatedCase(NamedTuple):
    """Outcome of a case: results and problems, or only problems."""

    file: str
    results: Results | None
    problems: list[Problem]
    data: bytes = b""
    """Content of the file of the case."""
    telling: Telling = Telling()
    scenario: DocumentOfCase | None = None
    """Scenario that names the case; None for other commands and files."""
    is_run: bool = False
    """True if the output concerns a run of the scenario, or vibration of gears that can vibrate."""
    locate: Callable[[Problem], Problem] | None = None
    """Function that adds the place in the file to a problem of the model."""

    def located(self, error: CaseError) -> ReadError:
        """Return an error whose problems have a place in the file of the case."""
        problems = error.problems if self.locate is None else map(self.locate, error.problems)
        return ReadError(each if each.place else each.in_file(self.file) for each in problems)

    @property
    def failed(self) -> bool:
        """True if the case has an error, or a warning that counts as an error.

        Unless `is_run`, a gear that is tied up or has a freewheel conflict is also an error.
        """
        if self.results is None or (self.results.failed and not self.is_run):
            return True
        return self.telling.fails(self.problems)

    def with_told(self, more: Sequence[Problem]) -> CalculatedCase:
        """Return the outcome with further problems."""
        return self._replace(problems=[*self.problems, *more])


_OF_LOAD = frozenset(("N414", "N421", "W426", "W427", "W430", "W431", "W433"))
"""Ids of messages about a gear that another operating point of the case can remove."""


class CaseOptions(NamedTuple):
    """Options for reading and calculating cases. An omitted option has the value of the case."""

    input_format: readers.Format | None = None
    coast: bool | None = None
    idle: IdleConvention | None = None
    telling: Telling = Telling()
    scenarios: bool = False
    """True if the command accepts a scenario instead of a case."""
    of_runs: bool = False
    """True if the output concerns a run of a scenario. Faulty gears are then not failures."""
    of_vibration: bool = False
    """True if the output concerns vibration. Gears that can vibrate are then not failures."""

    load: Load | None = None
    """Operating point for a case that has none."""
    is_nominal: bool = False
    """True if the output does not depend on `load`. Messages about it are then omitted."""

    @property
    def at_nominal_load(self) -> CaseOptions:
        """Options for results that do not depend on the operating point."""
        return self._replace(load=NOMINAL_LOAD, is_nominal=True)

    @property
    def on_page(self) -> CaseOptions:
        """Options for an HTML page, which contains notes instead of stderr."""
        return self._replace(telling=self.telling._replace(notes=True, on_page=True))


telling = gathered("telling", Telling, quiet, strict, allow)
"""Options that determine which messages are printed and which make the command fail."""
settings = gathered("settings", CaseOptions, input_format, coast, idle, telling)
"""Options of reading, calculating and reporting cases."""


def gear_number(case: Transmission, asked: str, option: str = "--gear") -> int:
    """Return the number (from 1) of a gear from its name or from text such as ``#3``.

    Raises
    ------
    BadParameter
        If the gear does not exist. The message contains the option and the most similar name.
    """
    with wrong_value(option):
        return case.gear_number(asked)


def gear_numbers(case: Transmission, asked: Iterable[str], option: str = "--gear") -> list[int]:
    """Return the numbers (from 1) of gears by name, each once.

    Raises
    ------
    BadParameter
        If a gear does not exist.
    """
    names = {gear.name for gear in case.gears}
    for name in asked:
        parts = name.split(",")
        if name not in names and names.issuperset(parts):
            options = " ".join(f"{option} {part}" for part in parts)
            message = f"read {name!r}, expected an option for each gear: {options}"
            raise click.BadParameter(message, param_hint=option)
    return [*dict.fromkeys(gear_number(case, name, option) for name in asked)]


def gear_indices(case: Transmission, asked: Sequence[str], option: str = "--gear") -> Sequence[int]:
    """Return the indices of gears by name, each once; all gears if `asked` is empty.

    Raises
    ------
    BadParameter
        If a gear does not exist.
    """
    return [number - 1 for number in gear_numbers(case, asked, option)] or range(len(case.gears))


def calculate(cases: Sequence[str], settings: CaseOptions) -> Iterator[CalculatedCase]:
    """Calculate every case, even after failures, and print the problems."""
    check_streams(cases)
    for file in cases:
        outcome = calculate_one(file, settings)
        show_problems(outcome.problems, settings.telling, outcome.file)
        yield outcome


def outside_notes(names: Sequence[str], case: Transmission, file: str) -> list[Problem]:
    """Return the note about laws evaluated outside their points, unless the case suppresses it."""
    from vstatics.core.statics.diagnosis import outside_message

    messages = not_allowed([outside_message(names)] if names else [], case.untold)
    return [of_file(message.id, file, message.text) for message in messages]


def show_problems(problems: Sequence[Problem], telling: Telling, name: str) -> None:
    """Print problems of a file on stderr.

    A failure because of unprinted warnings is also a problem.
    """
    files.show(telling.printed(problems))
    files.show(telling.quiet_failure(problems, name))


def named(cases: tuple[str, ...], files_from: str | None) -> list[str]:
    """Return the files of all cases: arguments, and names in the list of --files-from.

    Raises
    ------
    UsageError
        If there are no cases, or standard input is both the list and a case.
    ReadError
        If the list cannot be read.
    """
    if files_from is None:
        if not cases:
            raise click.UsageError("Missing argument 'CASE...'.")
        names = [*cases]
    else:
        if files_from == files.STDIN and files.STDIN in cases:
            raise click.UsageError(
                "standard input (-) is the list of cases (--files-from), so it cannot be a case"
            )
        names = [*cases, *files.read_names(files_from)]
    check_streams(names)
    return names


def check_streams(cases: Sequence[str]) -> None:
    """Raise an error if standard input is named twice."""
    if cases.count(files.STDIN) > 1:
        raise click.UsageError("standard input (-) can be read only once")


def check_order(case: str, table: str) -> None:
    """Raise an error if the arguments `case` and `table` are probably swapped."""
    if suffix_of(case) == ".csv" != suffix_of(table):
        raise click.UsageError(f"expected the case first, then the CSV file: {table} {case}")


def calculate_one(
    file: str,
    settings: CaseOptions,
    texts: Mapping[str, bytes] = documents.NO_TEXTS,
    *,
    regular: bool = False,
) -> CalculatedCase:
    """Read and calculate a case, with all errors as problems.

    `texts` contains texts that are read instead of the files with these names. If `regular` is
    True, pipes and devices are not accepted.
    """
    return completed(case_in_steps(file, settings, texts, regular=regular))


def completed(steps: Steps[Value]) -> Value:
    """Carry out the remaining steps of a generator, and return its value."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            value: Value = end.value
            return value


def case_in_steps(
    file: str,
    settings: CaseOptions,
    texts: Mapping[str, bytes] = documents.NO_TEXTS,
    *,
    regular: bool = False,
) -> Steps[CalculatedCase]:
    """Read and calculate a case in steps; see `calculate_one`."""
    from vstatics.core.statics.solution import explained  # not needed for the help text

    name, data = files.file_name(file), b""
    scenario, locate, is_run = None, None, False
    try:
        if file in texts:
            data, name = texts[file], file
        else:
            data, name = files.read_input(file, regular=regular)
        yield
        with_case = None
        if settings.scenarios:
            from vstatics.core.readers.kinds import document_function  # costs start-up time

            with_case = document_function("read_with_case", data, name)
        if with_case:
            read: DocumentOfCase = with_case(data, name, settings.input_format, texts=texts)
            scenario, is_run = read.allowing(settings.telling.allow), settings.of_runs
            reading = scenario.reading
        else:
            reading = readers.read(data, name, settings.input_format)
            reading = reading.allowing(settings.telling.allow)
        locate = reading.locate
        yield
        results = _solved(reading, settings, is_run=is_run)
        yield
        results = explained(results)
        notes = map(reading.locate, hints(reading.case)) if settings.telling.notes else ()
        each_gear = settings.telling.each_gear
        gear_messages = reading.located_messages(results, each_gear=each_gear)
        if settings.is_nominal and results.case.load is settings.load:
            gear_messages = iter(())
        elif settings.is_nominal:
            gear_messages = (each for each in gear_messages if each.id not in _OF_LOAD)
        if is_run:
            gear_messages = (problem._replace(id="N004") for problem in gear_messages)
        elif settings.of_vibration and results.failed and _vibrates(results.case):
            is_run = True
            gear_messages = (problem for problem in gear_messages if problem.id != "E452")
        problems = not_allowed([*reading.warnings, *notes, *gear_messages], reading.case.untold)
    except ReadError as error:
        taken = "read_with_case" if settings.scenarios else ""
        no_case = documents.no_case(data, name, taken)
        results, problems = None, no_case or error.problems
    except Exception as error:  # noqa: BLE001 - further cases must be calculated
        results, problems = None, [unexpected(name, error)]
    reported = settings.telling.told(problems)
    return CalculatedCase(name, results, reported, data, settings.telling, scenario, is_run, locate)


def _vibrates(case: Transmission) -> bool:
    """Return whether each gear can vibrate, such as on springs that hold the input in statics."""
    try:
        return not any(isinstance(higher("vibrating")(case, gear), str) for gear in case.gears)
    except CaseError:
        return False


def _solved(reading: Reading, settings: CaseOptions, *, is_run: bool) -> Results:
    """Return the results of a case.

    In a run, converters without a speed ratio slip freely. For vibration, they slip freely only if
    the load does not determine their speed ratios.

    Raises
    ------
    ReadError
        If a law of the case has an impossible torque. The error contains its place.
    """
    from vstatics.core.statics.solution import solution  # not needed for the help text

    case = reading.case
    try:
        if is_run or settings.of_vibration:
            from vstatics.core.model.laws import of_sought_ratios
            from vstatics.core.model.open_converters import with_needed_ratios

            if is_run or any(of_sought_ratios(case)):
                case = with_needed_ratios(case)
        if settings.load and case.depends:
            from vstatics.core.model.laws import with_load

            case = with_load(case, settings.load)
        return solution(case, coast=settings.coast, idle=settings.idle, explain=False)
    except CaseError as error:
        raise ReadError(map(reading.locate, error.problems)) from None


def read_data(
    data: bytes, name: str, input_format: readers.Format | None, telling: Telling
) -> Reading:
    """Read a case and print the warnings, for a command that does not calculate results.

    Raises
    ------
    ReadError
        If the case cannot be read. The error contains the problems to print.
    """
    try:
        reading = readers.read(data, name, input_format).allowing(telling.allow)
    except ReadError as error:
        raise ReadError(telling.printed(documents.no_case(data, name) or error.problems)) from None
    show_problems(reading.warnings, telling, name)
    return reading


def unexpected(name: str, error: Exception) -> Problem:
    """Return the problem for a fault in the program, with the line of the code.

    An import error becomes the problem of a missing package.
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
    message = f"an error in vstatics, please report it with this case: {text}{where}"
    return of_file("E002", name, message)
