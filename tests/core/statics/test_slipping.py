"""Clutches and brakes that slip under torque: exact fractions, closed forms, the power balance."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import count, examples, seeded
from tests.oracle.linear import ONE, ZERO, Linear, Row, exact, sign
from tests.oracle.systems import Torques, element_column, mechanism_column, ratios
from tests.trains import random_slipping, random_train
from vstatics import (
    CaseError,
    Gear,
    Load,
    Mechanism,
    ReadError,
    Results,
    ShiftElement,
    Transmission,
    flows,
    loads,
    solve,
)
from vstatics.core.model.parts import OfLoad
from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.writers.named import write_json, write_yaml


def two_shafts(slip: float, *, coast: bool = False) -> Transmission:
    return Transmission(2, [ShiftElement(1, 2, "C")], [], [Gear(slip={1: slip})], coast=coast)


def test_a_clutch_between_two_shafts_has_the_efficiency_1_less_the_slip() -> None:
    """Beyond 1 the load turns backward and gives power, too; coasting, it turns faster."""
    for slip in (0.0, 0.2, 0.999, 1.0, 1.3):
        results = solve(two_shafts(slip))
        assert results.efficiency == pytest.approx([max(0, 1 - slip)])
        assert results.slip_losses.tolist() == [[pytest.approx(slip)]]
        assert results.torques.tolist() == results.lossy_torques.tolist() == [[1, 1]]
        assert results.power_balance == pytest.approx([0], abs=1e-15)
    coasting = solve(two_shafts(-0.25, coast=True))
    assert (coasting.efficiency[0], coasting.slip_losses[0, 0]) == (pytest.approx(0.8), -0.25)


def test_a_warning_says_which_sign_of_slip_is_possible() -> None:
    """Torques exist only for the sign of the slip with which the clutch loses power."""
    loads_ = Load(), Load(-2000, -50), Load(2000, 50)
    for load, slip, coast in product(loads_, (0.3, -0.3), (False, True)):
        results = solve(two_shafts(slip, coast=coast).replace(load=load))
        loses = (slip > 0) != coast
        assert (results.balanced.item(), math.isnan(results.torques[0, 0])) == (loses, not loses)
        side = "below" if slip > 0 else "above"
        said = [message.text.rpartition("only a ")[2] for message in results.messages]
        assert said == ([] if loses else [f"slip {side} 0 is possible"])
    # at -2000 rpm, a slip below 0 makes the driven shaft slower
    text = """
    links: [a, b, out]
    mechanisms: {M: {first: b, second: out, ratio: 2}}
    shift_elements: {C: [a, b]}
    gears: {"1": {slip: {C: -100 rpm}}, "2": {slip: {C: 100 rpm}}}
    load: {speed: -2000 rpm, torque: -50 N*m}
    """
    [warning] = solve(loads(text)).messages
    assert warning.gear == "2"
    assert warning.text.endswith("; only a slip below 0 is possible")


class ByHand(NamedTuple):
    """Speeds, and torques without and with losses in the order of the tables; None if missing."""

    speeds: list[Fraction]
    ideal: list[Fraction] | None
    lossy: list[Fraction] | None
    efficiency: Fraction | None


def speeds_by_hand(case: Transmission, gear: Gear) -> list[Fraction]:
    pairs = zip(case.mechanisms, ratios(case), strict=True)
    rows: list[Row] = [mechanism_column(case.links, mechanism, u) for mechanism, u in pairs]
    rows += [element_column(case, number) for number in (*gear.engaged, *gear.slip)]
    right = [ZERO] * (len(rows) - len(gear.slip)) + [exact(slip) for slip in gear.slip.values()]
    rows.append([ONE if link == case.input else ZERO for link in range(1, case.links + 1)])
    system = Linear(rows, [*right, ONE], case.links)
    return [ZERO, *(system.unknown(link) or ZERO for link in range(case.links))]


def by_hand(case: Transmission) -> ByHand | None:
    """The only gear, by all sets of signs; None where losses alone load a mechanism."""
    [gear] = case.gears
    speeds, turn = speeds_by_hand(case, gear), -1 if case.coast else 1
    moving = [speeds[m.first] - speeds[m.third] for m in case.mechanisms]
    as_engaged = gear._replace(engaged=(*gear.engaged, *gear.slip), slip={})

    def torques(us: Sequence[Fraction]) -> list[Fraction]:
        system = Torques(case, as_engaged, us).system
        return [system.unknown(n) or ZERO for n in range(system.size)]

    def drives(some: Sequence[Fraction]) -> bool:
        return any(some[n - 1] * exact(slip) * turn < 0 for n, slip in gear.slip.items())

    elements, us = len(case.shift_elements), ratios(case)
    etas = [exact(mechanism.efficiency) for mechanism in case.mechanisms]
    ideal = torques(us)
    flows = [m * w for m, w in zip(ideal[elements:-1], moving, strict=True)]
    idle = [not m and w and eta < 1 for m, w, eta in zip(flows, moving, etas, strict=True)]
    out = ideal[-1] * speeds[case.output]
    best: tuple[Fraction, list[Fraction]] | None = None
    ways = [(1, -1) if m and eta < 1 else (0,) for m, eta in zip(flows, etas, strict=True)]
    for signs in product(*ways):
        lossy = torques([u * eta**x for u, eta, x in zip(us, etas, signs, strict=True)])
        if any(m for m, alone in zip(lossy[elements:-1], idle, strict=True) if alone):
            return None
        passing = zip(signs, lossy[elements:-1], moving, strict=True)
        power = lossy[-1] * speeds[case.output]
        if (
            all(x * sign(m * w) * turn >= 0 for x, m, w in passing)
            and not drives(lossy)
            and (power * out > 0 or not out)
        ):
            eta = max(power, ZERO) if turn > 0 else 1 / power if power else ZERO
            best = max(best or (eta, lossy), (eta, lossy), key=lambda one: one[0])
    if drives(ideal) and best is None:
        return ByHand(speeds, None, None, None)
    return ByHand(speeds, ideal, best and best[1], best and best[0])


def check_flow(results: Results, lost: Mapping[int, float]) -> None:
    """The flow and the table of ports have the same losses, in real direction, and balances."""
    [flow], turn = flows(results), -1 if results.case.coast else 1
    assert flow.lossy is not None
    losses = flow.lossy.losses.items()
    of_flow = {node.number: loss for node, loss in losses if node.kind == "element"}
    assert of_flow == pytest.approx({n: turn * loss for n, loss in lost.items()}, abs=1e-12)
    assert flow.lossy.balance == pytest.approx(0, abs=1e-9)
    names = {f"slip.{results.case.shift_elements[n - 1].name}": n for n in lost}
    of_ports = {names[loss.in_]: loss.power for loss in flow.ports.lost if loss.in_ in names}
    assert of_ports == pytest.approx({n: turn * loss for n, loss in lost.items()}, abs=1e-12)


@pytest.mark.parametrize("seed", range(54, 63))
def test_random_trains_with_slipping_elements_against_exact_fractions(seed: int) -> None:
    chance, lossy, driving = seeded(seed), 0, 0

    def same(got: Iterable[float], expected: Iterable[Fraction]) -> bool:
        close = pytest.approx(list(map(float, expected)), rel=1e-9, abs=1e-11)
        return bool(list(got) == close)

    for case in (case for _ in range(count(10, 250)) for case in random_slipping(chance)):
        expected, results = by_hand(case), solve(case)
        if expected is None:
            continue
        assert same(results.speeds[0], expected.speeds[1:])
        if expected.ideal is None:
            driving += 1
            assert np.isnan(results.torques).all()
            assert "W438" in {message.id for message in results.messages}
            continue
        assert same(results.torques[0], expected.ideal)
        assert results.consistent.item() == (expected.lossy is not None)
        if expected.lossy is not None:
            lossy += 1
            [gear], got = case.gears, results.lossy_torques[0].tolist()
            assert same(got, expected.lossy)
            lost = {n: slip * got[n - 1] for n, slip in gear.slip.items()}
            assert {n: results.slip_losses[0, n - 1] for n in gear.slip} == pytest.approx(lost)
            check_flow(results, lost)
            assert results.power_balance == pytest.approx([0], abs=1e-9)
            assert results.efficiency[0] == pytest.approx(float(expected.efficiency or 0), rel=1e-9)
    assert min(lossy, driving) > 3


def test_a_slip_of_0_is_as_engaged() -> None:
    """Speeds, torques, bodies, flow; to the last bit where the order of the elements is kept."""
    chance = seeded(55)
    for _ in range(count(20, 300)):
        case = random_train(chance, regular=True, gears=1)
        [gear] = case.gears
        slip = dict.fromkeys(gear.engaged[1:], 0.0)
        at_0 = replace(case, gears=[gear._replace(engaged=gear.engaged[:1], slip=slip)])
        ours, engaged = solve(at_0), solve(case)
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(ours, name), getattr(engaged, name), err_msg=name)
        assert ours.messages == engaged.messages
        assert ours.gear(1).bodies == engaged.gear(1).bodies
        assert repr(flows(ours)[0].shown) == repr(flows(engaged)[0].shown)


@examples(3, 10, 200)
def test_slips_of_arrays_are_those_of_single_cases(examples: int) -> None:
    """Through 0 and both signs, with the load that relates them; also at a drawn gear set."""
    chance = seeded(56)
    for _ in range(examples):
        speed = chance.choice((-900.0, 1500.0))
        case = random_slipping(chance)[0].replace(load=Load(speed, 80.0))
        [gear] = case.gears
        number, name = next((n, case.shift_elements[n - 1].name) for n in gear.slip)
        slips = np.array([0.0, *(chance.uniform(-60, 60) for _ in range(7)), 0.0])
        results = solve(case, vary={f"gears.{gear.name}.slip.{name}": slips})
        for place, slip in enumerate(slips.tolist()):
            given = OfLoad(slip * 30 / math.pi, speed)
            alone = solve(replace(case, gears=[gear._replace(slip={**gear.slip, number: given})]))
            for table in ("speeds", "torques", "lossy_torques", "efficiency", "slip_losses_kW"):
                expected, of_arrays = getattr(alone, table), getattr(results, table)[place]
                assert of_arrays == pytest.approx(expected, rel=1e-9, abs=1e-9, nan_ok=True), table


def test_digits_do_not_suffer_with_a_ratio_near_1() -> None:
    """Calculated in fractions: i = 1 - u/(u - 1) s by hand."""
    u, slip = 1 + 1e-13, 0.5
    case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, u)], [Gear(slip={1: slip})])
    results = solve(case)
    u_, slip_ = Fraction(u), Fraction(slip)
    assert results.exact.all()
    assert results.speeds[0, 2] == pytest.approx(float((1 - u_ * slip_) / (1 - u_)), rel=1e-14)


TROLL = """\
links: [engine, sun, ring, out]
output: out
load: {{speed: 1500 rpm, torque: 200 N*m}}
shift_elements:
  C1: [engine, sun]
  B1: [ring, housing]
  D1: {{links: [engine, ring], kind: dog_clutch}}
  F1: {{links: [ring, housing], kind: freewheel}}
mechanisms:
  P: {{first: sun, second: ring, third: out, ratio: -2.5, efficiency: 0.97}}
gears:
  troll: {{engaged: [B1], slip: {slip}}}
"""


def test_a_slip_with_a_unit_is_read_and_written_as_it_is() -> None:
    case = loads(TROLL.format(slip="{C1: 300 rpm}"))
    assert case.gears[0].slip == {1: pytest.approx(0.2)}
    assert solve(case).slip_losses_kW[0, 0] == pytest.approx(200 * 10 * math.pi / 1000)
    for text in (write_yaml(case), write_json(case)):
        assert loads(text) == case
        assert "300.0 rpm" in text


def test_slips_that_cannot_be_are_refused_at_their_places() -> None:
    for slip, said in (
        ("{B1: 0.1}", r"gears.troll.slip.B1: B1 is engaged and has a slip in this gear"),
        ("{D1: 0.1}", r"slip.D1: D1 is a dog clutch, which cannot slip under torque"),
        ("{F1: 0.1}", r"slip.F1: F1 is a freewheel, which cannot slip under torque"),
        ("{P: 0.1}", "read 'P', expected the name of a shift element"),
        ("{C1: .nan}", "read '.nan', expected a speed with its unit"),
        ("{C1: 1e999}", "read '1e999', expected a smaller number"),
        ("{C1: 5 N*m}", "relative to the input speed; this is a torque"),
        ("{C1: 1.1*sun}", r"read '1.1\*sun', expected a speed with its unit"),
        ("0.2", "expected a mapping: a number for each shift element"),
    ):
        with pytest.raises(ReadError, match=said):
            loads(TROLL.format(slip=slip))
    text = TROLL.format(slip="{C1: 300 rpm}").replace("speed: 1500 rpm, ", "")
    with pytest.raises(ReadError, match="read 300 rpm, but there is no input speed to relate it"):
        loads(text)
    for number, wrong, words in ((3, 0.1, "expected the number of a"), (1, math.inf, "read inf")):
        with pytest.raises(CaseError, match=words) as caught:
            two_shafts(0.1).replace(gears=[Gear(slip={number: wrong})])
        assert caught.value.problems[0].path == ("gears", 1, "slip", number)


def test_a_slip_and_an_equal_speed_are_both_named_as_redundant() -> None:
    case = two_shafts(0.2).replace(gears=[Gear(slip={1: 0.2}, speeds={2: 0.8})])
    said = str(solve(case).messages[0])
    assert "C, the input speed and the given speed of link 2 impose the same constraint" in said


DRAGGED = """\
links: [engine, shaft, out]
load: {{speed: {speed} rad/s, torque: {torque} N*m}}
shift_elements: {{C: [engine, shaft]}}
mechanisms: {{P: {{first: shaft, second: out, ratio: {ratio}, efficiency: 0.9}}}}
drag: {{engine: {drags[0]} N*m, shaft: {drags[1]} N*m}}
gears: {{creep: {{slip: {{C: {slip} rad/s}}}}}}
"""


@examples(20, 60, 600)
def test_torques_exist_even_if_a_clutch_would_drive_without_losses(examples: int) -> None:
    """Link by link: the clutch carries the torque of the engine less the drag before the clutch."""
    rng, kinds = seeded(57), set()
    for _ in range(examples):
        speed, torque = rng.choice([-1, 1]) * rng.uniform(50, 300), rng.uniform(-20, 20)
        drags, ratio = [rng.uniform(0, 12), rng.uniform(0, 12)], rng.choice([-3.0, 2.5])
        slips = np.array([rng.choice([-1, 1]) * rng.uniform(1, 350) for _ in range(3)])
        clutch = torque - math.copysign(drags[0], speed)
        pair = clutch - drags[1] * np.sign(speed - slips)
        out = pair * ratio * 0.9 ** np.sign(pair * (speed - slips))
        loses = clutch * slips >= 0
        text = DRAGGED.format(speed=speed, torque=torque, ratio=ratio, drags=drags, slip=slips[0])
        results = solve(loads(text), vary={"gears.creep.slip.C": slips})
        expected = np.transpose([np.full(3, clutch), pair, out])
        expected[~loses] = math.nan
        found, alone = results.lossy_torques_Nm[:, 0], solve(loads(text)).lossy_torques_Nm[0]
        assert found == pytest.approx(expected, abs=1e-9, nan_ok=True), text
        assert alone == pytest.approx(expected[0], abs=1e-9, nan_ok=True)
        kinds |= {*zip(loses.tolist(), (torque * slips >= 0).tolist(), strict=True)}
    assert len(kinds) == 4
