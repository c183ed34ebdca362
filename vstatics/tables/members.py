"""Torques that links give to the members of elements: sums of torques of mechanisms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.elements.lower import DrawnPart
from vstatics.numerics.arrays import Floats
from vstatics.statics import drag
from vstatics.statics.results import Results
from vstatics.statics.torques import solve_sums

Members = dict[str, Floats]
"""Member -> torque that its link gives to it, of shape (gears,). [-]"""

Terms = list[tuple[int, Floats]]
"""Indices of devices, each with the share that a member has of its torque in each gear."""


def member_torques(results: Results, made: Sequence[DrawnPart], *, lossy: bool) -> list[Members]:
    """For each part of a case, the torques that links give to its members.

    Parameters
    ----------
    results : Results
        Of one case.
    made : sequence of DrawnPart
        Its parts.
    lossy : bool
        Whether with losses.

    Examples
    --------
    >>> from vstatics.elements.lower import parts_of
    >>> from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.statics.solve import solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> member_torques(solve(case), parts_of(case), lossy=False)
    [{'first': array([1.]), 'second': array([2.5]), 'third': array([-3.5])}]
    """
    ratios = _lossy_ratios(results) if lossy else _ratios(results)
    torques = results.lossy_torques if lossy else results.torques
    terms = list(_terms(made, len(results.case.shift_elements), ratios))
    nothing = np.zeros(len(torques))
    with np.errstate(all="ignore"):
        found = [
            {
                name: sum((share * torques[:, n] for n, share in shares), nothing)
                for name, shares in of_part.items()
            }
            for of_part in terms
        ]
    exists = results.consistent if lossy else results.calculable
    for gear in np.flatnonzero(exists & ~np.isnan(ratios).any(axis=1)).tolist():
        open_ones = [
            (members, name, {n: float(share[gear]) for n, share in of_part[name]})
            for members, of_part in zip(found, terms, strict=True)
            for name in members
            if np.isnan(members[name][gear])
        ]
        if open_ones:  # a sum may be determined where its parts are not
            sums = [shares for _, _, shares in open_ones]
            values = _solve_sums(results, gear, ratios[gear].tolist(), sums, lossy=lossy)
            for (members, name, _), value in zip(open_ones, values, strict=True):
                members[name][gear] = value
    return found


def _ratios(results: Results) -> Floats:
    """Internal ratios, of shape (gears, mechanisms)."""
    internal = [mechanism.ratio for mechanism in results.case.mechanisms]
    return np.tile(np.array(internal, dtype=np.float64), (len(results.case.gears), 1))


def _lossy_ratios(results: Results) -> Floats:
    """Internal ratios with losses; NaN where power can't flow, or nobody knows which way."""
    given = [(one.efficiency, one.back_efficiency) for one in results.case.mechanisms]
    forward = np.array([one for one, _ in given])
    # a self-locking one never has power flow back
    back = 1 / np.array([(one if other is None else other) or np.nan for one, other in given])
    signs = results.power_sign
    factor = np.where(signs > 0, forward, np.where(signs < 0, back, 1.0))
    return np.where(np.isnan(signs), np.nan, _ratios(results) * factor)


def _terms(made: Sequence[DrawnPart], elements: int, ratios: Floats) -> Iterator[dict[str, Terms]]:
    """For each part and member, what its torque is the sum of; `elements` stand before."""
    device = elements
    for part in made:
        terms: dict[str, Terms] = {member: [] for member in part.members}
        for lowered in part.lowered:
            ratio = ratios[:, device - elements]
            shares = np.ones_like(ratio), -ratio, ratio - 1
            for member, share in zip(lowered.members, shares, strict=True):
                if member in terms:
                    terms[member].append((device, share))
            device += 1
        yield terms


def _solve_sums(
    results: Results,
    gear: int,
    ratios: list[float],
    sums: list[dict[int, float]],
    *,
    lossy: bool,
) -> list[float]:
    """Sums of torques in a gear, by the solver."""
    case = results.settled
    dragging = drag.of_gear(results, gear) if lossy else drag.NO_DRAG
    return solve_sums(case, case.gears[gear], ratios, sums, dragging)
