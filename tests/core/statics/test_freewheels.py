"""Freewheels: which of them hold, and what that means; numbers from closed forms.

The Simpson train: P1 joins sun, ring 1 and output, P2 sun, output and carrier 2, both of
ratio u = -73/35. With carrier 2 held the ratio is 2 - 1/u; with the sun held 1 - 1/u.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.chance import count, generator, seeded
from tests.commands import vstatics
from tests.core.statics.batches import (
    ARRAYS,
    KINDS,
    disagreements,
    efficiencies,
    large_train,
    plainly,
    ratios,
    same,
)
from tests.trains import random_train
from vstatics import CaseError, Gear, Mechanism, ReadError, Results, ShiftElement, Transmission
from vstatics import solve as solved
from vstatics.core.model.checks import hints
from vstatics.core.model.parts import Load
from vstatics.core.readers.named.reader import read_json, read_yaml
from vstatics.core.writers import deck, listing, named
from vstatics.core.writers.result_json import document

U = -73 / 35
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


def simpson(text: str = SIMPSON) -> Transmission:
    return read_yaml(text.encode(), "simpson.yaml").case


def texts(results: Results, gear: str) -> list[str]:
    return [f"{m.severity}: {m.text}" for m in results.messages if m.gear == gear]


def test_first_gear_holds_and_second_overruns() -> None:
    results = solved(simpson())
    assert results.ratio[:3] == pytest.approx([2 - 1 / U, 1 - 1 / U, 1])
    assert list(results.holds[:, 3]) == [True, False, False, False, False]
    assert list(results.holds[0]) == [True, False, False, True, False]
    # the housing takes what input and output leave: 1 - ratio, without losses and with
    assert results.torques[0, 3] == pytest.approx(1 / U - 1)
    assert results.lossy_torques[0, 3] == pytest.approx(1 - results.lossy_torques[0, -1])
    assert results.slip_speeds[1, 3] == pytest.approx((U / (U - 1)) ** 2)
    assert results.slip_speeds[2, 3] == pytest.approx(1)
    assert texts(results, "1") == []
    assert texts(results, "2") == []
    assert not results.failed


def test_coasting_in_first_gear_is_a_neutral() -> None:
    results = solved(simpson(), coast=True)
    assert not results.holds[0, 3]
    assert np.isnan([results.ratio[0], results.efficiency[0], results.slip_speeds[0, 3]]).all()
    assert texts(results, "1")[0].startswith(
        "warning: neutral, because freewheel D overruns: one more shift element must be engaged"
    )
    assert results.ratio[1] == pytest.approx(1 - 1 / U)
    assert not results.failed


def test_reverse_needs_a_brake_but_when_coasting() -> None:
    """The reaction on carrier 2 is 1 - u, in the direction in which the freewheel is free."""
    driving, coasting = solved(simpson()), solved(simpson(), coast=True)
    assert np.isnan(driving.ratio[3])
    assert "freewheel D overruns" in texts(driving, "R")[0]
    assert coasting.holds[3, 3]
    assert coasting.ratio[3] == pytest.approx(U)
    assert coasting.torques[3, 3] == pytest.approx(1 - U)


@pytest.mark.parametrize("coast", [False, True])
def test_a_brake_beside_the_freewheel_takes_the_torque(coast: bool) -> None:
    results = solved(simpson(), coast=coast)
    assert results.ratio[4] == pytest.approx(2 - 1 / U)
    assert list(results.holds[4]) == [True, False, False, False, True]
    assert results.slip_speeds[4, 3] == 0
    assert results.torques[4, 3:5] == pytest.approx([0, 1 / U - 1])


def test_it_is_the_gear_with_the_freewheel_engaged() -> None:
    """The same train with a brake for D, engaged in first gear only."""
    brake = simpson(SIMPSON.replace("kind: freewheel", "kind: brake"))
    gears = [brake.gears[0]._replace(engaged=(1, 4)), *brake.gears[1:]]
    expected, found = solved(replace(brake, gears=gears)), solved(simpson())
    assert all(same(getattr(found, name), getattr(expected, name)) for name in ARRAYS)


TWO = SIMPSON.replace("A: [input, ring 1]", "A: {kind: freewheel, links: [ring 1, input]}")
TWO = TWO.replace("engaged: [A, ", "engaged: [").replace("engaged: [A]", "engaged: []")


def test_two_freewheels() -> None:
    """A drives ring 1: it keeps it from falling behind the input. In first gear both hold."""
    results = solved(simpson(TWO))
    assert results.ratio[:3] == pytest.approx([2 - 1 / U, 1 - 1 / U, 1])
    assert [list(gear[[0, 3]]) for gear in results.holds[:3]] == [
        [True, True],
        [True, False],
        [True, False],
    ]
    assert results.torques[:2, 0] == pytest.approx([-1, -1])
    assert texts(results, "1") == []
    coasting = solved(simpson(TWO), coast=True)
    assert not coasting.holds[0, [0, 3]].any()
    assert "because freewheels A and D overrun" in texts(coasting, "1")[0]


def test_one_of_two_freewheels_takes_over_from_the_other() -> None:
    """A two-speed axle: link 2 follows link 1 by freewheel L1, or a clutch drives it faster.

    The gear pair (3, 2) of ratio .5 would drive link 2 at 2; then L1 overruns by 1.
    """
    case = Transmission(
        3,
        [ShiftElement(2, 1, kind="freewheel"), ShiftElement(1, 3)],
        [Mechanism(3, 2, 0, 0.5)],
        [Gear(), Gear([2])],
        output=2,
    )
    results = solved(case)
    assert results.ratio == pytest.approx([1, 0.5])
    assert [element.name for element in results.case.shift_elements] == ["L1", "F2"]
    assert list(results.holds[:, 0]) == [True, False]
    assert results.slip_speeds[:, 0] == pytest.approx([0, 1])
    assert results.torques[0] == pytest.approx([-1, 0, 0, 1])


def pair(ratio: float = -1.0, first: int = 2, second: int = 0) -> Transmission:
    """A gear pair with a freewheel at its output."""
    elements = [ShiftElement(first, second, "L", "freewheel")]
    return Transmission(2, elements, [Mechanism(1, 2, 0, ratio)], [Gear()])


def test_a_freewheel_that_is_driven_backward_is_a_conflict() -> None:
    """The output turns at -1, and holding it would hold the input."""
    results = solved(pair())
    assert results.conflict
    assert results.failed
    assert not results.calculable
    assert not results.tied_up
    assert np.isnan([*results.speeds[0], *results.torques[0], *results.ratio]).all()
    assert texts(results, "1") == [
        "error: conflict: freewheel L can neither overrun (its slip would be -1, below 0) nor "
        "hold (the gear would be tied up); release one of the engaged shift elements, or exchange "
        "the links of the freewheel if its direction is wrong"
    ]
    turned = solved(pair(first=0, second=2))
    assert turned.ratio == pytest.approx(-1)
    assert turned.slip_speeds == pytest.approx(np.array([[1]]))
    assert not turned.failed


def test_freewheels_that_could_hold_in_place_of_each_other_are_told() -> None:
    """Two between the same links: either turns the set as one piece."""
    elements = [ShiftElement(3, 2, "F1", "freewheel"), ShiftElement(2, 1, "F2", "freewheel")]
    sets = [Mechanism(1, 2, 3, 3.0, name="P", planet_ratio=-1.0)]
    results = solved(Transmission(3, elements, sets, [Gear()], input=1, output=3))
    assert results.ratio == pytest.approx([1])
    assert texts(results, "1") == [
        "warning: freewheel F2 could hold instead of F1, so their torques are indeterminate; "
        "the torques with F1 are shown"
    ]
    assert texts(solved(simpson()), "1") == []


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
    results = solved(simpson(TWO_MOTORS))
    out = 3 * 0.98 - 2 / 0.97
    assert results.ratio == pytest.approx([-3])
    assert results.lossy_torques[0, -1] == pytest.approx(-out)
    assert results.lossy_torques[0, -1] == pytest.approx(-0.878, abs=5e-4)
    assert results.efficiency == pytest.approx([2 / 3 + out / 3])
    assert results.efficiency == pytest.approx([0.959], abs=5e-4)
    assert results.torques[0, 0] == pytest.approx(-3)
    assert texts(results, "both") == []
    braked = simpson(TWO_MOTORS.replace("freewheel", "brake").replace("{tor", "{engaged: [F], tor"))
    assert all(same(getattr(solved(braked), name), getattr(results, name)) for name in ARRAYS)


def test_a_gear_that_no_freewheel_holds_says_so() -> None:
    """m2 pushes the carrier the other way, in which it is free."""
    results = solved(simpson(TWO_MOTORS.replace("{m2: -1}", "{m2: 1}")))
    assert not results.holds.any()
    said = "nothing supports the torque of m2, because freewheel F overruns"
    assert said in texts(results, "both")[-1]
    assert results.ratio == pytest.approx([-3])


# -- the input turns backward --------------------------------------------------------------


def backward(case: Transmission) -> Transmission:
    return replace(case, gears=[gear._replace(input_turns="backward") for gear in case.gears])


@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("text", [SIMPSON, TWO, TWO_MOTORS])
def test_an_input_that_turns_backward_is_a_train_with_its_freewheels_the_other_way(
    text: str, coast: bool
) -> None:
    """The image in a mirror: what turns forward there turns backward here."""
    case = replace(simpson(text), coast=coast)
    turned = [
        one._replace(first=one.second, second=one.first) if one.is_freewheel else one
        for one in case.shift_elements
    ]
    expected, found = solved(replace(case, shift_elements=turned)), solved(backward(case))
    assert same(found.speeds, expected.speeds)
    assert same(found.lossy_torques[:, -1], expected.lossy_torques[:, -1])
    assert same(found.efficiency, expected.efficiency)
    assert same(found.holds, expected.holds)
    assert same(found.conflict, expected.conflict)
    assert not same(found.holds, solved(case).holds)


def test_a_motor_that_drives_backward_needs_the_freewheel() -> None:
    """m2 alone against the carrier, which reacts with 1 - u = 3."""
    case = simpson(TWO_MOTORS.replace("torques: {m2: -1}", "input: m2"))
    assert np.isnan(solved(case).ratio).all()
    results = solved(backward(case))
    assert results.ratio == pytest.approx([-2])
    assert results.torques[0, 0] == pytest.approx(3)


def test_a_load_says_which_way_the_input_turns() -> None:
    case = simpson(TWO_MOTORS.replace("torques: {m2: -1}", "input: m2"))
    expected = solved(backward(case)).holds
    for load in ("{speed: -900 rpm, torque: -30 N*m}", "{speed: -900 rpm}", "{torque: -30 N*m}"):
        own = TWO_MOTORS.replace("torques: {m2: -1}", f"input: m2, load: {load}")
        common = TWO_MOTORS.replace("torques: {m2: -1}", "input: m2") + f"load: {load}\n"
        assert same(solved(simpson(own)).holds, expected)
        assert same(solved(simpson(common)).holds, expected)


def test_a_load_that_contradicts_the_gear_is_refused() -> None:
    text = TWO_MOTORS.replace("torques: {m2: -1}", "input_turns: backward")
    with pytest.raises(ReadError) as refused:
        simpson(text + "load: {speed: 900 rpm}\n")
    (problem,) = refused.value.problems
    assert problem.message == (
        "gears.both.input_turns: read `backward`, but with the operating point of this gear the "
        "input turns forward; expected an operating point with other signs, or no `input_turns`"
    )
    assert problem.place is not None
    assert problem.place[1] == 7
    simpson(text + "load: {speed: -900 rpm}\n")


def test_a_way_that_is_none_is_refused() -> None:
    with pytest.raises(ReadError, match="did you mean `backward`"):
        simpson(TWO_MOTORS.replace("torques: {m2: -1}", "input_turns: backwards"))
    with pytest.raises(CaseError, match="expected `forward` or `backward`"):
        replace(simpson(), gears=[Gear(input_turns="up")])  # type: ignore[arg-type]


def test_an_input_of_a_gears_own_that_says_neither_gets_a_note() -> None:
    def notes(given: str, text: str = TWO_MOTORS) -> list[str]:
        return [one.message for one in hints(simpson(text.replace("torques: {m2: -1}", given)))]

    assert notes("input: m2") == [
        "the input, link m2, is assumed to turn forward, which affects the freewheels; write "
        "`input_turns: forward` or `backward`"
    ]
    for given in (
        *("input: m1", "torques: {m2: 1}", "input: m2, load: {torque: 3 N*m}"),
        *("input: m2, input_turns: forward", "input: m2, input_turns: backward"),
    ):
        assert notes(given) == []
    assert notes("input: m2", TWO_MOTORS.replace("freewheel", "brake")) == []
    checked = vstatics(
        "check", "-", stdin=TWO_MOTORS.replace("torques: {m2: -1}", "input: m2").encode()
    )
    assert "7:3: note: gears.both: the input, link m2, is assumed to turn forward" in checked.err


def test_a_conflict_of_a_backward_input_says_so() -> None:
    (text,) = texts(solved(backward(pair(2.0))), "1")
    assert "(its slip would be 0.5, above 0, with an input that turns backward)" in text


def test_the_way_of_the_input_is_written_and_told_as_lost() -> None:
    case = backward(simpson())
    assert read_yaml(named.write_yaml(case).encode(), "").case == case
    assert read_json(named.write_json(case).encode(), "").case == case
    assert "input_turns of gear R" in deck.lost(case)


def test_plans_know_which_way_the_input_turns() -> None:
    """The same numbers, again and again, for gears that differ in this only."""
    case = simpson(TWO_MOTORS.replace("torques: {m2: -1}", "input: m2"))
    u = np.array([[-3.0, -2.0 - 0.01 * n] for n in range(20)])
    for _ in range(2):
        assert np.isnan(solved(case, ratios=u).ratio).all()
        assert solved(backward(case), ratios=u).ratio[:, 0] == pytest.approx(u[:, 1])
        load = Load(-900.0)
        assert solved(replace(case, load=load), ratios=u).ratio[:, 0] == pytest.approx(u[:, 1])


def test_a_gear_that_is_tied_up_is_none_of_the_freewheels_fault() -> None:
    case = simpson(SIMPSON.replace("[A, E]", "[A, C, E]"))
    results = solved(case)
    assert results.tied_up[4]
    assert not results.conflict[4]
    assert [text[:14] for text in texts(results, "1 manual")] == ["error: tied up"]


def test_the_command_line_fails_for_a_conflict() -> None:
    written = named.write_yaml(pair()).encode()
    said = vstatics("run", "-", "--from", "yaml", stdin=written)
    assert said.fails("gear 1: conflict: freewheel L can neither")
    checked = vstatics("check", "-", "--from", "yaml", stdin=written)
    assert checked.status == 1
    assert "freewheels in conflict" in checked.out
    assert (
        "3 of 3 constraints: ok (engaged: A D)"
        in vstatics("check", "-", stdin=SIMPSON.encode()).out
    )


def test_a_dog_clutch_is_engaged_like_any_other() -> None:
    made = [ShiftElement(1, 2, kind="dog_clutch"), ShiftElement(2, 0, kind="dog_clutch")]
    case = Transmission(3, made, [Mechanism(1, 2, 3, -2.0)], [Gear([1]), Gear([2])])
    assert solved(case).ratio == pytest.approx([1, 3])
    assert [element.name for element in case.shift_elements] == ["F1", "T2"]


# -- arrays of variants ------------------------------------------------------------------


def test_the_state_differs_from_variant_to_variant() -> None:
    """Link 2 turns at 1/u: forward it overruns, backward it is a conflict."""
    u = np.array([[-3.0], [2.0], [-1.0], [0.5], [4.0], [-0.2], [1.0], [3.0]])
    results = solved(pair(), ratios=u)
    assert list(results.conflict[:, 0]) == list(u[:, 0] < 0)
    assert results.ratio[u > 0] == pytest.approx(u[u > 0])
    assert not disagreements(pair(), u)


def test_who_holds_differs_from_variant_to_variant() -> None:
    """L1 brakes the ring, L2 the input's way round: the reaction on the ring is u."""
    made = [ShiftElement(2, 0, kind="freewheel"), ShiftElement(0, 2, kind="freewheel")]
    case = Transmission(3, made, [Mechanism(1, 2, 3, -2.0, 0.98)], [Gear()])
    u = np.array([[-3.0], [2.0], [-1.0], [0.5], [4.0], [-0.2], [1.5], [3.0]] * 3)
    u[8:] *= 1 + 1e-3 * np.arange(16)[:, None]
    results = solved(case, ratios=u)
    assert results.ratio[:, 0] == pytest.approx(1 - u[:, 0])
    assert list(results.holds[:, 0, 0]) == list(u[:, 0] < 0)
    assert list(results.holds[:, 0, 1]) == list(u[:, 0] > 0)
    assert not disagreements(case, u)
    assert not disagreements(replace(case, coast=True), u)


@pytest.mark.slow
@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("text", [SIMPSON, TWO])
def test_variants_of_the_simpson_train(text: str, coast: bool) -> None:
    case = replace(simpson(text), coast=coast)
    rng = generator(1)
    for kind in KINDS:
        u = ratios(rng, case, 6, kind)
        assert not disagreements(case, u, efficiencies(rng, case, 6, "any")), kind


def with_freewheels(seed: int) -> Transmission:
    """A random train, some of whose elements are freewheels; some inputs turn backward."""
    rng = seeded(seed)
    case = random_train(rng) if seed % 2 else large_train(rng, 6)
    made = [
        element._replace(kind="freewheel", name="") if rng.random() < 0.4 else element
        for element in case.shift_elements
    ]
    free = {number for number, element in enumerate(made, 1) if element.is_freewheel}
    gears = [
        gear._replace(
            engaged=[n for n in gear.engaged if n not in free],
            input_turns=rng.choice(("", "", "forward", "backward")),
        )
        for gear in case.gears
    ]
    return replace(case, shift_elements=made, gears=gears)


def states(case: Transmission, number: int) -> list[Results]:
    """What each set of freewheels leads to that is possible, each as a train of its own.

    Here the freewheels are clutches and brakes, engaged where they hold.
    """
    found = []
    wheels = [element.is_freewheel for element in case.shift_elements]
    plain = [element._replace(kind="") for element in case.shift_elements]
    way = -1 if case.gears[number].input_turns == "backward" else 1
    turn = -way if case.coast else way
    for mask in range(2 ** sum(wheels)):
        bits = iter(range(sum(wheels)))
        held = [n for n, is_one in enumerate(wheels) if is_one and mask >> next(bits) & 1]
        gear = case.gears[number]
        gear = gear._replace(engaged=[*gear.engaged, *(n + 1 for n in held)])
        one = plainly(replace(case, shift_elements=plain, gears=[gear]))
        lossy = one.lossy_torques[0, held]
        torques = np.where(np.isnan(lossy), one.torques[0, held], lossy) * turn
        others = [n for n, is_one in enumerate(wheels) if is_one and n not in held]
        if (
            not one.failed
            and (torques <= 1e-9).all()
            and not (one.slip_speeds[0, others] * way < -1e-9).any()
        ):
            found.append(one)
    return found


def drives(one: Results) -> bool:
    """Whether the torques of a train of one gear balance, and it has an output speed."""
    output = one.case.gear_output(one.case.gears[0]) - 1
    return bool(one.balanced[0] and not np.isnan(one.speeds[0, output]))


@pytest.mark.slow
@pytest.mark.parametrize("coast", [False, True])
def test_random_trains_with_given_torques_do_without_a_balance_only_if_they_must(
    coast: bool,
) -> None:
    """About one of 300 has a set of freewheels that turns the output, but can't balance it."""
    seen = 0
    for seed in range(count(200, 400)):
        case = replace(with_freewheels(seed), coast=coast)
        loaded = [gear for gear in case.gears if gear.torques and gear.output not in gear.speeds]
        for gear in loaded if case.freewheels else ():
            one = replace(case, gears=[gear])
            results, possible = plainly(one), states(one, 0)
            driving = [state for state in possible if drives(state)]
            if not driving:
                continue
            assert results.balanced[0], seed
            held = min(state.holds.sum() for state in driving)
            assert results.holds.sum() == held, seed
            assert any(same(state.torques, results.torques) for state in driving), seed
            assert not abs(results.power_balance[0]) > 1e-9, seed
            seen += any(not drives(state) and state.holds.sum() < held for state in possible)
    assert seen > 1


@pytest.mark.parametrize("seed", range(6))
def test_random_trains(seed: int) -> None:
    """The state is one of those found by trying them all, and variants are as alone."""
    case, numbers = with_freewheels(seed), generator(seed)
    results = plainly(case)
    for number, gear in enumerate(case.gears):
        possible = states(case, number)
        if results.tied_up[number] or results.conflict[number]:
            assert not possible
            continue
        speeds = results.speeds[number]
        driving = [one for one in possible if drives(one)]
        if driving:
            assert results.balanced[number]
            held = results.holds[number].sum() - len(gear.engaged)
            assert held == min(one.holds.sum() for one in driving) - len(gear.engaged)
        same_state = [one for one in possible if same(one.speeds[0], speeds)]
        assert same_state
        output = case.gear_output(gear) - 1
        if np.isnan(speeds[output]):
            assert all(np.isnan(one.speeds[0, output]) for one in possible)
        names = ("lossy_torques", "efficiency", "losses", "locked", "holds")
        assert any(
            all(same(getattr(one, name)[0], getattr(results, name)[number]) for name in names)
            for one in same_state
        )
    u = ratios(numbers, case, 12, KINDS[seed % len(KINDS)])
    assert not disagreements(case, u, None, range(4))
    assert not disagreements(case, u, efficiencies(numbers, case, 12, "any"), range(4))


# -- reading, writing, checking ----------------------------------------------------------


def test_what_is_written_is_read_again() -> None:
    case = simpson()
    assert case.shift_elements[3:] == (
        ShiftElement(4, 0, "D", "freewheel"),
        ShiftElement(4, 0, "E", "brake"),
    )
    assert read_yaml(named.write_yaml(case).encode(), "").case == case
    assert read_json(named.write_json(case).encode(), "").case == case
    written = named.mapping(case)["shift_elements"]
    assert written["A"] == ["input", "ring 1"]
    assert written["D"] == {"kind": "freewheel", "links": ["carrier 2", "housing"]}
    assert deck.lost(case) == ["that D is a freewheel; it is engaged where it holds"]


def test_the_table_stands_only_where_there_are_freewheels() -> None:
    results = solved(simpson())
    assert document(results)["holds"][3] == [True, False, False, False, False]
    assert "(HOLDS(I,J),J=1,NP),I=1,KL:\n  1   1   1   0   1\n" in listing.write(results)
    without = solved(simpson(SIMPSON.replace("kind: freewheel", "kind: brake")))
    assert "holds" not in document(without)
    assert "HOLDS" not in listing.write(without)


@pytest.mark.parametrize(
    ("before", "after", "line", "words"),
    [
        ('"1": {engaged: [A]}', '"1": {engaged: [A, D]}', 12, "remove it from the gear"),
        (
            "{kind: brake, links: [carrier 2]}",
            "{kind: brake, links: [sun, output]}",
            7,
            "against the",
        ),
        (
            "{kind: brake, links: [carrier 2]}",
            "{kind: clutch, links: [sun]}",
            7,
            "expected `brake`",
        ),
        ("kind: brake", "kind: break", 7, "did you mean `brake`"),
        ("[carrier 2]", "[]", 7, "or one: [first]"),
        ("[carrier 2]", "[carrier 2, sun, input]", 7, "read a list of 3"),
        ("[carrier 2]", "[carrier]", 7, "links[1]: read"),
        ("[carrier 2]", "[sun, sun]", 7, "to itself"),
        ("{kind: brake, links: [carrier 2]}", "{kind: brake}", 7, "`links` is missing"),
        ("{kind: brake, links: [carrier 2]}", "brake", 7, "expected two links"),
    ],
)
def test_faults_are_located(before: str, after: str, line: int, words: str) -> None:
    assert SIMPSON.count(before) == 1
    with pytest.raises(ReadError) as caught:
        simpson(SIMPSON.replace(before, after))
    (problem,) = caught.value.problems
    assert problem.place is not None
    assert problem.place[1] == line
    assert words in problem.message
