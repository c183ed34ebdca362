"""Gears without a single solution, and what is said of them.

Expected numbers are closed forms, given beside each case, or those of exact arithmetic
(`oracle`). Unless told otherwise the train is a differential of ratio u = -2 with the
links 1 (sun), 2 (ring) and 3 (carrier).
"""

import math
from itertools import product
from random import Random

import numpy as np
import pytest

from tests.chance import examples, seeded
from tests.core.statics.differential import status, texts, train
from tests.core.statics.test_status import FAULTY
from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.parts import Load, SpeedOf
from vstatics.core.model.springs import Spring, between
from vstatics.core.readers import loads
from vstatics.core.statics.diagnosis import regular_gears
from vstatics.core.statics.diagnosis.unknown_speeds import undriven_gears
from vstatics.core.statics.ideal import is_uncertain
from vstatics.core.statics.results import Results


def test_neutral_counts_what_is_missing_and_names_the_free_links() -> None:
    case = train([(2, 0)], Gear())
    results = solve(case)
    assert texts(results) == [
        "warning: neutral: one more shift element must be engaged, or a speed given "
        "(links 2 and 3 can still turn freely); nothing supports the input torque"
    ]
    assert results.missing == [1]
    assert results.speeds[0, 0] == 1
    assert np.isnan([*results.speeds[0, 1:], *results.ratio, *results.efficiency]).all()
    assert status(case) == 0
    two = texts(solve(train([(3, 4)], Gear(), links=4, output=4)))[0]
    assert two.startswith("warning: neutral: 2 more shift elements must")
    assert "(links 2, 3 and 4 can still turn freely)" in two


def test_brakes_that_hold_the_input_tie_the_gear_up() -> None:
    case = train([(2, 0), (3, 0)], Gear([1, 2]))
    [said] = texts(solve(case))
    assert said.startswith("error: tied up: A, B and the input speed contradict each other")
    assert said.endswith("release one of the engaged shift elements")
    assert status(case) == 1


def test_a_gear_that_holds_only_its_input_needs_another_shift_element_instead() -> None:
    """The two messages describe one remedy: brake A is the wrong one of the two shift elements."""
    tied_up, missing, *_ = texts(solve(train([(1, 0), (3, 0)], Gear([1]))))
    assert tied_up.endswith(
        "A and the input speed contradict each other, so the input cannot turn as given; release A"
    )
    assert missing == "warning: one more shift element must be engaged instead"


def test_a_contradiction_is_said_once_however_many_equations_repeat_it() -> None:
    """Both sets and the clutch make links 1 to 3 one piece, twice over."""
    sets = [Mechanism(3, 1, 2, -2.0), Mechanism(1, 3, 2, -3.0), Mechanism(2, 4, 0, -3.0)]
    case = Transmission(4, [ShiftElement(3, 2, "S")], sets, [Gear([1], speeds={2: 0.8})])
    told = texts(solve(case))
    assert sum("tied up" in text for text in told) == 1
    assert len(set(told)) == len(told)


def test_a_geared_neutral_holds_no_torque_but_with_losses() -> None:
    """w_out = 1 + (1/u - 1)/k is 0 at k = 2; beside it the output has torques of any size."""
    pair, own = Mechanism(1, 2, 0, -1.0, 0.95), Mechanism(2, 3, 1, 2.0, 0.96)

    def at(k: float) -> Results:
        return solve(Transmission(3, [], [pair, own._replace(ratio=k)], [Gear()]))

    assert "the output is at rest and takes no power, so torques without" in "".join(texts(at(2.0)))
    for k in 2 - 1e-7, 2 + 1e-7:
        assert abs(at(k).torques[0, -1]) > 1e7
        assert 1 < abs(at(k).lossy_torques[0, -1]) < 100
    braked = Transmission(3, [ShiftElement(3)], [Mechanism(1, 2, 0, -1.0)], [Gear([1])])
    at_rest, unheld = texts(solve(braked))
    assert at_rest == "warning: the output, link 3, is at rest, so the gear has no ratio"
    assert unheld.endswith("nothing supports the torque of the input")


def test_only_torques_that_are_not_held_are_reported() -> None:
    """The output takes that of the input; a pair on a link beside it takes none."""
    pairs = [Mechanism(1, 2, 0, -3.0), Mechanism(3, 4, 0, -2.0)]
    case = Transmission(4, [], pairs, [Gear(torques={4: 0.5})], output=2)
    assert texts(solve(case))[-1].endswith("equilibrium: nothing supports the torque of 4")


def proposed(results: Results) -> str:
    """The torque that is proposed for the further output, link 3."""
    [said] = [text for text in texts(results) if "takes no torque" in text]
    return said.rpartition("3: ")[2].partition("}")[0]


def test_the_torque_that_is_proposed_for_a_further_output_takes_power() -> None:
    """As power enters by the input, or, coasting, by the other output: that gives more then."""
    for ratio, speed, coast in product((2.0, -2.0), (1000.0, -1000.0), (False, True)):
        pairs, load = [Mechanism(1, 2, 0, -3.0), Mechanism(1, 3, 0, ratio)], Load(speed, 100.0)
        case = Transmission(3, [], pairs, [Gear()], outputs=[2, 3], load=load, coast=coast)
        results = solve(case)
        taken = solve(case.replace(gears=[Gear(torques={3: float(proposed(results))})]))
        assert not any("takes no torque" in text for text in texts(taken))
        own = taken.output_torque_Nm[0] * taken.speeds_rpm[0, 1]  # above 0 where it takes power
        assert own < results.output_torque_Nm[0] * results.speeds_rpm[0, 1]
        assert (own < 0) == coast


def test_beside_no_torque_the_one_that_is_proposed_has_a_unit() -> None:
    """A bare number is a part of that of the input, which is none."""
    for speed, coast in product((1000, -1000), ("false", "true")):
        text = f"""
        {{links: 3, outputs: [2, 3], coast: {coast}, load: {{speed: {speed} rpm, torque: 0 N*m}},
        mechanisms: {{axle: {{first: 1, second: 2, ratio: -3}}, pto: {{first: 1, second: 3, ratio: 2}}}},
        gears: {{1: {{}}}}}}
        """
        torque = proposed(solve(loads(text, format="yaml")))
        assert torque.endswith("N*m")
        given = text.replace("1: {}", f"1: {{torques: {{3: {torque}}}}}")
        results = solve(loads(given, format="yaml"))
        assert results.input_power_kW[0] == pytest.approx(20 * 500 * math.pi / 30e3)
        assert results.output_torque_Nm[0] * results.speeds_rpm[0, 1] < 0  # where it enters


def test_a_singular_train_of_the_right_count_has_both_messages() -> None:
    """Two brakes on one link; the fourth and fifth link hang on the sun."""
    case = train([(2, 0), (2, 0)], Gear([1, 2]), links=5)
    case = case.replace(mechanisms=[*case.mechanisms, Mechanism(1, 4, 5, -2.0)])
    results = solve(case)
    assert [*results.missing, *results.excess] == [1, 1]
    first, second = texts(results)[:2]
    assert first.startswith("warning: A and B impose the same constraint")
    assert second.startswith("warning: one more shift element must be engaged")
    assert "(links 4 and 5 can still turn freely)" in second
    assert [*results.ratio, *results.output_torque] == pytest.approx([3, 3])


def test_an_output_of_which_nothing_is_given_is_reported() -> None:
    """Where its speed is determined, by a brake here, only a torque can be given."""
    gears = [Gear([1]), Gear(speeds={2: SpeedOf(3)}), Gear()]
    sets = [Mechanism(1, 2, 3, -2.5)]
    results = solve(Transmission(3, [ShiftElement(2)], sets, gears, outputs=[3, 2]))
    told = [message for message in results.messages if "takes no torque" in message.text]
    assert [(one.severity, one.gear) for one in told] == [("warning", "1"), ("warning", "3")]
    assert "expected a torque, below 0 if the output takes power, such as `torques:" in told[0].text
    assert "expected a speed or a torque, such as `speeds: {2: link 3}`" in told[1].text


def vectoring_axle(chance: Random) -> str:
    """A differential with sets for torque vectoring, whose open brakes drag."""
    numbers = range(chance.randint(1, 3))
    sets = "".join(
        f"  tv{n}: {{first: {chance.choice(('left', 'right'))}, second: aux{n}, third: cage, "
        f"ratio: {chance.choice((0.85, 0.9, 1.15, -1.0, 1.3))}, efficiency: 0.97}}\n"
        for n in numbers
    )
    drags = [f"drag: {chance.uniform(0.5, 4):.3f} N*m" for _ in numbers]
    brakes = ", ".join(f"B{n}: {{links: [aux{n}, housing], {drags[n]}}}" for n in numbers)
    return f"""
links: [cage, left, right, {", ".join(f"aux{n}" for n in numbers)}]
outputs: [left, right]
load: {{speed: 1000 rpm, torque: 400 N*m}}
mechanisms:
  diff: {{first: left, second: right, third: cage, ratio: -1, efficiency: .96}}
{sets}shift_elements: {{{brakes}}}
gears: {{straight: {{speeds: {{right: left}}}}}}
"""


@examples(20, 60, 600)
def test_straight_ahead_with_sets_that_drag_is_a_note(examples: int) -> None:
    """All sets turn as one with the differential, whatever their ratios are."""
    chance = seeded(425)
    for _ in range(examples):
        said = [one.id for one in solve(loads(vectoring_axle(chance))).messages]
        assert "N413" in said
        assert "W425" not in said


def test_a_freewheel_that_cannot_support_the_input_is_no_reason() -> None:
    """Links 4, the input, and 5 are joined to nothing; the freewheel is on the held link 2."""
    elements = [ShiftElement(2, 0, "B"), ShiftElement(3, 0, "D"), ShiftElement(4, 1, "K")]
    elements.append(ShiftElement(2, 0, "F", "freewheel"))
    sets = [Mechanism(1, 2, 3, -2.0)]
    case = Transmission(4, elements, sets, [Gear([1, 2])], input=4, output=3)
    said = "warning: no torques are in equilibrium: nothing supports the torque of the input"
    assert texts(solve(case))[-1] == said


def test_gears_are_usual_but_for_faults_and_torques_that_statics_leaves_open() -> None:
    """Two brakes that hold the ring share its torque in an unknown way."""
    for name, (case, number) in FAULTY.items():
        assert not list(regular_gears(solve(case)))[number - 1], name
    assert all(regular_gears(shipped_results("mzkt7922.dat")))
    for engaged, is_usual in (([1, 2], False), ([1], True)):
        results = solve(train([(2, 0), (2, 0)], Gear(engaged)))
        assert list(regular_gears(results)) == [is_usual]


def test_speeds_and_torques_of_a_pair_check_one_another() -> None:
    """Without losses the output torque is the ratio; with a given torque nothing follows."""
    assert not is_uncertain(Gear(), -0.4, -2.5)
    assert is_uncertain(Gear(), -0.4, -2.6)
    assert not is_uncertain(Gear(torques={1: 0.5}), -0.4, -2.6)


def test_an_output_that_no_component_joins_is_the_cause_of_a_gear_that_cannot_drive() -> None:
    """Link 4 is the output by default, as the last link, but the planetary set ends at link 3.

    An output behind a shaft is connected to it.
    """
    case = train([(2, 0)], Gear([1]), links=4, output=4)
    results = solve(case)
    [problem] = undriven_gears(results)
    assert problem.message == "cannot drive: no component is connected to the output (link 4)"
    assert "warning: neutral: no component is connected to the output (link 4)" in texts(results)
    [behind] = undriven_gears(
        solve(case.replace(springs=[Spring(between(4, 3), 9e3)], gears=[Gear()]))
    )
    assert "expected another engaged shift element" in behind.message
