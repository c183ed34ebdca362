"""Options of commands that take a duty cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import gathered, refuse
from vstatics.core.cli.shared.values import above_0, value
from vstatics.core.jobs.input_files import DOCUMENT_BYTES, TABLE_BYTES
from vstatics.core.tables.file_suffixes import suffix_of

if TYPE_CHECKING:
    from vstatics.vehicle.duty_file import DutyFile, DutyTable


class DutyOptions(NamedTuple):
    """Options of a duty cycle: a file of shares or points, and an exponent."""

    duty: str | None
    exponent: float | None

    @property
    def files(self) -> list[str]:
        """Input files: the duty cycle, if given."""
        return [] if self.duty is None else [self.duty]

    def read(self) -> DutyFile | DutyTable | None:
        """Read the duty cycle, if given.

        Raises
        ------
        ReadError, UsageError
        """
        is_table = self.duty is not None and suffix_of(self.duty) == ".csv"
        without = "--exponent: without --duty and a CSV of points"
        refuse((self.exponent is not None and not is_table, without))
        if self.duty is None:
            return None
        from vstatics.vehicle.duty_file import read_duty, read_duty_table

        text = files.read_input(self.duty, TABLE_BYTES if is_table else DOCUMENT_BYTES)
        return read_duty_table(*text, self.exponent) if is_table else read_duty(*text)


duty_options = gathered(
    "duty",
    DutyOptions,
    click.option(
        "--duty",
        type=click.Path(),
        metavar="FILE",
        help="Duty cycle: a YAML file with `energy` or `time`, a share for each gear; or a CSV "
        "file with `time [s]` or `share`, `gear`, `speed [rpm]`, `torque [N*m]`.",
    ),
    click.option(
        "--exponent",
        type=click.FloatRange(min=0, min_open=True, max=100),
        callback=value(above_0),  # FloatRange accepts NaN
        metavar="P",
        help="Exponent of the equivalent torque of a duty cycle in CSV.  [default: 3]",
    ),
)
"""Decorator that adds both options; the command receives `duty`."""
