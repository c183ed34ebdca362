"""Decrements: of records in closed form, and dampings calculated from them, by table 2.4 of the book.

Table П2.1 is for `test_measured`.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import each_seed, generator
from tests.torsion.book import table
from vstatics.torsion.vibration.decays import Decay, decay, recorded_decay
from vstatics.torsion.vibration.decrements import dampings, decrement, decrements


def peaks(mean: float, drift: float, first: float, decrement: float, count: int) -> list[float]:
    ratio = math.exp(-decrement / 2)
    return [mean + drift * k + first * (-ratio) ** k for k in range(count)]


@pytest.mark.parametrize("drift", [0.0, 3.0])
@pytest.mark.parametrize("decrement", [0.0, 0.05, 0.55, 2.0])
def test_the_decrement_is_exact_also_on_a_mean_that_drifts(drift: float, decrement: float) -> None:
    """M_k = m + d k + A (-r)^k, r = exp(-decrement/2): the mean line has a part of all A r^k."""
    made = decay(peaks(40.0, drift, 120.0, decrement, 7), 0.25)
    assert made.decrement == pytest.approx(decrement, abs=1e-12)
    assert made.omega == pytest.approx(8 * math.pi)
    ratio = math.exp(-decrement / 2)
    expected = [120 * ratio**k * (1 + ratio) ** 2 / (4 * ratio) for k in range(1, 6)]
    assert made.amplitudes == pytest.approx(expected)


def test_the_mean_line_of_a_record() -> None:
    """By hand: means of (160 - 2 51.148655 + 109.233977)/4 and so on."""
    made = decay([160, -51.148655, 109.233977, -12.588199, 79.944530, 9.659249], 0.1)
    assert made.mean_line == pytest.approx((41.734167, 38.682775, 41.000527, 39.240027), abs=1e-6)


@each_seed(6)
def test_a_record_in_samples(seed: int) -> None:
    """Instants that are not even, 40 or so to a period; extremes lie pi/omega apart."""
    chance = generator(seed)
    omega, share = chance.uniform(5, 50), chance.uniform(0.005, 0.1)
    step = 2 * math.pi / omega / 40
    times = np.cumsum(chance.uniform(0.7, 1.3, size=300)) * step
    values = 7 + 3 * np.exp(-share * omega * times) * np.cos(omega * times + seed)
    made = recorded_decay(times, values)
    assert made.omega == pytest.approx(omega, rel=1e-3)
    assert made.decrement == pytest.approx(2 * math.pi * share, rel=0.01, abs=2e-3)


def test_a_plateau_is_an_extreme_unless_it_is_on_the_way() -> None:
    """Cosines sampled to both sides of their extremes have plateaus of two."""
    times = (np.arange(60) + 0.5) / 12
    made = recorded_decay(times, np.cos(2 * math.pi * times))
    assert made.omega == pytest.approx(2 * math.pi)
    assert made.decrement == pytest.approx(0.0, abs=1e-9)
    steps = np.array([0.0, 1, 1, 2, 0, 0, -2, 0, 1, -0.5, 0.25, 0.1, 0.2])
    seen: Decay = recorded_decay(np.arange(13.0), steps)
    assert len(seen.amplitudes) == 5 - 2 + 1


def test_curves_without_a_vibration_are_rejected() -> None:
    for given, message in (
        ([1, -1, 1, -1], "read 4 extremes of a vibration, expected 5 at least"),
        ([1, -1, 2, 3, -1, 2], "rise and fall in turn"),
        ([1, -1, 1, 1, -1], "rise and fall in turn"),
        ([1, -2, 3, -4, 5, -6], "expected extremes that decay"),
        ([1e308, -1e308, 1e308, -1e308, 1e307], "expected extremes that decay"),
        ([], "read 0 extremes"),
    ):
        with pytest.raises(ValueError, match=message):
            decay(given, 1.0)
    for values in (np.zeros(0), np.ones(9), np.arange(9.0)):
        with pytest.raises(ValueError, match="read 0 extremes"):
            recorded_decay(np.arange(float(len(values))), values)


class Gear(NamedTuple):
    """A gear of table 2.4, as its file has it."""

    ratio: float
    decrement: float
    compliances: list[float]
    parts: list[float | None]
    products: list[float | None]


TABLE_2_4 = {gear: Gear(**of) for gear, of in table("table_2_4")["gears"].items()}
RATIOS = {"transmission": 1.0, "axle": 8.0, "tyres": 2.35}
PROPSHAFT, GEARBOX = 0.03, 0.10
"""Their decrements: the means of table П1.3, with which the columns of table 2.4 agree."""


@pytest.mark.parametrize("gear", TABLE_2_4)
def test_table_2_4(gear: str) -> None:
    """At 1 rad/s a damping is K omega, (П1.19), which on e times the compliance is K omega/e^2, (П1.27)."""
    given = TABLE_2_4[gear]
    _, box, propshaft, half_shafts, axle, tyres = given.compliances
    parts = {"transmission": math.fsum(given.compliances[:4]), "axle": axle, "tyres": tyres}
    whole = math.fsum(parts.values())
    first = given.decrement / decrement(RATIOS, {name: one / whole for name, one in parts.items()})
    made = {name: first * ratio for name, ratio in RATIOS.items()}
    by_part = dampings(made, parts, 1.0)
    at_half_shafts = by_part["transmission"] * (parts["transmission"] / half_shafts) ** 2
    single = dampings(
        {"propshaft": PROPSHAFT, "box": GEARBOX}, {"propshaft": propshaft, "box": box}, 1.0
    )
    products = [*by_part.values(), at_half_shafts, single["propshaft"], single["box"]]
    for calculated, printed in (
        *zip(made.values(), given.parts, strict=True),
        *zip(products, given.products, strict=True),
    ):
        if printed is not None:
            assert calculated == pytest.approx(printed, rel=1e-2)


class Vehicle(NamedTuple):
    """A gear of table П2.1: one-link scheme, measured frequency, what follows."""

    inertias: list[float]
    compliance: float
    calculated: float | None
    measured: float
    corrected: float
    decrement: float
    damping: float | None


TABLE_P2_1 = {gear: Vehicle(**of) for gear, of in table("table_p2_1")["gears"].items()}


def test_decrements_come_back_from_dampings() -> None:
    given, compliances = {"shaft": 0.03, "damper": 0.2}, {"shaft": 1e-3, "damper": 8e-4}
    assert decrements(dampings(given, compliances, 80.0), compliances, 80.0) == pytest.approx(given)
