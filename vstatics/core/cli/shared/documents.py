"""Recognition of documents that annexes (optional packages) declare, such as scenarios."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol, Self

from vstatics.core.annexes import DOCUMENTS, document_kind, module, not_installed
from vstatics.core.errors import Problem, of_file
from vstatics.core.readers.kinds import KEYS, is_of_kind
from vstatics.core.readers.reading import Reading

NO_TEXTS: Mapping[str, bytes] = {}


class DocumentOfCase(Protocol):
    """Interface of a document that names a case, such as a scenario."""

    @property
    def name(self) -> str:
        """Name in the document; empty if missing."""

    @property
    def description(self) -> str:
        """Description in the document."""

    @property
    def reading(self) -> Reading:
        """Case that the document names."""

    @property
    def input_speeds(self) -> tuple[float, ...]:
        """Input speeds in the document [rpm]."""

    def allowing(self, ids: Sequence[str]) -> Self:
        """Return the document with further ids of suppressed messages."""

    def locate(self, problem: Problem) -> Problem:
        """Return a problem of the document or the case with its place in the file."""


def is_a(kind: str, data: bytes, name: str) -> bool:
    """Return whether a text is a document of a kind, such as `scenario`.

    >>> is_a("scenario", b"{case: box.yaml, duration: 6}", "up.yaml")
    True
    """
    if not any(mark in data for mark in DOCUMENTS[kind][1]):
        return False
    if kind in KEYS:
        return is_of_kind(kind, data, name)
    record = document_kind(kind)
    return record is None or bool(module(record.functions["is_document"]).is_document(data))


def no_case(data: bytes, name: str, taken: str = "") -> list[Problem]:
    """Return problems, if a command cannot use a document as a case.

    Documents can be used if their annex declares a function `taken` for their kind.
    """
    problems = []
    for kind, (annex, _) in DOCUMENTS.items():
        if is_a(kind, data, name):
            record = document_kind(kind)
            if record is None:
                problems.append(of_file("E004", name, not_installed(kind, annex)))
            elif taken not in record.functions:
                problems.append(of_file("E004", name, record.note))
    return problems
