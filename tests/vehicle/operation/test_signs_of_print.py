"""Blanks of print in a driving cycle."""

import pytest

from tests.chance import count, seeded
from tests.core.readers.named.test_signs_of_print import spoilt
from vstatics.vehicle.operation.trace import read_trace

CYCLE = "Time (s), Speed [km/h], Remark\n0, 0 , a b\n 2 ,36, c d\n"


@pytest.mark.parametrize("seed", range(count(10, 200)))
def test_blanks_of_print_are_blanks_in_tables(seed: int) -> None:
    trace = read_trace(spoilt(CYCLE, seeded(5100 + seed)).encode(), "t.csv")
    assert (trace.duration[0], trace.speed[0]) == (2.0, pytest.approx(5.0))
    assert trace.table.head.skipped == ["Remark"]
