"""Digits that are lost near a singular train are told; closed forms, and exact fractions."""

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from tests.chance import generator, ranges_with_slow, seeded
from tests.commands import CASES
from tests.core.statics.test_against_oracle import _disagreements as differences
from tests.oracle import gears as oracle
from tests.oracle import linear, losses, systems
from tests.trains import random_train, shown
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, load, solve
from vstatics.core.statics import freewheels

Choices = Sequence[float]
SINGULAR = "with slightly different ratios there would be no unique solution"
SHOWS = f"{SINGULAR}, so rounding errors show: "
EXACT = "; give exact ratios, for example by teeth"


def said(results: Results, gear: str = "1") -> list[str]:
    return [
        message.text.removeprefix(SHOWS).removesuffix(EXACT)
        for message in results.messages
        if message.gear == gear and message.text.startswith(SHOWS)
    ]


def one_piece(near: float) -> Transmission:
    """The clutch makes the first set one piece, and with it the second; all turn at 1.

    Each has the difference u - 1 in its equation, the speed of link 4 has their product.
    """
    sets = [Mechanism(2, 3, 1, 1 + 2 * near), Mechanism(2, 1, 4, 1 + near)]
    return Transmission(4, [ShiftElement(2, 3)], sets, [Gear([1])])


def test_a_speed_that_is_1_is_1() -> None:
    for near in (*(10.0**-n for n in range(6, 16)), 3e-8, -1e-8, -1e-15):
        results = solve(one_piece(near))
        assert results.speeds[0].tolist() == [1] * 4
        assert results.lossy_output_torque.tolist() == [1]
        assert (results.missing[0], results.excess[0]) == (0, 0)
        assert not any("speed" in text for text in said(results))
    for far in (0.1, 1e-3, 0.0):
        assert said(solve(one_piece(far))) == []
    assert solve(one_piece(1e-3)).speeds[0] == pytest.approx([1] * 4)


def test_the_rounding_of_a_ratio_counts_too() -> None:
    """Its last digit is 2.2e-16; the output turns at u/(u - 1), so 1e-12 leaves four digits."""
    four = ["only 4 digits of the speed of 3 and the torque of the output are certain"]
    one_digit = ["only 1 digit of the sp"]
    for near, expected in ((1e-8, []), (1e-5, []), (1e-12, four), (1e-15, one_digit)):
        sets = [Mechanism(1, 2, 3, 1 + near)]
        told = said(solve(Transmission(3, [ShiftElement(2)], sets, [Gear([1])])))
        assert [text[: len(one)] for text, one in zip(told, expected, strict=True)] == expected


@ranges_with_slow(16, 60, 400)
def test_every_wrong_speed_is_reported(seeds: range) -> None:
    """Random trains whose ratios are nearly 1, against exact fractions of their decimals."""
    wrong = 0
    for seed in seeds:
        rng = seeded(seed)
        case = random_train(rng, regular=seed % 2 == 0, coast=False)
        near = rng.choice((1e-6, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14))
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
    assert wrong


@pytest.fixture
def as_doubles(monkeypatch: pytest.MonkeyPatch) -> None:
    """The oracle takes a number for what its float is, not for the decimal that it shows."""
    for module in (linear, systems, losses, oracle):
        monkeypatch.setattr(module, "exact", Fraction)


def nearly_singular(seed: int, ratios: Choices, share: Choices, most: int) -> Transmission:
    """A random train of two to six mechanisms, most of nearly one ratio; even seeds lose nothing."""
    rng = seeded(seed)
    case = random_train(rng, regular=True)
    ratio, near = rng.choice(ratios), 10.0 ** -rng.randint(6, most)
    mechanisms = []
    for one in case.mechanisms:
        is_near = one.third and rng.random() < 0.85
        u = ratio * (1 + near * rng.choice(share)) if is_near else one.ratio
        mechanisms.append(one._replace(ratio=u, efficiency=one.efficiency if seed % 2 else 1.0))
    return replace(case, mechanisms=mechanisms)


@pytest.mark.usefixtures("as_doubles")
@ranges_with_slow(8, 40, 320)
def test_every_number_is_that_of_exact_arithmetic(seeds: range) -> None:
    for seed in seeds:
        case = nearly_singular(seed, (1,), (1, -1, 2, 5), 15)
        assert differences(case) == [], (seed, shown(case))


def test_equal_decimals_are_equal_whatever_their_floats_are() -> None:
    """1.1 * 1.1 = 1.21, though not in floats: both ways to link 3 say the same of its speed."""
    pairs = [Mechanism(3, 2, 0, 1.1), Mechanism(2, 1, 0, 1.1), Mechanism(3, 1, 0, 1.21)]
    results = solve(Transmission(3, [], pairs, [Gear()]))
    assert results.speeds[0].tolist() == pytest.approx([1, 1.1, 1.21])
    assert (results.excess[0], bool(results.tied_up[0]), said(results)) == (1, False, [])


@pytest.mark.usefixtures("as_doubles")
@ranges_with_slow(range(376, 386), 400, 4000, start=1000)
def test_speeds_and_torques_of_nearly_one_ratio_are_those_of_fractions(seeds: range) -> None:
    """But for speeds of some units in the last place of the input's, which are those of ratios."""
    ratios = (-2.0, 2.0, -1.5, 3.0, -2.37, 1.61)
    for seed in seeds:
        case = nearly_singular(seed, ratios, (0, 1, -1, 2, 5), 14)
        results = solve(case)
        for number, exact in enumerate(oracle.solve(case)):
            for got, wanted in (
                *zip(results.speeds[number], exact.speeds, strict=True),
                *zip(results.torques[number], exact.torques.listed, strict=True),
            ):
                expected = math.nan if wanted is None else float(wanted)
                close = pytest.approx(expected, rel=2e-6, abs=1e-14, nan_ok=True)
                assert got == close, (seed, shown(case))


@pytest.mark.usefixtures("as_doubles")
@ranges_with_slow(6, 20, 200)
def test_variants_of_nearly_one_ratio_have_rounded_fractions(
    seeds: range, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each number is the float closest to the exact fraction, although no fraction is calculated.

    Half of the other variants have ratios near enough to 1 for self-locking.
    """
    case, (near, some) = load(CASES / "mzkt7922.dat"), (slice(5, None, 250), slice(0, None, 2))
    monkeypatch.setattr(freewheels, "_exact_state", None)
    for seed in seeds:
        rng = generator(seed)
        u = rng.choice((-1, 1, 1), (1000, 3)) * rng.uniform(0.5, 3, (1000, 3))
        u[some] = rng.choice((-1, 1, 1), (500, 3)) * rng.uniform(0.95, 1.05, (500, 3))
        u[near, seed % 3] = 1 + rng.choice((1, -1), 4) * 10 ** rng.uniform(-6.5, -4.1, 4)
        losses = rng.uniform(0.9, 0.99, u.shape)
        results = solve(case, ratios=u, efficiencies=losses)
        assert results.exact[near].all()
        for variant in range(5, 1000, 250):
            numbers = zip(
                case.mechanisms, u[variant].tolist(), losses[variant].tolist(), strict=True
            )
            sets = [m._replace(ratio=ratio, efficiency=eta) for m, ratio, eta in numbers]
            for gear, exact in enumerate(oracle.solve(replace(case, mechanisms=sets))):
                for name, wanted in (
                    ("speeds", exact.speeds),
                    ("slip_speeds", exact.slip_speeds),
                    ("torques", exact.torques.listed),
                    ("lossy_torques", exact.lossy_torques.listed),
                    ("losses", exact.losses),
                ):
                    got = getattr(results, name)[variant, gear]
                    expected = np.array(wanted, np.float64)
                    np.testing.assert_array_equal(got, expected, name)


def is_wrong(got: float, exact: object) -> bool:
    if exact is None:
        return not math.isnan(got)
    expected = float(exact)  # type: ignore[arg-type]
    return not abs(got - expected) <= 2e-6 * max(abs(expected), 1e-12)
