"""Interface of documents other than cases that can be swept, such as scenarios."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from typing import ClassVar, NamedTuple, Self, TypeAlias

from vstatics.core.errors import Problem
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.statics.result_arrays import Message
from vstatics.sweep.results.meanings import NameFinder, Selection, Tables
from vstatics.sweep.variants.subject import VariedDocument
from vstatics.sweep.variants.targets import Varied


class RunOutcome(NamedTuple):
    """Outcome of the run of a variant."""

    status: int
    """Index into `chunk.STATUS`."""
    tables: Tables
    unknown: bool
    """True if the tables have no numbers."""
    messages: Sequence[Message] = ()


class SweptDocument(VariedDocument):
    """A document whose variants are runs, such as a scenario."""

    public_name: ClassVar[str] = "VariedScenario"
    """Name of the class in messages about arguments."""
    default_columns: ClassVar[str]
    """Columns of a sweep without --out."""

    @property
    @abstractmethod
    def file(self) -> str:
        """Name of the file of the document."""

    @property
    @abstractmethod
    def case_file(self) -> str:
        """Name of the file of the case."""

    @abstractmethod
    def limited(self, seconds: float) -> Self:
        """Return the document with a time limit for each run [s]."""

    @abstractmethod
    def names(self, source: Excerpt, targets: Sequence[Varied]) -> NameFinder:
        """Return the finder of the names in an expression."""

    @abstractmethod
    def unit_of(self, table: str) -> str:
        """Return the unit of a table, or "" for several or unknown units."""

    @abstractmethod
    def asked(self, selections: Iterable[Selection]) -> list[tuple[str, str]]:
        """Return the tables and rows that expressions need in addition to the usual ones."""

    @abstractmethod
    def outcome(
        self, targets: Sequence[Varied], values: Floats, asked: Sequence[tuple[str, str]]
    ) -> RunOutcome:
        """Calculate a variant."""

    @abstractmethod
    def reason(self, targets: Sequence[Varied], values: Sequence[float]) -> list[Problem]:
        """Return the problems of a variant without numbers."""

    @abstractmethod
    def seconds(self, tried: float) -> float:
        """Return the estimated time of a run after a trial of limited time; 0 if it completed."""


Subject: TypeAlias = Transmission | SweptDocument
