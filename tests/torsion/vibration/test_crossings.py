"""Where frequencies cross in a sweep each mode keeps the number of the first variant."""

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.installed import needs
from tests.torsion.systems import Array, chain, sprung, wheels
from tests.torsion.vibration.test_gear_modes import omegas, only
from tests.torsion.vibration.test_variants import system_of
from vstatics import Transmission
from vstatics.torsion.vibration.variants import variant_frequencies


def test_wheels_in_antiphase_keep_their_number() -> None:
    """A propshaft that gets stiffer takes the lowest frequency through theirs."""
    stiffness = np.array([70.0, 1.0, 1000.0, 300.0])
    found = variant_frequencies(
        system_of(wheels(70.0)), [0, 1], stiffnesses={0: stiffness}, inertias={}, variants=4
    )
    np.testing.assert_allclose(found[:, 1], 5.0, rtol=1e-12)
    for row, c in zip(found, stiffness, strict=True):
        lowest = next(one for one in omegas(only(wheels(c))) if abs(one - 5) > 1e-9)
        assert row[0] == pytest.approx(lowest, rel=1e-12)
    assert found[0, 0] < 5 < found[2, 0]


@needs("sweep")
def test_a_sweep_takes_the_numbers_of_its_first_variant_in_every_piece() -> None:
    """Of 3000 stiffnesses, more than a block of them has."""
    from vstatics import sweep

    [made] = sweep(wheels(70.0), {"propshaft.stiffness": (1, 2000, 3000)}, out="omega[1], omega[2]")
    first, second = made.columns.T
    np.testing.assert_allclose(second, 5.0, rtol=1e-12)
    assert (np.diff(first) > 0).all()
    assert first[0] < 5 < first[-1]


def side_by_side(one: Transmission, other: Transmission) -> Transmission:
    springs = [*one.springs]
    for spring in other.springs:
        twist = {link + one.links: part for link, part in spring.form.items()}
        springs.append(spring._replace(twist=twist, name=f"other {spring.name}"))
    inertias = {**one.inertias, **{link + one.links: j for link, j in other.inertias.items()}}
    links = one.links + other.links
    return sprung(links, springs, inertias)


def random_chain(number: int) -> tuple[list[float], list[float]]:
    rng = seeded(number)
    links = rng.randint(2, 5)
    inertias = [10 ** rng.uniform(-1, 1) for _ in range(links)]
    return inertias, [10 ** rng.uniform(1, 4) for _ in range(links - 1)]


def alone(inertias: list[float], stiffnesses: list[float]) -> list[float]:
    return omegas(only(chain(inertias, stiffnesses)))


@pytest.mark.slow
@each_seed(40, 100)
def test_modes_of_two_trains_stay_with_their_train(seed: int) -> None:
    """A stiffness and an inertia of the first vary; each variant is that of the trains alone."""
    (masses, shafts), (others, soft) = random_chain(2 * seed), random_chain(2 * seed + 1)
    rng = seeded(seed)
    stiffness = np.array([shafts[0], *(10 ** rng.uniform(0, 5) for _ in range(6))])
    inertia = np.array([masses[1], *(10 ** rng.uniform(-2, 2) for _ in range(6))])
    both = side_by_side(chain(masses, shafts), chain(others, soft))
    still = alone(others, soft)

    def by_train(c: float, j: float) -> Array:
        return np.array([*alone([masses[0], j, *masses[2:]], [c, *shafts[1:]]), *still])

    order = np.argsort(by_train(stiffness[0], inertia[0]))
    for heavy, light in ((inertia, stiffness), (np.full(7, masses[1]), stiffness)):
        varied = {1: heavy} if heavy is inertia else {}
        found = variant_frequencies(
            system_of(both), range(len(order)), stiffnesses={0: light}, inertias=varied, variants=7
        )
        expected = [by_train(c, j)[order] for c, j in zip(light, heavy, strict=True)]
        np.testing.assert_allclose(found, expected, rtol=1e-8)
