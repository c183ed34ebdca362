"""What is varied and over which values: texts of --vary, grids, pairs, tables in memory."""

import pickle
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.sweep.sweeps import CASE, in_parts, variations
from vstatics.core.errors import CaseError, Place, Problem, ReadError
from vstatics.core.numerics.steps import Steps
from vstatics.sweep.variants.numbered import VariantGrid, VariantPart, Variants, VariantTable, Zip
from vstatics.sweep.variants.targets import Target
from vstatics.sweep.variants.variation import read_variation


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


def test_what_does_not_go_together() -> None:
    for made in (VariantGrid, Zip):
        (problem,) = problems_of(made, "D1.ratio=1,2", "2.ratio=1,2", "#1.ratio=3,4")
        assert problem.message == "D1.ratio is varied twice, expected each number once"
        assert problem.place == Place("--vary", 1, 1, "#1.ratio=3,4")
        (problem,) = problems_of(made, "D1.ratio=1,2", "2.ratio=1:2")
        assert "such as 1:2:5 for five values, or --sample N" in problem.message
        assert problem.place == Place("--vary", 1, 1, "2.ratio=1:2")
        with pytest.raises(ReadError, match=r"D2\.ratio has no values, expected at least one"):
            made(variations([1], []))
    first, second = problems_of(Zip, "D1.ratio=1,2", "2.ratio=1:2:3", "D1.efficiency=1")
    assert first.message.startswith("D.2=x.ratio has 3 values, but D1.ratio has 2: pairs need")
    assert second.message.startswith("D1.efficiency has 1 value, but D1.ratio has 2: pairs")
    assert second.place == Place("--vary", 1, 1, "D1.efficiency=1")


TABLE = VariantTable([Target("D1.ratio", 0, "ratio")], np.arange(-9.0, -2.0)[:, np.newaxis])
EACH = [
    VariantGrid(variations([1, 2, 3], Steps(0.0, 1.0, 5))),
    Zip(variations([1, 2, 3], Steps(0.0, 1.0, 3))),
    TABLE,
    VariantPart(TABLE, 0, TABLE.count),
]
PART = VariantPart(TABLE, 2, 5)


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
    assert np.array_equal(PART.block(3, 5), TABLE.block(3, 5))  # only of its own variants
    wrong = [(variants, *ends) for ends in ((-1, 1), (2, 1), (0, variants.count + 1))]
    for source, start, stop in (*wrong, (PART, 1, 3), (PART, 4, 6)):
        with pytest.raises(IndexError):
            source.block(start, stop)


def test_a_table_in_memory_is_a_copy_with_a_digest_of_its_own() -> None:
    rows = np.array([[-2.0], [-3.0]])
    table = VariantTable(TABLE.targets, rows)
    rows[:] = 0
    assert table.block(0, 2).tolist() == [[-2], [-3]]
    assert table.digest == VariantTable(TABLE.targets, np.array([[-2.0], [-3.0]])).digest
    assert table.digest != VariantTable(TABLE.targets, rows).digest
    with pytest.raises(ValueError, match=r"expected \(variants, 1\)"):
        VariantTable(TABLE.targets, np.ones((3, 2)))
