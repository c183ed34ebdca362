"""One variant of a transmission: the numbers that differ between variants, and its matrix."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.model.transmission import Transmission
from vstatics.numerics.traced import Number
from vstatics.statics.efficiency import Efficiency, efficiencies_by_direction
from vstatics.statics.matrix import Column, columns


class Variant(NamedTuple):
    """A transmission with numbers of its mechanisms: floats, or traced for many variants."""

    case: Transmission
    ratios: Sequence[Number]
    """Internal ratio u of each mechanism. [-]"""
    efficiencies: Sequence[Efficiency]
    columns: Sequence[Column]
    """Of the structural-distribution matrix, without losses."""

    @property
    def direction(self) -> int:
        """+1, or -1 when coasting: all flows turn."""
        return -1 if self.case.coast else 1


def variant_of(
    case: Transmission,
    ratios: Sequence[Number] | None = None,
    efficiencies: Sequence[Number] | None = None,
) -> Variant:
    """A variant; what is not given is the case's own."""
    if ratios is None:
        ratios = [mechanism.ratio for mechanism in case.mechanisms]
    both = efficiencies_by_direction(case, efficiencies)
    return Variant(case, ratios, both, columns(case, ratios))
