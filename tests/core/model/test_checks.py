"""What can be no transmission, part, gear or load: told with its path."""

import math
from itertools import product
from typing import Any

import pytest

from tests.rejects import rejects
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission, loads
from vstatics import solve as solved
from vstatics.core.model.checks import hints
from vstatics.core.model.parts import Load, load_of
from vstatics.core.writers.deck import lost
from vstatics.core.writers.named import write_json, write_yaml

SET: dict[str, Any] = {"links": 3, "shift_elements": [], "mechanisms": [Mechanism(1, 2, 3, -2.5)]}
SET |= {"gears": [Gear()]}
PAIR: dict[str, Any] = {"links": 2, "shift_elements": [ShiftElement(1, 2)], "gears": [Gear()]}
PAIR |= {"mechanisms": [Mechanism(1, 2, 0, 4)]}
element: Any = ShiftElement
gear: Any = Gear
DOG = [ShiftElement(1, 2, kind="dog_clutch")]
CONVERTER = [Mechanism(1, 2, 0, math.nan, kind="converter", points=((0.0, 2.0), (1.0, 1.0)))]


def worm(back: float) -> Mechanism:
    return Mechanism(1, 2, 0, 20, 0.8, back_efficiency=back)


CYLINDERS = "a whole number from 1 to 48"
FAULTS: tuple[tuple[dict[str, Any], str, Any, str, str], ...] = (
    (SET, "mechanisms", Mechanism(1, 2, 3, -2, 1.0000001), "efficiency", "read 1.0000001, "),
    (SET, "outputs", [3, 3], "outputs 2", "link 3 is listed twice, expected each output once"),
    (SET, "outputs", [3, 9], "outputs 2", "read 9, expected a link number from 1 to 3"),
    (SET, "outputs", [3, 1], "outputs 2", "link 1 is the input, expected another link"),
    (SET | {"output": 3}, "outputs", [2, 3], "outputs", "first output is 2, but `output` is 3"),
    (PAIR, "gears", gear(["F1"]), "engaged 1", "the number of a shift element"),
    (PAIR, "gears", gear([1.0]), "engaged 1", "the number of a shift element"),
    (SET, "shift_elements", element("F1", 2), "first", "a link number"),
    (SET, "shift_elements", element(1.0, 2), "first", "a link number"),
    (SET, "shift_elements", element(1, 2, "X", "ratchet"), "kind", ""),
    (SET, "shift_elements", element(1, 2, "X", "brake"), "kind", ""),
    (SET, "mechanisms", worm(-0.1), "back_efficiency", "an efficiency from 0 (self-locking) to 1"),
    (SET, "mechanisms", worm(1.1), "back_efficiency", ""),
    (SET, "mechanisms", worm(math.nan), "back_efficiency", ""),
    (SET, "mechanisms", Mechanism(1, 2, 3, math.nan, kind="converter"), "points", ""),
    (SET, "mechanisms", Mechanism(1, 2, 3, math.nan, kind="converter"), "third", ""),
    (PAIR, "gears", gear(drag={3: 0.1}), "drag 3", ""),
    (PAIR, "gears", gear(drag={2: math.nan}), "drag 2", ""),
    (PAIR, "gears", gear(open_drag={2: 0.1}), "open_drag 2", ""),
    (PAIR | {"shift_elements": DOG}, "gears", gear(open_drag={1: 0.1}), "open_drag 1", ""),
    (
        PAIR | {"mechanisms": CONVERTER},
        "gears",
        [gear()] * 2,
        "gears 1",
        "this also concerns gear 2",
    ),
    *((PAIR, "cylinders", number, "cylinders", CYLINDERS) for number in (0, 49, 4.5)),
)


def test_a_fault_is_reported_with_its_path() -> None:
    for parts, key, given, path, said in FAULTS:
        one = isinstance(given, tuple)  # a part, the only one of its kind
        with pytest.raises(CaseError) as caught:
            Transmission(**{**parts, key: [given] if one else given})
        problems = {" ".join(map(str, each.path)): each.message for each in caught.value.problems}
        assert said in problems[f"{key} 1 {path}".strip() if one else path]


def test_there_may_be_no_more_than_eight_freewheels() -> None:
    def many(count: int) -> Transmission:
        made = [ShiftElement(number, 0, kind="freewheel") for number in range(3, 3 + count)]
        mechanisms = [Mechanism(1, link, 0, -1.0) for link in range(2, 3 + count)]
        return Transmission(2 + count, made, mechanisms, [Gear()], output=2)

    assert solved(many(8)).conflict
    with pytest.raises(CaseError) as caught:
        many(9)
    assert [one.path for one in caught.value.problems] == [("shift_elements", 9)]


def test_the_first_of_several_outputs_is_the_output() -> None:
    case = Transmission(**SET, outputs=[2, 3])
    assert (case.output, case.outputs, case.further_outputs(case.gears[0])) == (2, (2, 3), [3])
    assert Transmission(**SET, outputs=[2]).outputs == ()


def test_the_power_of_a_load_is_that_of_its_torque() -> None:
    """Documents have the power instead of the torque, so that they would be another case."""
    pair = [Mechanism(1, 2, 0, 4)]
    for load, said in (
        (Load(1000.0, 100.0, 50.0), "read 50 kW, which at 1000 rpm are 477.465 N*m"),
        (Load(1000.0, power=50.0), "expected these as `torque`, or no `power`"),
        (Load(torque=100.0, power=50.0), "read 50 kW without a speed"),
        (Load(1000.0, 0.0, 0.0), "read 0 kW"),
    ):
        with rejects(CaseError, said):
            Transmission(2, [], pair, [Gear(load=load)])
        with rejects(CaseError, said):
            Transmission(2, [], pair, [Gear()], load=load)


def test_a_load_that_is_turned_has_its_power_turned() -> None:
    for speed, coast in product((1000.0, -1000.0), (False, True)):
        told = load_of(speed, power=50.0)
        case = Transmission(2, [], [Mechanism(1, 2, 0, 4)], [Gear(load=told)], coast=coast)
        turned = case.gear_load(case.gears[0])
        assert turned.power == (-50.0 if coast else 50.0)
        assert case.replace(gears=[Gear(load=turned)]).gear_load(case.gears[0]) == turned


def test_the_number_of_cylinders_is_kept_but_by_a_deck() -> None:
    for number in (1, 4, 48):
        case = Transmission(**PAIR, cylinders=number)
        for kept in (loads(write_yaml(case)), loads(write_json(case), format="json")):
            assert (kept, kept.cylinders) == (case, number)
        assert lost(case) == ["cylinders"]
        assert "cylinders" not in write_yaml(case.replace(cylinders=None))


def test_a_gear_that_repeats_another_is_noted() -> None:
    """The order of shift elements has no meaning; neutral gears can be equal, points differ."""
    case = loads("""\
links: [sun, ring, carrier]
shift_elements: {B: [ring, housing], C: [sun, ring]}
mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -2.5}}
gears:
  first: {engaged: [B, C], kind: point}
  second: {engaged: [C, B], kind: point}
  third: {engaged: [B, C], kind: point, torques: {ring: 0.1}}
  N: {kind: neutral}
  P: {kind: neutral}
""")
    said = [(problem.id, problem.path) for problem in hints(case)]
    assert said == [("N206", ("gears", 2))]
