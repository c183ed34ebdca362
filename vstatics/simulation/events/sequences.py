"""Sequences of steps: which is due, and what is watched until the next one is."""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import copy

from vstatics.core.errors import CaseError, Path
from vstatics.simulation.events.margins import Awaited
from vstatics.simulation.events.sides import Judge
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.parts import Scenario, SequenceStep, StepSequence

Happened = Callable[[Seen, float], bool]
"""Whether what a word says has happened since a time [s]."""


class SequenceProgress:
    """How far a sequence is."""

    def __init__(self, sequence: StepSequence) -> None:
        self.sequence = sequence
        self.index = 0
        self.since = 0.0
        """From when on the step is looked at. [s]"""
        self.true_at: float | None = None
        """When its condition was true first. [s]"""

    @property
    def step(self) -> SequenceStep | None:
        """The step that is next; None behind the last."""
        steps = self.sequence.steps
        return steps[self.index] if self.index < len(steps) else None

    @property
    def name(self) -> str:
        """The sequence, and the number of its step."""
        return f"{self.sequence.name}, step {self.index + 1}"

    @property
    def path(self) -> Path:
        """Of its step."""
        return "sequences", self.sequence.name, self.index + 1

    def next_time(self) -> float:
        """When it is looked at again, whatever happens before [s]."""
        step = self.step
        if step is None:
            return math.inf
        if self.true_at is None:
            return self.since + step.within
        return self.true_at + step.wait

    def is_due(self, time: float, judge: Judge, happened: Happened) -> bool:
        """Whether its step is to be done.

        Raises
        ------
        CaseError
            Of a condition that was not true in time, or compares what is no number.
        """
        step = self.step
        if step is None:
            return False
        if self.true_at is None and self._is_true(step, judge, happened):
            self.true_at = time
        if self.true_at is None and time >= self.since + step.within:
            message = (
                f"at {time:.9g} s the condition of sequence {self.name} is not true within "
                f"{step.within:g} s"
            )
            raise CaseError("E696", message, (*self.path, "within"))
        return self.true_at is not None and time >= self.true_at + step.wait

    def _is_true(self, step: SequenceStep, judge: Judge, happened: Happened) -> bool:
        if step.when is None:
            return True

        awaited = [judge.awaited(one) for one in step.when.comparisons]
        sides = [one.side + "=" * one.is_equal for one in awaited]
        if "?" in "".join(sides):
            message = f"at {judge.now.time:.9g} s what {self.name} compares is no number"
            raise CaseError("E650", message, (*self.path, "when"))
        return step.when.holds(sides, lambda seen: happened(seen, self.since))

    def go_on(self, time: float) -> int:
        """The step is done; its number."""
        self.index += 1
        done = self.index
        if self.sequence.repeat and self.step is None:
            self.index = 0
        self.since, self.true_at = time, None
        return done


class SequenceRun:
    """The sequences of a run.

    Parameters
    ----------
    scenario : Scenario
    """

    def __init__(self, scenario: Scenario) -> None:
        self.going = [SequenceProgress(one) for one in scenario.sequences]

    def copy(self) -> SequenceRun:
        """The same, which goes on by itself."""
        made = copy(self)
        made.going = [copy(one) for one in self.going]
        return made

    def next_time(self) -> float:
        """When one is looked at again, whatever happens before [s]."""
        return min((one.next_time() for one in self.going), default=math.inf)

    def due(self, time: float, judge: Judge, happened: Happened) -> SequenceProgress | None:
        """The first that has a step to be done."""
        return next((one for one in self.going if one.is_due(time, judge, happened)), None)

    def awaited(self, judge: Judge) -> list[tuple[int, Awaited]]:
        """What steps wait for: the number of a sequence, a comparison."""
        return [
            (number, judge.awaited(comparison))
            for number, one in enumerate(self.going)
            if one.true_at is None and one.step is not None and one.step.when is not None
            for comparison in one.step.when.comparisons
        ]
