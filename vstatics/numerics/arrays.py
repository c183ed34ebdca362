"""Types of arrays of any shape (importing numpy.typing would cost start-up time)."""

from typing import Any

import numpy as np

Floats = np.ndarray[Any, np.dtype[np.float64]]
Complex = np.ndarray[Any, np.dtype[np.complex128]]
Integers = np.ndarray[Any, np.dtype[np.integer[Any]]]
Booleans = np.ndarray[Any, np.dtype[np.bool_]]


def largest(values: Any) -> float:
    """The largest magnitude of an array; 0 of an empty one, NaN if any is.

    Examples
    --------
    >>> largest(np.array([1.0, -3.0])), largest(np.zeros(0))
    (3.0, 0.0)
    """
    return float(np.abs(values).max(initial=0.0))
