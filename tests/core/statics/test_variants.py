"""Arrays of variants: each of them gets what it would get alone, to the last bit.

The first half compares `solve` with itself, an array of variants with every variant
alone, calculated with floats: that is the promise. The second half does not trust
it: closed forms, equilibrium and power, and the exact oracle.
"""

from __future__ import annotations

import copy
import math
import threading
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import vstatics
from tests.chance import count, generator, seeded, some
from tests.commands import CASES, SHIPPED
from tests.core.statics.batches import (
    ARRAYS,
    KINDS,
    LOSSES,
    alike,
    chain,
    disagreements,
    efficiencies,
    no_plans,
    plainly,
    random_case,
    ratios,
    same,
    with_numbers,
)
from tests.installed import HERE
from tests.oracle import gears as oracle
from tests.oracle.cases import NASTY
from tests.trains import is_regular, no_losses, random_train
from vstatics import Damping, Gear, Mechanism, Results, ShiftElement, Spring, Transmission, solve
from vstatics.core.annexes import KEYS
from vstatics.core.model.converters import Converter
from vstatics.core.model.parts import Friction, Load
from vstatics.core.model.struts import Strut
from vstatics.core.model.transmission import IdleConvention
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics import variants

CONVENTIONS: list[tuple[bool, IdleConvention]] = [
    (False, "exact"),
    (True, "exact"),
    (False, "published"),
    (True, "published"),
]


# -- variants together are variants alone ------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("path", some(SHIPPED), ids=lambda path: path.name)
def test_shipped_cases(path: Path) -> None:
    case = vstatics.load(path)
    rng = generator(1)
    for number, (coast, idle) in enumerate(CONVENTIONS):
        own = replace(case, coast=coast, idle=idle)
        u = ratios(rng, own, 3, ("ordinary", "near 1", "coincidences", "extreme")[number])
        assert not disagreements(own, u, efficiencies(rng, own, 3, LOSSES[number]))


@pytest.mark.slow
@pytest.mark.parametrize("name", NASTY)
def test_trains_that_are_easily_wrong(name: str) -> None:
    """Locked trains, redundant ones, flows that losses turn, idle mechanisms, ports."""
    case = NASTY[name]
    rng = generator(2, len(name))
    for kind in ("nearly the same", "ordinary", "coincidences"):
        u = ratios(rng, case, 8, kind)
        u[3] = u[7] = [mechanism.ratio for mechanism in case.mechanisms]
        assert not disagreements(case, u)
        assert not disagreements(case, u, efficiencies(rng, case, 8, "some 1"))
    assert not disagreements(case, None, efficiencies(rng, case, 12, "nearly 1"))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["mzkt7922.dat", "power-split.yaml"])
def test_variants_that_do_not_go_alike_run_on_arrays(name: str) -> None:
    """Ratios by up to a factor of 4, of any sign: of 1,500 variants few are left alone."""
    case = vstatics.load(CASES / name)
    rng = generator(4)
    shape = (1500, len(case.mechanisms))
    factors = 4 ** rng.uniform(-1, 1, shape) * rng.choice((-1, 1), shape)
    u = factors * [mechanism.ratio for mechanism in case.mechanisms]
    eta = rng.uniform(0.9, 0.99, shape)
    with no_plans():
        together = solve(case, ratios=u, efficiencies=eta)
        alone = sum(plans.alone for plans in variants._plans.values())
    assert alone <= 0.01 * len(u) * len(case.gears)
    searched = np.flatnonzero(together.turned.any(axis=(1, 2)) | together.locked.any(axis=1))
    assert searched.size > 10
    some = [*searched[:4].tolist(), *range(4)]
    assert not disagreements(case, u, eta, some)


def check_random(seed: int, most: int, largest: int = 6) -> None:
    case, u, eta = random_case(seed, largest)
    some = generator(seed).permutation(len(u))[:most]
    assert not disagreements(case, u, eta, some.tolist())


@pytest.mark.parametrize("seed", range(4))
def test_random_trains(seed: int) -> None:
    check_random(seed, most=6)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1000, 1000 + count(12, 30)))
def test_many_random_trains(seed: int) -> None:
    check_random(seed, most=30, largest=12)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("path", "kind"),
    [(path, kind) for n, path in enumerate(some(SHIPPED)) for kind in KINDS[n % 8 :: 8]],
    ids=lambda one: getattr(one, "name", one),
)
def test_many_variants_of_shipped_cases(path: Path, kind: str) -> None:
    case = vstatics.load(path)
    rng = generator(3, KINDS.index(kind))
    u = ratios(rng, case, 48, kind)
    tried = rng.permutation(48)[:3].tolist()
    assert not disagreements(case, u, efficiencies(rng, case, 48, "some 1"), tried)


@pytest.mark.slow
@pytest.mark.parametrize("place", [2, 4])
def test_ratios_near_those_that_make_a_train_singular(place: int) -> None:
    """Two sets on one pair of links: with equal ratios the output is held or free."""
    elements = [ShiftElement(2), ShiftElement(4)]
    sets = [Mechanism(1, 2, 3, -2.0, 0.97), Mechanism(1, 2, 3, -2.5, 0.96)]
    loop = Transmission(3, [ShiftElement(2)], sets, [Gear(), Gear([1])])
    split = [Mechanism(1, 2, 3, -2.0, 0.97), Mechanism(1, 2, 4, -2.5, 0.96)]
    two = Transmission(4, elements, split, [Gear([1]), Gear([2])], output=3)
    for case in (loop, two):
        first = np.full(34, -2.0)
        gaps = 10.0 ** -np.arange(0, 17)
        second = first * np.concatenate([1 + gaps, 1 - gaps / 2])
        second[place::7] = -2.0
        u = np.stack([first, second], axis=1)
        assert not disagreements(case, u)
        assert not disagreements(case, u[::-1])


@pytest.mark.slow
def test_ratios_near_1() -> None:
    case = Transmission(
        4,
        [ShiftElement(2), ShiftElement(1, 3)],
        [Mechanism(1, 2, 3, 1.5, 0.98), Mechanism(3, 0, 4, 1.25, 0.97)],
        [Gear([1]), Gear([2])],
    )
    gaps = 10.0 ** -np.arange(0, 17)
    near = np.concatenate([1 + gaps, 1 - gaps / 2])
    near = near[near != 1]
    for other in (1.25, 1.0, 1 + 1e-10):
        assert not disagreements(case, np.stack([near, np.full(near.size, other)], axis=1))
    assert not disagreements(case, np.stack([near, near[::-1]], axis=1))


def test_efficiencies_of_1_among_others() -> None:
    case = vstatics.load(SHIPPED[0])
    count = len(case.mechanisms)
    eta = np.full((3 * count, count), 0.96)
    for variant in range(3 * count):
        eta[variant, variant % count] = (1.0, 1 - 2**-53, 0.5)[variant % 3]
    assert not disagreements(case, None, eta)
    assert not disagreements(case, None, np.ones((6, count)))


@pytest.mark.parametrize("count", [1, 2, 4, 5, 6, 9])
def test_few_variants(count: int) -> None:
    case, _, _ = random_case(5)
    rng = generator(4)
    for _ in range(8):
        u = ratios(rng, case, count, "ordinary")
        assert not disagreements(case, u, efficiencies(rng, case, count, "any"), [0])


# -- whatever came before -------------------------------------------------------------


@pytest.mark.slow
def test_calls_in_any_order_give_the_same() -> None:
    """Cases of one structure share their plans; singles get them too when they come often."""
    made = [random_case(seed) for seed in range(20, 28)]
    made += [(replace(case, coast=not case.coast), u, eta) for case, u, eta in made[:4]]
    made += [(no_losses(case), u, None) for case, u, _ in made[:4]]
    made += [(case, u[:, ::1] * 1.001, eta) for case, u, eta in made[:4] if (u != 1).all()]
    expected = []
    for case, u, eta in made:
        with no_plans():
            expected.append(solve(case, ratios=u, efficiencies=eta))
    random = seeded(1)
    for _ in range(3):
        order = list(range(len(made)))
        random.shuffle(order)
        for number in order:
            case, u, eta = made[number]
            variant = random.randrange(len(u))
            own = with_numbers(case, u[variant], None if eta is None else eta[variant])
            single = solve(own)
            results = solve(case, ratios=u, efficiencies=eta)
            for name in ARRAYS:
                assert alike(getattr(results, name), getattr(expected[number], name))
                assert alike(getattr(single, name), getattr(expected[number], name)[variant])


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_singles_that_come_often_stay_the_same(seed: int) -> None:
    """After a few calls a plan serves them; messages and numbers are those of the first."""
    case, _, _ = random_case(seed)
    first = plainly(case)
    for _ in range(12):
        again = solve(case)
        assert again.messages == first.messages
        assert all(same(getattr(again, name), getattr(first, name)) for name in ARRAYS)
    rng = generator(6, seed)
    for kind in ("ordinary", "coincidences", "near 1"):
        for u in ratios(rng, case, 6, kind):
            own = with_numbers(case, u, None)
            one, other = plainly(own), solve(own)
            assert other.messages == one.messages
            assert all(same(getattr(other, name), getattr(one, name)) for name in ARRAYS)


CHANGES: list[Callable[[Transmission], Transmission]] = [
    lambda case: replace(case, coast=True),
    lambda case: replace(case, idle="published"),
    lambda case: replace(case, input=4),
    lambda case: replace(case, output=2),
    lambda case: replace(case, links=6, link_names=()),
    lambda case: replace(case, gears=[case.gears[0]._replace(output=2)]),
    lambda case: replace(case, gears=[case.gears[0]._replace(input=5, output=1)]),
    lambda case: replace(case, gears=[case.gears[0]._replace(speeds={4: 0.5}, engaged=())]),
    lambda case: replace(case, gears=[case.gears[0]._replace(speeds={4: -0.5}, engaged=())]),
    lambda case: replace(case, gears=[case.gears[0]._replace(torques={3: 0.5})]),
    lambda case: replace(case, gears=[case.gears[0]._replace(torques={3: -0.5})]),
    lambda case: replace(case, gears=[case.gears[0]._replace(engaged=[2])]),
    lambda case: replace(case, gears=[case.gears[0]._replace(engaged=[])]),
    lambda case: replace(case, shift_elements=case.shift_elements[::-1]),
    lambda case: replace(case, gears=[*case.gears, Gear(speeds={4: 0.5})]),
    lambda case: replace(
        case, mechanisms=[case.mechanisms[0]._replace(planet_ratio=2.0), *case.mechanisms[1:]]
    ),
    lambda case: replace(
        case, mechanisms=[case.mechanisms[0]._replace(first=2, second=1), *case.mechanisms[1:]]
    ),
    lambda case: replace(
        case, mechanisms=[case.mechanisms[0]._replace(efficiency=0.9), *case.mechanisms[1:]]
    ),
    lambda case: replace(
        case, mechanisms=[case.mechanisms[0]._replace(ratio=-2.0), *case.mechanisms[1:]]
    ),
    lambda case: replace(case, mechanisms=case.mechanisms[::-1]),
]


def test_cases_that_differ_in_anything_do_not_share_plans() -> None:
    case = Transmission(
        5,
        [ShiftElement(4), ShiftElement(1, 3)],
        [Mechanism(1, 2, 3, -2.5, 0.97), Mechanism(2, 4, 5, -1.5, 0.96), Mechanism(3, 5, 0, 1.25)],
        [Gear([1]), Gear([2])],
    )
    made = [case, *(change(case) for change in CHANGES)]
    rng = generator(7)
    u = ratios(rng, case, 8, "ordinary")
    eta = efficiencies(rng, case, 8, "any")
    expected = []
    for own in made:
        with no_plans():
            expected.append([solve(own, ratios=u), solve(own, efficiencies=eta), solve(own)])
    with no_plans():
        for _ in range(2):
            for own, wanted in zip(made, expected, strict=True):
                found = [solve(own, ratios=u), solve(own, efficiencies=eta), solve(own)]
                for one, other in zip(found, wanted, strict=True):
                    assert all(same(getattr(one, n), getattr(other, n)) for n in ARRAYS)


def test_plans_are_kept_for_a_number_of_gears_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(variants, "REMEMBERED", 20)
    with no_plans():
        for seed in range(40):
            case, u, _ = random_case(seed)
            solve(case, ratios=u[:2])
        assert len(variants._plans) == 20


@pytest.mark.slow
def test_threads_may_solve_at_the_same_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same case and others, with few plans kept so that they come and go."""
    monkeypatch.setattr(variants, "REMEMBERED", 5)
    made = [random_case(seed) for seed in (31, 33, 35, 37, 39)]
    expected = [solve(case, ratios=u, efficiencies=eta) for case, u, eta in made]
    wrong: list[str] = []

    def work(thread: int) -> None:
        try:
            for turn in range(8):
                number = (thread + turn * turn) % len(made)
                case, u, eta = made[number]
                order = generator(thread, turn).permutation(len(u))
                results = solve(
                    case, ratios=u[order], efficiencies=None if eta is None else eta[order]
                )
                wrong.extend(
                    name
                    for name in ARRAYS
                    if not alike(getattr(results, name), getattr(expected[number], name)[order])
                )
        except Exception as error:  # noqa: BLE001 any failure is told below
            wrong.append(repr(error))

    threads = [threading.Thread(target=work, args=(number,)) for number in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


# -- numbers at the ends -----------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("size", [5e-324, 1e-308, 1e-150, 1e-12, 1e12, 1e150, 1e308])
def test_one_extreme_variant_harms_no_other(size: float) -> None:
    case = vstatics.load(CASES / "two-stage.yaml")
    rng = generator(8)
    for place in (0, 3, 9):
        u = ratios(rng, case, 10, "ordinary")
        u[place] = np.copysign(size, u[place])
        assert not disagreements(case, u)
        u[place, 1:] = ratios(rng, case, 1, "ordinary")[0, 1:]
        assert not disagreements(case, u)


@pytest.mark.slow
@pytest.mark.parametrize("count", [3, 40])
@pytest.mark.parametrize("coast", [False, True])
def test_trains_of_many_mechanisms(count: int, coast: bool) -> None:
    case = replace(chain(count), coast=coast)
    rng = generator(9)
    for kind in ("ordinary", "wide", "powers of ten"):
        u = ratios(rng, case, 8, kind)
        assert not disagreements(case, u, efficiencies(rng, case, 8, "any"))


def test_a_product_that_overflows_in_some_variants_does_not_exist_there() -> None:
    """200 pairs of ratio 1.5 are 1.5**200; of ratio 60 they are 1e355."""
    case = chain(200)
    u = np.full((8, 200), 1.5)
    u[3] = u[6] = 60.0
    assert not disagreements(case, u, variants=[0, 3])


# -- what was wrong once -----------------------------------------------------------------


def test_open_torques_that_losses_determine() -> None:
    """The balance of guesses is a rest, with which nothing can be done on a tape."""
    sets = [Mechanism(1, 2, 4, -1.5, 0.99), Mechanism(3, 2, 0, 0.95, 0.991)]
    sets += [Mechanism(1, 3, 4, -1.8, 0.99)]
    case = Transmission(4, [], sets, [Gear(input=3, output=2)], coast=True)
    u = np.full((6, 3), 1e6)
    u[:, 1] = 1.0
    eta = np.array([1.0, 0.456, 0.919]) ** np.linspace(1, 1.01, 6)[:, None]
    assert not disagreements(case, u, eta)


def test_numbers_from_an_array_are_numbers() -> None:
    """Speeds of class numpy.float64, which cases of the same structure share plans with."""
    sets = [Mechanism(1, 2, 3, 1e200), Mechanism(3, 0, 4, 1e200, 0.97)]
    plain = Transmission(4, [ShiftElement(2)], sets, [Gear(speeds={2: 1e200})])
    with np.errstate(over="ignore"):
        numpy = replace(plain, gears=[Gear(speeds={2: np.float64(1e200)})])
        for case in (numpy, plain, numpy):
            assert same(plainly(case).speeds, plainly(plain).speeds)
            assert same(solve(case).speeds, plainly(plain).speeds)
    assert not np.isinf(plainly(numpy).speeds).any()


def test_whole_numbers_too_large_for_a_float_are_rounded_alike() -> None:
    for excess in range(1, 8):
        whole = -(2**53) - excess
        sets = [Mechanism(1, 2, 3, whole), Mechanism(3, 0, 4, -2.5, 0.97)]
        case = Transmission(4, [ShiftElement(2)], sets, [Gear([1])])
        u = np.stack([np.full(8, float(whole)), np.linspace(-2.5, -2.0, 8)], axis=1)
        assert not disagreements(case, u)


def test_a_fixed_number_that_overflows_beside_others_that_vary() -> None:
    """Ratios with losses are 1e320 and more, and what is made of them is no number."""
    sets = [
        Mechanism(5, 3, 1, -0.1, 1e-320, 2.95),
        Mechanism(5, 4, 3, 1.9, 1e-100),
        Mechanism(8, 1, 6, -2.1),
        Mechanism(6, 0, 0, 2.1, 1e-12),
        Mechanism(5, 8, 7, -1.0, 1.0, 1.51),
        Mechanism(2, 7, 0, -2.1),
    ]
    gear = Gear(speeds={4: 1.0}, torques={1: -1.3, 2: 1.57})
    case = Transmission(8, [], sets, [gear], idle="published")
    u = np.tile([mechanism.ratio for mechanism in sets], (6, 1))
    u[:, [2, 4, 5]] *= np.linspace(0.9, 1.1, 6)[:, None]
    assert not disagreements(case, u)


@pytest.mark.slow
@pytest.mark.parametrize("excess", [1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-8, 1e-7])
def test_what_turns_as_one_piece_beside_a_fixed_number(excess: float) -> None:
    """(u - 1)/(u - 1) is 1 for all variants; how certain it is hangs on u all the same."""
    sets = [Mechanism(1, 2, 3, 1.01), Mechanism(1, 4, 0, 1 + excess)]
    elements = [ShiftElement(1, 2), ShiftElement(3, 4)]
    case = Transmission(4, elements, sets, [Gear([1]), Gear([1, 2])], output=3)
    for first in (1.01, 1.5, 1.0001):
        u = np.stack([np.linspace(first, first * 1.01, 8), np.full(8, 1 + excess)], axis=1)
        assert not disagreements(case, u)


# -- what is true of any train -------------------------------------------------------------


def planetary(u: Floats | float, eta: Floats | float = 1.0) -> tuple[Transmission, Floats, Floats]:
    """Sun 1, ring 2, carrier 3; ring held, sun held and all as one, carrier out or ring out."""
    case = Transmission(
        3,
        [ShiftElement(2), ShiftElement(1, 2), ShiftElement(3)],
        [Mechanism(1, 2, 3, -2.0, 0.97)],
        [
            Gear([1], name="ring held"),
            Gear([2], name="one piece"),
            Gear([3], output=2, name="carrier held"),
            Gear([1], input=3, output=1, name="ring held, carrier in"),
        ],
    )
    u, eta = np.broadcast_arrays(u, eta)
    return case, u[..., None], eta[..., None]


def test_a_planetary_set_has_its_closed_form() -> None:
    """The ratio is 1 - u with the ring held, eta = (1 - u eta)/(1 - u), Willis; 1 as one piece."""
    u, eta = np.linspace(-5, -0.2, 97), np.linspace(0.9, 1, 97)[::-1]
    case, ratio, efficiency = planetary(u, eta)
    results = solve(case, ratios=ratio, efficiencies=efficiency)
    held = 1 - u
    expected = np.stack([held, np.ones(97), u, 1 / held], axis=1)
    np.testing.assert_allclose(results.ratio, expected, rtol=1e-14)
    np.testing.assert_allclose(results.output_torque, expected, rtol=1e-14)
    efficiencies_ = [(1 - u * eta) / (1 - u), np.ones(97), eta, (1 - u) / (1 - u / eta)]
    np.testing.assert_allclose(results.efficiency, np.stack(efficiencies_, axis=1), rtol=1e-14)
    np.testing.assert_allclose(results.lossy_torques[:, 0, -1], 1 - u * eta, rtol=1e-14)
    assert results.consistent.all()
    assert results.idle[:, 1].all()
    assert not results.idle[:, [0, 2, 3]].any()
    lost = 1 - results.efficiency
    np.testing.assert_allclose(results.losses[..., 0], lost, rtol=1e-12, atol=1e-15)


def test_a_set_that_locks_when_coasting() -> None:
    """Sun drives, ring held, carrier out: eta = (u eta_0 - 1)/(u - 1), locked where it is none.

    Power enters by the first link, seen from the carrier, as u/(u - 1) > 0.
    """
    u = np.linspace(1.01, 1.5, 50)
    case, ratio, eta = planetary(u, 0.8)
    results = solve(case, ratios=ratio, efficiencies=eta, coast=True)
    moves = u * 0.8 > 1
    assert moves.any()
    assert not moves.all()
    assert np.array_equal(results.locked[:, 3], ~moves)
    expected = (u[moves] * 0.8 - 1) / (u[moves] - 1)
    np.testing.assert_allclose(results.efficiency[moves, 3], expected, rtol=1e-13)
    assert np.isnan(results.efficiency[~moves, 3]).all()


@pytest.mark.parametrize("seed", range(20))
def test_output_torque_times_output_speed_is_1_without_losses(seed: int) -> None:
    """Power in is power out, in gears of one input and one output."""
    case = random_train(seeded(seed), regular=True, gears=3)
    results = solve(case, ratios=ratios(generator(10, seed), case, 200, "ordinary"))
    for number, gear in enumerate(case.gears):
        if not gear.speeds and not gear.torques and is_regular(case, gear):
            speed = results.speeds[:, number, case.gear_output(gear) - 1]
            power = results.output_torque[:, number] * speed
            np.testing.assert_allclose(power[~np.isnan(power)], 1, rtol=1e-7)


@pytest.mark.parametrize("seed", range(20))
def test_power_is_balanced_and_friction_takes_it(seed: int) -> None:
    """Losses take power, so the efficiency lies between 0 and 1 where power passes through.

    Coasting turns all flows: losses are below 0 in units of the input torque.
    """
    case = random_train(seeded(100 + seed), regular=True, gears=3)
    rng = generator(11, seed)
    u, eta = ratios(rng, case, 100, "ordinary"), efficiencies(rng, case, 100, "any")
    results = solve(case, ratios=u, efficiencies=eta)
    there = results.consistent
    size = 1 + np.nan_to_num(np.abs(results.lossy_torques)).max(axis=-1)
    assert (np.abs(np.nan_to_num(results.power_balance)) <= 1e-9 * size)[there].all()
    losses = np.nan_to_num(results.losses) * (-1 if case.coast else 1)
    assert (losses >= -1e-9 * size[..., None])[there].all()
    single = [not gear.speeds and not gear.torques for gear in case.gears]
    found = results.efficiency[:, single][there[:, single]]
    found = found[~np.isnan(found)]
    assert ((found > 0) & (found <= 1 + 1e-9)).all()


@pytest.mark.parametrize("seed", range(10))
def test_losses_that_are_none_change_nothing(seed: int) -> None:
    case = random_train(seeded(200 + seed))
    u = ratios(generator(12, seed), case, 50, "ordinary")
    results = solve(case, ratios=u, efficiencies=np.ones(u.shape))
    there = results.calculable & results.consistent
    np.testing.assert_allclose(results.lossy_torques[there], results.torques[there], rtol=1e-9)
    assert not np.nan_to_num(results.losses).any()
    assert not results.locked.any()


EXACT = 1e-9
"""Relative to the number, or to 1: the input is 1."""


def agree(found: Sequence[float], exact: Sequence[Fraction | None]) -> bool:
    return all(
        math.isnan(number)
        if value is None
        else abs(number - float(value)) <= EXACT * max(1.0, abs(float(value)))
        for number, value in zip(found, exact, strict=True)
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(300, 300 + count(6, 12)))
def test_variants_are_those_of_the_exact_oracle(seed: int) -> None:
    """Short decimals of both signs, so that coincidences happen, in rational arithmetic."""
    case = random_train(seeded(seed))
    u = ratios(generator(13, seed), case, 30, "short decimals")
    results = solve(case, ratios=u)
    for variant in (0, 11, 29):
        for number, exact in enumerate(oracle.solve(with_numbers(case, u[variant], None))):
            check_exact(results, (variant, number), exact)


def check_exact(results: Results, place: tuple[int, int], exact: oracle.OracleGear) -> None:
    """A gear of a variant beside the exact one."""
    assert agree(results.speeds[place], exact.speeds)
    assert agree(results.slip_speeds[place], exact.slip_speeds)
    assert agree(results.planet_speeds[place], exact.planet_speeds)
    assert agree([results.ratio[place]], [exact.ratio])
    assert agree(results.torques[place], exact.torques.listed)
    assert results.missing[place] == exact.missing
    assert results.excess[place] == exact.excess
    assert results.tied_up[place] == exact.tied_up
    assert results.locked[place] == exact.locked
    if not exact.several:
        assert agree(results.lossy_torques[place], exact.lossy_torques.listed)
        assert agree([results.efficiency[place]], [exact.efficiency])
        assert agree(results.losses[place], exact.losses)


# -- the key of plans ----------------------------------------------------------------------

KEYED = Transmission(
    4,
    [ShiftElement(2, 0, "B", "brake"), ShiftElement(1, 2, "C", "clutch")],
    [Mechanism(1, 2, 3, -2.0, 0.97, 0.5, "P", 0.9)],
    [Gear([1], torques={2: 0.5}, drag={1: 0.1}, open_drag={2: 0.1})],
    output=3,
    springs=[Spring({3: 1, 4: -1}, stiffness=9e4, damping=3, name="S")],
    inertias={1: 0.15},
)


def of_annexes() -> dict[str, object]:
    """Return data of annexes, which a case carries without knowing what they are."""
    found: dict[str, object] = dict.fromkeys(("dump", "vehicle", "fatigue"), object())
    if "torsion" in HERE:
        from vstatics import ClutchDump

        found["dump"] = ClutchDump([1], [2], [], [3], [4], M_C0=180.0, omega1=600.0)
    if "vehicle" in HERE:
        from vstatics import Fatigue, Vehicle

        found["vehicle"] = Vehicle(1000.0, 0.3)
        found["fatigue"] = {"axle": Fatigue(1e8, 3.0, 4e6, diameter=0.042)}
    return found


OTHER: dict[type, dict[str, object]] = {
    ShiftElement: {
        "first": 3,
        "second": 4,
        "name": "X",
        "kind": "freewheel",
        "drag": 0.5,
        "capacity": 2.0,
        "stiffness": 9e4,
        "damping": Damping(3.0),
        "static": 1.2,
        "friction": Friction(0.1, 0.006, 8, ((0.0, 0.12),)),
    },
    Mechanism: {
        "kind": "variator",
        "points": ((0.0, 2.0),),
        "first": 4,
        "second": 4,
        "third": 4,
        "ratio": -3.0,
        "efficiency": 0.5,
        "name": "X",
        "planet_ratio": 0.25,
        "back_efficiency": 0.5,
        "stiffness": 9e4,
        "damping": Damping(3.0),
        "is_set": True,
    },
    Spring: {
        "twist": ((3, 1.0), (4, -2.0)),
        "stiffness": 1.0,
        "compliance": 1.0,
        "damping": Damping(5.0),
        "name": "X",
        "limit": 3000.0,
        "points": ((0.0, 0.0), (0.1, 30.0)),
        "friction": 14.0,
        "strut": Strut(3e6, 0.02, 0.1, 1.0),
    },
    Gear: {
        "speed_ratios": {1: 0.5},
        "engaged": (),
        "speeds": {4: 0.5},
        "torques": {2: 0.25},
        "input": 2,
        "output": 4,
        "name": "X",
        "drag": {1: 0.2},
        "open_drag": {2: 0.3},
        "load": Load(100.0, 9.0),
        "input_turns": "backward",
        "kind": "point",
        "coast": True,
        "balance": None,  # it acts as given torques, which are in the key
        "holding": (2,),
    },
    Transmission: {
        "links": 5,
        "input": 2,
        "output": 4,
        "outputs": (4, 3),
        "name": "X",
        "description": "X",
        "source": "X",
        "idle": "published",
        "coast": True,
        "link_names": ("a", "b", "c", "d"),
        "load": Load(100.0, 9.0),
        "allow": ("W201",),
        "hushed": ("W201",),
        "inertias": {1: 0.5},
        "masses": {2: 300.0},
        "cylinders": 6,
        "drag": {3: 0.2},
        "converters": (Converter("TC", 1, 2, ((0.0, 2.0, 0.003), (1.0, 1.0, 0.0))),),
        **of_annexes(),
    },
}
"""Another value of each field; what is made of parts or of a drawing is tried elsewhere."""
VARIED = {"ratio", "efficiency"}
"""Of a mechanism: a plan takes them as its inputs."""
ELSEWHERE = {"shift_elements", "mechanisms", "springs", "gears", "drawing", "_lowered"}


def with_field(part: type, name: str) -> Transmission:
    """The case with another value of a field, unchecked."""
    value = OTHER[part][name]
    if part is Transmission:
        made = copy.copy(KEYED)
        object.__setattr__(made, name, value)
        return made
    where = {
        ShiftElement: "shift_elements",
        Mechanism: "mechanisms",
        Spring: "springs",
        Gear: "gears",
    }[part]
    first, *others = getattr(KEYED, where)
    made = copy.copy(KEYED)
    object.__setattr__(made, where, (first._replace(**{name: value}), *others))
    return made


def key(case: Transmission) -> tuple[object, ...]:
    gear = case.with_all_drag(case.gears[0])
    return (*variants._case_key(case), *variants._gear_key(case, gear))


FIELDS = [(part, name) for part, names in OTHER.items() for name in names]


@pytest.mark.parametrize(
    ("part", "name"), FIELDS, ids=[f"{part.__name__}.{name}" for part, name in FIELDS]
)
def test_a_plan_serves_no_case_that_differs_in_a_field(part: type, name: str) -> None:
    """The key of plans changes with each field, but those that are named as left out."""
    left_out = variants.WITHOUT_EFFECT[part] | (VARIED if part is Mechanism else set())
    changed = with_field(part, name)
    assert (key(changed) == key(KEYED)) == (name in left_out)


def test_every_field_is_tried() -> None:
    """A new field fails here until it has a line above."""
    for part in (ShiftElement, Mechanism, Spring, Gear):
        assert set(OTHER[part]) == set(part._fields)
    own = {one.name for one in fields(Transmission)}
    assert set(OTHER[Transmission]) == own - ELSEWHERE
    for one, left_out in variants.WITHOUT_EFFECT.items():
        assert left_out <= set(OTHER[one]) | ELSEWHERE


@pytest.mark.parametrize("part", OTHER)
def test_fields_that_are_left_out_have_no_effect(part: type) -> None:
    expected = plainly(KEYED)
    absent = {name for name, annex in KEYS.items() if annex not in HERE}
    for name in (variants.WITHOUT_EFFECT[part] & set(OTHER[part])) - absent:
        found = plainly(with_field(part, name))
        assert all(same(getattr(found, one), getattr(expected, one)) for one in ARRAYS), name
