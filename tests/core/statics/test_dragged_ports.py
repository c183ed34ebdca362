"""Drag above the load in gears with several ports, against all sets of signs in fractions."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.core.statics.batches import plainly
from tests.oracle.drag_of_ports import GearOfPorts, Solution
from tests.trains import is_regular, random_train, shown
from vstatics import Gear, Mechanism, Results, Transmission, solve

TIED = 1e-9
"""Rounding may decide what passes so little."""


def much_drag_of_ports(seed: int) -> Transmission:
    """A random train with gears of any kind, and drag that often is above their load."""
    rng = seeded(seed)
    case = random_train(rng, gears=4)
    made = [one._replace(drag=rng.choice((0.0, 0.3))) for one in case.shift_elements]
    gears = [
        gear._replace(
            drag={n: rng.choice((0.1, 0.5, 2.0)) for n in range(1, rng.randint(2, 4))},
        )
        for gear in case.gears
    ]
    return replace(case, shift_elements=made, gears=gears)


def error(one: Solution, results: Results, number: int) -> float:
    """How far all torques of a gear are from those of a solution, by the largest."""
    gear, elements = results.case.gears[number], one.torques.elements
    exact = [one.torques.element(n) for n in gear.engaged]
    exact += [one.torques.mechanism(k) for k in range(one.torques.mechanisms)]
    exact += [one.torques.mx(), *map(one.torques.system.unknown, one.torques.holding.values())]
    lossy, held = results.lossy_torques[number], results.lossy_holding_torques[number]
    got = [lossy[n - 1] for n in gear.engaged]
    got += [*lossy[elements:], *(held[link - 1] for link in one.torques.holding)]
    expected = np.array(exact, dtype=np.float64)
    return float(np.abs(expected - got).max() / (1 + np.abs(expected).max()))


def checked(case: Transmission) -> Counter[str]:
    """Compare all gears with several ports; how many are in which state."""
    results, states = plainly(case), Counter[str]()
    for number, gear in enumerate(case.gears):
        if not (gear.speeds or gear.torques) or not is_regular(case, gear):
            continue
        exact = GearOfPorts(case, gear)
        if not exact.is_regular:
            continue
        told, solutions = f"{shown(case)}, gear {number}, {gear.drag}", exact.solutions
        if any(one.passed is not None and abs(one.passed) < TIED for one in solutions):
            continue
        assert results.locked[number] == (not solutions), told
        if not solutions:
            states["locked"] += 1
            continue
        best = min(solutions, key=lambda one: error(one, results, number))
        assert error(best, results, number) < 1e-9, told
        dragged = exact.is_dragged(best)
        assert results.dragged[number] == dragged, told
        known = not dragged and best.efficiency is not None
        expected = float(best.efficiency or 0) if known else np.nan
        assert results.efficiency[number] == pytest.approx(expected, nan_ok=True), told
        states["dragged" if dragged else "passing"] += 1
    return states


@pytest.mark.parametrize(
    "seeds", [range(4), pytest.param(range(4, count(60, 600)), marks=pytest.mark.slow)]
)
def test_random_trains_agree_with_all_sets_of_signs(seeds: range) -> None:
    states = sum((checked(much_drag_of_ports(seed)) for seed in seeds), Counter[str]())
    assert states["dragged"] * 8 > states["passing"] > 0


def test_a_motor_overcomes_drag_and_the_load_of_the_output_stays() -> None:
    """1 in, 3 of drag at the motor's link: it is dragged at .5 from the motor, not at 4.

    Pairs of ratio 1 join all links: the output gets ``1 + m - 3`` less what the pairs lose.
    """
    pairs = [Mechanism(1, 2, 0, 1.0, 0.9), Mechanism(2, 3, 0, 1.0, 0.9)]

    def of(motor: float) -> Results:
        return solve(Transmission(3, [], pairs, [Gear(torques={2: motor}, drag={2: 3.0})]))

    little, much = of(0.5), of(4.0)
    assert little.lossy_output_torque == pytest.approx([(0.9 + 0.5 - 3) / 0.9])
    assert much.lossy_output_torque == pytest.approx([(0.9 + 4.0 - 3) * 0.9])
    assert [*little.dragged, *much.dragged] == [True, False]
    assert much.efficiency == pytest.approx([(0.9 + 4.0 - 3) * 0.9 / 5])
