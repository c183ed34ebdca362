"""Places of a half-section in a width: lines close up, letters stay."""

from __future__ import annotations

import math

from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import framed
from vstatics.pictures.schemes.coaxial.places import Needs, SectionPlaces, heights_of, placed_along
from vstatics.pictures.schemes.coaxial.rooms import extent, met_by, rooms_of
from vstatics.pictures.schemes.coaxial.search.sweep import swept
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme
from vstatics.pictures.schemes.sets import planet_strokes

LEAST_HALF = 24.0
"""Half the height of the row of planets, at least. [pt]"""
FITS = 6
"""Times that lines are closed up, at most."""
CLOSEST = 1.6
"""Lengths are shorter by so much, at most, where something can stand in another row."""
ROUNDED = 0.1
"""Of widths. [pt]"""


def laid_out(
    own: CoaxialScheme,
    wide: float = math.inf,
    *,
    is_small: bool = False,
    is_quick: bool = False,
    is_ordered: bool = False,
) -> CoaxialLayout:
    """Where everything stands.

    Parameters
    ----------
    wide : float
        For which lines close up, and letters do not. [pt]
    is_small : bool
        Links have no names but those at the ends of the axis.
    is_quick : bool
        It is one of many.
    is_ordered : bool
        Sets stand in the order of the case, if a way is found soon.
    """
    found = swept(own.train, is_ordered=is_ordered, is_quick=is_quick)
    letters = 1.0
    for _ in range(FITS):
        frame = framed(own.train, found.steps)
        bare = SectionPlaces(frame, 0.0)
        layout = _placed(CoaxialLayout(own, bare, found.is_ordered, is_small, letters))
        low, high = extent(layout)
        if high[0] - low[0] <= wide * letters + ROUNDED:
            break
        letters = max(letters + 0.02, (high[0] - low[0]) / wide)
    return layout


def fits(layout: CoaxialLayout, wide: float) -> bool:
    """Whether a half-section can be read in a width [pt]: lines have not closed up too far."""
    low, high = extent(layout)
    is_within = high[0] - low[0] <= wide * layout.letters + ROUNDED
    return is_within and layout.letters <= CLOSEST


def _placed(bare: CoaxialLayout) -> CoaxialLayout:
    """With places, for letters of a size."""
    own, frame = bare.own, bare.places.frame
    scheme = own.scheme
    at_ends = {own.train.start, own.train.end} | {port.link for port in scheme.ports}
    links = [] if bare.is_small else scheme.links
    named = {n: bare.width(name) for n, name in enumerate(links, 1) if n not in at_ends}
    tops = [
        abs(y)
        for section in own.sections.values()
        for stroke in planet_strokes(section)
        for _, y in stroke.points
    ]
    half = max([LEAST_HALF, *(y + 8 for y in tops)])
    needs = Needs(half, frozenset(range(len(own.pairs))), named, bare.letters)
    layout = bare._replace(places=heights_of(frame, needs))
    rooms = [list(rooms_of(layout, up)) for up in frame.uprights]
    offsets = {place: met_by(layout, up) for place, up in enumerate(frame.uprights)}
    placed_along(layout.places, rooms, offsets, needs)
    return layout
