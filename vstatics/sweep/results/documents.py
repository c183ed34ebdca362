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
    """Outcome of the simulated run of a variant."""

    status: int
    """Status of the variant, an index into `chunk.STATUS`."""
    tables: Tables
    unknown: bool
    """True if the run has no results."""
    messages: Sequence[Message] = ()


class SweptDocument(VariedDocument):
    """Document whose variants are simulated runs, such as a scenario."""

    public_name: ClassVar[str] = "VariedScenario"
    """Public name of the class, for messages about arguments."""
    default_columns: ClassVar[str]
    """Columns of a sweep if --out is not given."""

    @property
    @abstractmethod
    def file(self) -> str:
        """Name of the file that contains the document."""

    @property
    @abstractmethod
    def case_file(self) -> str:
        """Name of the file that contains the document's case."""

    @abstractmethod
    def limited(self, seconds: float) -> Self:
        """Return the document with a time limit for each run [s]."""

    @abstractmethod
    def names(self, source: Excerpt, targets: Sequence[Varied]) -> NameFinder:
        """Return the finder of the meanings of names in an expression."""

    @abstractmethod
    def unit_of(self, table: str) -> str:
        """Return the unit of a table's values; "" for several units or an unknown unit."""

    @abstractmethod
    def asked(self, selections: Iterable[Selection]) -> list[tuple[str, str]]:
        """Return the tables and rows that expressions need and that not every run provides."""

    @abstractmethod
    def outcome(
        self, targets: Sequence[Varied], values: Floats, asked: Sequence[tuple[str, str]]
    ) -> RunOutcome:
        """Simulate a variant, and return the outcome."""

    @abstractmethod
    def reason(self, targets: Sequence[Varied], values: Sequence[float]) -> list[Problem]:
        """Return the reasons why a variant has no results."""

    @abstractmethod
    def seconds(self, tried: float) -> float:
        """Return the estimated time of a run [s]; 0 if the run ends within `tried` seconds."""


Subject: TypeAlias = Transmission | SweptDocument
