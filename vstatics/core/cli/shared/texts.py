"""What a command shows of each of its cases, as text in each format: alone, or among several.

A command says by `CaseOutput` what it has; every format is made of that here. Writers are
imported when they are needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.tables.grid import Grid
from vstatics.core.texts import speaking

if TYPE_CHECKING:
    from vstatics.core.errors import Problem
    from vstatics.core.jobs.finished_cases import FinishedCases
    from vstatics.core.statics.results import Results
    from vstatics.core.tables.answer import Answer


class CaseOutput(NamedTuple):
    """What there is to show of a case; nothing is made before it is asked for."""

    titles: Sequence[str]
    """Over tables."""
    by_format: Mapping[str, Callable[[str | None], str | bytes | Sequence[bytes]]]
    """What is no table of `grids`, by format: a text, say. It is given the file of the case
    where this is one of several in a stream. A picture has pages, each for a file."""
    grids: Callable[[], Iterable[Grid]] | None = None
    answer: Callable[[], Answer] | None = None
    """What JSON is made of."""
    lay_out: Callable[[Any], str] | None = None
    """The lines of that in JSON, where they are not those of any data."""
    problems: Sequence[Problem] = ()
    """What is to be told of it, besides what is of the case."""


class CaseTables(NamedTuple):
    """The tables of a case."""

    file: str
    titles: Sequence[str]
    grids: list[Grid]


Part = bytes | CaseTables
"""Of a stream: a case as text, or as tables that become text with those of the others."""


class Frame(NamedTuple):
    """What stands around the parts of a stream."""

    first: str
    between: str
    last: str
    empty: str = ""
    """What there is in place of all that where there are no parts."""


FRAMES = {
    "text": Frame("", "\n", ""),
    "listing": Frame("", "\n", ""),
    "json": Frame("[\n", ",\n", "\n]\n", "[]\n"),
    "jsonl": Frame("", "", ""),
}


def alone(file: str, shown: CaseOutput, to: Destination) -> Sequence[bytes]:
    """The text of a case by itself, or the pages of its picture."""
    with speaking(to.language):
        if to.form in shown.by_format:
            return _pages(shown, to)
        if to.form in ("json", "jsonl"):
            return [_bytes(_json(file, shown, to), to)]
        return [b"".join(_of_grids([_tables(file, shown, to)], to, several=False))]


def _pages(shown: CaseOutput, to: Destination, file: str | None = None) -> Sequence[bytes]:
    """What a case has besides tables, in its format."""
    made = shown.by_format[to.form](file)
    return [_bytes(made, to)] if isinstance(made, str | bytes) else made


def among_several(
    outcome: CalculatedCase, shown: CaseOutput | None, to: Destination, *, folders: bool = False
) -> Part:
    """What a stream has of a case among several; one that failed is in JSON only.

    Parameters
    ----------
    folders : bool
        Whether JSON tells the file with its folders.
    """
    file = outcome.file
    if to.form in ("json", "jsonl"):
        text = _json(file, shown or _failed(outcome), to, folders=folders)
        return _bytes(text.rstrip("\n") if to.form == "json" else text, to)
    if shown is None:
        return b""
    with speaking(to.language):
        if to.form in shown.by_format:
            made = b"".join(_pages(shown, to, file))
        elif to.is_text:
            [made] = alone(file, shown, to)
        else:
            return _tables(file, shown, to)
    return (_bytes(f"==> {file} <==\n", to) if to.is_text else b"") + made


def _failed(outcome: CalculatedCase) -> CaseOutput:
    from vstatics.core.tables.answer import failure

    return CaseOutput([], {}, answer=partial(failure, outcome.file, outcome.problems))


def joined(
    parts: Iterable[Part], to: Destination, own_frame: Frame | None = None
) -> Iterator[bytes]:
    """The parts of all cases as one text, piece by piece; empty ones are left out."""
    if to.form == "parquet":
        from vstatics.core.writers import result_parquet

        yield from result_parquet.joined(one for one in parts if isinstance(one, bytes))
        return
    frame = own_frame or FRAMES.get(to.form)
    if frame is None:
        tables = (one for one in parts if isinstance(one, CaseTables))
        yield from _of_grids(tables, to, several=True)
        return
    before, is_empty = frame.first, True
    for text in parts:
        if text and isinstance(text, bytes):
            yield _bytes(before, to) + text
            before = frame.between
            is_empty = False
    yield _bytes(frame.empty if is_empty else frame.last, to)


def _tables(file: str, shown: CaseOutput, to: Destination) -> CaseTables:
    assert shown.grids is not None, to.form  # noqa: S101 - the command has this format
    grids = [grid.with_digits(to.style.digits) for grid in shown.grids()]
    return CaseTables(file, shown.titles, grids)


def _of_grids(cases: Iterable[CaseTables], to: Destination, *, several: bool) -> Iterator[bytes]:
    """Tables in a format that has nothing else."""
    if to.form == "xlsx":
        from vstatics.core.tables import xlsx

        by_file = ((one.file, one.grids) for one in cases)
        yield xlsx.write(by_file, several=several, digits=to.style.digits)
    elif to.form == "csv":
        from vstatics.core.tables import csv

        by_file = ((one.file, one.grids) for one in cases)
        for text in csv.write(by_file, several=several, raw=to.style.raw):
            yield _bytes(text, to)
    else:
        from vstatics.core.tables import latex, markdown
        from vstatics.core.tables import text as plain

        writer = {"latex": latex, "markdown": markdown}.get(to.form, plain)
        for number, one in enumerate(cases):
            with speaking(to.language):
                made = writer.write(one.titles, one.grids)
            yield _bytes("\n" * bool(number) + made, to)


def _json(file: str, shown: CaseOutput, to: Destination, *, folders: bool = False) -> str:
    """A case in JSON, on several lines or on one, with its end."""
    from vstatics.core.tables.answer import as_json, with_file

    assert shown.answer is not None  # noqa: S101 - the command has this format
    document = with_file(shown.answer(), file, folders=folders)
    if to.form == "json" and shown.lay_out:
        return shown.lay_out(document) + "\n"
    return as_json(document, to.form)


def _bytes(text: str | bytes, to: Destination) -> bytes:
    """Safe to print, but CSV, which has no escapes, is as it is."""
    return text if isinstance(text, bytes) else files.encoded(text, as_is=to.form == "csv")


class Job(NamedTuple):
    """How each case is done."""

    command: str
    """Whose it is."""
    options: CaseOptions
    to: Destination
    show: Callable[[CalculatedCase, Results], CaseOutput]
    """What the command shows of a case that has results."""
    own_frame: Frame | None = None
    """Around several, in a format of the command's own other than text."""
    finished: FinishedCases | None = None
    """Of the directory that results go to, if they do."""
    marked: bool = False
    """Whether parts of a stream tell of which case they are."""
    folders: bool = False
    """Whether JSON tells files with their folders, as without them some are alike."""
