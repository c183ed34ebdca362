"""The solver against the exact oracle on random trains.

Expected numbers come from `oracle`: the same equations in rational arithmetic, written
independently. The trains hold everything at once: neutral and overdetermined gears,
given speeds and torques, several ports, both idle conventions, coasting.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

import pytest

from tests.chance import ranges_with_slow, seeded
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
    vectors: list[tuple[str, Sequence[float], Exact]] = [
        ("speeds", results.speeds[gear], exact.speeds),
        ("planet_speeds", results.planet_speeds[gear], exact.planet_speeds),
        ("slip_speeds", results.slip_speeds[gear], exact.slip_speeds),
        ("ratio", [results.ratio[gear]], [exact.ratio]),
        ("torques", results.torques[gear], exact.torques.listed),
        ("lossy_torques", results.lossy_torques[gear], exact.lossy_torques.listed),
        ("efficiency", [results.efficiency[gear]], [exact.efficiency]),
    ]
    if exact.consistent is not None and exact.lossy_torques.output is not None:
        vectors.append(("power_balance", [results.power_balance[gear]], [exact.power_balance]))
    if exact.losses:
        vectors.append(("losses", results.losses[gear], exact.losses))
    for name in ("holding_torques", "lossy_holding_torques"):
        held = getattr(exact, name)
        got = [getattr(results, name)[gear, link - 1] for link in held]
        vectors.append((name, got, [*held.values()]))
    signs = [None if one is None else Fraction(one) for one in exact.power_sign]
    vectors.append(("power_sign", results.power_sign[gear][: len(signs)], signs))
    for name, numbers, expected in vectors:
        for number, (one, other) in enumerate(zip(numbers, expected, strict=True), 1):
            yield f"{name}[{number}]", one, other


def _disagreements(case: Transmission) -> list[str]:
    results = solve(case)
    found = []
    for gear, exact in enumerate(oracle.solve(case)):
        found += [
            f"{name}: {got}, expected {expected}"
            for name, got, expected in _pairs(results, gear, exact)
            if not _same(got, expected)
        ]
        marks = {name: getattr(results, name)[gear] for name in ("missing", "excess", "tied_up")}
        marks |= {name: getattr(results, name)[gear] for name in ("consistent", "locked")}
        marks |= {"turned": results.turned[gear].any(), "several": results.choices[gear] > 1}
        expected_marks = {name: getattr(exact, name) for name in marks}
        expected_marks["consistent"] = bool(exact.consistent)
        found += [f"{name}: {one}" for name, one in marks.items() if one != expected_marks[name]]
    return found


@pytest.mark.parametrize("name", NASTY)
def test_the_nastiest_cases_agree(name: str) -> None:
    assert _disagreements(NASTY[name]) == []


def with_ones(seed: int, *, regular: bool = False) -> Transmission:
    """A random train with losses everywhere, many of whose ratios are 1."""
    rng = seeded(seed)
    case = random_train(rng, regular=regular)
    part = rng.choice((0.3, 0.6, 1.0))
    mechanisms = [
        one._replace(
            ratio=1.0 if rng.random() < part else one.ratio, efficiency=min(one.efficiency, 0.99)
        )
        for one in case.mechanisms
    ]
    return replace(case, mechanisms=mechanisms)


def of_variators(seed: int, *, regular: bool) -> Transmission:
    rng = seeded(seed)
    return with_variators(rng, random_train(rng, regular=regular))


KINDS: dict[str, Callable[..., Transmission]] = {
    "plain": lambda seed, regular: random_train(seeded(seed), regular=regular),
    "variators": of_variators,
    "ratios of 1": with_ones,
}


@pytest.mark.parametrize("kind", KINDS)
@ranges_with_slow(50, 120, 500, start=1000)
def test_every_number_is_that_of_exact_arithmetic(seeds: range, kind: str) -> None:
    """Every other train has one input, one output and the right count of conditions."""
    for seed in seeds:
        case = KINDS[kind](seed, regular=seed % 2 == 0)
        assert _disagreements(case) == [], (seed, shown(case))
