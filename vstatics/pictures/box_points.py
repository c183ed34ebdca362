"""Found boxes as points: mean loss over the largest torque, families told apart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullLocator

from vstatics.pictures.box_numbers import LARGE_SPOT, NEAR, SPOT, BoxPoint, number_spots
from vstatics.pictures.labels import Panel
from vstatics.pictures.style import TITLE, Style
from vstatics.synthesis.box_listing import BoxListing, ListedBox

MARKERS = "os^Dv"
"""Of families, each in all colours."""
ROOM = 0.06
"""Beside the outermost points, as a part of the axis."""
LEAST_ROOM = 0.05
"""At least, as a part of the largest number."""
CROWD = 1000
"""From so many points of one look on they are small."""
LEFT = 40.0
"""From the words over the axes to these. [pt]"""
WIDELY = 8.0
"""A scale is logarithmic if the largest value is so many times the smallest."""
Look = tuple[str, str]
"""Colour and marker."""


def has_place(box: ListedBox) -> bool:
    """Whether a box has both figures."""
    return math.isfinite(box.loss) and math.isfinite(box.torque)


def draw_points(
    panel: Panel, listing: BoxListing, drawn: Sequence[ListedBox], style: Style
) -> None:
    """All boxes that have both figures as points, those with a diagram by their numbers.

    Parameters
    ----------
    drawn : sequence of ListedBox
        Those with a diagram; their families have colours, others are grey.
    """
    boxes = [box for box in listing.boxes if has_place(box)]
    _axes(panel, boxes, style)
    looks = _looks(drawn, style)
    spots = list(_spots(panel, boxes))
    alike: dict[tuple[Look | None, bool], list[BoxPoint]] = {}
    for spot in spots:
        alike.setdefault((looks.get(spot.boxes[0].family), spot.is_pareto), []).append(spot)
    for (look, is_pareto), own in alike.items():
        _draw_spots(panel, own, look, style, is_pareto=is_pareto)
    number_spots(panel, spots, {box.number for box in drawn}, style)


def _axes(panel: Panel, boxes: Sequence[ListedBox], style: Style) -> None:
    axes = panel.axes
    _scale(axes, "x", [box.torque for box in boxes])
    _scale(axes, "y", [100 * box.loss for box in boxes])
    axes.set_xlabel(
        style.text(
            "largest torque of an engaged element / input torque",
            "наибольший момент включённого элемента / момент на входе",
        )
    )
    axes.set_ylabel(style.text("mean loss, forward gears [%]", "средние потери вперёд [%]"))
    axes.grid(visible=True, linewidth=0.4)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _scale(axes: Axes, along: Literal["x", "y"], values: Sequence[float]) -> None:
    """Ends and ticks of an axis, logarithmic where values differ much."""
    if values and 0 < WIDELY * min(values) < max(values):
        ends = [math.exp(end) for end in _ends([math.log(one) for one in values])]
        locator = LogLocator(subs=(1.0, 2.0, 5.0))
        axis: Axis = axes.xaxis if along == "x" else axes.yaxis
        axes.set(**{f"{along}scale": "log", f"{along}lim": ends})
        axis.set_major_locator(locator)
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_locator(NullLocator())
    else:
        axes.set(**{f"{along}lim": _ends(values)})


def _ends(values: Sequence[float]) -> tuple[float, float]:
    """The ends of an axis: beside all values, and apart where these differ by rounding.

    >>> _ends([2.0, 2.0]), _ends([])
    ((1.9, 2.1), (0.0, 1.0))
    """
    if not values:
        return 0.0, 1.0
    low, high = min(values), max(values)
    room = max(ROOM * (high - low), LEAST_ROOM * max(abs(low), abs(high))) or LEAST_ROOM
    return low - room, high + room


def _looks(drawn: Sequence[ListedBox], style: Style) -> dict[int, Look]:
    """Colour and marker of each family that has a diagram."""
    families = dict.fromkeys(box.family for box in drawn)
    colours = len(style.colours)
    return {
        family: (style.colour(place), MARKERS[place // colours % len(MARKERS)])
        for place, family in enumerate(families)
    }


def _spots(panel: Panel, boxes: Sequence[ListedBox]) -> Iterator[BoxPoint]:
    """Boxes by their places; those of a family that coincide are together."""
    found: dict[tuple[int, int, int], BoxPoint] = {}
    for box in boxes:
        part = panel.axes.transLimits.transform(
            panel.axes.transScale.transform((box.torque, 100 * box.loss))
        )
        at = float(part[0]) * panel.width, float(part[1]) * panel.height
        key = box.family, round(at[0] / NEAR), round(at[1] / NEAR)
        found.setdefault(key, BoxPoint(at, [])).boxes.append(box)
    yield from found.values()


def _draw_spots(
    panel: Panel, spots: Sequence[BoxPoint], look: Look | None, style: Style, *, is_pareto: bool
) -> None:
    colour, marker = look or (style.faint, "o")
    panel.axes.plot(
        [spot.at[0] / panel.width for spot in spots],
        [spot.at[1] / panel.height for spot in spots],
        marker,
        transform=panel.axes.transAxes,
        color=colour,
        markeredgecolor=style.ink if is_pareto else style.paper,
        markeredgewidth=1.2 if is_pareto else 0.4,
        markersize=LARGE_SPOT if is_pareto else SPOT if len(spots) < CROWD else SPOT / 2,
        zorder=3 + is_pareto + 2 * (look is not None),
    )


def draw_words(panel: Panel, listing: BoxListing, drawn: Sequence[ListedBox], style: Style) -> None:
    """What stands over the axes, and the families beside them."""
    found, families, searched = len(listing.boxes), len(listing.families), listing.searched
    title = style.text(f"Found boxes: {found}", f"Найденные схемы: {found}")
    together = "family" if families == 1 else "families"
    said = style.text(
        f"{searched} looked at, {families} {together} with equal ratios",
        f"рассмотрено {searched}, семейств с равными передаточными отношениями: {families}",
    )
    placeless = sum(not has_place(box) for box in listing.boxes)
    if placeless:
        more = style.text("without loss or torque", "без потерь или момента")
        said = f"{said}; {more}: {placeless}"
    y = panel.height + 14
    panel.write(-LEFT, y + 13, title, fontsize=TITLE, weight="bold", va="bottom")
    panel.write(-LEFT, y, said, color=style.soft, va="bottom")
    _legend(panel, listing, drawn, style)


def _legend(panel: Panel, listing: BoxListing, drawn: Sequence[ListedBox], style: Style) -> None:
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
    x, step = panel.width + 14, min(13.0, panel.height / len(entries))
    for row, ((colour, marker), edge, text) in enumerate(entries):
        y = panel.height - 4 - step * row
        how = {"color": colour, "markeredgecolor": edge, "markersize": LARGE_SPOT - 1}
        panel.line((x, y), marker=marker, linestyle="", **how)
        panel.write(x + 8, y, text, va="center")
