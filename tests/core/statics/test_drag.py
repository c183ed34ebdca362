"""Drag of links and open elements, below the load and above it: all sets of signs in fractions."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from tests.chance import ranges_with_slow, seeded
from tests.core.statics.batches import plainly
from tests.core.statics.differential import assert_located
from tests.core.writers.again import is_read_again
from tests.oracle.drag import Admissible, GearOfPorts, GearWithDrag, Solution, solve_gear
from tests.trains import is_regular, random_train, shown
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.core import readers
from vstatics.core.writers import deck, named

D = 0.02


def test_an_overrunning_freewheel_drags_and_one_that_holds_does_not() -> None:
    """Link 2 follows link 1 by the freewheel, or the clutch drives it by the pair at 2."""
    elements = [ShiftElement(2, 1, kind="freewheel", drag=D), ShiftElement(1, 3)]
    gears = [Gear(), Gear([2])]
    results = solve(Transmission(3, elements, [Mechanism(3, 2, 0, 0.5)], gears, output=2))
    assert results.drag_losses == pytest.approx([0, D])
    assert results.efficiency == pytest.approx([1, 1 - D])
    assert results.lossy_torques[:, 0] == pytest.approx([-1, D])


def test_drag_at_a_speed_that_is_not_determined_is_left_out() -> None:
    """A direct clutch with a set that hangs on the input."""
    elements = [ShiftElement(1, 4), ShiftElement(2, 0, "B", drag=D)]
    gear = Gear([1], drag={3: D, 4: D})
    results = solve(Transmission(4, elements, [Mechanism(1, 2, 3, -2.0, 0.97)], [gear]))
    assert results.efficiency == pytest.approx([1 - D])
    [said] = [one for one in results.messages if "drag" in one.text]
    assert (said.id, said.gear, said.text[:27]) == ("W412", "1", "the drag of 3 and B is igno")


TEXT = """\
links: [in, out]
shift_elements:
  C: {kind: clutch, links: [in, out], drag: 0.02}
  B: [out, housing]
mechanisms:
  P: {first: in, second: out, ratio: 4, efficiency: 0.95}
gears:
  "1": {drag: {out: 0.01}, open_drag: {C: 0.03, B: 1/100}}
"""


def test_what_is_written_is_read_again() -> None:
    case = readers.read(TEXT.encode(), "case.yaml").case
    assert case.shift_elements[0] == ShiftElement(1, 2, "C", "clutch", 0.02)
    assert (case.gears[0].drag, case.gears[0].open_drag) == ({2: 0.01}, {1: 0.03, 2: 0.01})
    assert is_read_again(case)
    clutch = {"kind": "clutch", "links": ["in", "out"], "drag": 0.02}
    assert named.mapping(case)["shift_elements"] == {"C": clutch, "B": ["out", "housing"]}
    assert deck.lost(case) == ["drag of shift element C", "drag of gear 1", "open_drag of gear 1"]


def test_faults_are_located() -> None:
    opened = "{C: 0.03, B: 1/100}"
    rows = (
        ("drag: 0.02", "drag: -0.02", 3, "C.drag: read -0.02, expected a torque of 0 or more"),
        ("kind: clutch", "kind: dog_clutch", 3, "C.drag: a disengaged dog clutch has no drag"),
        ("{out: 0.01}", "{out: -1}", 8, "drag.out: read -1, expected a torque of 0 or more"),
        ("{out: 0.01}", "{outt: 1}", 8, "did you mean `out`"),
        ("{out: 0.01}", "{housing: 1}", 8, "the housing does not turn, expected a link"),
        ("{out: 0.01}", "0.01", 8, "expected a mapping: a number for each link"),
        (opened, "{D: 1}", 8, "expected the name of a shift element"),
        (opened, "{C: -1}", 8, "open_drag.C: read -1, expected a torque of 0"),
        (opened, "[1]", 8, "expected a mapping: a number for each shift element"),
    )
    assert_located(TEXT, rows)


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


def nearest(exact: GearWithDrag, states: tuple[bool, bool], output: float) -> Admissible | None:
    """The set of signs that a gear agrees with in its output torque; None where friction locks it.

    `states` are whether it is locked, and dragged.
    """
    assert states == (exact.locked, exact.dragged)
    if exact.locked:
        return None
    got, size = Fraction(float(output)), 1 + max(abs(one.output) for one in exact.possible)
    best = min(exact.possible, key=lambda one: abs(got - one.output))
    assert abs(got - best.output) < 1e-9 * size
    return best


def checked(case: Transmission) -> tuple[int, int]:
    """Compare all gears with exact arithmetic; how many are dragged, and locked."""
    results = solve(case)
    for number, gear in enumerate(case.gears):
        if not is_regular(case, gear):
            continue
        exact, states = solve_gear(case, gear), (results.locked[number], results.dragged[number])
        best = nearest(exact, states, results.lossy_torques[number, -1])
        efficiency = np.nan if best is None or exact.dragged else float(best.efficiency)
        assert results.efficiency[number] == pytest.approx(efficiency, nan_ok=True), shown(case)
        if best is not None:
            assert results.drag_losses[number] == pytest.approx(float(exact.drag_losses))
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


@ranges_with_slow(range(55, 70), 100, 340, start=70)
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


@ranges_with_slow(range(2, 10), 60, 600)
def test_random_trains_of_several_ports_agree_with_all_sets_of_signs(seeds: range) -> None:
    cases = (much_drag(seed, regular=False, gears=4) for seed in seeds)
    states = sum(map(compared, cases), Counter[str]())
    assert states["dragged"] * 8 > states["passing"] > 0
