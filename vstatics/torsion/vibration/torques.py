"""Torques of components in a vibration, by the names used in results."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.elimination import dependencies
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.statics.matrix import column
from vstatics.torsion.system.coordinates import Values, form_values
from vstatics.torsion.system.gear_system import TorsionalSystem


class Balance(NamedTuple):
    """Equilibrium of links, which determines the torques of rigid components.

    Attributes
    ----------
    columns : ndarray, shape (links, rigid devices)
        Columns of the structural-distribution matrix.
    determined : ndarray, shape (rigid devices,)
        True if equilibrium determines the torque; False for redundant components.
    """

    columns: Floats
    determined: Booleans


def balance(system: TorsionalSystem) -> Balance:
    """Return the equilibrium of links, ``A_rigid M_rigid = -J q'' - A_elastic M_elastic``.

    Examples
    --------
    Two clutches between the same two links share a torque in an indeterminate ratio:

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
    """Return torques on the first links of all components, by name; NaN if indeterminate.

    Parameters
    ----------
    shapes : ndarray, shape (links, modes)
        Amplitudes of links. [rad]
    omegas : ndarray, shape (modes,)
        Angular frequencies. [rad/s]

    Returns
    -------
    dict of str to ndarray, shape (modes,)
        Amplitudes of the torques. [N*m]
    """
    acting = np.asarray(system.link_inertias)[:, None] * shapes * omegas**2
    elastic = {
        device.name: device.rate * form_values(device.twist, shapes) for device in system.elastic
    }
    by_device = with_rigid(system, balance, acting, elastic)
    sizes = [np.nan_to_num(np.abs(torque)) for torque in by_device.values()]
    largest = np.max(sizes, axis=0) if sizes else 0.0
    return {
        name: np.where(np.abs(torque) <= NO_POWER * largest, 0.0, torque)
        for name, torque in by_device.items()
    }


def with_rigid(
    system: TorsionalSystem, balance: Balance, acting: Values, elastic: Mapping[str, Values]
) -> dict[str, Values]:
    """Add the torques of rigid components, by equilibrium, to the torques of elastic components.

    Parameters
    ----------
    acting : ndarray, shape (links, ...)
        Inertia torques and external torques on links, real or complex. [N*m]
    elastic : mapping of str to ndarray
        Torques of elastic components. [N*m]
    """
    unbalanced = acting.copy()
    for device in system.elastic:
        for link, part in device.twist.items():
            unbalanced[link] -= part * elastic[device.name]
    by_device = dict(elastic)
    if system.rigid:
        solved = np.linalg.pinv(balance.columns) @ unbalanced
        solved[~balance.determined] = np.nan
        by_device |= dict(zip((device.name for device in system.rigid), solved, strict=True))
    return {device.name: by_device[device.name] for device in system.devices}


def own_torques(
    case: Transmission,
    system: TorsionalSystem,
    by_device: Mapping[str, Values],
    accelerations: Values,
) -> dict[str, Values]:
    """Arrange torques as in the `torques` of results; disengaged components carry 0.

    The torque of a converter is the torque on its pump. The torque of a member of a gear set is the
    torque that it gives to the planets, without the inertia torque of the planets, ``J_share w^2
    q``. The torques of a gear set therefore do not add up to 0.

    Parameters
    ----------
    by_device : mapping
        Torques on the first links of engaged shift elements, mechanisms and springs, by name. [N*m]
    accelerations : ndarray, shape (links, ...)
        Amplitudes ``w^2 q`` of links. [rad/s^2]
    """
    nothing = np.zeros_like(accelerations[0])
    named = {element.name: by_device.get(element.name, nothing) for element in case.shift_elements}
    springs = {spring.name: by_device.get(spring.name, nothing) for spring in case.springs}
    if case.drawing is None:
        meshes = {mesh.name: by_device.get(mesh.name, nothing) for mesh in case.mechanisms}
        return named | meshes | springs
    for device in case.own_devices:
        if case.mechanisms[device.mechanisms[0]].kind == "converter":
            named[device.name] = by_device.get(device.name, nothing)
            continue
        shares: dict[int, float] = {}
        for owner, of_planet in system.planet_shares:
            for link, share in of_planet.items() if owner == device.name else ():
                shares[link] = shares.get(link, 0.0) + share
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
