"""Numbers of teeth for a set that is given by its ratios."""

import pytest

from tests.core.elements.test_ratios import of_ratios
from vstatics.core.readers import from_dict
from vstatics.core.writers.named import mapping
from vstatics.synthesis import find_teeth


def test_it_is_written_and_gets_teeth() -> None:
    case = of_ratios(85 / 31, -85 / 38)
    assert from_dict(mapping(case)) == case
    best = find_teeth(case, {case.gears[0].name: 85 / 31}).solutions[0]
    small, ring = (best.teeth["R"][wheel] for wheel in ("small_sun", "ring"))
    assert ring / small == pytest.approx(85 / 31, rel=1e-2)
