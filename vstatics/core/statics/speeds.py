"""Speeds of a gear: link speeds, relative speeds in mechanisms, and slip of shift elements."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.named_tuple import NamedTuple
from vstatics.core.numerics import elimination
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.numerics.traced import Number, absolute, is_nothing_beside
from vstatics.core.statics.matrix import Column, speed_rows


class Speeds(NamedTuple):
    """Speeds of a gear; NaN if indeterminate."""

    links: list[Number]
    """Speed of each link. [-]"""
    relative_speeds: list[Number]
    """``w_f - w_h`` of each mechanism, first link minus third; 0 if negligible. [-]"""
    slips: list[Number]
    """Slip speed of each shift element. [-]"""
    consistent: bool
    missing: int
    excess: int
    certain: bool
    """True if the equations keep correct digits in spite of rounding."""


def solve_speeds(case: Transmission, gear: Gear, by_device: Sequence[Column]) -> Speeds:
    """Solve the speed system of a gear.

    Parameters
    ----------
    by_device : sequence of Column
        Speed equations of the devices, from `matrix.rows`.
    """
    differences = [(mechanism.first, mechanism.third) for mechanism in case.mechanisms]
    slips = [(element.first, element.second) for element in case.shift_elements]
    sums = [
        {link - 1: part for link, part in ((first, 1.0), (second, -1.0)) if link != HOUSING}
        for first, second in (*differences, *slips)
    ]
    rows = speed_rows(case, gear, by_device)
    solution, certain = elimination.solve_with_certainty(rows, case.links, sums)
    links = solution.values[: case.links]
    relative = solution.values[case.links : case.links + len(differences)]
    by_link = [0.0, *map(absolute, links)]
    return Speeds(
        links,
        [
            0.0 if is_tie(absolute(speed), by_link[first], by_link[third]) else speed
            for speed, (first, third) in zip(relative, differences, strict=True)
        ],
        solution.values[case.links + len(differences) :],
        solution.consistent,
        solution.missing,
        solution.excess,
        certain,
    )


def is_tie(difference: Number, first: Number, third: Number) -> bool:
    """Return whether `difference` is negligible relative to two speeds (all magnitudes)."""
    return is_nothing_beside(difference, first, TIE) or is_nothing_beside(difference, third, TIE)
