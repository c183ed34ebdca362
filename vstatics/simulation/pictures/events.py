"""Words such as "locks" at the events in pictures of a run, and their positions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.labels import LABEL_GAP, spread, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, Style
from vstatics.pictures.runs import IMPORTANCE, event_word
from vstatics.simulation.record.motion import Event

MOST_ROW_EVENTS = 80
"""Largest number of events of a row for which words are placed."""
FAR_WORD = 26.0
"""Largest distance from an event to its word. [pt]"""


class EventWord(NamedTuple):
    """Word at an event in the row of a component."""

    event: Event
    text: str
    at: float
    """Position of the event, from the left end of the row. [pt]"""
    middle: float
    """Position of the centre of the word. [pt]"""


def placed_words(
    events: Sequence[tuple[Event, float]], room: float, style: Style
) -> list[EventWord]:
    """Place words at the events of a row without overlap, most important events first.

    Parameters
    ----------
    events : sequence of (Event, float)
        Events with their positions along the row. [pt]
    room : float
        Length of the row. [pt]

    Examples
    --------
    >>> events = [(Event(float(n), "C", "slips"), 2.0 * n) for n in range(20)]
    >>> len(placed_words(events[:2], 100.0, Style())), len(placed_words(events, 100.0, Style())) < 5
    (2, True)
    """
    texts = [event_word(event, style) for event, _ in events]
    first_step = next((n for n, (event, _) in enumerate(events) if event.step), None)
    for n, (event, _) in enumerate(events):
        if event.step and n != first_step:  # the first step of the row names the sequence
            texts[n] = str(event.step)
    sizes = [width(text) + 2 * LABEL_GAP for text in texts]
    order = sorted(range(len(events)), key=lambda n: (IMPORTANCE[events[n][0].event], n))
    placed: list[int] = []
    middles: list[float] = []
    for n in order[:MOST_ROW_EVENTS]:
        candidates = sorted([*placed, n])
        wanted = [events[place][1] for place in candidates]
        spread_out = spread(wanted, [sizes[place] for place in candidates], 0.0, room)
        fits = spread_out[-1] + sizes[candidates[-1]] / 2 <= room + LABEL_GAP
        if fits and all(
            # a word at the left or right end of the row is shifted inwards
            abs(x - at) <= FAR_WORD + max(size / 2 - at, at + size / 2 - room, 0.0)
            for x, at, size in zip(
                spread_out, wanted, (sizes[place] for place in candidates), strict=True
            )
        ):
            placed, middles = candidates, spread_out
    return [
        EventWord(events[n][0], texts[n], events[n][1], x)
        for n, x in zip(placed, middles, strict=True)
    ]


def draw_verticals(pen: Pen, times: Iterable[float]) -> None:
    """Draw a vertical line at each time [s]."""
    places = [pen.across(time) for time in sorted({*times})]
    pieces = [((x, 0.0), (x, pen.size[1])) for x in places]
    pen.lines(pieces, color=pen.style.faint, width=LEADER_WIDTH, zorder=0.45)
