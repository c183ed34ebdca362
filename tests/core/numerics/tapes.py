"""Traced numbers on a tape, and what is noted there."""

from vstatics.core.numerics.tape import GUARDS, Residual, Tape
from vstatics.core.numerics.traced import Magnitude, Number, Traced

Bounds = tuple[float, float]


def traced(*values: float, bounds: Bounds | None = None) -> list[Traced]:
    """Traced numbers on one tape, with the same bounds for their magnitudes, or wide ones."""
    tape = Tape(len(values))
    return [
        Traced(
            tape,
            1 if value > 0 else -1,
            Magnitude(slot, abs(value), *(bounds or (abs(value) / 50, abs(value) * 50))),
        )
        for slot, value in enumerate(values)
    ]


def noted(number: Traced | Residual) -> list[tuple[str, object, object]]:
    return [operation[:3] for operation in number.tape.operations]


def names(number: Traced | Residual) -> list[str]:
    return [name for name, _, _ in noted(number)]


def guards(number: Traced | Residual) -> list[str]:
    return [name for name in names(number) if name in GUARDS]


def on_tape(number: Number | Residual) -> Traced:
    assert isinstance(number, Traced)
    return number
