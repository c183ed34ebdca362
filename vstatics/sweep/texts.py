"""Texts of options, and where they stand in a sweep file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from vstatics.errors import Place, Problem, ReadError


class Stretch(NamedTuple):
    """Where a part of a text stands."""

    first: int
    """Its first column in the text, from 1."""
    place: Place
    as_written: bool = True
    """Letter by letter; else, as where several lines became one, only as a whole."""


class Text(NamedTuple):
    """The text of an option, and where it stands in a sweep file, if in one."""

    text: str
    parts: tuple[Stretch, ...] = ()

    def place(self, column: int) -> Place | None:
        """Where a column of the text stands."""
        for first, place, as_written in reversed(self.parts):
            if column >= first:
                further = column - first if as_written else 0
                return place._replace(column=place.column + further)
        return self.parts[0].place if self.parts else None


class FileName(str):
    """The name of a file that stands in a sweep file, and where it stands there."""

    __slots__ = ("place",)
    place: Place

    def at(self, place: Place) -> FileName:
        """Keep the place."""
        self.place = place
        return self


def joined(first: Text, others: tuple[Text, ...], separator: str) -> Text:
    """A text and others behind it, with a separator between these, each with its place.

    >>> joined(Text("D1.ratio="), (Text("-2"), Text("-3")), ",").text
    'D1.ratio=-2,-3'
    """
    text, parts = first.text, list(first.parts)
    for number, other in enumerate(others):
        text += separator if number else ""
        parts += [part._replace(first=len(text) + part.first) for part in other.parts]
        text += other.text
    return Text(text, tuple(parts))


@contextmanager
def located(text: Text) -> Iterator[None]:
    """Give problems with the text of an option their place in the sweep file."""
    try:
        yield
    except ReadError as error:
        raise ReadError([_moved(problem, text) for problem in error.problems]) from None


def _moved(problem: Problem, text: Text) -> Problem:
    place = problem.place
    if place is None or not text.parts or not place.file.startswith("--"):
        return problem
    return problem._replace(place=text.place(place.column))
