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


def examples(few: int, usual: int, nightly: int) -> pytest.MarkDecorator:
    """Parametrise a test by its number of examples; `make test` runs only the smaller one."""
    return pytest.mark.parametrize("examples", [nightly] if FRESH else [few, usual])


def some(cases: Sequence[Each]) -> Sequence[Each]:
    """Every third case, all of them by `make nightly`."""
    return cases[:: count(3, 1)]


def with_slow(quick: Iterable[object], slow: Iterable[object]) -> list[Any]:
    """Return parameters of a test: quick ones, then others that carry the mark `slow`."""
    return [*quick, *(pytest.param(each, marks=pytest.mark.slow) for each in slow)]


def each_seed(usual: int, nightly: int = 0) -> pytest.MarkDecorator:
    """Parametrise a test by seeds, of which `make nightly` may try more."""
    return pytest.mark.parametrize("seed", range(count(usual, nightly or usual)))


def seeds_with_slow(few: int, usual: int, nightly: int = 0) -> pytest.MarkDecorator:
    """Parametrise a test by seeds; all but a few first ones carry the mark `slow`."""
    more = range(few, count(usual, nightly or usual))
    return pytest.mark.parametrize("seed", with_slow(range(few), more))


def ranges_with_slow(
    few: int | range, usual: int, nightly: int, start: int = 0
) -> pytest.MarkDecorator:
    """Parametrise a test by half of a range of seeds, the whole range, and further, slow seeds."""
    quick = range(few) if isinstance(few, int) else few
    more = range(start or quick.stop, start + count(usual, nightly))
    return pytest.mark.parametrize("seeds", with_slow([quick[: len(quick) // 2], quick], [more]))
