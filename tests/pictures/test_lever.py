"""Levers: positions follow from the teeth, speeds are linear along them."""

from __future__ import annotations

import numpy as np
import pytest

from tests.commands import CASES, SHIPPED
from vstatics import Results, load, solve
from vstatics.pictures.lever import levers

NAMES = [path.name for path in SHIPPED]


def result(name: str) -> Results:
    return solve(load(CASES / name))


def test_positions_on_a_lever_follow_from_the_teeth() -> None:
    """Ravigneaux of 30, 36 and 72 teeth against its carrier: 72/30 : -72/36 : 1."""
    results = result("ravigneaux-aod.yaml")
    [lever] = levers(results.case)
    positions = {results.case.link_name(node.link): node.position for node in lever.nodes}
    assert positions == pytest.approx(
        {"reverse sun": -2, "carrier": 0, "ring": 1, "forward sun": 2.4}
    )


@pytest.mark.parametrize("name", NAMES)
def test_speeds_are_linear_along_every_lever(name: str) -> None:
    """Willis: all speeds against the carrier are in the ratio of their positions."""
    results = result(name)
    speeds = np.hstack([np.zeros((len(results.case.gears), 1)), results.speeds])
    for lever in levers(results.case):
        low, high = lever.nodes[0], lever.nodes[-1]
        slope = (speeds[:, high.link] - speeds[:, low.link]) / (high.position - low.position)
        for node in lever.nodes:
            expected = speeds[:, low.link] + slope * (node.position - low.position)
            np.testing.assert_allclose(speeds[:, node.link], expected, atol=1e-9)
