"""Links that turn as one piece."""

from tests.core.statics.differential import texts, train
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.statics.bodies import held_as_one


def test_a_set_that_clutches_lock_up_transmits_no_power() -> None:
    """Clutches lock up the set for any efficiency. An axle with equal wheel speeds is not locked up."""
    results = solve(train([(1, 2)], Gear([1])))
    assert results.idle.all()
    assert ([*results.efficiency], texts(results)) == ([1], [])
    direct = train([(1, 2)], Gear([1]))
    assert held_as_one(direct, direct.gears[0]) == {0}
    straight = train([], Gear(speeds={2: 1.0}))
    assert held_as_one(straight, straight.gears[0]) == set()


def test_links_that_turn_alike_are_one_body() -> None:
    """By Willis the carrier turns with sun and ring, joined by a clutch or by a given speed.

    A ring that is held is one piece with the housing by its brake, yet turns with no link.
    """
    both = [(1, 2), (2, 0)]
    for elements, gear, by_speeds, by_elements in (
        (both, Gear([1]), [0, 1, 1, 1], [0, 1, 1, 3]),
        (both, Gear([2]), [0, 1, 2, 3], [0, 1, 0, 3]),
        ([], Gear(speeds={2: 1.0}), [0, 1, 1, 1], [0, 1, 2, 3]),
        ([], Gear(speeds={2: 0.5}), [0, 1, 2, 3], [0, 1, 2, 3]),
    ):
        case = train(elements, gear)
        assert solve(case).gear(1).bodies == by_speeds
        assert case.bodies(case.gears[0]) == by_elements


def test_sets_of_two_ratios_on_the_same_links_are_held_as_one_and_of_one_ratio_are_not() -> None:
    """By Willis w1 - w3 = u (w2 - w3) holds for both, so w2 = w3 where u differs.

    With sun and ring exchanged the same set has the ratio 1/u.
    """

    def held(*mechanisms: Mechanism) -> set[int]:
        case = Transmission(3, [], mechanisms, [Gear()])
        return held_as_one(case, case.gears[0])

    assert held(Mechanism(1, 2, 3, -2.0), Mechanism(1, 2, 3, -2.5)) == {0, 1}
    assert held(Mechanism(1, 2, 3, -2.0), Mechanism(1, 2, 3, -2.0)) == set()
    assert held(Mechanism(1, 2, 3, -2.0), Mechanism(2, 1, 3, -0.5)) == set()
    assert held(Mechanism(1, 2, 3, -2.0), Mechanism(2, 1, 3, -0.4)) == {0, 1}
