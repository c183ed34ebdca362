"""Positions of bars and uprights [pt]; y is 0 in the middle of the row of planets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.pictures.schemes.coaxial.layout import Bar, SectionFrame, Upright

PITCH, SIGN_PITCH = 13.0, 27.0
"""Distances of neighbouring bars without and with a symbol in between. [pt]"""
NAMED_PITCH = 9.5
"""Smallest distance of bars with names. [pt, scaled with letters]"""
ROW_CLEARANCE = 9.0
"""Distance from the edge of the row of planets to the nearest bars. [pt]"""
WHEEL_NAME = 13.0
"""Height for the name of a gear and half of the link name above. [pt, scaled with letters]"""
HOUSING_BAND = 24.0
"""Distance from the outermost drum to the housing, for names of one line in full size. [pt]"""
HALF_NAME_LINE = 5.0
"""Half the distance between lines of a name, before letters are scaled. [pt]"""
ROOM_GAP = 5.0
"""Distance between the rectangles reserved for neighbouring components. [pt]"""
NAME_PAD = 5.0
"""Margin around the name of a link on a bar. [pt]"""


class SignRoom(NamedTuple):
    """Rectangle that a component or text needs, relative to the upright [pt]."""

    left: float
    right: float
    low: float
    high: float


class Needs(NamedTuple):
    """Sizes of symbols and letters that determine the positions of a half-section."""

    half: float
    """Half the height of the row of planets. [pt]"""
    signs: Sequence[float]
    """Distance that the symbol of each pair needs between its bars, in the order of the train. [pt]
    """
    names: Mapping[int, float]
    """Width of the name of each link on a bar, by the number of the link. [pt]"""
    letters: float
    """Ratio of the size of letters to lengths. [-]"""
    has_wheel_names: bool
    """True if names of gears are between the row of planets and the nearest bars."""

    @property
    def clearance(self) -> float:
        """Distance from the edge of the row of planets to the nearest bars [pt]."""
        return ROW_CLEARANCE + WHEEL_NAME * (self.letters - 1) * self.has_wheel_names

    @property
    def housing_band(self) -> float:
        """Distance from the outermost drum to the housing, with names below brakes [pt]."""
        return HOUSING_BAND + HALF_NAME_LINE * (self.letters - 1) * bool(self.names)

    @property
    def pitch(self) -> float:
        """Distance of neighbouring bars without a symbol in between [pt]."""
        return max(PITCH, NAMED_PITCH * self.letters)


@dataclass
class SectionPlaces:
    """Positions of the bars and uprights of a half-section."""

    frame: SectionFrame
    half: float
    heights: dict[Bar, float] = field(default_factory=dict)
    axis: float = 0.0
    housing: float = 0.0
    at: list[float] = field(default_factory=list)
    """Position of each upright along the axis. [pt]"""
    names: dict[int, tuple[float, float]] = field(default_factory=dict)
    """Position of the middle of each link name on the bar, by the number of the link. [pt]"""


def heights_of(frame: SectionFrame, needs: Needs) -> SectionPlaces:
    """Return the heights of bars, of the axis, and of the housing."""
    places = SectionPlaces(frame, needs.half)
    pinned, pitch = set(_pinned(frame)), needs.pitch
    signs = grouped(
        (frozenset(up.gap), max(needs.signs[up.index], 2 * pitch))
        for up in frame.uprights
        if up.kind == "pair"
    )
    rises = grouped(
        (high, (low, max(signs.get(frozenset((low, high)), [pitch]))))
        for low, high in frame.neighbours
        if low not in pinned and high not in pinned
    )
    ends = {bar for up in frame.uprights if up.kind in ("start", "end") for bar in up.bars}

    def rise(bar: Bar) -> float:
        if bar not in heights:
            least = 0.0 if bar.is_above or bar in ends else pitch
            heights[bar] = max([least, *(rise(low) + step for low, step in rises.get(bar, []))])
        return heights[bar]

    heights: dict[Bar, float] = {}
    bars = [bar for bar in frame.bars if bar not in pinned]
    depth = max((rise(bar) for bar in bars if not bar.is_above), default=0.0)
    places.axis = -needs.half - needs.clearance - max(depth, pitch)
    start = needs.half + needs.clearance
    places.heights = {
        bar: rise(bar) + (start if bar.is_above else places.axis) for bar in bars
    } | dict.fromkeys(pinned, 0.0)
    places.housing = max([start - pitch, *places.heights.values()]) + needs.housing_band
    return places


def _pinned(frame: SectionFrame) -> Iterator[Bar]:
    """Yield the bars at the height of carrier pins: between neighbouring sets, or next to a set."""
    for bar in frame.bars:
        uprights = frame.uprights[bar.first : bar.last + 1]
        met = [up for up in uprights if bar in up.all_bars]
        arms = [up for up in met if up.kind == "set"]
        if not arms or any(bar in pair for up in arms for pair in up.wheels):
            continue
        side = int(bar.is_above)
        if any(
            bar in arm and arm[1 - side] is not None for up in arms for arm in (up.left, up.right)
        ):
            continue
        ends_well = all(
            (up is uprights[0] and bar in up.right and bar not in up.left)
            or (up is uprights[-1] and bar in up.left and bar not in up.right)
            for up in arms
        )
        passed = any(_spans_row(up) for up in uprights if bar not in up.all_bars)
        rows = [both[side] for both in frame.rows if bar in both[side]]
        is_next = all(row[0 if bar.is_above else -1] is bar for row in rows)
        goes_off = any(up.kind in ("start", "end") for up in met)
        if ends_well and not passed and is_next and not goes_off and len(met) > 1:
            yield bar


def _spans_row(up: Upright) -> bool:
    if up.kind == "set":
        return True
    if up.kind == "top":
        return not up.bars[0].is_above
    return len({bar.is_above for bar in up.bars}) > 1


def placed_along(
    places: SectionPlaces,
    rooms: Sequence[Sequence[SignRoom]],
    offsets: Mapping[int, Mapping[Bar, Sequence[float]]],
    needs: Needs,
) -> None:
    """Place uprights (drawn gear sets, clutches, brakes) along the axis, as close as possible.

    Parameters
    ----------
    rooms : sequence of sequence of SignRoom
        Rectangles that the symbols of each upright need.
    offsets : mapping
        For each upright, by index: horizontal positions relative to it at which it meets each bar.
        [pt]
    needs : Needs
        Widths of the link names.
    """
    apart: dict[tuple[int, int], float] = {}
    for _ in range(3 * len(needs.names) + 1):
        _closed_up(places, rooms, apart)
        places.names, lack = _named(places, offsets, needs, apart)
        if not lack:
            return


def _closed_up(
    places: SectionPlaces,
    rooms: Sequence[Sequence[SignRoom]],
    apart: Mapping[tuple[int, int], float],
) -> None:
    at: list[float] = []
    for place, needed in enumerate(rooms):
        least = [
            start + there.right + ROOM_GAP - room.left
            for start, theirs in zip(at, rooms, strict=False)
            for room, there in product(needed, theirs)
            if room.low < there.high and there.low < room.high
        ]
        least += [at[other] + by for (other, behind), by in apart.items() if behind == place]
        at.append(max([0.0, *least]))
    places.at = at


def _named(
    places: SectionPlaces,
    offsets: Mapping[int, Mapping[Bar, Sequence[float]]],
    needs: Needs,
    apart: dict[tuple[int, int], float],
) -> tuple[dict[int, tuple[float, float]], bool]:
    """Return positions of link names, and True if the names forced uprights apart."""
    names: dict[int, tuple[float, float]] = {}
    for link, width in needs.names.items():
        gaps = []
        for bar in places.frame.bars:
            if bar.link != link:
                continue
            met = sorted(
                (places.at[place] + off, place)
                for place, by_bar in offsets.items()
                for off in by_bar.get(bar, ())
            )
            gaps += [(b[0] - a[0], bar, a, b) for a, b in pairwise(met) if a[1] != b[1]]
        if not gaps:
            continue
        long, bar, left, right = max(gaps, key=lambda gap: gap[0])
        lack = width + 2 * NAME_PAD - long
        if lack > 0.01:
            pair = (left[1], right[1]) if left[1] < right[1] else (right[1], left[1])
            apart[pair] = places.at[pair[1]] - places.at[pair[0]] + lack
            return names, True
        names[link] = (left[0] + right[0]) / 2, places.heights[bar]
    return names, False
