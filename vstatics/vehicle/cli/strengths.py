"""Check of commands that report fatigue damage."""

from __future__ import annotations

from vstatics.core.errors import Problem, ReadError
from vstatics.core.readers.reading import Reading


def expect_damage(reading: Reading) -> None:
    """Raise an error for a case without fatigue strength.

    Raises
    ------
    ReadError
    """
    if not reading.case.fatigue:
        message = "the case has no `fatigue`, expected data of a spring or another component"
        raise ReadError([reading.locate(Problem("E882", message))])
