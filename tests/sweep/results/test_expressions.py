"""The language of sweeps: what it means, what it refuses and where, columns of --out.

Numbers come from the closed form of one planetary set or from arithmetic
that is written out beside them.
"""

import math
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from tests.strategies import transmissions
from tests.sweep.asked import (
    HELD,
    RATIOS,
    RESULTS,
    SET,
    VALUES,
    VARIED,
    expression,
    number,
    problem,
    value,
)
from vstatics import Gear, Mechanism, Results, Transmission, solve
from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.tables.names import table_rows, written
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.expressions import read_expression
from vstatics.sweep.results.selection import read_where


def test_every_table_of_the_results_can_be_asked_for() -> None:
    arrays = [name for name in Results._fields if name not in ("case", "messages", "points")]
    assert list(ARRAYS) == arrays
    for name, (rows, _) in ARRAYS.items():
        names = table_rows(name, SET)
        shape = (3, 3) if rows == "one" else (3, 3, len(names))
        assert getattr(RESULTS, name).shape == shape
        if 0 not in shape:  # a set without teeth has no meshes
            assert expression(name)(RESULTS, VALUES).shape == shape


def test_tables_rows_and_gears_give_the_numbers_of_a_planetary_set() -> None:
    """Locked in `2`, so all turn with the input; with the ring held in `1R`; free in `N`.

    A name comes before a number: the gear that is called 2 is the first; #2 is the second, and no
    gear is called 1. What does not exist, as the ratio of `N`, is left out of min, max and sum.
    """
    nothing = [math.nan] * 3
    for text, expected in (
        ('speeds[in, "1R"]', 1 / HELD),
        ("speeds[3, #2]", 1 / HELD),
        *((f"speeds[{name},2]", 1) for name in ('"вал"', "'вал'", " вал ", "1", "#1", "01")),
        ('ratio["1R"]', HELD),
        *(("ratio[2]", 1), ("ratio[#2]", HELD), ("ratio[#1]", 1)),
        ('lossy_torques[Mx, "1R"]', 1 - 0.96 * RATIOS),  # M2 = -u*eta*M1
        *((f"{name}.ratio", RATIOS) for name in ("D1", "#1", "'D1'")),
        ("D1.efficiency", 0.96),
        ("sum(abs(speeds[:,2]))", 3),
        ("max(speeds)", 1),
        ('sum(speeds[:,"1R"])', 1 + 1 / HELD),
        ("max(slip_speeds['4-5'])", 1),  # the ring's own speed in 2
        *(("min(ratio)", 1), ("max(ratio)", HELD), ("sum(ratio)", 1 + HELD)),
        ('max(ratio[N], ratio["1R"])', HELD),
        *((f"{function}(ratio[N])", nothing) for function in ("", "min", "max", "sum")),
        ("ratio[N] + 1", nothing),
    ):
        assert value(text) == pytest.approx(expected, nan_ok=True), text
    assert "did you mean `1R`?; #1 is 2" in problem("ratio[1]").message


def test_a_row_or_a_gear_alone_gives_all_gears_or_rows() -> None:
    speeds = expression("speeds[in]")
    assert (speeds.gears, speeds.rows) == (("2", "1R", "N"), None)
    assert speeds(RESULTS, VALUES)[:, :2] == pytest.approx(np.column_stack([[1] * 3, 1 / HELD]))
    speeds = expression('speeds[:, "1R"]')
    assert (speeds.gears, speeds.rows) == (None, ("вал", "ring 1", "in"))
    expected = np.column_stack([[1] * 3, [0] * 3, 1 / HELD])
    assert speeds(RESULTS, VALUES) == pytest.approx(expected)


def test_names_are_taken_letter_by_letter() -> None:
    """A Python parser would take ﬁ for fi, and `in` for no name."""
    names = ("ﬁ", "fi", "in")
    case = Transmission(
        3, [], [Mechanism(1, 2, 3, -2.0)], [Gear(speeds={2: 0.5})], link_names=names
    )
    ends = read_columns("speeds[ﬁ,1],speeds[fi,1],speeds[in,1]", case, [])
    results = solve(case, ratios=np.array([[-2.0]]))
    # w3 = (w1 - u*w2)/(1 - u) = (1 + 2*0.5)/3
    assert ends(results, np.zeros((1, 0))) == pytest.approx(np.array([[1, 0.5, 2 / 3]]))


def test_marks_count_as_1_and_0_and_do_not_exist_without_a_solution() -> None:
    """As in the JSON of `run`; nothing can be said of the losses of a neutral gear."""
    assert value("tied_up + missing").tolist() == [[0, 0, 1]] * 3  # nothing is engaged in N
    assert number("sum(tied_up == 0) * 2") == 6
    assert number("idle[D1, 2]") == 1
    for text in ("locked[N]", "consistent[N]", "idle[D1,N]"):
        assert np.isnan(value(text)).all()
    assert number("locked[N] == 0") == 0
    assert number("sum(locked)") == 0
    assert number("tied_up[N]") == 0


def test_arithmetic_is_that_of_python() -> None:
    """Chains are those of Python, too: `1 < 2 == 1` is `1 < 2 and 2 == 1`."""
    for text, expected in {
        "2 + 3*4**2": 50,
        "-2**2": -4,
        "2**-1": 0.5,
        "2**3**2": 512,
        "1 - 2 - 3": -4,
        "8/4/2": 1,
        "(1 - 2)*-3": 3,
        "+.5e1": 5,
        "1 < 2 < 3": 1,
        "3 > 2 > 2": 0,
        "1 < 2 == 1": 0,
        "(1 < 2) == 1": 1,
        "1 or 0 and 0": 1,
        "not 1 > 2": 1,
        "not not 3": 1,
        "(1)and(0)": 0,
        "1 != 2": 1,
        "1 >= 1": 1,
        "1 <= 0": 0,
        "(2 > 1) + (3 > 1)": 2,
        "-(2 > 1)": -1,
        "min(3, 1, 2)": 1,
        "max(3, 1 + 3, 2)": 4,
        "abs(-3)": 3,
        "sum(3)": 3,
        "min\n( 3,\t2)": 2,
        "9**9**9": math.inf,
        "1/0": math.inf,
        "0/0": math.nan,
        "(-8)**(1/3)": math.nan,
    }.items():
        assert number(text) == pytest.approx(expected, rel=0, abs=0, nan_ok=True), text


def test_what_does_not_exist_is_no_true_condition() -> None:
    for sign in ("<", "<=", ">", ">=", "==", "!="):
        assert number(f"0/0 {sign} 1") == number(f"0/0 {sign} 0/0") == 0, sign
    assert number("0/0 and 1") == 0
    assert number("0/0 or 0") == 0
    assert number("not 0/0") == 1
    for text in ("0/0", "1/0", "-1/0", "0 or 1/0"):
        where = read_where(text, SET, VARIED)
        passed, _ = where.passed(RESULTS, VALUES, np.zeros(3, dtype=np.bool_))
        assert passed.tolist() == [False, False, False]
    assert number("1/0 > 3") == 1


def test_one_value_per_gear_is_spread_over_rows() -> None:
    product = expression("speeds*ratio")
    assert (product.gears, product.rows) == (("2", "1R", "N"), ("вал", "ring 1", "in"))
    made = product(RESULTS, VALUES)
    assert made.shape == (3, 3, 3)
    assert made[:, 1] == pytest.approx(np.column_stack([HELD, [0] * 3, [1] * 3]))
    assert value('ratio - ratio["1R"]')[:, 1].tolist() == [0, 0, 0]
    assert value("speeds - speeds[:,2]")[:, 0].tolist() == [[0] * 3] * 3
    assert value("speeds + D1.ratio")[:, 0, 0] == pytest.approx(1 + RATIOS)
    assert expression("lossy_torques*torques").rows == ("F", "4-5", "D1", "Mx")
    assert expression("losses*power_sign").rows == ("D1",)


def reversed_in_memory(results: Results) -> Results:
    """The same results with the variants last in memory, every other one left out."""
    arrays: dict[str, Any] = {}
    for name in ARRAYS:
        array = np.moveaxis(getattr(results, name), 0, -1)
        arrays[name] = np.moveaxis(np.repeat(array, 2, axis=-1)[..., ::2], -1, 0)
    return results._replace(**arrays)


def test_strides_do_not_matter_and_a_selection_is_a_view() -> None:
    for text in ("speeds", "speeds[in]", "max(abs(torques))", "sum(ratio)", "missing*ratio"):
        made, reversed_results = expression(text), reversed_in_memory(RESULTS)
        np.testing.assert_array_equal(made(reversed_results, VALUES), made(RESULTS, VALUES))
    assert np.shares_memory(value("speeds[in]"), RESULTS.speeds)
    assert np.shares_memory(value("ratio"), RESULTS.ratio)


def test_no_variants_have_no_values_and_one_case_is_calculated_alike() -> None:
    results = solve(SET, ratios=np.zeros((0, 1)))
    values = np.zeros((0, 1))
    assert expression("max(ratio) < 3")(results, values).shape == (0,)
    assert read_columns("ratio,1", SET, VARIED)(results, values).shape == (0, 4)
    own = read_expression("max(ratio)", SET, [], "--out")
    assert own(solve(SET), np.zeros(0)) == pytest.approx(3.5)  # 1 - (-2.5)


def test_an_expression_of_100_operations_goes_to_other_processes() -> None:
    deepest = expression("1" + " + 1" * 99)
    assert deepest(RESULTS, VALUES).tolist() == [100] * 3
    assert pickle.loads(pickle.dumps(deepest)) == deepest  # noqa: S301
    assert "more than 100 nested operations" in problem("1" + " + 1" * 100).message


@settings(max_examples=15)
@given(transmissions())
def test_every_mechanism_can_be_named(case: Transmission) -> None:
    names = [mechanism.name for mechanism in case.mechanisms]
    for index, mechanism in enumerate(case.mechanisms):
        name = written(index, names)
        if name.isdigit():
            name = f"'{name}'"  # 1.ratio begins like a number
        own = read_expression(f"{name}.ratio", case, [], "--min")
        assert own(solve(case), np.zeros(0)) == mechanism.ratio
