"""What the commands of `vstatics torsion` share: gears, links and messages of a case."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import click

from vstatics.cli.frame import cases as arguments
from vstatics.errors import Problem, ReadError
from vstatics.extras import missing
from vstatics.model.transmission import Transmission
from vstatics.readers.reading import Reading


def needs_scipy() -> None:
    """Refuse where the extra is not installed, before anything is read.

    Raises
    ------
    ReadError
    """
    if message := missing("torsion", "vstatics torsion"):
        raise ReadError([Problem(message)])


def coasting(reading: Reading, coast: bool | None) -> Reading:
    """A case with the power as an option says; as it says itself where that says nothing."""
    if coast in (None, reading.case.coast):
        return reading
    return reading._replace(case=reading.case.replace(coast=coast))


def gear_names(case: Transmission, asked: Sequence[str]) -> list[str]:
    """The gears that are asked for, each once; all where none is.

    Raises
    ------
    BadParameter
        If there is no such gear.
    """
    return [case.gears[index].name for index in arguments.gear_indices(case, asked)]


def link_name(case: Transmission, asked: str, option: str) -> str:
    """The name of the link that an option asks for.

    Raises
    ------
    BadParameter
        If there is none; it tells the nearest name.
    """
    try:
        return case.link_name(case.link_number(asked))
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint=option) from None


def located(reading: Reading, texts_by_gear: Iterable[tuple[str, str, str]]) -> Iterator[Problem]:
    """Messages as problems at the places of their gears.

    Parameters
    ----------
    texts_by_gear : iterable of tuple
        The name of a gear, a severity, a text.
    """
    numbers = {gear.name: number for number, gear in enumerate(reading.case.gears, 1)}
    for name, severity, message in texts_by_gear:
        place = reading.locate(Problem("", ("gears", numbers[name]))).place
        yield Problem(f"gear {name}: {message}", (), place, severity)  # type: ignore[arg-type]
