"""Springs in place of masses without inertia: closed forms, and the Schur complement."""

import numpy as np
import pytest

from tests.chance import count, each_seed, seeded
from vstatics.torsion.reduction.condensation import tidied, without_massless
from vstatics.torsion.reduction.scheme import (
    SchemeSpring,
    TorsionScheme,
    natural_frequencies,
    stiffness_matrix,
)  # fmt: skip
from vstatics.torsion.reduction.simplification import without_branch_mass

Twist = dict[int, float]


def light(inertias: list[float], *springs: tuple[Twist, float]) -> TorsionScheme:
    return TorsionScheme(
        tuple(str(mass) for mass, _ in enumerate(inertias)),
        tuple(inertias),
        tuple(SchemeSpring(n, *given) for n, given in zip("abcdefgh", springs, strict=False)),
    )


def test_differentials_and_shafts_in_a_row() -> None:
    """Figure П1.6: the twist 1, -i, -(1 - i) stays, C = C1 C2/((1 - i)^2 C1 + C2).

    Two differentials are 1, -i1, -(1 - i1) i2, -(1 - i1)(1 - i2).
    """
    i1, i2, one, two = 2.5, 0.4, 0.3, 0.7
    shaft: Twist = {2: -1, 3: 1}
    given = light([1, 1, 1, 0], ({0: 1, 1: -i1, 3: -(1 - i1)}, one), (shaft, two))
    [spring] = without_massless(given).springs
    assert spring.twist == pytest.approx({0: 1, 1: -i1, 2: -(1 - i1)})
    assert 1 / spring.compliance == pytest.approx(1 / one / two / ((1 - i1) ** 2 / one + 1 / two))
    first: Twist = {0: 1, 1: -i1, 4: -(1 - i1)}
    given = light([1, 1, 1, 1, 0], (first, one), ({4: 1, 2: -i2, 3: -(1 - i2)}, two))
    [spring] = without_massless(given).springs
    expected = {0: 1, 1: -i1, 2: -(1 - i1) * i2, 3: -(1 - i1) * (1 - i2)}
    assert spring.twist == pytest.approx(expected)
    assert spring.compliance == pytest.approx(one + (1 - i1) ** 2 * two)


def test_two_differentials_on_the_same_masses() -> None:
    """Figure П1.6: 1 - i2, -(i1 - i2), -(1 - i1), by its first coefficient."""
    i1, i2 = 2.5, 0.4
    first: Twist = {0: 1, 1: -i1, 3: -(1 - i1)}
    given = light([1, 1, 1, 0], (first, 0.3), ({2: 1, 1: -i2, 3: -(1 - i2)}, 0.7))
    [spring] = without_massless(given).springs
    expected = {0: 1 - i2, 1: -(i1 - i2), 2: -(1 - i1)}
    assert spring.twist == pytest.approx({mass: a / (1 - i2) for mass, a in expected.items()})


def random_scheme(seed: int) -> TorsionScheme:
    """Eight masses, three of them without inertia, and twists of two to four members."""
    chance = seeded(seed)
    springs = []
    for number in range(10):
        members = {number % 8, *chance.sample(range(8), chance.randint(1, 3))}
        twist = {mass: chance.choice([-1, 1]) * chance.uniform(0.2, 3) for mass in members}
        springs.append(SchemeSpring(f"s{number}", twist, 10 ** chance.uniform(-6, 0)))
    inertias = [chance.uniform(0.1, 2) for _ in range(5)] + [0.0] * 3
    return TorsionScheme(tuple("abcdefgh"), tuple(inertias), tuple(springs))


@each_seed(20)
def test_any_scheme_keeps_its_stiffness_and_frequencies(seed: int) -> None:
    """K of the masses with inertia is its Schur complement (static condensation)."""
    given = random_scheme(seed)
    left = without_massless(given)
    whole, heavy = stiffness_matrix(given), np.array(given.inertias) > 0
    outer, mixed, inner = whole[heavy][:, heavy], whole[heavy][:, ~heavy], whole[~heavy][:, ~heavy]
    expected = outer - mixed @ np.linalg.solve(inner, mixed.T)
    assert len(left.springs) <= len(given.springs) - 3
    assert stiffness_matrix(left) == pytest.approx(expected, abs=1e-9 * abs(expected).max())
    assert natural_frequencies(left) == pytest.approx(natural_frequencies(given), rel=1e-9)


def test_differentials_without_their_masses_still_turn_freely() -> None:
    """All masses can rotate together without a twist, so n masses have n - 1 frequencies above 0."""
    chance = seeded(2)
    for _ in range(count(60, 2000)):
        springs = [SchemeSpring("s", {mass: 1.0, mass - 1: -1.0}, 1e-3) for mass in range(1, 6)]
        for _ in range(2):
            masses, i = chance.sample(range(6), 3), round(chance.uniform(0.2, 3), 3)
            twist = dict(zip(masses, (1.0, -i, i - 1), strict=True))
            springs.append(SchemeSpring("d", twist, chance.uniform(1e-5, 1e-3)))
        scheme = TorsionScheme(tuple("abcdef"), (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), tuple(springs))
        for mass in chance.sample("abcdef", 4):
            scheme = without_branch_mass(scheme, scheme.names.index(mass), "r")
            found = natural_frequencies(without_massless(scheme))
            assert len(found) == sum(inertia > 0 for inertia in scheme.inertias) - 1, scheme


def test_a_meeting_of_three_stays_where_the_shape_is_kept() -> None:
    star = light([1, 1, 1, 0], *(({n: 1.0, 3: -1.0}, 1.0) for n in range(3)))
    assert tidied(star) == star
    springs = zip(star.springs, (9.0, 18.0, 27.0), strict=True)
    damped = star._replace(springs=tuple(one._replace(damping=d) for one, d in springs))
    found = without_massless(damped).springs  # a with b, then c with half of both, by (П1.14)
    assert [one.damping for one in found] == pytest.approx([27 / 4, (27 / 9 + 27 * 4 / 9) / 4])


def test_parallel_springs_are_one() -> None:
    """One of them is written with doubled coefficients: four times the stiffness."""
    given = light([1, 1], ({0: 1, 1: -1}, 0.5), ({0: -2, 1: 2}, 2.0))
    [spring] = tidied(given).springs
    assert spring == SchemeSpring("a+b", {0: 1, 1: -1}, 0.25)


def test_springs_that_nothing_resists_are_gone() -> None:
    given = light([1, 1, 0, 0], ({0: 1, 1: -1}, 1.0), ({1: 1, 2: -1}, 1.0), ({2: 1, 3: -1}, 1.0))
    left = tidied(given)
    assert left.names == ("0", "1")
    assert [spring.name for spring in left.springs] == ["a"]


def test_damping_in_a_row_is_weighed_by_squares_of_compliances() -> None:
    """(П1.17): K = K12 (E12/E)^2 + ... ; parallel dampers add."""
    row = [(1.0, 5.0), (2.0, 3.0), (7.0, 0.5)]
    springs = [SchemeSpring("s", {mass: 1, mass + 1: -1}, *given) for mass, given in enumerate(row)]
    chain = TorsionScheme(tuple("abcd"), (1, 0, 0, 1), tuple(springs))
    [spring] = tidied(chain).springs
    assert spring.damping == pytest.approx(sum(k * (e / 10) ** 2 for e, k in row))
    both = TorsionScheme(("a", "b"), (1, 1), (springs[0], springs[0]))
    assert tidied(both).springs[0].damping == 10


def test_damping_of_a_differential_and_a_shaft() -> None:
    """Both in one torque M: each dissipates K (E M')^2, with M' its own torque for 1 of M."""
    i, first, second = 2.5, (0.3, 4.0), (0.7, 9.0)
    differential = SchemeSpring("a", {0: 1, 1: -i, 3: -(1 - i)}, *first)
    springs = (differential, SchemeSpring("b", {2: -1, 3: 1}, *second))
    [spring] = tidied(TorsionScheme(tuple("abcd"), (1, 1, 1, 0), springs)).springs
    expected = first[1] * first[0] ** 2 + second[1] * (second[0] * (1 - i)) ** 2
    assert spring.damping * spring.compliance**2 == pytest.approx(expected)
