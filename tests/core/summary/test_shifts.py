"""Shifts between neighbouring gears."""

import math

import pytest

from tests.core.summary.gearboxes import differential, summary_of
from vstatics import Gear, Load, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.parts import OfLoad
from vstatics.core.summary import summarize
from vstatics.core.summary.shifts import transitions
from vstatics.core.summary.tables import summary_grids

KILOWATTS = math.pi / 30 / 1000
"""Power of 1 N*m at 1 rpm."""


def test_each_shift_of_the_8hp_changes_one_element() -> None:
    """A property that the source names: one clutch opens and one closes, up to skips of one."""
    zf = summary_of("zf-8hp70.yaml")
    assert {transition.word for transition in zf.transitions} == {"single"}
    assert [(one.start, one.end) for one in zf.transitions if one.skipped == "5"] == [("4", "6")]
    [slips] = [grid for grid in summary_grids(zf) if grid.key == "slip power"]
    pairs = [(row[0], row[1]) for row in slips.texts]
    assert (("4", "5") in pairs, ("4", "6") in pairs) == (True, False)
    first = zf.transitions[0]
    assert (first.released, first.engaged) == (["C"], ["E"])  # ABC to ABE


def test_a_freewheel_takes_part_in_a_shift_by_itself() -> None:
    """TH400: in gear 1 the low roller clutch holds, in gear 2 it overruns."""
    first, *_ = summary_of("simpson-th400.yaml").transitions
    assert first.released == ["low roller clutch"]
    assert first.engaged == ["intermediate clutch"]


def test_shifts_of_the_published_box() -> None:
    """Four forward and two reverse gears; gear 2 is F2 and T4, gear 3 is T1 and F5."""
    found = summary_of("mzkt7922.dat")
    words = {(one.start, one.end): one.word for one in found.transitions}
    assert (words["1", "2"], words["2", "3"]) == ("single", "double")
    assert found.design.forward == ["1", "2", "3", "4"]
    assert {line.gear: line.next for line in found.design.gears}["5"] == "6"


def test_gears_are_forward_by_their_majority_and_neighbours_by_ratio() -> None:
    """Whatever sign the final drive gives them, and in whatever order."""
    case = differential()
    turned = [*case.mechanisms, Mechanism(3, 4, 0, -2.0)]
    for other in (
        Transmission(4, case.shift_elements, turned, case.gears),
        Transmission(3, case.shift_elements, case.mechanisms, case.gears[::-1]),
    ):
        made = summarize(solve(other))
        assert made.design.forward == ["low", "direct"]
        assert made.design.spread == pytest.approx(3.5)
        assert [(one.start, one.end) for one in made.transitions] == [("low", "direct")]


def test_slip_power_is_the_torque_after_by_the_slip_before() -> None:
    """Ring held: -u n on the brake, slip 1 of the clutch; direct: u/(u - 1) on it, slip 1.

    Which link of the clutch comes first changes the signs of torque and slip only.
    """
    u, n = -2.5, 0.96
    gears, sets, load = [Gear([2]), Gear([1])], [Mechanism(1, 2, 3, u, n)], Load(1000.0, 100.0)
    for links in ((1, 2), (2, 1)):
        elements = [ShiftElement(*links, "C"), ShiftElement(2, 0, "B")]
        [shift] = transitions(solve(Transmission(3, elements, sets, gears, load=load)))
        slip = {"C": u / (u - 1), "B": -u * n}
        assert shift.slip_power == pytest.approx(slip)
        kilowatts = {name: power * 1000 * 100 * KILOWATTS for name, power in slip.items()}
        assert shift.slip_power_kW == pytest.approx(kilowatts)


def test_a_dog_clutch_does_not_slip_when_it_closes() -> None:
    clutches = [ShiftElement(1, 2, "C"), ShiftElement(1, 3, "D", kind="dog_clutch")]
    pairs = [Mechanism(2, 4, 0, 3.0), Mechanism(3, 4, 0, 2.0)]
    [made] = transitions(solve(Transmission(4, clutches, pairs, [Gear([1]), Gear([2])])))
    assert (made.engaged, [*made.slip_power]) == (["D"], ["C"])


def test_slip_power_is_at_the_load_of_the_gear_before() -> None:
    """Upward the clutch closes at the load of `low`, downward the brake at that of `direct`."""
    case = differential()
    u, n = case.mechanisms[0].ratio, case.mechanisms[0].efficiency
    loads = {"low": Load(1000.0, 100.0), "direct": Load(500.0, 40.0)}
    gears = [gear._replace(load=loads[gear.name]) for gear in case.gears]
    [shift] = transitions(solve(case.replace(gears=gears)))
    expected = {"C": u / (u - 1) * 100 * 1000 * KILOWATTS, "B": -u * n * 40 * 500 * KILOWATTS}
    assert shift.slip_power_kW == pytest.approx(expected)


def test_without_an_input_torque_no_slip_power_is_relative_to_it() -> None:
    """10 N*m on the output from outside: the brake holds u/(1 - u) of them."""
    torque = Gear([2], torques={3: OfLoad(10.0, 1.0)}, load=Load(1000.0, 0.0), output=1, input=3)
    elements = [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")]
    gears = [torque, torque._replace(engaged=[1])]
    [shift] = transitions(solve(Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], gears)))
    assert [*map(math.isnan, shift.slip_power.values())] == [True, True]
