"""A chain with one mass less: what stays, what is dropped, where the damping goes."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest

from tests.chance import seeded
from vstatics.torsion.reduction.chain import Chain, ChainSpring, partial_systems
from vstatics.torsion.reduction.simplification import with_masses_merged, without_mass


def chain(inertias: list[float], *springs: tuple[float, ...]) -> Chain:
    """Masses a, b, ...; springs of compliance and damping."""
    names = tuple("abcdefgh"[: len(inertias)])
    return Chain(names, tuple(inertias), tuple(ChainSpring("s", *one) for one in springs))


def compliances(given: Chain) -> list[float]:
    """In the order of the chain."""
    return [spring.compliance for spring in given.springs]


def test_one_mass_and_two_masses_have_one_frequency() -> None:
    """(П1.4), (П1.5): a partial system becomes the other kind of the same frequency, and back."""
    one = chain([0.0, 3.0, 0.0], (2.0,), (5.0,))
    [system, *_] = partial_systems(one._replace(inertias=(1.0, 3.0, 1.0)))
    two = without_mass(one, 1)
    assert two.inertias == pytest.approx((3 * 5 / 7, 3 * 2 / 7))
    [same] = partial_systems(two)
    assert same.frequency == pytest.approx(system.frequency)
    between = Chain(("l", *two.names, "r"), (1.0, *two.inertias, 1.0), (ChainSpring("l", 0.0),) * 3)
    between = between._replace(springs=(ChainSpring("l", 0.0), *two.springs, ChainSpring("r", 0.0)))
    back = with_masses_merged(between, 1)
    assert compliances(back) == pytest.approx([2, 5])
    assert back.inertias == pytest.approx((1, 3, 1))


def random_chains() -> Iterator[Chain]:
    """Free chains of five masses."""
    chance = seeded(12)
    for _ in range(20):
        springs = [(10 ** chance.uniform(-5, -2),) for _ in range(4)]
        yield chain([10 ** chance.uniform(-3, 1) for _ in range(5)], *springs)


def test_sums_stay() -> None:
    """Of inertias always, of compliances away from free ends."""
    for given in random_chains():
        for place in range(1, 4):
            left = without_mass(given, place)
            assert sum(left.inertias) == pytest.approx(sum(given.inertias))
            assert sum(compliances(left)) == pytest.approx(sum(compliances(given)))
        for place in range(1, 3):
            left = with_masses_merged(given, place)
            assert sum(left.inertias) == pytest.approx(sum(given.inertias))
            assert sum(compliances(left)) == pytest.approx(sum(compliances(given)))


def test_the_compliance_at_a_free_end_is_gone() -> None:
    given = chain([3.0, 1.0, 5.0], (1.0,), (2.0,))
    merged = with_masses_merged(given, 0)
    assert merged.inertias == (4, 5)
    assert compliances(merged) == [2 + 1 * 3 / 4]
    assert with_masses_merged(given, 1).inertias == (3, 6)
    assert compliances(with_masses_merged(given, 1)) == [pytest.approx(1 + 2 * 5 / 6)]
    ended = without_mass(given, 0)
    assert (ended.inertias, compliances(ended)) == ((4, 5), [2])
    ended = without_mass(given, 2)
    assert (ended.inertias, compliances(ended)) == ((3, 6), [1])


def test_the_inertia_that_goes_to_the_housing_is_gone() -> None:
    given = chain([math.inf, 4.0, 5.0], (1.0,), (3.0,))
    left = without_mass(given, 1)
    assert left.inertias == (math.inf, 5 + 4 * 1 / 4)
    assert compliances(left) == [4]


def test_damping_of_one_mass() -> None:
    """(П1.14): K = Kl (El/E)^2 + Kr (Er/E)^2."""
    [spring] = without_mass(chain([1, 1, 1], (2.0, 5.0), (3.0, 7.0)), 1).springs
    assert spring.damping == pytest.approx(5 * 0.4**2 + 7 * 0.6**2)


def test_damping_of_two_masses() -> None:
    """(П1.15), then (П1.16), as they are printed."""
    given = chain([9.0, 3.0, 1.0, 9.0], (2.0, 5.0), (4.0, 8.0), (6.0, 7.0))
    part_left, part_right = 4 * 1 / 4, 4 * 3 / 4
    left, right = 8 / 2 * (4 / part_left) ** 2, 8 / 2 * (4 / part_right) ** 2
    expected = [
        5 * (2 / 3) ** 2 + left * (part_left / 3) ** 2,
        right * (part_right / 9) ** 2 + 7 * (6 / 9) ** 2,
    ]
    found = with_masses_merged(given, 1).springs
    assert [spring.damping for spring in found] == pytest.approx(expected)


def test_damping_of_a_whole_chain() -> None:
    """(П1.17): K = K12 (E12/E)^2 + ... of one link that stands for all."""
    given = chain([1, 1, 1, 1], (2.0, 5.0), (3.0, 7.0), (5.0, 1.0))
    [spring] = without_mass(without_mass(given, 1), 1).springs
    assert spring.damping == pytest.approx(5 * 0.2**2 + 7 * 0.3**2 + 1 * 0.5**2)
