"""Steps between gears and the spread, of one case or of many variants."""

from __future__ import annotations

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats


def steps(case: Transmission, ratios: Floats) -> Floats:
    """The ratio of each gear by that of the next one of its direction; NaN without one.

    The next has the next smaller ratio, without sign, with the same input and output; of
    equal ones it is the later.

    Parameters
    ----------
    ratios : ndarray, shape (..., gears)
        [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear
    >>> from vstatics.core.model.parts import Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], [Gear(), Gear(), Gear()])
    >>> steps(case, np.array([[4.0, 2.0, -3.0], [2.0, 5.0, 1.0]]))
    array([[2. , nan, nan],
           [2. , 2.5, nan]])
    """
    sizes = _comparable(case, ratios)
    found = np.full(ratios.shape, np.nan)
    for gear, others in enumerate(_alike(case)):
        following = np.full(ratios.shape[:-1], np.nan)
        own = sizes[..., gear]
        for other in others:
            size = sizes[..., other]
            below = (size < own) | ((size == own) & (other > gear))
            same = below & (ratios[..., gear] * ratios[..., other] > 0)
            following = np.fmax(following, np.where(same, np.abs(ratios[..., other]), np.nan))
        found[..., gear] = np.abs(ratios[..., gear]) / following
    return found


def spread(case: Transmission, ratios: Floats) -> Floats:
    """The largest by the smallest forward ratio, of shape (...); NaN without gears.

    Forward is the direction, input and output that most gears have; of equally many those of
    the first gear.

    Parameters
    ----------
    ratios : ndarray, shape (..., gears)
        [-]
    """
    sizes = _comparable(case, ratios)
    best = np.zeros(ratios.shape[:-1])
    found = np.full(ratios.shape[:-1], np.nan)
    for gear, others in enumerate(_alike(case)):
        members = [gear, *others]
        own = np.where(ratios[..., members] * ratios[..., [gear]] > 0, sizes[..., members], np.nan)
        count = np.isfinite(own).sum(axis=-1)
        with np.errstate(all="ignore"):
            whole = np.fmax.reduce(own, axis=-1) / np.fmin.reduce(own, axis=-1)
        found = np.where(count > best, whole, found)
        best = np.maximum(best, count)
    return found


def _alike(case: Transmission) -> list[list[int]]:
    """Of each gear the indices of all others with its input and output, operating points apart."""
    ends = [(case.gear_input(one), case.gear_output(one)) for one in case.gears]
    every = [index for index, one in enumerate(case.gears) if one.kind == "gear"]
    return [
        [other for other in every if other != index and ends[other] == own]
        if index in every
        else []
        for index, own in enumerate(ends)
    ]


def _comparable(case: Transmission, ratios: Floats) -> Floats:
    """Sizes of ratios to ten digits, so that rounding orders nothing; none of operating points."""
    sizes = np.abs(ratios)
    with np.errstate(all="ignore"):
        unit = 10.0 ** (np.floor(np.log10(sizes)) - 9)
        rounded: Floats = np.round(sizes / unit) * unit
    rounded[~np.isfinite(rounded)] = np.nan
    rounded[..., [one.kind != "gear" for one in case.gears]] = np.nan
    return rounded
