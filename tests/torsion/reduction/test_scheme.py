"""Stiffness matrices and natural frequencies against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vstatics.torsion.reduction.scheme import (
    SchemeSpring,
    TorsionScheme,
    natural_frequencies,
    stiffness_matrix,
)


def masses(*inertias: float) -> tuple[tuple[str, ...], tuple[float, ...]]:
    """Names and inertias."""
    return tuple(f"m{number}" for number, _ in enumerate(inertias)), inertias


def uniform(count: int, *, held: bool = False) -> TorsionScheme:
    """Equal masses of 2 kg*m^2 on equal shafts of 50 N*m/rad."""
    springs = [SchemeSpring(f"s{n}", {n: 1, n + 1: -1}, 0.02) for n in range(count - 1)]
    if held:
        springs.append(SchemeSpring("mount", {0: 1}, 0.02))
    return TorsionScheme(*masses(*[2.0] * count), tuple(springs))


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


@pytest.mark.parametrize("count", [2, 3, 10])
def test_free_chain_of_equal_masses(count: int) -> None:
    """2 sqrt(c/J) sin(k pi/2n), k = 1 to n - 1."""
    expected = [10 * math.sin(k * math.pi / 2 / count) for k in range(1, count)]
    assert natural_frequencies(uniform(count)) == pytest.approx(expected)


@pytest.mark.parametrize("count", [1, 2, 10])
def test_held_chain_of_equal_masses(count: int) -> None:
    """2 sqrt(c/J) sin((2k - 1) pi/(4n + 2)), k = 1 to n."""
    expected = [10 * math.sin((2 * k - 1) * math.pi / (4 * count + 2)) for k in range(1, count + 1)]
    assert natural_frequencies(uniform(count, held=True)) == pytest.approx(expected)


def test_a_soft_support_is_an_ordinary_mode() -> None:
    """All masses on it as one: sqrt(c / sum of J), though it is 1e12 times as soft as the shafts."""
    free = uniform(3)
    held = free._replace(springs=(*free.springs, SchemeSpring("soft", {0: 1}, 0.02e12)))
    first, *others = natural_frequencies(held)
    assert first == pytest.approx(math.sqrt(1 / 0.02e12 / 6), rel=1e-6)
    assert others == pytest.approx(natural_frequencies(free))


def test_stiffnesses_that_are_far_apart() -> None:
    """Two equal masses in a row on the housing: the product of omegas is sqrt(c1 c2)/J."""
    springs = SchemeSpring("stiff", {0: 1}, 0.5e-7), SchemeSpring("soft", {0: 1, 1: -1}, 0.5e7)
    low, high = natural_frequencies(TorsionScheme(*masses(2.0, 2.0), springs))
    assert high == pytest.approx(math.sqrt(1e7), rel=1e-12)
    assert low * high == pytest.approx(1, rel=1e-8)


def test_masses_without_inertia_follow() -> None:
    """Two shafts in a row with nothing between are one; a shaft to nothing does nothing."""
    springs = (
        SchemeSpring("a", {0: 1, 1: -1}, 1.0),
        SchemeSpring("b", {1: 1, 2: -1}, 3.0),
        SchemeSpring("c", {2: 1, 3: -1}, 1.0),
    )
    found = natural_frequencies(TorsionScheme(*masses(1.0, 0.0, 1.0, 0.0), springs))
    assert found == pytest.approx((math.sqrt(2 / 4),))


def test_nothing_that_vibrates() -> None:
    assert natural_frequencies(TorsionScheme(*masses(1.0, 1.0), ())) == ()
    shaft = SchemeSpring("a", {0: 1, 1: -1}, 1.0)
    assert natural_frequencies(TorsionScheme(*masses(1.0, 0.0), (shaft,))) == ()
    assert natural_frequencies(TorsionScheme(*masses(0.0, 0.0), (shaft,))) == ()
