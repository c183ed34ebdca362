"""Protocols of a run and of events for pictures, and labels of events."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

from vstatics.core.errors import printable
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.style import Style


class PicturedEvent(Protocol):
    """Event of a run."""

    @property
    def time(self) -> float:
        """Time of the event in s."""

    @property
    def element(self) -> str:
        """Name of the part that the event concerns."""

    @property
    def event(self) -> str:
        """Key of `IMPORTANCE`."""

    @property
    def word(self) -> str:
        """Word for the event in labels; empty if the word is the key of the event."""

    @property
    def step(self) -> int | None:
        """Number of the step of a sequence."""


class PicturedRun(Protocol):
    """Run over time."""

    @property
    def time(self) -> Floats:
        """Instants, in s."""

    @property
    def links(self) -> Sequence[str]:
        """Names of the columns of `speeds`."""

    @property
    def speeds(self) -> Floats:
        """Speeds of links at each instant, in rad/s."""

    @property
    def events(self) -> Sequence[PicturedEvent]:
        """Events in the order of time."""

    @property
    def case(self) -> Transmission | None:
        """The case that moves."""


AnEvent = TypeVar("AnEvent", bound=PicturedEvent)
NAME_LETTERS = 40
"""Largest number of letters of a name in a label."""
IMPORTANCE = {"impact": 0, "locks": 1, "step": 2, "reverses": 3, "slips": 4}
"""Ranks of events by their keys; of simultaneous events, lower ranks get a label first."""


def short(name: str) -> str:
    """Return a printable name, cut to fit a margin.

    >>> short("C1"), short("a" * 50)
    ('C1', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…')
    """
    safe = printable(name)
    return safe if len(safe) <= NAME_LETTERS else f"{safe[: NAME_LETTERS - 1]}…"


def event_word(event: PicturedEvent, style: Style) -> str:
    """Return the word for an event; for a step of a sequence, with its number.

    >>> from types import SimpleNamespace
    >>> event_word(SimpleNamespace(event="step", word="step", step=2), Style())
    'step 2'
    """
    word = event.word or event.event
    number = f" {event.step}" if event.step else ""
    return f"{style.text(word)}{number}"


def event_text(event: PicturedEvent, style: Style) -> str:
    """Return the label of an event: the name of the part and the word.

    >>> from types import SimpleNamespace
    >>> event_text(SimpleNamespace(element="C1", event="locks", word="", step=None), Style())
    'C1 locks'
    """
    return f"{short(event.element)} {event_word(event, style)}"


def named_events(events: Sequence[AnEvent], most: int) -> list[AnEvent]:
    """Return the events that get a label; if there are more than `most`, the most important."""
    if len(events) <= most:
        return list(events)
    first = sorted(range(len(events)), key=lambda place: (IMPORTANCE[events[place].event], place))
    return [events[place] for place in sorted(first[:most])]
