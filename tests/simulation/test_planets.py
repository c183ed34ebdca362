"""Torques of sets with heavy planets: what their first member gives is what its link loses."""

from random import Random

import pytest

from tests.chance import each_seed, seeded
from vstatics import Transmission, loads
from vstatics.simulation import Motion, Scenario, Start, constant, simulate

SETS = {
    "planetary": "sun: a, ring: b, carrier: c, teeth: {sun: 30, ring: 78}",
    "bevel": "left: a, right: b, carrier: c, teeth: {left: 16, right: 16, planet: 10}",
    "ravigneaux": "small_sun: a, large_sun: d, ring: b, carrier: c, "
    "teeth: {small_sun: 30, large_sun: 38, ring: 80, short: 20, long: 21}",
}
"""Sun, ring, carrier, second sun as a, b, c, d."""


def masses(rng: Random) -> str:
    return (
        f"{{inertia: {10 ** rng.uniform(-4, 0):.5f}, mass: {rng.uniform(0.1, 9):.3f}, "
        f"radius: {rng.uniform(0.05, 0.3):.3f}}}"
    )


def heavy_set(kind: str, rng: Random, *, held: str = "", more: str = "") -> Transmission:
    """A set with inertias on its links, one of which may be the housing."""
    members = SETS[kind]
    planets = f"planet: {masses(rng)}"
    if kind == "ravigneaux":
        planets = f"planet: {{short: {masses(rng)}, long: {masses(rng)}}}"
    names = [name for name in ("a", "b", "c", "d") if f": {name}," in members and name != held]
    inertias = ", ".join(f"{name}: {10 ** rng.uniform(-2, 1):.4f}" for name in names)
    members = members.replace(f": {held},", ": housing,") if held else members
    return loads(
        f"links: [{', '.join(names)}]\noutput: {names[-1]}\ninertias: {{{inertias}}}\n{more}"
        f"elements:\n  P: {{kind: {kind}, {members}, planets: 3, {planets}}}\n"
    )


def speed_up(case: Transmission, torques: dict[str, float]) -> Motion:
    """From rest with constant torques, so with constant accelerations, for 1 s."""
    laws = tuple((case.link_names.index(name) + 1, constant(one)) for name, one in torques.items())
    start = Start(speeds=dict.fromkeys(range(1, case.own_links + 1), 0.0))
    return simulate(Scenario(case, 1.0, start, {}, laws))


def random_torques(rng: Random) -> dict[str, float]:
    return {name: rng.uniform(-100, 100) for name in ("a", "b", "c", "d")}


@pytest.mark.parametrize("kind", SETS)
@each_seed(10)
def test_what_a_wheel_gives_to_planets_is_what_its_link_loses(kind: str, seed: int) -> None:
    """``M = T - J dw/dt`` of a link on which nothing else acts."""
    rng = seeded(seed)
    case = heavy_set(kind, rng, more="" if kind == "bevel" else "losses: reduced\n")
    torques = {one: torque for one, torque in random_torques(rng).items() if one in case.link_names}
    motion = speed_up(case, torques)
    for mechanism in case.mechanisms:
        link = mechanism.first
        lost = case.inertias[link] * motion.speeds[-1, link - 1]
        expected = torques[case.link_names[link - 1]] - lost
        found = motion.torques[:, motion.devices.index(mechanism.name)]
        assert found == pytest.approx(
            expected, rel=1e-9, abs=1e-9 * max(map(abs, torques.values()))
        )
    assert abs(motion.energy.balance) < 1e-9 * (abs(motion.energy.work) + motion.energy.kinetic)


@pytest.mark.parametrize("kind", ["planetary", "ravigneaux"])
@pytest.mark.parametrize("held", ["", "a", "b", "c"])
def test_planets_as_links_have_the_same_torques(kind: str, held: str) -> None:
    """At the meshes planets are links with coordinates of their own: nothing is shared out."""
    rng = seeded(7)
    torques = {name: one for name, one in random_torques(rng).items() if name != held}
    both = []
    for losses in ("reduced", "meshes"):
        more = f"losses: {losses}\nmesh_efficiency: {{external: 1, internal: 1}}\n"
        case = heavy_set(kind, seeded(3), held=held, more=more)
        acting = {one: torque for one, torque in torques.items() if one in case.link_names}
        both.append(speed_up(case, acting))
    own, meshes = both
    wheels = {name.partition("-")[0]: k for k, name in enumerate(meshes.devices)}
    names = {"P": "P.sun"} if kind == "planetary" else {}
    for place, name in enumerate(own.devices):
        wheel = names.get(name, name).partition("-")[0]
        expected = meshes.torques[-1, wheels[wheel]]
        assert own.torques[-1, place] == pytest.approx(expected, rel=1e-9, abs=1e-7)


def test_planets_of_a_group_are_sped_up_by_the_wheel_that_they_mesh_with() -> None:
    """Sun 28 on rim 14, ring 70 on rim 28: ``M = T - J dw/dt`` of the sun, as above."""
    case = loads(
        "links: [a, b, c]\noutput: c\ninertias: {a: 0.02, b: 0.4, c: 2}\nelements:\n"
        "  G: {kind: planet_group, carrier: c, planets: 3, rims: {x: {A: 14, B: 28}},\n"
        "      suns: [{link: a, teeth: 28, rim: A}], rings: [{link: b, teeth: 70, rim: B}],\n"
        "      planet: {x: {inertia: 0.3, mass: 2, radius: 0.1}}}\n"
    )
    motion = speed_up(case, {"a": 50.0, "c": -20.0})
    assert motion.torques[-1, 0] == pytest.approx(50 - 0.02 * motion.speeds[-1, 0], rel=1e-9)
