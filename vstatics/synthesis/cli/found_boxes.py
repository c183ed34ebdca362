"""Documents of found boxes in place of cases: their picture, their page, their summaries."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.documents import is_a
from vstatics.core.cli.shared.exit_status import DONE
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.values import value
from vstatics.core.errors import Problem, ReadError, not_allowed, of_file
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.statics.solve import solve

if TYPE_CHECKING:
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style
    from vstatics.synthesis.boxes.listing import BoxListing, ListedBox


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
        data, name = files.read_input(file, TABLE_BYTES)
    except ReadError:  # told where cases are read
        return None
    if not is_a("boxes", data, name):
        return None
    from vstatics.synthesis.boxes.reading import read_document

    return read_document(data, name)


def plot_boxes(cases: Sequence[str], to: Destination, style: Style, _: object = None) -> int:
    """Write the picture of found boxes; the exit status.

    Raises
    ------
    UsageError
        If there are several documents.
    ReadError
        If the file has none, or can't be written.
    """
    from vstatics.synthesis.boxes.listing import drawn_boxes
    from vstatics.synthesis.boxes.reading import read_document
    from vstatics.synthesis.pictures.picture import MOST_DRAWN_DIAGRAMS, render_boxes

    if len(cases) > 1 or to.is_folder:
        raise click.UsageError("boxes: expected one document of found boxes, and a file for it")
    data, name = files.read_input(cases[0], TABLE_BYTES)
    listing, _ = read_document(data, name)
    with files.problems_of_file(name):
        drawn = render_boxes(listing, cast("Format", to.form), style)
        files.show(_contradictions(drawn_boxes(listing, MOST_DRAWN_DIAGRAMS), name))
    files.write_pages(drawn, to.output)
    return DONE


def report_boxes(
    listing: BoxListing,
    document: dict[str, Any],
    file: str,
    output: str,
    digits: int | None,
    stamp: Mapping[str, str],
) -> int:
    """Write the page of found boxes; the exit status.

    Raises
    ------
    ReadError
        If there is no box, the case of one can't be read, or the page can't be written.
    """
    from vstatics.synthesis.boxes.listing import drawn_boxes
    from vstatics.synthesis.report.boxes import MOST_SHOWN_BOXES, boxes_page

    with files.problems_of_file(file):
        page = boxes_page(listing, document, digits, stamp)
        files.show(_contradictions(drawn_boxes(listing, MOST_SHOWN_BOXES), file))
    files.write_data(files.encoded(page), output)
    return DONE


MOST_COMPARED_BOXES = 6
"""So many boxes stand side by side where nobody says which."""


def calculated_boxes(
    file: str, asked: Sequence[int], settings: CaseOptions
) -> Iterator[CalculatedCase] | None:
    """The cases of the found boxes that a file lists, with results; None if it is another file.

    Raises
    ------
    ReadError
        If it is such a document with something wrong.
    """
    listed = listing_in(file)
    return _calculated(listed[0], file, asked, settings) if listed else None


def _calculated(
    listing: BoxListing, file: str, asked: Sequence[int], settings: CaseOptions
) -> Iterator[CalculatedCase]:
    """The cases of boxes with their results: those that are asked for, else those that tell most.

    Raises
    ------
    BadParameter
        If there is no box of a number.
    ReadError
        If there is no box, or the case of one can't be read.
    """
    if not listing.boxes:
        raise ReadError(
            [of_file("E009", file, "no box was found, so there is nothing to summarize")]
        )
    for box in _chosen_boxes(listing, asked):
        with files.problems_of_file(file):
            allow = settings.telling.allow
            case = box.transmission()
            case = case.replace(hushed=(*case.hushed, *allow))
            doubts = not_allowed(_contradictions([box], file), allow)
        results = solve(case, coast=settings.coast, idle=settings.idle)
        name = f"{file} box {box.number}"
        said = [of_file(one.id, name, f"gear {one.gear}: {one.text}") for one in results.messages]
        problems = settings.telling.told([*doubts, *said])
        files.show(settings.telling.printed(problems))
        yield CalculatedCase(name, results, problems, telling=settings.telling)


def _contradictions(boxes: Sequence[ListedBox], file: str) -> Iterator[Problem]:
    """Warn of what boxes say otherwise than their cases."""
    for box in boxes:
        for message in box.contradictions():
            yield of_file("W806", file, f"box {box.number}: {message}")


def _chosen_boxes(listing: BoxListing, asked: Sequence[int]) -> list[ListedBox]:
    from vstatics.synthesis.boxes.listing import drawn_boxes

    if not asked:
        return drawn_boxes(listing, MOST_COMPARED_BOXES)
    last = len(listing.boxes)
    for number in asked:
        if not 1 <= number <= last:
            message = f"read {number}, but the boxes have the numbers 1 to {last}"
            raise click.BadParameter(message, param_hint="--box")
    return [listing.boxes[number - 1] for number in dict.fromkeys(asked)]


def box_numbers(texts: Sequence[str]) -> tuple[int, ...]:
    """Numbers of boxes, with commas or one by one.

    Raises
    ------
    ValueError
    """
    found: list[int] = []
    for text in ",".join(texts).split(",") if texts else ():
        if not text.strip().isdecimal() or len(text) > 9:
            raise ValueError(f"read {text!r}, expected numbers of boxes, such as 1,4")
        found.append(int(text))
    return tuple(found)


box_option = click.option(
    "--box",
    "boxes",
    multiple=True,
    callback=value(box_numbers),
    metavar="N,...",
    help="Which boxes of a document of found ones; else those that tell most.",
)
"""The option of commands that take several found boxes."""
