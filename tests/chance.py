"""Random numbers of the tests: the same in every run, others and more of them by `make nightly`."""

from __future__ import annotations

import os
from random import Random

import numpy as np

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
