"""Sequences of steps: next step of each, its condition, and the time at which it is due."""

from __future__ import annotations

import math
from collections.abc import Callable

from vstatics.core.errors import CaseError, Path
from vstatics.simulation.events.margins import Awaited
from vstatics.simulation.events.sides import Judge
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.parts import SequenceStep, StepSequence

Happened = Callable[[Seen, float], bool]
"""Test whether a named event has happened since a time [s]."""


class SequenceProgress:
    """Progress of a sequence: next step, and time of the preceding step."""

    def __init__(self, sequence: StepSequence) -> None:
        self.sequence = sequence
        self.index = 0
        self.since = 0.0
        """Time at which the preceding step was finished. [s]"""
        self.true_at: float | None = None
        """Time at which the condition of the next step became true. [s]"""

    @property
    def step(self) -> SequenceStep | None:
        """Next step, if any."""
        steps = self.sequence.steps
        return steps[self.index] if self.index < len(steps) else None

    @property
    def name(self) -> str:
        """Name of the sequence with the number of the next step."""
        return f"{self.sequence.name}, step {self.index + 1}"

    @property
    def path(self) -> Path:
        """Path of the next step in the scenario."""
        return "sequences", self.sequence.name, self.index + 1

    def next_time(self) -> float:
        """Return the time at which the step is due or the condition is overdue [s]."""
        step = self.step
        if step is None:
            return math.inf
        if self.true_at is None:
            return self.since + step.within
        return self.true_at + step.wait

    def is_due(self, time: float, judge: Judge, happened: Happened) -> bool:
        """Return whether the next step is due at a time [s].

        Raises
        ------
        CaseError
            If the condition of the step is overdue, or compares a value that is not a number.
        """
        step = self.step
        if step is None:
            return False
        if self.true_at is None and self._is_true(step, judge, happened):
            self.true_at = time
        if self.true_at is None and time >= self.since + step.within:
            raise CaseError(
                "E696",
                f"at {time:.9g} s the condition of sequence {self.name} did not become true within "
                f"{step.within:g} s",
                (*self.path, "within"),
            )
        return self.true_at is not None and time >= self.true_at + step.wait

    def _is_true(self, step: SequenceStep, judge: Judge, happened: Happened) -> bool:
        if step.when is None:
            return True

        sides = [awaited.side + "=" * awaited.is_equal for awaited in self.awaited(judge)]
        if "?" in "".join(sides):
            raise CaseError(
                "E650",
                f"at {judge.now.time:.9g} s {self.name} compares a value that is not a number",
                (*self.path, "when"),
            )
        return step.when.holds(sides, lambda seen: happened(seen, self.since))

    def awaited(self, judge: Judge) -> list[Awaited]:
        """Return the comparisons in the condition of the next step; none if it is already true."""
        step = self.step
        if self.true_at is not None or step is None or step.when is None:
            return []
        return [judge.awaited(comparison) for comparison in step.when.comparisons]

    def go_on(self, time: float) -> int:
        """Advance to the next step, and return the number of the finished step."""
        self.index += 1
        done = self.index
        if self.sequence.repeat and self.step is None:
            self.index = 0
        self.since, self.true_at = time, None
        return done
