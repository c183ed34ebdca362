"""Random runs of random trains, as functions of a `random.Random`."""

from random import Random

import numpy as np
from scipy.linalg import null_space

from tests.simulation.boxes import points
from tests.simulation.reference import mechanism_columns
from tests.trains import no_losses, random_train
from vstatics import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import (
    Capacity,
    Dog,
    Formula,
    Points,
    Resistance,
    Scenario,
    Start,
    constant,
)
from vstatics.simulation.scenario.laws import TorqueLaw
from vstatics.simulation.scenario.parts import Control


def random_box(rng: Random, *, losses: bool = False) -> Transmission:
    while True:
        case = random_train(rng, regular=True, gears=1, coast=False)
        columns = np.array(mechanism_columns(case))
        if np.linalg.matrix_rank(columns) == len(columns) < case.links:
            break
    case = case if losses else no_losses(case)
    inertias = {link: round(rng.uniform(0.05, 2), 3) for link in range(1, case.links + 1)}
    elements = [one._replace(drag=0.0) for one in case.shift_elements]
    return case.replace(inertias=inertias, gears=[Gear()], shift_elements=elements)


def allowed_speeds(case: Transmission, rng: Random) -> Floats:
    columns = np.array(mechanism_columns(case))
    basis = null_space(columns)
    speeds: Floats = basis @ np.array([rng.uniform(-100, 100) for _ in range(basis.shape[1])])
    return speeds


def as_start(speeds: Floats) -> Start:
    """All of them, as numbers that agree to rounding."""
    return Start(speeds={n: float(speed) for n, speed in enumerate(speeds, 1)})


def random_capacity(rng: Random) -> Points:
    top = round(rng.uniform(5, 200), 1)
    kind = rng.randrange(4)
    at = round(rng.uniform(0, 0.4), 2)
    if kind == 0:
        return constant(top)
    if kind == 1:
        return points((at, 0), (at + 0.1, top))
    if kind == 2:
        return points((at, 0), (at, top), (at + 0.3, top), (at + 0.3, 0))
    return points((0, top), (at + 0.1, top), (at + 0.2, 0))


def random_torque(rng: Random, *, rests: bool) -> TorqueLaw:
    size = round(rng.uniform(-60, 60), 1)
    kind = rng.randrange(5 if rests else 4)
    if kind == 0:
        return constant(size)
    if kind == 1:
        return points((0, size), (0.3, -size), (0.6, size / 2))
    if kind == 2:
        return Points((-50.0, 0.0, 60.0), (20.0, 0.0, -15.0), "speed")
    if kind == 3:
        return Formula(f"-{abs(size) / 100:.3f}*speed")
    return Resistance(abs(size))


def random_run(
    rng: Random, *, losses: bool = False, rests: bool = True, dogs: bool = False
) -> Scenario:
    case = random_box(rng, losses=losses)
    count = len(case.shift_elements)
    used = rng.sample(range(1, count + 1), rng.randint(min(1, count), count))
    controls: dict[int, Control] = {n: Capacity(random_capacity(rng)) for n in used}
    if dogs and used and rng.random() < 0.5:
        controls[used[0]] = Dog(((round(rng.uniform(0.1, 0.6), 2), True),))
    links = rng.sample(range(1, case.links + 1), min(case.links, rng.randint(1, 3)))
    torques = tuple((link, random_torque(rng, rests=rests)) for link in links)
    start = as_start(allowed_speeds(case, rng))
    return Scenario(case, 0.8, start, controls, torques)


def renumbered(scenario: Scenario, order: list[int]) -> Scenario:
    """The same with its links in another order; `order[n]` is the new number, 0 stays."""
    case = scenario.case
    new = [0, *order]
    elements = [
        one._replace(first=new[one.first], second=new[one.second]) for one in case.shift_elements
    ]
    mechanisms = [
        one._replace(first=new[one.first], second=new[one.second], third=new[one.third])
        for one in case.mechanisms
    ]
    names = [case.link_name(new.index(n)) for n in range(1, case.links + 1)]
    inertias = {new[link]: value for link, value in case.inertias.items()}
    moved = case.replace(shift_elements=elements, mechanisms=mechanisms, inertias=inertias)
    moved = moved.replace(input=new[case.input], output=new[case.output], link_names=names)
    start = Start(speeds={new[link]: speed for link, speed in scenario.start.speeds.items()})
    torques = tuple((new[link], law) for link, law in scenario.torques)
    return scenario._replace(case=moved, start=start, torques=torques)
