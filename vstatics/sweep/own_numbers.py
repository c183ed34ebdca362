"""The numbers that a sweep can vary: what they are in the case, and what they can't be."""

from __future__ import annotations

import numpy as np

from vstatics.model.parts import Damping, Mechanism, ShiftElement, damping
from vstatics.model.springs import Spring
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.statics.solve import impossible as impossible_of_mechanism

Device = ShiftElement | Mechanism | Spring


def devices_of(case: Transmission) -> list[Device]:
    """All devices, in the order of `Transmission.devices`."""
    return [*case.shift_elements, *case.mechanisms, *case.springs]


def stiffness_of(device: Device) -> float | None:
    """The stiffness of a device, None if it is rigid [N*m/rad]."""
    return device.rate if isinstance(device, Spring) else device.stiffness


def damping_of(device: Device) -> Damping:
    """The damping of a device."""
    return damping(device.damping)


def has_vibration(case: Transmission) -> bool:
    """Whether anything is elastic or heavy."""
    elastic = any(stiffness_of(device) is not None for device in devices_of(case))
    return elastic or bool(case.inertias)


def own_number(case: Transmission, index: int, quantity: str) -> float:
    """What a varied number is in the case itself.

    Parameters
    ----------
    index : int
        From 0: of a mechanism, a device or a link, as the quantity says.
    quantity : str

    Examples
    --------
    >>> from vstatics import Spring
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=500.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 0.1})
    >>> own_number(case, 0, "compliance"), own_number(case, 1, "inertia")
    (0.002, 0.0)
    """
    if quantity == "inertia":
        return case.inertias.get(index + 1, 0.0)
    if quantity in ("ratio", "efficiency"):
        number: float = getattr(case.mechanisms[index], quantity)
        return number
    device = devices_of(case)[index]
    if quantity == "damping":
        return damping_of(device).viscous
    if isinstance(device, Spring) and quantity == "compliance" and device.compliance is not None:
        return device.compliance
    stiffness = stiffness_of(device) or 0.0
    return stiffness if quantity == "stiffness" else 1 / stiffness


def impossible(quantity: str, numbers: Floats) -> Booleans:
    """Which numbers can't be those of any case, as its checks say.

    Parameters
    ----------
    quantity : str
    numbers : ndarray, shape (variants,)

    Examples
    --------
    >>> impossible("stiffness", np.array([1e3, 0.0, np.inf])).tolist()
    [False, True, True]
    >>> impossible("inertia", np.array([0.0, -1.0, np.nan])).tolist()
    [False, True, True]
    """
    if quantity in ("stiffness", "compliance"):
        with np.errstate(all="ignore"):
            return ~((numbers > 0) & np.isfinite(numbers) & np.isfinite(1 / numbers))
    if quantity in ("damping", "inertia"):
        return ~((numbers >= 0) & np.isfinite(numbers))
    return impossible_of_mechanism(quantity, numbers)  # type: ignore[arg-type] # one of the two
