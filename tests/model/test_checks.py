"""What can be no transmission as a whole: told with its path."""

from __future__ import annotations

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics import solve as solved


def test_there_may_be_no_more_than_eight() -> None:
    def many(count: int) -> Transmission:
        made = [ShiftElement(number, 0, kind="freewheel") for number in range(3, 3 + count)]
        mechanisms = [Mechanism(1, link, 0, -1.0) for link in range(2, 3 + count)]
        return Transmission(2 + count, made, mechanisms, [Gear()], output=2)

    assert solved(many(8)).conflict
    with pytest.raises(CaseError) as caught:
        many(9)
    (problem,) = caught.value.problems
    assert problem.path == ("shift_elements", 9)
