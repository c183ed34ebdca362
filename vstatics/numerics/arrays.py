"""Types of arrays of any shape (importing numpy.typing would cost start-up time); their largest."""

from typing import Any

import numpy as np

from vstatics.numerics.tolerances import LAST_BITS

Floats = np.ndarray[Any, np.dtype[np.float64]]
Complex = np.ndarray[Any, np.dtype[np.complex128]]
Integers = np.ndarray[Any, np.dtype[np.integer[Any]]]
Booleans = np.ndarray[Any, np.dtype[np.bool_]]


def first_largest(sizes: Floats) -> Integers:
    """The place of the largest number along the first axis; of those equal to rounding the first.

    Parameters
    ----------
    sizes : ndarray, shape (n,) or (n, columns)
        None below 0; NaN is never the largest.

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


def largest(values: Floats | Complex) -> float:
    """The largest magnitude of an array; 0 of an empty one, NaN if any is.

    Examples
    --------
    >>> largest(np.array([1.0, -3.0])), largest(np.zeros(0))
    (3.0, 0.0)
    """
    return float(np.abs(values).max(initial=0.0))
