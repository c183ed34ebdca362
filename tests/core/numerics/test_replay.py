"""A tape run again on arrays is the calculation."""

from functools import partial

import numpy as np
from hypothesis import given, settings

from tests.chance import count
from tests.core.numerics.programs import Program, programs, rows_for, run, same_bits, variants
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.plans import plan_of_one_sign, prepared
from vstatics.core.numerics.tape import Untraceable
from vstatics.core.numerics.traced import plain


@settings(max_examples=count(32, 240))
@given(programs(), variants())
def test_a_program_run_again_is_the_program(program: Program, values: Floats) -> None:
    """For every variant that passes the guards, to the last bit; the first always passes.

    A calculation with floats may lead to -0, which is 0 here.
    """
    rows, inputs = rows_for(len(program), values.shape[1]), prepared(values)
    try:
        plan = plan_of_one_sign(partial(run, program), inputs, 0, 1.05)
    except Untraceable:
        return
    with np.errstate(all="ignore"):  # as `solve` does
        passed = plan.suits(inputs) & plan.run(inputs, rows)
    assert passed[0]
    for variant in np.flatnonzero(passed).tolist():
        expected = [plain(one) + 0.0 for one in run(program, values[:, variant].tolist())]
        found = [float(row[variant]) + 0.0 for row in rows.arrays]
        assert all(map(same_bits, found, expected)), (variant, found, expected)
