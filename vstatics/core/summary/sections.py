"""Interfaces for sections of a summary that annexes calculate."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from vstatics.core.errors import Problem, of_file
from vstatics.core.model.parts import Load
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid


class Section(Protocol):
    """Interface of a section: results of an annex about a case."""

    def grids(self) -> Iterable[Grid]:
        """Return the tables of the section."""


class CycleSection(Section, Protocol):
    """Interface of results over a duty cycle."""

    @property
    def efficiency(self) -> float:
        """Output energy divided by input energy over the cycle [-]."""

    @property
    def damage(self) -> Mapping[str, object]:
        """Damage of components by name."""

    @property
    def messages(self) -> Sequence[Message]:
        """Warnings about the cycle."""


class GivenCycle(Protocol):
    """Interface of a duty cycle."""

    @property
    def load(self) -> Load | None:
        """Operating point for a case that has none; None for a cycle without points."""

    def of(self, results: Results) -> CycleSection:
        """Return the results of a case over the cycle."""


class CycleOptions(Protocol):
    """Interface of the command-line options for a duty cycle."""

    @property
    def files(self) -> list[str]:
        """Names of the files to read."""

    def read(self) -> GivenCycle | None:
        """Return the duty cycle; None without options."""


def doubts(cycle: CycleSection | None, file: str) -> list[Problem]:
    """Return the warnings about the duty cycle of a case."""
    return [
        of_file(message.id, file, message.text) for message in (cycle.messages if cycle else ())
    ]
