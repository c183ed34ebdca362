"""How what joins levers runs between them: upright at places of its own; lengths in points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, permutations
from typing import NamedTuple

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.pictures.drawing.labels import Span, height, width
from vstatics.pictures.drawing.style import SIZE
from vstatics.pictures.lever.gear import LeverTie, joins, spots_of, ties_of
from vstatics.pictures.lever.points import Lever

UNDER = 1.25 * SIZE + 3.0
"""Room for a number under the line of a row."""
LANE = 6.0
"""Between lines that pass levers."""
COLUMN = 8.0
"""Between upright lines."""
LEAST_GAP = 14.0
"""Between levers."""
SHORT_STEP = 20.0
"""Where a line rises by less the sign of a clutch stands on its level part."""
BESIDE_SIGN = 8.0
"""From the middle of an upright sign to its name."""
MOST_ORDERED = 6
"""Upright lines in a gap, all of whose orders are tried."""
OVERLAP = 10
"""What it costs that lines of two links lie on one another or on a clutch, in crossings."""


class LeverRow(NamedTuple):
    """The line of a point, with its texts."""

    name: str
    """In lines."""
    at: float
    """Height of the point on the lever."""
    y: float
    """Height of the line, which gives way to its neighbours."""

    @property
    def span(self) -> Span:
        """What its texts take of the height."""
        return self.y - UNDER, self.y + height(self.name) + 3


PointRows = Mapping[int, LeverRow]
"""The rows of a lever, by node; the housing of a pair has none."""


def middle_of(rows: PointRows) -> float:
    """Of a lever."""
    heights = [row.at for row in rows.values()]
    return (min(heights) + max(heights)) / 2


class LeverStep(NamedTuple):
    """What a tie does in the gap behind a lever."""

    tie: LeverTie
    gap: int
    """The lever before it."""
    start: float
    """Height at which it comes from the left."""
    end: float
    """Height at which it goes on."""
    is_signed: bool
    """Whether its clutch or spring is here."""
    is_back: bool
    """Whether it ends where it comes from, at the same lever."""
    x: float = 0.0
    """Where it is upright, from the beginning of the gap."""
    sign: float = 0.0
    """Height of its sign."""
    slant: float = 0.0
    """How far it goes on while it rises: where it changes places with another line."""
    is_late: bool = False
    """Whether its sign, if it is level, stands behind the rise: before it others branch off."""

    @property
    def span(self) -> Span:
        """From where to where it is upright."""
        return min(self.start, self.end), max(self.start, self.end)

    @property
    def is_upright(self) -> bool:
        """Whether its sign stands on an upright line, its name beside it."""
        return abs(self.end - self.start) >= SHORT_STEP

    @property
    def wide(self) -> float:
        """What it needs of the gap; nothing if it goes straight through."""
        if not self.is_signed:
            return COLUMN * (self.start != self.end)
        named = width(self.tie.name)
        return BESIDE_SIGN + named + 7 if self.is_upright else max(named, 14.0) + 7

    @property
    def sign_at(self) -> float:
        """Where its sign stands, from the beginning of the gap."""
        if self.is_upright:
            return self.x
        return self.x + self.wide / 2 if self.is_late else self.x - self.wide / 2 + 3

    @property
    def levels(self) -> list[tuple[float, bool]]:
        """Heights at which it is level, and whether left of where it is upright."""
        return [(self.start, True), (self.end, self.is_back)]


def steps(
    rows: Sequence[PointRows], boxes: Sequence[bool], ties: Iterable[LeverTie]
) -> list[LeverStep]:
    """What ties do in all gaps, those of a tie one after the other; each upright at its place.

    Parameters
    ----------
    rows : sequence of mapping
        Of each lever.
    boxes : sequence of bool
        Which levers are pairs of wheels: a box with their ratio.
    """
    used: list[tuple[int, float]] = []
    ordered = sorted(ties, key=lambda one: (bool(one.name), one.ends[1][0] - one.ends[0][0]))
    found = [step for one in ordered for step in _steps(rows, boxes, one, used)]
    for gap in {step.gap for step in found}:
        here = [number for number, step in enumerate(found) if step.gap == gap]
        for number, step in zip(here, _apart([found[number] for number in here]), strict=True):
            found[number] = step
    return found


def _steps(
    rows: Sequence[PointRows], boxes: Sequence[bool], one: LeverTie, used: list[tuple[int, float]]
) -> Iterator[LeverStep]:
    (first, _), (last, _) = one.ends
    start, end = (rows[place][node].y for place, node in one.ends)
    is_signed = bool(one.name)
    if last - first < 2:
        yield LeverStep(one, first, start, end, is_signed, first == last)
        return
    between = range(first + 1, last)
    lane = _lane(rows, boxes, between, end if is_signed else (start + end) / 2, used)
    yield LeverStep(one, first, start, lane, is_signed, is_back=False)
    for place in between[:-1]:
        yield LeverStep(one, place, lane, lane, is_signed=False, is_back=False)
    yield LeverStep(one, last - 1, lane, end, is_signed=False, is_back=False)


def _lane(
    rows: Sequence[PointRows],
    boxes: Sequence[bool],
    between: range,
    wanted: float,
    used: list[tuple[int, float]],
) -> float:
    """The free height next to a wanted one, past some levers."""
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
    """The steps of a gap, each with an x of its own, so that few lines cross."""
    here = [step._replace(is_late=_is_late(step, here)) for step in here]
    turning = [number for number, step in enumerate(here) if step.wide]
    orders = permutations(turning) if len(turning) <= MOST_ORDERED else [tuple(turning)]
    best = min(orders, key=lambda order: _crossings([here[number] for number in order]))
    found, x = list(here), COLUMN
    for number in best:
        step = here[number]
        is_behind = step.is_signed and not step.is_upright and not step.is_late
        after = step.wide - 3 if is_behind else 0.0
        found[number] = step._replace(x=x + after)
        x += step.wide
    for one, other in combinations(best, 2):
        if _change_places(found[one], found[other]):
            start, end = sorted((found[one].x, found[other].x))
            for number in (one, other):
                found[number] = found[number]._replace(x=start, slant=end - start)
    return [step._replace(sign=_sign(step, found)) if step.is_signed else step for step in found]


def _change_places(one: LeverStep, other: LeverStep) -> bool:
    """Whether each of two lines goes on where the other comes from: upright they would overlap."""
    both = one.is_signed or other.is_signed or one.is_back or other.is_back
    return not both and max(abs(one.end - other.start), abs(other.end - one.start)) < 1


def _is_late(step: LeverStep, here: Sequence[LeverStep]) -> bool:
    """Whether other lines begin where a step does, and none ends where it ends."""
    others = [other for other in here if other is not step]
    begins = any(abs(other.start - step.start) < 1 for other in others)
    return begins and not step.is_back and all(abs(one.end - step.end) >= 1 for one in others)


def _hides(one: LeverStep, other: LeverStep, *, is_after: bool) -> bool:
    """Whether a line right or left of the level sign of another one runs through that sign."""
    height = one.end if one.is_late else one.start
    levels = (abs(y - height) < 1 for y, is_left in other.levels if is_left == is_after)
    return one.is_signed and not one.is_upright and any(levels)


def _crossings(ordered: Sequence[LeverStep]) -> int:
    """How often lines of a gap cross that stand in this order, from the left."""
    count = 0
    for place, one in enumerate(ordered):
        for other in ordered[place + 1 :]:
            (low, high), (low2, high2) = one.span, other.span
            count += sum(low < y < high for y, is_left in other.levels if is_left)
            count += sum(low2 < y < high2 for y, is_left in one.levels if not is_left)
            count += OVERLAP * (not one.is_back and abs(one.end - other.start) < 1)
            count += OVERLAP * _hides(one, other, is_after=True)
            count += OVERLAP * _hides(other, one, is_after=False)
    return count


def _sign(step: LeverStep, here: Sequence[LeverStep]) -> float:
    """The height of a sign, where no line runs through its name."""
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
    """Room behind each lever, for all that joins it to others, or itself, in any gear."""
    spots, boxes = spots_of(drawn), [lever.ratio is not None for lever in drawn]
    found = [LEAST_GAP] * (len(drawn) - 1) + [0.0]
    for gear in [*case.gears, Gear(case.freewheels)]:
        engaged = {*gear.engaged, *case.freewheels}
        elements = [case.shift_elements[number - 1] for number in sorted(engaged)]
        ties = [*joins(drawn), *ties_of(case, elements, spots)]
        needed: dict[int, float] = {}
        for step in steps(rows, boxes, ties):
            needed[step.gap] = needed.get(step.gap, 0.0) + step.wide
        for gap, wide in needed.items():
            found[gap] = max(found[gap], COLUMN + wide + COLUMN / 2 if wide else 0.0)
    return found
