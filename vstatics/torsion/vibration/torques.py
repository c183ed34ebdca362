"""Torques of the devices in a vibration at an amplitude of 1, by the names that results have."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.elimination import dependencies
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.statics.matrix import column
from vstatics.torsion.system.coordinates import Values, form_values
from vstatics.torsion.system.gear_system import TorsionalSystem


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
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> twice = [ShiftElement(1, 2), ShiftElement(1, 2)]
    >>> case = Transmission(2, twice, [], [], springs=[Spring({2: 1}, stiffness=1.0)])
    >>> gear = case.gears[0]._replace(engaged=(1, 2))
    >>> balance(torsional_system(case, gear)).determined
    array([False, False])
    """
    rigid = system.rigid_twists
    determined = np.ones(len(rigid), np.bool_)
    for involved, _ in dependencies(rigid):
        determined[involved] = False
    return Balance(system.rows(rigid).T, determined)


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
    acting = np.asarray(system.link_inertias)[:, None] * shapes * omegas**2
    own = {
        device.name: device.rate * form_values(device.twist, shapes) for device in system.elastic
    }
    found = with_rigid(system, balance, acting, own)
    sizes = [np.nan_to_num(np.abs(torque)) for torque in found.values()]
    largest = np.max(sizes, axis=0) if sizes else 0.0
    return {
        name: np.where(np.abs(torque) <= NO_POWER * largest, 0.0, torque)
        for name, torque in found.items()
    }


def with_rigid(
    system: TorsionalSystem, balance: Balance, acting: Values, elastic: Mapping[str, Values]
) -> dict[str, Values]:
    """Torques of all devices in their order, those of rigid ones from the balance of the links.

    Parameters
    ----------
    acting : ndarray, shape (links, ...)
        Torques of inertias and from outside, real or complex. [N*m]
    elastic : mapping of str to ndarray
        Torques of elastic devices. [N*m]
    """
    left = acting.copy()
    for device in system.elastic:
        for link, part in device.twist.items():
            left[link] -= part * elastic[device.name]
    found = dict(elastic)
    if system.rigid:
        solved: Any = np.linalg.pinv(balance.columns) @ left
        solved[~balance.determined] = np.nan
        found |= dict(zip((device.name for device in system.rigid), solved, strict=True))
    return {device.name: found[device.name] for device in system.devices}


def own_torques(
    case: Transmission,
    system: TorsionalSystem,
    by_device: Mapping[str, Values],
    accelerations: Values,
) -> dict[str, Values]:
    """Torques of devices by the rows of `torques` in results; what is open has 0.

    A converter has that on its pump. That of a member of a set is what it gives to the planets, so
    those of a set do not add up to 0: what its planets take from a link, ``J_share w^2 q``, is none
    of the member's own.

    Parameters
    ----------
    by_device : mapping
        On the first link of each engaged element, mechanism and spring, by its name. [N*m]
    accelerations : ndarray, shape (links, ...)
        ``w^2 q`` of links. [rad/s^2]
    """
    nothing = np.zeros_like(accelerations[0])
    named = {one.name: by_device.get(one.name, nothing) for one in case.shift_elements}
    springs = {one.name: by_device.get(one.name, nothing) for one in case.springs}
    if case.drawing is None:
        meshes = {one.name: by_device.get(one.name, nothing) for one in case.mechanisms}
        return named | meshes | springs
    for device in case.own_devices:
        if case.mechanisms[device.mechanisms[0]].kind == "converter":
            named[device.name] = by_device.get(device.name, nothing)
            continue
        shares = _shares_of(system, device.name)
        for member in device.members:
            share = shares.pop(member.link - 1, 0.0) if member.link else 0.0
            parts = [
                column(case.mechanisms[index].ratio)[place] * by_device[case.mechanisms[index].name]
                for index, place in member.places
            ]
            parts += [-share * accelerations[member.link - 1]] * bool(share)
            total, size = np.sum(parts, axis=0), np.sum(np.abs(parts), axis=0)
            known = np.where(np.abs(total) <= NO_POWER * size, 0.0, total)
            named[f"{device.name}.{member.name}"] = known
    return named | springs


def _shares_of(system: TorsionalSystem, name: str) -> dict[int, float]:
    """What the planets of a set add to the inertias of links [kg*m^2]."""
    total: dict[int, float] = {}
    for owner, shares in system.planet_shares:
        for link, share in shares.items() if owner == name else ():
            total[link] = total.get(link, 0.0) + share
    return total
