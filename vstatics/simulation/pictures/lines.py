"""Lines of a run over time, and the panels that have room for them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.line_styles import Look, link_looks, thing_look
from vstatics.pictures.drawing.style import Style

MOST_LINES = 6
"""Lines of a panel; with more there is a further one."""
LARGE_PEAK_RATIO = 20.0
"""Torques and energies whose largest values are so far apart have panels of their own."""
LARGE_PART = 0.5
"""With less of what an element can carry its capacity stays on the other side."""
PARTS_OF_TIME = 1500
"""Of so many parts of the time the ends and extremes are drawn."""


class MotionLine(NamedTuple):
    """A number over the time of a run."""

    names: tuple[str, ...]
    """Of one thing, or of links that always turn together."""
    values: Floats
    """In SI units."""
    links: tuple[int, ...] = ()
    """Their numbers, if they are links."""
    capacity: Floats | None = None
    """Of a shift element. [N*m]"""
    beside: str = ""
    """What tells it from another line of the same name."""

    @property
    def peak(self) -> float:
        """Its largest value, by magnitude."""
        return float(np.abs(self.values).max(initial=0.0))

    @property
    def labels(self) -> list[str]:
        """What is written beside it."""
        return [f"{name} ({self.beside})" if self.beside else name for name in self.names]

    def looks(self, style: Style, numbers: Mapping[str, int]) -> list[Look]:
        """Of each name: of links their own, of others by their numbers."""
        if self.links:
            return link_looks(self.links, style)
        return [thing_look(numbers[name], style) for name in self.names]


class MotionPanel(NamedTuple):
    """Lines to one scale."""

    kind: str
    """``data-panel`` of its group."""
    text: str
    """Of its scale."""
    unit: float
    """By what values are divided."""
    lines: tuple[MotionLine, ...]
    left_out: tuple[str, ...] = ()
    """Names of what has no line."""
    part: int = 1
    """Which of several panels of a kind."""
    others: tuple[MotionPanel, ...] = ()
    """Of another run, whose numbers its scale has room for, too."""

    def beside(self, others: Iterable[MotionPanel]) -> MotionPanel:
        """The same with a scale for the same things of another run, whatever their names are."""
        own = {name for line in self.lines for name in line.names}
        alike = [one for one in others if (one.kind, one.text) == (self.kind, self.text)]
        named = [one for one in alike if any(own.intersection(line.names) for line in one.lines)]
        found = named or [one for one in alike if one.part == self.part]
        return self._replace(others=tuple(found))


def panels_of(
    kind: str,
    text: str,
    unit: float,
    lines: Iterable[MotionLine],
    *,
    by_size: bool = False,
) -> list[MotionPanel]:
    """Panels of at most `MOST_LINES` lines: each line in the first that has room for it.

    Parameters
    ----------
    by_size : bool
        Where one line would hide another by its size, each gets a panel.

    Examples
    --------
    >>> lines = [MotionLine((str(n),), np.array([10.0**n])) for n in range(3)]
    >>> [len(one.lines) for one in panels_of("heat", "", 1.0, lines, by_size=True)]
    [2, 1]
    """
    found: list[list[MotionLine]] = []
    for line in (part for one in lines for part in _parts(one)):
        for panel in found:
            if sum(len(one.names) for one in panel) + len(line.names) > MOST_LINES:
                continue
            peaks = [one.peak for one in (*panel, line)]
            if not by_size or max(peaks) < LARGE_PEAK_RATIO * min(peaks):
                panel.append(line)
                break
        else:
            found.append([line])
    return [MotionPanel(kind, text, unit, tuple(one)) for one in found]


def _parts(line: MotionLine) -> list[MotionLine]:
    """A line with no more names than a panel has lines."""
    starts = range(0, len(line.names), MOST_LINES)
    return [
        line._replace(
            names=line.names[start : start + MOST_LINES],
            links=line.links[start : start + MOST_LINES],
        )
        for start in starts
    ]


def numbers_of(elements: Sequence[str], panels: Iterable[MotionPanel]) -> dict[str, int]:
    """The number of each thing but links, by which it has its colour in all panels.

    >>> numbers_of(["A", "B"], [MotionPanel("heat", "", 1.0, (MotionLine(("P1",), None),))])
    {'A': 0, 'B': 1, 'P1': 2}
    """
    others = (
        name for panel in panels for line in panel.lines if not line.links for name in line.names
    )
    return {name: number for number, name in enumerate(dict.fromkeys([*elements, *others]))}


def capacity_side(torques: Floats, capacity: Floats) -> Floats:
    """On which side of 0 a capacity is drawn: where the torque is, but where this is small.

    It changes the side only for a torque that is a large part of it; while it is 0 it may.

    >>> capacity_side(np.array([-1.0, 6.0, -1.0, 2.0, -9.0]), np.full(5, 10.0))
    array([ 1.,  1.,  1.,  1., -1.])
    """
    side = np.where(torques < 0, -1.0, 1.0)
    closed = np.r_[False, capacity > 0, False]
    for start, end in np.flatnonzero(np.diff(closed)).reshape(-1, 2).tolist():
        own = side[start:end].copy()
        pieces = [0, *(np.flatnonzero(np.diff(own)) + 1).tolist(), end - start]
        large = np.abs(torques[start:end]) > LARGE_PART * capacity[start:end]
        known = own[int(np.abs(torques[start:end]).argmax())]
        if large.any():
            known = own[int(large.argmax())]
        for first, last in pairwise(pieces):
            if large[first:last].any():
                known = own[first]
            side[start + first : start + last] = known
    return side


def thinned(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    """A line that looks the same, of fewer points: in each part of the time its ends and extremes.

    >>> time = np.linspace(0.0, 1.0, 100_001)
    >>> fewer, values = thinned(time, np.sin(1e4 * time))
    >>> len(fewer) < 7000, float(round(max(values), 4))
    (True, 1.0)
    """
    if len(time) <= 4 * PARTS_OF_TIME:
        return time, values
    edges = np.searchsorted(time, np.linspace(time[0], time[-1], PARTS_OF_TIME + 1)[:-1])
    starts = np.unique(edges)
    kept = {0, len(time) - 1}
    for start, end in zip(starts, [*starts[1:], len(time)], strict=True):
        part = values[start:end]
        kept |= {start, end - 1, start + int(part.argmin()), start + int(part.argmax())}
    places = sorted(kept)
    return time[places], values[places]
