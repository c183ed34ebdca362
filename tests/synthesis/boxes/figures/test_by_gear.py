"""Figures of gears and boxes against the case that a box is written as, solved by itself."""

import math
from itertools import combinations as pairs_of

import pytest

from tests.synthesis.boxes.figures.random_boxes import RandomBox, numbered_box, random_boxes
from vstatics import CaseError, ShiftElement, Transmission, solve
from vstatics.core.flow.power import flows
from vstatics.synthesis import combinations
from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.figures.measured import MeasuredBox, measured
from vstatics.synthesis.boxes.grouping import core_of
from vstatics.synthesis.boxes.least_form import identity, least_box

BOXES = [*random_boxes(40, seed=32)]


def near(expected: float) -> object:
    return pytest.approx(expected, rel=1e-9, abs=2e-9, nan_ok=True)


@pytest.mark.parametrize("one", BOXES, ids=numbered_box)
def test_figures_of_gears_are_those_of_the_solved_case(one: RandomBox) -> None:
    found = one.measured()
    case, results = found.case, solve(found.case)
    names = [element.name for element in case.shift_elements]
    planets_of = [planet.name for device in case.own_devices for planet in device.planets]
    turning = [name.removesuffix(".planet") for name in planets_of]
    rows = zip(found.gears, case.gears, flows(results), strict=True)
    for row, (gear, own, flow) in enumerate(rows):
        figures = gear.figures
        engaged = {names[number - 1] for number in own.engaged}
        assert {*gear.engaged} == engaged
        torques = dict(zip(names, results.torques[row], strict=False))  # sets follow
        slips = dict(zip(names, results.slip_speeds[row], strict=True))
        assert figures.torques == {name: near(torques[name]) for name in engaged}
        assert figures.slips == {name: near(slips[name]) for name in {*names} - engaged}
        lost = dict(zip([one.name for one in case.own_devices], results.losses[row], strict=True))
        planets = dict(zip(turning, results.planet_speeds[row], strict=True))
        speeds = dict(zip(case.link_names, results.speeds[row], strict=True))
        for name, (_, carrier, _) in zip(found.ratios, found.box.scheme.sets, strict=True):
            whole = next((pair for pair in found.ravigneaux if name in found.ravigneaux[pair]), "")
            assert figures.carriers[name] == near(speeds.get(f"L{carrier}", 0.0))
            if not whole:
                assert figures.planets[name] == near(planets[name])
                assert figures.losses[name] == near(lost[name])
            elif name == found.ravigneaux[whole][0]:
                assert figures.planets[name] == near(planets[f"{whole}.long"])
                both = found.ravigneaux[whole]
                assert sum(figures.losses[one] for one in both) == near(lost[whole])
        assert math.fsum(figures.losses.values()) == near(1 - results.efficiency[row])
        assert flow.shown is not None
        assert figures.circulating == near(flow.shown.circulating)


@pytest.mark.parametrize("one", BOXES, ids=numbered_box)
def test_drag_is_the_slip_power_of_capacities(one: RandomBox) -> None:
    gears, drags = one.measured().gears, {}
    for gear in gears:
        drags[gear.name] = sum(
            abs(slip) * max(abs(other.figures.torques.get(name, 0.0)) for other in gears)
            for name, slip in gear.figures.slips.items()
        )
        assert gear.figures.drag == near(drags[gear.name])
    of_mean = [gear.name for gear in gears if gear.target > 0] or [*drags]
    weighted = measured(one.search, one.box, 0.97, {of_mean[0]: 3.0}).figures.drag
    total = sum(drags[name] for name in of_mean) + 2 * drags[of_mean[0]]
    assert weighted == near(total / (len(of_mean) + 2))


@pytest.mark.parametrize("one", BOXES, ids=numbered_box)
def test_ratios_beyond_are_the_other_combinations_of_one_motion(one: RandomBox) -> None:
    found = one.measured()
    told = [gear.ratio for gear in found.gears]
    others: list[float] = []
    for own in combinations(found.case, engaged=[one.search.engaged]):
        if own.kind in ("gear", "direct") and not own.free:
            assert own.ratio is not None
            if all(abs(own.ratio / ratio - 1) > 1e-6 for ratio in [*told, *others]):
                others.append(own.ratio)
    expected = sorted(others, key=lambda ratio: (ratio < 0, -abs(ratio)))
    assert found.figures.beyond == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("one", BOXES, ids=numbered_box)
def test_shifts_that_skip_gears_and_elements_that_reverse(one: RandomBox) -> None:
    found = one.measured()
    sets = [set(gear.engaged) for gear in found.gears if gear.target > 0]
    far = [(sets[a], sets[b]) for a, b in pairs_of(range(len(sets)), 2) if b > a + 1]
    assert found.figures.skip_shifts == sum(len(a - b) == len(b - a) == 1 for a, b in far)
    signs: dict[str, set[bool]] = {name: set() for name in found.elements}
    for gear in found.gears:
        for name, torque in gear.figures.torques.items():
            if torque:
                signs[name].add(torque > 0)
    assert {*found.figures.reversing} == {name for name, own in signs.items() if len(own) == 2}


@pytest.mark.parametrize("one", BOXES, ids=numbered_box)
def test_a_one_way_clutch_does_what_its_brake_did(one: RandomBox) -> None:
    """A freewheel in place of the brake, either way round, leaves the gears as they are, or not.

    Without losses: near direct drive these may turn the torque of a brake.
    """
    found = measured(one.search, one.box, 1.0)
    ratios = [gear.ratio for gear in found.gears]
    for name in (name for name in found.elements if name.startswith("T-")):
        torques = [gear.figures.torques[name] for gear in found.gears if name in gear.engaged]
        if not torques or not all(torques):  # nothing tells which way it is to hold
            assert name not in found.figures.one_way
            continue
        expected = pytest.approx(ratios, rel=1e-9, nan_ok=False)
        same = [solve(case).ratio.tolist() == expected for case in _with_freewheels(found, name)]
        assert any(same) == (name in found.figures.one_way)


def _with_freewheels(found: MeasuredBox, name: str) -> list[Transmission]:
    """The case of a box with a freewheel for a brake, for each way in which it may hold."""
    case = found.case
    place = [element.name for element in case.shift_elements].index(name)
    link = case.shift_elements[place].first
    engaged = [tuple(n for n in gear.engaged if n != place + 1) for gear in case.gears]
    gears = [gear._replace(engaged=own) for gear, own in zip(case.gears, engaged, strict=True)]
    made = []
    for links in ((link, 0), (0, link)):
        elements = [*case.shift_elements]
        elements[place] = ShiftElement(*links, name, "freewheel")
        made.append(case.replace(shift_elements=elements, gears=gears))
    return made


def test_weights_are_of_gears_of_the_mean() -> None:
    one = BOXES[0]
    for weights, said in [
        ({"9": 1.0}, "read `9`, but the gears of the mean are"),
        ({"1": -1.0}, "1: read -1, expected a number, 0 or above"),
        (dict.fromkeys((gear.name for gear in one.measured().gears), 0.0), "read"),
    ]:
        with pytest.raises(CaseError, match=said):
            measured(one.search, one.box, 0.97, weights)


@pytest.mark.parametrize("one", BOXES[:20], ids=numbered_box)
def test_one_core_has_one_form_without_its_clutches(one: RandomBox) -> None:
    """Each element is put between other links, and may change how the rest is named then."""

    def core(box: FoundBox) -> object:
        """The identity of a box with its brakes alone."""
        return identity(least_box(box._replace(elements=tuple(box.brakes), gears=())))

    box = one.box
    for place, own in enumerate(box.elements):
        for other in ((box.output, box.input), (box.scheme.sets[0][0], -1)):
            if own[1] != other[1] and other not in box.elements:
                changed = (*box.elements[:place], other, *box.elements[place + 1 :])
                less = box._replace(elements=changed)
                same = core_of(least_box(box)) == core_of(least_box(less))
                assert same == (core(box) == core(less))
