"""Dots of resonances: as large as the input takes part, as dark as they are little damped."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.style import Style
from vstatics.torsion.pictures.orders.resonances import Meeting

LARGEST_DOT, LEAST_DOT = 6.0, 1.6
"""Of a participation of 1, and of the least. [pt]"""
PER_DECADE = 1.4
"""By so much a dot is smaller at a tenth of the participation. [pt]"""
LITTLE_DAMPED, MUCH_DAMPED = 0.02, 0.1
"""Damping ratios: dots are filled below the first, open from the second on."""


def dot_size(participation: float) -> float:
    """The diameter of a dot [pt].

    >>> [round(dot_size(part), 1) for part in (1.0, 0.1, 0.01, 1e-6)]
    [6.0, 4.6, 3.2, 1.6]
    """
    return max(LARGEST_DOT + PER_DECADE * math.log10(participation), LEAST_DOT)


def dot_fill(damping_ratio: float, colour: str, style: Style) -> str:
    """What a dot is filled with."""
    if damping_ratio >= MUCH_DAMPED:
        return style.paper
    return style.faint if damping_ratio >= LITTLE_DAMPED else colour


def dot_look(met: Meeting, style: Style) -> Look:
    """The dot of a resonance, in the colour of its order."""
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
    """What sizes and fills mean, of those that occur."""
    if not met:
        return
    rates = [one.mode.damping_ratio for one in met]
    least = min(one.mode.participation for one in met)
    is_damped = any(rates)
    full = "resonance, participation of the input 1"
    yield (True, full, _look(1.0, 0.0, style, fires=False))
    for part in (0.1, 0.01):
        yield (least < 5 * part, f"{part:g}", _look(part, 0.0, style, fires=False))
    for occurs, rate, english in (
        (
            any(one < LITTLE_DAMPED for one in rates),
            0.0,
            style.text("damping ratio below {ratio:g}", ratio=LITTLE_DAMPED),
        ),
        (
            any(LITTLE_DAMPED <= one < MUCH_DAMPED for one in rates),
            LITTLE_DAMPED,
            style.text("damping ratio to {ratio:g}", ratio=MUCH_DAMPED),
        ),
        (
            any(one >= MUCH_DAMPED for one in rates),
            MUCH_DAMPED,
            style.text("damping ratio from {ratio:g} on", ratio=MUCH_DAMPED),
        ),
    ):
        look = _look(0.3, rate, style, fires=False)
        yield (is_damped and occurs, english, look)
