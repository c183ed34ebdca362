"""Drag above the load: by hand, and against all sets of signs in exact fractions."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from tests.chance import count, generator, seeded
from tests.commands import json_answer, vstatics
from tests.core.statics.batches import KINDS, disagreements, efficiencies, plainly, ratios
from tests.core.statics.test_drag import with_drag
from tests.oracle.drag import solve_gear
from tests.trains import is_regular, random_train, shown
from vstatics import Gear, Load, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.core.model.parts import OfLoad


def two_pairs(first: float = 1.0, second: float = 1.0) -> Transmission:
    """Gear pairs 20:60 and 25:50 behind .5 N*m at 3000 rpm; 2 and 5 N*m of drag behind them."""
    return Transmission(
        3,
        [],
        [Mechanism(1, 2, 0, -3, first), Mechanism(2, 3, 0, -2, second)],
        [Gear(drag={2: OfLoad(2.0, 0.5), 3: OfLoad(5.0, 0.5)})],
        load=Load(3000, 0.5),
    )


@pytest.mark.parametrize(
    ("etas", "expected"),
    [
        ((1.0, 1.0), (0.5 * 3 - 2) * 2 - 5),
        # the first pair is driven by its first wheel, the second by its second one
        ((0.98, 0.97), (0.5 * 3 * 0.98 - 2) * 2 / 0.97 - 5),
    ],
)
def test_the_output_gives_what_the_input_lacks(etas: tuple[float, float], expected: float) -> None:
    results = solve(two_pairs(*etas))
    assert expected == pytest.approx(-6 if etas[0] == 1 else -6.093, abs=5e-4)
    assert results.lossy_torques_Nm[0, -1] == pytest.approx(expected, rel=1e-12)
    assert results.lossy_output_torque_Nm == pytest.approx([expected], rel=1e-12)
    assert results.dragged.tolist() == [True]
    assert results.locked.tolist() == [False]
    assert results.consistent.tolist() == [True]
    assert np.isnan(results.efficiency).all()
    lost = results.losses_kW.sum() + results.drag_losses_kW.item()
    balance = results.input_power_kW - results.output_power_kW
    assert balance == pytest.approx([lost], rel=1e-12)
    assert results.output_power_kW == [0]


def test_without_mesh_losses_one_torque_is_left() -> None:
    """1.5 N*m in, 2 N*m of drag there: the output has to give .5 N*m."""
    gear = Gear(drag={1: OfLoad(2.0, 1.5)})
    case = Transmission(2, [], [Mechanism(1, 2, 0, 1)], [gear], load=Load(1000, 1.5))
    assert solve(case).lossy_output_torque_Nm == pytest.approx([-0.5])


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


def test_who_coasts_is_never_dragged() -> None:
    assert not solve(two_pairs(0.98, 0.97), coast=True).dragged.any()


CASE = b"""\
links: [in, lay, out]
mechanisms:
  P1: {first: in, second: lay, ratio: -60/20, efficiency: 0.98}
  P2: {first: lay, second: out, ratio: -50/25, efficiency: 0.97}
load: {speed: 3000 rpm, torque: 0.5 N*m}
gears:
  one: {drag: {lay: 2 N*m, out: 5 N*m}}
"""


def test_every_answer_says_that_it_is_dragged() -> None:
    said = json_answer("run", "-", "--from", "yaml", stdin=CASE)
    assert (said["dragged"], said["locked"], said["efficiency"]) == ([True], [False], [None])
    assert [text.count("back-driven") for text in said["messages"]] == [1]
    assert said["lossy_torques_Nm"][-1] == pytest.approx([-6.0927835], rel=1e-7)
    asked = ("--vary", "P1.efficiency=0.9:1:30", "--out", "dragged,ETA,MxP_Nm")
    rows = vstatics("sweep", "-", "--from", "yaml", *asked, stdin=CASE).out.splitlines()[1:]
    assert {row.split(",")[2] for row in rows} == {"dragged"}
    assert {row.split(",")[3] + row.split(",")[4] for row in rows} == {"1"}
    pretty = vstatics("run", "-", "--from", "yaml", "--pretty", stdin=CASE).out
    assert "-6.1" in pretty
    assert "back-driven" in pretty


def much_drag(seed: int) -> Transmission:
    """A random train of one input and one output, with drag that often is above its load."""
    rng = seeded(seed)
    case = random_train(rng, regular=True, gears=2)
    made = [one._replace(drag=rng.choice((0.0, 0.3))) for one in case.shift_elements]
    gears = [
        gear._replace(
            drag={
                n: rng.choice((0.1, 0.5, 2.0))
                for n in range(1, case.links + 1)[: rng.randint(1, 3)]
            }
        )
        for gear in case.gears
    ]
    return replace(case, shift_elements=made, gears=gears)


def checked(case: Transmission) -> tuple[int, int]:
    """Compare all gears with exact arithmetic; how many are dragged, and locked."""
    results = solve(case)
    for number, gear in enumerate(case.gears):
        if not is_regular(case, gear):
            continue
        exact = solve_gear(case, gear)
        told = shown(case), gear.drag
        assert (results.locked[number], results.dragged[number]) == (
            exact.locked,
            exact.dragged,
        ), told
        assert np.isnan(results.efficiency[number]) == (exact.locked or exact.dragged), told
        if exact.locked:
            continue
        got = float(results.lossy_torques[number, -1])
        size = float(max(abs(one.output) for one in exact.possible)) + 1
        assert min(abs(Fraction(got) - one.output) for one in exact.possible) < 1e-9 * size, told
        largest = 1 + np.abs(results.lossy_torques[number]).max()
        assert abs(results.power_balance[number]) < 1e-12 * largest, told
        assert results.drag_losses[number] == pytest.approx(float(exact.drag_losses)), told
    return int(results.dragged.sum()), int(results.locked.sum())


@pytest.mark.parametrize(
    "seeds", [range(25, 40), pytest.param(range(40, count(100, 340)), marks=pytest.mark.slow)]
)
def test_random_trains_agree_with_all_sets_of_signs(seeds: range) -> None:
    dragged, locked = map(sum, zip(*(checked(much_drag(seed)) for seed in seeds), strict=True))
    assert dragged > len(seeds) / 2
    assert locked


@pytest.mark.parametrize(
    "seeds", [range(4), pytest.param(range(50, 50 + count(10, 40)), marks=pytest.mark.slow)]
)
def test_variants_are_dragged_as_each_alone(seeds: range) -> None:
    for seed in seeds:
        case, numbers = much_drag(seed), generator(seed)
        u = ratios(numbers, case, 40, KINDS[1 + seed % 3])
        assert not disagreements(case, u, efficiencies(numbers, case, 40, "any"), range(8))


@pytest.mark.parametrize("seed", range(4))
def test_further_ports_close_the_balance_too(seed: int) -> None:
    results = plainly(with_drag(2 * seed + 1))
    known = results.dragged & ~np.isnan(results.power_balance)
    size = 1 + np.nan_to_num(np.abs(results.lossy_torques)).max(axis=-1)
    assert (np.abs(results.power_balance[known]) < 1e-12 * size[known]).all()
