"""Damped vibration: eigenvalues, and which belongs to which natural mode."""

import cmath
import math
from itertools import product

import numpy as np
import pytest
from scipy import linalg

from tests.chance import each_seed, seeded
from tests.torsion.systems import Array, chain, eigenvalues, matrices, mounted, sprung
from tests.torsion.vibration.test_gear_modes import only
from vstatics import CaseError, Damping, Spring, Transmission
from vstatics.torsion import Harmonic, modes, response
from vstatics.torsion.vibration.eigen_pairs import order_of
from vstatics.torsion.vibration.refined import Pencils


@pytest.mark.parametrize("damping", [0.0, 12.0, 25.0, 60.0, Damping(loss_factor=6.0)])
def test_one_mass(damping: Damping | float) -> None:
    """``s = -zeta omega + i omega sqrt(1 - zeta^2)`` with omega = 10; above 1 both are real."""
    gear = only(mounted(damping))
    [mode] = gear.modes
    zeta = damping / 20 if isinstance(damping, float) else 3.0
    root = cmath.sqrt(zeta**2 - 1)
    both = [10 * (-zeta + root), 10 * (-zeta - root)] if zeta > 1 else [10 * (-zeta + root)]
    assert gear.damped == pytest.approx(both if zeta else [])
    assert mode.omega == pytest.approx(10)
    assert mode.damping_ratio == pytest.approx(zeta, rel=1e-12)
    assert mode.damped_frequency == pytest.approx(10 * root.imag / (2 * math.pi))


def test_numbers_beyond_floats_are_reported() -> None:
    """Stiffness times loss factor, or a damping by an inertia of 0.05, is above 1.8e308."""
    lossy = (9e3, Damping(loss_factor=1e307)), (1e200, Damping(loss_factor=1e200))
    for stiffness, damping in (*lossy, (9e3, Damping(1e308))):
        shaft = Spring({1: 1, 2: -1}, stiffness=stiffness, damping=damping, name="shaft")
        case = sprung(2, [shaft], {1: 0.05, 2: 9.5})
        with pytest.raises(CaseError, match="differ by so many powers of ten"):
            modes(case)


def test_loss_factors_in_one_proportion_are_those_of_every_mode() -> None:
    """D at omega_k is ``6 K/omega_k``, so each mode creeps with its ``-omega (3 -+ sqrt(8))``."""
    case = chain([1.0, 2.0, 0.5, 3.0], [40.0, 90.0, 250.0])
    springs = [one._replace(damping=Damping(loss_factor=6.0)) for one in case.springs]
    gear = only(case.replace(springs=springs))
    expected = [-mode.omega * (3 + sign * math.sqrt(8)) for mode in gear.modes for sign in (-1, 1)]
    assert gear.damped == pytest.approx(sorted(expected, reverse=True), rel=1e-11)
    assert [mode.damping_ratio for mode in gear.modes] == pytest.approx([3.0] * 3, rel=1e-11)


def test_what_creeps_alone_is_no_mode() -> None:
    """A spring of 10 with a damper of 1 behind it, beside a mount of 100: the mass still swings.

    ``J s^2 + c + c2 d s/(c2 + d s) = 0``: one real root, that of the damper, and two of the mass.
    """
    springs = [
        Spring({1: 1}, 100.0), Spring({1: 1, 2: -1}, 10.0), Spring({2: 1}, 1e-6, damping=1.0),
    ]  # fmt: skip
    gear = only(sprung(2, springs, {1: 1.0}))
    roots = np.roots([1.0, 10.0, 110.0, 1000.0])
    [swing] = [root for root in roots if root.imag > 0]
    assert len(gear.damped) == 2
    assert gear.modes[0].damped_frequency == pytest.approx(swing.imag / (2 * math.pi), rel=1e-6)
    assert gear.modes[0].damping_ratio == pytest.approx(-swing.real / abs(swing), rel=1e-6)


def damped_system(seed: int) -> Transmission:
    """Two to six links, some without inertia, with springs, damped springs and pure dampers."""
    rng = seeded(seed)
    links = rng.randint(2, 6)
    inertias = {n: 10 ** rng.uniform(-1, 1) for n in range(1, links + 1) if rng.random() < 0.7}
    springs = [Spring({1: 1.0, 2: -1.0}, stiffness=50.0, damping=0.3, name="first")]
    for number in range(1, rng.randint(links, 2 * links) + 1):
        first = number if number <= links else rng.randint(1, links)
        others = rng.sample(range(links + 1), rng.choice((1, 1, 1, 2)))
        twist = {link: rng.choice((-1.0, -0.5)) for link in others if link} | {first: 1.0}
        size = 10 ** rng.uniform(0, 2)
        if rng.random() < 0.4:
            springs.append(Spring(twist, damping=size, name=f"d{number}"))
            continue
        damping = rng.choice((0.0, size / 10))
        springs.append(Spring(twist, stiffness=100 * size, damping=damping, name=f"s{number}"))
    return sprung(links, springs, inertias or {1: 1.0})


@each_seed(90, 2000)
def test_eigenvalues_of_any_damped_system(seed: int) -> None:
    """Eigenvalues are those of the first-order form of twice the size, without zeros."""
    case = damped_system(seed)
    gear, wanted = only(case), eigenvalues(*matrices(case))
    size = np.abs(wanted).max()
    found, wanted = (one[np.abs(one) > 1e-5 * size] for one in (np.array(gear.damped), wanted))
    assert len(found) == len(wanted), (found, wanted)
    for one in wanted:
        assert np.abs(found - one).min() <= 1e-5 * max(abs(one), 1e-3 * size)
    assert sorted(np.abs(found)) == pytest.approx(list(np.abs(found)), rel=1e-8)
    for mode in gear.modes:
        assert (mode.damping_ratio >= 1) == (mode.damped_frequency == 0)


def test_a_damper_parallel_to_a_spring_does_not_resist_the_rigid_mode() -> None:
    """Two masses: ``s^2 + (d s + c) (1/J1 + 1/J2) = 0``, and two zeros, which are left out."""
    springs = [Spring({1: 1, 2: -1}, 4.9), Spring({1: 1, 2: -1}, damping=1.2)]
    inertias = {1: 0.4500682524721604, 2: 1.1236422485937854}  # the rounded basis is not rigid
    mobility = sum(1 / inertia for inertia in inertias.values())
    root = np.roots([1, 1.2 * mobility, 4.9 * mobility])[0]
    gear = only(sprung(2, springs, inertias))
    assert gear.damped == pytest.approx([complex(root.real, abs(root.imag))], rel=1e-12)


@pytest.mark.filterwarnings("error")
def test_massless_links_whose_dampings_differ_by_many_powers_of_ten() -> None:
    """One creeps alone, fast, behind a mass that hardly moves: ``s = -(c1 + c2)/d``."""
    dampings = {2: 1e-9, 3: 1e12}
    shafts = [Spring({1: 1, link: -1}, stiffness=1.0) for link in dampings]
    mounts = [Spring({link: 1}, 3.0, damping=damping) for link, damping in dampings.items()]
    case = sprung(3, [*shafts, *mounts], {1: 1e6})
    *_, fast = only(case).damped
    assert fast == pytest.approx(-4e9)


def test_a_loss_factor_at_a_massless_link_with_a_damper() -> None:
    """The rigid mode creeps by ``s^3 + d s^2 + 2 c s + c d = 0``, without the loss factor.

    Between a free mass and a link without inertia, the loss factor damps nothing.
    """
    lossy = Damping(loss_factor=0.1)
    springs = [Spring({1: 1, 2: -1}, 100.0, damping=lossy), Spring({2: 1, 3: -1}, 100.0)]
    springs.append(Spring({3: 1}, damping=0.1))
    gear = only(sprung(3, springs, {1: 1.0, 3: 1.0}))
    [creep] = [root.real for root in np.roots([1, 0.1, 100, 5]) if root.imag == 0]
    assert gear.damped[0] == pytest.approx(creep, rel=1e-9)
    assert len(gear.damped) == 2
    free = only(sprung(2, springs[:1], {1: 1.0}))
    assert (free.modes, free.damped) == ([], [])


@each_seed(20, 500)
def test_amplitudes_and_torques_of_a_response_are_those_of_the_dense_equations(seed: int) -> None:
    """NumPy solves (K - w^2 M + i w D) x = F; the torque of a spring is k + i w d times its twist."""
    case = damped_system(seed)
    mass, stiffness, resistance = matrices(case)
    speed = 300.0  # rpm, first order
    omega = speed * np.pi / 30
    dynamic = stiffness - omega**2 * mass + 1j * omega * resistance
    force = np.zeros(len(mass))
    force[0] = 1.0
    amplitudes = np.linalg.solve(dynamic, force)
    [made] = response(case, 1, [Harmonic(1.0)], [speed])
    [order] = made.orders
    found = [abs(complex(order.amplitudes[name][0])) for name in case.link_names]
    assert found == pytest.approx(np.abs(amplitudes).tolist(), rel=1e-8, abs=1e-14)
    for one in case.springs:
        twist = sum(part * amplitudes[link - 1] for link, part in one.form.items())
        assert isinstance(one.damping, Damping)
        factor = 1j * omega * one.damping.viscous + (0.0 if one.is_damper else one.rate)
        carried = abs(complex(order.torques[one.name][0]))
        assert carried == pytest.approx(abs(factor * twist), rel=1e-8, abs=1e-12)


def test_a_damper_alone_takes_energy_whichever_way_it_is_twisted() -> None:
    """Each of three masses moves in both modes, so both have a bound at their speeds."""
    bare = chain([1.0, 0.5, 2.0], [100.0, 300.0])
    for link, sign in product((1, 2, 3), (1, -1)):
        brake = Spring({link: sign}, damping=0.5, name="brake")
        case = bare.replace(springs=[*bare.springs, brake])
        [gear] = response(case, 1, [Harmonic(1.0)], np.linspace(10.0, 500.0, 5))
        assert [one.damped for one in gear.resonances] == [True, True]
        assert all(np.isfinite(one).all() for one in gear.orders[0].amplitudes.values())


def with_losses(number: int, most: float) -> Transmission:
    """A random chain with some mounts, damped by numbers, loss factors up to the most, or not."""
    rng = seeded(number)
    links = rng.randint(2, 16)
    twists = [{n: 1.0, n + 1: -1.0} for n in range(1, links)]
    twists += [{rng.randint(1, links): 1.0} for _ in range(rng.randint(0, 2))]
    springs = []
    for place, twist in enumerate(twists):
        kinds: list[Damping | float] = [0.0, 10 ** rng.uniform(-3, 1)]
        kinds += [Damping(loss_factor=rng.uniform(0, most))] * 2
        damping = kinds[rng.randint(0, 3)] if place else kinds[2]
        stiffness = 10 ** rng.uniform(1, 5)
        springs.append(Spring(twist, stiffness=stiffness, damping=damping, name=f"s{place}"))
    inertias = {n: 10 ** rng.uniform(-2, 1) for n in range(1, links + 1)}
    return sprung(links, springs, inertias)


def eigenvalues_of_mode(case: Transmission, omega: float, shape: Array) -> tuple[Array, Array]:
    """All eigenvalues with the D of a frequency, and their parts in a mode: of the state matrix."""
    mass, stiffness, resistance = matrices(case)
    for spring in case.springs:
        assert isinstance(spring.damping, Damping)
        row = np.array([spring.form.get(n, 0.0) for n in range(1, case.links + 1)])
        lost = spring.damping.loss_factor * spring.rate / omega
        resistance = resistance + lost * np.outer(row, row)
    below = [-linalg.solve(mass, stiffness), -linalg.solve(mass, resistance)]
    state = np.block([[np.zeros(mass.shape), np.eye(len(mass))], below])
    values, vectors = linalg.eig(state)
    shapes = vectors[: len(mass)]
    lengths = np.sqrt(np.einsum("ij,ik,kj->j", shapes.conj(), mass, shapes).real)
    return values, np.abs(shape @ mass @ shapes) / lengths / math.sqrt(shape @ mass @ shape)


@pytest.mark.slow
@each_seed(50, 150)
@pytest.mark.parametrize("most", [0.1, 0.5, 2.0])
def test_loss_factors_of_any_chain(seed: int, most: float) -> None:
    """Each mode has the eigenvalue nearest to it with the damping ``c loss_factor/omega``."""
    case = with_losses(seed, most)
    for mode in only(case).modes:
        shape = np.array([*mode.shape.values()])
        values, parts = eigenvalues_of_mode(case, mode.omega, shape)
        upper = values.imag >= 0
        values, parts = values[upper], parts[upper]
        order = np.argsort(-parts)
        value = values[order[0]]
        if abs(value.imag) < 1e-6 * abs(value) or parts[order[1]] > 0.8 * parts[order[0]]:
            continue  # it creeps, or several are as near
        assert mode.damping_ratio == pytest.approx(-value.real / abs(value), rel=1e-6, abs=1e-9)
        assert mode.damped_frequency == pytest.approx(value.imag / (2 * math.pi), rel=1e-8)


def test_eigenvalues_are_in_the_order_of_their_moduli_then_of_their_imaginary_parts() -> None:
    """Below 1 rad/s, too."""
    values = np.array([0.2j, -0.5j, 0.1j, -0.3 + 0.4j, -0.3 - 0.4j, 3.0, -2.0])
    assert order_of(values).tolist() == [2, 0, 1, 4, 3, 6, 5]


@pytest.mark.parametrize("damping", [1e6, 30.0, 20.0, 12.0, -1e6])
def test_the_roots_of_a_shape_are_those_of_its_quadratic_equation(damping: float) -> None:
    """s1 s2 = 100, s1 + s2 = -d: (s + d/2)^2 = d^2/4 - 100, to the last digits of both."""
    one = Pencils(np.array([1.0]), np.array([[100.0]]), np.array([[[damping]]]))
    smaller, larger = (complex(root[0]) for root in one.roots(np.array([[1.0 + 0j]])))
    assert smaller * larger == pytest.approx(100, rel=1e-14)
    assert smaller + larger == pytest.approx(-damping, rel=1e-14)
    assert abs(smaller) <= abs(larger) * (1 + 1e-15)
