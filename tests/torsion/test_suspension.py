"""Suspensions in their own units: masses that move straight beside links that turn."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.chance import count, generator
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


@pytest.mark.parametrize(
    ("axle", "expected"),
    [(GAZ_53A, [11.651, 59.723]), (ZIL_130, [11.487, 57.296])],
    ids=["GAZ-53A", "ZIL-130"],
)
def test_a_front_axle_swings_as_its_two_masses_do(
    axle: dict[str, float], expected: list[float]
) -> None:
    """By hand: ``det(c - omega^2 m) = 0``; (4.10) is within half a percent of it."""
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


@pytest.mark.parametrize(
    ("gas", "at", "expected"),
    [
        ((6620, 38, 208.9, 11, 17, 77, 16), 0, 8037),
        ((6620, 38, 208.9, 11, 17, 77, 16), 4.2, 5270),
        ((9642, 53, 208.9, 10, 19, 77, 25), 0, 11660),
        ((9642, 53, 208.9, 10, 19, 77, 25), 12.5, 4527),
    ],
    ids=["540A front", "540A front unladen", "548A rear", "548A rear unladen"],
)
def test_struts_are_as_stiff_as_table_4_2_has_them(
    gas: tuple[float, ...], at: float, expected: float
) -> None:
    """Slope of (4.16) in N/cm by hand; printed are 8150, 5400, 11680, 4550."""
    load, p, area, length, q, counter, other = gas
    keys = {"load": load, "p": p, "area": area, "l": length, "q": q, "counter": counter, "m": other}
    [omega] = omegas(readers.loads(STRUT.format(**keys, at=at)))
    assert omega**2 * load / 100 == pytest.approx(expected, abs=0.5)


def test_a_counter_chamber_without_pressure_pushes_nothing() -> None:
    """By hand c = n p A/l of one chamber."""
    case = readers.loads(
        STRUT.format(load=6620, p=38, area=208.9, l=11, q=0, counter=77, m=16, at=0)
    )
    [omega] = omegas(case)
    assert omega**2 * 6620 == pytest.approx(1.02 * 38 * 98066.5 * 208.9e-4 / 0.11, rel=1e-12)
    assert readers.loads(write_yaml(case)) == case


def test_a_body_bounces_and_pitches() -> None:
    """(4.1) with m = 4000, rho^2 = 1.4, l = 1.2 and 1.8, c = 180 and 240 kN/m: two by two."""
    case = readers.loads(
        """
        masses: {body: 4 t}
        inertias: {pitch: 4000*1.4}
        springs:
          front: {twist: {body: 1, pitch: 1.2}, stiffness: 180 kN/m}
          rear: {twist: {body: 1, pitch: -1.8}, stiffness: 240 kN/m}
        """
    )
    straight = (180e3 + 240e3) / 4000
    turning = (180e3 * 1.2**2 + 240e3 * 1.8**2) / (4000 * 1.4)
    between = (180e3 * 1.2 - 240e3 * 1.8) ** 2 / (4000**2 * 1.4)
    half, root = (straight + turning) / 2, math.hypot((straight - turning) / 2, math.sqrt(between))
    assert omegas(case) == pytest.approx([math.sqrt(half - root), math.sqrt(half + root)])
    [gear] = modes(case)
    for mode in gear.modes:
        assert max(mode.shape.values(), key=abs) == pytest.approx(1)


STARTING = """
masses: {{x: {m}, z: {m}}}
inertias: {{T: .9, p: 2, pitch: {J}, K: 12}}
springs:
  Y1: {{twist: {{z: 1, pitch: 1.6}}, compliance: 6e-6}}
  Y2: {{twist: {{z: 1, pitch: -1.9}}, compliance: 4e-6}}
  YT: {{twist: {{T: 1, p: -1, K: -1}}, stiffness: 9e3}}
  Yp: {{twist: {{p: 1, pitch: -1}}, stiffness: 5e4}}
  YK: {{twist: {{K: 1, x: -1/.48, pitch: -{h}/.48}}, stiffness: 4e4}}
"""
"""(5.3), the clutch engaged."""


def test_a_start_with_pitch_turns_as_it_moves_straight() -> None:
    """(5.4): ``phi_z = z/L`` (printed z L), ``phi_A = x/r``, ``E = e/l^2`` of the same body."""
    mass, inertia, height, r, length = 5200.0, 9100.0, 0.9, 0.48, 3.5
    ways = {"x": r, "z": length}
    straight = readers.loads(STARTING.format(m=mass, J=inertia, h=height))
    names = straight.link_names
    turning = straight.replace(
        masses={},
        inertias={
            **straight.inertias,
            **{names.index(link) + 1: mass * way**2 for link, way in ways.items()},
        },
        springs=[
            spring._replace(
                twist={
                    link: part * ways.get(names[link - 1], 1) for link, part in spring.form.items()
                }
            )
            for spring in straight.springs
        ],
    )
    assert omegas(turning) == pytest.approx(omegas(straight), rel=1e-9)


def joint_vibration() -> tuple[Transmission, Floats, Floats]:
    """The case (5.2), M and K by hand: body, axles up and along, wheels in two parts, engine, axle casing."""
    l1, l2, h1, h2, r = 1.5, 2.1, 0.8, 0.7, 0.46
    names = ["pitch", "z1", "z2", "z3", "x1", "x2", "x3"]
    names += ["K11", "K12", "K21", "K22", "engine", "casing"]
    mass = np.diag([7e3, 5e3, 400, 800, 5e3, 400, 800, 3, 9, 5, 14, 2, 6.0])
    forms: list[tuple[float, dict[str, float]]] = [
        (2e5, {"z1": 1, "pitch": l1, "z2": -1}),
        (3e5, {"z1": 1, "pitch": -l2, "z3": -1}),
        (4e6, {"x1": 1, "pitch": h1, "x2": -1}),
        (5e6, {"x1": 1, "pitch": h2, "x3": -1}),
        (8e4, {"casing": 1, "pitch": -1}),
        (9e5, {"z2": 1}),
        (1.6e6, {"z3": 1}),
        (7e5, {"x2": 1, "K12": -r}),
        (9e5, {"x3": 1, "K22": -r}),
        (3e4, {"K11": 1, "K12": -1}),
        (5e4, {"K21": 1, "K22": -1}),
        (9e3, {"engine": 1, "casing": -1, "K21": -1}),
    ]
    stiffness = np.zeros_like(mass)
    springs = []
    for rate, form in forms:
        row = np.array([form.get(name, 0.0) for name in names])
        stiffness += rate * np.outer(row, row)
        springs.append(Spring({names.index(name) + 1: one for name, one in form.items()}, rate))
    turning, moving = (
        {n: mass[n - 1, n - 1] for n in range(1, len(names) + 1) if (n in range(2, 8)) == straight}
        for straight in (False, True)
    )
    case = Transmission(len(names), [], [], [], springs=springs, inertias=turning, masses=moving)
    return case, mass, stiffness


def test_transmission_and_suspension_vibrate_together() -> None:
    """(5.2), its linear part, against the eigenvalues of its matrices; one motion is rigid."""
    case, mass, stiffness = joint_vibration()
    squares = eigh(stiffness, mass, eigvals_only=True)
    assert omegas(case) == pytest.approx(np.sqrt(squares[1:]), rel=1e-7)


def case_of(mass: Floats, stiffness: Floats, straight: range) -> Transmission:
    """A case with these matrices: a spring for each eigenvector that has a stiffness."""
    rates, forms = np.linalg.eigh(stiffness)
    springs = [
        Spring({n + 1: part for n, part in enumerate(form) if part}, rate)
        for rate, form in zip(rates, forms.T, strict=True)
        if rate > 1e-9 * rates[-1]
    ]
    heavy = dict(enumerate(np.diag(mass), 1))
    return Transmission(
        len(mass),
        [],
        [],
        [],
        springs=springs,
        inertias={link: one for link, one in heavy.items() if link not in straight},
        masses={link: one for link, one in heavy.items() if link in straight},
    )


@pytest.mark.parametrize("seed", range(count(10, 200)))
def test_any_forms_vibrate_by_their_matrices(seed: int) -> None:
    random = generator(29, seed)
    size = int(random.integers(2, 8))
    mass = np.diag(random.uniform(0.1, 10, size))
    root = random.normal(size=(size, size))
    stiffness = root @ root.T
    case = case_of(mass, stiffness, range(1, int(random.integers(1, size + 1)) + 1))
    assert omegas(case) == pytest.approx(
        np.sqrt(eigh(stiffness, mass, eigvals_only=True)), rel=1e-6
    )


def test_orders_belong_to_what_turns() -> None:
    case = readers.loads(AXLE.format(**GAZ_53A))
    with pytest.raises(CaseError, match="link body moves straight, so it has no revolutions"):
        response(case, "body", [Harmonic(1.0)], [100.0])


def test_tables_tell_both_units() -> None:
    case = readers.loads(AXLE.format(**GAZ_53A))
    titles = [grid.title for grid in in_both_units(case, modes_grids(modes(case)))]
    assert "Gear 1: torques of components at these amplitudes [N*m/rad; straight N/m]" in titles


def test_what_moves_straight_is_written_as_it_is_read() -> None:
    """Each key of a suspension survives YAML; so does a limit that follows another spring."""
    text = STRUT.format(load=6620, p=38, area=208.9, l=11, q=17, counter=77, m=16, at=4.2)
    text += "  tyre: {links: [body], stiffness: 3 kN/m, limit: {base: 20 N, of: strut, times: .3}}"
    case = readers.loads(text)
    assert readers.loads(write_yaml(case)) == case
    assert case.springs[1].limit == SpringLimit(20.0, "strut", 0.3)
