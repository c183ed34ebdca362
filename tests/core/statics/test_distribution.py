"""The structural-distribution matrix of a case, and of arrays of ratios."""

from __future__ import annotations

import numpy as np
import pytest

from tests.chance import seeded
from tests.commands import MZKT
from tests.core.statics.differential import train
from tests.shipped import PRINTED
from tests.trains import random_train
from vstatics import Gear, Mechanism, distribution_matrix, load


def test_the_published_matrix() -> None:
    """AJK of the report of the MZKT 7922, as printed."""
    printed = np.array(PRINTED["AJK"], float)
    assert distribution_matrix(load(MZKT)) == pytest.approx(printed, abs=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_the_housing_has_no_row_and_takes_what_is_left(seed: int) -> None:
    case = random_train(seeded(seed))
    matrix = distribution_matrix(case)
    devices: list[tuple[int, ...]] = [(e.first, e.second) for e in case.shift_elements]
    devices += [m.links for m in case.mechanisms]
    assert matrix.shape == (case.links, len(devices))
    for torques, links in zip(matrix.T, devices, strict=True):
        if 0 not in links:
            assert torques.sum() == pytest.approx(0, abs=1e-12)
        assert set(np.flatnonzero(torques) + 1) <= set(links)


def test_a_ratio_for_each_mechanism_is_asked_for() -> None:
    case = train([(2, 0)], Gear([1]))
    ratios = np.array([[-2.0], [-3.0]])
    assert distribution_matrix(case, ratios)[:, :, 1] == pytest.approx(
        np.array([[1, 2, -3], [1, 3, -4]], float)
    )
    assert Mechanism(1, 2, 3, -2.0).links == (1, 2, 3)
    with pytest.raises(ValueError, match="expected a last axis of 1"):
        distribution_matrix(case, [[-2.0, 1.0]])
