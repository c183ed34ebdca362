"""What a command does with each of its cases."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from vstatics.cli import texts
from vstatics.cli.cases import CalculatedCase, CaseOptions

if TYPE_CHECKING:
    from vstatics.jobs.finished_cases import FinishedCases


class Job(NamedTuple):
    """How each case is done."""

    command: str
    """Whose it is."""
    options: CaseOptions
    form: texts.OutputForm
    show: Callable[[CalculatedCase], texts.CaseOutput]
    """What the command shows of a case that has results."""
    finished: FinishedCases | None = None
    """Of the directory that results go to, if they do."""
