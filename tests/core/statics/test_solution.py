"""Results of a case or of an array of variants: axes, own numbers, extreme ratios."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vstatics
from tests.chance import count, generator
from tests.commands import CASES
from tests.core.statics.batches import ARRAYS, plainly, random_case, ratios, same, with_numbers
from vstatics.core.statics.solution import solution

EXTREME = st.sampled_from(
    [1e308, -1e308, 1e200, 1e160, 1e10, -2.0, 0.5, 1.0 + 1e-15, 1e-10, 1e-160, -1e-200, 1e-308]
)


@pytest.mark.slow
@settings(max_examples=count(24, 180))
@given(st.data(), st.sampled_from(["zf-8hp70", "umdm", "two-stage"]), st.integers(1, 3))
def test_extreme_ratios_end_in_results(data: st.DataObject, name: str, variants: int) -> None:
    case = vstatics.load(CASES / f"{name}.yaml")
    own = data.draw(st.lists(EXTREME, min_size=(n := len(case.mechanisms)), max_size=n))
    results = solution(case, ratios=[own] * variants)
    assert not np.isinf(results.torques).any()
    assert results.speeds.shape == (variants, len(case.gears), case.own_links)


def test_ratios_and_efficiencies_have_axes_of_their_own() -> None:
    case = vstatics.load(CASES / "mzkt7922.yaml")
    rng = generator(5)
    u = ratios(rng, case, 6, "ordinary").reshape(2, 1, 3, 3)
    eta = np.tile(rng.uniform(0.9, 1, (4, 1, 3)), 1)
    results = solution(case, ratios=u, efficiencies=eta)
    assert results.ratio.shape == (2, 4, 3, 6)
    assert results.torques.shape == (2, 4, 3, 6, 9)
    assert results.idle.shape == (2, 4, 3, 6, 3)
    for place in np.ndindex(2, 4, 3):
        alone = plainly(with_numbers(case, u[place[0], 0, place[2]], eta[place[1], 0]))
        for name in ARRAYS:
            assert same(getattr(results, name)[place], getattr(alone, name)), name


def test_leading_axes_are_those_of_what_is_given() -> None:
    case, _, _ = random_case(7)
    own = [mechanism.ratio for mechanism in case.mechanisms]
    for shape in ((1,), (1, 1), (7,), (3, 1, 2), (0,), (2, 0, 3)):
        u = np.broadcast_to(own, (*shape, len(own)))
        eta = np.full(u.shape, 0.95)
        for results in (solution(case, ratios=u), solution(case, efficiencies=eta)):
            for name in ARRAYS:
                assert getattr(results, name).shape[: len(shape)] == shape
            assert results.ratio.shape == (*shape, len(case.gears))
    assert solution(case, ratios=own).ratio.shape == (len(case.gears),)
