"""What was observed of a mode: its frequency and decrement, its extremes, or a record."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import click
import numpy as np

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import gathered
from vstatics.core.cli.shared.values import above_0, from_0, numbers, value
from vstatics.core.errors import Problem, ReadError
from vstatics.core.jobs.input_files import TABLE_BYTES

if TYPE_CHECKING:
    from vstatics.torsion.vibration.decays import Decay

TIME = "time"
"""The column of a record that has its times."""


class Observed(NamedTuple):
    """One of a frequency, extremes with their period, and a record with its column."""

    omega: float | None = None
    """[rad/s]"""
    decrement: float | None = None
    peaks: list[float] | None = None
    period: float | None = None
    """[s]"""
    record: str | None = None
    column: str | None = None

    def measured(self) -> tuple[float, float | None, Decay | None]:
        """Frequency [rad/s], decrement if it is known, and what they follow from.

        Raises
        ------
        UsageError
        ReadError
            If a record has no vibration.
        ValueError
            If extremes are none.
        """
        given = tuple(one is not None for one in self)
        match given:
            case (True, _, False, False, False, False):
                return self.omega or 0.0, self.decrement, None
            case (False, False, True, True, False, False):
                from vstatics.torsion.vibration.decays import decay

                found = decay(self.peaks or [], self.period or 0.0)
            case (False, False, False, False, True, True):
                found = _recorded(self.record or "", self.column or "")
            case _:
                ways = "--omega (and --decrement), --peaks with --period, or --record with --column"
                raise click.UsageError(f"expected {ways}")
        return found.omega, found.decrement, found


def _recorded(file: str, column: str) -> Decay:
    """The vibration of a column of a record."""
    from vstatics.core.readers.records import read_record
    from vstatics.torsion.vibration.decays import recorded_decay

    found = read_record(*files.read_input(file, TABLE_BYTES), {TIME: "time", column: None})
    problems = [found.lacks("E883", one) for one in (TIME, column) if one not in found.columns]
    if problems:
        raise ReadError(problems)
    times, values = found.columns[TIME], found.columns[column]
    same = (np.diff(times) == 0) & (np.diff(values) == 0)
    kept = np.flatnonzero(np.append(True, ~same)) if len(times) else np.arange(0)
    times, values = times[kept], values[kept]
    falls = np.flatnonzero(np.diff(times) <= 0)
    if len(falls):
        row = int(kept[falls[0] + 1])
        message = f"read the time {times[falls[0] + 1]:g} s, expected times that rise"
        raise ReadError([Problem("E886", message, (), found.place(row))])
    try:
        return recorded_decay(times, values)
    except ValueError as error:
        raise ReadError([found.problem("E887", f"{column}: {error}")]) from None


observed = gathered(
    "seen",
    Observed,
    click.option(
        "--omega",
        type=float,
        callback=value(above_0),
        metavar="W",
        help="Frequency of the mode that was measured, in rad/s.",
    ),
    click.option(
        "--decrement",
        type=float,
        callback=value(from_0),
        metavar="D",
        help="Its logarithmic decrement, for the dampings of all devices.",
    ),
    click.option(
        "--peaks",
        callback=value(numbers("a number", -np.inf)),
        metavar="M,M,...",
        help="In their place extremes of its record, one after the other.",
    ),
    click.option(
        "--period", type=float, callback=value(above_0), metavar="T", help="Of these, in s."
    ),
    click.option(
        "--record",
        type=click.Path(),
        metavar="F.csv",
        help="Or the record itself, with a column `time` in s.",
    ),
    click.option("--column", metavar="C", help="Its column in which the mode is seen."),
)
"""All of them; the command gets `seen`."""
