"""What losses take and leave: efficiencies of trains in closed form, the balance of power."""

from itertools import product

import pytest

from tests.core.statics.batches import chain
from vstatics import Gear, Mechanism, Transmission, solve


def test_losses_of_mechanisms_in_series_multiply() -> None:
    for count, coast in product((3, 12, 13, 14, 40), (False, True)):
        results = solve(chain(count), coast=coast)
        assert results.ratio == pytest.approx(2.0**count)
        assert results.efficiency == pytest.approx(0.97**count)
        assert results.consistent.all()
        assert not results.messages


def test_a_stage_is_measured_by_its_own_links() -> None:
    """Sun in, ring held, carrier out, twice: each stage has (1 - u eta)/(1 - u)."""
    for ratio in (1e3, 1e5, 1e7):
        u, eta = 1 - ratio, 0.9
        stages = [Mechanism(1, 0, 2, u, eta), Mechanism(2, 0, 3, u, eta)]
        results = solve(Transmission(3, [], stages, [Gear()]))
        assert results.ratio == pytest.approx(ratio**2)
        assert results.efficiency == pytest.approx(((1 - u * eta) / (1 - u)) ** 2)
        assert not results.idle.any()
        assert list(results.power_sign[0]) == [1, 1]
        assert not results.messages
