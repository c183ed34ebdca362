"""`vstatics torsion simplify`: a scheme with fewer masses and the same low frequencies."""

from __future__ import annotations

import csv

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import files
from vstatics.cli.frame.cases import gear_number
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import TABLES, Destination, TextStyle
from vstatics.cli.frame.one_case import file_name, problems_of, show, tell
from vstatics.cli.frame.problems import Telling
from vstatics.cli.torsion.case import coasting, located, needs_scipy
from vstatics.errors import Problem, ReadError, of_file, spoken
from vstatics.model.parts import damping
from vstatics.model.transmission import Transmission

RULES = ("partial", "r", "b", "u")
FORMS = [form for form in TABLES if form != "xlsx"]
"""Of the steps, which are printed."""


@click.command()
@click.argument("case", type=click.Path())
@click.option("--gear", required=True, metavar="G", help="The gear, by its name or number.")
@click.option(
    "--links",
    "frequencies",
    type=click.IntRange(1),
    required=True,
    metavar="N",
    help="How many natural frequencies remain.",
)
@click.option(
    "--rule",
    type=click.Choice(RULES),
    help="partial: by systems of one and two masses, of a chain; r, b, u: by systems of one "
    "mass, whose inertia is shared by K, by K^2, or not at all. Else partial for a chain, r "
    "for any other.",
)
@click.option(
    "--remove",
    metavar="A,B",
    help="These masses first, in this order; a name with commas in double quotes.",
)
@click.option(
    "-f",
    "--format",
    "form",
    type=click.Choice(FORMS),
    default="text",
    show_default=True,
    help="Format of the steps.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(),
    metavar="FILE",
    help="Write the scheme as a case: YAML or JSON.",
)
@arguments.input_format
@arguments.coast
@arguments.telling
def simplify(
    case: str,
    gear: str,
    frequencies: int,
    rule: str | None,
    remove: str | None,
    form: str,
    output: str | None,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
) -> int:
    """Simplify the scheme of a gear of CASE, reduced to the input; - is standard input.

    Step by step the partial system with the highest frequency is taken out, so that the
    lowest frequencies hardly change. It warns where a kept one is above half of a partial
    frequency.

    \b
    Examples:
      vstatics torsion simplify box.yaml --gear 1 --links 3
      vstatics torsion simplify box.yaml --gear 1 --links 3 -o simple.yaml

    \b
    Exit status: 0 done; 1 the case is in error or has no such scheme;
    2 wrong use.
    """
    written = _format_of(output, case)
    needs_scipy()
    from vstatics.torsion.documents import simplification_document
    from vstatics.torsion.reduction.grids import simplification_grids
    from vstatics.torsion.reduction.reduced_scheme import gear_scheme
    from vstatics.torsion.reduction.scheme import scheme_case
    from vstatics.torsion.reduction.simplification import simplify as simplified

    reading = coasting(arguments.read_one(case, input_format, telling), coast)
    own = reading.case
    chosen = own.gears[gear_number(own, gear) - 1]
    scheme = gear_scheme(own, chosen)
    if isinstance(scheme, str):
        raise ReadError(list(located(reading, [(chosen.name, "error", scheme)])))
    removed = [] if remove is None else _names(remove)
    with problems_of(reading):
        found = simplified(scheme, frequencies, rule, removed)  # type: ignore[arg-type] # a choice
    problems = [*found.warnings, *_lost(own)]
    file = file_name(case)
    doubts = [of_file(file, one.message)._replace(severity="warning") for one in problems]
    tell(doubts, telling, case)
    if output is not None:
        ends = [own.link_name(end) for end in (own.gear_input(chosen), own.gear_output(chosen))]
        made = scheme_case(found.scheme, own.name, ends, chosen.name)
        files.write_output(_text(made, written), output)
    show(
        case,
        Destination(form, None, TextStyle()),
        own.name,
        lambda: simplification_grids(found),
        lambda: simplification_document(own.name, chosen.name, found),
    )
    return FAILED if telling.fails([*reading.warnings, *problems]) else DONE


def _format_of(output: str | None, case: str) -> str:
    """What the scheme is written in."""
    if output is None:
        return ""
    files.spare([case], output)
    form = readers.format_of_name(output)
    if form not in ("yaml", "json"):
        raise click.UsageError(f"{output}: expected a case in YAML or JSON, .yaml or .json")
    return form


def _names(written: str) -> list[str]:
    """Names with commas between them; one that has commas stands in double quotes."""
    [row] = csv.reader([written.replace("\n", " ")], skipinitialspace=True) if written else [[""]]
    return [name.strip() for name in row]


def _lost(case: Transmission) -> list[Problem]:
    """What a scheme does not have: its dampings are viscous."""
    names = [one.name for one in case.springs if damping(one.damping).loss_factor]
    names += [one.name for one in case.mechanisms if damping(one.damping).loss_factor]
    names += [one.name for one in case.shift_elements if damping(one.damping).loss_factor]
    if not names:
        return []
    message = f"the loss factor of {spoken(names)} is left out: a scheme has viscous damping only"
    return [Problem(message, severity="warning")]


def _text(case: Transmission, form: str) -> str:
    from vstatics.writers import named

    return named.write_yaml(case) if form == "yaml" else named.write_json(case)
