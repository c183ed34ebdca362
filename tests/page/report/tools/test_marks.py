"""Rows of a page know their links: those on which the device of a row acts."""

from __future__ import annotations

import numpy as np

from tests.chance import count, seeded
from tests.trains import random_train
from vstatics import solve
from vstatics.core.statics.solve import distribution_matrix
from vstatics.core.tables.result_tables import of_results
from vstatics.page.report.tools.marks import with_tool_marks


def test_a_torque_is_of_the_links_where_the_matrix_has_its_device() -> None:
    chance = seeded(7)
    for _ in range(count(20, 200)):
        case = random_train(chance, regular=True)
        [grid] = [one for one in of_results(solve(case)) if one.key == "torques"]
        rows = [row[0] for row in with_tool_marks(grid, case).cells]
        *devices, output = [[int(one) for one in row.marks["links"].split()] for row in rows]
        assert output == [case.main_output - 1]
        for own, column in zip(devices, distribution_matrix(case).T, strict=True):
            assert {*np.flatnonzero(column).tolist()} <= {*own}
            assert len(own) <= 3
