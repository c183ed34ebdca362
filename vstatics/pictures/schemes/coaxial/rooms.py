"""Rectangles that symbols and texts of a half-section need, and points where uprights meet bars."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.style import WIDE_MARGIN
from vstatics.pictures.schemes.boxes import BoxSection
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import Bar, Upright
from vstatics.pictures.schemes.coaxial.places import SignRoom
from vstatics.pictures.schemes.gear_glyphs import DEVICE_NAME_LETTERS, lines_of
from vstatics.pictures.schemes.ink import ARROW
from vstatics.pictures.schemes.scheme import Device, ratio_text
from vstatics.pictures.schemes.sets import HalfSection

BRAKE_LENGTH = 20.0
"""Distance from the end of a link to the housing, for a brake. [pt]"""
PORT_NAME = 5.0
"""Distance from an arrow to the name of the link. [pt]"""
SET_NAME = 10.0
"""Distance from the axis down to the names of gear sets. [pt]"""
LINK_NAME_GAP = 4.0
"""Distance from the end of a link to the name of the link. [pt]"""


def met_by(layout: CoaxialLayout, up: Upright) -> dict[Bar, list[float]]:
    """Return the positions where an upright meets each bar, relative to the upright [pt]."""
    if up.kind != "set":
        return {bar: [0.0] for bar in up.bars}
    section = layout.section(up)
    xs = map(section.x, range(len(up.wheels)))
    pairs = [(bar, x) for x, both in zip(xs, up.wheels, strict=True) for bar in both]
    pairs += [(bar, 0.0) for bar in up.left] + [(bar, section.width) for bar in up.right]
    return grouped((bar, x) for bar, x in pairs if bar is not None)


def rooms_of(layout: CoaxialLayout, up: Upright) -> Iterator[SignRoom]:
    """Yield the rectangles that the symbol and texts of an upright need."""
    places, scheme = layout.places, layout.coaxial.scheme
    for link, x, y in loose_names(layout, up):
        name = layout.name(link)
        yield SignRoom(x, x + LINK_NAME_GAP + layout.width(name), y - 5, y + 5)
    ys = [places.heights[bar] for bar in up.bars]
    if up.kind in ("start", "end"):
        yield SignRoom(-3, 3, min(places.axis, *ys) - 3, max(ys) + 3)
    elif up.kind in ("wall", "pair"):
        yield SignRoom(-3, 3, min(ys) - 3, max(ys) + 3)
        if up.kind == "wall":
            return
        middle, (wide, high) = layout.middle(up), layout.box_size(up)
        if wide:
            wide, high = wide / 2 + 2, high / 2 + 2
            yield SignRoom(-wide, wide, middle - high, middle + high)
            return
        name = pair_name(scheme.devices[layout.device(up)], layout.line_letters)
        high = layout.height(name) / 2
        yield SignRoom(-9, 9, middle - 8, middle + 8)
        yield SignRoom(9, 14 + layout.width(name, bold=True), middle - high, middle + high)
    elif up.kind == "top":
        yield SignRoom(-3, 3, min(ys) - 3, places.housing)
        yield SignRoom(-11, 10, places.housing - BRAKE_LENGTH, places.housing + 6)
        name = top_name(layout, up)
        if name:
            # The name of an engaged shift element is bold, which is wider.
            half = layout.width(name, bold=True) / 2
            yield SignRoom(
                -half, half, places.housing + 7, places.housing + 7 + layout.height(name)
            )
    else:
        yield from _of_set(layout, up)


def loose_names(layout: CoaxialLayout, up: Upright) -> Iterator[tuple[int, float, float]]:
    """Yield unconnected links, each with the point next to the name."""
    if layout.is_small or up.kind not in {"set", "pair", "top"}:
        return
    heights, names = layout.places.heights, set(layout.named_beside)
    for link, x, y in _set_ends(layout, up) if up.kind == "set" else ():
        others = [other for other in layout.uprights if other is not up]
        elsewhere = any(bar.link == link for other in others for bar in other.all_bars)
        if not elsewhere and link not in names and not layout.coaxial.is_housing(link):
            yield link, x, y
    for bar in up.bars:
        links = [drawn_bar.link for drawn_bar in layout.places.frame.bars]
        if bar.first == bar.last and bar.link not in names and links.count(bar.link) == 1:
            yield bar.link, 0.0, heights[bar]


def _set_ends(layout: CoaxialLayout, up: Upright) -> Iterator[tuple[int, float, float]]:
    """Yield the unconnected members of a gear set, each with the end of the line."""
    section, carrier = layout.section(up), layout.coaxial.train.sets[up.index].carrier
    ends = [(carrier, section.width, 0.0)]
    if len(section.levels) == 1:  # the name of a planet gear is above the end of its pin
        is_below = any(rim in section.names for rim in section.columns[-1].rims.values())
        drop = layout.height(layout.name(carrier)) / 2 + 1
        ends = [(carrier, section.pin_end, -drop * is_below)]
    ends = [] if any((*up.left, *up.right)) else ends
    for number, both in enumerate(up.wheels):
        for bar in both:
            if bar is not None and bar.first == bar.last:
                ends.append((bar.link, section.x(number), layout.places.heights[bar]))
    yield from ends


def pair_name(device: Device, letters: int = DEVICE_NAME_LETTERS) -> str:
    """Return the name of a component between two links, with the ratio of a mechanism."""
    name = lines_of(device.name, letters)
    is_bare = device.kind == "mechanism"
    return f"{name}\n{ratio_text(device.ratio)}" if is_bare else name


def top_name(layout: CoaxialLayout, up: Upright) -> str:
    """Return the name of a component at the housing; empty for a support."""
    meaning, scheme = layout.coaxial.tops[up.index], layout.coaxial.scheme
    if meaning.port:
        return scheme.name(meaning.port.link)
    if meaning.device < 0 or scheme.devices[meaning.device].kind == "held":
        return ""
    return layout.device_name(meaning.device)


def _of_set(layout: CoaxialLayout, up: Upright) -> Iterator[SignRoom]:
    places, section = layout.places, layout.section(up)
    is_left = any(up.left)
    is_right = any(up.right) or (not is_left and len(section.levels) > 1)
    left, right = section.faces
    left = -3.0 if is_left else left - 3
    right = section.width + 3 if is_right else right + 3
    yield SignRoom(left, right, -places.half, places.half)
    wheels = ((section.x(number), both) for number, both in enumerate(up.wheels))
    for x, both in ((0.0, up.left), (section.width, up.right), *wheels):
        for bar in both:
            if bar is not None:
                y = places.heights[bar]
                yield SignRoom(x - 3, x + 3, min(y, 0.0) - 3, max(y, 0.0) + 3)
    if isinstance(section, BoxSection):
        return
    name = layout.device_name(layout.device(up))
    middle, half = middle_of(section), layout.width(name, bold=True) / 2
    low = places.axis - SET_NAME - layout.height(name)
    yield SignRoom(middle - half, middle + half, low, places.axis - SET_NAME + 2)


def middle_of(section: HalfSection) -> float:
    """Return the middle between the outer planes of a gear set, from the left end [pt]."""
    return (section.x(0) + section.x(len(section.columns) - 1)) / 2


def extent(layout: CoaxialLayout) -> tuple[Point, Point]:
    """Return the lower left and upper right corner of the drawing without heading [pt]."""
    places, train = layout.places, layout.coaxial.train
    before, behind = (
        (ARROW + PORT_NAME + 1 + layout.width(layout.name(link)) if link else 0.0) + WIDE_MARGIN
        for link in (train.start, train.end)
    )
    rooms = _placed_rooms(layout)
    low = min(places.axis - 8, *(room.low for room in rooms)) - 3
    high = max(room.high for room in rooms) + 4
    left, right = min(room.left for room in rooms), max(room.right for room in rooms)
    return (left - before, low), (right + behind, high)


def ends_of(layout: CoaxialLayout) -> tuple[float, float]:
    """Return the positions of the left and right end of a half-section, without ports [pt]."""
    rooms = _placed_rooms(layout)
    return min(room.left for room in rooms), max(room.right for room in rooms)


def axis_ends(layout: CoaxialLayout) -> list[tuple[int, Point, float]]:
    """Return the link at each end of the axis (0 for no link), with point and direction."""
    (left, right), train, y = ends_of(layout), layout.coaxial.train, layout.places.axis
    return [(train.start, (left, y), -1.0), (train.end, (right, y), 1.0)]


def _placed_rooms(layout: CoaxialLayout) -> list[SignRoom]:
    """Return the rectangles of all uprights, relative to the origin of the picture."""
    return [
        room._replace(left=at + room.left, right=at + room.right)
        for up, at in zip(layout.uprights, layout.places.at, strict=True)
        for room in rooms_of(layout, up)
    ]
