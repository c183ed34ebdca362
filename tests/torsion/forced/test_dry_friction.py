"""Dry friction under a harmonic torque: harmonic balance, an iteration in NumPy, motion in time."""

import math
from pathlib import Path

import numpy as np
import pytest

from tests.chance import count, generator
from tests.commands import json_answer, vstatics
from tests.torsion.systems import sprung
from vstatics import Spring, Transmission
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.numerics.arrays import Complex, Floats
from vstatics.torsion.forced.harmonic_torques import Harmonic, response

RPM = np.linspace(20.0, 400.0, 30)


def one_mass(friction: float, damping: float = 0.0) -> Transmission:
    """0.5 kg*m^2 on 800 N*m/rad with dry friction."""
    spring = Spring({1: 1}, stiffness=800.0, damping=damping, friction=friction, name="mount")
    return sprung(1, [spring], {1: 0.5})


def test_one_mass_slides_by_den_hartogs_approximation() -> None:
    """Undamped: A = sqrt(F^2 - (4 M/pi)^2)/|c - J w^2|, 0 below 4 M/pi; at w = 0, M counts as 0."""
    for friction, force in ((2.0, 3.0), (10.0, 3.0), (2.0, 2.5)):
        [gear] = response(one_mass(friction), 1, [Harmonic(2.0, force)], np.append(0.0, RPM))
        omega = 2 * RAD_PER_RPM * gear.speeds
        limit = 4 * friction / math.pi * (omega > 0)
        expected = np.sqrt(np.maximum(force**2 - limit**2, 0)) / np.abs(800 - 0.5 * omega**2)
        [order] = gear.orders
        np.testing.assert_allclose(np.abs(order.amplitudes["1"]), expected, rtol=1e-9, atol=1e-15)
        torque = order.torques["mount"] - 0.5 * omega**2 * order.amplitudes["1"]
        np.testing.assert_allclose(torque, force, rtol=1e-9)  # balance of the mass


def test_a_friction_damper_without_spring_moves_its_ring_by_four_pi() -> None:
    """Lanchester's damper: the ring gets 4 M/pi, and a force below 4 M/pi (1 + J1/J2) none."""
    ring = Spring({1: 1, 2: -1}, friction=3.0, name="ring")
    case = sprung(2, [ring], {1: 0.1, 2: 0.05})
    for force in (11.0, 12.0, 40.0):
        [gear] = response(case, 1, [Harmonic(2.0, force)], RPM)
        omega, slips = 2 * RAD_PER_RPM * gear.speeds, force > 36 / math.pi
        on_ring = np.abs(gear.orders[0].amplitudes["2"]) * 0.05 * omega**2
        np.testing.assert_allclose(on_ring, 12 / math.pi if slips else force / 3, rtol=1e-6)


def equivalent(
    matrices: tuple[Floats, Floats, Floats], rows: Floats, limits: Floats, force: Floats, w: float
) -> Complex:
    """The response by dampers 4 M/(pi A w), iterated from large amplitudes with halved steps."""
    mass, stiffness, resistance = matrices
    sizes: Floats = np.ones(len(rows))
    for _ in range(20_000):
        lost = rows.T @ np.diag(limits / sizes) @ rows
        dynamic = stiffness - w**2 * mass + 1j * (w * resistance + np.sign(w) * lost)
        q: Complex = np.linalg.solve(dynamic.astype(complex), force.astype(complex))
        new = np.maximum(np.abs(rows @ q), 1e-10)  # stuck, still well conditioned
        if np.all(np.abs(new - sizes) <= 1e-13 * sizes):
            break
        sizes = np.sqrt(new * sizes)
    return q


@pytest.mark.parametrize("seed", range(508, 517))
def test_random_chains_agree_with_an_iteration_of_dampers(seed: int) -> None:
    """Chains of 2 to 4 masses, friction in one to three springs; sticking ones, too."""
    chance, compared, stuck = generator(seed), 0, 0
    for _ in range(count(3, 30)):
        size = int(chance.integers(2, 5))
        inertias = chance.uniform(0.05, 2, size)
        rates, dampings = chance.uniform(50, 900, size), chance.uniform(0.5, 4, size)
        friction = chance.uniform(0.1, 3, size) * (chance.random(size) < 0.6)
        friction[0] = friction[0] or 0.5
        forms = np.eye(size) - np.eye(size, k=1)  # link n against link n + 1, the last to housing
        twists = [{n + 1: float(part) for n, part in enumerate(row) if part} for row in forms]
        springs = [
            Spring(twist, stiffness=rate, damping=damping, friction=dry, name=f"s{n}")
            for n, (twist, rate, damping, dry) in enumerate(
                zip(twists, rates, dampings, friction, strict=True)
            )
        ]
        own = dict(enumerate(inertias.tolist(), 1))
        case = sprung(size, springs, own)
        amplitude = float(chance.uniform(2, 20))
        speeds = chance.uniform(20, 600, 4) * (1, 1, -1, -1)  # links can turn backward, too
        [gear] = response(case, 1, [Harmonic(1.0, amplitude)], speeds)
        q = np.array(list(gear.orders[0].amplitudes.values()))
        dry = friction > 0
        stiffness, resistance = (forms.T @ np.diag(each) @ forms for each in (rates, dampings))
        matrices = np.diag(inertias), stiffness, resistance
        force = amplitude * np.eye(size)[0]
        for w, column in zip(RAD_PER_RPM * gear.speeds, q.T, strict=True):
            expected = equivalent(matrices, forms[dry], 4 / np.pi * friction[dry], force, w)
            stuck += int((np.abs(forms[dry] @ expected) < 1e-8).sum())
            compared += 1
            np.testing.assert_allclose(column, expected, atol=1e-6 * np.abs(expected).max())
    assert compared >= 12
    assert stuck > 1


def test_notes_say_how_friction_counts_and_what_is_stuck(folder: Path) -> None:
    (folder / "case.yaml").write_text(
        "links: [a, b]\ninertias: {a: 0.5, b: 1}\ngears: {only: []}\n"
        "springs: {shaft: {links: [a, b], stiffness: 800, friction: 2 N*m}}\n"
    )
    (folder / "torque.csv").write_text("order,amplitude [N*m]\n1,30\n")
    asked = ("torsion", "response", "case.yaml", "--speed", "100,200", "-f", "json")
    said = vstatics(*asked, "--orders", "1")
    assert "the dry friction M of shaft, 2 N*m, counts as the damper" in said.err
    assert (
        "gear only: stuck by dry friction, with amplitude 0: shaft in order 1 at 2 of 2" in said.err
    )
    moving = vstatics(*asked, "--torque", "torque.csv")
    assert "stuck" not in moving.err
    [gear] = json_answer(*asked, "--torque", "torque.csv", "-q")["gears"]
    assert gear["orders"][0]["torques"]["shaft"]
