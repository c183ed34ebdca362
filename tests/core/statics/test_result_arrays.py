"""The fields of the results: the arrays in their order, between the case and the messages."""

from __future__ import annotations

from tests.commands import MZKT
from vstatics import load, solve
from vstatics.core.statics.result_arrays import ARRAYS, ResultFields


def test_the_arrays_are_declared_in_the_order_of_the_fields() -> None:
    assert ResultFields._fields == ("case", *ARRAYS, "messages", "points")


def test_the_output_torque_is_the_last_row_of_the_torques() -> None:
    """Without losses it is the ratio; gear 1 has 6.230 and 5.934 in the published report."""
    results = solve(load(MZKT))
    assert results.output_torque.tolist() == results.torques[:, -1].tolist()
    assert results.output_torque.round(3)[0] == 6.230
    assert results.lossy_output_torque.round(3)[0] == 5.934
