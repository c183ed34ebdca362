"""What combinations of shift elements give, in exact fractions: the null space itself.

Source: the Willis equation w_a - K w_b - (1 - K) w_h = 0 of each set, and equal speeds of
what is engaged. A basis of all speeds that these allow is written down, and looked at from
the input and the output. No numbers are rounded, nothing is shared with the program.
"""

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from tests.oracle.linear import ZERO, Linear

Vector = list[Fraction]
Set = tuple[int, int, int]
"""Links of sun, ring and carrier, or of first, second and third."""
Pair = tuple[int, int]
"""Links of a shift element; 0 is the housing, which has no speed."""


@dataclass(frozen=True)
class Train:
    """Links from 1, or any numbers: those that are named somewhere are links, 0 never."""

    sets: Sequence[Set]
    ratios: Sequence[Fraction]
    elements: Sequence[Pair]
    input: int
    output: int

    @property
    def links(self) -> list[int]:
        """All links but the housing, in order."""
        named = {link for part in (*self.sets, *self.elements) for link in part}
        return sorted((named | {self.input, self.output}) - {0})


class Found(NamedTuple):
    """What one combination is."""

    kind: str
    ratio: Fraction | None
    free: bool
    """Some other link turns as it likes, whatever input and output do."""
    freedom: int


def null_space(rows: Sequence[Vector], size: int) -> list[Vector]:
    """A basis of all x with rows @ x = 0."""
    system = Linear(rows, [ZERO] * len(rows), size)
    basis = []
    for column in set(range(size)) - {*system.pivots}:
        vector = system.unit(column)
        for pivot, row in zip(system.pivots, system.rows, strict=True):
            vector[pivot] = -row[column]
        basis.append(vector)
    return basis


def speeds(train: Train, engaged: Sequence[int], ratios: Sequence[Fraction]) -> list[Vector]:
    """All speeds that are possible with elements (from 0) engaged."""
    links = train.links
    place = {link: at for at, link in enumerate(links)}

    def row(*terms: tuple[int, Fraction | int]) -> Vector:
        values = [ZERO] * len(links)
        for link, factor in terms:
            if link:
                values[place[link]] += factor
        return values

    rows = [
        row((first, 1), (second, -ratio), (third, ratio - 1))
        for (first, second, third), ratio in zip(train.sets, ratios, strict=True)
    ]
    rows += [row((train.elements[n][0], 1), (train.elements[n][1], -1)) for n in engaged]
    return null_space(rows, len(links))


def _seen(train: Train, engaged: Sequence[int], ratios: Sequence[Fraction]) -> Found:
    links = train.links
    basis = speeds(train, engaged, ratios)
    ends = links.index(train.input), links.index(train.output)
    ports = [tuple(vector[at] for at in ends) for vector in basis]
    turning = [pair for pair in ports if any(pair)]
    rank = 0
    if turning:
        one = turning[0]
        rank = 2 if any(one[0] * b != one[1] * a for a, b in turning) else 1
    free = len(basis) > rank
    if rank == 2:
        return Found("neutral", None, free, len(basis))
    if all(not a for a, _ in ports):
        return Found("blocked", None, free, len(basis))
    if all(not b for _, b in ports):
        return Found("parking", None, free, len(basis))
    return Found("gear", Fraction(turning[0][0]) / turning[0][1], free, len(basis))


def anything(count: int, seed: int) -> list[Fraction]:
    """Internal ratios of no special value."""
    chance = random.Random(seed)  # noqa: S311
    return [Fraction(chance.randint(-9999, -1111), 1009 + 2 * n) for n in range(count)]


def found(train: Train, engaged: Sequence[int]) -> Found:
    """Kind and ratio; direct where the ratio is 1 with four other sets of ratios as well."""
    seen = _seen(train, engaged, train.ratios)
    if seen.kind != "gear" or seen.ratio != 1:
        return seen
    others = [_seen(train, engaged, anything(len(train.sets), seed)) for seed in range(4)]
    always = all(other.kind == "gear" and other.ratio == 1 for other in others)
    return seen._replace(kind="direct") if always else seen


def every(train: Train, count: int) -> Iterator[tuple[tuple[int, ...], Found]]:
    """All combinations of so many elements, in order."""
    for engaged in combinations(range(len(train.elements)), count):
        yield engaged, found(train, engaged)
