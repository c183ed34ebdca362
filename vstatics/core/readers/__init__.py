"""Readers of cases: a module or folder for each format converts bytes to a `Transmission`.

>>> text = "{links: 2, mechanisms: {D: {first: 1, second: 2, ratio: 3}}, gears: {low: , high: }}"
>>> format_of("case.yaml", text.encode())
'yaml'
>>> reading = read(text.encode(), "case.yaml")  # or ReadError, which lists every problem
>>> [gear.name for gear in reading.case.gears], reading.warnings
(['low', 'high'], [])

`load` reads a file, `loads` a text and `from_dict` a mapping. `expressions` reads formulas. `named`
reads YAML and JSON, and `deck` reads decks. Both record the places (line and column) of values, and
`reading` builds and checks the case. `workbook` converts sheets to nodes, which `named` reads.
`results` and `sweep_tables` read results that the program has written.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from os import PathLike, fspath
from os.path import split, splitext
from typing import TYPE_CHECKING, Any, Literal, Protocol, get_args, runtime_checkable

from vstatics.core.arguments import refusing, type_and_value
from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.input_files import DOCUMENT_BYTES, read_file, read_stream
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.reading import Reading

if TYPE_CHECKING:
    from vstatics.core.readers.named.nodes import DocumentText, Node

Format = Literal["deck", "yaml", "json", "xlsx"]


@runtime_checkable
class Stream(Protocol):
    """Open file or a similar object with a method `read`."""

    def read(self, size: int, /) -> Any:
        """Read and return at most `size` characters or bytes."""


FORMATS: tuple[Format, ...] = get_args(Format)

SUFFIXES: dict[str, Format] = {
    ".dat": "deck",
    ".deck": "deck",
    ".lst": "deck",
    ".yaml": "yaml",
    ".yml": "yaml",
    ".json": "json",
    ".xlsx": "xlsx",
}

_PACKED = b"PK\x03\x04"
"""First bytes of a workbook, which is a ZIP file."""


def format_of_name(file: str) -> Format | None:
    """Return the format of a file from the suffix of its name; None if the suffix is unknown."""
    suffix = splitext(file)[1]  # noqa: PTH122 (importing pathlib costs as much as a solve)
    return SUFFIXES.get(suffix.lower())


def format_of(file: str, data: bytes) -> Format:
    """Return the format of a case from the suffix of the file name, or else from the content."""
    by_name = format_of_name(file)
    if by_name is not None:
        return by_name
    if data.startswith(_PACKED):
        return "xlsx"
    from vstatics.core.readers.deck.text import holds_deck

    if data.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{":
        return "json"
    return "deck" if holds_deck(data) else "yaml"


def read(data: bytes, file: str, format: Format | None = None) -> Reading:  # noqa: A002
    """Read a case from bytes.

    Parameters
    ----------
    data : bytes
        The content of a file.
    file : str
        Name of the file, for messages and to find the format.
    format : {"deck", "yaml", "json", "xlsx"}, optional
        Format of the case; default: from the file name or the content.

    Returns
    -------
    Reading
        The transmission, its warnings, and the places of its parts.

    Raises
    ------
    ReadError
        The error contains every problem and its place.

    Examples
    --------
    >>> text = b"{links: 2, mechanisms: {D: {first: 1, second: 2, ratio: 3}}, gears: {low: }}"
    >>> read(text, "case.yaml").case
    <Transmission: 2 links, 0 shift elements, 1 mechanism, 1 gear>
    >>> try:
    ...     read(b"KJG= 3 KL= 1", "old.yaml")
    ... except ReadError as error:
    ...     print(error)
    old.yaml: error: the text is a deck, not YAML: expected the suffix .dat or `--from deck` [E108]
    """
    wanted = format or format_of(file, data)
    if wanted not in FORMATS:
        raise ValueError(f"format {wanted!r}: expected one of {', '.join(FORMATS)}")
    if wanted == "deck":
        from vstatics.core.readers.deck import reader  # imported when needed

        return reader.read(data, file)
    from vstatics.core.readers.named.reader import read_case_tree

    try:
        return read_case_tree(*case_tree(data, file, wanted))
    except ReadError as error:
        from vstatics.core.readers.deck.text import holds_deck

        if error.problems[0].id != "E108" or wanted == "xlsx" or not holds_deck(data):
            raise
        message = (
            f"the text is a deck, not {wanted.upper()}: expected the suffix .dat or `--from deck`"
        )
        raise ReadError([of_file("E108", file, message)]) from None


def case_tree(data: bytes, file: str, form: Format) -> tuple[Node, DocumentText]:
    """Return the tree of nodes of a case in YAML, JSON or a workbook, and the text.

    Modules are imported when needed to save start-up time.

    Raises
    ------
    ReadError
        If the text is not valid YAML or JSON, or the file is not a workbook.
    """
    if form == "xlsx":
        from vstatics.core.readers.workbook.reader import workbook_tree

        return workbook_tree(data, file)
    from vstatics.core.readers.named.nodes import decode

    document = decode(data, file)
    if form == "json":
        from vstatics.core.readers.named.json_nodes import json_tree

        return json_tree(document), document
    from vstatics.core.readers.named.yaml_nodes import yaml_tree

    return yaml_tree(document), document


@refusing()
def load(source: str | PathLike[str] | Stream, *, format: Format | None = None) -> Transmission:  # noqa: A002
    r"""Read a case: a Visual-Statics deck, YAML, JSON or a workbook.

    Parameters
    ----------
    source : path-like or stream
        A file, or an open stream of text or bytes.
    format : {"deck", "yaml", "json", "xlsx"}, optional
        Format of the case; default: from the suffix of the file, or else from the content.

    Returns
    -------
    Transmission

    Raises
    ------
    ReadError
        The error contains every problem and its place.
    ValueError
        If the format is unknown.
    OSError
        If the file cannot be opened.

    Examples
    --------
    >>> import io
    >>> text = "links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: 3}}\ngears: {1: []}"
    >>> load(io.StringIO(text))
    <Transmission: 2 links, 0 shift elements, 1 mechanism, 1 gear>
    """
    with content(source) as (data, name):
        return read(data, name, format).case


@contextmanager
def content(
    source: str | PathLike[str] | Stream, most: int = DOCUMENT_BYTES
) -> Iterator[tuple[bytes, str]]:
    """Yield the content (at most `most` bytes) and the name of a file or a stream.

    The origin of a stream without a name is unknown, so its text must not name other files within
    the block.

    Raises
    ------
    OSError
        If the file cannot be opened, or is larger than `most`.
    """
    if isinstance(source, str | PathLike):
        yield read_file(source, most), fspath(source)
        return
    name = getattr(source, "name", "")
    is_named = isinstance(name, str) and bool(name)
    from vstatics.core.readers.named.csv_files import no_files

    with nullcontext() if is_named else no_files():
        shown = name if is_named else "<text>"
        yield _encoded(read_stream(source, most, shown)), shown


@refusing()
def loads(text: str | bytes, *, format: Format | None = None, name: str = "") -> Transmission:  # noqa: A002
    r"""Read a case from a text.

    Parameters
    ----------
    text : str or bytes
        The case itself, not the name of a file.
    format : {"deck", "yaml", "json", "xlsx"}, optional
        Format of the text; default: from the content.
    name : str, optional
        Name of the text in messages. If it contains a folder, as in ``cases/box.yaml``, files named
        in the text are read relative to this folder. Otherwise such files are not read, because the
        text can be untrusted.

    Returns
    -------
    Transmission

    Raises
    ------
    ReadError
        The error contains every problem and its place.
    ValueError
        If the format is unknown.

    Examples
    --------
    >>> loads("links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: 3}}\ngears: {1: []}")
    <Transmission: 2 links, 0 shift elements, 1 mechanism, 1 gear>
    """
    from vstatics.core.readers.named.csv_files import no_files

    folder, _ = split(name)
    with nullcontext() if folder else no_files():
        return read(_encoded(text), name or "<text>", format).case


def _encoded(text: str | bytes) -> bytes:
    return text.encode("utf-8", "surrogatepass") if isinstance(text, str) else bytes(text)


def from_dict(data: Mapping[str, Any]) -> Transmission:
    """Return the transmission described by a mapping with the keys of YAML and JSON.

    No file is read.

    Raises
    ------
    ReadError
        The error contains every problem and its path.
    TypeError
        If `data` is not a mapping, or contains values other than numbers, texts, lists and
        mappings.

    Examples
    --------
    >>> pair = {"first": "in", "second": "out", "ratio": "-41/13"}
    >>> from_dict({"links": ["in", "out"], "mechanisms": {"pair": pair}, "gears": {"drive": []}})
    <Transmission: 2 links, 0 shift elements, 1 mechanism, 1 gear>
    """
    import json

    from vstatics.core.readers.named.csv_files import no_files

    if not isinstance(data, Mapping):
        raise TypeError(
            f"from_dict of {type_and_value(data)}: expected a mapping, or `load` for a file"
        )
    text = json.dumps(data, default=_plain)
    if "NaN" in text or "Infinity" in text:  # JSON has no such numbers
        text = json.dumps(json.loads(text, parse_constant=str))
    try:
        with no_files():
            return read(text.encode(), "<dict>", "json").case
    except ReadError as error:  # the caller knows keys, but not lines of `text`
        raise ReadError(
            problem._replace(path=(), place=None) for problem in error.problems
        ) from None


def _plain(value: Any) -> Any:
    """Return data with plain Python objects for NumPy numbers, arrays and mappings, for JSON."""
    if isinstance(value, Mapping):
        return dict(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"from_dict: {type_and_value(value)} is no plain data")
