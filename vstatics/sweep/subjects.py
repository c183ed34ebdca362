"""What a sweep is of: a case, or a scenario."""

from __future__ import annotations

from typing import TypeAlias

from vstatics.errors import Place
from vstatics.model.transmission import Transmission
from vstatics.sweep.scenario import VariedScenario
from vstatics.sweep.targets import Varied, target

Subject: TypeAlias = Transmission | VariedScenario


def target_of(text: str, subject: Subject, place: Place | None = None) -> Varied:
    """The number that a text speaks of; parameters and errors as of `targets.target`."""
    if isinstance(subject, Transmission):
        return target(text, subject, place)
    return subject.target(text, place)
