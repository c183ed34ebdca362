"""Found gearboxes as points in a diagram of mean loss versus largest torque, by family."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.labels import (
    LINE_HEIGHT,
    Span,
    height,
    ticks,
    title_width,
    widest,
    wrapped,
)
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import TITLE, Style
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox
from vstatics.synthesis.pictures.numbers import LARGE_SPOT, SPOT, BoxPoint, number_spots, rounded

MARKERS = "os^Dv"
"""Markers of the points of families, used in turn like the colours."""
AXIS_ROOM = 0.06
"""Distance of the outermost points from the ends of an axis, relative to the range. [-]"""
LEAST_AXIS_ROOM = 0.05
"""Smallest distance of the points from the ends of an axis, relative to the largest value. [-]"""
CROWD = 1000
"""Number of points with equal colour and marker above which points are drawn smaller."""
FEW_POINTS = 300
"""Largest number of points for which each point has a tooltip."""
POINTS_SCALE_WIDTH = 40.0
"""Distance from the left end of the title to the axes. [pt]"""
LOGARITHMIC_RATIO = 8.0
"""Ratio of the largest to the smallest value above which a scale is logarithmic. [-]"""
BESIDE_POINTS, TO_FAMILY = 14.0, 8.0
"""Distance from the axes to the markers in the legend, and from the markers to the names. [pt]"""
TICK_ROOM = 30.0
"""Smallest distance between numbers of the horizontal axis. [pt]"""
OVER_AXES = 12.0
"""Distance from the axes to the text above the axes. [pt]"""
PointLook = tuple[str, str]
"""Colour and marker of the points of a family."""


def has_place(box: ListedBox) -> bool:
    """Return whether a gearbox has both a mean loss and a largest torque."""
    return math.isfinite(box.loss) and math.isfinite(box.torque)


def draw_points(pen: Pen, listing: BoxListing, drawn: Sequence[ListedBox]) -> None:
    """Draw gearboxes as points, and write numbers next to gearboxes with a stick diagram.

    Parameters
    ----------
    pen : Pen
        Pen for the rectangle of the axes, with losses in % versus torques.
    drawn : sequence of ListedBox
        Gearboxes with a stick diagram; their families are coloured, all others are grey.
    """
    boxes, style = [box for box in listing.boxes if has_place(box)], pen.style
    x, y = box_scale([box.torque for box in boxes]), box_scale([100 * box.loss for box in boxes])
    pen = pen._replace(x=x, y=y)
    _scales(pen)
    looks = _looks(drawn, style)
    spots = list(_spots(pen, boxes))
    alike = grouped(
        ((looks.get(spot.boxes[0].family), any(box.pareto for box in spot.boxes)), spot)
        for spot in spots
    )
    for (look, is_pareto), alike_spots in alike.items():
        for series in (
            [[spot] for spot in alike_spots] if len(spots) <= FEW_POINTS else [alike_spots]
        ):
            _draw_spots(pen, series, look, is_pareto=is_pareto)
    has_more = number_spots(pen, spots, {box.number for box in drawn})
    room = POINTS_SCALE_WIDTH + pen.size[0] + families_width(listing, drawn, style)
    points_words(listing, room, style, has_more=has_more).draw(pen)
    _draw_families(pen, _families(listing, looks, style))


def _looks(drawn: Sequence[ListedBox], style: Style) -> dict[int, PointLook]:
    return {
        family: (style.colour(place), MARKERS[place % len(MARKERS)])
        for place, family in enumerate(dict.fromkeys(box.family for box in drawn))
    }


def _scales(pen: Pen) -> None:
    numbers, text = _ticks(pen.y, 8), pen.style.text
    pen.scale("left", numbers, grid=True)
    pen.scale("bottom", _ticks(pen.x, min(8, int(pen.size[0] / TICK_ROOM))), grid=True)
    pen.frame("left", "bottom")
    torque = torque_name(pen.size[0], pen.style)
    pen.name("bottom", torque, 24 + (height(torque) - height("")) / 2)
    loss = text("mean loss, forward gears, %")
    pen.name("left", loss, min(widest(tick_texts(numbers)) + 14, POINTS_SCALE_WIDTH - 4))


def torque_name(wide: float, style: Style) -> str:
    """Return the name of the horizontal axis, wrapped to the width of the axes [pt]."""
    name = style.text("largest torque of an engaged shift element / input torque")
    return wrapped(name, wide + 2 * POINTS_SCALE_WIDTH)


def _ticks(scale: AxisScale, most: int) -> list[float]:
    """Return round numbers of a scale; on a logarithmic scale 1, 2, 5, 10 and so on."""
    if not scale.is_log:
        return ticks(scale.low, scale.high, most)
    powers = range(math.floor(math.log10(scale.low)), math.ceil(math.log10(scale.high)) + 1)
    candidates = [digit * 10.0**power for power in powers for digit in (1, 2, 5)]
    return [tick for tick in candidates if scale.low <= tick <= scale.high]


def box_scale(values: Sequence[float]) -> AxisScale:
    """Return the scale for values: logarithmic if the values differ by a large factor."""
    if values and 0 < LOGARITHMIC_RATIO * min(values) < max(values):
        low, high = (math.exp(end) for end in _ends([math.log(number) for number in values]))
        return AxisScale(low, high, is_log=True)
    return AxisScale(*_ends(values))


def _ends(values: Sequence[float]) -> Span:
    """Return the ends of an axis, outside all values. The ends differ also if all values are equal.

    >>> _ends([2.0, 2.0]), _ends([])
    ((1.9, 2.1), (0.0, 1.0))
    """
    if not values:
        return 0.0, 1.0
    low, high = certain(min(values)), certain(max(values))
    room = (
        max(AXIS_ROOM * (high - low), LEAST_AXIS_ROOM * max(abs(low), abs(high))) or LEAST_AXIS_ROOM
    )
    return low - room, high + room


def _spots(pen: Pen, boxes: Sequence[ListedBox]) -> Iterable[BoxPoint]:
    by_place: dict[tuple[int, int, int], BoxPoint] = {}
    for box in boxes:
        at = pen.across(box.torque), pen.up(100 * box.loss)
        by_place.setdefault((box.family, *rounded(at)), BoxPoint(at, [])).boxes.append(box)
    return by_place.values()


def _draw_spots(
    pen: Pen, spots: Sequence[BoxPoint], look: PointLook | None, *, is_pareto: bool
) -> None:
    style, (colour, marker) = pen.style, look or (pen.style.faint, "o")
    edge, thick = (style.ink, 1.2) if is_pareto else (style.paper, 0.4)
    pen.line(
        *(spot.at for spot in spots),
        title=_point_title(spots[0], style) if len(spots) == 1 else "",
        color=colour,
        linestyle="none",
        marker=marker,
        markeredgecolor=edge,
        markeredgewidth=thick,
        markersize=LARGE_SPOT if is_pareto else SPOT if len(spots) < CROWD else SPOT / 2,
        zorder=3 + is_pareto + 2 * (look is not None),
    )


def _point_title(spot: BoxPoint, style: Style) -> str:
    numbers, first = ", ".join(str(box.number) for box in spot.boxes), spot.boxes[0]
    family = f"{style.text('family')} {first.family}"
    loss = f"{style.text('loss')} {100 * first.loss:.2f} %"
    return f"{numbers}: {family}, {loss}, {style.text('torque')} {first.torque:.2f}"


class PointsWords(NamedTuple):
    """Text above the axes, in wrapped lines."""

    title: str
    notes: str

    @property
    def high(self) -> float:
        """Height of the text with the gap to the axes [pt]."""
        title_high = height(self.title, TITLE) if self.title else 0.0
        return OVER_AXES + height(self.notes) + title_high

    def draw(self, pen: Pen) -> None:
        """Draw the text above the axes, from the left end of the scale."""
        x, y = -POINTS_SCALE_WIDTH, pen.size[1] + OVER_AXES
        look: Look = {"va": "bottom", "linespacing": LINE_HEIGHT}
        pen.text(x, y, self.notes, color=pen.style.soft, **look)
        pen.text(x, y + height(self.notes) + 2, self.title, size=TITLE, bold=True, **look)


def points_words(listing: BoxListing, room: float, style: Style, *, has_more: bool) -> PointsWords:
    """Return the text above the axes: counts of gearboxes, wrapped to a width [pt]."""
    box_count, families, searched = len(listing.boxes), len(listing.families), listing.searched
    counts = style.text(
        "{searched} looked at, {count} family with equal ratios|"
        "{searched} looked at, {count} families with equal ratios",
        searched=searched,
        count=families,
    )
    notes = [counts] * style.titled
    placeless = sum(not has_place(box) for box in listing.boxes)
    if placeless:
        more = style.text("without loss or torque")
        notes.append(f"{more}: {placeless}")
    if has_more:
        more = style.text("+1: one more at this place")
        notes.append(more)
    title = style.text("Found boxes: {found}", found=box_count)
    return PointsWords(
        wrapped(title, room, title_width) * style.titled, wrapped("; ".join(notes), room)
    )


def families_width(listing: BoxListing, drawn: Sequence[ListedBox], style: Style) -> float:
    """Return the width of the legend to the right of the axes [pt]."""
    entries = _families(listing, _looks(drawn, style), style)
    return BESIDE_POINTS + TO_FAMILY + widest(text for _, _, text in entries)


def _families(
    listing: BoxListing, looks: Mapping[int, PointLook], style: Style
) -> list[tuple[PointLook, str, str]]:
    """Return the entries of the legend: colour and marker, colour of the edge, and text.

    Families with a stick diagram come first, each in its colour. The number of other families,
    which are grey, and the mark of the Pareto list follow.
    """
    families = listing.families
    entries = [
        (look, style.paper, f"{style.text('family')} {family} ({len(families[family])})")
        for family, look in looks.items()
    ]
    grey = len(families) - len(looks)
    if grey:
        others = style.text("{rest} others", rest=grey)
        entries.append(((style.faint, "o"), style.paper, others))
    if any(box.pareto for box in listing.boxes):
        pareto = style.text("Pareto list")
        entries.append(((style.paper, "o"), style.ink, pareto))
    return entries


def _draw_families(pen: Pen, entries: Sequence[tuple[PointLook, str, str]]) -> None:
    x, step = pen.size[0] + BESIDE_POINTS, min(13.0, pen.size[1] / max(len(entries), 1))
    for row, ((colour, marker), edge, text) in enumerate(entries):
        y = pen.size[1] - 4 - step * row
        pen.line(
            (x, y),
            color=colour,
            marker=marker,
            markeredgecolor=edge,
            markersize=LARGE_SPOT - 1,
            linestyle="",
        )
        pen.text(x + TO_FAMILY, y, text, va="center")
