"""Dots at resonances: their size shows the participation of the input, their fill the damping.

The participation is the amplitude of the input divided by the largest amplitude of the mode.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.style import Style
from vstatics.torsion.pictures.orders.resonances import Meeting

LARGEST_DOT, LEAST_DOT = 6.0, 1.6
"""Diameter of a dot at a participation of 1, and smallest diameter. [pt]"""
PER_DECADE = 1.4
"""Decrease of the diameter per power of ten in the participation. [pt]"""
LITTLE_DAMPED, MUCH_DAMPED = 0.02, 0.1
"""Damping ratio below which a dot is filled, and from which it is open."""


def dot_size(participation: float) -> float:
    """Return the diameter of a dot [pt].

    >>> [round(dot_size(part), 1) for part in (1.0, 0.1, 0.01, 1e-6)]
    [6.0, 4.6, 3.2, 1.6]
    """
    return max(LARGEST_DOT + PER_DECADE * math.log10(participation), LEAST_DOT)


def dot_fill(damping_ratio: float, colour: str, style: Style) -> str:
    """Return the fill of a dot: the colour of its order, a paler colour, or the colour of paper."""
    if damping_ratio >= MUCH_DAMPED:
        return style.paper
    return style.faint if damping_ratio >= LITTLE_DAMPED else colour


def dot_look(met: Meeting, style: Style) -> Look:
    """Return the style of the dot at a resonance, in the colour of its order."""
    return _look(met.mode.participation, met.mode.damping_ratio, style, fires=met.order.fires)


def _look(participation: float, damping_ratio: float, style: Style, *, fires: bool) -> Look:
    colour = style.engaged if fires else style.ink
    return {
        "color": colour,
        "marker": "o",
        "markersize": dot_size(participation),
        "markeredgewidth": 0.8,
        "markerfacecolor": dot_fill(damping_ratio, colour, style),
        "markeredgecolor": colour,
        "zorder": 4,
    }


def dot_signs(met: Sequence[Meeting], style: Style) -> Iterator[Meaning]:
    """Yield the legend entries of the sizes and fills that occur."""
    if not met:
        return
    ratios = [meeting.mode.damping_ratio for meeting in met]
    least = min(meeting.mode.participation for meeting in met)
    is_damped = any(ratios)
    full = "resonance, participation of the input 1"
    yield (True, full, _look(1.0, 0.0, style, fires=False))
    for part in (0.1, 0.01):
        yield (least < 5 * part, f"{part:g}", _look(part, 0.0, style, fires=False))
    for low, high, text in (
        (
            -math.inf,
            LITTLE_DAMPED,
            style.text("damping ratio below {ratio:g}", ratio=LITTLE_DAMPED),
        ),
        (LITTLE_DAMPED, MUCH_DAMPED, style.text("damping ratio to {ratio:g}", ratio=MUCH_DAMPED)),
        (MUCH_DAMPED, math.inf, style.text("damping ratio from {ratio:g} on", ratio=MUCH_DAMPED)),
    ):
        occurs = any(low <= ratio < high for ratio in ratios)
        yield (is_damped and occurs, text, _look(0.3, low, style, fires=False))
