"""Summaries of found boxes: a document of them in place of cases."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import click

from vstatics.cli.cases import CalculatedCase, CaseOptions
from vstatics.errors import ReadError, of_file
from vstatics.statics.solve import solve

if TYPE_CHECKING:  # it costs start-up time
    from vstatics.synthesis.box_listing import BoxListing, ListedBox

MOST_COMPARED_BOXES = 6
"""So many boxes stand side by side where nobody says which."""


def calculated_boxes(
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
        raise ReadError([of_file(file, "no box was found, so there is nothing to summarize")])
    for box in _chosen(listing, asked):
        try:
            case = box.transmission()
        except ReadError as error:
            raise ReadError(of_file(file, one.message) for one in error.problems) from None
        results = solve(case, coast=settings.coast, idle=settings.idle)
        name = f"{file} box {box.number}"
        yield CalculatedCase(name, results, [], telling=settings.telling)


def _chosen(listing: BoxListing, asked: Sequence[int]) -> list[ListedBox]:
    from vstatics.synthesis.box_listing import drawn_boxes

    if not asked:
        return drawn_boxes(listing, MOST_COMPARED_BOXES)
    last = len(listing.boxes)
    for number in asked:
        if not 1 <= number <= last:
            message = f"read {number}, but the boxes have the numbers 1 to {last}"
            raise click.BadParameter(message, param_hint="--box")
    return [listing.boxes[number - 1] for number in dict.fromkeys(asked)]


def box_numbers(
    _context: click.Context, _option: click.Parameter, texts: Sequence[str]
) -> tuple[int, ...]:
    """Numbers of boxes, with commas or one by one."""
    found: list[int] = []
    for text in ",".join(texts).split(",") if texts else ():
        if not text.strip().isdecimal() or len(text) > 9:
            raise click.BadParameter(f"read {text!r}, expected numbers of boxes, such as 1,4")
        found.append(int(text))
    return tuple(found)
