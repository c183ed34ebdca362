"""Documents that are swept: what an expression can speak of, and what becomes of a variant."""

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
    """Whether the tables have no numbers."""
    messages: Sequence[Message] = ()


class SweptDocument(VariedDocument):
    """A document whose variants are runs."""

    public_name: ClassVar[str] = "VariedScenario"
    """Name of the class in messages about arguments."""
    default_columns: ClassVar[str]
    """Columns where none are asked for."""

    @property
    @abstractmethod
    def file(self) -> str:
        """Name of the file of the document."""

    @property
    @abstractmethod
    def case_file(self) -> str:
        """Name of the file of its case."""

    @abstractmethod
    def limited(self, seconds: float) -> Self:
        """Return the document with runs that take at most so long."""

    @abstractmethod
    def names(self, source: Excerpt, targets: Sequence[Varied]) -> NameFinder:
        """Return who knows the names in an expression."""

    @abstractmethod
    def unit_of(self, table: str) -> str:
        """Return the unit of a table; nothing if it has none, or several."""

    @abstractmethod
    def asked(self, selections: Iterable[Selection]) -> list[tuple[str, str]]:
        """Return tables and rows of a run that expressions ask for, and no run has of itself."""

    @abstractmethod
    def outcome(
        self, targets: Sequence[Varied], values: Floats, asked: Sequence[tuple[str, str]]
    ) -> RunOutcome:
        """Calculate a variant."""

    @abstractmethod
    def reason(self, targets: Sequence[Varied], values: Sequence[float]) -> list[Problem]:
        """Return why a variant has no numbers; nothing if it has numbers."""

    @abstractmethod
    def seconds(self, tried: float) -> float:
        """Return how long a run takes, after a trial of so many seconds; 0 if it is done soon."""


Subject: TypeAlias = Transmission | SweptDocument
