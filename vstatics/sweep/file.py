"""Sweep file: all options of a sweep in YAML, for repetition and for continuous integration."""

from __future__ import annotations

import os
from typing import Any

from vstatics.core.errors import Place, ReadError, quoted, spoken
from vstatics.core.readers.kinds import kind_of
from vstatics.core.readers.named import scalars
from vstatics.core.readers.named.arithmetic import LONGEST_ARITHMETIC
from vstatics.core.readers.named.nodes import (
    DocumentText,
    Listing,
    Mapping,
    Node,
    Scalar,
    decode,
    is_null,
    shown,
    what,
)
from vstatics.sweep.options import (
    KEYS,
    OPTIONS,
    Option,
    PlacedFile,
    PlacedPart,
    SweepOptions,
    Text,
    joined,
)

_NO_SWEEPS = {
    "scenario": "this is a scenario, expected a sweep file: `vstatics simulate` runs it, and "
    "`vstatics sweep SCENARIO --vary NAME=VALUES` varies it",
    "case": "this is a case, expected a sweep file: `vstatics sweep CASE --vary NAME=VALUES` "
    "varies it",
}
"""Message about a document that is not a sweep file, by the kind of document."""


def read_sweep_file(data: bytes, file: str) -> SweepOptions:
    """Read a sweep file. File names are relative to the folder of the sweep file.

    Parameters
    ----------
    data : bytes
    file : str
        Name of the file, for messages and for relative paths.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> options = read_sweep_file(b"case: box.yaml" + bytes([10]) + b"sample: 100", "sweep.yaml")
    >>> options.case, options.sample
    ('box.yaml', 100)
    """
    from vstatics.core.readers.named.yaml_nodes import yaml_tree  # yaml is slow to import

    source = decode(data, file, "a sweep")
    keys = spoken(map(quoted, list(KEYS)[:3]))
    root = source.mapping(yaml_tree(source), f"a sweep: a mapping with keys such as {keys}")
    if message := _NO_SWEEPS.get(kind_of(root) or ""):
        source.stop(message, root.line, root.column)
    options = _Reader(source, os.path.dirname(file)).options(root)  # noqa: PTH120
    if source.problems:
        raise ReadError(source.problems)
    return options


class _WrongError(Exception):
    """Error of a wrong value in a sweep file; the text states the expected value."""

    def __init__(self, expected: str, node: Node | None = None) -> None:
        super().__init__(expected)
        self.node = node


class _Reader:
    """Reader of the keys of a sweep file."""

    def __init__(self, source: DocumentText, directory: str) -> None:
        self.source = source
        self.directory = directory

    def options(self, root: Mapping) -> SweepOptions:
        values: dict[str, Any] = {}
        for key, node in root.entries:
            if key.text not in KEYS:
                hint = self.source.hint(key.text, KEYS)
                expected = hint or f", expected {spoken(map(quoted, KEYS))}"
                self.add(f"unknown key `{shown(key.text)}`{expected}", key)
            elif (name := KEYS[key.text]) in values:
                self.add(f"key `{key.text}` is given twice", key)
            elif not is_null(node):
                values[name] = None
                option = OPTIONS[name]
                try:  # each kind of option has a method of that name
                    values[name] = getattr(self, option.kind)(node, option)
                except _WrongError as error:
                    wrong = error.node or node
                    self.add(f"read {what(wrong)}, expected {error}", wrong)
        return SweepOptions(**values)

    def add(self, message: str, node: Node) -> None:
        self.source.add(message, node.line, node.column)

    def path(self, node: Node, _: Option) -> str:
        if not isinstance(node, Scalar) or not node.text or "\0" in node.text:
            raise _WrongError("the name of a file")
        name = node.text if node.text == "-" else os.path.join(self.directory, node.text)  # noqa: PTH118
        return PlacedFile(name).at(self.place(node))

    def count(self, node: Node, option: Option) -> int:
        text = node.text.replace("_", "") if isinstance(node, Scalar) else ""
        is_count = text.isascii() and text.isdigit()
        if is_count and len(text) > LONGEST_ARITHMETIC:
            raise _WrongError(f"a whole number of at most {LONGEST_ARITHMETIC} digits")
        if not is_count or int(text) < option.least:
            raise _WrongError(f"a whole number from {option.least} on")
        return int(text)

    def flag(self, node: Node, _: Option) -> bool:
        try:
            if isinstance(node, Scalar):
                return scalars.flag(node.text, plain=node.plain)
        except ValueError as error:
            raise _WrongError(str(error).removeprefix("expected ")) from None
        raise _WrongError("`true` or `false`")

    def choice(self, node: Node, option: Option) -> str:
        if isinstance(node, Scalar) and node.text in option.choices:
            return node.text
        hint = self.source.hint(node.text, option.choices) if isinstance(node, Scalar) else ""
        raise _WrongError(f"{spoken(map(quoted, option.choices), 'or')}{hint}")

    def text(self, node: Node, _: Option | None = None) -> Text:
        if not isinstance(node, Scalar) or not node.text.strip():
            raise _WrongError("text", node)
        place = self.place(node)
        as_written = place.text.startswith(node.text, place.column - 1)
        return Text(node.text, (PlacedPart(1, place, as_written),))

    def texts(self, node: Node, _: Option | None = None) -> tuple[Text, ...]:
        if isinstance(node, Mapping):
            raise _WrongError("text, a number or a list of these", node)
        items = node.items if isinstance(node, Listing) else [node]
        return tuple(self.text(item) for item in items)

    def list(self, node: Node, _: Option) -> Text:
        """Return the items of a list as a text, separated by commas."""
        return joined(Text(""), self.texts(node), ", ")

    def vary(self, node: Node, _: Option) -> tuple[Text, ...]:
        """Return texts as for the option --vary. A mapping from names to values is accepted."""
        if not isinstance(node, Mapping):
            return self.texts(node)
        return tuple(
            joined(Text(f"{key.text}=", (PlacedPart(1, self.place(key)),)), self.texts(value), ",")
            for key, value in node.entries
        )

    def place(self, node: Node) -> Place:
        place = self.source.source.place(node.line, node.column)
        quoted = place.text[place.column - 1 : place.column] in ("'", '"')
        return place._replace(column=place.column + quoted)
