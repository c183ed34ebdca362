"""Written sweeps in place of cases: their pictures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from vstatics.cli.frame import files
from vstatics.cli.frame.documents import is_a
from vstatics.cli.frame.exit_status import DONE
from vstatics.cli.frame.formats import Destination
from vstatics.errors import ReadError, of_file

if TYPE_CHECKING:
    from vstatics.pictures import Format
    from vstatics.pictures.sheet.style import Style
    from vstatics.pictures.sweeps.columns import DrawnColumns


def plot_sweep(
    sweeps: Sequence[str],
    kind: str,
    to: Destination,
    form: Format,
    style: Style,
    asked: DrawnColumns,
) -> int:
    """Write the picture of a sweep; the exit status.

    Raises
    ------
    UsageError
        If there are several files.
    ReadError
        If the file is no sweep, there is nothing to draw, or the picture can't be written.
    """
    from vstatics.pictures.sweeps import render_sweep
    from vstatics.readers import sweep_tables

    if len(sweeps) > 1 or to.is_folder:
        raise click.UsageError(f"{kind}: expected one written sweep, and a file for its picture")
    data, name = files.read_input(sweeps[0])
    if not is_a("sweep", data, name):
        message = "this is no table of variants: expected what `vstatics sweep -o` has written"
        raise ReadError([of_file("E039", name, message)])
    sweep = sweep_tables.read(data, name)
    with files.problems_of_file(name):
        drawn = render_sweep(sweep, kind, form, style, asked)
    files.write_data(drawn, to.output)
    return DONE
