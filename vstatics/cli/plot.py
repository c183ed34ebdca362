"""`vstatics plot`: a picture of a case."""

from __future__ import annotations

import os

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, calculate_to
from vstatics.cli.exit_status import DONE, FAILED
from vstatics.errors import CaseError, ReadError, of_file
from vstatics.pictures import FORMATS, PICTURES, Format, render
from vstatics.pictures.style import Style
from vstatics.statics.results import Language


@click.command()
@arguments.case_argument
@click.option(
    "-k", "--kind", type=click.Choice(list(PICTURES)), required=True, help="What is drawn."
)
@arguments.required_output("SVG, PNG or PDF by the suffix; - is standard output, for SVG.")
@click.option("--gear", metavar="G", help="This gear only, by its name or number.")
@click.option("--dark", is_flag=True, help="Light on dark, for a screen.")
@arguments.settings
@arguments.language("axes and titles")
def plot(
    case: str,
    kind: str,
    output: str,
    gear: str | None,
    dark: bool,
    settings: CaseOptions,
    lang: Language,
) -> int:
    """Draw a picture of CASE: a deck, YAML or JSON; - is standard input.

    \b
    plan         speeds of all links over the output speed: the generalised
                 kinematic plan
    lever        speeds of each gear on the levers of the mechanisms
    flow         power of each gear in bands, losses, circulating power
    structure    mechanisms as boxes, links as wires, clutches and brakes
    stick        the stick diagram of a case made of elements
    efficiency   efficiency by gear, with the losses of each mechanism

    \b
    Examples:
      vstatics plot gearbox.yaml --kind plan -o plan.svg
      vstatics plot gearbox.yaml --kind lever --gear 2 -o second.pdf
      cat gearbox.dat | vstatics plot - --kind efficiency -o losses.png --dark

    Needs matplotlib: pip install "vstatics[plot]".

    \b
    Exit status: 0 done; 1 the case is in error, a gear is tied up, or there is
    nothing to draw; 2 wrong use.
    """
    form = _format(output)
    outcome = calculate_to(output, case, settings)
    if outcome.results is not None:
        try:
            chosen = None if gear is None else arguments.gear_number(outcome.results.case, gear)
            drawn = render(outcome.results, kind, form, Style(lang, dark), chosen)
        except CaseError as error:
            raise ReadError(of_file(outcome.file, one.message) for one in error.problems) from None
        with files.stream(output) as write:
            write(drawn)
    return FAILED if outcome.failed else DONE


def _format(output: str) -> Format:
    """The format of a file's suffix.

    Raises
    ------
    UsageError
        If it has none that can be drawn.
    """
    if output == files.STDIN:
        return "svg"
    suffix = os.path.splitext(output)[1].lower()  # noqa: PTH122
    for form in FORMATS:
        if suffix == f".{form}":
            return form
    known = " ".join(f".{form}" for form in FORMATS)
    raise click.UsageError(f"can't tell the format of {output}: expected a suffix of {known}")
