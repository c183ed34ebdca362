"""Trains of many mechanisms, and of large ratios; expected numbers are closed forms."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.oracle import gears as oracle
from tests.oracle.cases import NASTY
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve


def chain(count: int, into: Transmission | None = None) -> Transmission:
    """Gear pairs of ratio 2 and efficiency .97 one after another, then a train."""
    last = into or Transmission(2, [ShiftElement(1, 2)], [], [Gear([1])])
    ends = [last.links + number for number in range(1, count + 1)]
    pairs = zip(ends, [*ends[1:], last.input], strict=True)
    made = [Mechanism(first, second, 0, 2.0, 0.97) for first, second in pairs]
    return replace(
        last,
        links=last.links + count,
        link_names=(),
        mechanisms=[*made, *(one._replace(name="") for one in last.mechanisms)],
        input=ends[0],
    )


@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("count", [3, 12, 13, 14, 40])
def test_losses_of_mechanisms_in_series_multiply(count: int, coast: bool) -> None:
    results = solve(chain(count), coast=coast)
    assert results.ratio == pytest.approx(2.0**count)
    assert results.efficiency == pytest.approx(0.97**count)
    assert results.consistent.all()
    assert not results.messages


@pytest.mark.parametrize("name", [name for name in NASTY if name.startswith("turned")])
def test_a_sign_is_turned_also_in_a_train_too_large_to_try_all_signs(name: str) -> None:
    """Eleven pairs before a train of three: its efficiency times .97**11."""
    case = replace(NASTY[name], gears=[Gear()], input=NASTY[name].gear_input(NASTY[name].gears[0]))
    case = replace(case, output=NASTY[name].gear_output(NASTY[name].gears[0]))
    (exact,) = oracle.solve(case)
    assert exact.efficiency is not None
    results = solve(chain(11, case))
    assert results.efficiency == pytest.approx(0.97**11 * float(exact.efficiency))
    assert results.turned.any()
    assert results.consistent.all()


@pytest.mark.parametrize("ratio", [1e3, 1e5, 1e7])
def test_a_stage_is_measured_by_its_own_links(ratio: float) -> None:
    """Sun in, ring held, carrier out, twice: each stage has (1 - u eta)/(1 - u)."""
    u, eta = 1 - ratio, 0.9
    stages = [Mechanism(1, 0, 2, u, eta), Mechanism(2, 0, 3, u, eta)]
    results = solve(Transmission(3, [], stages, [Gear()]))
    assert results.ratio == pytest.approx(ratio**2)
    assert results.efficiency == pytest.approx(((1 - u * eta) / (1 - u)) ** 2)
    assert not results.idle.any()
    assert list(results.power_sign[0]) == [1, 1]
    assert not results.messages
