"""Tables over one or two variables against scipy's linear interpolation."""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from tests.chance import count, generator
from vstatics.core.numerics.lookup_table import LookupTable


def test_values_are_those_of_scipy_inside_and_constant_outside() -> None:
    rng = generator(4)
    for columns in (4, 1) * count(10, 200):
        x, y = np.sort(rng.uniform(0, 9, 5)), np.sort(rng.uniform(0, 9, columns))
        values, points = rng.uniform(-5, 5, (5, columns)), rng.uniform(-2, 11, (40, 2))
        points[:2] = [x[2], y[0]], [x[-1], y[-1]]
        inside = np.clip(points, [x[0], y[0]], [x[-1], y[-1]])
        grid = ((x, y), values) if columns > 1 else ((x,), values[:, 0])
        expected = RegularGridInterpolator(*grid)(inside[:, : len(grid[0])])
        table = LookupTable(*(tuple(x), tuple(map(tuple, values)), tuple(y)))
        assert table.along(*points.T) == pytest.approx(expected, rel=1e-12, abs=1e-12)
        alone = [table.at(*point) for point in points.tolist()]
        assert alone == pytest.approx(expected, rel=1e-12, abs=1e-12)
        if columns == 1:
            starts, slopes = np.transpose([table.line_at(x) for x in points[:, 0]])
            assert starts + slopes * points[:, 0] == pytest.approx(expected, rel=1e-11, abs=1e-11)
