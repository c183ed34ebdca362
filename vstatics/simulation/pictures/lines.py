"""Lines of a run over time, and the panels that contain them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.line_styles import link_looks, thing_look
from vstatics.pictures.drawing.style import Style

MOST_LINES = 6
"""Largest number of names in a panel; further lines get another panel."""
LARGE_PEAK_RATIO = 20.0
"""Ratio of the largest values of two lines from which the lines get separate panels."""
LARGE_PART = 0.5
"""Ratio of torque to capacity above which the capacity moves to the side of the torque."""
PARTS_OF_TIME = 1500
"""Number of equal time intervals in which a thinned line keeps its ends and extremes."""


class MotionLine(NamedTuple):
    """Quantity over time, drawn as a line."""

    names: tuple[str, ...]
    """Name of a component, or of links that always rotate together."""
    values: Floats
    """Values in SI units."""
    links: tuple[int, ...] = ()
    """Numbers of the links, if the line belongs to links."""
    capacity: Floats | None = None
    """Torque capacity of a shift element. [N*m]"""
    distinction: str = ""
    """Word that distinguishes two lines of equal name."""

    @property
    def peak(self) -> float:
        """Largest magnitude of the values."""
        return float(np.abs(self.values).max(initial=0.0))

    @property
    def labels(self) -> list[str]:
        """Labels at the end of the line: names, each with the distinguishing word."""
        return [f"{name} ({self.distinction})" if self.distinction else name for name in self.names]

    def looks(self, style: Style, numbers: Mapping[str, int]) -> list[Look]:
        """Return the line style of each name; for components `numbers` has their colours."""
        if self.links:
            return link_looks(self.links, style)
        return [thing_look(numbers[name], style) for name in self.names]


class MotionPanel(NamedTuple):
    """Lines in a panel with a common vertical scale."""

    kind: str
    """Kind of the panel, which is also the value of ``data-panel`` in the SVG group."""
    text: str
    """Title of the scale."""
    unit: float
    """Divisor that converts values in SI units to the unit of the scale."""
    lines: tuple[MotionLine, ...]
    left_out: tuple[str, ...] = ()
    """Names of links or components whose lines are left out."""
    part: int = 1
    """Number of the panel among the panels of equal kind, from 1."""
    others: tuple[MotionPanel, ...] = ()
    """Panels of other runs that the scale also covers."""

    def with_scale_of(self, others: Iterable[MotionPanel]) -> MotionPanel:
        """Return the panel with a scale that also covers matching panels of other runs."""
        names = {name for line in self.lines for name in line.names}
        alike = [panel for panel in others if (panel.kind, panel.text) == (self.kind, self.text)]
        named = [
            panel for panel in alike if any(names.intersection(line.names) for line in panel.lines)
        ]
        matching = named or [panel for panel in alike if panel.part == self.part]
        return self._replace(others=tuple(matching))


def panels_of(
    kind: str,
    text: str,
    unit: float,
    lines: Iterable[MotionLine],
    *,
    by_size: bool = False,
) -> list[MotionPanel]:
    """Divide lines into panels, each line into the first panel with room for it.

    Parameters
    ----------
    by_size : bool
        Separate lines of very different size, so that small lines do not appear flat.

    Examples
    --------
    >>> lines = [MotionLine((str(n),), np.array([10.0**n])) for n in range(3)]
    >>> [len(panel.lines) for panel in panels_of("heat", "", 1.0, lines, by_size=True)]
    [2, 1]
    """
    groups: list[list[MotionLine]] = []
    for line in (part for whole in lines for part in _parts(whole)):
        for panel in groups:
            if sum(len(member.names) for member in panel) + len(line.names) > MOST_LINES:
                continue
            peaks = [member.peak for member in (*panel, line)]
            if not by_size or max(peaks) < LARGE_PEAK_RATIO * min(peaks):
                panel.append(line)
                break
        else:
            groups.append([line])
    return [MotionPanel(kind, text, unit, tuple(group)) for group in groups]


def _parts(line: MotionLine) -> list[MotionLine]:
    starts = range(0, len(line.names), MOST_LINES)
    return [
        line._replace(
            names=line.names[start : start + MOST_LINES],
            links=line.links[start : start + MOST_LINES],
        )
        for start in starts
    ]


def numbers_of(elements: Sequence[str], panels: Iterable[MotionPanel]) -> dict[str, int]:
    """Return the colour number of each component.

    >>> numbers_of(["A", "B"], [MotionPanel("heat", "", 1.0, (MotionLine(("P1",), None),))])
    {'A': 0, 'B': 1, 'P1': 2}
    """
    others = (
        name for panel in panels for line in panel.lines if not line.links for name in line.names
    )
    return {name: number for number, name in enumerate(dict.fromkeys([*elements, *others]))}


def capacity_side(torques: Floats, capacity: Floats) -> Floats:
    """Return the sign with which a capacity is drawn: the sign of the latest large torque.

    The sign changes only at a torque above half of the capacity, or after zero capacity.

    >>> capacity_side(np.array([-1.0, 6.0, -1.0, 2.0, -9.0]), np.full(5, 10.0))
    array([ 1.,  1.,  1.,  1., -1.])
    """
    side = np.where(torques < 0, -1.0, 1.0)
    closed = np.r_[False, capacity > 0, False]
    for start, end in np.flatnonzero(np.diff(closed)).reshape(-1, 2).tolist():
        piece_side = side[start:end].copy()
        pieces = [0, *(np.flatnonzero(np.diff(piece_side)) + 1).tolist(), end - start]
        large = np.abs(torques[start:end]) > LARGE_PART * capacity[start:end]
        known = piece_side[int(np.abs(torques[start:end]).argmax())]
        if large.any():
            known = piece_side[int(large.argmax())]
        for first, last in pairwise(pieces):
            if large[first:last].any():
                known = piece_side[first]
            side[start + first : start + last] = known
    return side


def thinned(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Reduce a long line to ends and extremes in equal time intervals, without visible change.

    >>> time = np.linspace(0.0, 1.0, 100_001)
    >>> fewer, values = thinned(time, np.sin(1e4 * time))
    >>> len(fewer) < 7000, float(round(max(values), 4))
    (True, 1.0)
    """
    if len(time) <= 4 * PARTS_OF_TIME:
        return time, values
    edges = np.searchsorted(time, np.linspace(time[0], time[-1], PARTS_OF_TIME + 1)[:-1])
    starts = np.unique(edges)
    drawn = {0, len(time) - 1}
    for start, end in zip(starts, [*starts[1:], len(time)], strict=True):
        part = values[start:end]
        drawn |= {start, end - 1, start + int(part.argmin()), start + int(part.argmax())}
    places = sorted(drawn)
    return time[places], values[places]
