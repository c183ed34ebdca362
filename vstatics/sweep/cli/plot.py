"""Pictures of sweep files on the command line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, cast

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.options import refuse
from vstatics.core.cli.shared.values import wrong_value
from vstatics.core.errors import ReadError, of_file
from vstatics.core.extras import higher
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.tables.file_suffixes import suffix_of
from vstatics.sweep.pictures import render_sweep
from vstatics.sweep.pictures.columns import drawn_columns
from vstatics.sweep.pictures.map_options import (
    FullLoad,
    MapOptions,
    checked_levels,
    operating_points,
)

if TYPE_CHECKING:
    from vstatics.pictures.cli.options import AskedPicture
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style


def plot_written_sweep(
    sweeps: Sequence[str], to: Destination, style: Style, asked: AskedPicture
) -> int:
    """Draw a picture of a sweep file, and return the exit status.

    Raises
    ------
    UsageError
        If there are several files, or a column does not suit the kind of picture.
    ReadError
        If the file is not a sweep, has nothing to draw, or the picture cannot be written.
    """
    from vstatics.core.readers import sweep_tables

    kind, columns = asked.kind, drawn_columns(asked.x, asked.y, asked.z, asked.by)
    best = asked.best_gear
    points = (asked.duty and suffix_of(asked.duty) != ".csv", "--duty: expected a CSV of points")
    refuse(
        (
            kind == "histogram" and (columns.x or columns.z),
            "--x, --z: a histogram shows the columns of --y only",
        ),
        points,
        (best and asked.levels is not None, "--levels: a map with --best-gear has no levels"),
        (kind == "curves" and columns.z, "--z: only a map has contours"),
        (
            len(sweeps) > 1 or to.is_folder,
            f"{kind}: expected one table of `sweep -o`, and a file for its picture",
        ),
    )
    data, name = files.read_input(sweeps[0], TABLE_BYTES)
    if not sweep_tables.is_sweep(data):
        message = "this is not a table of variants: expected a file written by `vstatics sweep -o`"
        raise ReadError([of_file("E039", name, message)])
    sweep = sweep_tables.read(data, name)
    with wrong_value("--levels"):
        levels = checked_levels(asked.levels)
    duty = operating_points(*files.read_input(asked.duty, TABLE_BYTES)) if asked.duty else ()
    options = MapOptions(levels, best, duty, _full_load_curves(asked.limits))
    columns = columns._replace(of_map=options)
    with files.problems_of_file(name):
        drawn = render_sweep(sweep, kind, cast("Format", to.form), style, columns)
    files.write_pages(drawn, to.output)
    return DONE


def _full_load_curves(file: str) -> list[FullLoad]:
    if not file:
        return []
    from vstatics.core import readers

    data, name = files.read_input(file)
    with files.problems_of_file(name):
        curves: list[FullLoad] = higher("full_load_curves")(readers.read(data, name).case)
    return curves
