"""Inertias and compliances reduced to one link (Tsitovich, Algin, 1981, tables 2.1 and 2.2).

The coordinates change, the energy does not: with ``i = w_to/w_link`` in the rigid motion of the
gear, ``J = J*/i^2`` and ``E = E* i^2``, (1.22) to (1.25). A link that stands in that motion, such
as a casing on its mounting, takes the reaction; it is scaled so that it has the coefficient -1
beside the 1 of the link before it: ``J = J*/(1 - i)^2``, ``E = E* (1 - i)^2`` of a gearbox.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.motions import free_motions
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.tables.answer import Failure
from vstatics.core.tables.numbers import certain
from vstatics.torsion.system.gear_system import TorsionalDevice, TorsionalSystem
from vstatics.torsion.system.state import asked_gears, vibrating

NO_REACTION = "no reaction"
"""Of a link that stands beside a train of ratio 1."""
Amounts = Mapping[str, float | None]
"""By the name of a link or a device."""


class GearReduction(NamedTuple):
    """The inertias and compliances of a gear on one link.

    Attributes
    ----------
    name : str
        Of the gear.
    inertias : mapping
        Of links and planets; what is rigidly joined is one entry under the first. [kg*m^2]
    compliances : mapping
        Of elastic devices. [rad/(N*m)]
    ratios : mapping
        Speed of the link to which all is reduced by that of each; of a link that stands by what
        it is scaled. None where it does not turn with it. [-]
    merged : mapping
        Under the first of some rigidly joined links, the others.
    notes : mapping
        Why there is no value.
    error : str
        Why there are none at all.
    """

    name: str
    inertias: Amounts = {}  # noqa: RUF012 - nobody changes it
    compliances: Amounts = {}  # noqa: RUF012
    ratios: Amounts = {}  # noqa: RUF012
    merged: Mapping[str, Sequence[str]] = {}
    notes: Mapping[str, str] = {}
    error: Failure = ""


@refusing()
def reduce(
    case: Transmission,
    to: int | str,
    gears: Sequence[int | str] | None = None,
) -> list[GearReduction]:
    """Reduce the inertias and compliances of a case to one link, gear by gear.

    Parameters
    ----------
    case : Transmission
    to : int or str
        Number or name of a link.
    gears : sequence of int or str, optional
        Numbers from 1 or names; all gears when not given.

    Returns
    -------
    list of GearReduction
        Inertias [kg*m^2] and compliances [rad/(N*m)] as seen from the link, ratios [-].

    Raises
    ------
    ValueError
        If there is no such link or gear.

    Examples
    --------
    >>> from vstatics import Mechanism, Spring, Transmission
    >>> case = Transmission(
    ...     3, [], [Mechanism(1, 2, 0, 2.0, name="pair")], [], inertias={1: 0.1, 3: 8.0},
    ...     springs=[Spring({2: 1, 3: -1}, compliance=0.01, name="shaft")],
    ... )
    >>> [gear] = reduce(case, 1)
    >>> gear.inertias, gear.compliances, gear.ratios, gear.merged
    ({'1': 0.1, '3': 2.0}, {'shaft': 0.04}, {'1': 1.0, '3': 2.0}, {'1': ['2']})
    """
    asked = asked_gears(case, gears)
    link = case.link_number(to) - 1
    return [_gear_reduction(case, gear, link) for gear in asked]


def _gear_reduction(case: Transmission, gear: Gear, to: int) -> GearReduction:
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearReduction(gear.name, error=system)
    found = scales(system, to)
    if isinstance(found, str):
        return GearReduction(gear.name, error=found)
    groups = joined_links(system)
    names, of = system.names, found.scales
    inertias: dict[str, float | None] = {}
    for group in groups:
        parts = [(system.bodies[link].inertia, of[link]) for link in group]
        known = [inertia / scale**2 for inertia, scale in parts if scale]
        inertias[names[group[0]]] = sum(known) if known else None
    return GearReduction(
        gear.name,
        inertias | _of_planets(system, found),
        {
            device.name: reduced_compliance(device, of[next(iter(device.twist))])
            for device in system.elastic
        },
        {names[first]: of[first] or None for first, *_ in groups},
        {names[first]: [names[link] for link in others] for first, *others in groups if others},
        {names[first]: NO_REACTION for first, *_ in groups if of[first] == 0},
    )


def _of_planets(system: TorsionalSystem, found: Scales) -> dict[str, float | None]:
    inertias: dict[str, float | None] = {}
    for body in system.bodies[system.own :]:
        speeds = [(part, found.speeds[link]) for link, part in body.form.items()]
        own = [part * speed for part, speed in speeds if speed is not None]
        if len(own) == len(speeds):
            inertias[body.name] = (inertias.get(body.name) or 0.0) + body.inertia * sum(own) ** 2
        else:
            inertias[body.name] = None
    return inertias


def reduced_compliance(device: TorsionalDevice, scale: float | None) -> float | None:
    """By the first link of its twist, whose coefficient is made 1 [rad/(N*m)]."""
    coefficient = next(iter(device.twist.values()))
    return scale**2 / coefficient**2 / device.rate if scale else None


class Scales(NamedTuple):
    """How the links of a gear follow from one of them.

    Attributes
    ----------
    speeds : sequence of float or None
        ``w_link/w_to`` in the rigid motion; None: it does not turn with it. [-]
    scales : sequence of float or None
        ``w_to/w_link``; of a link that stands, as it takes the reaction; 0: there is none. [-]
    """

    speeds: Sequence[float | None]
    scales: Sequence[float | None]


def scales(system: TorsionalSystem, to: int) -> Scales | str:
    """By what each link is scaled, or why it can't be told.

    Parameters
    ----------
    to : int
        Index of the link to which all is reduced.
    ends : tuple of int
        Indices of the input and the output link.
    """
    rigid = free_motions([device.twist for device in system.devices], len(system.names))
    free = system.free()
    own = rigid[to]
    if not own.any():
        return f"link {system.names[to]} does not turn: nothing can be reduced to it"
    speeds = [_by(row, own) for row in rigid]
    standing = {link for link, speed in enumerate(speeds) if speed == 0 and free[link].any()}
    by_link = [
        _reaction(system, link, to, standing)
        if link in standing
        else (1 / speed if speed else None)
        for link, speed in enumerate(speeds)
    ]
    _pass_on(system, by_link, standing)
    return Scales(speeds, by_link)


def _pass_on(system: TorsionalSystem, by_link: list[float | None], standing: set[int]) -> None:
    """Scale what stands behind a link that takes the reaction, as a frame behind a casing.

    So in the twist of the device between the two both have coefficients of the same size.
    """
    between = [
        device.twist
        for device in system.devices
        if len(device.twist) == 2 and standing.issuperset(device.twist)
    ]
    for _ in between:
        for (one, a), (other, b) in (twist.items() for twist in between):
            for near, far, factor in ((one, other, b / a), (other, one, a / b)):
                scale = by_link[near]
                if scale and not by_link[far]:
                    by_link[far] = scale * factor


def _by(row: Floats, own: Floats) -> float | None:
    """A motion as a multiple of another; None where it is none."""
    factor = float(row @ own / (own @ own))
    if np.abs(row - factor * own).max() > TIE * np.abs(row).max(initial=0.0):
        return None
    return factor


def _reaction(system: TorsionalSystem, link: int, to: int, standing: set[int]) -> float | None:
    """How far the link `to` turns with one that stands, when that is let go and an end is held.

    What is rigidly joined to it is let go with it, as a ring gear that is held by the casing.
    """
    group = next((set(one) for one in joined_links(system) if link in one), {link})
    kept = [
        device.twist
        for device in system.devices
        if group.isdisjoint(device.twist)
        or not standing.issuperset(device.twist)
        or (device.stiffness is None and group.issuperset(device.twist))
    ]
    found = []
    for end in system.ends:
        motions = free_motions([*kept, {end: 1.0}], len(system.names))
        if motions[link].any():
            ratio = _by(motions[to], motions[link])
            found += [] if ratio is None else [ratio]
    return max(found, key=lambda ratio: certain(abs(ratio)), default=None)


def joined_links(system: TorsionalSystem) -> list[list[int]]:
    """The case's own links, those together whose speeds the rigid devices tie to each other.

    A link that is held for good is by itself.
    """
    free = system.free()
    groups: list[list[int]] = []
    for link in range(system.own):
        row = free[link]
        for group in groups if row.any() else ():
            first = free[group[0]]
            if first.any() and _by(row, first) is not None:
                group.append(link)
                break
        else:
            groups.append([link])
    return groups
