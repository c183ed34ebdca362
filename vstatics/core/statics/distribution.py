"""The public function `distribution_matrix`, which checks the types of its arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics.core.arguments import refusing
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.matrix import structural_matrix

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@refusing()
def distribution_matrix(case: Transmission, ratios: ArrayLike | None = None) -> Floats:
    """Return the structural-distribution matrix AJK.

    Parameters
    ----------
    case : Transmission
    ratios : array_like, shape (..., mechanisms), optional
        Basic ratios. Default: the ratios of the case. [-]

    Returns
    -------
    ndarray, shape (..., links, shift elements + mechanisms + springs)
        Torque on each link per torque on the first link of each device. [-]

    Raises
    ------
    ValueError
        If there is not one ratio for each mechanism.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2, 0)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> distribution_matrix(case)
    array([[ 0. ,  1. ],
           [ 1. ,  2.5],
           [ 0. , -3.5]])
    """
    return structural_matrix(case, ratios)
