"""Mechanisms with an efficiency for each direction of power; numbers from closed forms.

With the third link held power goes from the first link to the second with `efficiency`,
from the second to the first with `back_efficiency`.
"""

from dataclasses import replace

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.core.statics.batches import ARRAYS, large_train, plainly, same
from tests.core.writers.again import is_read_again
from tests.trains import random_train
from vstatics import Gear, Mechanism, ReadError, ShiftElement, Transmission, solve
from vstatics.core import readers
from vstatics.core.writers import deck


def worm(back: float | None, forward: float = 0.8) -> Transmission:
    """A worm, which drives in gear 1, and its wheel, which drives in gear 2; 20 to 1."""
    pair = Mechanism(1, 2, 0, 20, forward, back_efficiency=back)
    return Transmission(2, [], [pair], [Gear(), Gear(input=2, output=1)])


def test_a_worm_gear_has_an_efficiency_from_each_side() -> None:
    results = solve(worm(0.7))
    assert results.efficiency == pytest.approx([0.8, 0.7])
    assert results.lossy_torques[:, -1] == pytest.approx([16, 0.7 / 20])
    assert results.losses[:, 0] == pytest.approx([0.2, 0.3])
    assert solve(worm(0.7), coast=True).efficiency == pytest.approx([0.7, 0.8])
    assert solve(worm(0.7, forward=1)).efficiency == pytest.approx([1, 0.7])
    assert solve(worm(1, forward=0.7)).efficiency == pytest.approx([0.7, 1])
    given, none = solve(worm(0.8)), solve(worm(None))
    assert all(same(getattr(given, name), getattr(none, name)) for name in ARRAYS)


def test_a_self_locking_worm_gear_can_be_driven_by_the_worm_only() -> None:
    results, coasting = solve(worm(0)), solve(worm(0), coast=True)
    assert results.efficiency == pytest.approx([0.8, np.nan], nan_ok=True)
    assert coasting.efficiency == pytest.approx([np.nan, 0.8], nan_ok=True)
    assert (list(results.locked), list(coasting.locked)) == ([False, True], [True, False])
    assert np.isnan(results.lossy_torques[1]).all()
    assert [(one.id, one.gear) for one in results.messages] == [("W421", "2")]


def test_a_planetary_set_by_its_carrier() -> None:
    """Ring held. Sun in: (1 - u e)/(1 - u). Carrier in: (1 - u)/(1 - u/b)."""
    u, e = -2.0, 0.95
    gears = [Gear([1]), Gear([1], input=3, output=1)]
    for back in (0.9, 0.98, None):
        sets = [Mechanism(1, 2, 3, u, e, back_efficiency=back)]
        case = Transmission(3, [ShiftElement(2)], sets, gears)
        forms = [(1 - u * e) / (1 - u), (1 - u) / (1 - u / (back or e))]
        assert solve(case).efficiency == pytest.approx(forms)
        assert solve(case, coast=True).efficiency == pytest.approx(forms[::-1])


def test_arrays_of_efficiencies_leave_the_second_one_as_it_is() -> None:
    eta = np.array([[0.8], [0.9], [1.0], [0.95], [0.5], [0.7]])
    for back, expected in ((0.7, np.full(6, 0.7)), (None, eta[:, 0])):
        found = solve(worm(back), efficiencies=eta).efficiency
        assert found == pytest.approx(np.stack([eta[:, 0], expected], axis=1))


def with_backs(seed: int) -> Transmission:
    """A random train with other efficiencies for the way back, some of them 0."""
    rng = seeded(seed)
    case = random_train(rng) if seed % 2 else large_train(rng, 6)
    choices = (None, None, 0.0, 1.0, 0.5, 0.8, 0.9, 0.95)
    made = [one._replace(back_efficiency=rng.choice(choices)) for one in case.mechanisms]
    return replace(case, mechanisms=made)


def test_random_trains() -> None:
    """Power is balanced, losses are none below 0, none goes back where that is not possible."""
    for seed in range(count(12, 100)):
        case = with_backs(seed)
        results = plainly(case)
        there = results.consistent
        size = 1 + np.nan_to_num(np.abs(results.lossy_torques[there])).max(axis=1, initial=0)
        balance = np.nan_to_num(results.power_balance[there]) / size
        assert balance == pytest.approx(0, abs=1e-7)
        losses = np.nan_to_num(results.losses[there]) * (-1 if case.coast else 1)
        assert (losses >= -1e-9 * size[:, None]).all()
        signs = np.nan_to_num(results.power_sign[there])
        backs = np.array([m.back_efficiency != 0 for m in case.mechanisms])
        assert (signs[:, ~backs] >= 0).all()


TEXT = """\
links: 2
mechanisms:
  W: {first: 1, second: 2, ratio: 20, efficiency: 0.8, back_efficiency: 0.7}
gears: {"1": {}}
"""


def test_yaml_and_json_keep_it_and_a_deck_cannot() -> None:
    case = readers.read(TEXT.encode(), "case.yaml").case
    assert case.mechanisms[0].back_efficiency == 0.7
    assert is_read_again(case)
    assert deck.lost(case) == ["back_efficiency of mechanism W"]
    with pytest.raises(ReadError) as caught:
        readers.read(TEXT.replace("0.7", "7").encode(), "case.yaml")
    (problem,) = caught.value.problems
    assert problem.place is not None
    assert problem.place[1:3] == (3, TEXT.splitlines()[2].index("0.7") + 1)
