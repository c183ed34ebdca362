"""Drawing of planetary gear sets of any kind: planets above suns, rings above planets.

Gears in one plane form a column. Meshing planets are on different levels: those that mesh with the
sun below, those that mesh with the ring above.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import permutations, product
from operator import itemgetter
from typing import Self

from vstatics.core.elements.element import CentralWheel
from vstatics.core.elements.group import PlanetGroup
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Segment, Span, width
from vstatics.pictures.drawing.style import SMALL
from vstatics.pictures.schemes.gear_glyphs import (
    ABOVE,
    BELOW,
    FACE,
    MESH,
    SLEEVE,
    Glyph,
    Stroke,
    Tap,
    teeth,
)

RADIUS, SMALL_RADIUS = 14.0, 9.0
"""Drawn radii of the larger and the smaller gear of a planet. [pt]"""
LEVEL = 2 * RADIUS + MESH
"""Vertical distance between levels of planets. [pt]"""
PLANE_DISTANCE = 34.0
"""Distance between planes of gears. [pt]"""
CARRIER_ARM = 16.0
"""Distance from the outermost gear to the arm of the carrier. [pt]"""
LEFT, RIGHT = 0, 1
MOST_COLUMNS = 6
"""Largest number of columns for which all orders are tried."""


@dataclass
class WheelColumn:
    """Gears in a common plane: planet gears by level, with a sun below and a ring above."""

    rims: dict[int, str]
    sun: CentralWheel | None = None
    ring: CentralWheel | None = None

    def bars(self, level: int) -> bool:
        """Return whether a gear of the plane blocks the axle of a planet on a level."""
        if level < min(self.rims):
            return self.sun is not None
        return level <= max(self.rims) or self.ring is not None


@dataclass(frozen=True)
class HalfSection:
    """Half-section, above the axis, of a group of planets with the suns and rings."""

    group: PlanetGroup
    levels: Mapping[str, int]
    """Level of each planet, from 0 at the sun."""
    columns: Sequence[WheelColumn]
    names: Mapping[str, str] = field(default_factory=dict)
    """Text next to each gear, by the name of the gear."""
    letters: float = 1.0
    """Ratio of the size of letters to lengths. [-]"""

    def with_teeth_alone(self) -> Self:
        """Return a copy in which gears have tooth numbers without names."""
        texts = {member: name.rpartition(" ")[2] for member, name in self.names.items()}
        return replace(self, names=texts)

    def x(self, column: int) -> float:
        """Return the position of the plane of a column, from the left end [pt]."""
        return (
            CARRIER_ARM + FACE + sum(max(PLANE_DISTANCE, self.name_width(n)) for n in range(column))
        )

    @property
    def width(self) -> float:
        """Distance between the carrier arms at both ends [pt]."""
        last = len(self.columns) - 1
        return self.x(last) + max(CARRIER_ARM + FACE, self.name_width(last))

    def name_width(self, column: int) -> float:
        """Return the width that the names of a column need to the right of the plane [pt]."""
        plane = self.columns[column]
        wheels = [wheel.member for wheel in (plane.sun, plane.ring) if wheel is not None]
        texts = [
            self.names[member] for member in (*plane.rims.values(), *wheels) if member in self.names
        ]
        return max((self.letters * width(text, SMALL) + FACE + 6 for text in texts), default=0.0)

    @property
    def tall(self) -> float:
        """Height needed above the middle of the row [pt]."""
        return max(abs(y) for stroke in planet_strokes(self) for _, y in stroke.points) + 8

    @property
    def faces(self) -> Span:
        """Left and right end of the gears with the names, without carrier arms [pt]."""
        last = len(self.columns) - 1
        return self.x(0) - FACE, self.x(last) + max(FACE, self.name_width(last) - 3)

    @property
    def pin_end(self) -> float:
        """Right end of the planet pin if the carrier is unconnected [pt]."""
        return self.x(len(self.columns) - 1) + FACE

    def y(self, level: int) -> float:
        """Return the height of the axles of planets on a level [pt]."""
        top = max(self.levels.values())
        return LEVEL * (level - top / 2)

    def planes(self, planet: str) -> list[int]:
        """Return the indices of the columns with a gear of a planet."""
        rims = self.group.planets[planet]
        return [n for n, col in enumerate(self.columns) if set(col.rims.values()) & set(rims)]

    def reach(self, rim: str) -> Span:
        """Return the positions of the first and the last plane with a planet gear [pt]."""
        planes = [n for n, column in enumerate(self.columns) if rim in column.rims.values()]
        return self.x(planes[0]), self.x(planes[-1])

    def radius(self, rim: str) -> float:
        """Return the drawn radius of a planet gear [pt].

        A smaller gear of a stepped planet is drawn smaller unless another planet meshes with it. A
        gear with a name is drawn large, because the name needs the height above the pin.
        """
        if rim in self.names:
            return RADIUS
        rims = self.group.planets[self.group.planet_of[rim]]
        meshed = {rim_name for pair in self.group.meshes for rim_name in pair}
        largest = max(self.group.teeth(other) for other in rims)
        return SMALL_RADIUS if rim not in meshed and self.group.teeth(rim) < largest else RADIUS

    def barred(self, planet: str, side: int) -> int:
        """Return the number of planes that block the axle of a planet on the left or right side."""
        planes, level = self.planes(planet), self.levels[planet]
        first = planes[0] if side == RIGHT else 0
        last = len(self.columns) if side == RIGHT else planes[-1]
        between = [n for n in range(first, last) if n not in planes]
        return sum(self.columns[n].bars(level) for n in between)


def section_of(group: PlanetGroup) -> HalfSection:
    """Return the half-section of a group, with the planes in the order that blocks axles least."""
    levels = _levels(group)
    columns = _columns(group, levels)
    orders = permutations(columns) if len(columns) <= MOST_COLUMNS else [columns]
    return min((HalfSection(group, levels, order) for order in orders), key=_disorder)


def _disorder(section: HalfSection) -> float:
    planets = section.group.planets
    spread = sum(section.planes(p)[-1] - section.planes(p)[0] for p in planets)
    barred = [[section.barred(p, side) for p in planets] for side in (LEFT, RIGHT)]
    best: int = sum(map(min, *barred))
    return spread + 3 * best + 0.1 * any(map(all, barred))


def _levels(group: PlanetGroup) -> dict[str, int]:
    """Return the level of each planet: the number of meshes away from the planet at the sun."""
    wheels = {planet: {True: 0, False: 0} for planet in group.planets}
    for wheel in group.wheels:
        wheels[group.planet_of[wheel.rim]][wheel.internal] += 1
    levels: dict[str, int] = {}
    for train in group.trains:
        start = min(train, key=lambda planet: (wheels[planet][True] > 0, -wheels[planet][False]))
        steps = {planet: len(group.path(start, planet)) for planet in train}
        levels |= sorted(steps.items(), key=itemgetter(1))
    return levels


def _columns(group: PlanetGroup, levels: Mapping[str, int]) -> list[WheelColumn]:
    columns: list[WheelColumn] = []
    for pair in group.meshes:
        places = {levels[group.planet_of[rim]]: rim for rim in pair}
        for column in columns:
            both = {**column.rims, **places}
            shared = [level for level in places if column.rims.get(level) == places[level]]
            if shared and len(both) > len(column.rims):
                column.rims = both
                break
        else:
            columns.append(WheelColumn(places))
    for wheel in group.wheels:
        level = levels[group.planet_of[wheel.rim]]
        for column in columns:
            end = max(column.rims) if wheel.internal else min(column.rims)
            taken = column.ring if wheel.internal else column.sun
            if column.rims[end] == wheel.rim and taken is None:
                break
        else:
            column = WheelColumn({level: wheel.rim})
            columns.append(column)
        if wheel.internal:
            column.ring = wheel
        else:
            column.sun = wheel
    return columns


def axles(
    section: HalfSection, *, is_left: bool, is_right: bool
) -> tuple[list[Segment], list[Segment]]:
    """Return the axles of planets, and the vertical arms that join the axles at wanted sides.

    An axle that gears block on one side leaves on the other side.
    """
    wanted = [side for side, there in ((LEFT, is_left), (RIGHT, is_right)) if there]
    if not wanted and len(section.levels) > 1:
        wanted = [RIGHT]  # the carrier is unconnected: draw an arm on the right
    chosen = {planet: _arm_ends(section, planet, wanted) for planet in section.levels}
    used = {side for sides in chosen.values() for side in sides}
    # No axle extends to both arms.
    if wanted and not any(sides >= used for sides in chosen.values()):
        planet = min(chosen, key=lambda name: sum(section.barred(name, side) for side in used))
        chosen[planet] = used
    pins: list[Segment] = []
    heights: dict[int, list[float]] = {LEFT: [], RIGHT: []}
    for planet, sides in chosen.items():
        planes, y = section.planes(planet), section.y(section.levels[planet])
        left = 0.0 if LEFT in sides else section.x(planes[0]) - 5
        right = section.width if RIGHT in sides else section.x(planes[-1]) + 5
        pins.append(((left, y), (right, y)))
        for side in sides:
            heights[side].append(y)
    ends = {LEFT: 0.0, RIGHT: section.width}
    arms = [((ends[s], min(ys)), (ends[s], max(ys))) for s, ys in heights.items() if ys]
    return pins, arms


def _arm_ends(section: HalfSection, planet: str, wanted: Sequence[int]) -> set[int]:
    """Return the wanted sides on which an axle is free, or the least blocked side."""
    sides = {side for side in wanted if not section.barred(planet, side)}
    if wanted and not sides:
        sides = {min((LEFT, RIGHT), key=lambda side: section.barred(planet, side))}
    return sides


def set_glyphs(section: HalfSection) -> list[Glyph]:
    """Return all drawings of a gear set: as given or mirrored, carrier left or right."""
    turned = replace(section, columns=section.columns[::-1])
    ways = [section, turned][: len(section.columns)]
    return [glyph for way in ways for glyph in _glyphs(way)]


def _glyphs(section: HalfSection) -> Iterator[Glyph]:
    wheels, carrier = list(wheel_taps(section)), section.group.carrier
    texts = list(wheel_texts(section, wheels))
    strokes = [*planet_strokes(section), *(teeth(tap.x, tap.y) for tap in wheels)]
    directions = [(ABOVE,), (BELOW,), (ABOVE, BELOW)][: 3 if carrier else 2]
    for is_left in (True, False):
        pins, arms = axles(section, is_left=is_left, is_right=not is_left)
        bars = [Stroke(line) for line in (*pins, *arms) if line[0] != line[1]]
        for chosen in product(directions, repeat=len(arms)):
            ends = [
                Tap(carrier, way, *arm[way == ABOVE], "carrier")
                for arm, ways in zip(arms, chosen, strict=True)
                for way in ways
            ]
            yield Glyph(section.width, [*strokes, *bars], [*wheels, *ends], texts)


def planet_strokes(section: HalfSection) -> list[Stroke]:
    """Return the lines of planet gears with webs, and sleeves between the gears of a planet."""
    strokes: list[Stroke] = []
    for planet, rims in section.group.planets.items():
        y = section.y(section.levels[planet])
        planes = section.planes(planet)
        for rim in rims:
            left, right = section.reach(rim)
            radius = section.radius(rim)
            half = (right - left) / 2 + FACE
            middle = (left + right) / 2
            strokes += [teeth(middle, y + way * radius, half) for way in (1, -1)]
            strokes.append(Stroke(((middle, y - radius), (middle, y + radius))))
        if len(rims) > 1:
            xs = [section.x(planes[0]), section.x(planes[-1])]
            strokes.append(Stroke(((xs[0], y), (xs[1], y)), SLEEVE))
    return strokes


def wheel_taps(section: HalfSection) -> Iterator[Tap]:
    """Yield the points where suns and rings mesh with the planets."""
    for number, column in enumerate(section.columns):
        low, high = min(column.rims), max(column.rims)
        for wheel, level, way in ((column.sun, low, BELOW), (column.ring, high, ABOVE)):
            if wheel is not None:
                y = section.y(level) + way * (section.radius(column.rims[level]) + MESH)
                yield Tap(wheel.link, way, section.x(number), y, wheel.member)


def wheel_texts(section: HalfSection, wheels: Sequence[Tap]) -> Iterator[tuple[Point, str, str]]:
    """Yield names of suns and rings next to the meshes, and of planet gears."""
    for tap in wheels:
        if tap.label in section.names:
            at = tap.x + 3, tap.y + 2.0 * tap.side
            yield at, "bottom" if tap.side == ABOVE else "top", section.names[tap.label]
    for rim, planet in section.group.planet_of.items():
        if rim in section.names:
            left, right = section.reach(rim)
            at = (left + right) / 2 + 3, section.y(section.levels[planet]) + 2
            yield at, "bottom", section.names[rim]
