"""Command-line options for a measured mode: frequency and decrement, extremes, or a record."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import click
import numpy as np

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import gathered, under
from vstatics.core.cli.shared.values import FILE, above_0, from_0, numbers, value
from vstatics.core.errors import Problem, ReadError
from vstatics.core.jobs.input_files import TABLE_BYTES

if TYPE_CHECKING:
    from vstatics.torsion.vibration.decays import Decay

TIME = "time"
"""Heading of the column of times in a record."""


class Observed(NamedTuple):
    """Measurement of a mode: a frequency, extremes with a period, or a column of a record."""

    omega: float | None = None
    """Natural frequency. [rad/s]"""
    decrement: float | None = None
    """Logarithmic decrement. [-]"""
    peaks: list[float] | None = None
    """Successive maxima and minima of a recorded free vibration."""
    period: float | None = None
    """Time between successive maxima, or between successive minima. [s]"""
    record: str | None = None
    """Name of a file with a recorded vibration."""
    column: str | None = None

    def measured(self) -> tuple[float, float | None, Decay | None]:
        """Return frequency [rad/s], decrement [-] and decay, each None if unknown.

        Raises
        ------
        UsageError
            If options are missing or contradictory.
        ReadError
            If the record has no decaying vibration.
        ValueError
            If the extremes do not belong to a decaying vibration.
        """
        given = tuple(option is not None for option in self)
        match given:
            case (True, _, False, False, False, False):
                return self.omega or 0.0, self.decrement, None
            case (False, False, True, True, False, False):
                from vstatics.torsion.vibration.decays import decay as decay_of

                decay = decay_of(self.peaks or [], self.period or 0.0)
            case (False, False, False, False, True, True):
                decay = _recorded(self.record or "", self.column or "")
            case _:
                ways = "--omega (and --decrement), --peaks with --period, or --record with --column"
                raise click.UsageError(f"expected {ways}")
        return decay.omega, decay.decrement, decay


def _recorded(file: str, column: str) -> Decay:
    from vstatics.core.readers.records import read_record
    from vstatics.torsion.vibration.decays import recorded_decay

    record = read_record(*files.read_input(file, TABLE_BYTES), {TIME: "time", column: None})
    problems = [record.lacks("E883", name) for name in (TIME, column) if name not in record.columns]
    if problems:
        raise ReadError(problems)
    times, values = record.columns[TIME], record.columns[column]
    repeated = (np.diff(times) == 0) & (np.diff(values) == 0)
    rows = np.flatnonzero(np.append(True, ~repeated)) if len(times) else np.arange(0)
    times, values = times[rows], values[rows]
    falls = np.flatnonzero(np.diff(times) <= 0)
    if len(falls):
        row = int(rows[falls[0] + 1])
        message = f"read the time {times[falls[0] + 1]:g} s, expected ascending times"
        raise ReadError([Problem("E886", message, (), record.place(row))])
    try:
        return recorded_decay(times, values)
    except ValueError as error:
        raise ReadError([record.problem("E887", f"{column}: {error}")]) from None


observed = gathered(
    "observation",
    Observed,
    under(
        "Measurement",
        click.option(
            "--omega",
            type=float,
            callback=value(above_0),
            metavar="W",
            help="Measured natural frequency of the mode, in rad/s.",
        ),
        click.option(
            "--decrement",
            type=float,
            callback=value(from_0),
            metavar="D",
            help="Measured logarithmic decrement of the mode.",
        ),
        click.option(
            "--peaks",
            callback=value(numbers("a number", -np.inf)),
            metavar="M,M,...",
            help="Successive extreme values of a record, instead of --omega and --decrement.",
        ),
        click.option(
            "--period",
            type=float,
            callback=value(above_0),
            metavar="T",
            help="Period of the vibration, in s; belongs to --peaks.",
        ),
        click.option(
            "--record",
            type=FILE,
            metavar="F.csv",
            help="Record of a free vibration, with a column `time` in s.",
        ),
        click.option(
            "--column", metavar="C", help="Column of the record in which the mode appears."
        ),
    ),
)
"""Decorator with the options of a measurement, which a command receives as `observation`."""
