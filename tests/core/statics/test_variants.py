"""Arrays of variants: each of them gets what it would get alone, calculated with floats.

`test_against_oracle` compares single cases with exact arithmetic.
"""

import copy
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

import vstatics
from tests.chance import generator, ranges_with_slow, seeded
from tests.commands import CASES
from tests.core.statics.batches import (
    ARRAYS,
    KINDS,
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
from tests.core.statics.test_against_oracle import with_ones
from tests.core.statics.test_drag import much_drag
from tests.core.statics.test_efficiency import with_backs
from tests.core.statics.test_freewheels import with_freewheels
from tests.core.statics.test_springs import with_springs
from tests.oracle.cases import NASTY
from tests.trains import no_losses
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.core.annexes import KEYS
from vstatics.core.model.parts import Load
from vstatics.core.statics import variants


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
    assert not disagreements(case, u, eta, [*searched[:4].tolist(), *range(4)])


@ranges_with_slow(4, 30, 60, start=1000)
def test_random_trains(seeds: range) -> None:
    most, largest = (30, 12) if seeds.start else (6, 6)
    for seed in seeds:
        case, u, eta = random_case(seed, largest)
        tried = generator(seed).permutation(len(u))[:most]
        assert not disagreements(case, u, eta, tried.tolist()), seed


@ranges_with_slow(2, 12, 60)
def test_trains_of_all_kinds(seeds: range) -> None:
    """Of freewheels, drag, two efficiencies of a mechanism, springs, ratios of 1."""
    for make in (with_freewheels, much_drag, with_backs, with_springs, with_ones):
        for seed in seeds:
            case, rng = make(seed), generator(seed)
            u = ratios(rng, case, 12, KINDS[seed % len(KINDS)])
            eta = efficiencies(rng, case, 12, "any")
            assert not disagreements(case, u, None, range(4)), (make.__name__, seed)
            assert not disagreements(case, u, eta, range(4)), (make.__name__, seed)


def test_a_product_that_overflows_in_some_variants_does_not_exist_there() -> None:
    """200 pairs of ratio 1.5 are 1.5**200; of ratio 60 they are 1e355."""
    case = chain(200)
    u = np.full((8, 200), 1.5)
    u[3] = u[6] = 60.0
    assert not disagreements(case, u, variants=[0, 3])


def test_numbers_of_other_types_are_those_of_floats() -> None:
    """A speed of class numpy.float64, and whole numbers above 2**53, which floats round."""
    sets = [Mechanism(1, 2, 3, 1e200), Mechanism(3, 0, 4, 1e200, 0.97)]
    plain = Transmission(4, [ShiftElement(2)], sets, [Gear(speeds={2: 1e200})])
    with np.errstate(over="ignore"):
        numpy = replace(plain, gears=[Gear(speeds={2: np.float64(1e200)})])
        for case in (numpy, plain, numpy):
            assert same(plainly(case).speeds, plainly(plain).speeds)
            assert same(solve(case).speeds, plainly(plain).speeds)
    assert not np.isinf(plainly(numpy).speeds).any()
    for whole in range(-(2**53) - 7, -(2**53)):
        sets = [Mechanism(1, 2, 3, whole), Mechanism(3, 0, 4, -2.5, 0.97)]
        case = Transmission(4, [ShiftElement(2)], sets, [Gear([1])])
        u = np.stack([np.full(8, float(whole)), np.linspace(-2.5, -2.0, 8)], axis=1)
        assert not disagreements(case, u)


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
    for _ in range(12):
        for number in random.sample(range(len(made)), len(made)):
            case, u, eta = made[number]
            variant = random.randrange(len(u))
            own = with_numbers(case, u[variant], None if eta is None else eta[variant])
            single = solve(own)
            assert single.messages == plainly(own).messages
            results = solve(case, ratios=u, efficiencies=eta)
            for name in ARRAYS:
                assert alike(getattr(results, name), getattr(expected[number], name))
                assert alike(getattr(single, name), getattr(expected[number], name)[variant])


def test_plans_are_kept_for_a_number_of_gears_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(variants, "REMEMBERED", 5)
    with no_plans():
        for seed in range(10):
            case, u, _ = random_case(seed)
            solve(case, ratios=u[:2])
        assert len(variants._plans) == 5


@pytest.mark.slow
def test_threads_may_solve_at_the_same_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same case and others, with few plans kept so that they come and go."""
    monkeypatch.setattr(variants, "REMEMBERED", 5)
    made = [random_case(seed) for seed in (31, 33, 35, 37, 39)]
    expected = [solve(case, ratios=u, efficiencies=eta) for case, u, eta in made]

    def work(thread: int) -> None:
        for turn in range(8):
            number = (thread + turn * turn) % len(made)
            case, u, eta = made[number]
            order = generator(thread, turn).permutation(len(u))
            own = None if eta is None else eta[order]
            results = solve(case, ratios=u[order], efficiencies=own)
            for name in ARRAYS:
                assert alike(getattr(results, name), getattr(expected[number], name)[order]), name

    with ThreadPoolExecutor(6) as pool:
        list(pool.map(work, range(6)))


KEYED = Transmission(
    4,
    [ShiftElement(2, 0, "B", "brake"), ShiftElement(1, 2, "C", "clutch")],
    [Mechanism(1, 2, 3, -2.0, 0.97, 0.5, "P", 0.9)],
    [Gear([2], torques={2: 0.5}, drag={1: 0.1}, open_drag={2: 0.1})],
    output=3,
    springs=[Spring({3: 1, 4: -1}, stiffness=9e4, damping=3, name="S")],
    inertias={1: 0.15},
)


OTHER: dict[str, object] = {
    "open_drag": {2: 0.3},
    "capacity": 2.0,
    "load": Load(100.0, 9.0),
    "inertias": {1: 0.5},
    "masses": {2: 300.0},
    "points": ((0.0, 0.0), (0.1, 20.0)),
    "link_names": ("a", "b", "c", "d"),
    "balance": None,  # it acts as given torques, which are in the key
}
"""Another value of fields that may not be anything."""
DRAG = {ShiftElement: 0.5, Gear: {1: 0.2}, Transmission: {3: 0.2}}
PLACES: dict[Any, str] = {ShiftElement: "shift_elements", Mechanism: "mechanisms"}
PLACES |= {Spring: "springs", Gear: "gears"}
ELSEWHERE = {*PLACES.values(), "drawing", "_lowered"}
FIELDS = [(part, name) for part in PLACES for name in part._fields]
FIELDS += [(Transmission, one.name) for one in fields(Transmission) if one.name not in ELSEWHERE]


def with_field(part: type, name: str) -> Transmission:
    """The case with another value of a field, unchecked."""
    value = DRAG[part] if name == "drag" else OTHER.get(name, "X")
    made = copy.copy(KEYED)
    if part is Transmission:
        object.__setattr__(made, name, value)
    else:
        first, *others = getattr(KEYED, PLACES[part])
        parts = (first._replace(**{name: value}), *others)
        object.__setattr__(made, PLACES[part], parts)
    return made


def key(case: Transmission) -> tuple[object, ...]:
    gear = case.gears_with_drag[0]
    return (*variants._case_key(case), *variants._gear_key(case, gear))


def test_a_plan_serves_no_case_that_differs_in_a_field() -> None:
    """The key of plans changes with each field; those that are left out change no result."""
    expected = plainly(KEYED)
    varied = {(Mechanism, "ratio"), (Mechanism, "efficiency")}  # which are inputs of a plan
    for part, name in FIELDS:
        is_left_out = name in variants.WITHOUT_EFFECT[part]
        changed = with_field(part, name)
        assert (key(changed) == key(KEYED)) == (is_left_out or (part, name) in varied), name
        if is_left_out and name not in KEYS:
            found = plainly(changed)
            assert all(same(getattr(found, one), getattr(expected, one)) for one in ARRAYS), name
    for part, left_out in variants.WITHOUT_EFFECT.items():
        assert left_out - ELSEWHERE <= {name for own, name in FIELDS if own is part}
