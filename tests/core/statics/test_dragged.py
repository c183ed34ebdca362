"""Drag above the load: by hand, and against all sets of signs in exact fractions."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from tests.chance import ranges_with_slow, seeded
from tests.core.statics.batches import plainly
from tests.oracle.drag import solve_gear
from tests.oracle.drag_of_ports import GearOfPorts, Solution
from tests.trains import is_regular, random_train, shown
from vstatics import Gear, Load, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.core.model.parts import OfLoad

TWO_PAIRS = Transmission(
    *(3, [], [Mechanism(1, 2, 0, -3, 0.98), Mechanism(2, 3, 0, -2, 0.97)]),
    [Gear(drag={2: OfLoad(2.0, 0.5), 3: OfLoad(5.0, 0.5)})],
    load=Load(3000, 0.5),
)
"""Gear pairs 20:60 and 25:50 behind .5 N*m at 3000 rpm; 2 and 5 N*m of drag behind them."""


def test_the_output_gives_what_the_input_lacks() -> None:
    """The first pair is driven by its first wheel, the second by its second one."""
    results = solve(TWO_PAIRS)
    assert results.lossy_output_torque_Nm == pytest.approx([(0.5 * 3 * 0.98 - 2) * 2 / 0.97 - 5])
    assert [*results.dragged, *results.locked, *results.consistent] == [True, False, True]
    assert np.isnan(results.efficiency).all()
    lost = results.losses_kW.sum() + results.drag_losses_kW.item()
    assert results.input_power_kW == pytest.approx([lost], rel=1e-12)
    assert results.output_power_kW == [0]
    assert not solve(TWO_PAIRS, coast=True).dragged.any()


def test_more_drag_than_reaches_the_output() -> None:
    """4 of the 1 at the input, less 5 %, and 3.9 of drag; at 3.7 there is an efficiency."""

    def of(drag: float) -> Results:
        return solve(Transmission(2, [], [Mechanism(1, 2, 0, 4, 0.95)], [Gear(drag={2: drag})]))

    assert of(3.7).efficiency == pytest.approx([0.025])
    assert of(3.9).lossy_output_torque == pytest.approx([-0.1])
    assert [*of(3.7).dragged, *of(3.9).dragged] == [False, True]


def test_a_train_that_friction_locks_is_not_dragged() -> None:
    """A worm that cannot be driven back, between a drag and the output that should overcome it."""
    worm = Mechanism(1, 2, 0, 30, 0.5, back_efficiency=0.0)
    assert solve(Transmission(2, [], [worm], [Gear(drag={1: 1.5})])).locked
    assert solve(Transmission(2, [], [worm], [Gear(drag={2: 16.0})])).dragged


def test_an_engine_that_drag_stops_lets_its_freewheel_overrun() -> None:
    """It could pull by a freewheel only; it would need a push."""
    wheel = ShiftElement(2, 1, kind="freewheel")
    case = Transmission(3, [wheel], [Mechanism(2, 3, 0, 2)], [Gear(drag={1: 1.5})])
    assert not solve(case).holds.any()
    assert solve(case.replace(gears=[Gear(drag={1: 0.5})])).holds.all()


def much_drag(seed: int, *, regular: bool = True, gears: int = 2) -> Transmission:
    """A random train with drag that often is above its load; regular: of one input and output."""
    rng = seeded(seed)
    case = random_train(rng, regular=regular, gears=gears)
    made = [one._replace(drag=rng.choice((0.0, 0.3))) for one in case.shift_elements]
    links, opened = range(1, case.links + 1), range(1, len(made) + 1)
    dragged = [
        gear._replace(
            drag={n: rng.choice((0.1, 0.5, 2.0)) for n in links[: rng.randint(1, 3)]},
            open_drag={n: rng.choice((0.0, 0.05)) for n in opened if rng.random() < 0.2},
        )
        for gear in case.gears
    ]
    return replace(case, shift_elements=made, gears=dragged)


def checked(case: Transmission) -> tuple[int, int]:
    """Compare all gears with exact arithmetic; how many are dragged, and locked."""
    results = solve(case)
    for number, gear in enumerate(case.gears):
        if not is_regular(case, gear):
            continue
        exact = solve_gear(case, gear)
        told, state = (shown(case), gear.drag), (results.locked[number], results.dragged[number])
        assert state == (exact.locked, exact.dragged), told
        assert np.isnan(results.efficiency[number]) == any(state), told
        if exact.locked:
            continue
        got = float(results.lossy_torques[number, -1])
        size = float(max(abs(one.output) for one in exact.possible)) + 1
        assert min(abs(Fraction(got) - one.output) for one in exact.possible) < 1e-9 * size, told
        assert results.drag_losses[number] == pytest.approx(float(exact.drag_losses)), told
        check_open(results, number)
    return int(results.dragged.sum()), int(results.locked.sum())


def check_open(results: Results, number: int) -> None:
    """Power balances, losses take it, and open elements have their drag against their slip."""
    case, torques = results.case, results.lossy_torques[number]
    turn, size, gear = -1 if case.coast else 1, 1 + np.abs(torques).max(), case.gears[number]
    assert abs(results.power_balance[number]) < 1e-11 * size
    assert (results.losses[number] * turn >= -1e-9 * size).all()
    for place, one in enumerate(case.shift_elements):
        if place + 1 not in gear.engaged:
            slip, drag = results.slip_speeds[number, place], gear.open_drag.get(place + 1, one.drag)
            sign = np.sign(slip) if abs(slip) > 1e-12 else 0
            assert torques[place] == pytest.approx(drag * sign * turn)


@ranges_with_slow(range(55, 70), 100, 340)
def test_random_trains_agree_with_all_sets_of_signs(seeds: range) -> None:
    dragged, locked = map(sum, zip(*(checked(much_drag(seed)) for seed in seeds), strict=True))
    assert dragged > len(seeds) / 2
    assert locked


TIED = 1e-9
"""Rounding may decide what passes so little."""


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


def compared(case: Transmission) -> Counter[str]:
    """Compare all gears with several ports; how many are in which state."""
    results, states = plainly(case), Counter[str]()
    for number, gear in enumerate(case.gears):
        if not (gear.speeds or gear.torques) or not is_regular(case, gear):
            continue
        exact = GearOfPorts(case, gear)
        told, solutions = f"{shown(case)}, gear {number}, {gear.drag}", exact.solutions
        nearly = any(one.passed is not None and abs(one.passed) < TIED for one in solutions)
        if not exact.is_regular or nearly:
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
        assert results.drag_losses[number] == pytest.approx(float(exact.drag_losses)), told
        check_open(results, number)
        states["dragged" if dragged else "passing"] += 1
    return states


@ranges_with_slow(range(2, 6), 60, 600)
def test_random_trains_of_several_ports_agree_with_all_sets_of_signs(seeds: range) -> None:
    cases = (much_drag(seed, regular=False, gears=4) for seed in seeds)
    states = sum(map(compared, cases), Counter[str]())
    assert states["dragged"] * 8 > states["passing"] > 0
