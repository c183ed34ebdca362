"""The instants of a motion: its largest and least values are among them, and they draw it.

Chains of springs have a closed form, a sum of harmonic motions by the eigenvectors of their
stiffness. Runs with friction are compared with themselves at many more instants.
"""

from random import Random

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.chance import each_seed, seeded, seeds_with_slow
from tests.simulation.runs import random_run
from vstatics import Gear, Spring, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Motion, Points, Scenario, Start, constant, simulate
from vstatics.simulation.record import record
from vstatics.simulation.record.curves import Curves, drawn_times, ranges

CHORD = 1e-3


def random_chain(rng: Random) -> Scenario:
    """Two to six bodies, springs between neighbours and at times to the housing, steady torques."""
    count = rng.randint(2, 6)
    inertias = {link: 10 ** rng.uniform(-2, 1) for link in range(1, count + 1)}
    springs = [
        Spring({n: 1, n + 1: -1}, 10 ** rng.uniform(2, 5), name=f"s{n}") for n in range(1, count)
    ]
    if rng.random() < 0.5:
        springs.append(Spring({count: 1}, 10 ** rng.uniform(2, 5), name="ground"))
    case = Transmission(count, [], [], [Gear()], inertias=inertias, springs=springs)
    speed = rng.choice([0.0, rng.uniform(-100, 100)])
    start = Start(speeds={link: speed + rng.uniform(-5, 5) for link in inertias})
    torques = tuple((link, constant(rng.uniform(-100, 100))) for link in inertias)
    fastest = np.sqrt(max(one.rate for one in springs) / min(inertias.values()))
    return Scenario(case, 10 ** rng.uniform(0, 2) / fastest, start, torques=torques)


def of_modes(scenario: Scenario, times: Floats) -> dict[str, Floats]:
    """Speeds of links and torques of springs by the modes of the chain."""
    case = scenario.case
    rows = np.zeros((len(case.springs), case.links))
    for row, spring in zip(rows, case.springs, strict=True):
        for link, part in spring.form.items():
            row[link - 1] = part
    rates = np.array([spring.rate for spring in case.springs])
    mass = np.diag([case.inertias[link] for link in range(1, case.links + 1)])
    squares, shapes = eigh(rows.T @ (rates[:, None] * rows), mass)
    loads = [law.y[0] for _, law in scenario.torques if isinstance(law, Points)]
    forces = shapes.T @ np.array(loads)
    started = np.array([scenario.start.speeds[n] for n in range(1, case.links + 1)])
    speeds = shapes.T @ mass @ started
    turned, moved = np.zeros((2, case.links, len(times)))
    for mode, square in enumerate(squares):
        force, speed = forces[mode], speeds[mode]
        if square < 1e-9 * squares.max():
            turned[mode] = speed * times + force * times**2 / 2
            moved[mode] = speed + force * times
            continue
        omega = np.sqrt(square)
        turned[mode] = speed / omega * np.sin(omega * times)
        turned[mode] += force / square * (1 - np.cos(omega * times))
        moved[mode] = speed * np.cos(omega * times) + force / omega * np.sin(omega * times)
    columns = dict(zip(case.link_names, shapes @ moved, strict=True))
    torques = rates[:, None] * (rows @ shapes @ turned)
    return columns | {one.name: row for one, row in zip(case.springs, torques, strict=True)}


def columns(motion: Motion) -> dict[str, Floats]:
    made = dict(zip(motion.links, motion.speeds.T, strict=True))
    made |= {f"slip {n}": one for n, one in zip(motion.elements, motion.slips.T, strict=True)}
    made |= {f"heat {n}": one for n, one in zip(motion.elements, motion.heat.T, strict=True)}
    return made | dict(zip(motion.devices, motion.torques.T, strict=True))


def extreme(values: Floats) -> float:
    """The largest of a smooth curve, by the parabola through its highest points."""
    place = int(np.argmax(values))
    if not 0 < place < len(values) - 1:
        return float(values[place])
    before, at, after = values[place - 1 : place + 2]
    return float(at - (after - before) ** 2 / (8 * (before - 2 * at + after)))


def check_chain(scenario: Scenario) -> None:
    motion = simulate(scenario)
    times = np.linspace(0.0, scenario.duration, 20_001)
    expected = of_modes(scenario, times)
    for name, values in columns(motion).items():
        size = np.ptp(expected[name])
        for sign in (1.0, -1.0):
            best = extreme(sign * expected[name])
            assert (sign * values).max() == pytest.approx(best, abs=1e-7 * size)
        drawn = np.interp(times, motion.time, values)
        assert np.abs(drawn - expected[name]).max() <= CHORD * size
        if name in motion.peaks:
            top = max(extreme(sign * expected[name]) for sign in (1.0, -1.0))
            assert abs(motion.peaks[name].torque) == pytest.approx(top, rel=1e-7)


def check_friction(scenario: Scenario) -> None:
    """Calculated again at 501 instants nothing is larger, and chords come near to all of it."""
    motion, fine = simulate(scenario), simulate(scenario, step=scenario.duration / 500)
    known = columns(motion)
    kinds = "speeds", "torques", "heat"
    largest = {kind: np.abs(getattr(fine, kind)).max(initial=0.0) for kind in kinds}
    twice = fine.time[1:][np.diff(fine.time) == 0]
    jumps = (np.abs(fine.time[:, None] - twice) < 1e-9).any(axis=1)
    for name, values in columns(fine).items():
        kind = "heat" if name.startswith("heat") else "speeds"
        kind = "torques" if name in motion.devices else kind
        size, tiny = np.ptp(values), 1e-8 * largest[kind]
        assert values.max() <= known[name].max() + tiny
        assert values.min() >= known[name].min() - tiny
        drawn = np.interp(fine.time[~jumps], motion.time, known[name])
        assert np.abs(drawn - values[~jumps]).max() <= CHORD * size + tiny


@seeds_with_slow(6, 66, 200)
def test_extremes_of_a_chain_of_springs_are_those_of_its_modes(seed: int) -> None:
    check_chain(random_chain(seeded(seed)))


@each_seed(6)
def test_they_are_so_where_each_step_is_drawn_at_once(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(record, "_MOST_NUMBERS", 0)
    check_chain(random_chain(seeded(seed)))
    check_friction(random_run(seeded(seed)))


@seeds_with_slow(4, 24, 60)
def test_runs_with_friction_have_no_values_beyond_their_instants(seed: int) -> None:
    check_friction(random_run(seeded(seed), losses=bool(seed % 2)))


def test_curves_are_drawn_by_no_more_instants_than_are_asked_for() -> None:
    """3000 arcs that bend alike: 51,000 instants draw them."""
    nodes, count = (0.0, 0.3, 0.7, 1.0), 3000
    arcs = np.tile([x**2 for x in nodes], (1, count, 1))
    arc = Curves(np.arange(float(count)), np.ones(count), nodes, arcs)
    of = ranges([arc], [slice(None)])
    [drawn], [fewer] = (drawn_times([arc], of, most) for most in (200_000, 20_000))
    assert len(drawn) == 17 * count
    assert len(fewer) <= 20_000
    assert (np.diff(fewer) > 0).all()
