"""A tape run again on arrays is the calculation."""

from collections.abc import Sequence

import numpy as np
from hypothesis import given, settings

from tests.chance import count
from tests.core.numerics.programs import (
    Program,
    programs,
    rows_for,
    run,
    run_plan,
    same_bits,
    variants,
)
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.tape import Untraceable
from vstatics.core.numerics.traced import Number, plain


def test_the_number_1_is_not_slot_1() -> None:
    """Slot 1 holds 5: a bug once took it for the number 1, and the quotient for the dividend."""

    def quotients(numbers: Sequence[Number]) -> list[Number]:
        one, five = numbers
        return [one / five, 1.0 / five, one - five, 1.0 - five, bool(one < five), bool(five > 2.0)]

    values = np.array([[1.0, 2.0], [5.0, 7.0]])
    rows = rows_for(6, 2)
    assert run_plan(quotients, values, rows).all()
    for variant in range(2):
        expected = quotients(values[:, variant].tolist())
        assert [row[variant] for row in rows.arrays] == expected


@settings(max_examples=count(32, 240))
@given(programs(), variants())
def test_a_program_run_again_is_the_program(program: Program, values: Floats) -> None:
    """For every variant that passes the guards, to the last bit; the first always passes."""
    rows = rows_for(len(program), values.shape[1])
    try:
        passed = run_plan(lambda numbers: run(program, numbers), values, rows)
    except Untraceable:
        return
    assert passed[0]
    for variant in np.flatnonzero(passed).tolist():
        expected = [plain(one) for one in run(program, values[:, variant].tolist())]
        found = [float(row[variant]) for row in rows.arrays]
        assert all(map(same_value, found, expected)), (variant, found, expected)


def same_value(found: float, expected: float) -> bool:
    """To the last bit; a calculation with floats may lead to -0, which is 0 here."""
    return same_bits(found + 0.0, expected + 0.0)
