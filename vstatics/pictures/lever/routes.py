"""Routes of the connections in the gaps between levers; lengths in points."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, permutations
from typing import NamedTuple

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.pictures.drawing.labels import Span, height, width
from vstatics.pictures.drawing.style import SIZE
from vstatics.pictures.lever.gear import LeverTie, joins, spots_of, ties_of
from vstatics.pictures.lever.points import Lever

UNDER = 1.25 * SIZE + 3.0
"""Height reserved for a number below the horizontal line of a point. [pt]"""
LANE = 6.0
"""Distance between lines that pass above or below levers. [pt]"""
UPRIGHT_PITCH = 8.0
"""Distance between vertical parts of lines. [pt]"""
LEAST_GAP = 14.0
"""Smallest distance between levers. [pt]"""
SHORT_STEP = 20.0
"""Rise of a line below which the symbol of a clutch is on its horizontal part. [pt]"""
BESIDE_SIGN = 8.0
"""Distance from the middle of a symbol on a vertical line to the name. [pt]"""
MOST_ORDERED = 6
"""Largest number of vertical parts in a gap for which all orders are tried."""
OVERLAP_COST = 10
"""Cost of a line that overlaps with a different link, in crossings. [-]"""


class LeverRow(NamedTuple):
    """Horizontal line of a point of a lever, with the texts."""

    name: str
    """Name of the link, wrapped into lines."""
    at: float
    """Height of the point on the lever. [pt]"""
    y: float
    """Height of the horizontal line, moved away from neighbouring lines. [pt]"""

    @property
    def span(self) -> Span:
        """Vertical range of the texts [pt]."""
        return self.y - UNDER, self.y + height(self.name) + 3


PointRows = Mapping[int, LeverRow]
"""Horizontal line of each drawn point of a lever, by index of the point.

The housing point of a gear pair is not drawn.
"""


def middle_of(rows: PointRows) -> float:
    """Return the middle between the lowest and highest point of a lever [pt]."""
    heights = [row.at for row in rows.values()]
    return (min(heights) + max(heights)) / 2


class LeverStep(NamedTuple):
    """Piece of a connecting line in the gap to the right of a lever."""

    tie: LeverTie
    gap: int
    """Index of the lever that is left of the gap."""
    start: float
    """Height at the left end. [pt]"""
    end: float
    """Height at the right end. [pt]"""
    is_signed: bool
    """True if the symbol of a clutch or spring is in the gap."""
    is_back: bool
    """True if the connection returns to the lever of origin."""
    x: float = 0.0
    """Position of the vertical part, from the start of the gap. [pt]"""
    sign: float = 0.0
    """Height of the symbol of the clutch or spring. [pt]"""
    slant: float = 0.0
    """Horizontal length of a slanted rise, for two lines that exchange heights. [pt]"""
    is_late: bool = False
    """True for a symbol on the horizontal part after the rise, if other lines branch off before."""

    @property
    def span(self) -> Span:
        """Vertical range of the vertical part [pt]."""
        return min(self.start, self.end), max(self.start, self.end)

    @property
    def is_upright(self) -> bool:
        """True if a symbol would be on the vertical part, because the rise is long."""
        return abs(self.end - self.start) >= SHORT_STEP

    @property
    def wide(self) -> float:
        """Width that the piece needs in the gap; 0 for a straight line [pt]."""
        if not self.is_signed:
            return UPRIGHT_PITCH * (self.start != self.end)
        named = width(self.tie.name)
        return BESIDE_SIGN + named + 7 if self.is_upright else max(named, 14.0) + 7

    @property
    def sign_at(self) -> float:
        """Position of the symbol of the clutch or spring, from the start of the gap [pt]."""
        if self.is_upright:
            return self.x
        return self.x + self.wide / 2 if self.is_late else self.x - self.wide / 2 + 3

    @property
    def levels(self) -> list[tuple[float, bool]]:
        """Height of each horizontal part [pt], with True for a part left of the vertical part."""
        return [(self.start, True), (self.end, self.is_back)]


def steps(
    rows: Sequence[PointRows], boxes: Sequence[bool], ties: Iterable[LeverTie]
) -> list[LeverStep]:
    """Return the pieces of connecting lines in all gaps. Their vertical parts do not overlap.

    Parameters
    ----------
    rows : sequence of mapping
        Horizontal lines of the points of each lever.
    boxes : sequence of bool
        True for each lever that is a gear pair, drawn as a box with its ratio.
    """
    used: list[tuple[int, float]] = []
    ordered = sorted(ties, key=lambda tie: (bool(tie.name), tie.ends[1][0] - tie.ends[0][0]))
    all_steps = [step for tie in ordered for step in _steps(rows, boxes, tie, used)]
    for gap in {step.gap for step in all_steps}:
        here = [number for number, step in enumerate(all_steps) if step.gap == gap]
        for number, step in zip(here, _apart([all_steps[number] for number in here]), strict=True):
            all_steps[number] = step
    return all_steps


def _steps(
    rows: Sequence[PointRows], boxes: Sequence[bool], tie: LeverTie, used: list[tuple[int, float]]
) -> Iterator[LeverStep]:
    (first, _), (last, _) = tie.ends
    start, end = (rows[place][node].y for place, node in tie.ends)
    is_signed = bool(tie.name)
    if last - first < 2:
        yield LeverStep(tie, first, start, end, is_signed, first == last)
        return
    between = range(first + 1, last)
    lane = _lane(rows, boxes, between, end if is_signed else (start + end) / 2, used)
    yield LeverStep(tie, first, start, lane, is_signed, is_back=False)
    for place in between[:-1]:
        yield LeverStep(tie, place, lane, lane, is_signed=False, is_back=False)
    yield LeverStep(tie, last - 1, lane, end, is_signed=False, is_back=False)


def _lane(
    rows: Sequence[PointRows],
    boxes: Sequence[bool],
    between: range,
    wanted: float,
    used: list[tuple[int, float]],
) -> float:
    """Return the free height nearest to a wanted height, for a line past some levers [pt]."""
    spans = [row.span for place in between for row in rows[place].values()]
    taken = [(low - 1, high + 2) for low, high in spans]
    middles = [middle_of(rows[place]) for place in between if boxes[place]]
    taken += [(middle - SIZE - LANE / 2, middle + SIZE + LANE / 2) for middle in middles]
    taken += [(y - LANE, y + LANE) for place, y in used if place in between]
    places = [wanted, *(y for span in taken for y in span)]
    free = [y for y in places if not any(low < y < high for low, high in taken)]
    lane = min(free, key=lambda y: abs(y - wanted))
    used += [(place, lane) for place in between]
    return lane


def _apart(here: Sequence[LeverStep]) -> list[LeverStep]:
    """Return the pieces in a gap with separate vertical parts, in an order with few crossings."""
    here = [step._replace(is_late=_is_late(step, here)) for step in here]
    turning = [number for number, step in enumerate(here) if step.wide]
    orders = permutations(turning) if len(turning) <= MOST_ORDERED else [tuple(turning)]
    best = min(orders, key=lambda order: _crossings([here[number] for number in order]))
    placed, x = list(here), UPRIGHT_PITCH
    for number in best:
        step = here[number]
        is_behind = step.is_signed and not step.is_upright and not step.is_late
        after = step.wide - 3 if is_behind else 0.0
        placed[number] = step._replace(x=x + after)
        x += step.wide
    for first, second in combinations(best, 2):
        if _change_places(placed[first], placed[second]):
            start, end = sorted((placed[first].x, placed[second].x))
            for number in (first, second):
                placed[number] = placed[number]._replace(x=start, slant=end - start)
    return [step._replace(sign=_sign(step, placed)) if step.is_signed else step for step in placed]


def _change_places(first: LeverStep, second: LeverStep) -> bool:
    """Return whether two lines exchange heights, so that vertical parts would overlap."""
    both = first.is_signed or second.is_signed or first.is_back or second.is_back
    return not both and max(abs(first.end - second.start), abs(second.end - first.start)) < 1


def _is_late(step: LeverStep, here: Sequence[LeverStep]) -> bool:
    """Return whether other lines share the start of a piece, but no line shares its end."""
    others = [other for other in here if other is not step]
    begins = any(abs(other.start - step.start) < 1 for other in others)
    ends = any(abs(other.end - step.end) < 1 for other in others)
    return begins and not (ends or step.is_back)


def _crossings(ordered: Sequence[LeverStep]) -> int:
    count = 0
    for left, right in combinations(ordered, 2):
        (low, high), (low2, high2) = left.span, right.span
        count += sum(low < y < high for y, is_left in right.levels if is_left)
        count += sum(low2 < y < high2 for y, is_left in left.levels if not is_left)
        count += OVERLAP_COST * (not left.is_back and abs(left.end - right.start) < 1)
    return count


def _sign(step: LeverStep, here: Sequence[LeverStep]) -> float:
    """Return the height at which lines avoid the name of a symbol [pt]."""
    if not step.is_upright:
        return step.end if step.is_late else step.start
    low, high = step.span
    right = step.x + step.wide - 6
    levels = [
        y
        for other in here
        if other is not step
        for y, is_left in other.levels
        if (other.x > step.x if is_left else other.x < right or not other.wide)
    ]
    middle = (low + high) / 2
    places = [low + 7 + 2 * n for n in range(int((high - low - 14) / 2) + 1)] or [middle]

    def cost(y: float) -> float:
        near = min((abs(y - level) for level in levels), default=SIZE)
        return 100 * max(0.0, SIZE - near) + abs(y - middle)

    return min(places, key=cost)


def gaps_of(case: Transmission, drawn: Sequence[Lever], rows: Sequence[PointRows]) -> list[float]:
    """Return the width of the gap after each lever [pt], sufficient for the lines of any gear."""
    spots, boxes = spots_of(drawn), [lever.ratio is not None for lever in drawn]
    gaps = [LEAST_GAP] * (len(drawn) - 1) + [0.0]
    for gear in [*case.gears, Gear(case.freewheels)]:
        engaged = {*gear.carrying, *case.freewheels}
        elements = case.elements_at(sorted(engaged))
        ties = [*joins(drawn), *ties_of(case, elements, spots)]
        needed = defaultdict[int, float](float)
        for step in steps(rows, boxes, ties):
            needed[step.gap] += step.wide
        for gap, wide in needed.items():
            gaps[gap] = max(gaps[gap], UPRIGHT_PITCH + wide + UPRIGHT_PITCH / 2 if wide else 0.0)
    return gaps
