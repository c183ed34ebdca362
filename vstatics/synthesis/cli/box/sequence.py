"""Options for gears without given ratios: their number, ratio spread and step ratios."""

from __future__ import annotations

from functools import partial

from vstatics.core.cli.shared.options import refuse
from vstatics.synthesis.boxes.box import ANY_QUOTIENT, WantedSequence
from vstatics.synthesis.cli.values import pair

ends = partial(pair, example="1.2:1.8")
"""Parser of two numbers separated by a colon."""


def gear_counts(text: str) -> tuple[int, int]:
    """Read the smallest and largest number of gears. A single number means both.

    >>> gear_counts("6:8"), gear_counts("6")
    ((6, 8), (6, 6))
    """
    parts = text.split(":")
    if len(parts) > 2 or not all(part.strip().isdecimal() for part in parts):
        raise ValueError("expected how many, such as 6:8")
    return int(parts[0]), int(parts[-1])


def wanted_sequence(
    gears_wanted: tuple[int, int] | None,
    spread: tuple[float, float] | None,
    steps: tuple[float, float] | None,
    *,
    falling: bool,
) -> WantedSequence | None:
    """Return the gears that are wanted in addition to --ratios.

    Raises
    ------
    UsageError

    Examples
    --------
    >>> wanted_sequence((6, 8), (5.0, 7.0), None, falling=True).steps
    (1.0, 1000000.0)
    """
    has_details = spread is not None or steps is not None or falling
    alone = "--spread, --step-ratios, --falling describe --gears: expected --gears A:B"
    refuse((has_details and gears_wanted is None, alone))
    if gears_wanted is None:
        return None
    return WantedSequence(*gears_wanted, spread or ANY_QUOTIENT, steps or ANY_QUOTIENT, falling)
