"""The largest torque of a shift element in N*m, where the case tells it."""

from __future__ import annotations

from vstatics.model.parts import OfLoad
from vstatics.model.transmission import Transmission


def largest_capacity(case: Transmission, number: int) -> float | None:
    """What a shift element can carry at most [N*m].

    Parameters
    ----------
    case : Transmission
    number : int
        Of the element, from 1.

    Returns
    -------
    float or None
        None if the case has no capacity of it, or one relative to a load that it does not have.

    Examples
    --------
    >>> from vstatics import Gear, Load, ShiftElement
    >>> elements = [ShiftElement(1, 2, capacity=1.5), ShiftElement(1, 2)]
    >>> case = Transmission(2, elements, [], [Gear()], load=Load(torque=-200.0))
    >>> largest_capacity(case, 1), largest_capacity(case, 2)
    (300.0, None)
    """
    capacity = case.shift_elements[number - 1].capacity
    if isinstance(capacity, OfLoad):
        return abs(capacity.given)
    torque = case.load.torque if case.load else None
    return None if capacity is None or not torque else capacity * abs(torque)
