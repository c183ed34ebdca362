"""The search for sets of shift elements, against all sets there are and SciPy's matching."""

from itertools import combinations

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.search.elements import PortGears, begun, some_sets
from vstatics.synthesis.boxes.search.engaged import combinations_table
from vstatics.synthesis.boxes.search.joining import NO_END, set_room

BRAKES = 4
"""The first elements of a table with so many links."""


def is_wanted(
    chosen: tuple[int, ...], numbers: dict[tuple[int, ...], int], port: PortGears, targets: int
) -> bool:
    """Whether brakes are as wanted, each target has a ratio, and each element is engaged."""
    engaged = len(next(iter(numbers)))
    usable = [one for one in combinations(chosen, engaged) if port.ratio_of[numbers[one]] >= 0]
    ratios = sorted({int(port.ratio_of[numbers[one]]) for one in usable})
    if {element for one in usable for element in one} != {*chosen}:
        return False
    if sum((port.retained >> element) & 1 for element in chosen) < port.least_kept:
        return False
    if not (port.brakes >> sum(element < BRAKES for element in chosen)) & 1:
        return False
    can = (port.reach[ratios][:, None] >> np.arange(targets)) & 1
    best = maximum_bipartite_matching(csr_array(can.T.astype(np.int8)), perm_type="column")
    return bool((best >= 0).all())


@pytest.mark.parametrize(
    ("engaged", "size", "targets"), [(1, 4, 3), (2, 4, 4), (2, 5, 3), (3, 5, 6)]
)
def test_all_sets_are_found_and_each_once(engaged: int, size: int, targets: int) -> None:
    table = combinations_table(BRAKES, engaged, size)
    numbers = {tuple(one): number for number, one in enumerate(table.members.tolist())}
    random = np.random.default_rng(32)
    count, links, found_some = len(numbers), len(table.ends), 0
    for _ in range(20):
        ratios = random.integers(2, min(count, 40))
        reach: Integers = np.zeros(count, np.int64)
        reach[:ratios] = (random.random((ratios, targets)) < 0.3) @ (1 << np.arange(targets))
        kinds = random.integers(0, ratios, count)
        usable = (reach[kinds] > 0) & (random.random(count) < random.uniform(0.2, 1))
        missing = int(random.integers(links))
        usable &= (table.members != missing).all(axis=1)
        useful = np.full(count, -1)
        useful[: usable.sum()] = np.flatnonzero(usable)
        brakes = int(random.choice([0b11111, 0b110, 0b10]))
        kept, least_kept = int(random.integers(1 << links)), int(random.integers(3))
        there, none = ((1 << links) - 1) & ~(1 << missing), np.zeros(0, np.int64)
        ratio_of = np.where(usable, kinds, -1)
        shown = (there, ratio_of, reach, useful, brakes, none.reshape(0, 2), table.masks, none)
        port = PortGears(0, 1, *shown, kept, least_kept)
        room = set_room(table, targets, 2000)
        count_sets = some_sets(table, port, room, NO_END)[0] if begun(table, port, room) else 0
        rows = room.listed[:count_sets].tolist()
        every = combinations(range(links), size)
        expected = [one for one in every if is_wanted(one, numbers, port, targets)]
        assert sorted(map(tuple, rows)) == expected
        found_some += len(rows) > 0
    assert found_some
