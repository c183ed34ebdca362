"""Torques of the members of sets: what they give to the planets, which are heavy."""

from typing import NamedTuple

import numpy as np
import pytest
from scipy import linalg

from tests.chance import count, seeded, with_slow
from tests.torsion.systems import Array
from tests.torsion.vibration.test_gear_modes import omegas, only
from vstatics import Transmission, loads
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.torsion.forced.harmonic_torques import Harmonic, response

LINKS = ("engine", "s1", "r1", "link", "r2", "c2", "wheel")
"""The carrier of the first set is the sun of the second."""


class Set(NamedTuple):
    """A planetary set with heavy planets."""

    name: str
    members: tuple[str, str, str]
    """Links of sun, ring and carrier."""
    teeth: tuple[int, int]
    spin: float
    """Of all planets about their axes. [kg*m^2]"""
    orbit: float
    """Of all planets with the carrier. [kg*m^2]"""

    def written(self) -> str:
        """As a case has it, with three planets on a radius of 0.1 m."""
        members = zip(("sun", "ring", "carrier"), self.members, strict=True)
        links = ", ".join(f"{member}: {link}" for member, link in members)
        sun, ring = self.teeth
        return (
            f"  {self.name}: {{kind: planetary, {links}, teeth: {{sun: {sun}, ring: {ring}}}, "
            f"planets: 3, planet: {{inertia: {self.spin / 3!r}, mass: {self.orbit / 0.03!r}, "
            "radius: 0.1}}\n"
        )


class Driveline(NamedTuple):
    """Two sets between an engine and a wheel; both rings are held by shafts."""

    sets: tuple[Set, Set]
    inertias: dict[str, float]
    springs: dict[str, tuple[dict[str, float], float]]
    """Twist and stiffness [N*m/rad] of each."""

    def case(self) -> Transmission:
        """What the program reads."""
        springs = "".join(
            f"  {name}: {{twist: {{{', '.join(f'{link}: {part}' for link, part in twist.items())}}}"
            f", stiffness: {rate!r}}}\n"
            for name, (twist, rate) in self.springs.items()
        )
        inertias = ", ".join(f"{link}: {one!r}" for link, one in self.inertias.items())
        return loads(
            f"links: [{', '.join(LINKS)}]\noutput: wheel\ninertias: {{{inertias}}}\n"
            f"elements:\n{''.join(one.written() for one in self.sets)}springs:\n{springs}"
        )

    def row(self, form: dict[str, float]) -> Array:
        """A form of links and planets as a row."""
        names = (*LINKS, *(one.name for one in self.sets))
        return np.array([form.get(name, 0.0) for name in names])

    def meshes(self) -> Array:
        """A row of each mesh: ``z_sun (w_s - w_c) + z_p (w_p - w_c)``, ``z_ring ... - z_p ...``."""
        rows = []
        for one in self.sets:
            (sun, ring, carrier), (z_sun, z_ring) = one.members, one.teeth
            planet = (z_ring - z_sun) / 2
            rows.append(self.row({sun: z_sun, one.name: planet, carrier: -z_sun - planet}))
            rows.append(self.row({ring: z_ring, one.name: -planet, carrier: planet - z_ring}))
        return np.array(rows)

    def matrices(self) -> tuple[Array, Array, Array]:
        """M with planets as coordinates, the part of it without planets, and K."""
        own = np.diag([*(self.inertias.get(link, 0.0) for link in LINKS), 0.0, 0.0])
        mass = own.copy()
        for one in self.sets:
            mass += one.spin * np.diag(self.row({one.name: 1.0}))
            mass += one.orbit * np.diag(self.row({one.members[2]: 1.0}))
        twists = [(self.row(twist), rate) for twist, rate in self.springs.values()]
        return mass, own, np.sum([rate * np.outer(one, one) for one, rate in twists], axis=0)

    def member_torques(self, shape: Array, omega: float, outside: Array) -> dict[str, complex]:
        """``A M = w^2 M q + Q - K q`` by the meshes; from the carrier also what the pins take."""
        mass, _, stiffness = self.matrices()
        meshes = self.meshes()
        acting = omega**2 * mass @ shape + outside - stiffness @ shape
        torques, *_ = np.linalg.lstsq(meshes.T, acting, rcond=None)
        found = {}
        for place, one in enumerate(self.sets):
            two = slice(2 * place, 2 * place + 2)
            given = meshes[two].T @ torques[two]
            pins = omega**2 * one.orbit * shape * self.row({one.members[2]: 1.0})
            for member, link in zip(("sun", "ring", "carrier"), one.members, strict=True):
                found[f"{one.name}.{member}"] = complex((given - pins) @ self.row({link: 1.0}))
        return found


def random_driveline(number: int) -> Driveline:
    rng = seeded(number)

    def size(low: float, high: float) -> float:
        return 10 ** rng.uniform(low, high)

    sets = []
    for name, members in (("P1", ("s1", "r1", "link")), ("P2", ("link", "r2", "c2"))):
        sun = rng.randint(18, 40)
        teeth = sun, sun + 2 * rng.randint(10, 40)
        sets.append(Set(name, members, teeth, size(-4, 0), size(-4, 0)))
    inertias = {link: size(-3, 0) for link in LINKS if rng.random() < 0.8}
    inertias |= {"engine": size(-1, 0), "wheel": size(0, 1)}
    twists: dict[str, dict[str, float]] = {
        "in": {"engine": 1, "s1": -1}, "hold r1": {"r1": 1}, "hold r2": {"r2": 1},
        "out": {"c2": 1, "wheel": -1},
    }  # fmt: skip
    springs = {name: (twist, size(2, 5)) for name, twist in twists.items()}
    return Driveline((sets[0], sets[1]), inertias, springs)


def check_rows(found: dict[str, complex], expected: dict[str, complex], size: float) -> None:
    for name, torque in expected.items():
        assert found[name] == pytest.approx(torque, rel=1e-6, abs=1e-8 * size), name


def check_modes(driveline: Driveline) -> None:
    mass, own, stiffness = driveline.matrices()
    free = linalg.null_space(driveline.meshes())
    gear = only(driveline.case())
    count = len(gear.modes)
    # by 1/omega^2, which is 0 of a motion without inertia; one motion is rigid
    soft = stiffness + mass
    values, vectors = linalg.eigh(free.T @ mass @ free, free.T @ soft @ free)
    squares = (1 / values[::-1] - 1)[1 : count + 1]
    assert omegas(gear) == pytest.approx(np.sqrt(squares), rel=1e-6)
    shapes = (free @ vectors)[:, ::-1][:, 1 : count + 1]
    for mode, shape in zip(gear.modes, shapes.T, strict=True):
        largest = max(mode.shape, key=lambda link: abs(mode.shape[link]))
        scaled = shape * mode.shape[largest] / shape[LINKS.index(largest)]
        torques = driveline.member_torques(scaled, mode.omega, np.zeros(9))
        size = max(map(abs, [*torques.values(), *mode.torques.values()]))
        check_rows(dict(mode.torques), torques, size)
        # what no set shares: w^2 J q is what the springs and the member of the set take
        for link, springs, member in (
            ("s1", -mode.torques["in"], "P1.sun"),
            ("r1", mode.torques["hold r1"], "P1.ring"),
            ("c2", mode.torques["out"], "P2.carrier"),
        ):
            inertia = own[LINKS.index(link), LINKS.index(link)]
            acting = mode.omega**2 * inertia * mode.shape[link]
            assert mode.torques[member] + springs == pytest.approx(acting, abs=1e-8 * size)


def check_response(driveline: Driveline, speed: float) -> None:
    """``(K - w^2 M) q = Q`` with planets as coordinates of their own."""
    mass, _, stiffness = driveline.matrices()
    free = linalg.null_space(driveline.meshes())
    outside = 10.0 * driveline.row({"engine": 1.0})
    omega = 2 * speed * RAD_PER_RPM
    dynamic = free.T @ (stiffness - omega**2 * mass) @ free
    shape = free @ linalg.solve(dynamic, free.T @ outside)
    [gear] = response(driveline.case(), "engine", [Harmonic(2.0, 10.0)], [speed])
    expected = driveline.member_torques(shape, omega, outside)
    found = {name: complex(torque[0]) for name, torque in gear.orders[0].torques.items()}
    check_rows(found, expected, max(map(abs, expected.values())) * np.linalg.cond(dynamic) / 1e4)


@pytest.mark.parametrize("number", with_slow([0, 3], [1, 2, *range(4, count(60, 200))]))
def test_rows_of_any_driveline_are_those_of_planets_as_links(number: int) -> None:
    driveline = random_driveline(number)
    check_modes(driveline)
    check_response(driveline, seeded(number).uniform(100, 5000))
