"""Lists and counts of schemes, against lists made in the simplest way and counts that list none."""

import json
from collections import Counter
from itertools import permutations, product
from typing import get_args

import numpy as np
import pytest

from tests.chance import with_slow
from tests.oracle import schemes as oracle
from tests.oracle.boxes import codes, hangs_together
from tests.synthesis.oracle.test_schemes import GROUPS, is_sound, least
from vstatics.core.tables.answer import plain_data
from vstatics.synthesis.structures.counts import count
from vstatics.synthesis.structures.estimate import estimate
from vstatics.synthesis.structures.growth import (
    Classes,
    SchemeBatch,
    StructureSearch,
    batches,
    check_search,
    ports,
    schemes,
    weights,
)
from vstatics.synthesis.structures.json_lines import lines

Row = tuple[int, ...]
CHOICES = [*product(get_args(Classes), (False, True), (False, True))]
SMALL = [StructureSearch(sets, *choice) for sets in (1, 2) for choice in CHOICES]
THREE_SETS = [StructureSearch(3), StructureSearch(3, "sets", ports=True)]
THREE_SETS += [StructureSearch(3, "members", unsound=True)]


def rows(search: StructureSearch) -> list[Row]:
    """All schemes in their order, with the input and output behind them where there are any."""
    found: list[Row] = []
    for batch in batches(search):
        codes = [tuple(one) for one in batch.codes.tolist()]
        if search.ports:
            triples = zip(*(part.tolist() for part in ports(batch)), strict=True)
            codes = [(*codes[k], i, o) for k, i, o in triples]
        found += codes
    return found


def listed(search: StructureSearch) -> list[Row]:
    """The same by looking at every code, every order and every exchange."""
    good = hangs_together if search.unsound else is_sound
    found = set()
    for code in codes(search.sets):
        links = max(code) + 1
        if links in search.link_range and good(code):
            pairs = permutations(range(links), 2) if search.ports else [()]
            if search.classes == "none":
                found |= {(*code, *pair) for pair in pairs}
            else:
                found |= {least(code, GROUPS[search.classes], pair) for pair in pairs}
    return sorted(found)


@pytest.mark.parametrize("searches", with_slow([SMALL], [THREE_SETS]))
def test_schemes_of_up_to_three_sets_are_all_of_them(searches: list[StructureSearch]) -> None:
    """Each with the least code of its class, each once, ascending."""
    for search in searches:
        assert rows(search) == listed(search), search


FOUR_SETS = [StructureSearch(4, *choice) for choice in CHOICES]


@pytest.mark.parametrize("search", with_slow(FOUR_SETS[5:7], FOUR_SETS), ids=str)
def test_counts_of_four_sets(search: StructureSearch) -> None:
    """Against the lemma of Burnside with schemes that are counted by recursion, by links."""
    assert count(search) == counted(search)


def counted(search: StructureSearch) -> dict[int, int]:
    sets, classes, unsound, with_ports, *_ = search
    if classes != "none":
        return oracle.classes(sets, classes, ports=with_ports, all_=unsound)
    whole = oracle.connected(sets) if unsound else oracle.sound(sets)
    by_links = {links: number for links, number in whole.items() if links in search.link_range}
    return {n: k * (n * (n - 1) if with_ports else 1) for n, k in by_links.items()}


@pytest.mark.parametrize("search", [StructureSearch(3, "members", ports=True), StructureSearch(3)])
def test_a_list_has_as_many_as_are_counted(search: StructureSearch) -> None:
    found: Counter[int] = Counter()
    for batch in batches(search):
        which = ports(batch).which if search.ports else slice(None)
        found.update(batch.links[which].tolist())
    assert found == count(search)


@pytest.mark.slow
def test_five_sets_in_one_process() -> None:
    """802 776 classes, 43 570 875 with input and output, 93 304 953 schemes: by Burnside.

    All in one listing, ascending, so none comes twice.
    """
    search = StructureSearch(5, "sets")
    searches = [search, search._replace(ports=True), search._replace(classes="none")]
    found: list[Counter[int]] = [Counter() for _ in searches]
    before = (0,)
    for batch in batches(search):
        steps = np.diff(batch.codes.astype(int), axis=0)
        first = (steps != 0).argmax(axis=1)
        assert (steps[np.arange(len(steps)), first] > 0).all()
        assert before < (before := tuple(batch.codes[-1].tolist()))
        for one, numbers in zip(searches, found, strict=True):
            sizes = weights(one, batch)
            for links in range(7, 12):
                numbers[links] += int(sizes[batch.links == links].sum())
    assert found == [counted(one) for one in searches]


@pytest.mark.parametrize("classes", ["none", "sets", "order"])
def test_wanted_links_are_those_of_all(classes: str) -> None:
    search = StructureSearch(3, classes)  # type: ignore[arg-type]
    some = [row for row in rows(search) if max(row) + 1 in (5, 7)]
    assert rows(search._replace(links=(7, 5, 7))) == some
    assert count(search._replace(links=(7, 5))) == Counter(max(row) + 1 for row in some)


def test_what_can_not_be_is_refused() -> None:
    for sets, links, message in (
        (3, 4, "read 4 links, but 3 sets have 5 to 7"),
        (1, 4, "read 4 links, but one set has 3"),
        (0, 3, "read 0 sets, expected 1 to 10"),
        (11, 13, "read 11 sets, expected 1 to 10"),
    ):
        with pytest.raises(ValueError, match=message):
            check_search(StructureSearch(sets, links=(links,)))


def test_lines_have_the_records() -> None:
    """A tree of five sets has 11 links; the last one is 10."""
    for search in (
        StructureSearch(1, ports=True),
        StructureSearch(2, "order", ports=True),
        StructureSearch(3, "members", unsound=True, ports=True),
        StructureSearch(3, "sets", links=(6,)),
        StructureSearch(2, ports=True, matrix=True),
        StructureSearch(3, "order", matrix=True),
    ):
        text = b"".join(lines(search, batch) for batch in batches(search)).splitlines()
        assert [json.loads(line) for line in text] == [plain_data(one) for one in schemes(search)]
    code = np.array([[0, 1, 2, 0, 3, 4, 0, 5, 6, 0, 7, 8, 0, 9, 10]], np.uint8)
    batch = SchemeBatch(code, np.array([11]), None, np.zeros(1, np.intp))
    [line] = lines(StructureSearch(5), batch).splitlines()
    expected = {"code": "-".join(map(str, code[0])), "links": 11, "input": None, "output": None}
    assert json.loads(line) == expected


@pytest.mark.slow
def test_an_estimate_is_true_to_a_few_per_cent() -> None:
    """A count of the oracle, and trees, which have a closed count: 3^7 * 15^5."""
    for search, expected, within in (
        (StructureSearch(5, "sets"), 802_776, 0.03),
        (StructureSearch(7, links=(15,)), 1_660_753_125, 0.1),
    ):
        found = estimate(search, listed=False)
        assert found.total == pytest.approx(expected, rel=within)
        assert not found.exact


@pytest.mark.parametrize("sets", with_slow([1, 2, 3, 4, 5], [6]))
def test_labelled_schemes_are_counted_without_a_list(sets: int) -> None:
    """Sound and connected ones against the oracle, whose recursion is written apart."""
    for unsound, whole in ((False, oracle.sound), (True, oracle.connected)):
        search = StructureSearch(sets, unsound=unsound)
        assert count(search) == {links: whole(sets)[links] for links in search.link_range}
    links = 2 * sets + 1
    trees = 3**sets * links**sets // links**2
    search = StructureSearch(sets, ports=True, links=(links,))
    assert count(search) == {links: trees * links * (links - 1)}


@pytest.mark.parametrize("sets", with_slow([1, 2, 3, 4, 5], [7]))
def test_trees_with_members_in_any_order_are_triangular_cacti(sets: int) -> None:
    """OEIS A003081, Harary and Palmer, Graphical Enumeration, (3.4.21)."""
    links = 2 * sets + 1
    cacti = (1, 1, 1, 2, 4, 8, 19, 48)
    assert count(StructureSearch(sets, "order", links=(links,))) == {links: cacti[sets]}


def test_the_published_gearbox_is_one_of_the_classes() -> None:
    """BelAZ-7516, table 1 of the source: sun, carrier and ring of four sets on J1 to J7."""
    table = ((3, 2, 1), (2, 5, 4), (2, 7, 5), (5, 7, 6))
    code = least(tuple(link for one in table for link in one), GROUPS["sets"], ())
    search = StructureSearch(4, "sets", links=(7,))
    found = {one.code for one in schemes(search)}
    assert len(found) == 6141
    assert "-".join(map(str, code)) in found
