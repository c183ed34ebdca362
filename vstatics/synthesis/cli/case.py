"""`vstatics synth case`: write a scheme as a case."""

from __future__ import annotations

from collections.abc import Sequence

import click

from vstatics.core import readers
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.options import command
from vstatics.core.cli.shared.values import FILE, separated, value, wrong_value
from vstatics.core.errors import CaseError, Problem, quoted, spoken
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.readers.named.arithmetic import calculated
from vstatics.core.suggestions import nearest
from vstatics.synthesis.cli.case_file import case_format, write_case
from vstatics.synthesis.gears.case_of_scheme import MOST_OF_SCHEME, NEUTRAL, scheme_case
from vstatics.synthesis.gears.names import set_name
from vstatics.synthesis.structures.scheme import SetScheme, link_name

FIRST, STEP = -2.0, -0.1
"""Default basic ratio of the first gear set, and difference to the next set, so that no gears are
equal. [-]
"""


@command
@click.argument("scheme", metavar="CODE", callback=value(SetScheme.of_code))
@click.option(
    "--input", "input_link", required=True, metavar="LINK", help="Input link, such as L0."
)
@click.option(
    "--output", "output_link", required=True, metavar="LINK", help="Output link, such as L4."
)
@click.option(
    "--ratios",
    multiple=True,
    metavar="R,..",
    help="Basic ratio of each gear set in turn (sun to ring, carrier held), or as P1=R. "
    "Repeatable.  [default: chosen by the program]",
)
@click.option(
    "-f",
    "--format",
    "form",
    type=click.Choice(readers.FORMATS),
    help="Format of the case.  [default: by the suffix of -o, else yaml]",
)
@click.option(
    "-o",
    "--write",
    "target",
    type=FILE,
    metavar="FILE",
    default=STDOUT,
    help="Output file, written completely or not at all. An existing file is replaced.",
)
def case_command(
    scheme: SetScheme,
    input_link: str,
    output_link: str,
    ratios: tuple[str, ...],
    form: str | None,
    target: str,
) -> int:
    """Write the structure CODE as a case: gear sets, shift elements and gears.

    CODE is from `vstatics synth structures`. Link 0 is L0 in the case, and so on. Each
    link except input and output gets a brake, and a clutch connects input and output. If
    gears engage two or more shift elements, clutches also connect the input to all other
    links, unless this gives more than 60 combinations. The gears are the combinations that
    give a ratio, one for each ratio. Input and output have inertias of 1 kg*m^2 instead of
    engine and load. A deck has no inertias.

    \b
    Examples:
      vstatics synth structures --sets 2 --links 4 | head -3
      vstatics synth case 0-1-2-0-3-1 --input L0 --output L1 \\
          --ratios -2,-2.5 -o box.yaml
      vstatics run box.yaml

    Exit status 1: the format cannot keep all data of the case.
    """
    form = form or ("yaml" if is_stream(target) else case_format(target, []))
    with wrong_value("--ratios"):
        given = _ratios(scheme, ratios)
    with wrong_value("--input"):
        first = _link(scheme, input_link)
    with wrong_value("--output"):
        last = _link(scheme, output_link)
        if first == last:
            raise ValueError(f"read {link_name(first)}, which is the input; expected another link")
    try:
        with wrong_value("CODE"):
            case_of_code = scheme_case(scheme, first, last, given)
    except CaseError as error:
        raise click.BadParameter(_messages_by_set(error.problems), param_hint="--ratios") from None
    if locked := scheme.locked_sets:
        links = {link for number in locked for link in scheme.sets[number - 1]}
        sets = f"sets {spoken(map(str, locked))} have {len(links)} links only"
        files.say(f"warning: {sets}, so they turn as one body whatever their ratios are")
    if not any(gear.engaged for gear in case_of_code.gears):
        files.say(f"warning: no combination of its elements gives a gear but {NEUTRAL}, neutral")
    elif len(case_of_code.gears) >= MOST_OF_SCHEME:
        files.say(f"there may be more gears than the {MOST_OF_SCHEME} of the case")
    if not ratios:
        some = spoken(f"{ratio:g}" for ratio in given)
        files.show([Problem("N002", f"no ratios are given, so the gear sets have {some}")])
    if form == "deck":  # a deck has no inertias, and the inertias are only placeholders
        case_of_code = case_of_code.replace(inertias={}, description="")
        files.say("a deck holds no inertias: those of input and output are left out")
    return DONE if write_case(case_of_code, target, form) else FAILED


def _link(scheme: SetScheme, given: str) -> int:
    """Return the number of a link from the name or the number in the code."""
    names = [link_name(link) for link in range(scheme.links)]
    word = given.strip()
    for link, name in enumerate(names):
        if word.upper() == name or word == str(link):
            return link
    there = f"the structure has {names[0]} to {names[-1]}"
    raise ValueError(f"read {quoted(given)}, but {there}")


def _ratios(scheme: SetScheme, given: Sequence[str]) -> list[float]:
    names = [set_name(number) for number in range(1, len(scheme.sets) + 1)]
    if not given:
        return [round(FIRST + STEP * number, 1) for number in range(len(names))]
    by_name: dict[str, float] = {}
    words = separated(given)
    for number, word in enumerate(words):
        name, equals, text = (part.strip() for part in word.rpartition("="))
        if not equals:
            if number >= len(names):
                raise ValueError(f"read {len(words)} ratios, expected {_expected(names)}")
            name = names[number]
        if name not in names:
            hint = nearest(name, names) or f"; expected {spoken(names, 'or')}"
            raise ValueError(f"read a ratio of {quoted(name)}, but there is no such set{hint}")
        if name in by_name:
            raise ValueError(f"{name} has two ratios, expected one")
        by_name[name] = _number(text)
    if missing := [name for name in names if name not in by_name]:
        raise ValueError(f"{spoken(missing)} without a ratio, expected {_expected(names)}")
    return [by_name[name] for name in names]


def _number(text: str) -> float:
    try:
        number = calculated(text)
    except ValueError as error:
        raise ValueError(f"read {quoted(text)}: {error}") from None
    if number.behind:
        raise ValueError(f"read {quoted(text)}, expected a number such as -2.5 or -73/35")
    return number.value


def _expected(names: Sequence[str]) -> str:
    return f"{len(names)}, one for each set" if len(names) > 1 else "one"


def _messages_by_set(problems: Sequence[Problem]) -> str:
    parts = []
    for problem in problems:
        numbers = [part for part in problem.path if isinstance(part, int)]
        where = f"{set_name(numbers[0])}: " if numbers else ""
        parts.append(where + problem.message)
    return "; ".join(parts)
