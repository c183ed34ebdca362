"""Damage of components: cycles counted by the standard, sums by hand, a long random record."""

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from tests.chance import each_seed, generator
from vstatics import CaseError, Spring, Transmission
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.damage.devices import damages, device_damage
from vstatics.vehicle.damage.rainflow import LoadCycle, extremes, rainflow
from vstatics.vehicle.damage.rayleigh import rayleigh_life

EXAMPLE = np.array([-2.0, 1, -3, 5, -1, 3, -4, 4, -2])
COUNTS = {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}
"""ASTM E1049-85, 5.4.4, figure 6: ranges and their counts as the standard prints them."""
SHAFT = Fatigue(100e6, 3, 4e6, section_modulus=4e-6, threshold=0.0)
TORQUES = 100 * EXAMPLE
"""An amplitude of 400 N*m is the endurance."""


def by_range_and_mean(cycles: Iterable[LoadCycle]) -> dict[tuple[float, float], float]:
    sums: dict[tuple[float, float], float] = {}
    for cycle in cycles:
        key = round(cycle.range, 9), round(cycle.mean, 9)
        sums[key] = sums.get(key, 0.0) + cycle.counted
    return sums


def four_points(values: Sequence[float]) -> list[LoadCycle]:
    """Two of four points that are between the others are a cycle; remaining points are half-cycles.

    This is the method of Amzallag and others (1994), not the method of the standard.
    """
    left, cycles = [*values], []
    at = 0
    while at + 3 < len(left):
        a, b, c, d = left[at : at + 4]
        if min(a, d) <= min(b, c) and max(b, c) <= max(a, d):
            cycles.append(LoadCycle(abs(b - c), (b + c) / 2, 1.0))
            del left[at + 1 : at + 3]
            at = max(at - 2, 0)
        else:
            at += 1
    pairs = pairwise(left)
    return [*cycles, *(LoadCycle(abs(a - b), (a + b) / 2, 0.5) for a, b in pairs)]


@each_seed(60, 2000)
@pytest.mark.parametrize("whole", [True, False])
def test_random_records_as_by_four_points(seed: int, whole: bool) -> None:
    """Whole numbers have many ranges that are equal; points between extremes do not count."""
    chance = generator(seed)
    values = chance.normal(size=int(chance.integers(0, 80))) * 4
    values = np.round(values) if whole else values
    turning = extremes(values).tolist()
    counted = rainflow(values)
    halves = np.arange(0, len(values) - 0.5, 0.5)
    between = np.interp(halves, np.arange(len(values)), values) if len(values) else values
    assert rainflow(np.repeat(between, 3)) == counted
    assert by_range_and_mean(counted) == by_range_and_mean(four_points(turning))
    assert sum(2 * one.counted for one in counted) == max(len(turning) - 1, 0)
    ways = sum(2 * one.range * one.counted for one in counted)
    assert ways == pytest.approx(np.abs(np.diff(values)).sum())


def test_the_example_of_the_standard() -> None:
    ranges = [(cycle.range, cycle.counted) for cycle in rainflow(EXAMPLE)]
    assert {r: sum(n for other, n in ranges if other == r) for r, _ in ranges} == COUNTS
    by_hand = sum(Fraction(n) * Fraction(r, 8) ** 3 for r, n in COUNTS.items()) / 4_000_000
    made, half = (device_damage(SHAFT._replace(sum=a), TORQUES) for a in (1.0, 0.5))
    assert made.damage == half.damage == pytest.approx(float(by_hand), rel=1e-14)
    assert made.damage == pytest.approx(5.341796875e-7, rel=1e-14)
    assert made.repeats == pytest.approx(1 / float(by_hand))
    assert half.repeats == pytest.approx(0.5 / float(by_hand))
    assert made.largest_stress == pytest.approx(450 / 4e-6)
    round_ = SHAFT._replace(section_modulus=None, diameter=0.04)  # 16 M/(pi d^3)
    made = device_damage(round_, np.array([0.0, 1000.0, -1000.0, 0.0]))
    assert made.largest_stress == pytest.approx(16e3 / (math.pi * 0.04**3))


def test_cycles_count_from_the_threshold_on() -> None:
    """With 3/4 ranges of 600 and more: 6 is there, 4 is not.

    465 N*m/(5e-6 m^3)/(310 MPa) is 0.3, but 0.29999999999999993 in floating point.
    """
    shaft = Fatigue(310e6, 1, 1e6, section_modulus=5e-6, threshold=0.3)
    assert device_damage(shaft, np.array([-465.0, 465.0])).damage == pytest.approx(0.5 * 0.3e-6)
    assert device_damage(shaft, np.array([-464.9, 464.9])).damage == 0
    by_hand = sum(n * (r / 8) ** 3 for r, n in COUNTS.items() if r >= 6) / 4e6
    made = device_damage(SHAFT._replace(threshold=0.75), TORQUES)
    assert made.damage == pytest.approx(by_hand)
    small = device_damage(SHAFT, TORQUES / 1e3)
    none = device_damage(SHAFT._replace(threshold=0.6), TORQUES / 1e3)
    assert (none.damage, none.repeats) == (0.0, None)
    assert small.damage == pytest.approx(5.341796875e-16)


def test_a_mean_stress_counts_in_part_whatever_its_sign() -> None:
    """(4.38): 200 N*m about 300 N*m is as 230 N*m about 0 with an asymmetry of .1."""
    leaning = device_damage(SHAFT._replace(asymmetry=0.1), np.array([100.0, 500.0]))
    other = device_damage(SHAFT._replace(asymmetry=0.1), np.array([-100.0, -500.0]))
    even = device_damage(SHAFT, np.array([-230.0, 230.0]))
    assert leaning.damage == other.damage == pytest.approx(even.damage, rel=1e-14)
    assert leaning.largest_stress == pytest.approx(230 / 4e-6)


def test_a_record_has_one_axis() -> None:
    shaft = Spring({1: 1, 2: -1}, stiffness=9e3, name="shaft")
    case = Transmission(2, [], [], [], springs=[shaft], fatigue={"shaft": SHAFT})
    with pytest.raises(CaseError, match="shaft: read 2 axes, expected a list of numbers"):
        damages(case, {"shaft": [[0.0, 5.0], [5.0, 0.0]]})


@pytest.mark.parametrize("torques", [[0.0, math.nan, 3.0], [0.0, math.inf], [1e200, -1e200, 0.0]])
def test_what_is_open_or_too_large_has_no_damage(torques: list[float]) -> None:
    made = device_damage(SHAFT, np.array(torques))
    assert math.isnan(made.damage)
    assert made.repeats is None


def test_a_narrow_band_has_the_life_of_rayleighs_distribution() -> None:
    """A narrow band of noise: its amplitudes have that distribution (Rice).

    The deviation is 60 % of the endurance, as in the book's example.
    """
    chance, cycles, samples = generator(4), 20_000, 32
    spectrum = np.zeros(cycles * samples // 2 + 1, dtype=complex)
    band = slice(cycles - cycles // 20, cycles + cycles // 20)
    spectrum[band] = chance.normal(size=(cycles // 20 * 2, 2)) @ [1, 1j]
    waves = np.fft.irfft(spectrum)
    shaft = SHAFT._replace(threshold=0.6)
    made = device_damage(shaft, 240.0 * waves / np.std(waves))
    expected = rayleigh_life(shaft, 60e6).life
    assert made.repeats is not None
    assert made.repeats * cycles == pytest.approx(expected, rel=0.1)
