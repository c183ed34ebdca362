"""Output of a command in any format, for a single case or several cases.

A command supplies a `CaseOutput`, from which this module creates the text in any format. Writers
are imported only when needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.named_tuple import NamedTuple
from vstatics.core.texts import speaking

if TYPE_CHECKING:
    from vstatics.core.errors import Problem
    from vstatics.core.jobs.finished_cases import FinishedCases
    from vstatics.core.statics.results import Results
    from vstatics.core.tables.answer import Answer
    from vstatics.core.tables.grid import Grid


class CaseOutput(NamedTuple):
    """Output of a command for a case. Functions calculate what the format needs."""

    titles: Sequence[str]
    """Titles above the tables."""
    by_format: Mapping[str, Callable[[str | None], str | bytes | Sequence[bytes]]]
    """Functions that return output other than `grids`, such as a text, by format.

    The argument is the name of the case's file in a stream of several cases, else None. A picture
    consists of pages for separate files.
    """
    grids: Callable[[], Iterable[Grid]] | None = None
    answer: Callable[[], Answer] | None = None
    """Function that returns the record for JSON."""
    lay_out: Callable[[Any], str] | None = None
    """Function that converts the record to JSON with special line breaks."""
    problems: Sequence[Problem] = ()
    """Problems of the output, in addition to the problems of the case."""


class CaseTables(NamedTuple):
    """Tables of a case."""

    file: str
    titles: Sequence[str]
    grids: list[Grid]


Part = bytes | CaseTables
"""Output of a case in a stream of several cases: text or tables."""


class Frame(NamedTuple):
    """Texts before, between and after the outputs of cases in a stream."""

    first: str
    between: str
    last: str
    empty: str = ""
    """Complete text of a stream without output of any case."""


FRAMES = {
    "text": Frame("", "\n", ""),
    "listing": Frame("", "\n", ""),
    "json": Frame("[\n", ",\n", "\n]\n", "[]\n"),
    "jsonl": Frame("", "", ""),
}


def alone(file: str, shown: CaseOutput, to: Destination) -> Sequence[bytes]:
    """Return the text of a single case, or the pages of a picture."""
    with speaking(to.language):
        if to.form in shown.by_format:
            return _pages(shown, to)
        if to.form in ("json", "jsonl"):
            return [_bytes(_json(file, shown, to), to)]
        return [b"".join(_of_grids([_tables(file, shown, to)], to, several=False))]


def _pages(shown: CaseOutput, to: Destination, file: str | None = None) -> Sequence[bytes]:
    output = shown.by_format[to.form](file)
    return [_bytes(output, to)] if isinstance(output, str | bytes) else output


def among_several(
    outcome: CalculatedCase, shown: CaseOutput | None, to: Destination, *, folders: bool = False
) -> Part:
    """Return the output of a case in a stream of several cases. Only JSON includes failed cases.

    Parameters
    ----------
    folders : bool
        True if file names in JSON have folders.
    """
    file = outcome.file
    if to.form in ("json", "jsonl"):
        if shown is None:
            from vstatics.core.tables.answer import failure

            shown = CaseOutput([], {}, answer=partial(failure, file, outcome.problems))
        text = _json(file, shown, to, folders=folders)
        return _bytes(text.rstrip("\n") if to.form == "json" else text, to)
    if shown is None:
        return b""
    with speaking(to.language):
        if to.form in shown.by_format:
            output = b"".join(_pages(shown, to, file))
        elif to.is_text:
            [output] = alone(file, shown, to)
        else:
            return _tables(file, shown, to)
    return (_bytes(f"==> {file} <==\n", to) if to.is_text else b"") + output


def joined(
    parts: Iterable[Part], to: Destination, frame_of_command: Frame | None = None
) -> Iterator[bytes]:
    """Yield the output of a command in pieces: the outputs of all cases that are not empty."""
    if to.form == "parquet":
        from vstatics.core.writers import result_parquet

        yield from result_parquet.joined(part for part in parts if isinstance(part, bytes))
        return
    frame = frame_of_command or FRAMES.get(to.form)
    if frame is None:
        tables = (part for part in parts if isinstance(part, CaseTables))
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
    """Yield the tables of cases in a format that contains only tables."""
    by_file = ((case.file, case.grids) for case in cases)
    if to.form == "xlsx":
        from vstatics.core.tables import xlsx

        yield xlsx.write(by_file, several=several, digits=to.style.digits)
    elif to.form == "csv":
        from vstatics.core.tables import csv

        for text in csv.write(by_file, several=several, raw=to.style.raw):
            yield _bytes(text, to)
    else:
        from vstatics.core.tables import latex, markdown
        from vstatics.core.tables import text as plain

        writer = {"latex": latex, "markdown": markdown}.get(to.form, plain)
        for number, case in enumerate(cases):
            with speaking(to.language):
                page = writer.write(case.titles, case.grids)
            yield _bytes("\n" * bool(number) + page, to)


def _json(file: str, shown: CaseOutput, to: Destination, *, folders: bool = False) -> str:
    """Return the output of a case as JSON, on one or several lines, with a final line break."""
    from vstatics.core.tables.answer import as_json, with_file

    assert shown.answer is not None  # noqa: S101 - the command has this format
    document = with_file(shown.answer(), file, folders=folders)
    if to.form == "json" and shown.lay_out:
        return shown.lay_out(document) + "\n"
    return as_json(document, to.form)


def _bytes(text: str | bytes, to: Destination) -> bytes:
    """Return a text in UTF-8, with unsafe characters escaped except in CSV."""
    return text if isinstance(text, bytes) else files.encoded(text, as_is=to.form == "csv")


class Job(NamedTuple):
    """Command with its options, which is applied to each case."""

    command: str
    """Name of the command."""
    options: CaseOptions
    to: Destination
    show: Callable[[CalculatedCase, Results], CaseOutput]
    """Function that returns the output of the command for a case with results."""
    own_frame: Frame | None = None
    """Frame of the command for several cases, instead of the frame of the format in `FRAMES`."""
    finished: FinishedCases | None = None
    """Record of finished results, if results are written to a directory."""
    marked: bool = False
    """True to store the output of each case for `--resume`, with hashes of the case's files."""
    folders: bool = False
    """True if file names in JSON have folders, because some names are equal."""
