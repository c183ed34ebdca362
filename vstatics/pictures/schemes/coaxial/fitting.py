"""Fitting of a half-section into a width: lengths shrink, but letters keep their size."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import framed
from vstatics.pictures.schemes.coaxial.places import Needs, SectionPlaces, heights_of, placed_along
from vstatics.pictures.schemes.coaxial.rooms import extent, met_by, rooms_of
from vstatics.pictures.schemes.coaxial.search.order import (
    BRIEF,
    FULL,
    SearchEffort,
    component_order,
)
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme
from vstatics.pictures.schemes.gear_glyphs import DEVICE_NAME_LETTERS

LEAST_HALF = 24.0
"""Smallest half height of gear sets after reduction. [pt]"""
FEW_LETTERS = 5
"""Number of letters above which a name is broken at a blank in a narrow picture."""
NAMED = (
    (DEVICE_NAME_LETTERS, False, False),
    (FEW_LETTERS, False, False),
    (FEW_LETTERS, True, False),
    (FEW_LETTERS, True, True),
)
"""Variants of names in a layout to try, from wide to narrow.

A variant contains the number of letters per line, and two flags. The first flag limits names to the
links at the ends of the axis, the second labels gears by tooth numbers only.
"""
MOST_SHRUNK_NAMED = 2.5
"""Largest ratio of letter size to lengths if gears have names or boxes are drawn. [-]"""
MOST_SHRUNK = 4.0
"""Largest ratio of letter size to lengths in other pictures; wider pictures exceed the page. [-]"""
FITS, SLOW_FITS = 16, 5
"""Largest number of reductions, and number of reductions after which the steps grow."""
LEAST_STEP = 1.01
"""Smallest factor of a single reduction. [-]"""
CLOSEST = 1.6
"""Largest ratio of letters to lengths if components can move to other rows. [-]"""
ROUNDED = 0.1
"""Excess up to which a width counts as fitting. [pt]"""


def laid_out(
    coaxial: CoaxialScheme,
    wide: float = math.inf,
    *,
    is_small: bool = False,
    effort: SearchEffort = FULL,
    is_ordered: bool = False,
) -> CoaxialLayout:
    """Return the layout of a half-section.

    Parameters
    ----------
    wide : float
        Width into which the layout should fit, by reducing lengths but not letters. [pt]
    is_small : bool
        True to name only the links at the ends of the axis.
    effort : SearchEffort, optional
        Effort of the search for an order of components; with boxes, a smaller effort is used.
    is_ordered : bool
        True to keep gear sets in the order of the case, if a layout is found soon.
    """
    ends = [coaxial.train.start, coaxial.train.end, *(port.link for port in coaxial.scheme.ports)]
    effort = BRIEF if coaxial.has_boxes else effort
    bare = arranged(coaxial, ends, effort=effort, is_ordered=is_ordered)
    for line_letters, without, has_teeth_alone in NAMED[: 1 if coaxial.has_boxes else None]:
        named = bare._replace(
            is_small=is_small or without,
            line_letters=line_letters,
            has_teeth_alone=has_teeth_alone,
        )
        layout = _closed_up(named, wide)
        if is_within(layout, wide) and layout.letters <= MOST_SHRUNK_NAMED:
            break
    return layout


def arranged(
    coaxial: CoaxialScheme,
    named_beside: Iterable[int],
    *,
    is_ordered: bool,
    effort: SearchEffort = FULL,
) -> CoaxialLayout:
    """Return the layout of a half-section without positions; parameters as in `laid_out`.

    The links in `named_beside` have names next to arrows.
    """
    order = component_order(coaxial.train, is_ordered=is_ordered, effort=effort)
    places = SectionPlaces(framed(coaxial.train, order.steps), 0.0)
    return CoaxialLayout(coaxial, places, order.is_ordered, named_beside=frozenset(named_beside))


def _closed_up(bare: CoaxialLayout, wide: float) -> CoaxialLayout:
    """Return the layout with lengths reduced to fit into a width."""
    letters = 1.0
    sections = bare.coaxial.sections.values()
    has_rims = any(
        rim in section.names
        for section in sections
        for column in section.columns
        for rim in column.rims.values()
    )
    # Names on planet gears limit the reduction.
    most = MOST_SHRUNK_NAMED if has_rims else MOST_SHRUNK
    if bare.coaxial.has_boxes:  # the size of boxes depends on the letters
        most = MOST_SHRUNK_NAMED
    for tried in range(FITS):
        layout = placed_by_letters(bare._replace(letters=letters))
        length = _length(layout)
        if length <= wide * letters + ROUNDED or letters >= most:
            break
        lack = length / (wide * letters)
        letters *= max(lack ** (1 + tried // SLOW_FITS), LEAST_STEP)  # larger steps in later tries
        letters = min(letters, most)
    return layout


def is_within(layout: CoaxialLayout, wide: float) -> bool:
    """Return whether a half-section fits into a width [pt], at the present reduction."""
    return _length(layout) <= wide * layout.letters + ROUNDED


def _length(layout: CoaxialLayout) -> float:
    """Return the length of a half-section along the axis, including ports [pt]."""
    low, high = extent(layout)
    return high[0] - low[0]


def fits(layout: CoaxialLayout, wide: float) -> bool:
    """Return whether a half-section fits into a width [pt] with a readable reduction."""
    return is_within(layout, wide) and layout.letters <= CLOSEST


def placed_by_letters(bare: CoaxialLayout) -> CoaxialLayout:
    """Return the layout with all positions calculated for the ratio of letters to lengths."""
    coaxial, frame = bare.coaxial, bare.places.frame
    scheme = coaxial.scheme
    links = [] if bare.is_small else scheme.links
    own_names = [bare.link_name(n) for n in range(1, len(links) + 1)]
    named = {
        n: bare.width(name) for n, name in enumerate(own_names, 1) if n not in bare.named_beside
    }
    lines = max((own_names[n - 1].count("\n") + 1 for n in named), default=1)
    sections = [replace(section, letters=bare.letters) for section in coaxial.sections.values()]
    half = max([LEAST_HALF, *(section.tall for section in sections)])
    needs = Needs(
        half,
        [bare.sign_room(number) for number in range(len(coaxial.pairs))],
        named,
        bare.letters * lines,
        coaxial.has_boxes or any(section.names for section in coaxial.sections.values()),
    )
    layout = bare._replace(places=heights_of(frame, needs))
    rooms = [list(rooms_of(layout, up)) for up in frame.uprights]
    offsets = {place: met_by(layout, up) for place, up in enumerate(frame.uprights)}
    placed_along(layout.places, rooms, offsets, needs)
    return layout
