"""`vstatics synth combinations`: list the gears that combinations of shift elements give."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.one_case import OneCase, one_case, problems_of
from vstatics.core.cli.shared.options import RenamedOption, command, gathered
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import separated, value, wrong_value
from vstatics.core.errors import CaseError, ReadError, listed, of_file, plural, quoted
from vstatics.synthesis.cli.case_file import case_format, write_case, written_case

if TYPE_CHECKING:
    from vstatics.synthesis.gears.search import CombinationSearch


def _sizes(texts: Sequence[str]) -> list[int]:
    asked = separated(texts)
    for text in asked:
        if not (text.isascii() and text.isdigit() and len(text) <= 9):
            expected = "expected a whole number of shift elements, or several: 2,3"
            raise ValueError(f"read {quoted(text)}, {expected}")
    return list(dict.fromkeys(map(int, asked)))


class Trials(NamedTuple):
    """Choice of combinations: numbers and names of shift elements, ports, order and limit."""

    engaged: list[int]
    elements: tuple[str, ...]
    ports: tuple[str, ...]
    sort: str | None
    at_most: int
    dry_run: bool


@command
@gathered(
    "trials",
    Trials,
    click.option(
        "--engaged",
        multiple=True,
        callback=value(_sizes),
        metavar="K",
        help="Number of engaged shift elements, or several such as 2,3.  [default: the number "
        "that leaves one degree of freedom]",
    ),
    click.option(
        "--shift-elements",
        "elements",
        cls=RenamedOption,
        former=["--elements"],
        multiple=True,
        metavar="auto|NAME,...",
        help="Shift elements to combine; auto: all possible clutches and brakes. Repeatable.  "
        "[default: all shift elements of the case]",
    ),
    click.option(
        "--ports",
        multiple=True,
        metavar="all|IN:OUT,...",
        help="Pairs of input and output; all: each ordered pair of links. Repeatable.  [default: "
        "input and output of the case]",
    ),
    click.option(
        "--sort",
        type=click.Choice(["torques"]),
        help="Sort by the largest torque of a shift element, direct drives before gears.",
    ),
    click.option(
        "--at-most",
        type=click.IntRange(min=1),
        default=1_000_000,
        show_default=True,
        metavar="N",
        help="Largest number of combinations to try.",
    ),
    click.option("--dry-run", is_flag=True, help="Print only estimates of number, size and time."),
)
@written_case
@one_case
def combinations_command(
    request: OneCase,
    trials: Trials,
    target: str | None,
) -> int:
    """Find the gears of all combinations of K engaged shift elements of CASE.

    The combinations are listed by the motion of input and output that they allow:

    \b
      blocked  the input cannot turn
      parking  the output cannot turn
      neutral  input and output turn independently
      gear     a fixed ratio
      direct   the ratio 1, independent of the ratios of the mechanisms
      free     added if the speeds of other links are indeterminate

    A freewheel counts as holding. With --shift-elements auto, the shift elements are a
    clutch between any two links, such as F-1-2, and a brake on any link except input and
    output, such as T-3.

    Torques are the torques of the engaged shift elements without losses, divided by the
    input torque. For a direct drive by one shift element, slip is its slip speed while the
    output is at rest, divided by the input speed. The product of torque and slip is 1. The
    CASE `-` is standard input.

    \b
    Examples:
      vstatics new box.yaml --template simpson
      vstatics synth combinations box.yaml
      vstatics synth combinations box.yaml --engaged 1,2 -f json
      vstatics synth combinations box.yaml --shift-elements auto --sort torques
      vstatics synth combinations box.yaml --shift-elements auto \\
          --write gears.yaml
      vstatics synth combinations box.yaml --ports all -f json

    Exit status 1: the case has an error, or no gear can be written.
    """
    to, telling = request.destination(), request.telling
    form = None if target is None else case_format(target, [request.case], to.output)
    from vstatics.synthesis.cli.combinations_output import (
        check_room,
        show,
        show_estimate,
        show_ports,
    )
    from vstatics.synthesis.gears.ports import between, port_pairs
    from vstatics.synthesis.gears.search import (
        AUTO,
        CombinationSearch,
        chosen_elements,
        refuse_converters,
    )

    if trials.ports and (trials.dry_run or target):
        raise click.UsageError("--ports cannot be combined with --dry-run or --write")
    reading = request.read()
    with problems_of(reading):
        refuse_converters(reading.case)
    chosen = _chosen([element.name for element in reading.case.shift_elements], trials.elements)
    with wrong_value("--shift-elements"):
        if chosen != [AUTO]:
            chosen_elements(reading.case, chosen)
    with wrong_value("--ports"):
        pairs = port_pairs(reading.case, separated(trials.ports))
    cases = [between(reading.case, pair) for pair in pairs] or [reading.case]
    with (
        problems_of(reading),
        wrong_value("--engaged"),
        _hint("see --shift-elements and --engaged"),
    ):
        searches = [CombinationSearch(case, trials.engaged, chosen) for case in cases]
    with problems_of(reading), _hint("see --dry-run, --engaged, --shift-elements and --at-most"):
        for each_search in searches:
            each_search.check(None if trials.dry_run else trials.at_most // len(searches))
    search, is_complete, by_torque = searches[0], True, trials.sort is not None
    if pairs:
        show_ports(searches, request.case, to, telling, by_torque=by_torque)
    elif trials.dry_run:
        show_estimate(search, request.case, to)
    else:
        check_room(search, to, by_torque=by_torque)
        _told_freewheels(search, telling)
        if target is not None and form is not None:
            is_complete = _write(search, target, form, request)
        show(search, request.case, to, telling, by_torque=by_torque)
    return FAILED if not is_complete or telling.fails(reading.warnings) else DONE


def _chosen(names: Sequence[str], asked: Iterable[str]) -> list[str]:
    """Split texts at commas into names of shift elements.

    A text that is itself a name, or a name in quotes, is not split.
    """
    return [name for text in asked for name in ([text] if text in names else separated([text]))]


@contextmanager
def _hint(hint: str) -> Iterator[None]:
    """Add a hint about helpful options to problems of the case."""
    try:
        yield
    except CaseError as error:
        raise CaseError(
            [
                problem._replace(message=f"{problem.message}; {hint}") if problem.path else problem
                for problem in error.problems
            ]
        ) from None


def _told_freewheels(search: CombinationSearch, telling: Telling) -> None:
    names = [element.name for element in search.elements if element.is_freewheel]
    if names and not telling.quiet:
        message = f"note: freewheels count as holding shift elements: {listed(names)}"
        files.say(f"{message}; --write keeps the gears in which they hold")


def _write(search: CombinationSearch, target: str, form: str, request: OneCase) -> bool:
    """Write a case with the found gears; return whether the format holds all data."""
    from vstatics.synthesis.gears.found_gears import found_gears

    try:
        result = found_gears(search)
    except CaseError as error:
        message = f"{error.problems[0].message}; {target} is not written"
        raise ReadError([of_file("E020", file_name(request.case), message)]) from None
    if result.slipping and not request.telling.quiet:
        files.say(f"{target}: left out, as freewheels do not hold: {listed(result.slipping)}")
    if result.free and not request.telling.quiet:
        what = f"{result.free} {plural('gear', result.free)} with other links undetermined"
        files.say(f"{target}: left out: {what}")
    return write_case(result.case, target, form)
