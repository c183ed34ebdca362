"""Damped vibration: eigenvalues, and which belongs to which natural mode."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from scipy import linalg

from tests.torsion.systems import branched, chain, matrices
from tests.torsion.vibration.test_gear_modes import omegas, only
from vstatics import Damping, Spring, Transmission


def mounted(damping: Damping | float, stiffness: float = 100.0) -> Transmission:
    """One mass of 1 kg*m^2 on a spring to the housing."""
    spring = Spring({1: 1}, stiffness=stiffness, damping=damping, name="mount")
    return Transmission(1, [], [], [], springs=[spring], inertias={1: 1.0})


def test_one_mass() -> None:
    """``s = -zeta omega + i omega sqrt(1 - zeta^2)``."""
    gear = only(mounted(12.0))
    [mode] = gear.modes
    assert gear.damped == pytest.approx([complex(-6, 8)])
    assert mode.omega == pytest.approx(10)
    assert mode.damping_ratio == pytest.approx(0.6)
    assert mode.damped_frequency == pytest.approx(8 / (2 * math.pi))


def test_an_overdamped_mass_has_two_real_eigenvalues() -> None:
    """``s^2 + 25 s + 100 = 0``."""
    gear = only(mounted(25.0))
    assert gear.damped == pytest.approx([complex(-5, 0), complex(-20, 0)])
    assert (gear.modes[0].damping_ratio, gear.modes[0].damped_frequency) == (1.0, 0.0)


@pytest.mark.parametrize("ratio", [0.001, 0.02, 0.5])
def test_a_damping_ratio_is_that_of_a_mode_of_the_device_alone(ratio: float) -> None:
    gear = only(mounted(Damping(loss_factor=2 * ratio)))
    assert gear.modes[0].damping_ratio == pytest.approx(ratio, rel=1e-12)
    both = chain([1.0, 4.0], [30.0])
    spring = both.springs[0]._replace(damping=Damping(loss_factor=2 * ratio))
    assert only(both.replace(springs=[spring])).modes[0].damping_ratio == pytest.approx(ratio)


@settings(max_examples=50, deadline=None)
@given(branched(damped=True))
def test_every_damped_system(case: Transmission) -> None:
    """All eigenvalues of the first-order form of twice the size, but those of rigid modes."""
    gear = only(case)
    mass, stiffness, resistance = matrices(case)
    size = len(mass)
    first_order = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-linalg.solve(mass, stiffness), -linalg.solve(mass, resistance)],
        ]
    )
    values = np.asarray(linalg.eigvals(first_order), complex)
    values = values[np.argsort(np.abs(values))][2 * gear.rigid_modes :]
    upper = values[values.imag > 1e-7 * np.abs(values)]
    real = values[np.abs(values.imag) <= 1e-7 * np.abs(values)]
    found = np.array(gear.damped)
    assert len(found) == len(upper) + len(real)
    for value in (*upper, *real.real):
        assert np.abs(found - value).min() < 1e-5 * abs(value)
    assert sorted(np.abs(found)) == pytest.approx(list(np.abs(found)), rel=1e-8)
    for mode in gear.modes:
        assert 0 <= mode.damping_ratio <= 1


def test_proportional_damping_leaves_the_shapes() -> None:
    """``D = b K``: ``zeta_k = b omega_k/2``, damped frequency by ``sqrt(1 - zeta^2)``."""
    stiffnesses = [40.0, 90.0, 250.0]
    gear = only(chain([1.0, 2.0, 0.5, 3.0], stiffnesses, [0.01 * c for c in stiffnesses]))
    for mode in gear.modes:
        zeta = 0.005 * mode.omega
        assert mode.damping_ratio == pytest.approx(zeta, rel=1e-11)
        expected = mode.frequency * math.sqrt(1 - zeta**2)
        assert mode.damped_frequency == pytest.approx(expected, rel=1e-11)


def test_a_massless_link_between_a_damped_and_an_undamped_shaft() -> None:
    """It follows by its own rate: roots of the cubic of ``x_2 = (c1 + d s) x_1/(c1 + c2 + d s)``.

    For masses J1, J3 against each other with J = J1 J3/(J1 + J3):
    ``J s^2 (c1 + c2 + d s) + c2 (c1 + d s) = 0``.
    """
    c1, c2, d, j1, j3 = 100.0, 300.0, 5.0, 1.0, 2.0
    gear = only(chain([j1, 0.0, j3], [c1, c2], [d, 0.0]))
    j = j1 * j3 / (j1 + j3)
    roots = np.roots([j * d, j * (c1 + c2), c2 * d, c1 * c2])
    expected = sorted((root for root in roots if root.imag >= 0), key=abs)
    assert gear.damped == pytest.approx(expected, rel=1e-10)
    assert omegas(gear) == pytest.approx([math.sqrt(c1 * c2 / (c1 + c2) / j)])


@pytest.mark.filterwarnings("error")
def test_massless_links_whose_dampings_differ_by_many_powers_of_ten() -> None:
    """One creeps alone, fast, behind a mass that hardly moves: ``s = -(c1 + c2)/d``."""
    dampings = {2: 1e-9, 3: 1e12}
    shafts = [Spring({1: 1, link: -1}, stiffness=1.0, name=f"shaft {link}") for link in dampings]
    mounts = [
        Spring({link: 1}, stiffness=3.0, damping=damping, name=f"mount {link}")
        for link, damping in dampings.items()
    ]
    case = Transmission(3, [], [], [], springs=[*shafts, *mounts], inertias={1: 1e6})
    *_, fast = only(case).damped
    assert fast == pytest.approx(-4e9)


def test_nothing_damped_has_no_eigenvalues_to_tell() -> None:
    assert only(mounted(0.0)).damped == []
