"""Speeds of a gear: of links, of mechanisms against their third link, of slip."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.numerics.traced import Number, absolute, is_nothing_beside
from vstatics.core.statics.matrix import Column, speed_rows


class Speeds(NamedTuple):
    """The speeds of a gear. NaN: not determined."""

    links: list[Number]
    """By link. [-]"""
    relative_speeds: list[Number]
    """By mechanism: ``w_f - w_h``, the first link against the third; 0 where it is a tie. [-]"""
    slips: list[Number]
    """By shift element. [-]"""
    consistent: bool
    missing: int
    excess: int
    certain: bool
    """Rounding leaves digits of what they are made from."""


def solve_speeds(case: Transmission, gear: Gear, by_device: Sequence[Column]) -> Speeds:
    """Solve the speed system of a gear.

    Parameters
    ----------
    by_device : sequence of Column
        The equations of devices, `matrix.rows`.
    """
    differences = [(mechanism.first, mechanism.third) for mechanism in case.mechanisms]
    slips = [(element.first, element.second) for element in case.shift_elements]
    sums = [_difference(*pair) for pair in (*differences, *slips)]
    rows = speed_rows(case, gear, by_device)
    solution, certain = elimination.solve_told(rows, case.links, sums)
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


def _difference(first: int, second: int) -> dict[int, float]:
    """The difference of two link speeds as a sum of unknowns."""
    terms = {first - 1: 1.0, second - 1: -1.0}
    terms.pop(HOUSING - 1, None)
    return terms


def is_tie(difference: Number, first: Number, third: Number) -> bool:
    """Whether a difference of speeds is nothing beside the speeds themselves; magnitudes all."""
    return is_nothing_beside(difference, first, TIE) or is_nothing_beside(difference, third, TIE)
