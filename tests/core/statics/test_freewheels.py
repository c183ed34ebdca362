"""Freewheels: which of them hold, and what that means; numbers from closed forms.

The Simpson train: P1 joins sun, ring 1 and output, P2 sun, output and carrier 2, both of
ratio u = -73/35. With carrier 2 held the ratio is 2 - 1/u; with the sun held 1 - 1/u.
"""

from dataclasses import replace
from itertools import combinations
from typing import Literal

import numpy as np
import pytest

from tests.chance import ranges_with_slow, seeded
from tests.core.statics.batches import large_train, plainly, same
from tests.core.statics.differential import assert_located
from tests.core.writers.again import is_read_again
from tests.trains import random_train
from vstatics import CaseError, Gear, Mechanism, Results, ShiftElement, Transmission, loads
from vstatics import solve as solved
from vstatics.core.model.checks import hints
from vstatics.core.statics.diagnosis.unknown_speeds import undriven_gears
from vstatics.core.writers import deck, named

U = -73 / 35
WAYS: tuple[Literal["", "forward", "backward"], ...] = "", "", "forward", "backward"
SIMPSON = """\
links: [input, ring 1, sun, carrier 2, output]
shift_elements:
  A: [input, ring 1]
  B: [input, sun]
  C: [sun, housing]
  D: {kind: freewheel, links: [carrier 2, housing]}
  E: {kind: brake, links: [carrier 2]}
mechanisms:
  P1: {first: sun, second: ring 1, third: output, ratio: -73/35, efficiency: 0.98}
  P2: {first: sun, second: output, third: carrier 2, ratio: -73/35, efficiency: 0.98}
gears:
  "1": {engaged: [A]}
  "2": {engaged: [A, C]}
  "3": {engaged: [A, B]}
  R: {engaged: [B]}
  "1 manual": {engaged: [A, E]}
"""


def test_the_freewheel_holds_in_first_gear_and_coasting_in_reverse() -> None:
    """The housing takes 1 - ratio; in reverse that is 1 - u, where the freewheel is free."""
    for coast in (False, True):
        results = solved(loads(SIMPSON), coast=coast)
        first, reverse = (np.nan, U) if coast else (2 - 1 / U, np.nan)
        expected = [first, 1 - 1 / U, 1, reverse, 2 - 1 / U]
        assert results.ratio == pytest.approx(expected, nan_ok=True)
        assert results.holds[:, 3].tolist() == [not coast, False, False, coast, False]
        assert results.holds[4].tolist() == [True, False, False, False, True]
        held = 3 if coast else 0
        assert results.torques[held, 3] == pytest.approx(1 - expected[held])
        assert results.lossy_torques[held, 3] == pytest.approx(1 - results.lossy_torques[held, -1])
        assert results.slip_speeds[1:, 3] == pytest.approx(
            [(U / (U - 1)) ** 2, 1, results.slip_speeds[3, 3], 0], nan_ok=True
        )
        assert results.torques[4, 3:5] == pytest.approx([0, 1 / U - 1])  # the brake takes it all
        assert not results.failed
        [said] = [one for one in results.messages if "neutral, because" in one.text]
        assert said.gear == ("1" if coast else "R")
        assert "freewheel D overruns: one more shift element must be engaged" in said.text


def pair(ratio: float = -1.0, first: int = 2, second: int = 0) -> Transmission:
    elements = [ShiftElement(first, second, "L", "freewheel"), ShiftElement(1, 0, "B")]
    return Transmission(2, elements, [Mechanism(1, 2, 0, ratio)], [Gear()])


def test_a_freewheel_that_is_driven_backward_is_a_conflict() -> None:
    """The output turns at -1, and holding it would hold the input."""
    results = solved(pair())
    marks = results.conflict[0], results.failed, results.calculable[0], results.tied_up[0]
    assert [*map(bool, marks)] == [True, True, False, False]
    assert np.isnan([*results.speeds[0], *results.torques[0], *results.ratio]).all()
    [said] = results.messages
    assert said.text.startswith(
        "conflict: freewheel L can neither overrun (its slip would be -1, below 0) nor hold"
    )
    turned = solved(pair(first=0, second=2))
    assert turned.slip_speeds.tolist() == [[1, 1]]
    assert not turned.failed
    [said] = solved(backward(pair(2.0))).messages
    assert "(its slip would be 0.5, above 0, with an input that turns backward)" in said.text
    results = solved(loads(SIMPSON.replace("[A, E]", "[A, C, E]")))  # tied up by brakes
    assert (results.tied_up[4], results.conflict[4]) == (True, False)
    assert [one.text[:7] for one in results.messages if one.gear == "1 manual"] == ["tied up"]


def test_freewheels_that_could_hold_in_place_of_each_other_are_reported() -> None:
    """Two between the same links: either turns the set as one piece."""
    elements = [ShiftElement(3, 2, "F1", "freewheel"), ShiftElement(2, 1, "F2", "freewheel")]
    sets = [Mechanism(1, 2, 3, 3.0, name="P", planet_ratio=-1.0)]
    results = solved(Transmission(3, elements, sets, [Gear()], input=1, output=3))
    assert results.ratio == pytest.approx([1])
    [said] = results.messages
    assert said.text.startswith("freewheel F2 could hold instead of F1, so their torques are inde")


TWO_MOTORS = """\
links: [m1, m2, carrier, out]
shift_elements: {F: {kind: freewheel, links: [carrier, housing]}}
mechanisms:
  pair: {first: m1, second: out, ratio: -3, efficiency: .98}
  set: {first: m2, second: out, third: carrier, ratio: -2, efficiency: .97}
gears:
  both: {torques: {m2: -1}}
"""


def test_the_set_that_holds_is_one_whose_torques_balance() -> None:
    """The pair alone turns the output, but the carrier has to take three times the torque of m2.

    Carrier held: m1 turns by 1 with the torque 1, m2 by 2/3 with -1, the output by -1/3. The
    pair gives the output 3 x .98, the set takes 2/.97 of it, as power leaves by m2.
    """
    results = solved(loads(TWO_MOTORS))
    out = 3 * 0.98 - 2 / 0.97
    assert results.ratio == pytest.approx([-3])
    assert results.lossy_torques[0, -1] == pytest.approx(-out)
    assert results.efficiency == pytest.approx([2 / 3 + out / 3])
    assert results.torques[0, 0] == pytest.approx(-3)
    assert results.messages == ()
    other_way = solved(loads(TWO_MOTORS.replace("{m2: -1}", "{m2: 1}")))
    assert not other_way.holds.any()
    said = "nothing supports the torque of m2, because freewheel F overruns"
    assert said in other_way.messages[-1].text


def backward(case: Transmission) -> Transmission:
    return replace(case, gears=[gear._replace(input_turns="backward") for gear in case.gears])


def turned_round(case: Transmission) -> Transmission:
    """The train with its freewheels the other way."""
    elements = [
        one._replace(first=one.second, second=one.first) if one.is_freewheel else one
        for one in case.shift_elements
    ]
    return replace(case, shift_elements=elements)


M2 = TWO_MOTORS.replace("torques: {m2: -1}", "input: m2")
"""Motor 2 alone against the carrier, which reacts with 1 - u = 3: it has to drive backward."""


def test_the_operating_point_gives_the_direction_of_the_input() -> None:
    assert np.isnan(solved(loads(M2)).ratio).all()
    expected = solved(backward(loads(M2)))
    assert expected.ratio == pytest.approx([-2])
    assert expected.torques[0, 0] == pytest.approx(3)
    for load in ("{speed: -900 rpm, torque: -30 N*m}", "{speed: -900 rpm}", "{torque: -30 N*m}"):
        own, common = M2.replace("input: m2", f"input: m2, load: {load}"), f"{M2}load: {load}\n"
        assert same(solved(loads(own)).holds, expected.holds)
        assert same(solved(loads(common)).holds, expected.holds)


def test_an_operating_point_that_contradicts_the_gear_is_refused() -> None:
    text = TWO_MOTORS.replace("torques: {m2: -1}", "input_turns: backward")
    said = "read `backward`, but with the operating point of this gear the input turns forward"
    forward = ("gears:\n", "load: {speed: 900 rpm}\ngears:\n", 8, f"gears.both.input_turns: {said}")
    assert_located(text, [forward, ("backward", "backwards", 7, "did you mean `backward`")])
    loads(text + "load: {speed: -900 rpm}\n")
    with pytest.raises(CaseError, match="expected `forward` or `backward`"):
        replace(loads(SIMPSON), gears=[Gear(input_turns="up")])  # type: ignore[arg-type]


def test_a_note_says_that_the_own_input_of_a_gear_is_assumed_to_turn_forward() -> None:
    note = "the input, link m2, is assumed to turn forward, which affects the freewheels; write "
    note += "`input_turns: forward` or `backward`"
    assert [one.message for one in hints(loads(M2))] == [note]
    for old, new in (
        ("freewheel", "brake"),
        ("input: m2", "torques: {m2: 1}"),
        ("input: m2", "input: m2, load: {torque: 3 N*m}"),
        ("input: m2", "input: m2, input_turns: forward"),
        ("input: m2", "input: m2, input_turns: backward"),
    ):
        assert [*hints(loads(M2.replace(old, new)))] == [], new


def with_freewheels(seed: int) -> Transmission:
    """A random train, some of whose elements are freewheels; some inputs turn backward."""
    rng = seeded(seed)
    case = random_train(rng) if seed % 2 else large_train(rng, 6)
    made = [
        one._replace(kind="freewheel", name="") if rng.random() < 0.4 else one
        for one in case.shift_elements
    ]
    free = {number for number, one in enumerate(made, 1) if one.is_freewheel}
    gears = []
    for gear in case.gears:
        engaged = [number for number in gear.engaged if number not in free]
        gears.append(gear._replace(engaged=engaged, input_turns=rng.choice(WAYS)))
    return replace(case, shift_elements=made, gears=gears)


def states(case: Transmission, number: int) -> list[Results]:
    """What each set of freewheels leads to that is possible, each as a train of its own.

    Here the freewheels are clutches and brakes, engaged where they hold.
    """
    possible, gear = [], case.gears[number]
    wheels = [n for n, one in enumerate(case.shift_elements) if one.is_freewheel]
    plain = [element._replace(kind="") for element in case.shift_elements]
    way = -1 if gear.input_turns == "backward" else 1
    turn = -way if case.coast else way
    for count in range(len(wheels) + 1):
        for held in map(list, combinations(wheels, count)):
            engaged = gear._replace(engaged=[*gear.engaged, *(n + 1 for n in held)])
            one = plainly(replace(case, shift_elements=plain, gears=[engaged]))
            lossy = one.lossy_torques[0, held]
            torques = np.where(np.isnan(lossy), one.torques[0, held], lossy) * turn
            others = [n for n in wheels if n not in held]
            slips = one.slip_speeds[0, others] * way
            if not one.failed and (torques <= 1e-9).all() and not (slips < -1e-9).any():
                possible.append(one)
    return possible


def drives(one: Results) -> bool:
    """Whether the torques of a train of one gear balance, and it has an output speed."""
    output = one.case.gear_output(one.case.gears[0]) - 1
    return bool(one.balanced[0] and not np.isnan(one.speeds[0, output]))


def check_state(case: Transmission, results: Results, number: int) -> None:
    """The state of a gear is one of those found by trying them all."""
    gear, possible = case.gears[number], states(case, number)
    if results.tied_up[number] or results.conflict[number]:
        assert not possible
        return
    speeds, output = results.speeds[number], case.gear_output(gear) - 1
    driving = [one for one in possible if drives(one)]
    if driving:
        assert results.balanced[number]
        assert results.holds[number].sum() == min(one.holds.sum() for one in driving)
    if np.isnan(speeds[output]):
        assert all(np.isnan(one.speeds[0, output]) for one in possible)
    names = ("speeds", "lossy_torques", "efficiency", "losses", "locked", "holds")
    assert any(
        all(same(getattr(one, name)[0], getattr(results, name)[number]) for name in names)
        for one in possible
    )


@ranges_with_slow(6, 120, 400)
def test_the_state_of_random_trains_is_one_that_trying_them_all_finds(seeds: range) -> None:
    """About one of 300 has a set of freewheels that turns the output, but can't balance it."""
    for seed in seeds:
        case = with_freewheels(seed)
        results = plainly(case)
        for number in range(len(case.gears)):
            check_state(case, results, number)


def test_yaml_and_json_keep_freewheels_and_a_deck_cannot() -> None:
    case = backward(loads(SIMPSON))
    freewheel, brake = ShiftElement(4, 0, "D", "freewheel"), ShiftElement(4, 0, "E", "brake")
    assert case.shift_elements[3:] == (freewheel, brake)
    assert is_read_again(case)
    written = named.mapping(case)["shift_elements"]
    assert written["A"] == ["input", "ring 1"]
    assert written["D"] == {"kind": "freewheel", "links": ["carrier 2", "housing"]}
    assert deck.lost(loads(SIMPSON)) == ["that D is a freewheel; it is engaged where it holds"]
    assert "input_turns of gear R" in deck.lost(case)


def test_names_of_shift_elements_tell_their_kind() -> None:
    """A dog clutch is named as a clutch or a brake, a freewheel by L."""
    made = [ShiftElement(1, 2, kind="dog_clutch"), ShiftElement(2, 0, kind="dog_clutch")]
    made += [ShiftElement(1, 3, kind="freewheel")]
    case = Transmission(3, made, [Mechanism(1, 2, 3, -2.0)], [Gear([1]), Gear([2])])
    assert [element.name for element in case.shift_elements] == ["F1", "T2", "L3"]


def test_faults_are_located() -> None:
    brake = "{kind: brake, links: [carrier 2]}"
    rows = (
        ('"1": {engaged: [A]}', '"1": {engaged: [A, D]}', 12, "remove it from the gear"),
        (brake, "{kind: brake, links: [sun, output]}", 7, "against the"),
        (brake, "{kind: clutch, links: [sun]}", 7, "expected `brake`"),
        ("kind: brake", "kind: break", 7, "did you mean `brake`"),
        ("[carrier 2]", "[carrier 2, sun, input]", 7, "read a list of 3"),
        ("[carrier 2]", "[carrier]", 7, "links[1]: read"),
        (brake, "{kind: brake}", 7, "`links` is missing"),
        (brake, "brake", 7, "expected two links"),
    )
    assert_located(SIMPSON, rows)


@pytest.mark.parametrize("converter", [False, True])
def test_a_reversed_freewheel_is_the_remedy_of_a_gear_that_cannot_drive(converter: bool) -> None:
    """No further shift element is needed, because the freewheel holds in its right order."""
    text = SIMPSON.replace("[carrier 2, housing]}\n  E", "[0, carrier 2]}\n  E")
    if converter:
        points = "kind: converter, points: [[0, 2, 4e-3], [1, 1, 0]]"
        pump = f"mechanisms:\n  TC: {{first: engine, second: input, {points}}}"
        text = text.replace("links: [", "links: [engine, ", 1).replace("mechanisms:", pump)
        text += "load: {speed: 2000 rpm, torque: 100 N*m}\n"
    reversed_freewheel = loads(text)
    case = reversed_freewheel.replace(gears=reversed_freewheel.gears[:1])
    [problem] = undriven_gears(solved(case))
    assert problem.message == (
        "cannot drive; if the links of D are in the wrong order, write [carrier 2, housing]: "
        "then the gear can drive"
    )
