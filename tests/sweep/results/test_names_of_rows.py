"""Names of rows in a sweep."""

from __future__ import annotations

import pytest

from tests.core.elements.element_texts import AOD, loaded
from tests.core.tables.test_names_of_rows import GEARS, ROWS
from vstatics import Results, solve, sweep


@pytest.fixture(scope="module")
def aod() -> Results:
    return solve(loaded(AOD))


@pytest.mark.parametrize("name", ROWS)
def test_a_sweep_has_these_rows(aod: Results, name: str) -> None:
    efficiency = aod.case.mechanisms[0].efficiency
    (made,) = sweep(aod.case, {"set.small_sun-short.efficiency": [efficiency]}, out=name)
    assert len(made.headings) == len(GEARS) * len(ROWS[name])
    by_row = made.columns[0].reshape(-1)
    assert sorted(by_row) == pytest.approx(sorted(getattr(aod, name).ravel()))
    for row in ROWS[name]:
        assert sum(f"[{row}," in heading or f'"{row}"' in heading for heading in made.headings) == 5
