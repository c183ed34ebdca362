"""Check for commands that report fatigue damage."""

from __future__ import annotations

from vstatics.core.errors import Problem, ReadError
from vstatics.core.readers.reading import Reading
from vstatics.vehicle.case.fatigue import Fatigue


def expect_damage(reading: Reading) -> None:
    """Raise an error if no component of a case has a fatigue strength.

    Raises
    ------
    ReadError
    """
    if not Fatigue.of(reading.case):
        message = "the case has no `fatigue` by `endurance`"
        message += ", expected data of a spring or another component"
        raise ReadError([reading.locate(Problem("E882", message))])
