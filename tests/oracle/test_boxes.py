"""The brute force finds what is built, and what it was given to find."""

import math
from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import seeded
from tests.oracle.boxes import (
    HELD,
    Box,
    Frame,
    Space,
    all_frames,
    found,
    found_in,
    names,
    searched,
    triples,
)

pytestmark = pytest.mark.slow  # nothing in them is the program's own
Pairs = Sequence[tuple[int, int]]


class Built(NamedTuple):
    """A gearbox that is built."""

    space: Space
    frame: Frame
    elements: Pairs


# Links in the order of the comments, sets as sun, carrier, ring. Ratios and schemes: the cases
# of these names and their sources; of the 41TE: Wikipedia, Ultradrive (underdrive, overdrive and
# reverse clutch, 2-4 and low-reverse clutch to the housing).
SIMPSON = Built(
    Space(2, 4, 2, (2.479, 1.479, 1, -2.086), own_input=True),
    Frame((0, 1, 2, 0, 3, 1), (False, False), HELD, 4, 1),  # sun, output, ring 1, carrier 2
    [(4, 2), (4, 0), (0, HELD), (3, HELD)],
)
AOD = Built(
    Space(2, 5, 2, (2.4, 1.467, 1, 0.667, -2), meshed=1, own_input=True),
    Frame((0, 1, 2, 3, 1, 2), (False, True), HELD, 4, 2),  # large sun, carrier, ring, small sun
    [(4, 3), (4, 0), (4, 1), (0, HELD), (1, HELD)],
)
GF4A = AOD._replace(space=AOD.space._replace(targets=(2.8, 1.54, 1, 0.7, -2.333)))
A41TE = Built(
    Space(2, 5, 2, (2.842, 1.573, 1, 0.689, -2.214), own_input=True),
    Frame((0, 1, 2, 3, 2, 1), (False, False), HELD, 4, 2),  # front sun, its carrier, output, sun
    [(4, 3), (4, 1), (4, 0), (0, HELD), (1, HELD)],
)
GM6 = Built(
    Space(3, 5, 2, (4.584, 2.964, 1.912, 1.446, 1, 0.746, -2.943), cells=12),
    # input, input carrier, input ring, output sun, output, reaction sun
    Frame((0, 1, 2, 3, 4, 1, 5, 2, 4), (False,) * 3, HELD, 0, 4),
    [(3, HELD), (5, HELD), (0, 5), (0, 2), (2, HELD)],
)
LEPELLETIER = Built(
    Space(3, 5, 2, (4.171, 2.34, 1.521, 1.143, 0.867, 0.691, -3.403), meshed=1, fixed=1, cells=12),
    # front sun, its carrier, input; large sun, carrier, output, small sun
    Frame((0, 1, 2, 3, 4, 5, 6, 4, 5), (False, False, True), 0, 2, 5),
    [(1, 6), (1, 3), (2, 4), (3, HELD), (4, HELD)],
)


def holds(boxes: Sequence[Box], built: Built) -> bool:
    name = min(names(built.frame, built.elements))
    return any((box.frame, box.elements) == name for box in boxes)


@pytest.mark.parametrize(("built", "count"), [(SIMPSON, 9), (A41TE, 6)], ids=["simpson", "41te"])
def test_two_sets_whole(built: Built, count: int) -> None:
    boxes = [box for box in found(built.space) if box.error <= built.space.tolerance]
    assert holds(boxes, built)
    assert len(boxes) == count  # of this search; the proof is that of the cells


@pytest.mark.parametrize(
    "built", [AOD, GF4A, GM6, LEPELLETIER], ids=["aod", "gf4a", "6t70", "6hp26"]
)
def test_its_own_frame(built: Built) -> None:
    frame = min(names(built.frame, ()))[0]
    assert frame in all_frames(built.space)
    assert holds(found_in(built.space, frame), built)


def test_counts_of_frames() -> None:
    """Known counts: 4428 classes with ports of three sets and six links, 3656 of five."""
    assert len(all_frames(Space(3, 1, 2, ()))) == 4428
    assert len(all_frames(Space(3, 1, 1, ()))) == 3656
    space = Space(2, 4, 1, ())
    assert (len(all_frames(space)), searched(space)) == (111, 111 * math.comb(2 + 6, 4))


def ratio(frame: Frame, engaged: Pairs, ratios: Sequence[float]) -> float:
    """By the null space, nan if the speeds are not determined or one port stands."""
    place = {link: at for at, link in enumerate(frame.moving)}
    rows = [
        [(sun, 1.0), (ring, -k), (carrier, k - 1)]
        for (sun, carrier, ring), k in zip(triples(frame.code), ratios, strict=True)
    ]
    rows += [[(a, 1.0), (b, -1.0)] for a, b in engaged]
    matrix = np.zeros((len(rows), len(place)))
    for at, row in enumerate(rows):
        for link, value in row:
            if link in place:
                matrix[at, place[link]] += value
    _, sizes, vectors = np.linalg.svd(matrix)
    speeds = vectors[-1]
    both = speeds[place[frame.input]], speeds[place[frame.output]]
    return float(both[0] / both[1]) if min(*map(abs, both), sizes[-1]) > 1e-9 else math.nan


SPACES = [
    Space(1, 4, 2, (), own_input=True, cells=100),
    Space(2, 3, 1, ()),
    Space(2, 4, 2, (), meshed=2),
    Space(2, 5, 2, (), meshed=1, own_input=True),
    Space(2, 4, 2, (), fixed=1),
    Space(2, 4, 2, (), fixed=2, own_input=True),
    Space(3, 5, 2, (), meshed=1, cells=8),
]
MANY = {1: 3, 2: 3, 3: 7}
"""Gears, by sets: with fewer of them nearly every box is one that is found."""


@pytest.mark.parametrize("space", SPACES, ids=lambda space: f"{space.sets}-{space.links}")
def test_what_was_hidden_is_found(space: Space) -> None:
    chance = seeded(15)
    while True:
        frame = chance.choice(all_frames(space))
        elements = sorted(chance.sample(frame.possible, space.elements))
        ratios = [(1 if one else -1) * chance.uniform(1.4, 5) for one in frame.meshed]
        gears = {
            round(value, 6): some
            for some in combinations(elements, space.engaged)
            if 0.2 < abs(value := ratio(frame, some, ratios)) < 8
        }
        used = {one for some in gears.values() for one in some}
        if len(gears) >= MANY[space.sets] and used == set(elements):
            break
    space = space._replace(targets=tuple(gears))
    boxes = found_in(space, frame)
    assert holds(boxes, Built(space, frame, elements))
    for box in boxes:
        frame_, _ = box.found_as
        values = [ratio(frame_, some, box.ratios) for some in box.gears]
        errors = [abs(math.log(i / t)) for i, t in zip(values, space.targets, strict=True)]
        assert max(errors) == pytest.approx(box.error, abs=1e-9)
