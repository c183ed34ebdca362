"""What happens in a run: which events are named in its pictures, how, and where."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.labels import LABEL_GAP, spread, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, Style
from vstatics.pictures.runs import IMPORTANCE, event_word
from vstatics.simulation.record.motion import Event

MOST_ROW_EVENTS = 80
"""Events of a row that are tried for a word."""
FAR_WORD = 26.0
"""A word stands no farther from its event than this. [pt]"""


class EventWord(NamedTuple):
    """A word beside the row of what it happens to."""

    event: Event
    text: str
    at: float
    """Of the event, from the left end of the row. [pt]"""
    middle: float
    """Of the word. [pt]"""


def placed_words(
    events: Sequence[tuple[Event, float]], room: float, style: Style
) -> list[EventWord]:
    """Words of events of one row, none over another: as many as stand near their events.

    Parameters
    ----------
    events : sequence of (Event, float)
        With their places. [pt]
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
        if event.step and n != first_step:  # the row says of which sequence
            texts[n] = str(event.step)
    sizes = [width(text) + 2 * LABEL_GAP for text in texts]
    order = sorted(range(len(events)), key=lambda n: (IMPORTANCE[events[n][0].event], n))
    kept: list[int] = []
    middles: list[float] = []
    for n in order[:MOST_ROW_EVENTS]:
        tried = sorted([*kept, n])
        wanted = [events[place][1] for place in tried]
        found = spread(wanted, [sizes[place] for place in tried], 0.0, room)
        fits = found[-1] + sizes[tried[-1]] / 2 <= room + LABEL_GAP
        if fits and all(
            abs(x - at) <= _reach(at, size, room)
            for x, at, size in zip(found, wanted, (sizes[place] for place in tried), strict=True)
        ):
            kept, middles = tried, found
    return [
        EventWord(events[n][0], texts[n], events[n][1], x)
        for n, x in zip(kept, middles, strict=True)
    ]


def _reach(at: float, size: float, room: float) -> float:
    """How far a word may be from its event: farther at an end of the row."""
    beyond = max(size / 2 - at, at + size / 2 - room, 0.0)
    return FAR_WORD + beyond


def draw_verticals(pen: Pen, times: Iterable[float]) -> None:
    """A vertical at each time [s]."""
    places = [pen.across(time) for time in sorted({*times})]
    pieces = [((x, 0.0), (x, pen.size[1])) for x in places]
    pen.lines(pieces, color=pen.style.faint, width=LEADER_WIDTH, zorder=0.45)
