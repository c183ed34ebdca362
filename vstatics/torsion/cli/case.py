"""Common code of the commands `vstatics torsion ...`: options, gears, links and messages."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import Command, Option, gathered
from vstatics.core.cli.shared.values import FILE, torque, value, wrong_value
from vstatics.core.errors import Problem, listed, plural, spoken
from vstatics.core.groups import grouped
from vstatics.core.model.checks import notes_on_vibration
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.readers.reading import Reading

if TYPE_CHECKING:
    from vstatics.core.tables.answer import Answer
    from vstatics.core.tables.grid import Grid
    from vstatics.torsion.clutch.gear_dump import GearDump
    from vstatics.torsion.forced.harmonic_torques import GearResponse
    from vstatics.torsion.random.random_vibration import GearRandom
    from vstatics.torsion.reduction.reduced_values import GearReduction
    from vstatics.torsion.system.working_points import WorkingGear
    from vstatics.torsion.vibration.gear_modes import GearModes


static_torque = click.option(
    "--torque",
    "static_torque",
    callback=value(torque),
    metavar="T",
    help="Input torque, in N*m, at which springs with `points` get their stiffness. A given speed "
    "ratio of a converter determines this torque instead.  [default: torque of the operating "
    "point, else 0]",
)


def _ratios(texts: Sequence[str]) -> dict[str, float]:
    """Read texts such as ``TC=.6``; return the speed ratio of each converter by name."""
    ratios = {}
    for text in texts:
        name, _, ratio = text.rpartition("=")
        try:
            ratios[name] = float(ratio)
        except ValueError:
            ratios[name] = math.nan
        if not name or not math.isfinite(ratios[name]):
            raise ValueError(
                f"read {text!r}, expected the name of a converter and a number: TC=0.6"
            )
    return ratios


_speed_ratios = click.option(
    "--speed-ratio",
    "ratios",
    multiple=True,
    callback=value(_ratios),
    metavar="TC=I",
    help="Speed ratio I of the converter TC, turbine divided by pump. Repeatable.  [default: as in "
    "the gear, else the ratio at which the converter takes the input torque]",
)


CASE_OPTIONS = (
    click.argument("case", type=FILE),
    formats.options(*formats.TABLES),
    arguments.input_format,
    arguments.coast,
    arguments.telling,
)
elastic_case = gathered("request", OneCase, *CASE_OPTIONS, static_torque)
"""Decorator with the case and the common options, which a command receives as `request`."""


def gear_names(case: Transmission, chosen: Sequence[str]) -> list[str]:
    """Return the names of the chosen gears without repetitions, or of all gears by default.

    Raises
    ------
    BadParameter
        If a gear does not exist.
    """
    return [case.gears[index].name for index in arguments.gear_indices(case, chosen)]


class WorkingGears(NamedTuple):
    """Gears and speed ratios of converters that the options of a command choose."""

    gears: tuple[str, ...]
    ratios: Mapping[str, float]

    def of(self, case: Transmission) -> list[WorkingGear]:
        """Return the chosen gears of a case, with converters linearised."""
        from vstatics.torsion.system.working_points import working_gear

        gears = [case.gears[index] for index in arguments.gear_indices(case, self.gears)]
        with wrong_value("--speed-ratio"):
            return [working_gear(case, gear, self.ratios) for gear in gears]


def working_options(*between: Option) -> Callable[[Command], Command]:
    """Add the options of `WorkingGears`, which a command receives as `chosen`."""
    return gathered("chosen", WorkingGears, arguments.some_gears, *between, _speed_ratios)


chosen_gear = click.option(
    "--gear",
    metavar="G",
    help="Gear, by its name, or by its number as '#3'; required if the case has several gears.",
)


def gear_of(case: Transmission, chosen: str | None) -> Gear:
    """Return the chosen gear, or the gear of a case with a single gear.

    Raises
    ------
    UsageError
        If the gear does not exist, or if no gear is chosen and the case has several gears.
    """
    if chosen is not None:
        return case.gears[arguments.gear_number(case, chosen) - 1]
    if len(case.gears) > 1:
        names = listed([gear.name for gear in case.gears])
        raise click.UsageError(f"Missing option '--gear': gears are {names}")
    return case.gears[0]


def link_name(case: Transmission, link: str, option: str) -> str:
    """Return the name of a link that an option gives by number or name.

    Raises
    ------
    BadParameter
        If the link does not exist; the message suggests the nearest name.
    """
    with wrong_value(option):
        return case.link_name(case.link_number(link))


def located(
    reading: Reading, texts_by_gear: Iterable[tuple[str, str]], identity: str
) -> list[Problem]:
    """Return the messages about gears as problems at the positions of the gears in a file.

    Equal messages of several gears are one problem, at the first of these gears.

    Parameters
    ----------
    reading : Reading
    texts_by_gear : iterable of tuple
        Pairs of gear name and message; empty messages are skipped.
    identity : str
        Identity of the problems, such as E519.
    """
    numbers = {gear.name: number for number, gear in enumerate(reading.case.gears, 1)}
    problems = []
    for message, names in grouped((text, name) for name, text in texts_by_gear).items():
        if message:
            place = reading.locate(Problem(identity, "", ("gears", numbers[names[0]]))).place
            problems.append(Problem(identity, _of_gears(names, message), (), place))
    return problems


def _of_gears(names: Sequence[str], message: str) -> str:
    return f"{plural('gear', len(names))} {spoken(names)}: {message}"


def gears_answer(
    reading: Reading,
    gears: Sequence[GearDump | GearModes | GearRandom | GearReduction | GearResponse],
    grids: Callable[[], Iterable[Grid]],
    answer: Answer,
    problems: Iterable[Problem],
) -> CaseAnswer:
    """Return an answer about gears, which fails if a gear has an error.

    Errors are reported before other problems.
    """
    faults = located(reading, ((gear.name, gear.error) for gear in gears), "E519")
    return CaseAnswer(
        grids,
        answer,
        [*faults, *problems, *map(reading.locate, notes_on_vibration(reading.case))],
        failed=bool(faults),
    )


def slope_notes(reading: Reading, gears: Iterable[str]) -> list[Problem]:
    """Return notes about the slopes of nonlinear springs, and warnings about converters."""
    from vstatics.torsion.system.working_points import mean_gear

    by_name = {gear.name: gear for gear in reading.case.gears}
    return _slope_notes(reading, [mean_gear(reading.case, by_name[name]) for name in gears])


def working_notes(
    reading: Reading, gears: Iterable[WorkingGear], *, linearised: bool = False
) -> list[Problem]:
    """Return notes on slopes of springs, and on dry friction that is omitted or linearised."""
    notes = _friction_notes(reading, linearised=linearised)
    return [*_slope_notes(reading, list(gears)), *notes]


def _friction_notes(reading: Reading, *, linearised: bool) -> Iterator[Problem]:
    for number, spring in enumerate(reading.case.springs, 1):
        if not spring.friction:
            continue
        named, path = f"{spring.name}, {spring.friction:g} N*m", ("springs", number, "friction")
        if linearised:
            text = (
                f"the dry friction M of {named}, counts as the damper 4 M/(pi A w) at the "
                "amplitude A of its twist, for each order alone; a torque on it below 4 M/pi does "
                "not move it"
            )
            yield reading.locate(Problem("N508", text, path))
        else:
            text = (
                f"linear vibration omits the dry friction of {named}; use `simulate`, or give a "
                "`damping` that dissipates the same energy"
            )
            yield reading.locate(Problem("N507", text, path))


def _slope_notes(reading: Reading, gears: Sequence[WorkingGear]) -> list[Problem]:
    from vstatics.torsion.system.slopes import spring_slopes

    doubts = ((working.gear.name, text) for working in gears for text in working.doubts)
    equal = grouped(
        (Problem("N506", str(slope), ("springs", slope.number, "points")), gear.name)
        for case, gear, *_ in gears
        for slope in spring_slopes(case, gear)
    )
    notes = [
        reading.locate(note._replace(message=_of_gears(names, note.message)))
        for note, names in equal.items()
    ]
    return [*located(reading, doubts, "W431"), *notes]
