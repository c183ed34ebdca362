"""Lists of found gearboxes as input of other commands: picture, page and comparison."""

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
from vstatics.core.cli.shared.options import INPUT, RenamedOption, under
from vstatics.core.cli.shared.values import value
from vstatics.core.errors import Problem, ReadError, not_allowed, of_file
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.statics.solve import solve

if TYPE_CHECKING:
    from vstatics.pictures.drawing.files import Format
    from vstatics.pictures.drawing.style import Style
    from vstatics.synthesis.boxes.listing import BoxListing, ListedBox


def listing_in(file: str) -> tuple[BoxListing, dict[str, Any]] | None:
    """Return the gearboxes that a file lists, and the document.

    Return None for other files.

    Files that can be read only once, such as standard input and pipes, are left to readers of
    cases.

    Raises
    ------
    ReadError
        If the file is a list of gearboxes with an error.
    """
    if file == files.STDIN or not os.path.isfile(file):  # noqa: PTH113
        return None
    try:
        data, name = files.read_input(file, TABLE_BYTES)
    except ReadError:  # the reader of cases will report the error
        return None
    if not is_a("boxes", data, name):
        return None
    from vstatics.synthesis.boxes.reading import read_document

    return read_document(data, name)


def plot_boxes(cases: Sequence[str], to: Destination, style: Style, _: object = None) -> int:
    """Draw found gearboxes, write the picture, and return the exit status.

    Raises
    ------
    UsageError
        If several files are given.
    ReadError
        If the file does not list gearboxes, or the picture cannot be written.
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
    """Write the page of found gearboxes, and return the exit status.

    Raises
    ------
    ReadError
        If the list is empty, a case cannot be read, or the page cannot be written.
    """
    from vstatics.synthesis.boxes.listing import drawn_boxes
    from vstatics.synthesis.report.boxes import MOST_SHOWN_BOXES, boxes_page

    with files.problems_of_file(file):
        page = boxes_page(listing, document, digits, stamp)
        files.show(_contradictions(drawn_boxes(listing, MOST_SHOWN_BOXES), file))
    files.write_data(files.encoded(page), output)
    return DONE


MOST_COMPARED_BOXES = 6
"""Number of gearboxes compared by default."""


def calculated_boxes(
    file: str, asked: Sequence[int], settings: CaseOptions
) -> Iterator[CalculatedCase] | None:
    """Return the calculated cases of the gearboxes that a file lists.

    Return None for other files.

    Raises
    ------
    ReadError
        If the file is a list of gearboxes with an error.
    """
    listed = listing_in(file)
    return _calculated(listed[0], file, asked, settings) if listed else None


def _calculated(
    listing: BoxListing, file: str, asked: Sequence[int], settings: CaseOptions
) -> Iterator[CalculatedCase]:
    """Calculate the cases of chosen gearboxes, by default a few with different figures.

    Raises
    ------
    BadParameter
        If no gearbox has a chosen number.
    ReadError
        If the list is empty, or a case cannot be read.
    """
    if not listing.boxes:
        raise ReadError(
            [of_file("E009", file, "no gearbox was found, so there is nothing to summarize")]
        )
    for box in _chosen_boxes(listing, asked):
        with files.problems_of_file(file):
            allow = settings.telling.allow
            case = box.transmission()
            case = case.replace(hushed=(*case.hushed, *allow))
            doubts = not_allowed(_contradictions([box], file), allow)
        results = solve(case, coast=settings.coast, idle=settings.idle)
        name = f"{file} box {box.number}"
        messages = [
            of_file(message.id, name, f"gear {message.gear}: {message.text}")
            for message in results.messages
        ]
        problems = settings.telling.told([*doubts, *messages])
        files.show(settings.telling.printed(problems))
        yield CalculatedCase(name, results, problems, telling=settings.telling)


def _contradictions(boxes: Sequence[ListedBox], file: str) -> Iterator[Problem]:
    """Yield a warning for each figure of a gearbox that contradicts the case."""
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
            raise click.BadParameter(message, param_hint="--gearbox")
    return [listing.boxes[number - 1] for number in dict.fromkeys(asked)]


def box_numbers(texts: Sequence[str]) -> tuple[int, ...]:
    """Return numbers of gearboxes, separated by commas or given singly.

    Raises
    ------
    ValueError
    """
    numbers: list[int] = []
    for text in ",".join(texts).split(",") if texts else ():
        if not text.strip().isdecimal() or len(text) > 9:
            raise ValueError(f"read {text!r}, expected numbers of boxes, such as 1,4")
        numbers.append(int(text))
    return tuple(numbers)


box_option = under(
    INPUT,
    click.option(
        "--gearbox",
        "boxes",
        cls=RenamedOption,
        former=["--box"],
        multiple=True,
        callback=value(box_numbers),
        metavar="N,...",
        help="Numbers of the gearboxes to show from a file of `synth box`.  "
        "[default: Pareto list and families]",
    ),
)
"""Option to choose gearboxes, for commands that can take several."""
