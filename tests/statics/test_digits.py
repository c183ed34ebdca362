"""Digits that are lost near a singular train are told; closed forms, and exact fractions."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from tests.oracle import gears as oracle
from tests.trains import random_train, seeded, shown
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, solve

SHOWS = "the ratios are so close to a singular train that rounding shows: "


def said(results: Results, gear: str = "1") -> list[str]:
    return [
        message.text.removeprefix(SHOWS)
        for message in results.messages
        if message.gear == gear and message.text.startswith(SHOWS)
    ]


def one_piece(near: float) -> Transmission:
    """The clutch makes the first set one piece, and with it the second; all turn at 1.

    Each has the difference u - 1 in its equation, the speed of link 4 has their product.
    """
    sets = [Mechanism(2, 3, 1, 1 + 2 * near), Mechanism(2, 1, 4, 1 + near)]
    return Transmission(4, [ShiftElement(2, 3)], sets, [Gear([1])])


@pytest.mark.parametrize("near", [1e-6, 1e-7, 3e-8, 1e-8, 1e-9, -1e-8])
def test_a_speed_that_should_be_1_and_is_not_is_told(near: float) -> None:
    results = solve(one_piece(near))
    error = abs(results.speeds[0, 3] - 1)
    assert error > 1e-6
    digits = math.floor(-math.log10(min(error, 1)))
    number = f"{digits} digits" if digits else "no digit"
    (text,) = said(results)
    assert text.startswith(f"{number} of the speed of 4 and the torque of F1, D1, D2")


@pytest.mark.parametrize("near", [0.1, 1e-3, 0.0])
def test_farther_away_and_at_1_itself_nothing_is_lost(near: float) -> None:
    results = solve(one_piece(near))
    assert said(results) == []
    if near:
        assert results.speeds[0] == pytest.approx([1] * 4)


def test_the_rounding_of_a_ratio_counts_too() -> None:
    """Its last digit is 2.2e-16; the output turns at u/(u - 1), so 1e-12 leaves four digits."""

    def reduced(near: float) -> list[str]:
        sets = [Mechanism(1, 2, 3, 1 + near)]
        return said(solve(Transmission(3, [ShiftElement(2)], sets, [Gear([1])])))

    assert reduced(1e-8) == reduced(1e-5) == []
    assert reduced(1e-12) == ["4 digits of the speed of 3 and the torque of the output are certain"]
    assert reduced(1e-15)[0].startswith("no digit")


@pytest.mark.parametrize("seeds", [range(40), pytest.param(range(40, 400), marks=pytest.mark.slow)])
def test_every_wrong_speed_is_told(seeds: range) -> None:
    """Random trains whose ratios are nearly 1, against exact fractions of their decimals."""
    wrong = 0
    for seed in seeds:
        rng = seeded(seed)
        case = random_train(rng, regular=seed % 2 == 0, coast=False)
        near = rng.choice((1e-6, 1e-7, 2e-8, 1e-8, 1e-9, 1e-10))
        mechanisms = [
            one._replace(ratio=1 + near * rng.choice((1, -1, 1, 2, 0.5))) if one.third else one
            for one in case.mechanisms
        ]
        case = replace(case, mechanisms=mechanisms)
        results = solve(case)
        for number, gear in enumerate(case.gears):
            exact = oracle.flow_of(case, gear).speeds
            speeds = [exact.link(link) for link in range(1, case.links + 1)]
            if any(map(is_wrong, results.speeds[number], speeds)):
                wrong += 1
                assert said(results, gear.name), (seed, shown(case))
    assert wrong > len(seeds) / 20


def is_wrong(got: float, exact: object) -> bool:
    if exact is None:
        return not math.isnan(got)
    expected = float(exact)  # type: ignore[arg-type]
    return not abs(got - expected) <= 2e-6 * max(abs(expected), 1e-12)
