"""What a sweep keeps: conditions, the best by one, the non-dominated by several.

What is right comes from the definitions, written out below in plain Python.
"""

from __future__ import annotations

import math
import pickle
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from vstatics import Gear, Mechanism, ReadError, ShiftElement, Transmission, solve
from vstatics.sweep.results.selection import best, read_objective, read_where
from vstatics.sweep.variants.targets import target

SET = Transmission(
    3,
    [ShiftElement(1, 2), ShiftElement(2, 0)],
    [Mechanism(1, 2, 3, -2.5, 0.96)],
    [Gear([1]), Gear([2]), Gear(name="N")],
)
"""Locked in gear 1, the ring held in gear 2 (ratio 1 - u), nothing engaged in N."""
RATIOS = np.array([[-2.0], [-2.5], [-3.0]])
VARIED = [target("D1.ratio", SET)]
RESULTS = solve(SET, ratios=RATIOS)

RANDOM = settings(max_examples=count(30, 225))
FEW_VALUES = st.sampled_from([0.0, -0.0, 1.0, 2.0, 3.0, math.nan, math.inf, -math.inf])
ANY_VALUE = st.one_of(FEW_VALUES, st.floats())


NONE = np.zeros(3, dtype=np.bool_)


def passed(text: str) -> list[int]:
    """Whether each variant passes a condition."""
    made: list[int] = read_where(text, SET, VARIED).passed(RESULTS, RATIOS, NONE)[0].tolist()
    return made


# Conditions and objectives


def test_a_condition_is_1_or_0_for_each_variant() -> None:
    assert passed("ratio[2] >= 3.5") == [0, 1, 1]
    assert read_where("ratio[2] >= 3.5", SET, VARIED).text == "ratio[2] >= 3.5"


def test_a_number_is_a_condition_unless_it_is_0_or_does_not_exist() -> None:
    assert passed("D1.ratio + 2") == [0, 1, 1]
    assert passed("ratio[N]") == [0, 0, 0]
    assert passed("locked[1] == 0") == [1, 1, 1]


@pytest.mark.parametrize(
    ("text", "removed"),
    [
        ("ratio[2] > 3 and D1.ratio > -3", (1, 1)),
        ("(ratio[2] > 3 and D1.ratio > -3)", (2,)),
        ("ratio[2] > 3 and D1.ratio > -3 or 1", (0,)),
        ("not locked[1] and 3 < ratio[2] < 4 and 0", (0, 2, 1)),
    ],
)
def test_each_part_between_ands_tells_what_it_removes(text: str, removed: tuple[int, ...]) -> None:
    """Ratios are 3, 3.5 and 4 for -2, -2.5 and -3."""
    assert read_where(text, SET, VARIED).passed(RESULTS, RATIOS, NONE)[1] == removed


def test_a_variant_of_which_nothing_is_known_is_removed() -> None:
    unknown = np.array([False, True, False])
    assert read_where("1 and 1", SET, VARIED).passed(RESULTS, RATIOS, unknown)[1] == (1, 0)


def test_a_large_objective_is_a_small_negative_one() -> None:
    least = read_objective("ratio[2]", SET, VARIED, "--min")
    most = read_objective("ratio[2]", SET, VARIED, "--max")
    assert (least.sign, most.sign) == (1, -1)
    assert least.expression(RESULTS, RATIOS) == pytest.approx(np.array([3, 3.5, 4]))
    assert pickle.loads(pickle.dumps(most)) == most  # noqa: S301


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ratio", "`ratio` has one value per gear: pick a gear, or use min, max or sum"),
        (
            " speeds + 1 ",
            "`speeds + 1` has one value per link and gear: pick a link and a gear, or use",
        ),
        ("torques[:,2]", "has one value per device: pick a device, or use min, max or sum"),
    ],
)
def test_conditions_and_objectives_have_one_value(text: str, message: str) -> None:
    with pytest.raises(ReadError) as caught:
        read_where(text, SET, VARIED)
    with pytest.raises(ReadError) as again:
        read_objective(text, SET, VARIED, "--max")
    (told,), (told_again,) = caught.value.problems, again.value.problems
    assert message in told.message
    assert told.place is not None
    assert (told.place.file, told.place.column) == ("--where", 1 + text.startswith(" "))
    assert told_again.place == told.place._replace(file="--max")


# The best by one


def best_by_definition(values: Sequence[float], count: int) -> list[int]:
    existing = [(value, row) for row, value in enumerate(values) if not math.isnan(value)]
    return [row for _, row in sorted(existing)[:count]]


@RANDOM
@given(st.lists(ANY_VALUE, max_size=60), st.integers(1, 70))
def test_the_best_are_sorted_and_ties_go_to_the_first(values: list[float], count: int) -> None:
    assert best(np.array(values, dtype=float), count).tolist() == best_by_definition(values, count)


@RANDOM
@given(st.lists(ANY_VALUE, max_size=60), st.integers(1, 20), st.integers(1, 20))
def test_the_best_of_chunks_are_the_best_of_all(values: list[float], count: int, size: int) -> None:
    kept: list[int] = []
    for start in range(0, len(values), size):
        rows = [*kept, *range(start, min(start + size, len(values)))]
        kept = [rows[row] for row in best(np.array([values[row] for row in rows]), count)]
    assert kept == best_by_definition(values, count)


# The best by several


# A front with few rows
