"""Documents of found boxes as input of commands that take cases."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from vstatics.cli import files
from vstatics.cli.exit_status import DONE
from vstatics.cli.formats import Destination
from vstatics.errors import CaseError, ReadError, of_file

if TYPE_CHECKING:  # they cost start-up time
    from vstatics.pictures import Format
    from vstatics.pictures.style import Style
    from vstatics.synthesis.box_listing import BoxListing


def listing_in(file: str) -> tuple[BoxListing, dict[str, Any]] | None:
    """The found boxes that a file lists, and its document; None if it is another file.

    What can be read but once is left to those that read cases: standard input, pipes.

    Raises
    ------
    ReadError
        If it is such a document with something wrong.
    """
    if file == files.STDIN or not os.path.isfile(file):  # noqa: PTH113
        return None
    try:
        data, name = files.read_input(file)
    except ReadError:  # told where cases are read
        return None
    if b'"searched"' not in data:
        return None
    from vstatics.synthesis.box_reading import is_listing, read_document

    if not is_listing(data):
        return None
    return read_document(data, name)


def plot_boxes(cases: Sequence[str], to: Destination, form: Format, style: Style) -> int:
    """Write the picture of found boxes; the exit status.

    Raises
    ------
    UsageError
        If there are several documents.
    ReadError
        If the file has none, or can't be written.
    """
    from vstatics.pictures.boxes import render_boxes
    from vstatics.synthesis.box_reading import read_boxes

    if len(cases) > 1 or to.is_folder:
        raise click.UsageError("boxes: expected one document of found boxes, and a file for it")
    data, name = files.read_input(cases[0])
    listing = read_boxes(data, name)
    try:
        drawn = render_boxes(listing, form, style)
    except (CaseError, ReadError) as error:
        raise ReadError(of_file(name, one.message) for one in error.problems) from None
    files.write_data(drawn, to.output)
    return DONE


def report_boxes(
    listing: BoxListing, document: dict[str, Any], file: str, output: str, digits: int | None
) -> int:
    """Write the page of found boxes; the exit status.

    Raises
    ------
    ReadError
        If there is no box, the case of one can't be read, or the page can't be written.
    """
    from vstatics.report.boxes import boxes_page

    try:
        page = boxes_page(listing, document, digits)
    except (CaseError, ReadError) as error:
        raise ReadError(of_file(file, one.message) for one in error.problems) from None
    files.write_data(files.encoded(page), output)
    return DONE
