"""Array types, and small functions on arrays.

The types avoid numpy.typing, whose import costs start-up time.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import numpy as np

from vstatics.core.errors import CaseError, quoted
from vstatics.core.numerics.tolerances import LAST_BITS, NO_POWER

Floats = np.ndarray[Any, np.dtype[np.float64]]
Complex = np.ndarray[Any, np.dtype[np.complex128]]
Integers = np.ndarray[Any, np.dtype[np.integer[Any]]]
Booleans = np.ndarray[Any, np.dtype[np.bool_]]


def as_floats(name: str, given: object, hint: str = "") -> Floats:
    """Return numbers of any array-like type as an array of floats.

    Raises
    ------
    CaseError
        If `given` contains something other than numbers. The message contains `name` and `hint`.

    Examples
    --------
    >>> as_floats("load.torque", [100, 200])
    array([100., 200.])
    >>> as_floats("load.torque", ["100 N*m"])
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: load.torque: read `['100 N*m']`, expected numbers [E701]
    """
    with contextlib.suppress(TypeError, ValueError):
        if not _has_truths(given):
            return np.asarray(given, dtype=np.float64)
    raise CaseError("E701", f"{name}: read {quoted(str(given))}, expected numbers{hint}")


def as_list(name: str, given: object, hint: str = "") -> Floats:
    """Return numbers of any array-like type with a single axis as an array of floats.

    Raises
    ------
    CaseError
        If `given` contains something other than numbers, or has another number of axes.

    Examples
    --------
    >>> as_list("load.torque", 100)
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: load.torque: read 0 axes, expected a list of numbers [E701]
    """
    numbers = as_floats(name, given, hint)
    if numbers.ndim != 1:
        raise CaseError("E701", f"{name}: read {numbers.ndim} axes, expected a list of numbers")
    return numbers


def _has_truths(given: object) -> bool:
    if isinstance(given, list | tuple):
        return any(map(_has_truths, given))
    return isinstance(given, bool) or getattr(given, "dtype", None) == np.bool_


def first_largest(sizes: Floats) -> Integers:
    """Return the index of the largest number along the first axis.

    Of several largest numbers that are equal within rounding, the first is chosen.

    Parameters
    ----------
    sizes : ndarray, shape (n,) or (n, columns)
        Magnitudes; NaN is never the largest.

    Returns
    -------
    ndarray of int, shape () or (columns,)

    Examples
    --------
    >>> int(first_largest(np.array([0.25, 0.3, 0.1 + 0.2, np.nan])))
    1
    """
    known = np.where(np.isnan(sizes), -1.0, sizes)
    return np.asarray(np.argmax(known >= known.max(axis=0) * (1 - LAST_BITS), axis=0))


def largest(values: np.ndarray[Any, np.dtype[np.inexact[Any]]]) -> float:
    """Return the largest magnitude of an array; 0 if empty, NaN if any number is NaN.

    Examples
    --------
    >>> largest(np.array([1.0, -3.0])), largest(np.zeros(0))
    (3.0, 0.0)
    """
    return float(np.abs(values).max(initial=0.0))


def rounding_as_zero(values: Floats) -> Floats:
    """Return values, with 0 for values that are tiny relative to the largest value of the column.

    >>> rounding_as_zero(np.array([[3.0, np.nan], [1e-15, 1e-15]])).tolist()
    [[3.0, nan], [0.0, 1e-15]]
    """
    sizes = np.abs(values)
    return np.where(sizes <= NO_POWER * np.fmax.reduce(sizes), 0.0, values)


def without(values: Floats, flags: Booleans) -> Floats:
    """Return values with NaN where a flag is True. Flags have the leading axes of the values.

    >>> without(np.ones((2, 2)), np.array([False, True])).tolist()
    [[1.0, 1.0], [nan, nan]]
    """
    return np.where(flags.reshape(*flags.shape, *[1] * (values.ndim - flags.ndim)), np.nan, values)


def counted(lengths: Integers) -> tuple[Integers, Integers]:
    """Return the number of the list and the position in the list of each item of all lists.

    Both count from 0.

        >>> [indices.tolist() for indices in counted(np.array([2, 0, 3]))]
        [[0, 0, 2, 2, 2], [0, 1, 0, 1, 2]]
    """
    which = np.repeat(np.arange(len(lengths)), lengths)
    return which, np.arange(len(which)) - (np.cumsum(lengths) - lengths)[which]


def portions(lengths: Integers, most: int) -> Iterator[slice]:
    """Yield slices of consecutive lists with at most `most` items together, or of one longer list.

    >>> list(portions(np.array([2, 0, 3, 9, 1]), 5))
    [slice(0, 3, None), slice(3, 4, None), slice(4, 5, None)]
    """
    ends, start, done = np.cumsum(lengths), 0, 0
    while start < len(ends):
        end = max(int(np.searchsorted(ends, done + most, "right")), start + 1)
        yield slice(start, end)
        start, done = end, int(ends[end - 1])
