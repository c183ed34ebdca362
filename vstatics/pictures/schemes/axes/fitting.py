"""Places of several axes in a width: lines close up, letters stay."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.letters.extent import AxesLetters
from vstatics.pictures.schemes.axes.places import AxesPlaces, places
from vstatics.pictures.schemes.axes.recognition import ParallelAxes
from vstatics.pictures.schemes.axes.row_sections import RowSection, row_sections
from vstatics.pictures.schemes.axes.rows import axis_rows
from vstatics.pictures.schemes.axes.search import arranged, passing
from vstatics.pictures.schemes.axes.stations import stations_of
from vstatics.pictures.schemes.coaxial.fitting import CLOSEST, FEW_LETTERS
from vstatics.pictures.schemes.scheme import Scheme
from vstatics.pictures.schemes.sets import HalfSection

GAPS = (16.0, 12.0, 8.0, 6.0, 4.0, 3.0, 2.0)
"""Between stations: the largest with which all fits into the width. [pt]"""
PARTS = (1.0, 0.92, 0.85, 0.78, 0.72, 0.66, 0.6, 0.55, 0.5, 0.45, 0.4, 0.36, 0.32)
"""Sizes of all but letters: the largest with which all fits into the width."""
HEAD_ROOM = 60.0
"""For the head of a page; several axes stand on one. [pt]"""
LETTERS = 12
"""Longer names are broken at blanks; where room is short, at all blanks."""


def placed(
    scheme: Scheme, axes: ParallelAxes, sections: Mapping[int, HalfSection], style: Style
) -> AxesPlaces:
    """Where everything stands in the width of a page, and in its height if that is possible."""
    inner = list(row_sections(scheme, axes, sections, is_ordered=style.ordered))
    chosen = _chosen(scheme, axes, inner)
    if chosen is None:  # something would lead through a half-section
        inner, chosen = [], _chosen(scheme, axes, [])
    assert chosen is not None  # noqa: S101 - nothing leads through none
    small = [(False, part) for part in PARTS if not inner or part * CLOSEST >= 1]
    small += [(True, part) for part in PARTS * bool(inner)]
    for (is_small, part), letters in product(small, (LETTERS, FEW_LETTERS)):
        layouts = [one.laid_out(1 / part, letters, is_small=is_small) for one in inner]
        own = stations_of(scheme, axes, style, letters, layouts)
        rows = axis_rows(axes, own, 1 / part)
        for gap in GAPS:
            board = AxesBoard(axes, rows, own, scheme.ports, gap)
            found = places(board, chosen)._replace(letters=1 / part)
            if part * max(found.xs) > style.width:
                continue
            low, high = AxesLetters.of(found, scheme, style.width / part).extent(found)
            if part * (high[1] - low[1]) > style.height - HEAD_ROOM and part > PARTS[-1]:
                break
            if part * (high[0] - low[0]) <= style.width:
                return found
    return found


def _chosen(scheme: Scheme, axes: ParallelAxes, inner: Sequence[RowSection]) -> StationOrder | None:
    """The order of the stations; None if something would lead through a half-section."""
    stations = stations_of(scheme, axes, Style(), sections=[one.laid_out() for one in inner])
    found = arranged(AxesBoard(axes, axis_rows(axes, stations), stations, scheme.ports))
    for one, x in zip(stations, found.xs, strict=True):
        if one.layout is not None and any(passing(found, one, x)):
            return None
    return found.chosen
