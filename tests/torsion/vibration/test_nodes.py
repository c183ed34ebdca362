"""Nodes of modes in chains, by the signs of shapes with 300 digits."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest
from scipy import linalg

from tests.chance import count, seeded
from tests.torsion.vibration.test_gear_modes import only
from vstatics import Mechanism, Spring, Transmission

DIGITS, BITS = 300, 900
"""Of a square of a frequency: the smallest amplitudes are 1e-80 and less."""


class ExactChain(NamedTuple):
    """Masses, a shaft between each two that may go through a pair of wheels, a mount at the first.

    The twist of a shaft is ``q_i - u q_(i+1)``.
    """

    masses: list[Decimal]
    shafts: list[Decimal]
    ratios: list[Decimal]
    mount: Decimal

    def case(self) -> Transmission:
        """What the program reads."""
        springs = [
            Spring({n: 1, n + 1: -float(u)}, stiffness=float(c), name=f"shaft {n}")
            for n, (c, u) in enumerate(zip(self.shafts, self.ratios, strict=True), 1)
        ]
        if self.mount:
            springs.append(Spring({1: 1}, stiffness=float(self.mount), name="mount"))
        inertias = {n: float(mass) for n, mass in enumerate(self.masses, 1) if mass}
        return Transmission(len(self.masses), [], [], [], springs=springs, inertias=inertias)

    def shape(self, square: Decimal) -> list[Decimal]:
        """Amplitudes, by the balance of each mass but the last; then what is left at the last."""
        found, before = [Decimal(1)], -self.mount
        for mass, c, u in zip(self.masses, self.shafts, self.ratios, strict=False):
            torque = before + square * mass * found[-1]  # of the shaft
            found.append((found[-1] - torque / c) / u)
            before = u * torque
        return [*found, before + square * self.masses[-1] * found[-1]]

    def signs(self, square: Decimal) -> int:
        """How often the sign changes along the shape: as many frequencies are below (Sturm)."""
        *shape, left = self.shape(square)
        turned, factor = [], 1
        for amplitude, u in zip(shape, (*self.ratios, Decimal(1)), strict=True):
            turned.append(amplitude * factor)
            factor = factor if u > 0 else -factor
        count = sum(one * other < 0 for one, other in pairwise(turned))
        return count + (left * shape[-1] > 0)

    def nodes(self, mode: int) -> int:
        """Of a mode, from 0: sign changes of the shape at its frequency, found by halving."""
        low, high = Decimal(0), Decimal(10**14)
        for _ in range(BITS):
            middle = (low + high) / 2
            low, high = (middle, high) if self.signs(middle) <= mode else (low, middle)
        *shape, _ = self.shape(low)
        twists = zip(pairwise(shape), self.ratios, strict=True)
        return sum(one * u * other < 0 for (one, other), u in twists)


def random_chain(number: int) -> ExactChain:
    """Masses over five, stiffnesses over eight decades; some links have no mass."""
    rng = seeded(number)
    links = rng.randint(3, 14)
    masses = [Decimal(10 ** rng.uniform(-3, 2)) for _ in range(links)]
    for place in range(1, links - 1):
        if rng.random() < 0.15:
            masses[place] = Decimal(0)
    ratios = [Decimal(rng.choice((1, 1, 1, -2, 3, -0.5))) for _ in range(links - 1)]
    shafts = [Decimal(10 ** rng.uniform(-1, 7)) for _ in range(links - 1)]
    mount = Decimal(10 ** rng.uniform(0, 5)) if rng.random() < 0.5 else Decimal(0)
    return ExactChain(masses, shafts, ratios, mount)


def check(exact: ExactChain) -> None:
    gear = only(exact.case())
    rigid = gear.rigid_modes
    assert rigid == (exact.mount == 0)
    with localcontext(prec=DIGITS):
        expected = [exact.nodes(mode + rigid) for mode in range(len(gear.modes))]
    assert [mode.nodes for mode in gear.modes] == expected


def test_a_chain_whose_amplitudes_decay_below_rounding() -> None:
    """A heavy chain behind a light one: high modes hardly reach it, and each node counts."""
    masses = [Decimal(1) / 100] * 4 + [Decimal(10 + n) for n in range(8)]
    shafts = [Decimal(10**6)] * 3 + [Decimal(100)] * 8
    check(ExactChain(masses, shafts, [Decimal(1)] * 11, Decimal(0)))


@pytest.mark.slow
@pytest.mark.parametrize("number", range(count(10, 25)))
def test_nodes_of_any_chain(number: int) -> None:
    check(random_chain(number))


@pytest.mark.parametrize("seed", range(count(10, 300)))
def test_modes_of_chains_that_are_not_connected_have_the_nodes_of_their_own(seed: int) -> None:
    """Each chain is mounted at its first mass, so its n-th mode has n - 1 nodes."""
    rng = seeded(seed)
    springs, inertias, expected, link = [], {}, [], 0
    for _ in range(rng.randint(2, 3)):
        size = rng.randint(1, 3)
        masses = [rng.uniform(0.5, 5) for _ in range(size)]
        stiffness = np.zeros((size, size))
        for n in range(size):
            link, c = link + 1, rng.uniform(50, 500)
            twist = {link: 1.0, **({link - 1: -1.0} if n else {})}
            springs.append(Spring(twist, stiffness=c, name=f"s{link}"))
            inertias[link] = masses[n]
            row = np.eye(size)[n] - (np.eye(size)[n - 1] if n else 0)
            stiffness += c * np.outer(row, row)
        squares = linalg.eigh(stiffness, np.diag(masses), eigvals_only=True)
        expected += [(math.sqrt(square), nodes) for nodes, square in enumerate(squares)]
    gear = only(Transmission(link, [], [], [], springs=springs, inertias=inertias, output=link))
    found = [(mode.omega, float(mode.nodes)) for mode in gear.modes]
    assert found == [pytest.approx(one) for one in sorted(expected)]


@pytest.mark.parametrize("seed", range(count(15, 300)))
def test_a_body_that_moves_with_two_masses_leaves_no_chain(seed: int) -> None:
    """Nodes are then the shafts whose ends turn against each other, in any number of a mode."""
    rng = seeded(seed)
    ratio = rng.choice((-3.0, -1.0, 0.4, 2.0, 3.0))
    masses, rates = [rng.uniform(0.5, 5) for _ in range(3)], [rng.uniform(50, 500) for _ in "12"]
    third = rng.uniform(1, 10)
    case = Transmission(
        4, [], [Mechanism(1, 2, 4, ratio)], [], output=3,
        inertias=dict(enumerate([*masses, third], 1)),
        springs=[Spring({n: 1, n + 1: -1}, stiffness=c) for n, c in enumerate(rates, 1)],
    )  # fmt: skip
    third_row = np.array([1, -ratio, 0]) / (1 - ratio)  # w1 - i w2 = (1 - i) w4
    rows = np.array([[1, -1, 0], [0, 1, -1]])
    _, shapes = linalg.eigh(
        rows.T @ np.diag(rates) @ rows,
        np.diag(masses) + third * np.outer(third_row, third_row),
    )
    expected = [int(np.sum(one[:-1] * one[1:] < 0)) for one in shapes.T[1:]]
    assert [mode.nodes for mode in only(case).modes] == expected
