"""Protocols of a simulated run and of events for pictures, and the labels of events."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

from vstatics.core.errors import printable
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.style import Style


class PicturedEvent(Protocol):
    """Event of a simulated run."""

    @property
    def time(self) -> float:
        """Time of the event in s."""

    @property
    def element(self) -> str:
        """Name of the component that the event concerns."""

    @property
    def event(self) -> str:
        """Kind of event, a key of `IMPORTANCE`."""

    @property
    def word(self) -> str:
        """Word for the event in labels; empty if the kind of event is the word."""

    @property
    def step(self) -> int | None:
        """Number of the step of a shift sequence, if the event is a step."""


class PicturedRun(Protocol):
    """Simulated run of a case over time, as needed for pictures."""

    @property
    def time(self) -> Floats:
        """Time of each instant, in s."""

    @property
    def links(self) -> Sequence[str]:
        """Names of the links in the columns of `speeds`."""

    @property
    def speeds(self) -> Floats:
        """Speeds of links at each instant, in rad/s, shape (instants, links)."""

    @property
    def events(self) -> Sequence[PicturedEvent]:
        """Events in the order of time."""

    @property
    def case(self) -> Transmission | None:
        """Case that the run simulates."""


AnEvent = TypeVar("AnEvent", bound=PicturedEvent)
NAME_LETTERS = 40
"""Largest number of letters of a name in a label."""
IMPORTANCE = {"impact": 0, "locks": 1, "step": 2, "reverses": 3, "slips": 4}
"""Rank of each kind of event. Among simultaneous events, lower ranks get a label first."""


def short(name: str) -> str:
    """Return a name with printable letters only, cut to `NAME_LETTERS`.

    >>> short("C1"), short("a" * 50)
    ('C1', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…')
    """
    safe = printable(name)
    return safe if len(safe) <= NAME_LETTERS else f"{safe[: NAME_LETTERS - 1]}…"


def event_word(event: PicturedEvent, style: Style) -> str:
    """Return the word for an event, including the step number in a shift sequence.

    >>> from types import SimpleNamespace
    >>> event_word(SimpleNamespace(event="step", word="step", step=2), Style())
    'step 2'
    """
    word = event.word or event.event
    number = f" {event.step}" if event.step else ""
    return f"{style.text(word)}{number}"


def event_text(event: PicturedEvent, style: Style) -> str:
    """Return the label of an event: the name of the component, and the word for the event.

    >>> from types import SimpleNamespace
    >>> event_text(SimpleNamespace(element="C1", event="locks", word="", step=None), Style())
    'C1 locks'
    """
    return f"{short(event.element)} {event_word(event, style)}"


def named_events(events: Sequence[AnEvent], most: int) -> list[AnEvent]:
    """Return the events that get a label: all events, or the `most` important events."""
    if len(events) <= most:
        return list(events)
    first = sorted(range(len(events)), key=lambda place: (IMPORTANCE[events[place].event], place))
    return [events[place] for place in sorted(first[:most])]
