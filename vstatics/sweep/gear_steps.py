"""Step ratios between gears, and the ratio spread, of one case or of many variants."""

from __future__ import annotations

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats


def steps(case: Transmission, ratios: Floats) -> Floats:
    """Return the step ratio of each gear: the gear ratio divided by the ratio of the next gear.

    The next gear has the next smaller magnitude of the ratio among gears with the same direction,
    input and output. Of gears with equal ratios, the later follows the earlier. NaN marks a gear
    without a next gear.

    Parameters
    ----------
    ratios : ndarray, shape (..., gears)
        Ratio of each gear. [-]

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
    step_ratios = np.full(ratios.shape, np.nan)
    for gear, others in enumerate(_alike(case)):
        following = np.full(ratios.shape[:-1], np.nan)
        size_of_gear = sizes[..., gear]
        for other in others:
            size = sizes[..., other]
            below = (size < size_of_gear) | ((size == size_of_gear) & (other > gear))
            same = below & (ratios[..., gear] * ratios[..., other] > 0)
            following = np.fmax(following, np.where(same, np.abs(ratios[..., other]), np.nan))
        step_ratios[..., gear] = np.abs(ratios[..., gear]) / following
    return step_ratios


def spread(case: Transmission, ratios: Floats) -> Floats:
    """Return the ratio spread: the largest forward ratio divided by the smallest, shape ``(...)``.

    Forward gears are the largest group of gears with the same direction, input and output. Of
    equally large groups, the group of the earliest gear counts. A case without gears gives NaN.

    Parameters
    ----------
    ratios : ndarray, shape (..., gears)
        Ratio of each gear. [-]
    """
    sizes = _comparable(case, ratios)
    best = np.zeros(ratios.shape[:-1])
    spreads = np.full(ratios.shape[:-1], np.nan)
    for gear, others in enumerate(_alike(case)):
        members = [gear, *others]
        forward = np.where(
            ratios[..., members] * ratios[..., [gear]] > 0, sizes[..., members], np.nan
        )
        count = np.isfinite(forward).sum(axis=-1)
        with np.errstate(all="ignore"):
            whole = np.fmax.reduce(forward, axis=-1) / np.fmin.reduce(forward, axis=-1)
        spreads = np.where(count > best, whole, spreads)
        best = np.maximum(best, count)
    return spreads


def _alike(case: Transmission) -> list[list[int]]:
    """Return for each gear the indices of the other gears that share both input and output.

    Entries of `gears` that are operating points, not gears, are left out.
    """
    ends = [(case.gear_input(gear), case.gear_output(gear)) for gear in case.gears]
    every = [index for index, gear in enumerate(case.gears) if gear.kind == "gear"]
    return [
        [other for other in every if other != index and ends[other] == input_and_output]
        if index in every
        else []
        for index, input_and_output in enumerate(ends)
    ]


def _comparable(case: Transmission, ratios: Floats) -> Floats:
    """Return the magnitudes of ratios, rounded to ten digits; NaN for operating points.

    Without rounding, the last digits would determine the order of equal ratios.
    """
    sizes = np.abs(ratios)
    with np.errstate(all="ignore"):
        unit = 10.0 ** (np.floor(np.log10(sizes)) - 9)
        rounded: Floats = np.round(sizes / unit) * unit
    rounded[~np.isfinite(rounded)] = np.nan
    rounded[..., [gear.kind != "gear" for gear in case.gears]] = np.nan
    return rounded
