"""Boxes that are left out within the search are those that would be left out behind it."""

from functools import cache

import pytest

from vstatics.synthesis.boxes.batches.found import found_in
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.choice import BoxFilter, ranked
from vstatics.synthesis.boxes.figures.measured import measured

pytestmark = pytest.mark.slow
TRUCK = BoxSearch(3, 5, 2, (6.0, 3.6, 2.3, 1.5, 1.0, 0.75, -5.0), tolerance=0.04)


@cache
def _boxes(search: BoxSearch) -> tuple[FoundBox, ...]:
    return found_in(search).boxes


@pytest.mark.parametrize(
    "wanted",
    [
        BoxFilter(single=True),
        BoxFilter(brakes=(2,)),
        BoxFilter(single=True, clutches=(2, 3)),
        BoxFilter(limits={"clutches": 2, "brakes": 3}),
    ],
)
def test_filters_within_the_search_give_what_those_behind_it_give(wanted: BoxFilter) -> None:
    searches = TRUCK, wanted.narrowed(TRUCK)
    assert searches[0] != searches[1]
    behind, within = (
        [
            one.found.box
            for one in ranked(TRUCK, [measured(TRUCK, box, 0.98) for box in boxes], wanted)
        ]
        for boxes in map(_boxes, searches)
    )
    assert behind
    assert behind == within
    assert len(behind) < len(_boxes(TRUCK)) or wanted.limits
