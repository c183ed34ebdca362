"""Command `vstatics torsion simplify`: a scheme with fewer masses and equal low frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.formats import TABLES, FormatChoice, OutputOptions, TextStyle
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase, warnings_of
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import FILE, separated, value
from vstatics.core.errors import ReadError, spoken
from vstatics.core.model.parts import damping
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Mechanism, ShiftElement, Transmission
from vstatics.core.readers.reading import Reading
from vstatics.core.writers.saving import case_data
from vstatics.torsion.cli.case import chosen_gear, gear_of, located, slope_notes, static_torque

if TYPE_CHECKING:
    from vstatics.torsion.reduction.scheme import TorsionScheme
    from vstatics.torsion.reduction.simplification import Simplification, SimplificationRule

RULES = ("partial", "r", "b", "u")
FORMS = [form for form in TABLES if form != "xlsx"]
"""Output formats of the steps of a simplification."""


def _request_for_steps(
    case: str,
    form: str,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
    static_torque: float | None,
) -> OneCase:
    return OneCase(
        case,
        OutputOptions(FORMS, form, None, TextStyle()),
        input_format,
        telling,
        coast,
        static_torque,
    )


def _names(text: str) -> list[str]:
    return separated([text])


class Reducing(NamedTuple):
    """Rule of a simplification, and the masses to remove or merge first."""

    rule: SimplificationRule | None
    remove: Sequence[str] | None
    merge: Sequence[str] | None

    def simplified(self, scheme: TorsionScheme, frequencies: int) -> Simplification:
        """Simplify a scheme down to a number of natural frequencies."""
        from vstatics.torsion.reduction.merging import simplify_merging
        from vstatics.torsion.reduction.simplification import simplify

        if self.merge:
            remove = self.remove or ()
            return simplify_merging(scheme, frequencies, self.rule, remove, self.merge)
        return simplify(scheme, frequencies, self.rule, self.remove or ())


@command
@chosen_gear
@click.option(
    "--links",
    "frequencies",
    type=click.IntRange(1),
    required=True,
    metavar="N",
    help="Number N of natural frequencies to keep. A simplified chain has N + 1 masses.",
)
@gathered(
    "reducing",
    Reducing,
    click.option(
        "--rule",
        type=click.Choice(RULES),
        help="Rule of removal. partial: removes partial systems of one and two masses, in chains "
        "only. r, b, u: remove partial systems of one mass. The neighbours receive its inertia in "
        "proportion to the stiffness K (r), to K^2 (b), or not at all (u).  [default: partial for "
        "a chain, else r]",
    ),
    click.option(
        "--remove",
        metavar="A,B",
        callback=value(_names),
        help="Masses to remove first, in this order.",
    ),
    click.option(
        "--merge",
        metavar="A+B,C+D",
        callback=value(_names),
        help="Pairs of masses to merge after --remove, such as masses of equal branches.",
    ),
)
@gathered(
    "request",
    _request_for_steps,
    click.argument("case", type=FILE),
    click.option(
        "-f",
        "--format",
        "form",
        type=FormatChoice(FORMS),
        default="text",
        show_default=True,
        help="Format of the report on the removals.",
    ),
    click.option(
        "-o",
        "--output",
        type=FILE,
        metavar="FILE",
        help="File for the simplified system as a case, YAML or JSON.",
    ),
    arguments.input_format,
    arguments.coast,
    arguments.telling,
    static_torque,
)
def simplify_command(
    request: OneCase,
    gear: str | None,
    frequencies: int,
    reducing: Reducing,
    output: str | None,
) -> int:
    """Simplify the torsional system of a gear of CASE, reduced to the input.

    The partial system with the highest frequency is removed repeatedly. The lowest natural
    frequencies hardly change. A warning lists remaining frequencies that are above half of
    a removed partial frequency. The CASE `-` is standard input.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion simplify car.yaml --gear 1 --links 3
      vstatics torsion simplify car.yaml --gear 1 --links 3 -o simple.yaml

    Exit status 1: the case has an error, or the system cannot be simplified.
    """
    written = _format_of(output, request.case)

    def calculate(reading: Reading) -> CaseAnswer:
        from vstatics.torsion.answers import SimplificationAnswer
        from vstatics.torsion.reduction.reduced_scheme import gear_scheme
        from vstatics.torsion.reduction.scheme import scheme_case
        from vstatics.torsion.reduction.tables import simplification_grids

        case = reading.case
        chosen = gear_of(case, gear)
        scheme = gear_scheme(case, chosen)
        if isinstance(scheme, str):
            raise ReadError(located(reading, [(chosen.name, scheme)], "E517"))
        simplification = reducing.simplified(scheme, frequencies)

        def write() -> bool:
            if output is not None:
                ends = [
                    case.link_name(end)
                    for end in (case.gear_input(chosen), case.gear_output(chosen))
                ]
                simplified = scheme_case(simplification.scheme, case.name, ends, chosen.name)
                files.write_data(case_data(simplified, written)[0], output)
            return True

        notes = slope_notes(reading, [chosen.name])
        warnings = [doubt.message for doubt in simplification.warnings]
        return CaseAnswer(
            lambda: simplification_grids(simplification),
            SimplificationAnswer(
                case.name, chosen.name, simplification.rule, simplification.steps, warnings
            ),
            [
                *warnings_of("W502", [*warnings, *_lost_dampings(case)], file_name(request.case)),
                *notes,
            ],
            write=write,
        )

    return request.answer(calculate, extra="torsion")


def _format_of(output: str | None, case: str) -> str:
    if output is None:
        return ""
    files.spare([case], output)
    form = readers.format_of_name(output)
    if form not in ("yaml", "json"):
        raise click.UsageError(f"{output}: expected a case in YAML or JSON, .yaml or .json")
    return form


def _lost_dampings(case: Transmission) -> list[str]:
    """Return a warning about loss factors, which the simplified system omits."""
    devices: list[Spring | Mechanism | ShiftElement]
    devices = [*case.springs, *case.mechanisms, *case.shift_elements]
    names = [device.name for device in devices if damping(device.damping).loss_factor]
    if not names:
        return []
    return [
        f"the loss factor of {spoken(names)} is omitted: a simplified system has only viscous "
        "damping"
    ]
