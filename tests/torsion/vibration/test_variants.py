"""Frequencies of many variants at once: each as if it were calculated alone."""

import math
from collections.abc import Mapping

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.torsion.systems import Array, branched, chain, sprung
from vstatics import Spring, Transmission
from vstatics.core.numerics.motions import free_motions
from vstatics.torsion.system.coordinates import coordinates
from vstatics.torsion.system.gear_system import TorsionalSystem, torsional_system
from vstatics.torsion.vibration.natural import natural_modes
from vstatics.torsion.vibration.other_ratios import followed_motions
from vstatics.torsion.vibration.variants import variant_frequencies

VARIANTS = 4


def system_of(case: Transmission, gear: int = 0) -> TorsionalSystem:
    return torsional_system(case, case.gears[gear])


def frequencies(
    system: TorsionalSystem,
    stiffnesses: Mapping[int, Array] | None = None,
    inertias: Mapping[int, Array] | None = None,
) -> Array:
    """All that there may be, of shape (variants, links)."""
    given = [*(stiffnesses or {}).values(), *(inertias or {}).values()]
    return variant_frequencies(
        system, range(len(system.names)), stiffnesses=stiffnesses or {}, inertias=inertias or {},
        variants=len(given[0]),
    )  # fmt: skip


def alone(
    system: TorsionalSystem, stiffnesses: Mapping[int, Array], inertias: Mapping[int, Array]
) -> Array:
    rows = []
    for variant in range(VARIANTS):
        devices, bodies = list(system.devices), list(system.bodies)
        places = [place for place, one in enumerate(devices) if one.stiffness is not None]
        for device, numbers in stiffnesses.items():
            place = places[device]
            devices[place] = devices[place]._replace(stiffness=float(numbers[variant]))
        for body, numbers in inertias.items():
            bodies[body] = bodies[body]._replace(inertia=float(numbers[variant]))
        one = system._replace(devices=tuple(devices), bodies=tuple(bodies))
        omegas = natural_modes(one, coordinates(one)).omegas
        rows.append(np.pad(omegas, (0, len(system.names) - len(omegas)), constant_values=np.nan))
    return np.array(rows)


def numbers(low: float, high: float) -> st.SearchStrategy[Array]:
    size = st.floats(math.log10(low), math.log10(high)).map(lambda power: 10.0**power)
    return st.lists(size, min_size=VARIANTS, max_size=VARIANTS).map(np.array)


@settings(max_examples=count(8, 60))
@given(branched(), st.data())
def test_any_stiffnesses_and_inertias(case: Transmission, data: st.DataObject) -> None:
    """A link may lose its inertia in some variants, and a stiffness go over eight decades."""
    kept = [link for link in case.inertias if data.draw(st.integers(0, 3)) or link < 2]
    system = system_of(case.replace(inertias={link: case.inertias[link] for link in kept}))
    stiff_at, heavy_at = (st.integers(0, n - 1) for n in (len(system.elastic), case.links))
    stiff = data.draw(st.dictionaries(stiff_at, numbers(1e-4, 1e4), max_size=2))
    some = st.lists(st.booleans(), min_size=VARIANTS, max_size=VARIANTS).map(np.array)
    sizes = st.builds(np.multiply, numbers(0.01, 10), some)
    heavy = data.draw(st.dictionaries(heavy_at, sizes, max_size=2))
    if stiff or heavy:
        expected = alone(system, stiff, heavy)
        np.testing.assert_allclose(frequencies(system, stiff, heavy), expected, rtol=1e-9)


def test_a_shaft_that_ends_without_inertia_carries_no_torque() -> None:
    system = system_of(chain([0.2, 0.8, 0.0], [500.0, 300.0]))
    found = frequencies(system, {1: np.array([1.0, 1e3, 1e9])})
    np.testing.assert_allclose(found[:, 0], math.sqrt(500 * (1 / 0.2 + 1 / 0.8)), rtol=1e-13)
    assert np.isnan(found[:, 1:]).all()


def test_a_soft_support_keeps_its_digits_beside_stiff_shafts() -> None:
    """A body of 1 + 1 on a support: ``omega^2 = c/2``, twelve decades below the shaft."""
    twists = {1: 1, 2: -1}, {2: 1}
    springs = [Spring(twist, stiffness=c) for twist, c in zip(twists, (1e9, 1.0), strict=True)]
    system = system_of(sprung(2, springs, {1: 1.0, 2: 1.0}))
    stiffness = np.array([1e-3, 1e-2, 1e-1])
    found = frequencies(system, {1: stiffness})
    np.testing.assert_allclose(found[:, 0], np.sqrt(stiffness / 2), rtol=1e-9)
    np.testing.assert_allclose(found[:, 1], math.sqrt(2e9), rtol=1e-9)


def test_more_variants_than_are_solved_at_once() -> None:
    """Four masses on a row of shafts, all of the same stiffness: frequencies go by its root."""
    system = system_of(chain([1.0] * 4, [1.0] * 3))
    stiffness = np.linspace(1, 100, 20_000)
    found = frequencies(system, dict.fromkeys(range(3), stiffness))
    expected = 2 * np.outer(np.sqrt(stiffness), [math.sin(k * math.pi / 8) for k in (1, 2, 3)])
    np.testing.assert_allclose(found[:, :3], expected, rtol=1e-12)


def test_many_links_are_solved_one_by_one() -> None:
    """A shaft of 400 equal masses, ``omega_k = 2 sqrt(c/J) sin(k pi/800)``; all inertias vary."""
    system = system_of(chain([1.0] * 400, [1.0] * 399))
    heavy = dict.fromkeys(range(400), np.array([1.0, 4.0]))
    found = variant_frequencies(system, [0, 2], stiffnesses={}, inertias=heavy, variants=2)
    expected = [[2 / j * math.sin(k * math.pi / 800) for k in (1, 3)] for j in (1, 2)]
    np.testing.assert_allclose(found, expected, rtol=1e-9)


WHOLE = st.integers(-3, 3).map(float)


@st.composite
def small_equations(draw: st.DrawFn) -> Array:
    shape = draw(st.integers(1, 4)), draw(st.integers(0, 4)), draw(st.integers(1, 5))
    count = shape[0] * shape[1] * shape[2]
    numbers = draw(st.lists(WHOLE, min_size=count, max_size=count))
    return np.array(numbers).reshape(shape)


@settings(max_examples=count(80, 600))
@given(small_equations())
def test_a_variant_is_safe_if_its_rank_is_that_of_the_first(equations: Array) -> None:
    unknowns = equations.shape[2]
    counts = [
        free_motions([dict(enumerate(row)) for row in one], unknowns).shape[1] for one in equations
    ]
    found = followed_motions(equations, counts[0])
    assert found.safe[0]
    for one, motions, safe, rank in zip(equations, found.motions, found.safe, counts, strict=True):
        if safe:
            assert rank == counts[0]
            np.testing.assert_allclose(one @ motions, 0, atol=1e-9)
            np.testing.assert_array_equal(motions[found.free], np.eye(rank))
    assert sorted([*found.free, *found.others]) == list(range(unknowns))


def test_equations_that_vanish_or_are_missing_leave_unknowns_free() -> None:
    """``u - 1`` for u = 2, 1 + 1e-15 and 1: then nothing is said of the second unknown."""
    equations = np.array([[[0.0, 1.0]], [[0.0, 1e-15]], [[0.0, 0.0]]])
    assert followed_motions(equations, 1).safe.tolist() == [True, False, False]
    found = followed_motions(np.zeros((2, 0, 3)), 3)
    np.testing.assert_array_equal(found.motions, [np.eye(3)] * 2)
    assert found.safe.all()
