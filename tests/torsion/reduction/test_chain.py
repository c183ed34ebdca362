"""What is a chain, and its partial systems."""

import math

import pytest

from tests.torsion.book import chain
from vstatics.torsion.reduction.chain import Chain, chain_of, partial_systems, scheme_of
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme, natural_frequencies


def joined(masses: str, *pairs: str) -> TorsionScheme:
    """Masses with names of a letter; a pair is a shaft between two, a letter one to the housing."""
    springs = [
        SchemeSpring(pair, dict(zip(map(masses.index, pair), (1.0, -1.0), strict=False)), number)
        for number, pair in enumerate(pairs, 1)
    ]
    inertias = tuple(float(number) for number, _ in enumerate(masses, 1))
    return TorsionScheme(tuple(masses), inertias, tuple(springs))


def found(scheme: TorsionScheme) -> Chain:
    one = chain_of(scheme)
    assert isinstance(one, Chain), one
    return one


def test_a_chain_begins_with_the_end_that_the_case_has_first() -> None:
    one = found(joined("acdb", "cd", "ba", "ac"))
    assert one.names == ("d", "c", "a", "b")
    assert one.inertias == (3, 2, 1, 4)
    assert [spring.name for spring in one.springs] == ["cd", "ac", "ba"]
    assert [spring.compliance for spring in one.springs] == [1, 3, 2]


def test_the_housing_is_an_end_and_a_single_mass_a_chain() -> None:
    assert found(joined("ab", "ab", "b")).inertias == (1, 2, math.inf)
    assert found(joined("ab", "ab", "a")).inertias == (math.inf, 1, 2)
    assert found(joined("ab", "a", "ab", "b")).names == ("", "a", "b", "")
    assert found(joined("a", "a", "a")).names == ("a", "")
    assert found(joined("a")) == Chain(("a",), (1.0,), ())


def test_parallel_shafts_are_one() -> None:
    [spring] = found(joined("ab", "ab", "ba")).springs
    assert spring.compliance == pytest.approx(1 / (1 / 1 + 1 / 2))


AXLE = TorsionScheme(tuple("abc"), (1, 1, 1), (SchemeSpring("axle", {0: 1, 1: -1, 2: -1}, 1.0),))


def test_a_branched_scheme_is_no_chain() -> None:
    for scheme, why in (
        (joined("abcd", "ab", "ac", "ad"), "3 components act on `a`"),
        (joined("abc", "ab", "bc", "b"), "3 components act on `b`"),
        (joined("abc", "ab", "bc", "ca"), "its springs make a ring"),
        (joined("abcd", "ab", "cd"), "not all of its links are joined by springs"),
        (joined("ab"), "not all of its links are joined by springs"),
        (AXLE, "`axle` is not a shaft between two links: it acts on a, b and c with coefficients"),
    ):
        assert str(chain_of(scheme)).startswith(why)


def test_the_scheme_of_a_chain_is_that_chain() -> None:
    held = found(joined("ab", "a", "ab", "b"))
    assert chain_of(scheme_of(held)) == held
    again = natural_frequencies(scheme_of(held))
    assert again == pytest.approx(natural_frequencies(joined("ab", "a", "ab", "b")))


def test_partial_systems_by_hand() -> None:
    """sqrt((1/El + 1/Er)/J) and sqrt((1/Jl + 1/Jr)/E), (П1.3); at the housing no partner."""
    systems = partial_systems(chain([40, 10, 20, 8], [1, 0.5, 0.25], unit=1))
    names = [("2",), ("3",), ("1", "2"), ("2", "3"), ("3", "4")]
    assert [system.names for system in systems] == names
    pairs = [(1 / 4 + 1) / 1, (1 + 1 / 2) / 0.5, (1 / 2 + 1 / 0.8) / 0.25]
    expected = [(1 + 2) / 1, (2 + 4) / 2, *pairs]
    assert [system.frequency**2 for system in systems] == pytest.approx(expected)
    systems = partial_systems(found(joined("ab", "a", "ab")))
    assert [system.names for system in systems] == [("a",), ("a", "b")]
