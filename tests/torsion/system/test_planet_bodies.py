"""Planets as bodies: with their exact share the same vibration as with planets as links."""

import numpy as np
import pytest
from scipy import linalg

from tests.torsion.vibration.test_gear_modes import omegas
from vstatics import loads
from vstatics.torsion.vibration.gear_modes import modes

DRIVELINE = """
links: [engine, sun, ring, carrier, vehicle]
output: vehicle
inertias: {engine: 0.2, sun: 0.001, ring: 0.05, vehicle: 4}
elements:
  P: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 75},
      planets: 3, planet: {inertia: 2e-3, mass: 0.6, radius: 0.08}}
shift_elements: {B: {links: [ring, housing], stiffness: 9e4}}
springs:
  in: {links: [engine, sun], stiffness: 900}
  out: {links: [carrier, vehicle], stiffness: 2500}
gears: {low: [B]}
"""
MESHES = """mechanisms:
  inner: {first: sun, second: planet, third: carrier, ratio: -22.5/30}
  outer: {first: ring, second: planet, third: carrier, ratio: 22.5/75}
"""
SET = DRIVELINE[DRIVELINE.index("elements:") : DRIVELINE.index("shift_elements:")]
BY_HAND = (
    DRIVELINE.replace(SET, MESHES)
    .replace("ring, carrier, vehicle]", "ring, carrier, vehicle, planet]")
    .replace("vehicle: 4", "vehicle: 4, planet: 3*2e-3, carrier: 3*0.6*0.0064")
)
"""The planets as a link of their own: a mechanism for each mesh (30, 22.5, 75 teeth)."""


def test_planets_vibrate_as_links_of_their_own_would() -> None:
    [own], [hand] = modes(loads(DRIVELINE)), modes(loads(BY_HAND))
    assert omegas(own) == pytest.approx(omegas(hand), rel=1e-12)
    for one, other in zip(own.modes, hand.modes, strict=True):
        share = other.kinetic["planet"] + other.kinetic["carrier"]
        assert one.kinetic["P.planet"] == pytest.approx(share, abs=1e-12)
        assert min(one.kinetic.values()) >= 0
        assert sum(one.kinetic.values()) == pytest.approx(1)
        assert one.elastic == pytest.approx(other.elastic)


def test_at_the_meshes_planets_are_links_anyway() -> None:
    [own] = modes(loads(DRIVELINE))
    [meshes] = modes(loads("losses: meshes" + DRIVELINE))
    for one, other in zip(meshes.modes, own.modes, strict=True):
        assert one.torques == pytest.approx(other.torques, rel=1e-9)
    assert omegas(meshes) == pytest.approx(omegas(own), rel=1e-12)
    [hand] = modes(loads(BY_HAND))
    for one, other in zip(meshes.modes, hand.modes, strict=True):
        expected = [other.torques["inner"], other.torques["outer"]]
        assert [one.torques["P.sun"], one.torques["P.ring"]] == pytest.approx(expected, rel=1e-9)


BEVEL = """
links: [in, left, right]
input: in
outputs: [left, right]
inertias: {left: 1, right: 2}
elements:
  D: {kind: bevel, left: left, right: right, carrier: in, teeth: {left: 16, planet: 10, right: 16},
      planets: 2, planet: {inertia: 1e-2, mass: 0.2, radius: 0.05}}
springs:
  l: {links: [left, housing], stiffness: 100}
  r: {links: [right, housing], stiffness: 300}
gears: {g: {speeds: {right: 1}}}
"""


def test_planets_of_a_bevel_differential_spin_by_the_difference_of_its_sides() -> None:
    """Lagrange: ``T = J v^2/2`` with ``v = (w_left - w_right)/2 * 16/10``, orbit (w_l + w_r)/2."""
    spin, orbit = np.array([0.8, -0.8]), np.array([0.5, 0.5])
    mass = np.diag([1.0, 2.0]) + 2e-2 * np.outer(spin, spin)
    mass += 2 * 0.2 * 0.05**2 * np.outer(orbit, orbit)
    expected = np.sqrt(linalg.eigh(np.diag([100.0, 300.0]), mass, eigvals_only=True))
    [gear] = modes(loads(BEVEL))
    assert omegas(gear) == pytest.approx(expected, rel=1e-12)
