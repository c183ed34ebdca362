"""Random numbers of the tests: the same in every run, others and more of them by `make nightly`."""

import os
from collections.abc import Iterable, Sequence
from random import Random
from typing import Any, TypeVar

import numpy as np
import pytest

Each = TypeVar("Each")
FRESH = os.environ.get("VSTATICS_TEST_SEED", "")


def seeded(seed: int) -> Random:
    """Random numbers of Python."""
    return Random(f"{FRESH} {seed}" if FRESH else seed)  # noqa: S311


def generator(*seeds: int) -> np.random.Generator:
    """Random numbers of NumPy."""
    return np.random.default_rng([int(FRESH), *seeds] if FRESH else seeds)


def count(usual: int, nightly: int) -> int:
    """How many examples are tried."""
    return nightly if FRESH else usual


def some(cases: Sequence[Each]) -> Sequence[Each]:
    """Every third case, all of them by `make nightly`."""
    return cases[:: count(3, 1)]


def with_marked(
    plain: Iterable[object], others: Iterable[object], mark: pytest.MarkDecorator
) -> list[Any]:
    """Return parameters of a test: plain ones, then others that carry a mark."""
    return [*plain, *(pytest.param(each, marks=mark) for each in others)]


def each_seed(seeds: range, more: range, mark: pytest.MarkDecorator) -> pytest.MarkDecorator:
    """Parametrise a test by seeds, of which further ones carry a mark."""
    return pytest.mark.parametrize("seed", with_marked(seeds, more, mark))


def seed_ranges(seeds: range, more: range, mark: pytest.MarkDecorator) -> pytest.MarkDecorator:
    """Parametrise a test by a range of seeds, and by a further one that carries a mark."""
    return pytest.mark.parametrize("seeds", with_marked([seeds], [more], mark))
