"""Counts of schemes against closed forms, and against lists made in the simplest way."""

from collections import Counter
from collections.abc import Iterator
from itertools import combinations, permutations, product

import pytest

from tests.commands import ROOT
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
    assert len(possible) == 4**sets - 1
    for some in combinations(possible, links):
        if sum(map(len, some)) == 3 * sets == len(frozenset().union(*some)):
            yield some


def all_codes(sets: int) -> Iterator[Code]:
    """Restricted growth strings in which no set has two equal numbers."""

    def grown(code: Code) -> Iterator[Code]:
        if len(code) == 3 * sets:
            yield code
            return
        own = code[len(code) // 3 * 3 :]
        for link in range(max(code, default=-1) + 2):
            if link not in own:
                yield from grown((*code, link))

    return grown(())


def renumbered(code: Code) -> Code:
    numbers: dict[int, int] = {}
    return tuple(numbers.setdefault(link, len(numbers)) for link in code)


def is_connected(code: Code) -> bool:
    sets = [set(code[at : at + 3]) for at in range(0, len(code), 3)]
    reached, left = sets[0], sets[1:]
    while near := [one for one in left if one & reached]:
        reached = reached.union(*near)
        left = [one for one in left if one not in near]
    return not left


def is_sound(code: Code) -> bool:
    sets = [set(code[at : at + 3]) for at in range(0, len(code), 3)]
    groups = (group for size in range(1, len(sets) + 1) for group in combinations(sets, size))
    return is_connected(code) and all(len(set().union(*g)) - len(g) >= 2 for g in groups)


def least(code: Code, orders: list[tuple[int, ...]], ports: tuple[int, ...]) -> Code:
    """The least name of a scheme with its ports behind it, over all that may be exchanged."""
    triples = [code[at : at + 3] for at in range(0, len(code), 3)]
    names = []
    for way in permutations(triples):
        for turns in product(orders, repeat=len(triples)):
            new = [one[k] for one, turn in zip(way, turns, strict=True) for k in turn]
            names.append(renumbered((*new, *ports)))
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
    codes = list(all_codes(sets))
    assert Counter(max(code) + 1 for code in codes) == labelled(sets)
    if sets < 4:
        whole = [code for code in codes if is_connected(code)]
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
    good = is_connected if all_ else is_sound
    seen = set()
    for code in all_codes(sets):
        links = max(code) + 1
        if sets + 2 <= links <= 2 * sets + 1 and good(code):
            pairs = permutations(range(links), 2) if ports else [()]
            seen |= {(links, least(code, GROUPS[group], pair)) for pair in pairs}
    return dict(sorted(Counter(links for links, _ in seen).items()))


def test_the_table_of_the_page() -> None:
    """Counts of two to five sets, five only by what lists nothing."""
    text = PAGE.read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    rows = {line.split("|")[1].strip(): line.split("|")[2:-1] for line in lines}
    sizes = range(2, 6)

    def printed(name: str) -> list[int]:
        return [int(cell.replace(" ", "")) for cell in rows[name]]

    enough = [sum(n for links, n in connected(sets).items() if links >= sets + 2) for sets in sizes]
    assert printed("connected, N + 2 <= J <= 2 N + 1") == enough
    assert printed("sound") == [sum(sound(sets).values()) for sets in sizes]
    counted = [sum(classes(sets, all_=True).values()) for sets in sizes]
    assert printed("connected, up to renaming of sets") == counted
    counted = [sum(classes(sets).values()) for sets in sizes]
    assert printed("sound, up to renaming of sets") == counted
    counted = [sum(classes(sets, ports=True).values()) for sets in sizes]
    assert printed("the same with input and output") == counted
