"""The half-section as it is drawn: wires of links, planets, signs, names, ports."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any, NamedTuple

from vstatics.pictures.schemes.coaxial.layout import Bar, Upright, framed
from vstatics.pictures.schemes.coaxial.places import (
    Needs,
    SectionPlaces,
    SignRoom,
    heights_of,
    placed_along,
)
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme
from vstatics.pictures.schemes.coaxial.sweep import swept
from vstatics.pictures.schemes.glyphs import FACE, ground, hatching, lines_of
from vstatics.pictures.schemes.scheme import Device, SchemePort, SchemeState
from vstatics.pictures.schemes.sets import (
    HalfSection,
    axles,
    planet_strokes,
    wheel_taps,
    wheel_texts,
)
from vstatics.pictures.schemes.signs import HALF_SIGN, PACK, Coupled, draw_coupled
from vstatics.pictures.schemes.titles import Titles
from vstatics.pictures.schemes.wires import passed
from vstatics.pictures.sheet.groups import grouped
from vstatics.pictures.sheet.labels import Point, Segment, height, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import LINE_WIDTH, Pen, corners
from vstatics.pictures.sheet.style import SMALL, WIDE_MARGIN

PORT = 26.0
"""Length of the arrow of a port. [pt]"""
BRAKE = 20.0
"""From the end of its link to the housing. [pt]"""
SET_NAME = 10.0
"""From the axis to the names of sets below it. [pt]"""
HATCH = 0.5
NAME_GAP = 4.0
"""From the end of a link to its name. [pt]"""
LEAST_HALF = 24.0
"""Half the height of the row of planets, at least. [pt]"""
FITS = 6
"""Times that lines are closed up, at most."""
AXIS_NAME = "1"
"""Of the one axis, in SVG."""


class CoaxialLayout(NamedTuple):
    """A half-section with its places."""

    own: CoaxialScheme
    places: SectionPlaces
    is_ordered: bool
    """False if sets should stand in their order, but do not."""
    is_small: bool = False
    """Whether links have no names but those at the ends of the axis."""
    letters: float = 1.0
    """Size of letters over lengths, where lines are drawn smaller and letters are not."""

    def width(self, text: str, *, bold: bool = False) -> float:
        """Of a text, as lengths are here [pt]."""
        return self.letters * width(text, bold=bold)

    def height(self, text: str) -> float:
        """Of a text, as lengths are here [pt]."""
        return self.letters * height(text)

    @property
    def uprights(self) -> list[Upright]:
        """From left to right."""
        return self.places.frame.uprights

    def section(self, up: Upright) -> HalfSection:
        """A set as it stands there."""
        section = self.own.sections[self.own.sets[up.index]]
        columns = list(section.columns)
        return replace(section, columns=columns[::-1] if up.is_turned else columns)

    def device(self, up: Upright) -> int:
        """The place of a device in the scheme; -1 for what is none."""
        if up.kind == "set":
            return self.own.sets[up.index]
        if up.kind == "pair":
            return self.own.pairs[up.index]
        return self.own.tops[up.index].device if up.kind == "top" else -1

    def name(self, link: int) -> str:
        """Of a link, or of the housing."""
        return "housing" if self.own.is_housing(link) else self.own.scheme.name(link)

    @property
    def ends(self) -> tuple[float, float]:
        """Left and right end of the half-section, without ports."""
        xs = [
            (at + room.left, at + room.right)
            for up, at in zip(self.uprights, self.places.at, strict=True)
            for room in _rooms(self, up)
        ]
        return min(left for left, _ in xs), max(right for _, right in xs)


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
        if high[0] - low[0] <= wide * letters + 0.1:
            break
        letters = max(letters + 0.02, (high[0] - low[0]) / wide)
    return layout


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
    needs = Needs(half, frozenset(range(len(own.pairs))), named)
    layout = bare._replace(places=heights_of(frame, needs))
    rooms = [list(_rooms(layout, up)) for up in frame.uprights]
    offsets = {place: _met(layout, up) for place, up in enumerate(frame.uprights)}
    placed_along(layout.places, rooms, offsets, needs)
    return layout


def _met(layout: CoaxialLayout, up: Upright) -> dict[Bar, list[float]]:
    """Where an upright meets bars, from its place."""
    if up.kind != "set":
        return {bar: [0.0] for bar in up.bars}
    section = layout.section(up)
    pairs = [(bar, section.x(n)) for n, own in enumerate(up.wheels) for bar in own]
    pairs += [(bar, 0.0) for bar in up.left] + [(bar, section.width) for bar in up.right]
    return grouped((bar, x) for bar, x in pairs if bar is not None)


def _rooms(layout: CoaxialLayout, up: Upright) -> Iterator[SignRoom]:
    """What an upright needs of the paper."""
    places, scheme = layout.places, layout.own.scheme
    ys = [places.heights[bar] for bar in up.bars]
    if up.kind in ("start", "end"):
        yield SignRoom(-3, 3, min(places.axis, *ys) - 3, max(ys) + 3)
    elif up.kind == "wall":
        yield SignRoom(-3, 3, min(ys) - 3, max(ys) + 3)
    elif up.kind == "pair":
        name = lines_of(scheme.devices[layout.device(up)].name)
        yield SignRoom(-3, 3, min(ys) - 3, max(ys) + 3)
        middle, high = sum(ys) / 2, layout.height(name) / 2
        yield SignRoom(-9, 9, middle - 8, middle + 8)
        yield SignRoom(9, 14 + layout.width(name), middle - high, middle + high)
    elif up.kind == "top":
        yield SignRoom(-3, 3, min(ys) - 3, places.housing)
        yield SignRoom(-11, 10, places.housing - BRAKE, places.housing + 6)
        name = _top_name(layout, up)
        if name:
            half = layout.width(name) / 2
            yield SignRoom(
                -half, half, places.housing + 7, places.housing + 7 + layout.height(name)
            )
    else:
        yield from _set_rooms(layout, up)


def _loose(layout: CoaxialLayout, up: Upright) -> Iterator[tuple[int, float, float]]:
    """Members of a set that nothing else joins: their names stand beside their ends."""
    if layout.is_small or up.kind != "set":
        return
    section, train = layout.section(up), layout.own.train
    carrier = train.sets[up.index].carrier
    ends = [(carrier, section.width if len(section.levels) > 1 else _pin_end(section), 0.0)]
    ends = [] if any((*up.left, *up.right)) else ends
    for number, own in enumerate(up.wheels):
        for bar in own:
            if bar is not None and bar.first == bar.last:
                ends.append((bar.link, section.x(number), layout.places.heights[bar]))
    at_ends = {train.start, train.end} | {port.link for port in layout.own.scheme.ports}
    for link, x, y in ends:
        others = [one for one in layout.uprights if one is not up]
        elsewhere = any(bar.link == link for one in others for bar in one.all_bars)
        if link not in at_ends and not layout.own.is_housing(link) and not elsewhere:
            yield link, x, y


def _pin_end(section: HalfSection) -> float:
    return section.x(len(section.columns) - 1) + FACE


def _top_name(layout: CoaxialLayout, up: Upright) -> str:
    meaning, scheme = layout.own.tops[up.index], layout.own.scheme
    if meaning.port:
        return scheme.name(meaning.port.link)
    if meaning.device < 0 or scheme.devices[meaning.device].kind == "held":
        return ""
    return lines_of(scheme.devices[meaning.device].name)


def _set_rooms(layout: CoaxialLayout, up: Upright) -> Iterator[SignRoom]:
    places, section = layout.places, layout.section(up)
    is_left = any(up.left)
    is_right = any(up.right) or (not is_left and len(section.levels) > 1)
    last = len(section.columns) - 1
    left = -3.0 if is_left else section.x(0) - FACE - 3
    right = section.width + 3 if is_right else section.x(last) + max(FACE + 3, section.beside(last))
    yield SignRoom(left, right, -places.half, places.half)
    for link, x, y in _loose(layout, up):
        name = layout.name(link)
        yield SignRoom(x, x + NAME_GAP + layout.width(name), y - 5, y + 5)
    for x, own in ((0.0, up.left), (section.width, up.right)):
        for bar in own:
            if bar is not None:
                y = places.heights[bar]
                yield SignRoom(x - 3, x + 3, min(y, 0.0) - 3, max(y, 0.0) + 3)
    for number, own in enumerate(up.wheels):
        for bar in own:
            if bar is not None:
                y, x = places.heights[bar], section.x(number)
                yield SignRoom(x - 3, x + 3, min(y, 0.0) - 3, max(y, 0.0) + 3)
    name = lines_of(layout.own.scheme.devices[layout.device(up)].name)
    middle, half = _middle(section), layout.width(name, bold=True) / 2
    low = places.axis - SET_NAME - layout.height(name)
    yield SignRoom(middle - half, middle + half, low, places.axis - SET_NAME + 2)


def _middle(section: HalfSection) -> float:
    return (section.x(0) + section.x(len(section.columns) - 1)) / 2


def extent(layout: CoaxialLayout) -> tuple[Point, Point]:
    """The lower left and the upper right corner, with room for all but the head."""
    left, right = layout.ends
    places, train = layout.places, layout.own.train
    before = PORT + 6 + layout.width(layout.name(train.start)) + WIDE_MARGIN
    behind = (PORT + 6 + layout.width(layout.name(train.end)) if train.end else 0.0) + WIDE_MARGIN
    rooms = [room for up in layout.uprights for room in _rooms(layout, up)]
    low = min(places.axis - 8, *(room.low for room in rooms)) - 3
    return (left - before, low), (right + behind, max(room.high for room in rooms) + 4)


class Wires(NamedTuple):
    """The lines of links, and where devices meet them."""

    lines: Mapping[int, Sequence[Segment]]
    met: Sequence[tuple[int, int, Point]]
    """A link, a device, a place."""

    def crossings(self) -> list[Point]:
        """Where an upright line of a link meets a level one of another."""
        found: list[Point] = []
        for one, other in combinations(self.lines, 2):
            for first in self.lines[one]:
                for second in self.lines[other]:
                    at = _meeting(first, second)
                    if at is not None and at not in found:
                        found.append(at)
        return found


def _meeting(one: Segment, other: Segment) -> Point | None:
    (a, b), (c, d) = one
    (e, f), (g, h) = other
    left, right = max(a, e), min(c, g)
    low, high = max(b, f), min(d, h)
    return (left, low) if left <= right and low <= high else None


def wires_of(layout: CoaxialLayout) -> Wires:
    """All lines of all links."""
    places = layout.places
    lines: list[tuple[int, Segment]] = []
    met: list[tuple[int, int, Point]] = []
    ends: dict[Bar, list[float]] = {}
    for up, at in zip(layout.uprights, places.at, strict=True):
        for bar, offs in _met(layout, up).items():
            ends.setdefault(bar, []).extend(at + off for off in offs)
        for link, line in _upright_lines(layout, up, at):
            lines.append((link, line))
        met += _meets(layout, up, at)
    left, right = layout.ends
    for bar, xs in ends.items():
        y = places.heights[bar]
        lines.append((bar.link, ((min(xs), y), (max(xs), y))))
    own = layout.own.train
    for link, x, kind in ((own.start, left, "start"), (own.end, right, "end")):
        for up, at in zip(layout.uprights, places.at, strict=True):
            if up.kind == kind:
                low, high = min(x, at), max(x, at)
                lines.append((link, ((low, places.axis), (high, places.axis))))
    kept = [(link, line) for link, line in lines if line[0] != line[1]]
    return Wires(grouped(kept), met)


def _upright_lines(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, Segment]]:  # noqa: C901 - by kind
    places = layout.places
    if up.kind == "set":
        section = layout.section(up)
        carrier = layout.own.train.sets[up.index].carrier
        pins, arms = axles(section, is_left=any(up.left), is_right=any(up.right))
        yield from ((carrier, _moved(line, at)) for line in (*pins, *arms))
        for x, own in ((0.0, up.left), (section.width, up.right)):
            arm = [y for line in arms if line[0][0] == x for _, y in line]
            for bar in own:
                if bar is not None:
                    ys = [*arm, places.heights[bar]]
                    yield carrier, ((at + x, min(ys)), (at + x, max(ys)))
        taps = {(tap.x, tap.side): tap.side * tap.depth for tap in wheel_taps(section)}
        for number, (sun, ring) in enumerate(up.wheels):
            x = section.x(number)
            if sun is not None:
                yield sun.link, ((at + x, places.heights[sun]), (at + x, taps[x, -1]))
            if ring is not None:
                yield ring.link, ((at + x, taps[x, 1]), (at + x, places.heights[ring]))
        return
    ys = sorted(places.heights[bar] for bar in up.bars)
    bars = sorted(up.bars, key=places.heights.__getitem__)
    if up.kind == "pair":
        half = _half(layout, up)
        middle = sum(ys) / 2
        yield bars[0].link, ((at, ys[0]), (at, middle - half))
        yield bars[1].link, ((at, middle + half), (at, ys[1]))
    elif up.kind == "wall":
        yield bars[0].link, ((at, ys[0]), (at, ys[1]))
    elif up.kind == "top":
        yield bars[0].link, ((at, ys[0]), (at, places.housing - BRAKE))
    elif ys[0] != places.axis:
        yield bars[0].link, ((at, places.axis), (at, ys[0]))


def _half(layout: CoaxialLayout, up: Upright) -> float:
    kind = layout.own.scheme.devices[layout.device(up)].kind
    return HALF_SIGN.get(kind, PACK)


def _moved(line: Segment, by: float) -> Segment:
    (a, b), (c, d) = line
    return (a + by, b), (c + by, d)


def _meets(layout: CoaxialLayout, up: Upright, at: float) -> Iterator[tuple[int, int, Point]]:
    """Where a device meets its links."""
    places, device = layout.places, layout.device(up)
    if up.kind == "set":
        section = layout.section(up)
        carrier = layout.own.train.sets[up.index].carrier
        pins, _ = axles(section, is_left=any(up.left), is_right=any(up.right))
        for (x, y), (end, _) in pins:
            yield carrier, device, (at + x, y)
            yield carrier, device, (at + end, y)
        for tap in wheel_taps(section):
            if tap.wire:
                yield tap.wire, device, (at + tap.x, tap.side * tap.depth)
    elif up.kind == "pair":
        bars = sorted(up.bars, key=places.heights.__getitem__)
        middle = sum(places.heights[bar] for bar in bars) / 2
        for bar, side in zip(bars, (-1, 1), strict=True):
            yield bar.link, device, (at, middle + side * _half(layout, up))
    elif up.kind == "top" and device >= 0:
        yield up.bars[0].link, device, (at, places.housing - BRAKE)


class Paint(NamedTuple):
    """A half-section on paper, in a state."""

    pen: Pen
    layout: CoaxialLayout
    state: SchemeState
    titles: Titles

    def color(self, index: int) -> str:
        """Of a device."""
        style = self.pen.style
        if index in self.state.engaged:
            return style.engaged
        return style.faint if index in self.state.idle else style.ink

    def text_color(self, index: int) -> str:
        """Of the name of a device."""
        return self.pen.style.soft if index in self.state.idle else self.color(index)

    def rod_color(self, index: int) -> str:
        """Of what leads to a coupling."""
        loaded = self.state.loaded
        return self.color(index) if loaded is None or loaded[index] else self.pen.style.faint

    @property
    def scale(self) -> float:
        """Of letters over lines."""
        return self.pen.letters

    def name_color(self, link: int) -> str:
        """Of the name of a link."""
        return self.pen.style.soft if link in self.state.idle_links else self.pen.style.ink

    def text(self, pen: Pen, at: Point, text: str, **look: Any) -> None:
        """A text by its middle."""
        centred: Look = {"ha": "center", "va": "center", "linespacing": 1.0, "zorder": 8}
        pen.text(*at, text, **centred | look)

    def _of_device(self, device: Device) -> Pen:
        """What draws in the group of a device."""
        kind = "element" if device.is_shift_element else "mechanism"
        return self.pen.within(kind, name=device.name)

    def all(self) -> None:
        """Everything."""
        places, (left, right) = self.layout.places, self.layout.ends
        ends = (left - PORT, places.axis), (right + PORT, places.axis)
        look: Look = {"linestyle": (0, (12, 3, 2, 3)), "kind": "axis", "data": {"axis": AXIS_NAME}}
        self.pen.line(*ends, color=self.pen.style.faint, width=0.8, **look)
        self._links()
        for up, at in zip(self.layout.uprights, places.at, strict=True):
            if up.kind == "set":
                self._set(up, at)
            elif up.kind == "pair":
                self._pair(up, at)
            elif up.kind == "top":
                self._top(up, at)
        self._ports()

    def _links(self) -> None:
        wires = wires_of(self.layout)
        style, loaded = self.pen.style, self.state.loaded
        ends = [*wires.met, *self._port_points()]
        for link, lines in wires.lines.items():
            pen = self.pen.within("link", name=self.layout.name(link), axis=AXIS_NAME)
            runs = [(line, True) for line in lines]
            points = {at for line in lines for at in line}
            if loaded is not None and not self.layout.own.is_housing(link):
                met = {p for one, d, p in ends if one == link and (d < 0 or link in loaded[d])}
                runs, points = passed(lines, met)
            look: Look = {"title": self.titles.links.get(link, ""), "zorder": 3}
            for color, there in ((style.faint, False), (style.ink, True)):
                own = [line for line, one in runs if one == there]
                pen.lines(own, color=color, kind="wire", solid_capstyle="projecting", **look)
            self._joints(pen, lines, points)
        for x, y in wires.crossings():
            gaps = [((x - 5, y), (x - 1.4, y)), ((x + 1.4, y), (x + 5, y))]
            self.pen.lines(gaps, color=style.paper, width=3.0, kind="crossing", zorder=3.5)
        for link, at in self.layout.places.names.items():
            pen = self.pen.within("link", name=self.layout.name(link), axis=AXIS_NAME)
            name = self.layout.name(link)
            half, high = (width(name) / 2 + 1.5) * self.scale, 4.0 * self.scale
            self.pen.area(
                *corners(at[0] - half, at[1] - high, at[0] + half, at[1] + high),
                color=self.pen.style.paper,
                zorder=3.6,
            )
            self.text(pen, at, name, color=self.name_color(link))

        for up, x in zip(self.layout.uprights, self.layout.places.at, strict=True):
            for link, by, y in _loose(self.layout, up):
                pen = self.pen.within("link", name=self.layout.name(link), axis=AXIS_NAME)
                look = {"color": self.name_color(link), "ha": "left"}
                self.text(pen, (x + by + NAME_GAP, y), self.layout.name(link), **look)

    def _joints(self, pen: Pen, lines: Sequence[Segment], points: set[Point]) -> None:
        """Dots where a link branches."""
        found: dict[Point, int] = {}
        for one, other in combinations(lines, 2):
            at = _meeting(one, other)
            if at is not None and (at not in one or at not in other):
                found[at] = found.get(at, 0) + 1
        look: Look = {"width": 4.0, "zorder": 6, "solid_capstyle": "round", "snap": False}
        for color, there in ((self.pen.style.faint, False), (self.pen.style.ink, True)):
            dots = [(x, y) for x, y in found if ((x, y) in points) == there]
            pen.lines([((x, y), (x + 0.1, y)) for x, y in dots], color=color, **look)

    def _port_points(self) -> Iterator[tuple[int, int, Point]]:
        (left, right), train = self.layout.ends, self.layout.own.train
        used = {
            port.link for port in self.layout.own.scheme.ports if port not in self.state.idle_ports
        }
        for link, x in ((train.start, left), (train.end, right)):
            if link in used:
                yield link, -1, (x, self.layout.places.axis)
        for up, at in zip(self.layout.uprights, self.layout.places.at, strict=True):
            if up.kind == "top" and self.layout.own.tops[up.index].port:
                yield up.bars[0].link, -1, (at, self.layout.places.housing - BRAKE)

    def _set(self, up: Upright, at: float) -> None:
        layout, index = self.layout, self.layout.device(up)
        section, device = layout.section(up), layout.own.scheme.devices[index]
        pen = self._of_device(device)
        color, said = self.color(index), self.titles.devices.get(index, "")
        taps = list(wheel_taps(section))
        strokes = [*planet_strokes(section)]
        looks: dict[float, list[Sequence[Point]]] = {}
        for stroke in strokes:
            points = [(at + x, y) for x, y in stroke.points]
            looks.setdefault(stroke.width, []).append(points)
        faces = [(at + tap.x, tap.side * tap.depth) for tap in taps]
        looks.setdefault(0.9, []).extend(((x - FACE, y), (x + FACE, y)) for x, y in faces)
        if index in self.state.pieces:
            xs, ys = zip(*(p for own in looks.values() for line in own for p in line), strict=True)
            lines = hatching((min(xs), min(ys)), (max(xs), max(ys)))
            pen.lines(lines, color=pen.style.soft, width=HATCH, zorder=1)
        for thick, own in looks.items():
            title = said if thick == LINE_WIDTH else ""
            pen.lines(
                own, color=color, width=thick, zorder=4, solid_capstyle="projecting", title=title
            )
        ink = self.text_color(index)
        for (x, y), va, text in wheel_texts(section, taps):
            self.text(pen, (at + x, y), text, color=ink, size=SMALL, ha="left", va=va, over=True)
        name = at + _middle(section), layout.places.axis - SET_NAME
        self.text(pen, name, lines_of(device.name), color=ink, bold=True, va="top")

    def _pair(self, up: Upright, at: float) -> None:
        layout, index = self.layout, self.layout.device(up)
        device, heights = layout.own.scheme.devices[index], layout.places.heights
        pen = self._of_device(device)
        middle = sum(heights[bar] for bar in up.bars) / 2
        first = up.bars[0].link == device.members.get("first")
        low_first = first == (heights[up.bars[0]] < heights[up.bars[1]])
        side = _half(layout, up) * (1 if low_first else -1)
        closed = index in self.state.engaged
        said = self.titles.devices.get(index, "")
        ends = (at, middle - side), (at, middle + side)
        look = device.kind, *ends, self.color(index), closed, self.rod_color(index), 0, said
        draw_coupled(pen, Coupled(*look))
        name = {"color": self.text_color(index), "bold": closed, "ha": "left"}
        self.text(pen, (at + 12, middle), lines_of(device.name), **name)

    def _top(self, up: Upright, at: float) -> None:
        layout, meaning = self.layout, self.layout.own.tops[up.index]
        roof = layout.places.housing
        ends = (at, roof - BRAKE), (at, roof)
        if meaning.port:
            self._port_arrow(meaning.port, (at, roof - BRAKE), (0.0, 1.0))
            self.text(self.pen, (at, roof + 8), _top_name(layout, up), va="bottom")
            return
        if meaning.device < 0:
            pen = self.pen.within("link", name="housing", axis=AXIS_NAME)
            lines = [ends, *ground((at, roof), 1)]
            pen.lines(lines, color=self.pen.style.ink, zorder=4.5)
            return
        index = meaning.device
        device = layout.own.scheme.devices[index]
        pen = self._of_device(device)
        closed, said = index in self.state.engaged, self.titles.devices.get(index, "")
        is_back = device.members.get("first") == 0
        look = (
            device.kind,
            *ends,
            self.color(index),
            closed,
            self.rod_color(index),
            1,
            said,
            is_back,
        )
        draw_coupled(pen, Coupled(*look))
        name = {"color": self.text_color(index), "bold": closed, "va": "bottom"}
        self.text(pen, (at, roof + 8), _top_name(layout, up), **name)

    def _ports(self) -> None:
        layout, (left, right) = self.layout, self.layout.ends
        train, y = layout.own.train, layout.places.axis
        for link, x, way in ((train.start, left, -1.0), (train.end, right, 1.0)):
            if not link:
                continue
            ports = [p for p in layout.own.scheme.ports if p.link == link]
            is_used = [p for p in ports if p not in self.state.idle_ports]
            self._port_arrow((is_used or ports)[0], (x, y), (way, 0.0))
            at = x + way * (PORT + 5), y
            ha = "left" if way > 0 else "right"
            self.text(self.pen, at, layout.name(link), color=self.name_color(link), ha=ha)

    def _port_arrow(self, port: SchemePort, at: Point, way: Point) -> None:
        role = "input" if port.role == "input" else "output"
        pen, (x, y), (dx, dy) = self.pen.within("port", port=role), at, way
        is_idle = port in self.state.idle_ports
        color = pen.style.faint if is_idle else pen.style.ink
        end = x + dx * PORT, y + dy * PORT
        pen.line(at, end, color=color, zorder=3)
        known = self.state.leaving.get(port)
        ways = {known} if known is not None else {port.role != "input"}
        ways = {True, False} if port.role == "given" and known is None else ways
        for leaves in ways:
            tip = end if leaves else (x + 4 * dx, y + 4 * dy)
            back = -9.0 if leaves else 9.0
            base = tip[0] + back * dx, tip[1] + back * dy
            head = (
                tip,
                (base[0] - 3.5 * dy, base[1] + 3.5 * dx),
                (base[0] + 3.5 * dy, base[1] - 3.5 * dx),
            )
            pen.area(*head, color=color, width=0.5, joinstyle="round", zorder=4)


def crossings_of(layout: CoaxialLayout) -> int:
    """How often two links cross."""
    return len(wires_of(layout).crossings())
