"""What happens in a run: which events are named in its pictures, and how."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.errors import printable
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import LEADER_WIDTH, Style
from vstatics.simulation.record.motion import Event

MOST_NAMED_EVENTS = 24
"""Events that are named."""
NAME_LETTERS = 40
"""Letters of a name."""


EVENTS_IN_RUSSIAN = {
    "locks": "замыкается",
    "slips": "буксует",
    "reverses": "меняет знак скольжения",
    "impact": "удар",
    "opens": "выключается",
    "closes": "включается",
    "overruns": "обгоняет",
    "starts": "трогается",
    "step": "шаг",
}
"""Kinds of events, and other words for them."""


def short(name: str) -> str:
    """A name that fits into a margin, whoever wrote it.

    >>> short("C1"), short("a" * 50)
    ('C1', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…')
    """
    safe = printable(name)
    return safe if len(safe) <= NAME_LETTERS else f"{safe[: NAME_LETTERS - 1]}…"


def event_text(event: Event, style: Style) -> str:
    """What happens.

    >>> event_text(Event(0.3, "C1", "locks"), Style())
    'C1 locks'
    >>> event_text(Event(0.3, "up", "step", None, None, 2), Style())
    'up step 2'
    """
    word = event.word or event.event
    number = f" {event.step}" if event.step else ""
    return f"{short(event.element)} {style.text(word, EVENTS_IN_RUSSIAN[word])}{number}"


def named_events(events: Sequence[Event], most: int) -> list[Event]:
    """The events that get a label: all, or of many impacts and ends of slip before others."""
    if len(events) <= most:
        return list(events)
    order = {"impact": 0, "locks": 1, "step": 2, "reverses": 3, "slips": 4}
    first = sorted(range(len(events)), key=lambda place: (order[events[place].event], place))
    return [events[place] for place in sorted(first[:most])]


def draw_events(pen: Pen, events: Sequence[Event]) -> None:
    """A vertical at each event."""
    times = [pen.across(time) for time in sorted({event.time for event in events})]
    pieces = [((x, 0.0), (x, pen.size[1])) for x in times]
    pen.lines(pieces, color=pen.style.faint, width=LEADER_WIDTH, zorder=0.5)
