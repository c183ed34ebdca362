"""`vstatics torsion identify` and `damping`: what follows from a mode that was measured."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, TypeVar

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import formats
from vstatics.cli.frame.cases import gear_number
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import OutputOptions
from vstatics.cli.frame.one_case import one_text, problems_of, show
from vstatics.cli.frame.problems import Telling
from vstatics.cli.frame.values import named_values
from vstatics.cli.torsion.case import located, needs_scipy
from vstatics.errors import CaseError, ReadError
from vstatics.model.transmission import Gear
from vstatics.readers.reading import Reading

Command = TypeVar("Command", bound=Callable[..., Any])


def _above_0(context: click.Context, parameter: click.Parameter, value: float | None) -> Any:
    if value is not None and not 0 < value < math.inf:
        message = f"read {value:g}, expected a number above 0"
        raise click.BadParameter(message, context, parameter)
    return value


def _from_0(context: click.Context, parameter: click.Parameter, value: float | None) -> Any:
    if value is not None and not 0 <= value < math.inf:
        message = f"read {value:g}, expected a number of 0 or more"
        raise click.BadParameter(message, context, parameter)
    return value


def _decrements(
    context: click.Context, parameter: click.Parameter, value: str
) -> Mapping[str, float]:
    """Decrements by devices, from `shaft=.03,damper=.2`."""
    try:
        items = named_values(value)
    except ValueError as error:
        raise click.BadParameter(str(error), context, parameter) from None
    found: dict[str, float] = {}
    for name, text in items:
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not 0 <= number < math.inf:
            message = f"{name}: read {text!r}, expected a number of 0 or more"
            raise click.BadParameter(message, context, parameter)
        if name in found:
            raise click.BadParameter(f"{name} is given twice", context, parameter)
        found[name] = number
    return found


def _of_one_mode(command: Command) -> Command:
    """The case, the gear and the mode, and all that other commands have."""
    for option in (
        arguments.telling,
        arguments.coast,
        arguments.input_format,
        formats.options(*formats.TABLES),
        click.option(
            "--mode",
            type=click.IntRange(1),
            default=1,
            show_default=True,
            metavar="K",
            help="Of those that are not rigid, the lowest is 1.",
        ),
        click.option("--gear", required=True, metavar="G", help="The gear, by its name or number."),
        click.argument("case", type=click.Path()),
    ):
        command = option(command)
    return command


@click.command()
@_of_one_mode
@click.option(
    "--omega",
    type=float,
    required=True,
    callback=_above_0,
    metavar="W",
    help="Frequency of the mode that was measured, in rad/s.",
)
@click.option(
    "--decrement",
    type=float,
    callback=_from_0,
    metavar="D",
    help="Its logarithmic decrement, for the dampings of all devices.",
)
def identify(
    case: str,
    gear: str,
    mode: int,
    omega: float,
    decrement: float | None,
    wanted: OutputOptions,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
) -> int:
    """Correct the compliances of CASE by a measured frequency; - is standard input.

    All elastic devices of the gear get their compliance times (calculated/W)^2, in their
    own twists; so the mode has the frequency W, and all shapes stay. With a decrement D
    each gets the damping D/(pi E W) with its corrected E, so that the mode has it, too.

    \b
    Examples:
      vstatics torsion identify box.yaml --gear 3 --omega 27.4
      vstatics torsion identify box.yaml --gear 3 --omega 27.4 --decrement 1.06

    \b
    Exit status: 0 done; 1 the case is in error, or the gear is tied up or has
    no mode; 2 wrong use.
    """
    to = one_text(wanted, [case])
    needs_scipy()
    from vstatics.torsion.documents import identified_document
    from vstatics.torsion.vibration.grids import identified_grids
    from vstatics.torsion.vibration.measured import identify as identified

    reading = arguments.read_one(case, input_format, telling)
    chosen = _gear(reading, gear)
    with _told(reading, chosen):
        made = identified(reading.case, chosen.name, omega, decrement, mode, coast=coast)
    name = reading.case.name
    show(
        case,
        to,
        name,
        lambda: identified_grids(omega, made),
        lambda: identified_document(name, chosen.name, mode, omega, made),
    )
    return FAILED if telling.fails(reading.warnings) else DONE


@click.command()
@_of_one_mode
@click.option(
    "--decrements",
    required=True,
    callback=_decrements,
    metavar="DEVICE=D,...",
    help="Logarithmic decrements of elastic devices; a name with commas in double quotes.",
)
@click.option(
    "--omega",
    type=float,
    callback=_above_0,
    metavar="W",
    help="Frequency at which the dampings hold, in rad/s; that of the mode when not given.",
)
def damping(
    case: str,
    gear: str,
    mode: int,
    decrements: Mapping[str, float],
    omega: float | None,
    wanted: OutputOptions,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
) -> int:
    """Calculate dampings of CASE from decrements of its devices; - is standard input.

    A damping is D/(pi E W), with the compliance E of the device. The decrement of the mode
    is the sum of those that are given, by their shares in its elastic energy.

    \b
    Examples:
      vstatics torsion damping box.yaml --gear 1 --decrements shaft=.03,damper=.2
      vstatics torsion damping box.yaml --gear 1 --decrements shaft=.1 --omega 83

    \b
    Exit status: 0 done; 1 the case is in error, or the gear is tied up or has
    no mode; 2 wrong use.
    """
    to = one_text(wanted, [case])
    needs_scipy()
    from vstatics.torsion.documents import damped_document
    from vstatics.torsion.vibration.grids import damped_grids
    from vstatics.torsion.vibration.measured import damping as damped

    reading = arguments.read_one(case, input_format, telling)
    chosen = _gear(reading, gear)
    with _told(reading, chosen):
        made = damped(reading.case, chosen.name, decrements, omega, mode, coast=coast)
    name = reading.case.name
    show(
        case,
        to,
        name,
        lambda: damped_grids(decrements, made),
        lambda: damped_document(name, chosen.name, mode, made),
    )
    return FAILED if telling.fails(reading.warnings) else DONE


def _gear(reading: Reading, asked: str) -> Gear:
    return reading.case.gears[gear_number(reading.case, asked) - 1]


@contextmanager
def _told(reading: Reading, gear: Gear) -> Iterator[None]:
    """What is wrong with the gear at its place; a mode or device that is not there: wrong use."""
    try:
        yield
    except CaseError as error:
        if error.problems[0].path[:1] != ("gears",):
            with problems_of(reading):
                raise
        faults = [(gear.name, "error", one.message) for one in error.problems]
        raise ReadError(list(located(reading, faults))) from None
    except ValueError as error:
        raise click.UsageError(str(error)) from None
