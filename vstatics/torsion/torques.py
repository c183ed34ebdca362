"""Torques of the devices in a vibration at an amplitude of 1."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import linalg

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.numerics.elimination import dependencies
from vstatics.numerics.tolerances import NOISE
from vstatics.torsion.coordinates import form_values, rows
from vstatics.torsion.system import TorsionalSystem


class Balance(NamedTuple):
    """How the torques of rigid devices follow from those of inertias and springs.

    Attributes
    ----------
    columns : ndarray, shape (links, rigid devices)
        Of the structural-distribution matrix.
    determined : ndarray, shape (rigid devices,)
        Whether statics tells the torque; of redundant devices it does not.
    """

    columns: Floats
    determined: Booleans


def balance(system: TorsionalSystem) -> Balance:
    """The balance of the links of a system, ``A_rigid M_rigid = -J q'' - A_elastic M_elastic``.

    Examples
    --------
    Two clutches that hold the same two links share a torque in a way that nobody knows:

    >>> from vstatics import ShiftElement, Spring, Transmission
    >>> from vstatics.torsion.system import torsional_system
    >>> twice = [ShiftElement(1, 2), ShiftElement(1, 2)]
    >>> case = Transmission(2, twice, [], [], springs=[Spring({2: 1}, stiffness=1.0)])
    >>> gear = case.gears[0]._replace(engaged=(1, 2))
    >>> balance(torsional_system(case, gear)).determined
    array([False, False])
    """
    rigid = system.rigid
    determined = np.ones(len(rigid), np.bool_)
    for involved, _ in dependencies([device.twist for device in rigid]):
        determined[involved] = False
    return Balance(rows([device.twist for device in rigid], system).T, determined)


def torques(
    system: TorsionalSystem, balance: Balance, shapes: Floats, omegas: Floats
) -> dict[str, Floats]:
    """Torques on the first links of all devices, by their names; NaN where not determined.

    Parameters
    ----------
    shapes : ndarray, shape (links, modes)
        [rad]
    omegas : ndarray, shape (modes,)
        [rad/s]

    Returns
    -------
    dict of str to ndarray, shape (modes,)
        [N*m]
    """
    if not shapes.shape[1]:
        return {device.name: np.zeros(0) for device in system.devices}
    found: dict[str, Floats] = {}
    acting = np.asarray(system.link_inertias)[:, None] * shapes * omegas**2
    for device in system.elastic:
        torque = (device.stiffness or 0.0) * form_values(device.twist, shapes)
        for link, part in device.twist.items():
            acting[link] -= part * torque
        found[device.name] = torque
    if not shapes.shape[1]:
        return dict.fromkeys((device.name for device in system.devices), np.zeros(0))
    if system.rigid:
        scale = np.abs(acting).max(axis=0, initial=0.0)
        solved, *_ = linalg.lstsq(balance.columns, acting / np.where(scale, scale, 1.0))
        solved = np.where(balance.determined[:, None], solved * scale, np.nan)
        found |= dict(zip((device.name for device in system.rigid), solved, strict=True))
    if not found:
        return found
    largest = np.max([np.nan_to_num(np.abs(torque)) for torque in found.values()], axis=0)
    return {
        device.name: np.where(
            np.abs(found[device.name]) <= NOISE * largest, 0.0, found[device.name]
        )
        for device in system.devices
    }
