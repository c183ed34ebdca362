"""What the commands of `vstatics torsion` share: gears, links and messages of a case."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.one_case import OneCase
from vstatics.core.cli.shared.options import Command, Option, gathered
from vstatics.core.cli.shared.values import value, wrong_value
from vstatics.core.errors import Problem, listed
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.readers.reading import Reading

if TYPE_CHECKING:
    from vstatics.torsion.system.working_points import WorkingGear


def _torque(text: str) -> float:
    from vstatics.core.readers.named.si_units import measured

    try:
        return measured(text, "si_torque")
    except ValueError as error:
        raise ValueError(f"read {text!r}, {error}") from None


static_torque = click.option(
    "--torque",
    "static_torque",
    callback=value(_torque),
    metavar="T",
    help="Torque at the input, in N*m, under which springs with `points` have their slopes; "
    "that of the load of CASE when not given, else 0. A given speed ratio of a converter decides.",
)


def _ratios(texts: Sequence[str]) -> dict[str, float]:
    """Speed ratios by names of converters."""
    found = {}
    for text in texts:
        name, _, ratio = text.rpartition("=")
        try:
            found[name] = float(ratio)
        except ValueError:
            found[name] = math.nan
        if not name or not math.isfinite(found[name]):
            raise ValueError(f"read {text!r}, expected the name of a converter and a number: TC=.6")
    return found


_speed_ratios = click.option(
    "--speed-ratio",
    "ratios",
    multiple=True,
    callback=value(_ratios),
    metavar="TC=I",
    help="Speed ratio of a converter, turbine by pump, in place of that of the gear; when neither "
    "gives it that at which it takes the torque of the load.",
)


CASE_OPTIONS = (
    click.argument("case", type=click.Path()),
    formats.options(*formats.TABLES),
    arguments.input_format,
    arguments.coast,
    arguments.telling,
)
elastic_case = gathered("one", OneCase, *CASE_OPTIONS, static_torque)
"""The case and the options of a command of this group; the command gets `one`."""


def gear_names(case: Transmission, asked: Sequence[str]) -> list[str]:
    """The gears that are asked for, each once; all where none is.

    Raises
    ------
    BadParameter
        If there is no such gear.
    """
    return [case.gears[index].name for index in arguments.gear_indices(case, asked)]


class WorkingAsked(NamedTuple):
    """Gears that are asked for, and speed ratios of their converters."""

    gears: tuple[str, ...]
    ratios: Mapping[str, float]

    def of(self, case: Transmission) -> list[WorkingGear]:
        """These gears of a case, with its converters at these ratios."""
        from vstatics.torsion.system.working_points import working_gear

        gears = [case.gears[index] for index in arguments.gear_indices(case, self.gears)]
        with wrong_value("--speed-ratio"):
            return [working_gear(case, gear, self.ratios) for gear in gears]


def working_options(*between: Option) -> Callable[[Command], Command]:
    """Options of such gears, with others between them; the command gets `asked`."""
    return gathered("asked", WorkingAsked, arguments.some_gears, *between, _speed_ratios)


chosen_gear = click.option(
    "--gear",
    metavar="G",
    help="The gear, by its name, or the third by '#3'; needed where the case has several.",
)


def gear_of(case: Transmission, asked: str | None) -> Gear:
    """The gear that is asked for, or the only one.

    Raises
    ------
    UsageError
        If there is none of this name or number, or none of several is asked for.
    """
    if asked is not None:
        return case.gears[arguments.gear_number(case, asked) - 1]
    if len(case.gears) > 1:
        names = listed([gear.name for gear in case.gears])
        raise click.UsageError(f"Missing option '--gear': gears are {names}")
    return case.gears[0]


def link_name(case: Transmission, asked: str, option: str) -> str:
    """The name of the link that an option asks for.

    Raises
    ------
    BadParameter
        If there is none; it tells the nearest name.
    """
    with wrong_value(option):
        return case.link_name(case.link_number(asked))


def located(
    reading: Reading, texts_by_gear: Iterable[tuple[str, str]], identity: str
) -> list[Problem]:
    """Messages as problems at the places of their gears.

    Parameters
    ----------
    texts_by_gear : iterable of tuple
        The name of a gear, and a text; an empty one says nothing.
    identity : str
        Of all of them.
    """
    numbers = {gear.name: number for number, gear in enumerate(reading.case.gears, 1)}
    found = []
    for name, message in texts_by_gear:
        if message:
            place = reading.locate(Problem(identity, "", ("gears", numbers[name]))).place
            found.append(Problem(identity, f"gear {name}: {message}", (), place))
    return found


def slope_notes(reading: Reading, gears: Iterable[str]) -> list[Problem]:
    """Slopes of springs with points in gears, by their names, with doubts about their load."""
    from vstatics.torsion.system.working_points import mean_gear

    by_name = {gear.name: gear for gear in reading.case.gears}
    return _slope_notes(reading, [mean_gear(reading.case, by_name[name]) for name in gears])


def working_notes(reading: Reading, gears: Iterable[WorkingGear]) -> list[Problem]:
    """Slopes of springs in gears at their working points, and friction that is left out there."""
    return [*_slope_notes(reading, list(gears)), *_friction_notes(reading)]


def _friction_notes(reading: Reading) -> Iterator[Problem]:
    for number, spring in enumerate(reading.case.springs, 1):
        if spring.friction:
            text = (
                f"the dry friction of {spring.name}, {spring.friction:g} N*m, is left out of "
                "linear vibration; `simulate` takes it, or give a `damping` that loses as much"
            )
            yield reading.locate(Problem("N507", text, ("springs", number, "friction")))


def _slope_notes(reading: Reading, gears: Sequence[WorkingGear]) -> list[Problem]:
    from vstatics.torsion.system.slopes import spring_slopes

    doubts = ((working.gear.name, text) for working in gears for text in working.doubts)
    notes = [
        reading.locate(
            Problem("N506", f"gear {gear.name}: {one}", ("springs", one.number, "points"))
        )
        for case, gear, *_ in gears
        for one in spring_slopes(case, gear)
    ]
    return [*located(reading, doubts, "W431"), *notes]
