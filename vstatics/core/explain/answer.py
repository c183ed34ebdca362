"""Record that `vstatics explain` writes as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.explain.explanation import Explanation
from vstatics.core.tables.answer import document


@document("vstatics-explanation")
class ExplanationAnswer(NamedTuple):
    """Explanations of the gears of a case."""

    case: str
    gears: Sequence[Explanation]
