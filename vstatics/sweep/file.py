"""The sweep file: a whole sweep in YAML, for repetition and for CI."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple, TypeVar, get_args

from vstatics.errors import Place, Problem, ReadError
from vstatics.readers.named import scalars
from vstatics.readers.named.nodes import (
    Found,
    Listing,
    Mapping,
    Node,
    Scalar,
    decode,
    is_null,
    shown,
    what,
)
from vstatics.sweep.formats import Format

Value = TypeVar("Value")


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


class Settings(NamedTuple):
    """What a sweep file, or the command line, says; None and () say nothing."""

    case: str | None = None
    vary: tuple[Text, ...] = ()
    zip: bool | None = None
    sample: int | None = None
    method: str | None = None
    seed: int | None = None
    variants: str | None = None
    out: Text | None = None
    where: Text | None = None
    min: tuple[Text, ...] = ()
    max: tuple[Text, ...] = ()
    best: int | None = None
    output: str | None = None
    format: str | None = None
    coast: bool | None = None
    idle: str | None = None

    def over(self, others: Settings) -> Settings:
        """These settings, and the others where these say nothing.

        What is varied goes together: who gives a table does not want the others' grid.
        """
        if self.variants is not None:
            others = others._replace(vary=(), zip=None, sample=None, method=None, seed=None)
        elif self.vary:
            others = others._replace(variants=None, vary=())
        if self.zip:
            others = others._replace(sample=None, method=None, seed=None)
        elif self.sample is not None:
            others = others._replace(zip=None, variants=None)
        if self.min or self.max:
            others = others._replace(min=(), max=())
        said = {name: own for name, own in self._asdict().items() if own not in (None, ())}
        return others._replace(**said)


METHODS = ("sobol", "lhs", "random")
IDLE = ("exact", "published")


def read_sweep_file(data: bytes, file: str) -> Settings:
    """Read a sweep file; its paths are relative to it.

    Parameters
    ----------
    data : bytes
    file : str
        Its name, for messages and for the paths in it.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> settings = read_sweep_file(b"case: box.yaml" + bytes([10]) + b"sample: 100", "sweep.yaml")
    >>> settings.case, settings.sample
    ('box.yaml', 100)
    """
    from vstatics.readers.named.yaml_nodes import yaml_tree  # yaml costs start-up time

    if not data.strip():
        message = "the file is empty, expected a sweep"
        raise ReadError([Problem(message, place=Place(file, 1, 1))])
    found = decode(data, file)
    root = yaml_tree(found)
    if not isinstance(root, Mapping):
        expected = f"expected a sweep: a mapping with keys such as {_listed(list(_READERS)[:3])}"
        found.stop(f"read {what(root)}, {expected}", root.line, root.column)
    settings = _Reader(found, os.path.dirname(file)).settings(root)  # noqa: PTH120
    if found.problems:
        raise ReadError(found.problems)
    return settings


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


class _WrongError(Exception):
    """What was expected in place of a node, of the whole one when not given."""

    def __init__(self, expected: str, node: Node | None = None) -> None:
        super().__init__(expected)
        self.node = node


class _Reader:
    """Reads the keys of a sweep file."""

    def __init__(self, found: Found, directory: str) -> None:
        self.found = found
        self.directory = directory

    def settings(self, root: Mapping) -> Settings:
        given: dict[str, Any] = {}
        for key, node in root.entries:
            if key.text not in _READERS:
                hint = self.found.hint(key.text, _READERS)
                expected = hint or f", expected {_listed(list(_READERS))}"
                self.add(f"unknown key `{shown(key.text)}`{expected}", key)
            elif key.text in given:
                self.add(f"key `{key.text}` is given twice", key)
            elif not is_null(node):
                given[key.text] = None
                try:
                    given[key.text] = _READERS[key.text](self, node)
                except _WrongError as error:
                    wrong = error.node or node
                    self.add(f"read {what(wrong)}, expected {error}", wrong)
        return Settings(**given)

    def add(self, message: str, node: Node) -> None:
        self.found.add(message, node.line, node.column)

    def path(self, node: Node) -> str:
        if not isinstance(node, Scalar) or not node.text:
            raise _WrongError("the name of a file")
        return node.text if node.text == "-" else os.path.join(self.directory, node.text)  # noqa: PTH118

    def count(self, node: Node) -> int:
        return self.whole(node, 1)

    def seed(self, node: Node) -> int:
        return self.whole(node, 0)

    def whole(self, node: Node, least: int) -> int:
        text = node.text.replace("_", "") if isinstance(node, Scalar) else ""
        if not (text.isascii() and text.isdigit() and int(text) >= least):
            raise _WrongError(f"a whole number from {least} on")
        return int(text)

    def flag(self, node: Node) -> bool:
        try:
            if isinstance(node, Scalar):
                return scalars.flag(node.text, plain=node.plain)
        except ValueError as error:
            raise _WrongError(str(error).removeprefix("expected ")) from None
        raise _WrongError("`true` or `false`")

    def text(self, node: Node) -> Text:
        if not isinstance(node, Scalar) or not node.text.strip():
            raise _WrongError("text", node)
        place = self.place(node)
        as_written = place.text.startswith(node.text, place.column - 1)
        return Text(node.text, (Stretch(1, place, as_written),))

    def texts(self, node: Node) -> tuple[Text, ...]:
        items = node.items if isinstance(node, Listing) else [node]
        return tuple(self.text(item) for item in items)

    def joined(self, node: Node) -> Text:
        """The items of a list as one text with commas."""
        return self.put_together(Text(""), self.texts(node), ", ")

    def vary(self, node: Node) -> tuple[Text, ...]:
        """Texts as of the option, or the varied numbers as keys."""
        if not isinstance(node, Mapping):
            return self.texts(node)
        return tuple(
            self.put_together(
                Text(f"{key.text}=", (Stretch(1, self.place(key)),)), self.texts(value), ","
            )
            for key, value in node.entries
        )

    def put_together(self, first: Text, texts: tuple[Text, ...], between: str) -> Text:
        """Texts as one, each with its place."""
        text, parts = first.text, list(first.parts)
        for number, item in enumerate(texts):
            text += between if number else ""
            parts += [one._replace(first=len(text) + one.first) for one in item.parts]
            text += item.text
        return Text(text, tuple(parts))

    def place(self, node: Node) -> Place:
        place = self.found.source.place(node.line, node.column)
        quoted = place.text[place.column - 1 : place.column] in ("'", '"')
        return place._replace(column=place.column + quoted)


def _choice(choices: tuple[str, ...]) -> Callable[[_Reader, Node], str]:
    """A reader of one of some words."""

    def read(reader: _Reader, node: Node) -> str:
        if isinstance(node, Scalar) and node.text in choices:
            return node.text
        hint = reader.found.hint(node.text, choices) if isinstance(node, Scalar) else ""
        raise _WrongError(f"{_listed(choices, 'or')}{hint}")

    return read


def _listed(words: list[str] | tuple[str, ...], last: str = "and") -> str:
    *others, end = (f"`{word}`" for word in words)
    return f"{', '.join(others)} {last} {end}"


_READERS: dict[str, Callable[[_Reader, Node], Any]] = {
    "case": _Reader.path,
    "vary": _Reader.vary,
    "zip": _Reader.flag,
    "sample": _Reader.count,
    "method": _choice(METHODS),
    "seed": _Reader.seed,
    "variants": _Reader.path,
    "out": _Reader.joined,
    "where": _Reader.text,
    "min": _Reader.texts,
    "max": _Reader.texts,
    "best": _Reader.count,
    "output": _Reader.path,
    "format": _choice(get_args(Format)),
    "coast": _Reader.flag,
    "idle": _choice(IDLE),
}
