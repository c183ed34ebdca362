"""Samples: scipy's numbers, in any blocks, within their ranges."""

import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.rejects import rejects
from tests.sweep.sweeps import in_parts, variations
from vstatics.core.errors import CaseError
from vstatics.core.numerics.steps import Steps
from vstatics.sweep.variants import samples
from vstatics.sweep.variants.samples import METHODS, Method, Sample
from vstatics.sweep.variants.variation import Span

qmc = pytest.importorskip("scipy.stats").qmc
UNIT = variations(Span(0.0, 1.0), Span(0.0, 1.0), Span(0.0, 1.0))
methods = st.sampled_from(METHODS)


@given(methods, st.integers(1, 300), st.integers(0, 9), st.lists(st.integers(0, 300)))
def test_a_sample_is_the_same_in_any_blocks(
    method: Method, count: int, seed: int, cuts: list[int]
) -> None:
    sample = Sample(UNIT, count, method, seed)
    assert np.array_equal(in_parts(sample, cuts), sample.block(0, count))


@pytest.mark.parametrize("method", METHODS)
def test_the_seed_decides(method: Method) -> None:
    sample = Sample(UNIT, 100, method, 1)
    whole = sample.block(0, 100)
    assert not np.isin(Sample(UNIT, 100, method, 2).block(0, 100), whole).any()
    unseeded, first = Sample(UNIT, 9, method), Sample(UNIT, 9, method, 0)
    assert np.array_equal(unseeded.block(0, 9), first.block(0, 9))
    copy = pickle.loads(pickle.dumps(sample))  # noqa: S301
    assert np.array_equal(copy.block(50, 60), whole[50:60])
    assert whole.flags.f_contiguous


@pytest.mark.parametrize("seed", [0, 7])
@pytest.mark.parametrize("dimensions", [1, 3, 40])
def test_sobol_is_scipys(dimensions: int, seed: int) -> None:
    """To the bit, from any point of the sequence on, and at its end."""
    spans = variations(*[Span(0.0, 1.0)] * dimensions)
    sample = Sample(spans, 2**20, "sobol", seed)
    engine = qmc.Sobol(dimensions, rng=np.random.default_rng(seed))
    assert np.array_equal(sample.block(0, 2**14), engine.random(2**14))
    for start, stop in ((65_530, 65_541), (200_001, 300_000), (2**20 - 1, 2**20)):
        engine.reset().fast_forward(start)
        assert np.array_equal(sample.block(start, stop), engine.random(stop - start))
    longer = Sample(spans, 2**20 + 2, "sobol", seed)
    assert np.array_equal(longer.block(2**20, 2**20 + 2), engine.random(2))


def test_a_latin_hypercube_is_scipys_and_random_numbers_are_numpys_row_by_row() -> None:
    for count in (1, 10, 1000):
        whole = Sample(UNIT, count, "lhs", 5).block(0, count)
        engine = qmc.LatinHypercube(3, rng=np.random.default_rng(5))
        assert np.array_equal(whole, engine.random(count))
        generator = np.random.Generator(np.random.PCG64(3))
        plain = Sample(UNIT, count, "random", 3).block(0, count)
        assert np.array_equal(plain, generator.random((count, 3)))


@given(methods, st.floats(-1e308, 1e308), st.floats(-1e308, 1e308), st.integers(1, 40))
def test_a_sample_lies_in_its_range(method: Method, one: float, other: float, number: int) -> None:
    """64 points in 4 values: the points of a Sobol sequence fill quarters evenly."""
    low, high = sorted((one, other))
    listed = [float(value) for value in range(number)]
    varied = variations(Span(low, high), listed, Steps(0.0, number - 1.0, number), [1, 2, 3, 4])
    sample = Sample(varied, 64, method, number).block(0, 64)
    assert ((low <= sample[:, 0]) & (sample[:, 0] <= high)).all()
    assert np.isin(sample[:, 1:3], listed).all()
    if method == "sobol":
        assert np.unique(sample[:, 3], return_counts=True)[1].tolist() == [16] * 4


def test_what_cannot_be_sampled() -> None:
    wrong: list[tuple[tuple[Any, ...], str]] = [
        ((UNIT, 0), "read a sample of 0 variants, expected at least 1"),
        ((UNIT, 2**63, "random"), "fewer than 2**63"),
        ((UNIT, 2**30 + 1, "sobol"), "has 1073741824 (2**30); use fewer, or the method `random`"),
        ((UNIT, 5, "sobool"), "expected one of sobol, lhs, random; did you mean `sobol`?"),
        ((UNIT, 5, "random", -1), "read the seed -1, expected 0 or above"),
        (([], 5, "random"), "nothing is varied"),
        ((variations(*[Span(0.0, 1.0)] * 21202), 5, "sobol"), "has 21201; use"),
        ((UNIT[:1] * 2, 5), "D1.ratio is varied twice"),
    ]
    for arguments, words in wrong:
        with rejects(CaseError, words):
            Sample(*arguments)
    assert Sample(UNIT, 2**63 - 1, "random").block(2**63 - 2, 2**63 - 1).shape == (1, 3)
    assert Sample(UNIT, 2**30, "sobol").count == 2**30
    with pytest.raises(CaseError, match="does not fit into memory"):
        Sample(UNIT, 2**50, "lhs").block(0, 1)


def test_without_scipy_random_numbers_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(samples, "find_spec", lambda _: None)
    with pytest.raises(CaseError, match="needs scipy: install it, or use the method `random`"):
        Sample(UNIT, 5)
    assert Sample(UNIT, 5, "random").block(0, 5).shape == (5, 3)
