"""Results that several tests write."""

import pytest

from tests.commands import MZKT
from tests.core.writers.result_cases import NAMED
from vstatics import Results, load, solve


@pytest.fixture(scope="module")
def published() -> Results:
    return solve(load(MZKT))


@pytest.fixture(scope="module")
def several() -> Results:
    return solve(NAMED)
