"""Places of a half-section in a width: lines close up, letters stay."""

from __future__ import annotations

import math
from dataclasses import replace

from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import framed
from vstatics.pictures.schemes.coaxial.places import Needs, SectionPlaces, heights_of, placed_along
from vstatics.pictures.schemes.coaxial.rooms import extent, met_by, rooms_of
from vstatics.pictures.schemes.coaxial.search.sweep import BRIEF, FULL, SweepEffort, swept
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme
from vstatics.pictures.schemes.glyphs import DEVICE_NAME_LETTERS

LEAST_HALF = 24.0
"""Half the height of the row of planets, at least. [pt]"""
FEW_LETTERS = 5
"""In a narrow picture longer names are broken at blanks."""
NAMED = (
    (DEVICE_NAME_LETTERS, False, False),
    (FEW_LETTERS, False, False),
    (FEW_LETTERS, True, False),
    (FEW_LETTERS, True, True),
)
"""Letters of a line, whether links have no names, and whether wheels have their teeth alone:
what is tried, from wide to narrow."""
MOST_NAMED = 2.5
"""Links and wheels have names while lengths are shorter by so much, at most; else signs are not
seen."""
MOST_CLOSED = 4.0
"""Lengths are shorter by so much, at most; what is wider then is wider than its page."""
FITS, SLOW_FITS = 16, 5
"""Times that lines are closed up, at most; after so many by more each time."""
LEAST_STEP = 1.01
"""What they close up by, at least."""
CLOSEST = 1.6
"""Lengths are shorter by so much, at most, where something can stand in another row."""
ROUNDED = 0.1
"""Of widths. [pt]"""


def laid_out(
    own: CoaxialScheme,
    wide: float = math.inf,
    *,
    is_small: bool = False,
    effort: SweepEffort = FULL,
    is_ordered: bool = False,
) -> CoaxialLayout:
    """Where everything stands.

    Parameters
    ----------
    wide : float
        For which lines close up, and letters do not. [pt]
    is_small : bool
        Links have no names but those at the ends of the axis.
    effort : SweepEffort, optional
        Tries of the search for an arrangement; fewer for boxes.
    is_ordered : bool
        Sets stand in the order of the case, if a way is found soon.
    """
    found = swept(own.train, is_ordered=is_ordered, effort=BRIEF if own.has_boxes else effort)
    ends = frozenset([own.train.start, own.train.end, *(port.link for port in own.scheme.ports)])
    bare = CoaxialLayout(
        own, SectionPlaces(framed(own.train, found.steps), 0.0), found.is_ordered, named_beside=ends
    )
    for line_letters, without, has_teeth_alone in NAMED[: 1 if own.has_boxes else None]:
        named = bare._replace(
            is_small=is_small or without,
            line_letters=line_letters,
            has_teeth_alone=has_teeth_alone,
        )
        layout = _closed_up(named, wide)
        if is_within(layout, wide) and layout.letters <= MOST_NAMED:
            break
    return layout


def _closed_up(bare: CoaxialLayout, wide: float) -> CoaxialLayout:
    """With lines as close as a width asks for."""
    letters = 1.0
    sections = bare.own.sections.values()
    has_rims = any(
        rim in one.names for one in sections for col in one.columns for rim in col.rims.values()
    )
    most = MOST_NAMED if has_rims else MOST_CLOSED  # the teeth of a planet stand over its pin
    if bare.own.has_boxes:  # which have the size of their letters
        most = MOST_NAMED
    for tried in range(FITS):
        layout = placed_by_letters(bare._replace(letters=letters))
        length = _length(layout)
        if length <= wide * letters + ROUNDED or letters >= most:
            break
        lack = length / (wide * letters)
        letters *= max(lack ** (1 + tried // SLOW_FITS), LEAST_STEP)  # faster where names fill it
        letters = min(letters, most)
    return layout


def is_within(layout: CoaxialLayout, wide: float) -> bool:
    """Whether a half-section is no wider than it may be [pt]."""
    return _length(layout) <= wide * layout.letters + ROUNDED


def _length(layout: CoaxialLayout) -> float:
    """Return the length of a half-section along its axis, with its ports [pt]."""
    low, high = extent(layout)
    return high[0] - low[0]


def fits(layout: CoaxialLayout, wide: float) -> bool:
    """Whether a half-section can be read in a width [pt]: lines have not closed up too far."""
    return is_within(layout, wide) and layout.letters <= CLOSEST


def placed_by_letters(bare: CoaxialLayout) -> CoaxialLayout:
    """With places, for letters of its size."""
    own, frame = bare.own, bare.places.frame
    scheme = own.scheme
    links = [] if bare.is_small else scheme.links
    own_names = [bare.link_name(n) for n in range(1, len(links) + 1)]
    named = {
        n: bare.width(name) for n, name in enumerate(own_names, 1) if n not in bare.named_beside
    }
    lines = max((own_names[n - 1].count("\n") + 1 for n in named), default=1)
    sections = [replace(section, letters=bare.letters) for section in own.sections.values()]
    half = max([LEAST_HALF, *(section.tall for section in sections)])
    needs = Needs(
        half,
        [bare.sign_room(number) for number in range(len(own.pairs))],
        named,
        bare.letters * lines,
        own.has_boxes or any(section.names for section in own.sections.values()),
    )
    layout = bare._replace(places=heights_of(frame, needs))
    rooms = [list(rooms_of(layout, up)) for up in frame.uprights]
    offsets = {place: met_by(layout, up) for place, up in enumerate(frame.uprights)}
    placed_along(layout.places, rooms, offsets, needs)
    return layout
