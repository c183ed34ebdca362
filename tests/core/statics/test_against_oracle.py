"""The solver against the exact oracle on random trains.

Expected numbers come from `oracle`: the same equations in rational arithmetic, written
independently. The trains hold everything at once: neutral and overdetermined gears,
given speeds and torques, several ports, both idle conventions, coasting.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

import pytest

from tests.chance import count, seeded
from tests.oracle import gears as oracle
from tests.oracle.cases import NASTY
from tests.oracle.gears import OracleGear
from tests.trains import random_train, shown, with_variators
from vstatics import Results, Transmission, solve

TOLERANCE = 1e-9
"""Relative to the number, or to 1: the input is 1."""

Exact = Sequence[Fraction | None]


def _same(got: float, expected: Fraction | None) -> bool:
    if expected is None:
        return math.isnan(got)
    return abs(got - float(expected)) <= TOLERANCE * max(1.0, abs(float(expected)))


def _pairs(
    results: Results, gear: int, exact: OracleGear
) -> Iterator[tuple[str, float, Fraction | None]]:
    """Every number of a gear beside the exact one."""
    vectors: list[tuple[str, Sequence[float], Exact]] = [
        ("speeds", results.speeds[gear], exact.speeds),
        ("planet_speeds", results.planet_speeds[gear], exact.planet_speeds),
        ("slip_speeds", results.slip_speeds[gear], exact.slip_speeds),
        ("ratio", [results.ratio[gear]], [exact.ratio]),
        ("torques", results.torques[gear], exact.torques.listed),
    ]
    vectors += [
        ("lossy_torques", results.lossy_torques[gear], exact.lossy_torques.listed),
        ("efficiency", [results.efficiency[gear]], [exact.efficiency]),
    ]
    if exact.consistent is not None and exact.lossy_torques.output is not None:
        vectors.append(("power_balance", [results.power_balance[gear]], [exact.power_balance]))
    if exact.losses:
        vectors.append(("losses", results.losses[gear], exact.losses))
    for name, got, expected in vectors:
        for number, (one, other) in enumerate(zip(got, expected, strict=True), 1):
            yield f"{name}[{number}]", one, other
    for link, torque in exact.holding_torques.items():
        yield f"holding torque of {link}", results.holding_torques[gear, link - 1], torque
    for link, torque in exact.lossy_holding_torques.items():
        got = results.lossy_holding_torques[gear, link - 1]
        yield f"lossy holding torque of {link}", got, torque


def _disagreements(case: Transmission) -> list[str]:
    """What differs, in words."""
    results = solve(case)
    found = []
    for gear, exact in enumerate(oracle.solve(case)):
        found += [
            f"{name}: {got}, expected {expected}"
            for name, got, expected in _pairs(results, gear, exact)
            if not _same(got, expected)
        ]
        states = {
            "tied_up": (results.tied_up[gear], exact.tied_up),
            "missing": (results.missing[gear], exact.missing),
            "excess": (results.excess[gear], exact.excess),
            "consistent": (results.consistent[gear], bool(exact.consistent)),
            "locked": (results.locked[gear], exact.locked),
            "turned": (results.turned[gear].any(), exact.turned),
            "several": (results.choices[gear] > 1, exact.several),
        }
        found += [f"{name}: {a}, expected {b}" for name, (a, b) in states.items() if a != b]
        for number, (sign, exact_sign) in enumerate(
            zip(results.power_sign[gear], exact.power_sign, strict=False)
        ):
            if not _same(sign, None if exact_sign is None else Fraction(exact_sign)):
                found.append(f"power_sign[{number + 1}]: {sign}, expected {exact_sign}")
    return found


@pytest.mark.parametrize("name", NASTY)
def test_the_nastiest_cases_agree(name: str) -> None:
    assert _disagreements(NASTY[name]) == []


@pytest.mark.parametrize("regular", [False, True], ids=["any gears", "one input, one output"])
def test_every_number_is_that_of_exact_arithmetic(*, regular: bool) -> None:
    for seed in range(25):
        case = random_train(seeded(seed), regular=regular)
        assert _disagreements(case) == [], (seed, shown(case))


def test_trains_with_variators_are_those_of_exact_arithmetic() -> None:
    tried = 0
    for seed in range(80):
        rng = seeded(seed)
        case = with_variators(rng, random_train(rng, regular=seed % 2 == 0))
        if any(one.kind for one in case.mechanisms):
            tried += 1
            assert _disagreements(case) == [], (seed, shown(case))
    assert tried >= 20


@pytest.mark.slow
@pytest.mark.parametrize("block", range(2))
def test_every_number_is_that_of_exact_arithmetic_at_length(block: int) -> None:
    size = count(60, 250)
    for seed in range(10_000 + size * block, 10_000 + size * (block + 1)):
        case = random_train(seeded(seed), regular=seed % 2 == 0)
        assert _disagreements(case) == [], (seed, shown(case))
