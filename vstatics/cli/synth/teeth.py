"""`vstatics synth teeth`: integer teeth for wanted ratios of gears or sets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import formats
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import OutputOptions
from vstatics.cli.frame.one_case import (
    file_name,
    one_text,
    problems_of,
    show_alone,
    tell,
    warnings_of,
)
from vstatics.cli.frame.problems import Telling
from vstatics.cli.frame.progress import progress
from vstatics.cli.frame.values import named, pair, separated, wrong_use
from vstatics.cli.synth.case_file import case_format, write_case, written_case
from vstatics.errors import Problem, listed, of_file, quoted
from vstatics.readers.named.scalars import number
from vstatics.synthesis.teeth.case import case_with_teeth
from vstatics.synthesis.teeth.finding import FoundTeeth, NoTeethError, find_teeth
from vstatics.synthesis.teeth.grids import asked_grids, teeth_grids
from vstatics.synthesis.teeth.limits import CLEARANCE, TeethLimits
from vstatics.synthesis.teeth.problem import own_ratios, teeth_problem
from vstatics.synthesis.teeth.reach import doubts_before
from vstatics.synthesis.teeth.solutions import asked_document, teeth_document
from vstatics.synthesis.teeth.targets import TeethError


@click.command()
@click.argument("case", type=click.Path())
@click.option(
    "--ratios",
    multiple=True,
    metavar="NAME=I,...",
    help="What gears should have, such as 1=4.7,R=-3.3, or sets, such as P1=-2.03; a name with "
    "commas in double quotes. Else what the gears of the case have.",
)
@click.option(
    "--range",
    "ranges",
    multiple=True,
    metavar="WHEEL=LOW:HIGH,...",
    help="Fewest and most teeth, or the number there is to be: of the wheels of one name, "
    "sun=17:60, of one of them, P2.ring=40:121, or of all others, all=17:90. Else 17 to 60, "
    "rings to 121, wheels of pairs to 100, and as far as what the case has. Fewer than 17 mean a "
    "shifted profile.",
)
@click.option(
    "--planets",
    multiple=True,
    metavar="N,...",
    help="How many planets there may be; else as many as the case says, or 3 to 5.",
)
@click.option(
    "--clearance",
    metavar="C",
    default=f"{CLEARANCE:g}",
    show_default=True,
    help="Modules between the tips of neighbouring planets.",
)
@click.option(
    "--centre",
    multiple=True,
    metavar="PAIR=A,...",
    help="Distance of the axes of an external gear pair in modules, half the sum of its teeth; "
    "pairs on the same two shafts need it, since their axes are not compared.",
)
@click.option(
    "--modules",
    multiple=True,
    metavar="M,...",
    help="Modules to choose from [mm], one for all wheels that mesh; else all have the same.",
)
@click.option(
    "--largest-diameter",
    "largest",
    metavar="D",
    help="Of an element over its ring or planets [mm]; needs --modules.",
)
@click.option(
    "--shift",
    metavar="N",
    default="0",
    show_default=True,
    help="Teeth by which axes may differ, up to 2, as shifted profiles make up for it; else they "
    "coincide. Then wheels may have 14 teeth.",
)
@click.option(
    "--error",
    type=click.Choice(["ln", "absolute"]),
    default="ln",
    show_default=True,
    help="What is least in its largest value: |ln(i/target)|, or |i - target|.",
)
@click.option(
    "--dry-run", is_flag=True, help="Only say which wheels of which kinds are looked for."
)
@written_case
@formats.options(*formats.TABLES)
@arguments.input_format
@arguments.telling
def teeth(
    case: str,
    ratios: tuple[str, ...],
    ranges: tuple[str, ...],
    planets: tuple[str, ...],
    clearance: str,
    centre: tuple[str, ...],
    modules: tuple[str, ...],
    largest: str | None,
    shift: str,
    error: TeethError,
    dry_run: bool,
    target: str | None,
    wanted: OutputOptions,
    input_format: readers.Format | None,
    telling: Telling,
) -> int:
    """Find teeth of the elements of CASE for wanted ratios; - is standard input.

    All teeth fulfil the conditions: axes coincide, planets go in and don't touch, no wheel is
    undercut (14 to 16 teeth, where a range has them, need a shifted profile), no tips foul one
    another in a ring. The 20 best are given, each with other teeth, by
    the largest error of all that is wanted; it is proven that no others are better. A mechanism
    without teeth counts as a planetary set, or as a pair of wheels where it has two links:
    --dry-run tells which.

    \b
    Examples:
      vstatics synth teeth cases/belaz7516.yaml --ratios 2=4,4=2.01,5=1.4925,R2=-5.12
      vstatics synth teeth box.yaml --range sun=17:60,P2.ring=40:121 --planets 3,4 -f json
      vstatics synth teeth box.yaml --ratios P1=-2.03 --write teeth.yaml

    \b
    Exit status: 0 teeth are found; 1 none fulfil the conditions, or the case is in error;
    2 wrong use, such as a wheel that there is not.
    """
    to = one_text(wanted, [case])
    form = "" if target is None else case_format(target, [case], to.output)
    limits = TeethLimits(
        named("range", ranges, "WHEEL=LOW:HIGH", _whole_pair),
        tuple(one for text in _each("planets", planets) for one in _counts(text)),
        _of("clearance", clearance),
        named("centre", centre, "PAIR=MODULES", number),
        tuple(_of("modules", text) for text in _each("modules", modules)),
        None if largest is None else _of("largest-diameter", largest),
        _whole("shift", shift),
    )
    asked = named("ratios", ratios, "NAME=RATIO", number)
    reading = arguments.read_one(case, input_format, telling)
    own = reading.case
    with problems_of(reading), wrong_use(_OPTIONS):
        asked = asked or own_ratios(own)
        if dry_run:
            problem = teeth_problem(own, asked, limits, error)
            notes = warnings_of(doubts_before(problem), file_name(case))
            tell(notes, telling, case)
            show_alone(
                case, to, own.name, lambda: asked_grids(problem), lambda: asked_document(problem)
            )
            return FAILED if telling.fails([*reading.warnings, *notes]) else DONE
        try:
            with progress(None, "regions", quiet=telling.quiet) as advance:
                found = find_teeth(own, asked, limits, error=error, advance=advance)
        except NoTeethError as failed:
            tell([of_file(file_name(case), one.message) for one in failed.problems], telling, case)
            show_alone(case, to, own.name, list, lambda: teeth_document([]))
            return FAILED
    notes = [*_notes(found, file_name(case))]
    tell(notes, telling, case)
    kept = target is None or write_case(
        case_with_teeth(own, found.problem, found.solutions[0]), target, form
    )
    grids, document = lambda: teeth_grids(found), lambda: teeth_document(found.solutions)
    show_alone(case, to, own.name, grids, document)
    return FAILED if not kept or telling.fails([*reading.warnings, *notes]) else DONE


def _each(option: str, texts: Sequence[str]) -> list[str]:
    """The values of an option without names."""
    found = separated(texts)
    if not all(found):
        raise click.BadParameter(f"read {quoted(','.join(texts))}", param_hint=f"--{option}")
    return found


def _of(option: str, text: str) -> float:
    try:
        return number(text)
    except ValueError as error:
        raise click.BadParameter(
            f"read {quoted(text)}, {error}", param_hint=f"--{option}"
        ) from None


def _whole(option: str, text: str) -> int:
    value = _of(option, text)
    if value != int(value):
        message = f"read {quoted(text)}, expected a whole number"
        raise click.BadParameter(message, param_hint=f"--{option}")
    return int(value)


def _counts(text: str) -> Iterable[int]:
    """One number of planets, or all from one to another."""
    low, colon, high = text.partition(":")
    first = _whole("planets", low)
    last = _whole("planets", high) if colon else first
    if not first <= last < first + 100:
        message = f"read {quoted(text)}, expected a number, or LOW:HIGH"
        raise click.BadParameter(message, param_hint="--planets")
    return range(first, last + 1)


def _whole_pair(text: str) -> tuple[int, int]:
    low, high = pair(text, "17:60")
    if low != int(low) or high != int(high):
        raise ValueError("expected whole numbers of teeth, such as 17:60")
    return int(low), int(high)


_OPTIONS = (
    *("ratios", "range", "planets", "clearance", "centre"),
    *("modules", "largest-diameter", "shift"),
)


def _notes(found: FoundTeeth, file: str) -> Iterator[Problem]:
    """What to know of the solutions."""
    yield from warnings_of(found.doubts, file)
    if found.problem.unused:
        message = f"in no wanted ratio, so as they are: {listed(found.problem.unused)}"
        yield of_file(file, message)._replace(severity="note")
    if not found.is_proven:
        message = (
            f"the search was ended: that others are better is possible, "
            f"but none has an error below {found.bound:.3g}"
        )
        yield from warnings_of([message], file)
