"""Conversion of the steps of a search to bars (links) and uprights (components)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from itertools import pairwise

from vstatics.core.groups import grouped
from vstatics.pictures.schemes.coaxial.search.state import Bars, OrderStep
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain


@dataclass(eq=False)
class Bar:
    """Bar: horizontal line of a link, drawn for a shaft or a drum."""

    link: int
    is_above: bool
    """True for a bar above the row of planets, False for a bar below."""
    first: int = 0
    last: int = 0
    """Indices of the first and the last upright that the bar reaches, from left to right."""


@dataclass(eq=False)
class Upright:
    """Upright: component at a position along the axis."""

    kind: str
    """Kind: ``top`` (at the housing), ``pair`` (between two links), ``wall`` (vertical line of a
    link), ``set`` (gear set), or ``start`` and ``end`` of the axis.
    """
    index: int
    bars: Sequence[Bar]
    """Lower and upper connected bar; a single bar for tops and ends; empty for gear sets."""
    gap: Sequence[Bar] = ()
    """Neighbouring bars below and above the symbol of a pair."""
    is_turned: bool = False
    wheels: Sequence[tuple[Bar | None, Bar | None]] = ()
    """Bars of sun and ring in each plane of a gear set, from left to right."""
    left: tuple[Bar | None, Bar | None] = (None, None)
    """Bars below and above that the left arm of the carrier meets."""
    right: tuple[Bar | None, Bar | None] = (None, None)
    """Bars below and above that the right arm of the carrier meets."""

    @property
    def all_bars(self) -> list[Bar]:
        """Bars that the upright meets."""
        pairs = (*self.wheels, self.left, self.right)
        return [*self.bars, *(bar for pair in pairs for bar in pair if bar is not None)]


@dataclass
class SectionFrame:
    """Bars (links) and uprights (components) of a half-section."""

    uprights: list[Upright] = field(default_factory=list)
    rows: list[tuple[list[Bar], list[Bar]]] = field(default_factory=list)
    """Bars below and above the row of planets at each upright, from the axis outwards."""

    @property
    def bars(self) -> list[Bar]:
        """All bars, sorted by the left ends."""
        return list(dict.fromkeys(bar for up in self.uprights for bar in up.all_bars))

    @property
    def neighbours(self) -> set[tuple[Bar, Bar]]:
        """Pairs of neighbouring bars above or below the row of planets, from the axis outwards."""
        return {pair for rows in self.rows for row in rows for pair in pairwise(row)}


def framed(train: CoaxialTrain, steps: Sequence[OrderStep]) -> SectionFrame:
    """Return the bars and uprights for the steps that a search found.

    Examples
    --------
    >>> from vstatics.pictures.schemes.coaxial.search.order import component_order
    >>> from vstatics.pictures.schemes.coaxial.train import Planes
    >>> train = CoaxialTrain([Planes(3, [(1, 2)])], [], [2], 1, 3)
    >>> frame = framed(train, component_order(train).steps)
    >>> [(up.kind, [bar.link for bar in up.all_bars]) for up in frame.uprights]
    [('start', [1]), ('set', [1, 2, 3]), ('top', [2]), ('end', [3])]
    """
    builder = _FrameMaker(train)
    for step in steps:
        builder.add(step)
    return builder.finished()


class _FrameMaker:
    def __init__(self, train: CoaxialTrain) -> None:
        self.train, self.frame = train, SectionFrame()
        self.below: list[Bar] = []
        self.above: list[Bar] = []
        self.is_started = False

    def add(self, step: OrderStep) -> None:
        if not self.is_started:
            self._start(step)
        if step.before is not None:
            self._go_to(*step.before)
        self._go_to(*step.bars[0])
        if step.kind == "set":
            self._set(step)
        elif step.kind == "top":
            bar = self._last_of(self.below + self.above, self.train.tops[step.number])
            self._stand(Upright("top", step.number, [bar]))
        else:
            pair = (
                self.train.pairs[step.number] if step.kind == "pair" else (step.number, step.number)
            )
            bars = self._nearest(*pair, step.place)
            row = self.below + self.above
            place = row.index(bars[0])
            self._stand(Upright(step.kind, step.number, bars, row[place : place + 2]))

    def finished(self) -> SectionFrame:
        if not self.is_started:  # a train without components has no steps
            self._start(OrderStep("wall", self.train.start, [((8 * self.train.start,), ())]))
        if self.train.end:
            # The last step can already have ended the bar.
            bars = [*self.frame.bars, *reversed(self.below + self.above)]
            ends = [bar for bar in bars if bar.link == self.train.end]
            if not ends:  # the output is not connected
                ends = [Bar(self.train.end, is_above=False)]
                self.below += ends
                self._note()
            self._stand(Upright("end", 0, ends[-1:]))
        return _with_ends(self.frame)

    def _start(self, step: OrderStep) -> None:
        below, _ = step.bars[0]
        is_low = any(bar >> 3 == self.train.start for bar in below)
        bar = Bar(self.train.start, not is_low)
        (self.below if is_low else self.above).append(bar)
        self._note()
        self._stand(Upright("start", 0, [bar]))
        self.is_started = True

    def _stand(self, upright: Upright) -> None:
        self.frame.uprights.append(upright)

    def _note(self) -> None:
        self.frame.rows.append(([*self.below], [*self.above]))

    def _go_to(self, below: Bars, above: Bars) -> None:
        self.below = _aligned(self.below, [bar >> 3 for bar in below], is_above=False)
        self.above = _aligned(self.above, [bar >> 3 for bar in above], is_above=True)
        self._note()

    def _set(self, step: OrderStep) -> None:
        carrier = self.train.sets[step.number].carrier
        left = self._met(*(carrier * is_there for is_there in step.left))
        wheels: list[tuple[Bar | None, Bar | None]] = []
        planes = self.train.sets[step.number].wheels
        for (sun, ring), bars in zip(
            planes[::-1] if step.is_turned else planes, step.bars[1:-1], strict=True
        ):
            self._go_to(*bars)
            wheels.append(self._met(sun, ring))
        self._go_to(*step.bars[-1])
        right = self._met(*(carrier * is_there for is_there in step.right))
        self._stand(Upright("set", step.number, [], (), step.is_turned, wheels, left, right))

    @staticmethod
    def _last_of(row: Sequence[Bar], link: int) -> Bar:
        return next(bar for bar in row[::-1] if bar.link == link)

    def _met(self, low: int, high: int) -> tuple[Bar | None, Bar | None]:
        """Return the bars of two links nearest to the planets, below and above; 0 is no link."""
        return (
            self._last_of(self.below, low) if low else None,
            self._last_of(self.above[::-1], high) if high else None,
        )

    def _nearest(self, first_link: int, second_link: int, place: int) -> list[Bar]:
        """Return the bars `place` and `place` + 1 or, for -1, the nearest bars of the two links."""
        if place >= 0:
            return (self.below + self.above)[place : place + 2]
        bars = list(enumerate(self.below + self.above))
        ways = [
            (b - a, a, low, high)
            for a, low in bars
            for b, high in bars[a + 1 :]
            if {low.link, high.link} == {first_link, second_link}
        ]
        _, _, low, high = min(ways, key=lambda way: way[:2])
        return [low, high]


def _with_ends(frame: SectionFrame) -> SectionFrame:
    """Set the ends of all bars, and leave out bars that meet nothing."""
    uprights = enumerate(frame.uprights)
    met = grouped((bar, place) for place, up in uprights for bar in up.all_bars)
    for bar, places in met.items():
        bar.first, bar.last = places[0], places[-1]
    frame.rows = [
        ([bar for bar in below if bar in met], [bar for bar in above if bar in met])
        for below, above in frame.rows
    ]
    return frame


def _aligned(old: Sequence[Bar], links: Sequence[int], *, is_above: bool) -> list[Bar]:
    """Return bars of links. Old bars continue where the order of the links permits."""
    bars = [Bar(link, is_above) for link in links]
    common = SequenceMatcher(None, [bar.link for bar in old], links, autojunk=False)
    for start, place, size in common.get_matching_blocks():
        bars[place : place + size] = old[start : start + size]
    return bars
