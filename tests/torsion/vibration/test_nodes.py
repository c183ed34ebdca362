"""Nodes of modes in chains: the n-th shape of a chain changes its sign n - 1 times.

Gantmacher, Krein, Oscillation matrices and kernels (1950), of masses in a row.
"""

import math

import numpy as np
import pytest
from scipy import linalg

from tests.chance import count, each_seed, seeded, with_slow
from tests.torsion.systems import chain, sprung
from tests.torsion.vibration.test_gear_modes import only
from vstatics import Mechanism, Spring, Transmission


def check(case: Transmission, rigid: int) -> None:
    """A rigid mode is the first of a chain, and has no node."""
    gear = only(case)
    assert gear.rigid_modes == rigid
    assert [mode.nodes for mode in gear.modes] == [*range(rigid, rigid + len(gear.modes))]


def test_a_chain_whose_amplitudes_decay_below_rounding() -> None:
    """A heavy chain behind a light one: high modes hardly reach it, and each node counts."""
    masses = [0.01] * 4 + [10.0 + n for n in range(8)]
    check(chain(masses, [1e6] * 3 + [100.0] * 8), 1)


@pytest.mark.parametrize("number", with_slow([0, 1], range(2, count(10, 25))))
def test_nodes_of_any_chain(number: int) -> None:
    """Masses over five, stiffnesses over eight decades; some links have no mass.

    Shafts may go through a pair of wheels, with the twist ``q_i - u q_(i+1)``; perhaps a mount.
    """
    rng = seeded(number)
    links = rng.randint(3, 14)
    inertias = {n: 10 ** rng.uniform(-3, 2) for n in range(1, links + 1)}
    for link in range(2, links):
        if rng.random() < 0.15:
            del inertias[link]
    springs = [
        Spring({n: 1, n + 1: -rng.choice((1, 1, 1, -2, 3, -0.5))}, 10 ** rng.uniform(-1, 7))
        for n in range(1, links)
    ]
    if is_mounted := rng.random() < 0.5:
        springs.append(Spring({1: 1}, 10 ** rng.uniform(0, 5)))
    check(sprung(links, springs, inertias), not is_mounted)


@each_seed(10, 300)
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
    gear = only(sprung(link, springs, inertias))
    found = [(mode.omega, float(mode.nodes)) for mode in gear.modes]
    assert found == [pytest.approx(one) for one in sorted(expected)]


@each_seed(15, 300)
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
        rows.T @ np.diag(rates) @ rows, np.diag(masses) + third * np.outer(third_row, third_row)
    )
    expected = [int(np.sum(one[:-1] * one[1:] < 0)) for one in shapes.T[1:]]
    assert [mode.nodes for mode in only(case).modes] == expected
