"""Found boxes as points: mean loss over the largest torque, families told apart."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from vstatics.pictures.boxes.numbers import LARGE_SPOT, SPOT, BoxPoint, number_spots, rounded
from vstatics.pictures.sheet.groups import grouped
from vstatics.pictures.sheet.labels import Span, ticks, widest
from vstatics.pictures.sheet.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.sheet.style import TITLE, Style
from vstatics.pictures.sheet.words import term
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox
from vstatics.tables.numbers import certain

MARKERS = "os^Dv"
"""Of families, by turns, as their colours."""
AXIS_ROOM = 0.06
"""Beside the outermost points, as a part of the axis."""
LEAST_AXIS_ROOM = 0.05
"""At least, as a part of the largest number."""
CROWD = 1000
"""From so many points of one look on they are small."""
FEW_POINTS = 300
"""Up to so many points each says what it is."""
POINTS_SCALE_WIDTH = 40.0
"""From the words over the axes to these. [pt]"""
LOGARITHMIC_RATIO = 8.0
"""A scale is logarithmic if the largest value is so many times the smallest."""
Look = tuple[str, str]
"""Colour and marker."""


def has_place(box: ListedBox) -> bool:
    """Whether a box has both figures."""
    return math.isfinite(box.loss) and math.isfinite(box.torque)


def draw_points(pen: Pen, listing: BoxListing, drawn: Sequence[ListedBox]) -> None:
    """All boxes that have both figures as points, those with a diagram by their numbers.

    Parameters
    ----------
    pen : Pen
        In the rectangle of the axes: losses in % over torques.
    drawn : sequence of ListedBox
        Those with a diagram; their families have colours, others are grey.
    """
    boxes, style = [box for box in listing.boxes if has_place(box)], pen.style
    x, y = box_scale([box.torque for box in boxes]), box_scale([100 * box.loss for box in boxes])
    pen = pen._replace(x=x, y=y)
    _scales(pen)
    families = dict.fromkeys(box.family for box in drawn)
    looks = {
        family: (style.colour(place), MARKERS[place % len(MARKERS)])
        for place, family in enumerate(families)
    }
    spots = list(_spots(pen, boxes))
    alike = grouped(
        ((looks.get(one.boxes[0].family), any(box.pareto for box in one.boxes)), one)
        for one in spots
    )
    for (look, is_pareto), own in alike.items():
        for some in [[spot] for spot in own] if len(spots) <= FEW_POINTS else [own]:
            _draw_spots(pen, some, look, is_pareto=is_pareto)
    has_more = number_spots(pen, spots, {box.number for box in drawn})
    _draw_words(pen, listing, has_more=has_more)
    _draw_families(pen, listing, looks)


def _scales(pen: Pen) -> None:
    numbers, text = _ticks(pen.y, 8), pen.style.text
    pen.scale("left", numbers, grid=True)
    pen.scale("bottom", _ticks(pen.x, 10), grid=True)
    pen.frame("left", "bottom")
    torque = text(
        "largest torque of an engaged element / input torque",
        "наибольший момент включённого элемента / момент на входе",
    )
    pen.name("bottom", torque, 24)
    loss = text("mean loss, forward gears, %", "средние потери вперёд, %")
    pen.name("left", loss, min(widest(tick_texts(numbers)) + 14, POINTS_SCALE_WIDTH - 4))


def _ticks(scale: AxisScale, most: int) -> list[float]:
    """Round numbers of a scale: 1, 2, 5, 10 and so on where it is logarithmic."""
    if not scale.is_log:
        return ticks(scale.low, scale.high, most)
    powers = range(math.floor(math.log10(scale.low)), math.ceil(math.log10(scale.high)) + 1)
    found = [digit * 10.0**power for power in powers for digit in (1, 2, 5)]
    return [one for one in found if scale.low <= one <= scale.high]


def box_scale(values: Sequence[float]) -> AxisScale:
    """A scale for numbers, logarithmic where they differ much."""
    if values and 0 < LOGARITHMIC_RATIO * min(values) < max(values):
        low, high = (math.exp(end) for end in _ends([math.log(one) for one in values]))
        return AxisScale(low, high, is_log=True)
    return AxisScale(*_ends(values))


def _ends(values: Sequence[float]) -> Span:
    """The ends of an axis: beside all values, and apart where these differ by rounding.

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
    """Boxes by their places; those of a family that coincide are together."""
    found: dict[tuple[int, int, int], BoxPoint] = {}
    for box in boxes:
        at = pen.across(box.torque), pen.up(100 * box.loss)
        found.setdefault((box.family, *rounded(at)), BoxPoint(at, [])).boxes.append(box)
    return found.values()


def _draw_spots(pen: Pen, spots: Sequence[BoxPoint], look: Look | None, *, is_pareto: bool) -> None:
    style, (colour, marker) = pen.style, look or (pen.style.faint, "o")
    edge, thick = (style.ink, 1.2) if is_pareto else (style.paper, 0.4)
    pen.line(
        *(spot.at for spot in spots),
        title=_said(spots[0], style) if len(spots) == 1 else "",
        color=colour,
        linestyle="none",
        marker=marker,
        markeredgecolor=edge,
        markeredgewidth=thick,
        markersize=LARGE_SPOT if is_pareto else SPOT if len(spots) < CROWD else SPOT / 2,
        zorder=3 + is_pareto + 2 * (look is not None),
    )


def _said(spot: BoxPoint, style: Style) -> str:
    """What a point is."""
    numbers, first = ", ".join(str(box.number) for box in spot.boxes), spot.boxes[0]
    family = f"{term('family', style)} {first.family}"
    loss = f"{style.text('loss', 'потери')} {100 * first.loss:.2f} %"
    return f"{numbers}: {family}, {loss}, {term('torque', style)} {first.torque:.2f}"


def _draw_words(pen: Pen, listing: BoxListing, *, has_more: bool) -> None:
    """What stands over the axes."""
    found, families, searched = len(listing.boxes), len(listing.families), listing.searched
    style, y = pen.style, pen.size[1] + 14
    together = "family" if families == 1 else "families"
    said = style.text(
        f"{searched} looked at, {families} {together} with equal ratios",
        f"рассмотрено {searched}, семейств с равными передаточными отношениями: {families}",
    )
    notes = [said] * style.titled
    placeless = sum(not has_place(box) for box in listing.boxes)
    if placeless:
        more = style.text("without loss or torque", "без потерь или момента")
        notes.append(f"{more}: {placeless}")
    if has_more:
        more = style.text("+1: one more at this place", "+1: ещё одна на этом месте")
        notes.append(more)
    if style.titled:
        title = style.text(f"Found boxes: {found}", f"Найденные схемы: {found}")
        pen.text(-POINTS_SCALE_WIDTH, y + 13, title, size=TITLE, bold=True, va="bottom")
    pen.text(-POINTS_SCALE_WIDTH, y, "; ".join(notes), color=style.soft, va="bottom")


def _draw_families(pen: Pen, listing: BoxListing, looks: Mapping[int, Look]) -> None:
    """The families that have a colour, how many are grey, what has a dark edge."""
    families, style = listing.families, pen.style
    entries = [
        (look, style.paper, f"{term('family', style)} {family} ({len(families[family])})")
        for family, look in looks.items()
    ]
    rest = len(families) - len(looks)
    if rest:
        others = style.text(f"{rest} others", f"ещё {rest}")
        entries.append(((style.faint, "o"), style.paper, others))
    if any(box.pareto for box in listing.boxes):
        pareto = style.text("Pareto list", "список Парето")
        entries.append(((style.paper, "o"), style.ink, pareto))
    x, step = pen.size[0] + 14, min(13.0, pen.size[1] / len(entries))
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
        pen.text(x + 8, y, text, va="center")
