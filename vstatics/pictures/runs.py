"""A run as pictures show it, and the words for its events."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

from vstatics.core.errors import printable
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.style import Style


class PicturedEvent(Protocol):
    """An event of a run."""

    @property
    def time(self) -> float:
        """In s."""

    @property
    def element(self) -> str:
        """The name of whatever it happens to."""

    @property
    def event(self) -> str:
        """A key of `IMPORTANCE`."""

    @property
    def word(self) -> str:
        """The usual word for it, if it has one."""

    @property
    def step(self) -> int | None:
        """The number of a step of a sequence."""


class PicturedRun(Protocol):
    """A run over time."""

    @property
    def time(self) -> Floats:
        """Instants, in s."""

    @property
    def links(self) -> Sequence[str]:
        """Names of the columns of `speeds`."""

    @property
    def speeds(self) -> Floats:
        """Of links at each instant, in rad/s."""

    @property
    def events(self) -> Sequence[PicturedEvent]:
        """In the order of their times."""

    @property
    def case(self) -> Transmission | None:
        """The case that moves."""


AnEvent = TypeVar("AnEvent", bound=PicturedEvent)
NAME_LETTERS = 40
"""Letters of a name."""
IMPORTANCE = {"impact": 0, "locks": 1, "step": 2, "reverses": 3, "slips": 4}
"""Event -> its place among the events of an instant that get a label."""


def short(name: str) -> str:
    """A name that fits into a margin, whoever wrote it.

    >>> short("C1"), short("a" * 50)
    ('C1', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…')
    """
    safe = printable(name)
    return safe if len(safe) <= NAME_LETTERS else f"{safe[: NAME_LETTERS - 1]}…"


def event_word(event: PicturedEvent, style: Style) -> str:
    """What happens, where it stands beside the name.

    >>> from types import SimpleNamespace
    >>> event_word(SimpleNamespace(event="step", word="step", step=2), Style())
    'step 2'
    """
    word = event.word or event.event
    number = f" {event.step}" if event.step else ""
    return f"{style.text(word)}{number}"


def event_text(event: PicturedEvent, style: Style) -> str:
    """What happens to what.

    >>> from types import SimpleNamespace
    >>> event_text(SimpleNamespace(element="C1", event="locks", word="", step=None), Style())
    'C1 locks'
    """
    return f"{short(event.element)} {event_word(event, style)}"


def named_events(events: Sequence[AnEvent], most: int) -> list[AnEvent]:
    """The events that get a label: all, or of many impacts and ends of slip before others."""
    if len(events) <= most:
        return list(events)
    first = sorted(range(len(events)), key=lambda place: (IMPORTANCE[events[place].event], place))
    return [events[place] for place in sorted(first[:most])]
