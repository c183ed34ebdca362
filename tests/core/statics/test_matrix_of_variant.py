"""One variant: numbers of mechanisms, and the columns of the matrix that they make."""

import pytest

from vstatics import Gear, Mechanism, Transmission
from vstatics.core.statics.matrix import variant_of

PAIR = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()])


def test_numbers_that_are_not_given_are_those_of_the_case() -> None:
    assert variant_of(PAIR).ratios == [-4.0]
    assert variant_of(PAIR).efficiencies[0].forward == 0.98


@pytest.mark.parametrize("ratio", [-4.0, 2.5])
def test_columns_are_those_of_the_ratios(ratio: float) -> None:
    """docs/method.md: 1 on the first link, -u on the second; the housing has no row."""
    assert list(variant_of(PAIR, [ratio]).columns[0].values()) == [1, -ratio]
