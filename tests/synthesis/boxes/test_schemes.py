"""The schemes of boxes, against counts that are known otherwise.

Source of the counts without held links: classes of sound schemes with ordered input and output,
by Burnside's lemma over all schemes (those of `vstatics synth structures --ports`, which
tests/oracle/schemes.py counts apart). With sets that are told apart by their planets, and with
a link that is held, every choice is listed here and the orbits are counted.
"""

from itertools import combinations, permutations, product

import pytest

from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.stems import box_schemes


@pytest.mark.parametrize(
    ("sets", "engaged", "schemes", "ports"),
    [(2, 1, 12, 111), (2, 2, 6, 90), (3, 1, 190, 3656), (3, 2, 155, 4428), (3, 3, 37, 1350)],
)
def test_all_schemes_have_all_choices_of_ports(
    sets: int, engaged: int, schemes: int, ports: int
) -> None:
    found = list(box_schemes(BoxSearch(sets, 4, engaged, (2.0,))))
    assert (len(found), sum(len(one.ports) for one in found)) == (schemes, ports)


def _orbits(search: BoxSearch) -> int:
    """Schemes of two sets with meshed sets, a held link and ports, up to renaming of the sets."""
    seen = set()
    links = search.links
    for first, second in product(permutations(range(links), 3), repeat=2):
        if len({*first, *second}) != links or len({*first, *second}) < 4:
            continue
        if not search.fixed and not {*first} & {*second}:
            continue
        for meshed in combinations((0, 1), search.meshed):
            for held in range(links) if search.fixed else [-1]:
                if search.fixed and (*first, *second).count(held) != search.fixed:
                    continue
                moving = [link for link in range(links) if link != held]
                inputs = [links] if search.own_input else moving
                outputs = [links + search.own_input] if search.own_output else moving
                for ports in product(inputs, outputs):
                    if ports[0] != ports[1]:
                        seen.add(_least((first, second), meshed, held, ports))
    return len(seen)


def _least(
    sets: tuple[tuple[int, ...], ...], meshed: tuple[int, ...], held: int, ports: tuple[int, ...]
) -> tuple[object, ...]:
    """The least of the two orders of the sets, links numbered as they come."""
    forms = []
    for order in ((0, 1), (1, 0)):
        numbers: dict[int, int] = {-1: -1}
        code = [numbers.setdefault(link, len(numbers) - 1) for one in order for link in sets[one]]
        are_meshed = tuple(one in meshed for one in order)
        own = [numbers.get(link, link) for link in ports]
        forms.append((tuple(code), are_meshed, numbers[held], tuple(own)))
    return min(forms)


@pytest.mark.parametrize(
    "search",
    [
        BoxSearch(2, 4, 2, (2.0,), own_input=True),
        BoxSearch(2, 4, 2, (2.0,), own_input=True, meshed=1),
        BoxSearch(2, 4, 1, (2.0,), fixed=1),
        BoxSearch(2, 4, 1, (2.0,), fixed=2),
        BoxSearch(2, 4, 2, (2.0,), fixed=1, own_input=True, meshed=1),
        BoxSearch(2, 4, 2, (2.0,), own_output=True, meshed=1),
        BoxSearch(2, 5, 3, (2.0,), own_input=True, own_output=True, fixed=1),
        BoxSearch(2, 5, 2, (2.0,), shafts=1),
    ],
)
def test_choices_that_a_renaming_makes_equal_are_one(search: BoxSearch) -> None:
    assert sum(len(one.ports) for one in box_schemes(search)) == _orbits(search)
