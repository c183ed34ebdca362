"""Found boxes as points: mean loss over the largest torque, families told apart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from vstatics.pictures.boxes.numbers import LARGE_SPOT, SAME_POINT, SPOT, BoxPoint, number_spots
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import AxisScale, Chart, tick_texts, widest
from vstatics.pictures.sheet.labels import Paper, Point
from vstatics.pictures.sheet.style import TITLE, Style
from vstatics.pictures.sheet.svg import told
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox
from vstatics.tables.numbers import certain

MARKERS = "os^Dv"
"""Of families, by turns, as their colours."""
AXIS_ROOM = 0.06
"""Beside the outermost points, as a part of the axis."""
LEAST_ROOM = 0.05
"""At least, as a part of the largest number."""
CROWD = 1000
"""From so many points of one look on they are small."""
FEW_POINTS = 300
"""Up to so many points each says what it is."""
LEFT = 40.0
"""From the words over the axes to these. [pt]"""
WIDELY = 8.0
"""A scale is logarithmic if the largest value is so many times the smallest."""
Look = tuple[str, str]
"""Colour and marker."""


def has_place(box: ListedBox) -> bool:
    """Whether a box has both figures."""
    return math.isfinite(box.loss) and math.isfinite(box.torque)


def box_chart(paper: Paper, corner: Point, size: Point, listing: BoxListing) -> Chart:
    """A chart for all boxes that have both figures: losses in % over torques."""
    boxes = [box for box in listing.boxes if has_place(box)]
    x = box_scale([box.torque for box in boxes])
    return Chart(paper, corner, *size, x, box_scale([100 * box.loss for box in boxes]))


def draw_points(
    chart: Chart, listing: BoxListing, drawn: Sequence[ListedBox], style: Style
) -> bool:
    """All boxes that have both figures as points, those with a diagram by their numbers.

    Parameters
    ----------
    drawn : sequence of ListedBox
        Those with a diagram; their families have colours, others are grey.

    Returns
    -------
    bool
        Whether there are more boxes where some have their numbers.
    """
    _scales(chart, style)
    looks = _looks(drawn, style)
    spots = list(_spots(chart, [box for box in listing.boxes if has_place(box)]))
    alike: dict[tuple[Look | None, bool], list[BoxPoint]] = {}
    for spot in spots:
        alike.setdefault((looks.get(spot.boxes[0].family), spot.is_pareto), []).append(spot)
    for (look, is_pareto), own in alike.items():
        one_by_one = [[spot] for spot in own] if len(spots) <= FEW_POINTS else [own]
        for some in one_by_one:
            _draw_spots(chart, some, look, style, is_pareto=is_pareto)
    return number_spots(chart, spots, {box.number for box in drawn}, style)


def _scales(chart: Chart, style: Style) -> None:
    ticks = _ticks(chart.y, 8)
    chart.scale("left", ticks, style, grid=True)
    chart.scale("bottom", _ticks(chart.x, 10), style, grid=True)
    chart.frame(style, "left", "bottom")
    torque = style.text(
        "largest torque of an engaged element / input torque",
        "наибольший момент включённого элемента / момент на входе",
    )
    chart.name("bottom", torque, 24)
    loss = style.text("mean loss, forward gears, %", "средние потери вперёд, %")
    chart.name("left", loss, min(widest(tick_texts(ticks)) + 14, LEFT - 4))


def _ticks(scale: AxisScale, most: int) -> list[float]:
    """Round numbers of a scale: 1, 2, 5, 10 and so on where it is logarithmic."""
    if not scale.is_log:
        return labels.ticks(scale.low, scale.high, most)
    powers = range(math.floor(math.log10(scale.low)), math.ceil(math.log10(scale.high)) + 1)
    found = [digit * 10.0**power for power in powers for digit in (1, 2, 5)]
    return [one for one in found if scale.low <= one <= scale.high]


def box_scale(values: Sequence[float]) -> AxisScale:
    """A scale for numbers, logarithmic where they differ much."""
    if values and 0 < WIDELY * min(values) < max(values):
        low, high = (math.exp(end) for end in _ends([math.log(one) for one in values]))
        return AxisScale(low, high, is_log=True)
    return AxisScale(*_ends(values))


def _ends(values: Sequence[float]) -> tuple[float, float]:
    """The ends of an axis: beside all values, and apart where these differ by rounding.

    >>> _ends([2.0, 2.0]), _ends([])
    ((1.9, 2.1), (0.0, 1.0))
    """
    if not values:
        return 0.0, 1.0
    low, high = certain(min(values)), certain(max(values))
    room = max(AXIS_ROOM * (high - low), LEAST_ROOM * max(abs(low), abs(high))) or LEAST_ROOM
    return low - room, high + room


def _looks(drawn: Sequence[ListedBox], style: Style) -> dict[int, Look]:
    """Colour and marker of each family that has a diagram."""
    families = dict.fromkeys(box.family for box in drawn)
    return {
        family: (style.colour(place), MARKERS[place % len(MARKERS)])
        for place, family in enumerate(families)
    }


def _spots(chart: Chart, boxes: Sequence[ListedBox]) -> Iterator[BoxPoint]:
    """Boxes by their places; those of a family that coincide are together."""
    found: dict[tuple[int, int, int], BoxPoint] = {}
    for box in boxes:
        at = chart.across(box.torque), chart.up(100 * box.loss)
        key = box.family, round(at[0] / SAME_POINT), round(at[1] / SAME_POINT)
        found.setdefault(key, BoxPoint(at, [])).boxes.append(box)
    yield from found.values()


def _draw_spots(
    chart: Chart, spots: Sequence[BoxPoint], look: Look | None, style: Style, *, is_pareto: bool
) -> None:
    colour, marker = look or (style.faint, "o")
    how: dict[str, Any] = {
        "color": colour,
        "linestyle": "none",
        "marker": marker,
        "markeredgecolor": style.ink if is_pareto else style.paper,
        "markeredgewidth": 1.2 if is_pareto else 0.4,
        "markersize": LARGE_SPOT if is_pareto else SPOT if len(spots) < CROWD else SPOT / 2,
        "zorder": 3 + is_pareto + 2 * (look is not None),
    }
    said = told(_said(spots[0], style)) if len(spots) == 1 else None
    chart.line(*(spot.at for spot in spots), gid=said, **how)


def _said(spot: BoxPoint, style: Style) -> str:
    """What a point is."""
    numbers, first = ", ".join(str(box.number) for box in spot.boxes), spot.boxes[0]
    family = f"{style.text('family', 'семейство')} {first.family}"
    loss = f"{style.text('loss', 'потери')} {100 * first.loss:.2f} %"
    return f"{numbers}: {family}, {loss}, {style.text('torque', 'момент')} {first.torque:.2f}"


def draw_words(
    chart: Chart,
    listing: BoxListing,
    drawn: Sequence[ListedBox],
    style: Style,
    *,
    has_more: bool,
) -> None:
    """What stands over the axes, and the families beside them."""
    found, families, searched = len(listing.boxes), len(listing.families), listing.searched
    title = style.text(f"Found boxes: {found}", f"Найденные схемы: {found}")
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
    y = chart.height + 14
    if style.titled:
        chart.write(-LEFT, y + 13, title, fontsize=TITLE, weight="bold", va="bottom")
    chart.write(-LEFT, y, "; ".join(notes), color=style.soft, va="bottom")
    _legend(chart, listing, drawn, style)


def _legend(chart: Chart, listing: BoxListing, drawn: Sequence[ListedBox], style: Style) -> None:
    """The families that have a colour, how many are grey, what has a dark edge."""
    families, looks = listing.families, _looks(drawn, style)
    word = style.text("family", "семейство")
    entries = [
        (look, style.paper, f"{word} {family} ({len(families[family])})")
        for family, look in looks.items()
    ]
    rest = len(families) - len(looks)
    grey, open_look = (style.faint, "o"), (style.paper, "o")
    if rest:
        entries.append((grey, style.paper, style.text(f"{rest} others", f"ещё {rest}")))
    if any(box.pareto for box in listing.boxes):
        entries.append((open_look, style.ink, style.text("Pareto list", "список Парето")))
    x, step = chart.width + 14, min(13.0, chart.height / len(entries))
    for row, ((colour, marker), edge, text) in enumerate(entries):
        y = chart.height - 4 - step * row
        how = {"color": colour, "markeredgecolor": edge, "markersize": LARGE_SPOT - 1}
        chart.line((x, y), marker=marker, linestyle="", **how)
        chart.write(x + 8, y, text, va="center")
