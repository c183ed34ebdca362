"""The public functions of the solver, which check the types of their arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics.core.arguments import refusing
from vstatics.core.model.transmission import IdleConvention, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.matrix import structural_matrix
from vstatics.core.statics.results import Results
from vstatics.core.statics.solution import solution

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike


@refusing()
def solve(  # noqa: PLR0913
    case: Transmission,
    *,
    ratios: ArrayLike | None = None,
    efficiencies: ArrayLike | None = None,
    coast: bool | None = None,
    idle: IdleConvention | None = None,
    vary: Mapping[str, ArrayLike] | None = None,
) -> Results:
    """Calculate every gear of a transmission, or of many variants of it.

    Parameters
    ----------
    case : Transmission
        Links, shift elements, mechanisms and gears.
    ratios, efficiencies : array_like, shape (..., mechanisms), optional
        Basic ratios and efficiencies of the mechanisms. The leading axes are the variants. Planet
        ratios of the case do not change. Default: the numbers of the case. [-]
    coast : bool, optional
        True if power enters at the output. Default: the setting of the case.
    idle : {"exact", "published"}, optional
        Convention for idle mechanisms. Default: the convention of the case.
    vary : mapping of str to array_like, optional
        Values of other numbers of the case by their paths, such as `load.torque`,
        `gears.low.speeds.motor` or `P1.teeth.sun`; see `vstatics.core.statics.points`. Units are
        rad/s (also for `load.speed`, although `Load.speed` is in rpm) and N*m; ratios and
        efficiencies are dimensionless. The arrays share one axis of variants.

    Returns
    -------
    Results
        Arrays with the leading axes of `ratios` and `efficiencies`, or the axis of `vary`, then
        gears. For arrays of variants `messages` is empty, and `case` is the given case.

    Raises
    ------
    CaseError
        If an array contains text or an impossible ratio or efficiency, a converter has no speed
        ratio, or a drag or efficiency depends on a missing load.
    TypeError
        If `case` is not a transmission, such as a file name.
    ValueError
        If the arrays do not have one number for each mechanism, the lengths in `vary` differ,
        `vary` is combined with `ratios` or `efficiencies`, or `idle` is not a convention.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> results = solve(case)
    >>> results.ratio
    array([1. , 3.5])
    >>> results.speeds.shape, results.torques.shape
    ((2, 3), (2, 4))
    >>> solve(case, ratios=[[-2.0], [-2.5], [-3.0]]).ratio
    array([[1. , 3. ],
           [1. , 3.5],
           [1. , 4. ]])

    A drag of 3 N*m at the input takes 1 % of an input torque of 300 N*m.

    >>> from vstatics.core.model.parts import Load
    >>> dragged = case.replace(load=Load(2000, 300), gears=[Gear([1], drag={1: 0.01})])
    >>> solve(dragged, vary={"drag.1": [0, 3, 6]}).efficiency.round(3).tolist()
    [[1.0], [0.99], [0.98]]
    """
    return solution(
        case, ratios=ratios, efficiencies=efficiencies, coast=coast, idle=idle, vary=vary
    )


@refusing()
def distribution_matrix(case: Transmission, ratios: ArrayLike | None = None) -> Floats:
    """Return the structural-distribution matrix (`AJK` in the listing).

    Parameters
    ----------
    case : Transmission
    ratios : array_like, shape (..., mechanisms), optional
        Basic ratios. Default: the ratios of the case. [-]

    Returns
    -------
    ndarray, shape (..., links, shift elements + mechanisms + springs)
        Torque on each link divided by the torque on the first link, for each device. [-]

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
