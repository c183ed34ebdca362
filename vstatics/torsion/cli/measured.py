"""Commands `vstatics torsion identify` and `damping`: parameters from a measured mode."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import click

from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import Command
from vstatics.core.cli.shared.values import above_0, from_0, named, value
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import chosen_gear, elastic_case, gear_of, located, slope_notes
from vstatics.torsion.cli.observed import Observed, observed


def _of_one_mode(command: Command) -> Command:
    """Add the options of a case, a gear and a mode to a command."""
    for option in (
        elastic_case,
        click.option(
            "--mode",
            type=click.IntRange(1),
            default=1,
            show_default=True,
            metavar="K",
            help="Of those that are not rigid, the lowest is 1.",
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


@click.command()
@_of_one_mode
@observed
def identify(request: OneCase, gear: str | None, mode: int, observation: Observed) -> int:
    """Correct the compliances of CASE by a measured frequency; - is standard input.

    All elastic devices of the gear get their compliance times (calculated/W)^2, in their
    own twists; so the mode has the frequency W, and all shapes stay. With a decrement D
    each gets the damping D/(pi E W) with its corrected E, so that the mode has it, too.
    Both follow from a record, or from its extremes, where these are given in their place.

    \b
    Examples:
      vstatics torsion identify box.yaml --gear 3 --omega 27.4
      vstatics torsion identify box.yaml --gear 3 --omega 27.4 --decrement 1.06
      vstatics torsion identify box.yaml --peaks 160,-51,109,-13 --period .23
      vstatics torsion identify box.yaml --record test.csv --column shaft

    \b
    Exit status: 0 done; 1 the case or the record is in error, or the gear has no
    mode; 2 wrong use.
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


@click.command()
@_of_one_mode
@click.option(
    "--decrements",
    required=True,
    callback=value(_decrements),
    metavar="DEVICE=D,...",
    help="Logarithmic decrements of elastic devices; a name with commas in double quotes.",
)
@click.option(
    "--omega",
    type=float,
    callback=value(above_0),
    metavar="W",
    help="Frequency at which the dampings hold, in rad/s; that of the mode when not given.",
)
def damping(
    request: OneCase,
    gear: str | None,
    mode: int,
    decrements: Mapping[str, float],
    omega: float | None,
) -> int:
    """Calculate dampings of CASE from decrements of its devices; - is standard input.

    A damping is D/(pi E W), with the compliance E of the device. The decrement of the mode
    is the sum of those that are given, by their shares in its elastic energy.

    \b
    Examples:
      vstatics torsion damping box.yaml --gear 1 --decrements shaft=.03,damper=.2
      vstatics torsion damping box.yaml --gear 1 --decrements shaft=.1 --omega 83

    \b
    Exit status: 0 done; 1 the case is in error, or the gear has no mode;
    2 wrong use.
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
    """Answer about a gear; unknown modes or devices are reported as wrong use."""

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
