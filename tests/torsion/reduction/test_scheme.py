"""Stiffness matrices and natural frequencies against closed forms."""

import math

import numpy as np
import pytest

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
