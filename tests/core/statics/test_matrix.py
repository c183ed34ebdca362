"""The structural-distribution matrix, and the systems of a gear made from its columns."""

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.core.statics.differential import SET, train
from tests.trains import random_train
from vstatics import Gear, Mechanism, Transmission, distribution_matrix
from vstatics.core.statics.matrix import (
    column,
    columns,
    speed_row_names,
    torque_rows,
    variant_of,
)


def test_a_column_is_in_equilibrium_and_turns_as_one_piece() -> None:
    """1 - u + (u - 1) = 0: torques on a mechanism balance, and equal speeds satisfy Willis."""
    assert column(-2.0) == (1, 2.0, -3.0)
    for u in (-2.5, 0.5, 1.004, 20.0):
        assert sum(column(u)) == pytest.approx(0, abs=1e-15)


def test_a_gear_has_its_conditions_and_an_equilibrium_for_each_link() -> None:
    """Figures 3 and 4 of the source: conditions are those of mechanisms, elements, given speeds.

    Unknowns are engaged devices, the output, holding torques.
    """
    case = train([(2, 0), (1, 2)], Gear([1], speeds={3: 1 / 3}))
    names = ["D1", "A", "the input speed", "the given speed of link 3"]
    assert speed_row_names(case, case.gears[0]) == names
    rows = torque_rows(case, Gear([1]), columns(case, [SET.ratio]))
    # brake 0, set 1, output 2: M_d = 1 at the sun, M_b + 2 M_d = 0, -3 M_d + Mx = 0
    assert [sorted({*row} & {0, 1, 2}) for row in rows] == [[1], [0, 1], [1, 2]]


def test_the_housing_has_no_row_and_takes_what_is_left() -> None:
    for seed in range(count(8, 80)):
        case = random_train(seeded(seed))
        matrix = distribution_matrix(case)
        devices: list[tuple[int, ...]] = [(e.first, e.second) for e in case.shift_elements]
        devices += [m.links for m in case.mechanisms]
        assert matrix.shape == (case.links, len(devices))
        for torques, links in zip(matrix.T, devices, strict=True):
            assert 0 in links or torques.sum() == pytest.approx(0, abs=1e-12)
            assert set(np.flatnonzero(torques) + 1) <= set(links)


def test_a_ratio_for_each_mechanism_is_asked_for() -> None:
    """Omitted ratios are ratios of the case.

    docs/method.md: 1 on the first link, -u on the second; the housing has no row.
    """
    case = train([(2, 0)], Gear([1]))
    columns = distribution_matrix(case, np.array([[-2.0], [-3.0]]))[:, :, 1]
    assert columns.tolist() == [[1, 2, -3], [1, 3, -4]]
    with pytest.raises(ValueError, match="expected a last axis of 1"):
        distribution_matrix(case, [[-2.0, 1.0]])
    pair = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()])
    assert variant_of(pair).efficiencies[0].forward == 0.98
    for given, ratio in ((None, -4.0), ([2.5], 2.5)):
        assert list(variant_of(pair, given).columns[0].values()) == [1, -ratio]
