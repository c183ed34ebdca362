"""Summaries that several tests look at."""

import pytest

from tests.core.summary.gearboxes import summary_of
from vstatics.core.summary import Summary


@pytest.fixture(scope="module")
def zf() -> Summary:
    return summary_of("zf-8hp70.yaml")
