"""Dampers without a stiffness in damped vibration and response, by dense matrices."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import linalg

from tests.chance import count, seeded
from tests.torsion.systems import Array
from vstatics.core.model.parts import damping
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Transmission
from vstatics.torsion import Harmonic, modes, response


def random_case(seed: int) -> tuple[Transmission, Array, Array, Array]:
    """Three to six inertias with springs and dampers alone between any two, or to the housing."""
    rng = seeded(seed)
    links = rng.randint(3, 6)
    masses = [10 ** rng.uniform(-1, 1) for _ in range(links)]
    springs, stiffness, resistance = [], np.zeros((links, links)), np.zeros((links, links))
    for number in range(rng.randint(2, 2 * links)):
        first, second = rng.sample(range(links + 1), 2)
        twist = {link: part for link, part in ((first, 1.0), (second, -1.0)) if link}
        size = 10 ** rng.uniform(0, 2)
        row = np.array([twist.get(n, 0.0) for n in range(1, links + 1)])
        if number and rng.random() < 0.5:
            springs.append(Spring(twist, stiffness=100 * size, name=f"s{number}"))
            stiffness += 100 * size * np.outer(row, row)
        else:
            springs.append(Spring(twist, damping=size, name=f"d{number}"))
            resistance += size * np.outer(row, row)
    inertias = dict(enumerate(masses, 1))
    case = Transmission(links, [], [], [], inertias=inertias, springs=springs)
    return case, np.diag(masses), stiffness, resistance


@pytest.mark.parametrize("seed", range(count(40, 1000)))
def test_eigenvalues_are_those_of_the_dense_pencil(seed: int) -> None:
    """Zeros are left out: the program tells rigid motions apart."""
    case, mass, stiffness, resistance = random_case(seed)
    identity = np.eye(len(mass))
    companion = np.block([[0 * mass, identity], [-stiffness, -resistance]])
    wanted = linalg.eigvals(companion, linalg.block_diag(identity, mass))
    size = np.abs(wanted).max()
    wanted = wanted[(np.abs(wanted) > 1e-5 * size) & (wanted.imag >= -1e-6 * size)]
    [found] = modes(case)
    values = np.array([one for one in found.damped if abs(one) > 1e-5 * size])
    assert len(values) == len(wanted), (values, wanted)
    for one in wanted:
        assert np.abs(values - one).min() <= 1e-5 * max(abs(one), 1e-3 * size)


@pytest.mark.parametrize("seed", range(count(20, 500)))
def test_amplitudes_and_torques_of_a_response_are_those_of_the_dense_equations(seed: int) -> None:
    """(K - w^2 M + i w D) x = F, by NumPy; the torque of a damper is i w d times its twist."""
    case, mass, stiffness, resistance = random_case(seed)
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
        factor = 1j * omega * damping(one.damping).viscous if one.is_damper else one.rate
        carried = abs(complex(order.torques[one.name][0]))
        assert carried == pytest.approx(abs(factor * twist), rel=1e-8, abs=1e-12)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("link", [1, 2, 3])
def test_a_damper_alone_takes_energy_whichever_way_it_is_twisted(sign: int, link: int) -> None:
    """Each of three masses moves in both modes, so both have a bound at their speeds."""
    springs = [
        Spring({1: 1, 2: -1}, stiffness=100.0),
        Spring({2: 1, 3: -1}, stiffness=300.0),
        Spring({link: sign}, damping=0.5, name="brake"),
    ]
    case = Transmission(3, [], [], [], inertias={1: 1.0, 2: 0.5, 3: 2.0}, springs=springs)
    [gear] = response(case, 1, [Harmonic(1.0)], np.linspace(10.0, 500.0, 5))
    assert [one.damped for one in gear.resonances] == [True, True]
    assert all(np.isfinite(one).all() for one in gear.orders[0].amplitudes.values())
