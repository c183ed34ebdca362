"""Layout of several axes in the width of a page: lengths shrink, letters keep their size."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product

from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.letters.extent import AxesLetters
from vstatics.pictures.schemes.axes.places import AxesPlaces, places
from vstatics.pictures.schemes.axes.recognition import ParallelAxes
from vstatics.pictures.schemes.axes.row_sections import row_sections
from vstatics.pictures.schemes.axes.rows import axis_rows
from vstatics.pictures.schemes.axes.search import arranged, passing
from vstatics.pictures.schemes.axes.stations import Station, box_note, note_half, stations_of
from vstatics.pictures.schemes.coaxial.fitting import CLOSEST, FEW_LETTERS, placed_by_letters
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.scheme import RATIO_SIGN, Scheme
from vstatics.pictures.schemes.sets import HalfSection

GAPS = (16.0, 12.0, 8.0, 6.0, 4.0, 3.0, 2.0)
"""Distances between stations to try; the first that fits the width is used. [pt]"""
PARTS = (1.0, 0.92, 0.85, 0.78, 0.72, 0.66, 0.6, 0.55, 0.5, 0.45, 0.4, 0.36, 0.32)
"""Scales of lengths, but not of letters, to try; the first that fits is used. [-]"""
HEAD_ROOM = 60.0
"""Height reserved for the heading of a page. [pt]"""
LETTERS = 12
"""Number of letters above which a name is broken at blanks."""


def placed(
    scheme: Scheme, axes: ParallelAxes, sections: Mapping[int, HalfSection], style: Style
) -> AxesPlaces:
    """Return the positions of axes, stations and lines within the width of a page.

    The diagram also fits the height of a page if possible.
    """
    inner = list(row_sections(scheme, axes, sections, is_ordered=style.ordered))
    nameless = {index: replace(section, names={}) for index, section in sections.items()}
    chosen = _chosen(scheme, axes, nameless, inner)
    # If a link would pass through a half-section, all components are drawn as separate stations.
    if chosen is None:
        inner, chosen = [], _chosen(scheme, axes, nameless, [])
    assert chosen is not None  # noqa: S101 - without half-sections, no link can pass through one
    small = [(False, part) for part in PARTS if not inner or part * CLOSEST >= 1]
    small += [(True, part) for part in PARTS * bool(inner)]
    for (is_small, part), letters in product(small, (LETTERS, FEW_LETTERS)):
        layouts = [
            placed_by_letters(
                bare._replace(letters=1 / part, line_letters=letters, is_small=is_small)
            )
            for bare in inner
        ]
        stations = [
            _around_letters(station, scheme, style, part)
            for station in stations_of(scheme, axes, style, letters, sections, layouts)
        ]
        rows = axis_rows(axes, stations, 1 / part)
        for gap in GAPS:
            board = AxesBoard(axes, rows, stations, scheme.ports, gap)
            placing = places(board, chosen)._replace(letters=1 / part)
            if part * max(placing.xs) > style.width:
                continue
            low, high = AxesLetters.of(placing, scheme, style.width / part).extent(placing)
            if part * (high[1] - low[1]) > style.height - HEAD_ROOM and part > PARTS[-1]:
                break
            if part * (high[0] - low[0]) <= style.width:
                return placing
    return placing


def _around_letters(station: Station, scheme: Scheme, style: Style, part: float) -> Station:
    """Return a box that is at least as wide as the letters of its ratio, which do not shrink.

    >>> from vstatics.pictures.schemes.scheme import Device
    >>> pair = Device("z1", "mechanism", {"first": 1, "second": 2}, (0,), ratio=-2.0537)
    >>> scheme, box = Scheme(["in", "out"], [pair], []), Station("box", [0], [0], [1, 2], 14.0)
    >>> around = _around_letters(box, scheme, Style(), 0.6)
    >>> 0.6 * around.half >= note_half("−2.0537") > 0.6 * box.half
    True
    """
    if station.kind != "box":
        return station
    short = box_note(scheme.devices[station.devices[0]], style).removeprefix(RATIO_SIGN)
    return station._replace(half=max(station.half, note_half(short) / part))


def _chosen(
    scheme: Scheme,
    axes: ParallelAxes,
    sections: Mapping[int, HalfSection],
    inner: Sequence[CoaxialLayout],
) -> StationOrder | None:
    """Return the best order of the stations, unless a link would pass through a half-section."""
    layouts = [placed_by_letters(bare._replace(line_letters=LETTERS)) for bare in inner]
    stations = stations_of(scheme, axes, Style(), LETTERS, sections, layouts)
    placing = arranged(AxesBoard(axes, axis_rows(axes, stations), stations, scheme.ports))
    for station, x in zip(stations, placing.xs, strict=True):
        if station.layout is not None and any(passing(placing, station, x)):
            return None
    return placing.chosen
