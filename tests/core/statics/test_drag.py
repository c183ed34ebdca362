"""Drag of links and open elements: numbers from equilibrium and power, by hand.

A gear pair has the ratio 4 and the efficiency .95; its output turns at 1/4.
"""

from dataclasses import replace

import numpy as np
import pytest

from tests.chance import seeded
from tests.core.statics.batches import (
    ARRAYS,
    large_train,
    plainly,
    random_disagreements,
    same,
)
from tests.core.writers.again import is_read_again
from tests.trains import random_train
from vstatics import Gear, Mechanism, ReadError, Results, ShiftElement, Transmission, solve
from vstatics.core.readers.named.reader import read_yaml
from vstatics.core.statics.solve import distribution_matrix
from vstatics.core.writers import deck, named

D = 0.02


def pair(drag: dict[int, float], *, clutch: float = 0.0) -> Transmission:
    """The gear pair, with an open clutch between its links."""
    elements = [ShiftElement(1, 2, drag=clutch)]
    return Transmission(2, elements, [Mechanism(1, 2, 0, 4, 0.95)], [Gear(drag=drag)])


def test_drag_on_the_output_takes_from_the_output_torque_and_adds_to_it_when_coasting() -> None:
    results = solve(pair({2: D}))
    assert results.lossy_torques[0] == pytest.approx([0, 1, 4 * 0.95 - D])
    assert results.torques[0] == pytest.approx([0, 1, 4])
    assert results.efficiency == pytest.approx([0.95 - D / 4])
    assert results.losses[0] == pytest.approx([0.05])
    assert results.drag_losses == pytest.approx([D / 4])
    coasting = solve(pair({2: D}), coast=True)
    assert coasting.lossy_torques[0] == pytest.approx([0, 1, 4 / 0.95 + D])
    assert coasting.efficiency == pytest.approx([1 / (1 / 0.95 + D / 4)])
    assert coasting.drag_losses == pytest.approx([-D / 4])


def test_an_open_clutch_takes_by_its_slip() -> None:
    """It brakes link 1 and drives link 2; the slip is 3/4. Coasting turns its torque."""
    for coast, d in ((False, D), (True, -D)):
        results = solve(pair({}, clutch=D), coast=coast)
        output = (1 - d) * 4 * 0.95 ** (-1 if coast else 1) + d
        assert results.lossy_torques[0] == pytest.approx([d, 1 - d, output])
        assert results.torques[0] == pytest.approx([0, 1, 4])
        assert results.drag_losses == pytest.approx([0.75 * d])
        assert results.efficiency == pytest.approx([(output / 4) ** (-1 if coast else 1)])
        assert results.power_balance == pytest.approx([0])


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
    assert [str(m) for m in results.messages if "drag" in m.text] == [
        "warning: gear 1: the drag of 3 and B is ignored, because the speed there is "
        "indeterminate; give this speed in the gear [W412]"
    ]


def with_drag(seed: int) -> Transmission:
    """A random train with drag here and there, of any size."""
    rng = seeded(seed)
    case = random_train(rng) if seed % 2 else large_train(rng, 6)
    made = [
        element._replace(drag=rng.choice((0.0, 0.001, 0.01, 0.1)))
        for element in case.shift_elements
    ]
    numbers, links = range(1, len(made) + 1), range(1, case.links + 1)
    gears = [
        gear._replace(
            drag={n: rng.choice((0.0, 0.001, 0.02, 0.3)) for n in links if rng.random() < 0.4},
            open_drag={n: rng.choice((0.0, 0.05)) for n in numbers if rng.random() < 0.2},
        )
        for gear in case.gears
    ]
    return replace(case, shift_elements=made, gears=gears)


def check_equilibrium(results: Results, number: int) -> None:
    """On every link all torques are in balance, and so are all powers.

    The matrix with the ratios of the losses times the torques of all devices, those of open
    elements too, and the output torque, against what acts from outside.
    """
    case, gear = results.case, results.case.gears[number]
    turn = -1 if case.coast else 1
    exponents = results.power_sign[number]
    both = [(m.efficiency, m.back_efficiency) for m in case.mechanisms]
    factors = [
        eta if x > 0 else 1 / (eta if back is None else back) if x < 0 else 1.0
        for (eta, back), x in zip(both, exponents, strict=True)
    ]
    u = np.array([m.ratio for m in case.mechanisms]) * factors
    torques, speeds = results.lossy_torques[number], results.speeds[number]
    left = distribution_matrix(case, u) @ torques[:-1]
    left[case.gear_output(gear) - 1] += torques[-1]
    left -= np.nan_to_num(results.lossy_holding_torques[number])
    left[case.gear_input(gear) - 1] -= 1
    taken = 0.0
    for link, torque in gear.torques.items():
        left[link - 1] -= torque
    for link, torque in gear.drag.items():
        left[link - 1] += torque * np.sign(speeds[link - 1]) * turn
        taken += torque * abs(speeds[link - 1])
    for place, element in enumerate(case.shift_elements):
        if place + 1 not in gear.engaged:
            torque = gear.open_drag.get(place + 1, element.drag)
            slip = results.slip_speeds[number, place]
            slip = 0.0 if abs(slip) < 1e-12 else slip
            assert torques[place] == pytest.approx(torque * np.sign(slip) * turn)
            taken += torque * abs(slip)
    size = 1 + np.abs(torques).max()
    assert left / size == pytest.approx(0, abs=1e-8)
    assert results.drag_losses[number] * turn == pytest.approx(taken)
    assert results.power_balance[number] / size == pytest.approx(0, abs=1e-8)
    assert (results.losses[number] * turn >= -1e-9 * size).all()


def check(case: Transmission, held: Transmission, results: Results, seed: int) -> int:
    """Check gears, with freewheels that hold as `held` elements, and variants; count drags."""
    known = results._replace(case=held)
    for number in np.flatnonzero(results.consistent):
        values = (results.speeds[number], results.lossy_torques[number], results.power_sign[number])
        if not any(np.isnan(one).any() for one in values):
            check_equilibrium(known, int(number))
    assert not random_disagreements(case, seed)
    return int(np.count_nonzero(np.nan_to_num(results.drag_losses)))


def test_random_trains() -> None:
    cases = [with_drag(seed) for seed in range(6)]
    assert sum(check(case, case, plainly(case), n) for n, case in enumerate(cases)) > 5


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(200, 212))
def test_drag_freewheels_and_second_efficiencies_together(seed: int) -> None:
    rng = seeded(seed)
    case = with_drag(seed)
    made = [
        element._replace(kind="freewheel") if rng.random() < 0.3 else element
        for element in case.shift_elements
    ]
    free = {number for number, element in enumerate(made, 1) if element.is_freewheel}
    backs = [rng.choice((None, 0.0, 0.8, 1.0)) for _ in case.mechanisms]
    case = replace(
        case,
        shift_elements=made,
        mechanisms=[
            m._replace(back_efficiency=back) for m, back in zip(case.mechanisms, backs, strict=True)
        ],
        gears=[
            gear._replace(engaged=[n for n in gear.engaged if n not in free]) for gear in case.gears
        ],
    )
    results = plainly(case)
    gears = [
        gear._replace(engaged=[n for n, holds in enumerate(marks, 1) if holds])
        for gear, marks in zip(case.gears, results.holds.tolist(), strict=True)
    ]
    plain = [element._replace(kind="") for element in made]
    check(case, replace(case, shift_elements=plain, gears=gears), results, seed)


def test_drag_of_0_is_none() -> None:
    for seed in range(10):
        case = random_train(seeded(seed))
        still = [gear._replace(drag={1: 0.0}, open_drag={}) for gear in case.gears]
        one, other = plainly(case), plainly(replace(case, gears=still))
        assert all(same(getattr(one, name), getattr(other, name)) for name in ARRAYS), seed


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
    case = read_yaml(TEXT.encode(), "case.yaml").case
    assert case.shift_elements[0] == ShiftElement(1, 2, "C", "clutch", 0.02)
    assert case.gears[0].drag == {2: 0.01}
    assert case.gears[0].open_drag == {1: 0.03, 2: 0.01}
    assert is_read_again(case)
    assert named.mapping(case)["shift_elements"] == {
        "C": {"kind": "clutch", "links": ["in", "out"], "drag": 0.02},
        "B": ["out", "housing"],
    }
    assert deck.lost(case) == ["drag of shift element C", "drag of gear 1", "open_drag of gear 1"]


FAULTS = (
    ("drag: 0.02", "drag: -0.02", 3, "C.drag: read -0.02, expected a torque of 0 or more"),
    ("kind: clutch", "kind: dog_clutch", 3, "C.drag: a disengaged dog clutch has no drag"),
    ("{out: 0.01}", "{out: -1}", 8, "drag.out: read -1, expected a torque of 0 or more"),
    ("{out: 0.01}", "{outt: 1}", 8, "did you mean `out`"),
    ("{out: 0.01}", "{housing: 1}", 8, "the housing does not turn, expected a link"),
    ("{out: 0.01}", "0.01", 8, "expected a mapping: a number for each link"),
    ("{C: 0.03, B: 1/100}", "{D: 1}", 8, "expected the name of a shift element"),
    ("{C: 0.03, B: 1/100}", "{C: -1}", 8, "open_drag.C: read -1, expected a torque of 0"),
    ("{C: 0.03, B: 1/100}", "[1]", 8, "expected a mapping: a number for each shift element"),
)


def test_faults_are_located() -> None:
    for before, after, line, words in FAULTS:
        assert TEXT.count(before) == 1
        with pytest.raises(ReadError) as caught:
            read_yaml(TEXT.replace(before, after).encode(), "case.yaml")
        (problem, *_) = caught.value.problems
        assert problem.place is not None
        assert (problem.place[1], words in problem.message) == (line, True), after
