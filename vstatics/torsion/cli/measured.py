"""Commands `vstatics torsion identify` and `damping`: parameters from a measured mode."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import click

from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import Command, command
from vstatics.core.cli.shared.values import above_0, from_0, named, value
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import chosen_gear, elastic_case, gear_of, located, slope_notes
from vstatics.torsion.cli.observed import Observed, observed


def _of_one_mode(command: Command) -> Command:
    """Add options to a command that choose a case, a gear and a mode."""
    for option in (
        elastic_case,
        click.option(
            "--mode",
            type=click.IntRange(1),
            default=1,
            show_default=True,
            metavar="K",
            help="Number of the elastic mode, from 1 for the lowest.",
        ),
        chosen_gear,
    ):
        command = option(command)
    return command


def _decrement(text: str) -> float:
    try:
        return from_0(float(text))
    except ValueError:
        raise ValueError("expected a number of 0 or more") from None


def _decrements(text: str) -> Mapping[str, float]:
    return named("NAME=NUMBER", _decrement, repr)([text])


@command
@_of_one_mode
@observed
def identify_command(request: OneCase, gear: str | None, mode: int, observation: Observed) -> int:
    """Correct the compliances of CASE by a measured natural frequency.

    The compliances of all elastic components of the gear are multiplied by
    (calculated/W)^2. The mode then has the measured frequency W. Mode shapes do not change.
    With a logarithmic decrement D, each component also gets the damping D/(pi E W), with
    its corrected compliance E. Instead of the two numbers you can give the record of a free
    vibration, or its extreme values. The CASE `-` is standard input.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion identify car.yaml --gear 3 --omega 27.4
      vstatics torsion identify car.yaml --gear 3 --omega 27.4 --decrement 1.06
      vstatics torsion identify car.yaml --gear 3 --peaks 160,-51,109,-13,70 \\
          --period 0.23

    \b
    Exit status 1: the case or the record has an error, or the gear has no such
    mode.
    """
    to = request.destination(*filter(None, [observation.record]))

    def calculate(case: Transmission, chosen: str) -> CaseAnswer:
        from vstatics.torsion.answers import IdentificationAnswer
        from vstatics.torsion.vibration.measured import identify as identify_mode
        from vstatics.torsion.vibration.tables import decay_grid, identified_grids

        omega, decrement, decay = observation.measured()
        identified = identify_mode(case, chosen, omega, decrement, mode)
        answer = IdentificationAnswer(case.name, chosen, mode, omega, identified, decrement)
        if decay is None:
            return CaseAnswer(lambda: identified_grids(omega, identified), answer)
        answer = answer._replace(mean_line=decay.mean_line, amplitudes=decay.amplitudes)
        return CaseAnswer(lambda: [decay_grid(decay), *identified_grids(omega, identified)], answer)

    return _answer(request, gear, calculate, to)


@command
@_of_one_mode
@click.option(
    "--decrements",
    required=True,
    callback=value(_decrements),
    metavar="NAME=D,...",
    help="Logarithmic decrements of elastic components. Repeatable.",
)
@click.option(
    "--omega",
    type=float,
    callback=value(above_0),
    metavar="W",
    help="Frequency for which the dampings are calculated, in rad/s.  [default: frequency of the "
    "mode]",
)
def damping_command(
    request: OneCase,
    gear: str | None,
    mode: int,
    decrements: Mapping[str, float],
    omega: float | None,
) -> int:
    """Calculate the damping of CASE from decrements of its components.

    The damping of a component is D/(pi E W), with its logarithmic decrement D, its
    compliance E and the frequency W. The decrement of the mode is the sum of the given
    decrements, weighted by their shares in its elastic energy. The CASE `-` is standard input.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion damping car.yaml --gear 1 \\
          --decrements propshaft=0.03,damper=0.2
      vstatics torsion damping car.yaml --gear 1 --decrements tyres=0.4 --omega 83

    Exit status 1: the case has an error, or the gear has no such mode.
    """

    def calculate(case: Transmission, chosen: str) -> CaseAnswer:
        from vstatics.torsion.answers import DampingAnswer
        from vstatics.torsion.vibration.measured import damping as damping_of
        from vstatics.torsion.vibration.tables import damped_grids

        damped = damping_of(case, chosen, decrements, omega, mode)
        return CaseAnswer(
            lambda: damped_grids(decrements, damped),
            DampingAnswer(case.name, chosen, mode, damped),
        )

    return _answer(request, gear, calculate)


def _answer(
    request: OneCase,
    gear: str | None,
    of_gear: Callable[[Transmission, str], CaseAnswer],
    to: Destination | None = None,
) -> int:
    """Print an answer about a gear; an unknown mode or component is a usage error."""

    def calculate(reading: Reading) -> CaseAnswer:
        case = reading.case
        chosen = gear_of(case, gear).name
        try:
            answer = of_gear(case, chosen)
            return answer._replace(problems=slope_notes(reading, [chosen]))
        except CaseError as error:
            if error.problems[0].path[:1] != ("gears",):
                raise
            faults = [(chosen, problem.message) for problem in error.problems]
            raise ReadError(located(reading, faults, "E518")) from None
        except ValueError as error:
            raise click.UsageError(str(error)) from None

    return request.answer(calculate, to, "torsion")
