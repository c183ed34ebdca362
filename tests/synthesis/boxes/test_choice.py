"""Found boxes side by side: what is one box, families, the Pareto list, filters, the document."""

import re
from functools import cache
from itertools import permutations
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from tests.chance import seeded
from tests.synthesis.boxes.hand_boxes import (
    FORD_10R,
    SIMPSON,
    SIMPSON_SEARCH,
    ZF_6HP,
    ZF_6HP_SEARCH,
    ZF_8HP,
    ZF_8HP_SEARCH,
)
from vstatics import solve
from vstatics.core.readers import from_dict
from vstatics.core.tables.answer import plain_data, schema
from vstatics.synthesis import SetScheme, StructureSearch, schemes
from vstatics.synthesis.boxes.batches.found import found_in
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.boxes.choice import BoxFilter, BoxList, RankedBox, ranked
from vstatics.synthesis.boxes.figures.by_box import LIMITED
from vstatics.synthesis.boxes.figures.measured import MeasuredBox, measured
from vstatics.synthesis.boxes.least_form import identity, least_box
from vstatics.synthesis.boxes.listing import BoxListing, listed_box, wanted_of
from vstatics.synthesis.boxes.reading import listing_of
from vstatics.synthesis.boxes.tables import box_grids
from vstatics.synthesis.tolerances import SAME_FITTED_RATIO

FAST = measured(SIMPSON_SEARCH, SIMPSON, 0.98)
EIGHT = measured(ZF_8HP_SEARCH, ZF_8HP, 0.98)


def renamed(box: FoundBox, seed: int) -> FoundBox:
    """The same box in other words."""
    rng = seeded(seed)
    links = list(range(box.scheme.links))
    rng.shuffle(links)
    new = {HELD: HELD, box.input: box.input, box.output: box.output} | dict(enumerate(links))
    shafts = [one for one in range(box.scheme.links, box.links) if one not in new]
    new |= dict(zip(shafts, rng.sample(shafts, len(shafts)), strict=True))
    order = rng.sample(range(len(box.ratios)), len(box.ratios))
    which = rng.sample(range(len(box.elements)), len(box.elements))
    sets = [tuple(new[link] for link in one) for one in box.scheme.sets]
    elements = [tuple(new[link] for link in box.elements[index]) for index in which]
    return FoundBox(
        SetScheme(tuple(sets[index] for index in order)),  # type: ignore[misc]
        None if box.held is None else new[box.held],
        new[box.input],
        new[box.output],
        tuple((b, a) if b != HELD and rng.random() < 0.5 else (a, b) for a, b in elements),
        tuple(box.ratios[index] for index in order),
        tuple(tuple(which.index(index) for index in one) for one in box.gears),
        box.error,
    )


SHAFTS = SIMPSON._replace(  # an input and an output of its own, and two shafts more
    output=5,
    elements=((4, 6), (0, 6), (6, HELD), (6, 7), (7, 1), (7, 5), (4, 7)),
    gears=((0, 1, 2, 4), (0, 3, 4, 5), (1, 2, 3, 5), (3, 4, 5, 6)),
)


@pytest.mark.parametrize("box", [ZF_8HP, SIMPSON, ZF_6HP, FORD_10R, SHAFTS])
def test_a_box_in_other_words_is_the_same(box: FoundBox) -> None:
    least = least_box(box)
    assert least_box(least) == least
    for seed in range(20):
        assert least_box(renamed(box, seed)) == least


def test_codes_and_ports_are_those_of_the_list_of_schemes() -> None:
    """By the least of all orders of the sets, which another module finds."""
    for seed, one in enumerate([*schemes(StructureSearch(3, "sets", ports=True))][::200]):
        source, sink = one.input or 0, one.output or 0
        scheme = SetScheme.of_code(one.code)
        box = FoundBox(scheme, None, source, sink, (), (-2.0,) * 3, (), 0.0)
        least = least_box(renamed(box, seed))
        assert (least.scheme.code, least.input, least.output) == (one.code, source, sink)


def test_meshed_sets_and_held_links_tell_boxes_apart() -> None:
    least, exchanged = least_box(ZF_6HP), (-71 / 37, 85 / 31, -85 / 38)
    for other in (ZF_6HP._replace(ratios=exchanged), ZF_6HP._replace(held=None)):
        assert identity(least_box(other)) != identity(least)
    # a clutch to what is held is a brake
    clutch = ZF_6HP._replace(elements=(*ZF_6HP.elements[:3], (1, 4), (5, HELD)))
    assert least_box(clutch) == least


def with_figures(found: MeasuredBox, number: int, **figures: Any) -> MeasuredBox:
    """The same with other figures, as another box: one with another held link."""
    return found._replace(
        box=found.box._replace(held=number), figures=found.figures._replace(**figures)
    )


def test_families_have_equal_ratios_in_all_gears() -> None:
    """Equal but for parts of the tolerance."""
    boxes = []
    off = [(0, 0, 0, 0), (0, 0, 0, 5), (0.3, 0, -0.3, 0), (0, 5, 0, 5), (0, 0, 0, 5.3)]
    for number, parts in enumerate(off):
        factors = [1 + SAME_FITTED_RATIO * part for part in parts]
        pairs = zip(FAST.gears, factors, strict=True)
        gears = tuple(gear._replace(ratio=gear.ratio * factor) for gear, factor in pairs)
        boxes.append(with_figures(FAST, number, loss=number)._replace(gears=gears))
    found = ranked(SIMPSON_SEARCH, reversed(boxes), BoxFilter())
    assert [box.family for box in found] == [1, 2, 1, 3, 2]


def test_order_is_by_loss_then_torque() -> None:
    worse = SIMPSON_SEARCH.tolerance * 2
    boxes = [
        with_figures(FAST, 0, loss=0.03, error=0.0),
        with_figures(FAST, 1, loss=0.02, torque=3.0, error=0.009),
        with_figures(FAST, 2, loss=0.02 + 1e-12, torque=2.0, error=0.005),
        with_figures(FAST, 3, loss=0.01, error=worse),
    ]
    found = ranked(SIMPSON_SEARCH, boxes, BoxFilter())
    assert [one.found.box.held for one in found] == [2, 1, 0, 3]


def test_what_is_found_twice_is_listed_once() -> None:
    boxes = []
    for seed in range(6):
        box = renamed(ZF_8HP, seed)
        near = tuple(ratio * (1 + 1e-4 * seed) for ratio in box.ratios)
        boxes.append(measured(ZF_8HP_SEARCH, box._replace(ratios=near), 0.98))
    best = min(box.figures.error for box in boxes)
    for order in list(permutations(boxes))[::100]:
        [found] = ranked(ZF_8HP_SEARCH, order, BoxFilter())
        assert found.found.figures.error == best


def test_filters() -> None:
    for wanted, stays in (
        (BoxFilter(), True),
        (BoxFilter(single=True, planar=True, brakes=(2,), clutches=(1, 3)), True),
        (BoxFilter(brakes=(1, 3)), False),
        (BoxFilter(clutches=(2,)), False),
        *((BoxFilter(limits={name: EIGHT.figures.number(name)}), True) for name in LIMITED),
        *((BoxFilter(limits={name: EIGHT.figures.number(name) - 1e-3}), False) for name in LIMITED),
    ):
        assert len(ranked(ZF_8HP_SEARCH, [EIGHT], wanted)) == stays
        assert wanted.before(EIGHT.box) or not stays
        no = EIGHT._replace(figures=EIGHT.figures._replace(single=False, planar=False))
        filters = BoxFilter(single=True), BoxFilter(planar=True), BoxFilter()
        assert [each.lets(no) for each in filters] == [False, False, True]


def test_document_follows_the_schema_and_its_cases_are_cases() -> None:
    search = ZF_6HP_SEARCH
    [found] = ranked(search, [measured(search, ZF_6HP, 0.98)], BoxFilter())
    document = plain_data(BoxListing(1234, (listed_box(1, found),), 0, wanted_of(search)))
    Draft202012Validator(schema(BoxListing)).validate(document)
    assert (document["searched"], document["found"], document["families"]) == (1234, 1, 1)
    for target, (low, high) in zip(search.targets, document["wanted"]["ratios"], strict=True):
        assert low < target < high
    assert listing_of(document).wanted == wanted_of(search)
    [one] = document["boxes"]
    assert one["held"] == found.found.box.held
    # L0 large sun, L1 rear carrier, L3 small sun, L5 front carrier, L6 input: C, D, B, E, A
    assert [*one["elements"]] == ["T-L0", "T-L1", "F-L0-L5", "F-L1-L6", "F-L3-L5"]
    assert one["elements"]["F-L3-L5"] == ["L3", "L5"]
    assert one["elements"]["T-L0"] == ["L0", "housing"]
    case = from_dict(one["case"])
    assert case == found.found.case
    ratios = [gear["ratio"] for gear in one["gears"].values()]
    assert solve(case).ratio.tolist() == pytest.approx(ratios, rel=1e-12)
    names = [element.name for element in case.shift_elements]
    engaged = [[names[number - 1] for number in gear.engaged] for gear in case.gears]
    assert [gear["engaged"] for gear in one["gears"].values()] == engaged


def test_tables_tell_how_many_boxes_share_their_ratios() -> None:
    boxes = [RankedBox(EIGHT, 1, 1, pareto=True), RankedBox(EIGHT, 1, 2, pareto=False)]
    counts, best, schemes, families = box_grids(7, boxes, 3)
    expected = {"searched": "7", "given up": "3", "found": "2", "families": "1", "Pareto list": "1"}
    assert counts.texts == [[*row] for row in expected.items()]
    assert [row[0] for row in best.texts] == [row[0] for row in schemes.texts] == ["1"]
    assert families.texts[0][:2] == ["1", "2"]
    assert families.texts[0][-9:][0] == "4.696"
    assert len(list(box_grids(7, [], 0))) == 1


def test_a_notebook_shows_counts_the_pareto_list_and_families() -> None:
    found = BoxList(7, ranked(SIMPSON_SEARCH, [FAST], BoxFilter()), 3)._repr_html_()
    rows = [re.findall(r">([^<>]+)</t[dh]>", row) for row in found.split("<tr>")]
    for row in (["searched", "7"], ["given up", "3"], ["found", "1"]):
        assert row in rows
    assert "Pareto list" in found
    assert ">2.479<" in found  # its first gear, as printed for the ZF 3HP 22


TRUCK = BoxSearch(3, 5, 2, (6.0, 3.6, 2.3, 1.5, 1.0, 0.75, -5.0), tolerance=0.04)


@cache
def boxes_of(search: BoxSearch) -> tuple[FoundBox, ...]:
    return found_in(search).boxes


@pytest.mark.slow
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
    assert wanted.narrowed(TRUCK) != TRUCK
    behind, within = (
        ranked(TRUCK, [measured(TRUCK, box, 0.98) for box in boxes_of(search)], wanted)
        for search in (TRUCK, wanted.narrowed(TRUCK))
    )
    assert behind
    assert [one.found.box for one in behind] == [one.found.box for one in within]
    assert len(behind) < len(boxes_of(TRUCK)) or wanted.limits
