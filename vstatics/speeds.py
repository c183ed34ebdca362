"""Speeds of a gear: of links, of mechanisms against their third link, of slip."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics import elimination, matrix
from vstatics.arrays import Booleans, Floats, Integers
from vstatics.model import HOUSING, Gear, Transmission

TIE = 1e-9
"""Speeds, or torques on a link, that differ by less than this part are the same."""


class Speeds(NamedTuple):
    """The speeds of a gear; the variants are the last axis. NaN: not determined."""

    links: Floats
    """(links, variants). [-]"""
    motion: Floats
    """(mechanisms, variants): first link against the third, 0 where it is a tie. [-]"""
    slips: Floats
    """(shift elements, variants). [-]"""
    consistent: Booleans
    missing: Integers
    excess: Integers


def solve_speeds(case: Transmission, gear: Gear, ratios: Floats) -> Speeds:
    """Solve the speed system of a gear.

    Parameters
    ----------
    ratios : ndarray, shape (mechanisms, variants)
        Internal ratios. [-]
    """
    differences = [(mechanism.first, mechanism.third) for mechanism in case.mechanisms]
    slips = [(element.first, element.second) for element in case.shift_elements]
    sums = [_difference(*pair) for pair in (*differences, *slips)]
    rows = matrix.speed_rows(case, gear, matrix.columns(case, ratios))
    solution = elimination.solve(rows, case.links, sums, variants=ratios.shape[1])
    links, motion, slip = np.split(solution.values, [case.links, case.links + len(differences)])
    return Speeds(
        links,
        _without_ties(case, links, motion),
        slip,
        solution.consistent,
        solution.missing,
        solution.excess,
    )


def _difference(first: int, second: int) -> dict[int, float]:
    """The difference of two link speeds as a sum of unknowns."""
    terms = {first - 1: 1.0, second - 1: -1.0}
    terms.pop(HOUSING - 1, None)
    return terms


def _without_ties(case: Transmission, links: Floats, motion: Floats) -> Floats:
    """The motion of the mechanisms, 0 where it is nothing beside the speeds themselves."""
    speeds = np.concatenate([np.zeros((1, links.shape[1])), np.abs(links)])
    first = speeds[[mechanism.first for mechanism in case.mechanisms]]
    third = speeds[[mechanism.third for mechanism in case.mechanisms]]
    return np.where(np.abs(motion) <= TIE * np.fmax(first, third), 0.0, motion)
