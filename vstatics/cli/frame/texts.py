"""What a command shows of each of its cases, as text in each format: alone, or among several.

A command says by `CaseOutput` what it has; every format is made of that here. Writers are
imported when they are needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from vstatics.cli.frame import files
from vstatics.cli.frame.cases import CalculatedCase, CaseOptions
from vstatics.cli.frame.formats import TextStyle
from vstatics.tables.grid import Grid

if TYPE_CHECKING:
    from vstatics.jobs.finished_cases import FinishedCases


class CaseOutput(NamedTuple):
    """What there is to show of a case; nothing is made before it is asked for."""

    titles: Sequence[str]
    """Over tables."""
    by_format: Mapping[str, Callable[[str | None], str | bytes]]
    """What is no table of `grids`, by format: a text, say. It is given the file of the case
    where this is one of several in a stream."""
    grids: Callable[[], Iterable[Grid]] | None = None
    document: Callable[[], dict[str, Any]] | None = None
    """As plain data, without its file."""
    lay_out: Callable[[Any], str] | None = None
    """The lines of that in JSON, where they are not those of any data."""


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


class OutputForm(NamedTuple):
    """A format, and what it needs to know."""

    name: str
    style: TextStyle
    own_frame: Frame | None = None
    """Around several, in a format of the command's own other than text."""

    @property
    def is_text(self) -> bool:
        """Whether people read it as it is."""
        return self.name in ("text", "listing")


FRAMES = {
    "text": Frame("", "\n", ""),
    "listing": Frame("", "\n", ""),
    "json": Frame("[\n", ",\n", "\n]\n"),
    "jsonl": Frame("", "", ""),
}


def alone(outcome: CalculatedCase, shown: CaseOutput, form: OutputForm) -> bytes:
    """The text of a case by itself."""
    if form.name in shown.by_format:
        return _bytes(shown.by_format[form.name](None), form)
    if form.name in ("json", "jsonl"):
        return _bytes(_json(outcome, shown, form) + "\n" * (form.name == "json"), form)
    return b"".join(_of_grids([_tables(outcome, shown, form)], form, several=False))


def among_several(outcome: CalculatedCase, shown: CaseOutput | None, form: OutputForm) -> Part:
    """What a stream has of a case among several; one that failed is in JSON only."""
    if form.name in ("json", "jsonl"):
        return _bytes(_json(outcome, shown, form), form)
    if shown is None:
        return b""
    if form.name in shown.by_format:
        made = _bytes(shown.by_format[form.name](outcome.file), form)
    elif form.is_text:
        made = alone(outcome, shown, form)
    else:
        return _tables(outcome, shown, form)
    return (_bytes(f"==> {outcome.file} <==\n", form) if form.is_text else b"") + made


def joined(parts: Iterable[Part], form: OutputForm) -> Iterator[bytes]:
    """The parts of all cases as one text, piece by piece; empty ones are left out."""
    frame = form.own_frame or FRAMES.get(form.name)
    if frame is None:
        tables = (one for one in parts if isinstance(one, CaseTables))
        yield from _of_grids(tables, form, several=True)
        return
    before = frame.first
    for text in parts:
        if text and isinstance(text, bytes):
            yield _bytes(before, form) + text
            before = frame.between
    if before != frame.first:
        yield _bytes(frame.last, form)


def _tables(outcome: CalculatedCase, shown: CaseOutput, form: OutputForm) -> CaseTables:
    assert shown.grids is not None, form.name  # noqa: S101 - the command has this format
    grids = [grid.with_digits(form.style.digits) for grid in shown.grids()]
    return CaseTables(outcome.file, shown.titles, grids)


def _of_grids(cases: Iterable[CaseTables], form: OutputForm, *, several: bool) -> Iterator[bytes]:
    """Tables in a format that has nothing else."""
    if form.name == "xlsx":
        from vstatics.tables import xlsx

        by_file = ((one.file, one.grids) for one in cases)
        yield xlsx.write(by_file, several=several, digits=form.style.digits)
    elif form.name == "csv":
        from vstatics.tables import csv

        by_file = ((one.file, one.grids) for one in cases)
        for text in csv.write(by_file, several=several, raw=form.style.raw):
            yield _bytes(text, form)
    else:
        from vstatics.tables import latex, markdown
        from vstatics.tables import text as plain

        writer = {"latex": latex, "markdown": markdown}.get(form.name, plain)
        for number, one in enumerate(cases):
            yield _bytes("\n" * bool(number) + writer.write(one.titles, one.grids), form)


def _json(outcome: CalculatedCase, shown: CaseOutput | None, form: OutputForm) -> str:
    """A case in JSON: lines without the last end, or one line with it."""
    from vstatics.writers import plain_json

    if shown is None:
        from vstatics.writers.documents import failure

        document = failure(outcome.file, outcome.problems)
    else:
        assert shown.document is not None  # noqa: S101 - the command has this format
        document = shown.document()
    document = plain_json.with_file(document, outcome.file)
    if form.name == "jsonl":
        return plain_json.line(document)
    lay_out = shown.lay_out if shown is not None and shown.lay_out else plain_json.text
    return lay_out(document)


def _bytes(text: str | bytes, form: OutputForm) -> bytes:
    """Safe to print, but CSV, which has no escapes, is as it is."""
    return text if isinstance(text, bytes) else files.encoded(text, as_is=form.name == "csv")


class Job(NamedTuple):
    """How each case is done."""

    command: str
    """Whose it is."""
    options: CaseOptions
    form: OutputForm
    show: Callable[[CalculatedCase], CaseOutput]
    """What the command shows of a case that has results."""
    finished: FinishedCases | None = None
    """Of the directory that results go to, if they do."""
