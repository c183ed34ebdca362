"""Lever diagrams of a case, in which a script shows the speeds at the selected time.

Points on a lever have true distances; speeds are drawn to the right of the points.
"""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.html import Markup, joined, tag
from vstatics.core.texts import heading, tr
from vstatics.pictures.drawing.labels import widest
from vstatics.pictures.drawing.style import SIZE
from vstatics.pictures.lever.places import LeverCell, page_of
from vstatics.pictures.lever.routes import LeverRow
from vstatics.pictures.paged.drawn import PAGE, in_spoken

BESIDE = 8.0
"""Distance from a lever to the names of its points, and to the speeds. [pt]"""
ACROSS = 130.0
"""Width from the lowest to the highest speed in the run. [pt]"""
NUMBER = 48.0
"""Width of a printed speed. [pt]"""
LARGER = 1.25
"""Pixels on the page per pt of the figure."""
MARGIN = 4.0
"""Margin above and below a lever. [pt]"""


def moving_levers(case: Transmission) -> Iterator[Markup]:
    """Yield a figure for each lever of a case; shafts without gear sets have no lever.

    A point is ``<g data-link="sun">``; the point of the housing has no `data-link`. The script sets
    the bar and number of each speed, and the line through the speeds of all points.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> [shown] = moving_levers(case)
    >>> shown.count("<g "), shown.count('data-link="2"')
    (3, 1)
    """
    page = page_of(case, in_spoken(PAGE))
    for cell in page.cells if page else ():
        if cell.lever.devices:
            yield tag("figure", tag("figcaption", cell.lever.name), _lever(case, cell))


def _lever(case: Transmission, cell: LeverCell) -> Markup:
    rows = cell.rows
    spans = [row.span for row in rows.values()]
    top = max(high for _, high in spans) + MARGIN
    high = top - min(low for low, _ in spans) + MARGIN
    at = widest(row.name for row in rows.values()) + BESIDE
    start = at + BESIDE
    wide = start + ACROSS + NUMBER
    heights = [top - row.at for row in rows.values()]
    ends = {"y1": _length(min(heights)), "y2": _length(max(heights))}
    lever = tag("line", x1=_length(at), x2=_length(at), class_="bar-of-lever", **ends)
    through = tag("polyline", class_="through") if cell.lever.ratio is None else ""
    points = (
        _point(case, cell.lever.nodes[node].link, row, top, (at, wide))
        for node, row in rows.items()
    )
    return tag(
        "svg",
        tag("line", class_="rest", **ends),
        lever,
        *points,
        through,
        viewBox=f"0 0 {_length(wide)} {_length(high)}",
        width=_length(LARGER * wide),
        role="img",
        aria_label=tr("Lever {name}", name=cell.lever.name),
        data_from=_length(start),
        data_to=_length(start + ACROSS),
    )


def _point(
    case: Transmission, link: int, row: LeverRow, top: float, across: tuple[float, float]
) -> Markup:
    """Return a point on the lever with the name of its link, and the speed next to it."""
    (at, wide), y, point = across, _length(top - row.y), _length(top - row.at)
    texts = row.name.split("\n")
    lines = [
        tag("tspan", text, x="0", dy=False if n == 0 else _length(1.1 * SIZE))
        for n, text in enumerate(texts)
    ]
    first = _length(top - row.y - 3.5 - 1.1 * SIZE * (len(texts) - 1))
    bent = f"M0 {y}H{_length(at - BESIDE)}L{_length(at)} {point}H{_length(at + BESIDE)}"
    return tag(
        "g",
        tag("text", *lines, y=first),
        tag("path", d=bent),
        tag("circle", cx=_length(at), cy=point, r="2.4"),
        tag("line", class_="speed", y1=point, y2=point),
        tag("text", class_="number", x=_length(wide), y=_length(top - row.at + SIZE / 3)),
        data_link=case.link_names[link - 1] if link else False,
        data_at=point,
    )


def _length(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")


def moving_speeds(links: tuple[str, ...]) -> Markup:
    """Return a table of the speeds of links at the selected time."""
    rows = (
        tag(
            "tr",
            tag("th", name, scope="row"),
            tag("td", data_link=name),
        )
        for name in links
    )
    head = tag("tr", *(tag("th", heading(name), scope="col") for name in ("link", "speed, rpm")))
    return tag("table", tag("thead", head), tag("tbody", joined(*rows)), class_="speeds-now")
