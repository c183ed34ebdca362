"""Schemes of masses and springs: stiffness, natural frequencies, chains, masses that turn as one."""

import math

import numpy as np
import pytest
from scipy import linalg

from tests.chance import each_seed, generator
from tests.rejects import rejects
from tests.torsion.book import chain
from vstatics import CaseError
from vstatics.torsion.reduction.chain import Chain, chain_of, partial_systems, scheme_of
from vstatics.torsion.reduction.merging import simplify_merging
from vstatics.torsion.reduction.scheme import (
    SchemeSpring,
    TorsionScheme,
    natural_frequencies,
    stiffness_matrix,
)  # fmt: skip


def masses(*inertias: float) -> tuple[tuple[str, ...], tuple[float, ...]]:
    return tuple(f"m{number}" for number, _ in enumerate(inertias)), inertias


def shaft(first: int, second: int, compliance: float = 1.0) -> SchemeSpring:
    return SchemeSpring(f"s{first}", {first: 1, second: -1}, compliance)


def test_stiffness_is_the_sum_of_squares_of_twists() -> None:
    """A gearbox with a compliant casing: equations (1.11) and (1.12) of Tsitovich and Algin."""
    i, own, casing = 3.5, 2e-4, 1e-3
    springs = SchemeSpring("mesh", {0: 1, 1: -i, 2: i - 1}, own), SchemeSpring("r", {2: 1}, casing)
    row = np.array([1, -i, -(1 - i)])
    expected = np.outer(row, row) / own + np.diag([0, 0, 1 / casing])
    found = stiffness_matrix(TorsionScheme(*masses(1, 1, 1), springs))
    assert found == pytest.approx(expected)


def test_one_spring_on_any_masses() -> None:
    """omega^2 = (sum of a^2/J)/E, of one link (1/Ja + 1/Jb)/E."""
    spring = SchemeSpring("differential", {0: 1, 1: -0.5, 2: -0.5}, 1e-3)
    found = natural_frequencies(TorsionScheme(*masses(0.2, 0.7, 0.9), (spring,)))
    expected = math.sqrt((1 / 0.2 + 0.25 / 0.7 + 0.25 / 0.9) / 1e-3)
    assert found == pytest.approx((expected,))


def test_stiffnesses_that_are_far_apart() -> None:
    """Two equal masses in a row on the housing: the product of omegas is sqrt(c1 c2)/J.

    On a soft support both are one mass: sqrt(c/sum of J).
    """
    springs = SchemeSpring("stiff", {0: 1}, 0.5e-7), shaft(0, 1, 0.5e7)
    low, high = natural_frequencies(TorsionScheme(*masses(2.0, 2.0), springs))
    assert high == pytest.approx(math.sqrt(1e7), rel=1e-12)
    assert low * high == pytest.approx(1, rel=1e-8)
    springs = SchemeSpring("soft", {0: 1}, 0.02e12), shaft(0, 1, 0.02)
    low, _ = natural_frequencies(TorsionScheme(*masses(2.0, 4.0), springs))
    assert low == pytest.approx(math.sqrt(1 / 0.02e12 / 6), rel=1e-6)


def test_masses_without_inertia_follow() -> None:
    """Two shafts in a row with nothing between are one; a shaft to nothing does nothing."""
    springs = shaft(0, 1), shaft(1, 2, 3.0), shaft(2, 3)
    found = natural_frequencies(TorsionScheme(*masses(1.0, 0.0, 1.0, 0.0), springs))
    assert found == pytest.approx((math.sqrt(2 / 4),))
    for inertias, some in (((1.0, 1.0), ()), ((1.0, 0.0), springs[:1]), ((0.0, 0.0), springs[:1])):
        assert natural_frequencies(TorsionScheme(*masses(*inertias), some)) == ()


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


def fork(left: float = 1.0) -> TorsionScheme:
    ends = {"s": (0, 1, 0.5), "l": (1, 2, 1.0), "r": (1, 3, 1.0)}
    springs = [SchemeSpring(name, {a: 1, b: -1}, e) for name, (a, b, e) in ends.items()]
    return TorsionScheme(("a", "b", "l", "r"), (4.0, 2.0, left, 1.0), tuple(springs))


@each_seed(8)
def test_both_turn_as_one(seed: int) -> None:
    """Any springs, of three links and to the housing too: eigenvalues of C^T K C, C^T J C."""
    chance = generator(seed)
    names, inertias = tuple("abcde"), tuple(chance.uniform(0.5, 3, size=5).tolist())
    pairs = [(n, m) for n in range(5) for m in range(n)]
    springs = [
        SchemeSpring(f"s{n}{m}", {n: 1.0, m: -float(chance.choice([1.0, 2.5]))}, e)
        for (n, m), e in zip(pairs, chance.uniform(0.1, 2, size=10).tolist(), strict=True)
    ]
    given = TorsionScheme(names, inertias, (*springs, SchemeSpring("mount", {4: 1.0}, 1.0)))
    one, two = sorted(chance.choice(5, size=2, replace=False).tolist())
    joined = np.delete(np.eye(5), two, axis=1)
    joined[two, one] = 1.0
    stiffness = joined.T @ stiffness_matrix(given) @ joined
    masses = joined.T @ np.diag(inertias) @ joined
    omegas = np.sqrt(linalg.eigh(stiffness, masses, eigvals_only=True))
    pair = f"{names[two]}+{names[one]}"
    found = simplify_merging(given, 4, None, (), [pair])
    assert found.steps[0].omegas == pytest.approx(omegas, rel=1e-9)
    assert sum(found.scheme.inertias) == pytest.approx(sum(inertias))


def test_equal_branches_lose_the_mode_in_which_they_swing_against_each_other() -> None:
    """It is sqrt(1/(E J)) of one branch; all others stay."""
    [step] = simplify_merging(fork(), 2, None, (), ["l+r"]).steps
    assert step.partial_frequency == pytest.approx(1.0)
    before = natural_frequencies(fork())
    assert sorted([*step.omegas, 1.0]) == pytest.approx(before)
    assert step.names == ("a", "b", "l+r")
    assert step.compliances == pytest.approx((0.5, 0.5))


def test_a_merged_mass_has_a_name_to_merge_it_again() -> None:
    found = simplify_merging(fork(left=3.0), 1, None, (), ["l+r", "l+r+b"])
    assert [one.operation for one in found.steps] == ["merge l and r", "merge l+r and b"]
    assert found.scheme.names == ("a", "l+r+b")
    assert found.scheme.inertias == (4.0, 6.0)


def test_what_is_no_pair() -> None:
    for remove, merge, message in (
        ([], ["l+x"], "read `l+x` to merge"),
        ([], ["l"], "expected two links of the system as `A+B`"),
        ([], ["l+l"], "read `l+l` to merge"),
        ([], ["+"], "to merge"),
        (["l"], ["l+r"], "read `l+r` to merge"),
        ([], ["l+r", "l+b"], "read `l+b` to merge"),
        (["l", "r", "b", "a"], ["l+r"], "links to remove"),
    ):
        with rejects(CaseError, message):
            simplify_merging(fork(), 1, None, remove, merge)
