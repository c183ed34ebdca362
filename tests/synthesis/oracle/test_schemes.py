"""Counts of schemes against closed forms, and against lists made in the simplest way."""

from collections import Counter
from collections.abc import Iterator
from itertools import combinations, permutations, product

import pytest

from tests.commands import ROOT
from tests.oracle.boxes import codes, hangs_together, triples
from tests.oracle.boxes import is_sound as has_no_locked_group
from tests.oracle.schemes import KEPT, SUN_AND_RING, bodies, classes, connected, labelled, sound

pytestmark = pytest.mark.slow  # nothing in them is the program's own
Code = tuple[int, ...]
PAGE = ROOT / "docs" / "synthesis" / "method.md"


def subsets_of_links(sets: int, links: int) -> Iterator[tuple[frozenset[int], ...]]:
    """As the source lists them: all choices of links, those kept with each element once."""
    possible = [
        frozenset(3 * at + one for at, one in enumerate(chosen) if one < 3)
        for chosen in product(range(4), repeat=sets)
        if min(chosen) < 3
    ]
    for some in combinations(possible, links):
        if sum(map(len, some)) == 3 * sets == len(frozenset().union(*some)):
            yield some


def is_sound(code: Code) -> bool:
    return hangs_together(code) and has_no_locked_group(code)


def least(code: Code, orders: list[tuple[int, ...]], ports: tuple[int, ...]) -> Code:
    """The least name of a scheme with its ports behind it, over all that may be exchanged."""
    names = []
    for way in permutations(triples(code)):
        for turns in product(orders, repeat=len(way)):
            new = [one[k] for one, turn in zip(way, turns, strict=True) for k in turn]
            numbers: dict[int, int] = {}
            names.append(tuple(numbers.setdefault(link, len(numbers)) for link in (*new, *ports)))
    return min(names)


GROUPS: dict[str, list[tuple[int, ...]]] = {
    "sets": [KEPT],
    "members": [KEPT, SUN_AND_RING],
    "order": list(permutations(KEPT)),
}


def test_two_sets_from_4368_subsets_of_links() -> None:
    found = {links: list(subsets_of_links(2, links)) for links in (4, 5)}
    assert {links: len(some) for links, some in found.items()} == sound(2) == {4: 18, 5: 9}


@pytest.mark.parametrize("sets", [1, 2, 3, 4])
def test_labelled_schemes_are_those_of_a_list(sets: int) -> None:
    every = list(codes(sets))
    assert Counter(max(code) + 1 for code in every) == labelled(sets)
    if sets < 4:
        whole = [code for code in every if hangs_together(code)]
        assert Counter(max(code) + 1 for code in whole) == connected(sets)
        good = Counter(max(code) + 1 for code in whole if is_sound(code))
        assert good == sound(sets)


@pytest.mark.parametrize("sets", range(2, 8))
def test_trees_of_sets_have_their_closed_count(sets: int) -> None:
    """3^N (2N + 1)^(N - 2), hypertrees of triples; every tree is sound."""
    trees = 3**sets * (2 * sets + 1) ** (sets - 2)
    assert connected(sets)[2 * sets + 1] == trees
    if sets < 6:
        assert sound(sets)[2 * sets + 1] == trees


def test_sound_schemes_of_five_sets_and_bodies_by_recursion() -> None:
    """Both together with mixed ones are all; two sets on three links are 3! bodies."""
    assert bodies(2) == {3: 6}
    assert sum(connected(5).values()) == 146_184_993
    assert sum(count for links, count in connected(5).items() if links >= 7) == 111_461_913


@pytest.mark.parametrize("group", GROUPS)
@pytest.mark.parametrize("ports", [False, True], ids=["bare", "ports"])
@pytest.mark.parametrize("all_", [False, True], ids=["sound", "all"])
def test_classes_of_two_sets_are_those_of_a_list(group: str, ports: bool, all_: bool) -> None:
    assert classes(2, group, ports=ports, all_=all_) == listed_classes(2, group, ports, all_)


@pytest.mark.parametrize(("group", "ports"), [("sets", False), ("sets", True), ("members", False)])
def test_classes_of_three_sets_are_those_of_a_list(group: str, ports: bool) -> None:
    assert classes(3, group, ports=ports) == listed_classes(3, group, ports, False)


def listed_classes(sets: int, group: str, ports: bool, all_: bool) -> dict[int, int]:
    """By the names of all schemes, each with all its ports."""
    good = hangs_together if all_ else is_sound
    seen = set()
    for code in codes(sets):
        links = max(code) + 1
        if sets + 2 <= links <= 2 * sets + 1 and good(code):
            pairs = permutations(range(links), 2) if ports else [()]
            seen |= {(links, least(code, GROUPS[group], pair)) for pair in pairs}
    return dict(sorted(Counter(links for links, _ in seen).items()))


def test_the_table_of_the_page() -> None:
    """Counts of two to five sets, five only by what lists nothing."""
    lines = [line for line in PAGE.read_text("utf-8").splitlines() if line.startswith("| ")]
    rows = {line.split("|")[1].strip(): line.split("|")[2:-1] for line in lines}
    many: list[dict[str, int]] = [
        {
            "connected, N + 2 <= J <= 2 N + 1": sum(
                number for links, number in connected(sets).items() if links >= sets + 2
            ),
            "sound": sum(sound(sets).values()),
            "connected, up to renaming of gear sets": sum(classes(sets, all_=True).values()),
            "sound, up to renaming of gear sets": sum(classes(sets).values()),
            "the same with input and output": sum(classes(sets, ports=True).values()),
        }
        for sets in range(2, 6)
    ]
    for name in many[0]:
        printed = [int(cell.replace(",", "")) for cell in rows[name]]
        assert printed == [counted[name] for counted in many]
