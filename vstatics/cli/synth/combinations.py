"""`vstatics synth combinations`: which gears the shift elements of a case give."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import files, formats
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import OutputOptions
from vstatics.cli.frame.one_case import file_name, one_text, problems_of
from vstatics.cli.frame.problems import Telling
from vstatics.cli.frame.values import separated
from vstatics.cli.synth.case_file import case_format, write_case, written_case
from vstatics.errors import CaseError, ReadError, listed, of_file, plural, quoted

if TYPE_CHECKING:
    from vstatics.synthesis.gears.search import CombinationSearch


def _sizes(_context: click.Context, _option: click.Parameter, asked: Sequence[str]) -> list[int]:
    for one in separated(asked):
        if not (one.isascii() and one.isdigit() and len(one) <= 9):
            message = f"read {quoted(one)}, expected a whole number of elements, or several: 2,3"
            raise click.BadParameter(message)
    return list(dict.fromkeys(map(int, separated(asked))))


@click.command()
@click.argument("case", type=click.Path())
@click.option(
    "--engaged",
    multiple=True,
    callback=_sizes,
    metavar="K",
    help="So many elements are engaged; several as 2,3. "
    "[default: as many as leave one degree of freedom]",
)
@click.option(
    "--elements",
    multiple=True,
    metavar="auto|NAME,...",
    help="auto: all clutches and brakes that the scheme may have; else these of the case only, "
    "a name with commas in double quotes.",
)
@click.option(
    "--at-most",
    type=click.IntRange(min=1),
    default=1_000_000,
    show_default=True,
    metavar="N",
    help="Try no more combinations than these.",
)
@click.option("--dry-run", is_flag=True, help="Only say how many, how large, how long.")
@written_case
@formats.options(*formats.TABLES)
@arguments.input_format
@arguments.telling
def combinations(
    case: str,
    engaged: list[int],
    elements: tuple[str, ...],
    at_most: int,
    dry_run: bool,
    target: str | None,
    wanted: OutputOptions,
    input_format: readers.Format | None,
    telling: Telling,
) -> int:
    """Tell what each combination of shift elements of CASE does; - is standard input.

    All sets of exactly K elements, by the speeds of input and output that they allow:
    blocked, the input can't turn; parking, the output stands; neutral, both turn
    independently; gear, a fixed ratio; direct, 1 whatever the ratios of the
    mechanisms. Free: other links are left undetermined. A freewheel counts as one
    that holds.

    With --elements auto the elements are a clutch between any two links and a brake
    on any link but input and output; F-1-2 and T-3 are new ones, by their links.

    \b
    Examples:
      vstatics synth combinations box.yaml
      vstatics synth combinations box.yaml --engaged 1,2 -f json
      vstatics synth combinations box.yaml --elements auto --write gears.yaml

    \b
    Exit status: 0 done; 1 the case is in error, no gear is there to write;
    2 wrong use.
    """
    to = one_text(wanted, [case])
    form = None if target is None else case_format(target, [case], to.output)
    from vstatics.cli.synth.combinations_output import check_room, show, show_estimate
    from vstatics.synthesis.gears.element_choice import AUTO, chosen_elements
    from vstatics.synthesis.gears.search import CombinationSearch

    reading = arguments.read_one(case, input_format, telling)
    chosen = _chosen([one.name for one in reading.case.shift_elements], elements)
    with _wrong_use("--elements"):
        if chosen != [AUTO]:
            chosen_elements(reading.case, chosen)
    with problems_of(reading), _wrong_use("--engaged"), _hint("see --elements and --engaged"):
        search = CombinationSearch(reading.case, engaged, chosen)
    with problems_of(reading), _hint("see --dry-run, --engaged, --elements and --at-most"):
        search.check(None if dry_run else at_most)
    if dry_run:
        show_estimate(search, case, to)
        return FAILED if telling.fails(reading.warnings) else DONE
    check_room(search, to)
    _told_freewheels(search, telling)
    kept = target is None or form is None or _write(search, target, form, case, telling)
    show(search, case, to, telling)
    return FAILED if not kept or telling.fails(reading.warnings) else DONE


def _chosen(names: Sequence[str], asked: Iterable[str]) -> list[str]:
    """Names of elements; a comma separates them unless it is in quotes, or all is one name."""
    return [one for text in asked for one in ([text] if text in names else separated([text]))]


@contextmanager
def _wrong_use(option: str) -> Iterator[None]:
    """What is wrong with an option, not with the case."""
    try:
        yield
    except CaseError as error:
        if any(one.path for one in error.problems):
            raise
        message = error.problems[0].message
        raise click.BadParameter(message, param_hint=option) from None


@contextmanager
def _hint(hint: str) -> Iterator[None]:
    """Say which options help with what is wrong with the case."""
    try:
        yield
    except CaseError as error:
        raise CaseError(
            [
                one._replace(message=f"{one.message}; {hint}") if one.path else one
                for one in error.problems
            ]
        ) from None


def _told_freewheels(search: CombinationSearch, telling: Telling) -> None:
    names = [element.name for element in search.elements if element.is_freewheel]
    if names and not telling.quiet:
        message = f"note: a freewheel counts as an element that holds: {listed(names)}"
        files.say(f"{message}; --write keeps the gears in which they do")


def _write(search: CombinationSearch, target: str, form: str, case: str, telling: Telling) -> bool:
    """Write a case with the gears; whether all is kept."""
    from vstatics.synthesis.gears.found_gears import found_gears

    try:
        found = found_gears(search)
    except CaseError as error:
        message = f"{error.problems[0].message}; {target} is not written"
        raise ReadError([of_file(file_name(case), message)]) from None
    if found.slipping and not telling.quiet:
        files.say(f"{target}: left out, as freewheels do not hold: {listed(found.slipping)}")
    if found.free and not telling.quiet:
        what = f"{found.free} {plural('gear', found.free)} with other links undetermined"
        files.say(f"{target}: left out: {what}")
    return write_case(found.case, target, form)
