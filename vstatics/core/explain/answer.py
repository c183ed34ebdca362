"""What `vstatics explain` answers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.explain.explanation import Explanation
from vstatics.core.tables.answer import document


@document("vstatics-explanation")
class ExplanationAnswer(NamedTuple):
    """Gears of a case explained, by its name."""

    case: str
    gears: Sequence[Explanation]
