"""Arguments of `solve`: which arrays are taken, and which are refused."""

import numpy as np
import pytest

import vstatics
from tests.commands import CASES
from tests.core.statics.batches import ARRAYS, random_case, same
from vstatics import distribution_matrix, solve


def test_arrays_of_another_shape_are_refused() -> None:
    case = vstatics.load(CASES / "mzkt7922.yaml")
    for wrong in ([1.0, 2.0], 1.0, np.ones((3, 2))):
        with pytest.raises(ValueError, match="expected a last axis of 3"):
            solve(case, ratios=wrong)
        with pytest.raises(ValueError, match="expected a last axis of 3"):
            distribution_matrix(case, wrong)


def test_any_array_of_numbers_will_do() -> None:
    case, u, _ = random_case(1)
    expected = solve(case, ratios=u)
    given = [u.tolist(), np.asfortranarray(u), u[::-1][::-1], np.repeat(u, 2, axis=0)[::2]]
    for array in given:
        results = solve(case, ratios=array)
        assert all(same(getattr(results, name), getattr(expected, name)) for name in ARRAYS)
