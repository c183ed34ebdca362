"""What is varied and over which values: texts of --vary, grids, pairs, tables in memory."""

from __future__ import annotations

import math
import pickle
from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vstatics.errors import CaseError, Place, Problem, ReadError
from vstatics.model.transmission import Gear, Mechanism, Transmission
from vstatics.numerics.arrays import Floats
from vstatics.sweep.steps import Steps, stepped
from vstatics.sweep.targets import Target, target
from vstatics.sweep.variants import VariantGrid, VariantPart, Variants, VariantTable, Zip
from vstatics.sweep.variation import Span, Variation, read_variation

CASE = Transmission(
    7,
    [],
    [
        Mechanism(1, 2, 3, -2.5),
        Mechanism(3, 4, 5, -2.0, name="D.2=x"),
        Mechanism(5, 6, 7, -3.0, name="1"),
    ],
    [Gear()],
)
NUMBERS = st.floats(-1e6, 1e6).map(lambda number: round(number, 6))


def read(text: str) -> Floats:
    """The values of a text for D1.ratio."""
    values = read_variation(f"D1.ratio={text}", CASE).values
    assert not isinstance(values, Span)
    return values[np.arange(len(values))]


def refusal(text: str) -> tuple[int, str]:
    """The column of the first problem, and all messages."""
    with pytest.raises(ReadError) as caught:
        read_variation(text, CASE)
    problems = caught.value.problems
    place = problems[0].place
    assert place is not None
    assert (place.file, place.line, place.text) == ("--vary", 1, text)
    return place.column, "\n".join(problem.message for problem in problems)


def variations(*lists: list[float] | Steps | Span) -> list[Variation]:
    """Variations of any numbers; targets may be any here."""
    return [
        Variation(
            Target(f"D{number}.ratio", number - 1, "ratio"),
            np.array(values, float) if isinstance(values, list) else values,
        )
        for number, values in enumerate(lists, 1)
    ]


def in_parts(variants: Variants, cuts: list[int]) -> Floats:
    """All blocks between cuts, asked for from the last to the first."""
    ends = sorted({0, variants.count, *(cut % (variants.count + 1) for cut in cuts)})
    blocks = [variants.block(*two) for two in reversed(list(pairwise(ends)))]
    return np.concatenate([np.empty((0, len(variants.targets))), *blocks[::-1]])


@pytest.mark.parametrize(
    ("text", "name", "index", "quantity"),
    [
        ("D1.ratio", "D1.ratio", 0, "ratio"),
        (" #1.efficiency ", "D1.efficiency", 0, "efficiency"),
        ("2.ratio", "D.2=x.ratio", 1, "ratio"),
        ("1.ratio", "1.ratio", 2, "ratio"),  # a name first, then a number
        ("#3.ratio", "1.ratio", 2, "ratio"),
        ("D.2=x.ratio", "D.2=x.ratio", 1, "ratio"),
        ('"D.2=x".ratio', "D.2=x.ratio", 1, "ratio"),
    ],
)
def test_a_number_is_named_as_the_case_names_it(
    text: str, name: str, index: int, quantity: str
) -> None:
    assert target(text, CASE) == (name, index, quantity)
    assert read_variation(f"{text}=1,2", CASE).target == (name, index, quantity)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        (".95,.97,.98", [0.95, 0.97, 0.98]),
        (" .95 , -96/39 ", [0.95, -96 / 39]),
        ("-2.5", [-2.5]),
        ("1:2:3", [1, 1.5, 2]),
        ("2:1:3", [2, 1.5, 1]),
        (" 1 : 2 : 3 ", [1, 1.5, 2]),
        ("1:1:1", [1]),
        ("1:1:3", [1, 1, 1]),
        ("0:1/3:2", [0, 1 / 3]),
        ("1:2:step=.25", [1, 1.25, 1.5, 1.75, 2]),
        ("1:2:step=0.3", [1, 1.3, 1.6, 1.9]),
        ("2:1: step = -0.5", [2, 1.5, 1]),
        ("1:1:step=0.5", [1]),
        ("0:1:step=1/3", [0, 1 / 3, 2 / 3, 1]),  # 1/3 is not a double; the end is hit
        ("0:1:step=5", [0]),
    ],
)
def test_values(text: str, values: list[float]) -> None:
    assert read(text).tolist() == values


def test_what_can_be_no_ratio_is_left_to_the_result() -> None:
    """A variant that is none becomes a row marked so; see STATUS in chunk.py."""
    assert read("0,1,-inf,+INF").tolist() == [0, 1, -math.inf, math.inf]
    assert np.isnan(read("nan,-nan")).all()


def test_a_range_without_a_count_is_for_samples() -> None:
    for text in ("-0.9:-0.7", "-0.7:-0.9"):
        assert read_variation(f"D1.ratio={text}", CASE).values == Span(-0.9, -0.7)


@pytest.mark.parametrize(
    ("text", "column", "words"),
    [
        ("D9.ratio=1", 1, "no mechanism `D9`, expected one of D1, D.2=x, 1"),
        ("D11.ratio=1", 1, "expected one of D1, D.2=x, 1; did you mean `D1`?"),
        ("  #4.ratio=1", 3, "expected the number of a mechanism, #1 to #3"),
        ("#0.ratio=1", 1, "#1 to #3"),
        ("D1.ratoi=1", 4, "read `ratoi`, expected `ratio` or `efficiency`; did you mean `ratio`?"),
        ("D1ratio=1", 1, "expected a mechanism, then `.ratio`"),
        ("D1ratio=1", 1, "did you mean `D1.ratio`?"),
        (".ratio=1", 1, "expected a mechanism"),
        ("=1", 1, "read nothing, expected a mechanism"),
        ("D1.ratio", 9, "read `D1.ratio` without values, expected D1.ratio= and then START:STOP"),
        ("D1.ratio=", 10, "read no values"),
        ("D1.ratio=1,x,3", 12, "read `x`, expected a number or a fraction"),
        ("D1.ratio=1, 1_0,3", 13, "read `1_0`"),
        ("D1.ratio=1,,3", 12, "read nothing, expected a number"),
        ("D1.ratio=1,", 12, "read nothing"),
        ("D1.ratio=+-nan", 10, "read `+-nan`"),
        ("D1.ratio=1/0", 10, "a denominator other than 0"),
        ("D1.ratio=0,7:0,9:3", 10, "with a decimal point"),
        ("D1.ratio=1:nan:3", 12, "read `nan`, expected a number"),
        ("D1.ratio=1:2:0.1", 14, "read `0.1`, expected how many values, such as 201, or a step"),
        ("D1.ratio=1:2:9999999999999999999", 14, "expected how many values"),
        ("D1.ratio=1:2:", 14, "read nothing, expected how many values"),
        ("D1.ratio=1:2:1", 14, "read 1, expected at least 2 values: both ends are included"),
        ("D1.ratio=1:2:3:4", 16, "read a fourth part"),
        ("D1.ratio=1:2:step=0", 19, "expected a step other than 0"),
        ("D1.ratio=2:1:step=.5", 19, "does not lead from 2 to 1, expected step=-0.5"),
        ("D1.ratio=1:2:step= x", 20, "read `x`, expected a number"),
        ("D1.ratio=0:1e300:step=1e-300", 23, "expected a larger step"),
    ],
)
def test_what_is_wrong_is_told_with_its_column(text: str, column: int, words: str) -> None:
    found, messages = refusal(text)
    assert words in messages
    assert found == column


def test_every_wrong_number_of_a_list_is_told() -> None:
    _, messages = refusal("D1.ratio=a,1,b")
    assert [line.partition(",")[0] for line in messages.split("\n")] == ["read `a`", "read `b`"]
    assert len(refusal("D1.ratio=" + "x" * 1000)[1]) < 200


def test_a_text_may_stand_elsewhere() -> None:
    """In a sweep file, say."""
    with pytest.raises(ReadError) as caught:
        read_variation("D1.ratio=1,x", CASE, Place("sweep.yaml", 7, 5, "  - D1.ratio=1,x"))
    assert caught.value.problems[0].place == Place("sweep.yaml", 7, 16, "  - D1.ratio=1,x")


def test_a_case_without_mechanisms_has_nothing_to_vary() -> None:
    with pytest.raises(ReadError, match="has no mechanisms"):
        target("D1.ratio", Transmission(2, [], [], [Gear()]))


@given(NUMBERS, NUMBERS, st.integers(2, 1000))
def test_steps_are_those_of_linspace(start: float, stop: float, number: int) -> None:
    steps = Steps(start, stop, number)[np.arange(number)]
    assert (steps[0], steps[-1]) == (start, stop)
    size = max(abs(start), abs(stop))
    np.testing.assert_allclose(
        steps, np.linspace(start, stop, number), rtol=1e-14, atol=1e-14 * size
    )


@given(st.integers(-2000, 2000), st.integers(1, 50), st.integers(1, 300))
def test_steps_of_short_decimals_are_as_if_written_by_hand(
    start: int, step: int, number: int
) -> None:
    """Thousandths, whose doubles are those of their texts: no 5e-17 in place of 0."""
    written = [float(f"{start + step * index}e-3") for index in range(number)]
    text = f"{start}e-3:{start + step * (number - 1)}e-3"
    assert read(f"{text}:step={step}e-3").tolist() == written
    assert number == 1 or read(f"{text}:{number}").tolist() == written


@given(st.floats(-1e300, 1e300), st.floats(-1e300, 1e300), st.integers(2, 9))
def test_steps_of_any_numbers_have_their_ends(start: float, stop: float, number: int) -> None:
    steps = Steps(start, stop, number)[np.arange(number)]
    assert (steps[0], steps[-1]) == (start, stop)
    assert np.isfinite(steps).all()


@given(NUMBERS, NUMBERS, st.floats(1e-3, 1e3))
def test_steps_end_at_or_before_the_stop(start: float, stop: float, step: float) -> None:
    made = stepped(start, stop, math.copysign(step, stop - start))
    assert made is not None
    assert abs(stop - made.stop) < step
    assert min(start, stop) <= made.stop <= max(start, stop)


def test_steps_are_made_only_when_they_are_asked_for() -> None:
    steps = Steps(0.0, 1.0, 10**15 + 1)
    assert steps[np.array([0, 10**15 // 2, 10**15])].tolist() == [0, 0.5, 1]
    with pytest.raises(ValueError, match="finite"):
        Steps(0.0, math.inf, 3)[np.arange(3)]


@given(st.lists(st.lists(st.floats(-9, 9), min_size=1, max_size=6), max_size=4))
def test_a_grid_is_every_value_with_every_other(lists: list[list[float]]) -> None:
    """The order is that of `itertools.product`, like nested loops."""
    grid = VariantGrid(variations(*lists))
    assert list(map(tuple, grid.block(0, grid.count).tolist())) == list(product(*lists))


@given(st.lists(st.integers(1, 7), min_size=1, max_size=4), st.lists(st.integers(0, 10**4)))
def test_a_grid_is_the_same_in_any_blocks(numbers: list[int], cuts: list[int]) -> None:
    grid = VariantGrid(variations(*(Steps(0.0, number - 1.0, number) for number in numbers)))
    assert np.array_equal(in_parts(grid, cuts), grid.block(0, grid.count))


def test_the_largest_grid_and_one_too_large() -> None:
    """2**63 - 1 = 7 * 7 * 73 * 127 * 337 * 92737 * 649657."""
    sizes = (7, 7, 73, 127, 337, 92737, 649657)
    grid = VariantGrid(variations(*(Steps(0.0, size - 1.0, size) for size in sizes)))
    assert grid.count == 2**63 - 1
    assert grid.block(grid.count - 1, grid.count).tolist() == [[size - 1 for size in sizes]]
    with pytest.raises(CaseError, match=r"the grid has 10000000000000000000000 variants.*2\*\*63"):
        VariantGrid(variations(Steps(0, 1, 10**11), Steps(0, 1, 10**11)))


@given(st.integers(1, 30), st.lists(st.integers(0, 100)))
def test_pairs(count: int, cuts: list[int]) -> None:
    pairs = Zip(variations(list(range(count)), Steps(0.0, float(count > 1), count)))
    whole = pairs.block(0, count)
    assert whole[:, 0].tolist() == list(range(count))
    assert whole[:, 1].tolist() == [index / max(count - 1, 1) for index in range(count)]
    assert np.array_equal(in_parts(pairs, cuts), whole)


def problems_of(made: Any, *texts: str) -> list[Problem]:
    with pytest.raises(ReadError) as caught:
        made([read_variation(text, CASE) for text in texts])
    return caught.value.problems


@pytest.mark.parametrize("made", [VariantGrid, Zip])
def test_what_does_not_go_together(made: Any) -> None:
    (problem,) = problems_of(made, "D1.ratio=1,2", "2.ratio=1,2", "#1.ratio=3,4")
    assert problem.message == "D1.ratio is varied twice, expected each number once"
    assert problem.place == Place("--vary", 1, 1, "#1.ratio=3,4")
    (problem,) = problems_of(made, "D1.ratio=1,2", "2.ratio=1:2")
    assert "expected one such as 1:2:201, or a sample" in problem.message
    assert problem.place == Place("--vary", 1, 1, "2.ratio=1:2")


def test_nothing_but_an_empty_list() -> None:
    for made in (VariantGrid, Zip):
        with pytest.raises(ReadError, match=r"D2\.ratio has no values, expected at least one"):
            made(variations([1], []))


def test_pairs_need_equally_many_values() -> None:
    first, second = problems_of(Zip, "D1.ratio=1,2", "2.ratio=1:2:3", "D1.efficiency=1")
    assert first.message == (
        "D.2=x.ratio has 3 values, but D1.ratio has 2: pairs need as many of each"
    )
    assert second.place == Place("--vary", 1, 1, "D1.efficiency=1")


TABLE = VariantTable([Target("D1.ratio", 0, "ratio")], np.arange(-9.0, -2.0)[:, np.newaxis])
EACH = [
    VariantGrid(variations([1, 2, 3], Steps(0.0, 1.0, 5))),
    Zip(variations([1, 2, 3], Steps(0.0, 1.0, 3))),
    TABLE,
    VariantPart(TABLE, 0, TABLE.count),
]


@pytest.mark.parametrize("variants", EACH)
def test_variants_of_each_kind(variants: Variants) -> None:
    whole = variants.block(0, variants.count)
    assert whole.shape == (variants.count, len(variants.targets))
    assert whole.flags.f_contiguous
    assert variants.block(2, 2).shape == (0, len(variants.targets))
    assert np.array_equal(in_parts(variants, [2, 1]), whole)
    copy = pickle.loads(pickle.dumps(variants))  # noqa: S301
    assert (copy.targets, copy.count) == (variants.targets, variants.count)
    assert np.array_equal(copy.block(1, 3), whole[1:3])
    whole[:] = 0  # blocks are the caller's own
    assert variants.block(0, 1).any()
    for start, stop in ((-1, 1), (2, 1), (0, variants.count + 1)):
        with pytest.raises(IndexError):
            variants.block(start, stop)


def test_a_part_has_its_own_variants_only() -> None:
    part = VariantPart(TABLE, 2, 5)
    assert part.count == TABLE.count
    assert np.array_equal(part.block(3, 5), TABLE.block(3, 5))
    for start, stop in ((1, 3), (4, 6)):
        with pytest.raises(IndexError):
            part.block(start, stop)


def test_a_table_in_memory_is_a_copy_with_a_digest_of_its_own() -> None:
    rows = np.array([[-2.0], [-3.0]])
    table = VariantTable(TABLE.targets, rows)
    rows[:] = 0
    assert table.block(0, 2).tolist() == [[-2], [-3]]
    assert table.digest == VariantTable(TABLE.targets, np.array([[-2.0], [-3.0]])).digest
    assert table.digest != VariantTable(TABLE.targets, rows).digest
    with pytest.raises(ValueError, match=r"expected \(variants, 1\)"):
        VariantTable(TABLE.targets, np.ones((3, 2)))
