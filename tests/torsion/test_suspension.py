"""Suspensions in their own units: masses that move straight beside links that turn."""

import math

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.chance import each_seed, generator
from vstatics.core import readers
from vstatics.core.errors import CaseError
from vstatics.core.model.springs import Spring, SpringLimit
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.straight import in_both_units
from vstatics.core.writers.named import write_yaml
from vstatics.torsion.forced.harmonic_torques import Harmonic, response
from vstatics.torsion.vibration.gear_modes import modes
from vstatics.torsion.vibration.tables import modes_grids

AXLE = """
masses: {{body: {body} kg, axle: {axle}}}
springs:
  leaves: {{links: [body, axle], stiffness: {leaves} N/mm}}
  tyres: {{links: [axle], stiffness: {tyres} N/mm}}
"""
GAZ_53A = {"body": 1480 - 340, "axle": 340, "leaves": 184, "tyres": 1020}
ZIL_130 = {"body": 2100 - 475, "axle": 475, "leaves": 260, "tyres": 1286}
"""Tsitovich, Algin, table 4.1, front; the labels of the springs and the tyres are exchanged."""


def omegas(case: Transmission) -> list[float]:
    [gear] = modes(case)
    return [mode.omega for mode in gear.modes]


def test_a_front_axle_swings_as_its_two_masses_do() -> None:
    """By hand: ``det(c - omega^2 m) = 0``; (4.10) is within half a percent of it."""
    for axle, expected in ((GAZ_53A, [11.651, 59.723]), (ZIL_130, [11.487, 57.296])):
        found = omegas(readers.loads(AXLE.format(**axle)))
        assert found == pytest.approx(expected, abs=6e-4)
        leaves, tyres = axle["leaves"] * 1e3, axle["tyres"] * 1e3
        body = math.sqrt(leaves * tyres / (leaves + tyres) / axle["body"])
        assert found == pytest.approx([body, math.sqrt((leaves + tyres) / axle["axle"])], rel=5e-3)


STRUT = """
masses: {{body: {load} kg}}
springs:
  strut:
    links: [body]
    strut: {{pressure: {p} at, area: {area} cm^2, length: {l} cm, exponent: 1.02, at: {at} cm,
      counter_pressure: {q} at, counter_area: {counter} cm^2, counter_length: {m} cm}}
"""


BELAZ_540A = {"load": 6620, "p": 38, "area": 208.9, "l": 11, "q": 17, "counter": 77, "m": 16}
BELAZ_548A = {"load": 9642, "p": 53, "area": 208.9, "l": 10, "q": 19, "counter": 77, "m": 25}
"""Front and rear."""


def test_struts_are_as_stiff_as_table_4_2_has_them() -> None:
    """Slope of (4.16) in N/cm by hand, laden and not; printed are 8150, 5400, 11680, 4550."""
    for gas, at, expected in (
        *((BELAZ_540A, 0, 8037), (BELAZ_540A, 4.2, 5270)),
        *((BELAZ_548A, 0, 11660), (BELAZ_548A, 12.5, 4527)),
    ):
        [omega] = omegas(readers.loads(STRUT.format(**gas, at=at)))
        assert omega**2 * gas["load"] / 100 == pytest.approx(expected, abs=0.5)


def test_a_counter_chamber_without_pressure_pushes_nothing() -> None:
    """By hand c = n p A/l of one chamber."""
    case = readers.loads(STRUT.format(**{**BELAZ_540A, "q": 0}, at=0))
    [omega] = omegas(case)
    assert omega**2 * 6620 == pytest.approx(1.02 * 38 * 98066.5 * 208.9e-4 / 0.11, rel=1e-12)
    assert readers.loads(write_yaml(case)) == case


def case_of(mass: Floats, stiffness: Floats, straight: range) -> Transmission:
    """A case with these matrices: a spring for each eigenvector that has a stiffness."""
    rates, forms = np.linalg.eigh(stiffness)
    springs = [
        Spring({n + 1: part for n, part in enumerate(form) if part}, rate)
        for rate, form in zip(rates, forms.T, strict=True)
        if rate > 1e-9 * rates[-1]
    ]
    heavy = dict(enumerate(np.diag(mass), 1))
    turning, moving = (
        {link: one for link, one in heavy.items() if (link in straight) == is_straight}
        for is_straight in (False, True)
    )
    return Transmission(len(mass), [], [], [], springs=springs, inertias=turning, masses=moving)


@each_seed(10, 200)
def test_any_forms_vibrate_by_their_matrices(seed: int) -> None:
    """Masses that move straight beside links that turn, as in (4.1), (5.2) and (5.3)."""
    random = generator(29, seed)
    size = int(random.integers(2, 8))
    mass = np.diag(random.uniform(0.1, 10, size))
    root = random.normal(size=(size, size))
    stiffness = root @ root.T
    case = case_of(mass, stiffness, range(1, int(random.integers(1, size + 1)) + 1))
    expected = np.sqrt(eigh(stiffness, mass, eigvals_only=True))
    assert omegas(case) == pytest.approx(expected, rel=1e-6)
    for mode in modes(case)[0].modes:
        assert max(mode.shape.values(), key=abs) == pytest.approx(1)


def test_orders_belong_to_what_turns_and_tables_tell_both_units() -> None:
    case = readers.loads(AXLE.format(**GAZ_53A))
    with pytest.raises(CaseError, match="link body moves straight, so it has no revolutions"):
        response(case, "body", [Harmonic(1.0)], [100.0])
    titles = [grid.title for grid in in_both_units(case, modes_grids(modes(case)))]
    assert "Gear 1: torques of components at these amplitudes [N*m/rad; straight N/m]" in titles


def test_what_moves_straight_is_written_as_it_is_read() -> None:
    text = STRUT.format(**BELAZ_540A, at=4.2)
    text += "  tyre: {links: [body], stiffness: 3 kN/m, limit: {base: 20 N, of: strut, times: .3}}"
    case = readers.loads(text)
    assert readers.loads(write_yaml(case)) == case
    assert case.springs[1].limit == SpringLimit(20.0, "strut", 0.3)
