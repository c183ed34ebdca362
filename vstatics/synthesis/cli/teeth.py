"""`vstatics synth teeth`: find integer tooth numbers for wanted ratios."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import click

from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase, one_case, warnings_of
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.values import named, separated, told, value
from vstatics.core.errors import Problem, listed, of_file, quoted
from vstatics.core.readers.named.scalars import number
from vstatics.core.readers.reading import Reading
from vstatics.synthesis.cli.case_file import case_format, write_case, written_case
from vstatics.synthesis.cli.values import pair, wrong_use
from vstatics.synthesis.teeth.finding import FoundTeeth, NoTeethError, doubts_before, find_teeth
from vstatics.synthesis.teeth.limits import CLEARANCE, TeethLimits
from vstatics.synthesis.teeth.problem import own_ratios, teeth_problem
from vstatics.synthesis.teeth.solutions import TeethAnswer, asked_document, case_with_teeth
from vstatics.synthesis.teeth.tables import asked_grids, teeth_grids
from vstatics.synthesis.teeth.targets import TeethError


def _whole(text: str) -> int:
    read = told(number)(text)
    if read != int(read):
        raise ValueError(f"read {quoted(text)}, expected a whole number")
    return int(read)


def _several(texts: Sequence[str]) -> list[str]:
    """Return the values of an option that is given several times, without empty values."""
    words = separated(texts)
    if not all(words):
        raise ValueError(f"read {quoted(','.join(texts))}")
    return words


def _modules(texts: Sequence[str]) -> tuple[float, ...]:
    return tuple(map(told(number), _several(texts)))


def _planet_counts(texts: Sequence[str]) -> tuple[int, ...]:
    counts: list[int] = []
    for text in _several(texts):
        low, colon, high = text.partition(":")
        first = _whole(low)
        last = _whole(high) if colon else first
        if not first <= last < first + 100:
            raise ValueError(f"read {quoted(text)}, expected a number, or LOW:HIGH")
        counts += range(first, last + 1)
    return tuple(counts)


def _whole_pair(text: str) -> tuple[int, int]:
    low, high = pair(text, "17:60")
    if low != int(low) or high != int(high):
        raise ValueError("expected whole numbers of teeth, such as 17:60")
    return int(low), int(high)


@command
@click.option(
    "--ratios",
    multiple=True,
    metavar="NAME=I,...",
    callback=value(named("NAME=RATIO", number), "--ratios"),
    help="Wanted ratios of gears, such as 1=4.7,R=-3.3, or of gear sets, such as P1=-2.03. "
    "Repeatable.  [default: ratios of the gears of the case]",
)
@gathered(
    "limits",
    TeethLimits,
    click.option(
        "--range",
        "ranges",
        multiple=True,
        metavar="NAME=LOW:HIGH,...",
        callback=value(named("NAME=LOW:HIGH", _whole_pair), "--range"),
        help="Range of tooth numbers, or a fixed number, of all toothed gears with a name "
        "(sun=17:60), of one toothed gear (P2.ring=40:121), or of all others (all=17:90). Fewer "
        "than 17 teeth need a profile shift. Repeatable.  [default: 17 to 60, ring gears to 121, "
        "gear pairs to 100; always includes the numbers of the case]",
    ),
    click.option(
        "--planets",
        multiple=True,
        metavar="N,...",
        callback=value(_planet_counts, "--planets"),
        help="Allowed numbers of planets.  [default: as in the case, else 3 to 5]",
    ),
    click.option(
        "--clearance",
        metavar="C",
        callback=value(told(number), "--clearance"),
        default=f"{CLEARANCE:g}",
        show_default=True,
        help="Smallest distance between the tips of neighbouring planets, in modules.",
    ),
    click.option(
        "--centre",
        multiple=True,
        metavar="PAIR=A,...",
        callback=value(named("PAIR=MODULES", number), "--centre"),
        help="Centre distance of an external gear pair, in modules (half the sum of its teeth). "
        "Give this option for pairs on the same two shafts.",
    ),
    click.option(
        "--modules",
        multiple=True,
        metavar="M,...",
        callback=value(_modules, "--modules"),
        help="Modules to choose from, in mm, equal for all gears in mesh.  [default: one module "
        "for all]",
    ),
    click.option(
        "--largest-diameter",
        metavar="D",
        callback=value(told(number), "--largest-diameter"),
        help="Largest diameter of a gear set over its ring gear or planets, in mm; needs "
        "--modules.",
    ),
    click.option(
        "--shift",
        metavar="N",
        callback=value(_whole, "--shift"),
        default="0",
        show_default=True,
        help="Difference of centre distances that profile shifts can compensate, in teeth, up to "
        "2. Toothed gears can then have as few as 14 teeth.",
    ),
)
@click.option(
    "--error",
    type=click.Choice(["ln", "absolute"]),
    default="ln",
    show_default=True,
    help="Error of a ratio: |ln(i/target)|, or |i - target|. Its largest value is minimised.",
)
@click.option(
    "--dry-run", is_flag=True, help="Print only the toothed gears with unknown tooth numbers."
)
@written_case
@one_case
def teeth_command(
    request: OneCase,
    ratios: Mapping[str, float],
    limits: TeethLimits,
    error: TeethError,
    dry_run: bool,
    target: str | None,
) -> int:
    """Find tooth numbers of the gear sets of CASE for wanted ratios.

    All solutions can be built: the axes coincide, the planets can be assembled and do not
    touch, no toothed gear is undercut (14 to 16 teeth, if a range allows them, need a
    profile shift), and no tips interfere in a ring gear. The 20 best solutions are listed,
    by the largest error of the wanted ratios. They are proven to be the best, unless a
    warning appears.

    A mechanism without teeth is treated as a planetary gear set, or as a gear pair if it
    has two links. --dry-run lists the result. The CASE `-` is standard input.

    \b
    Examples:
      vstatics new truck.yaml --template belaz7516
      vstatics synth teeth truck.yaml --ratios 2=4,4=2.01,5=1.4925,R2=-5.12
      vstatics synth teeth gearbox.yaml --ratios P1=-2.03 \\
          --range sun=17:60,P2.ring=40:121 --planets 3,4 --write teeth.yaml

    \b
    Exit status 1: no solution exists, or the case has an error.
    Exit status 2: a named toothed gear does not exist.
    """
    to = request.destination()
    form = "" if target is None else case_format(target, [request.case], to.output)

    def calculate(reading: Reading) -> CaseAnswer:
        case, file = reading.case, file_name(request.case)
        with wrong_use(_OPTIONS):
            asked = ratios or own_ratios(case)
            if dry_run:
                problem = teeth_problem(case, asked, limits, error)
                notes = warnings_of("W801", doubts_before(problem), file)
                return CaseAnswer(lambda: asked_grids(problem), asked_document(problem), notes)
            try:
                with progress(None, "regions", quiet=request.telling.quiet) as advance:
                    result = find_teeth(case, asked, limits, error=error, advance=advance)
            except NoTeethError as failed:
                why = [problem.in_file(file) for problem in failed.problems]
                return CaseAnswer(list, TeethAnswer([]), why, failed=True)

        def write() -> bool:
            best = result.solutions[0]
            return target is None or write_case(
                case_with_teeth(case, result.problem, best), target, form
            )

        return CaseAnswer(
            lambda: teeth_grids(result),
            TeethAnswer(result.solutions),
            [*_notes(result, file)],
            write=write,
        )

    return request.answer(calculate, to)


_OPTIONS = (
    *("ratios", "range", "planets", "clearance", "centre"),
    *("modules", "largest-diameter", "shift"),
)


def _notes(result: FoundTeeth, file: str) -> Iterator[Problem]:
    yield from warnings_of("W802", result.doubts, file)
    if result.problem.unused:
        message = (
            f"no wanted ratio uses these, so they stay unchanged: {listed(result.problem.unused)}"
        )
        yield of_file("N801", file, message)
    if not result.is_proven:
        message = (
            "the search ended early: better solutions are possible, "
            f"but none has an error below {result.bound:.3g}"
        )
        yield from warnings_of("W803", [message], file)
