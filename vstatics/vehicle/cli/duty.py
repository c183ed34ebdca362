"""Options of commands that take a duty cycle."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import gathered, refuse
from vstatics.core.cli.shared.values import FILE, above_0, value
from vstatics.core.jobs.files import is_stream
from vstatics.core.jobs.input_files import DOCUMENT_BYTES, TABLE_BYTES
from vstatics.core.tables.file_suffixes import suffix_of

if TYPE_CHECKING:
    from vstatics.pictures.drawing.style import PictureFiles
    from vstatics.vehicle.duty_file import DutyFile, DutyTable
    from vstatics.vehicle.life.classes import Classes

MOST_CLASSES = 1000
"""Largest number of torque classes of a load spectrum."""


class DutyOptions(NamedTuple):
    """Options of a duty cycle: file with shares or operating points, exponent, torque classes."""

    duty: str | None
    exponent: float | None
    classes: Classes | None = None

    @property
    def files(self) -> list[str]:
        """Input files of the options: the duty cycle if requested."""
        return [] if self.duty is None else [self.duty]

    def read(self) -> DutyFile | DutyTable | None:
        """Read the duty cycle if there is a file.

        Raises
        ------
        ReadError, UsageError
        """
        is_table, text = False, (b"", "")
        if self.duty is not None:
            is_table = suffix_of(self.duty) == ".csv"
            text = files.read_input(self.duty, TABLE_BYTES if is_table else DOCUMENT_BYTES)
            if is_stream(self.duty):
                from vstatics.vehicle.duty_file import has_points

                is_table |= has_points(text[0])
        without = "--exponent needs --duty with a CSV file"
        refuse((self.exponent is not None and not is_table, without))
        without = "--spectrum needs --duty with a CSV file"
        refuse((self.classes is not None and not is_table, without))
        if self.duty is None:
            return None
        from vstatics.vehicle.duty_file import read_duty, read_duty_table

        return read_duty_table(*text, self.exponent, self.classes) if is_table else read_duty(*text)


def _classes(text: str) -> Classes:
    """Parse a number of torque classes, or their upper bounds with a common unit."""
    from vstatics.core.readers.named.scalars import number
    from vstatics.core.readers.named.units import common_unit, quantity

    expected = f"a number of classes from 1 to {MOST_CLASSES}, or bounds such as '50,100,200 N*m'"
    if text.strip().isdecimal():
        if len(text.strip()) > 4 or not 1 <= int(text) <= MOST_CLASSES:
            raise ValueError(f"read {text!r}, expected {expected}")
        return int(text)
    try:
        bare, unit = common_unit(text)
        size = quantity(f"1 {unit}", "torque")
        torques = [size * number(cell.strip()) for cell in bare.split(",")]
    except ValueError:
        raise ValueError(f"read {text!r}, expected {expected}") from None
    if torques[0] <= 0 or any(b <= a for a, b in pairwise(torques)):
        raise ValueError(f"read {text!r}, expected bounds above 0 in ascending order")
    return torques


def drawn_duty(asked: PictureFiles) -> DutyTable:
    """Read the duty cycle of a picture, with torque classes.

    Raises
    ------
    ReadError
        If the file has errors.
    ValueError
        If no CSV of operating points is given, or if the torque classes are invalid.
    """
    from vstatics.vehicle.duty_file import read_duty_table

    if suffix_of(asked.duty) != ".csv":
        message = "expected a duty cycle as a CSV of points, such as --duty points.csv"
        raise ValueError(f"a picture of a load spectrum: {message}")
    classes = asked.classes
    if not isinstance(classes, str):
        classes = (
            str(classes) if isinstance(classes, int) else f"{','.join(map(repr, classes))} N*m"
        )
    return read_duty_table(*files.read_input(asked.duty, TABLE_BYTES), None, _classes(classes))


duty_options = gathered(
    "duty",
    DutyOptions,
    click.option(
        "--duty",
        type=FILE,
        metavar="FILE",
        help="File of a duty cycle. YAML gives `energy` or `time` with a share for each gear. CSV "
        "has the columns `time [s]` or `share`, `gear`, `speed [rpm]` and `torque [N*m]`.",
    ),
    click.option(
        "--exponent",
        type=click.FloatRange(min=0, min_open=True, max=100),
        callback=value(above_0),  # FloatRange would accept NaN
        metavar="P",
        help="Exponent of the equivalent torque, if --duty is a CSV file.  [default: 3]",
    ),
    click.option(
        "--spectrum",
        "classes",
        callback=value(_classes),
        metavar="CLASSES",
        help="Add the load spectrum of each member, if --duty is a CSV file. Give the number of "
        "equal classes of torque, or their upper bounds, such as '50,100,200 N*m'.",
    ),
)
"""Decorator that adds the options of a duty cycle; the command receives `duty`."""
