"""Inertias and compliances reduced to a link (Tsitovich, Algin, 1981, tables 2.1 and 2.2).

The reduction changes the coordinates and conserves the energy: with ``i = w_to/w_link`` in the
rigid motion of the gear, an inertia J* and a compliance E* become ``J = J*/i^2`` and ``E = E*
i^2``, (1.22) to (1.25). A link that is at rest in the rigid motion, such as a casing on its
mounting, takes the reaction. It is scaled so that its coefficient in the twist of an elastic
component is -1 if the coefficient of the preceding link is 1; for a casing ``J = J*/(1 - i)^2`` and
``E = E* (1 - i)^2``.
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
"""Note on a link at rest, such as a casing, that takes no reaction because the ratio is 1."""
Amounts = Mapping[str, float | None]
"""Reduced values by name of the link or component; None if undefined."""


class GearReduction(NamedTuple):
    """Inertias and compliances of a gear reduced to a link.

    Attributes
    ----------
    name : str
        Name of the gear.
    inertias : mapping
        Reduced inertias of links and planets. Rigidly joined links share the entry of the first
        link. [kg*m^2]
    compliances : mapping
        Reduced compliances of elastic components. [rad/(N*m)]
    ratios : mapping
        Speed of the reference link divided by the speed of each link, or the scale of a link at
        rest. None for a link that does not rotate with the reference link. [-]
    merged : mapping
        Names of the other links of rigidly joined links, by name of the first link.
    notes : mapping
        Reasons for missing values, by name of the link or component.
    error : str
        Reason why the whole gear cannot be reduced.
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
    """Reduce the inertias and compliances of a case to a reference link, in each gear.

    Parameters
    ----------
    case : Transmission
    to : int or str
        Number or name of the reference link.
    gears : sequence of int or str, optional
        Numbers (from 1) or names of gears. By default all gears.

    Returns
    -------
    list of GearReduction
        Inertias [kg*m^2] and compliances [rad/(N*m)] on the reference link, ratios [-].

    Raises
    ------
    ValueError
        If the link or a gear does not exist.

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
    chosen = asked_gears(case, gears)
    link = case.link_number(to) - 1
    return [_gear_reduction(case, gear, link) for gear in chosen]


def _gear_reduction(case: Transmission, gear: Gear, to: int) -> GearReduction:
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearReduction(gear.name, error=system)
    of_links = scales(system, to)
    if isinstance(of_links, str):
        return GearReduction(gear.name, error=of_links)
    groups = joined_links(system)
    names, by_link = system.names, of_links.scales
    inertias: dict[str, float | None] = {}
    for group in groups:
        known = [
            system.bodies[link].inertia / scale**2 for link in group if (scale := by_link[link])
        ]
        inertias[names[group[0]]] = sum(known) if known else None
    return GearReduction(
        gear.name,
        inertias | _of_planets(system, of_links),
        {
            device.name: reduced_compliance(device, by_link[next(iter(device.twist))])
            for device in system.elastic
        },
        {names[first]: by_link[first] or None for first, *_ in groups},
        {names[first]: [names[link] for link in others] for first, *others in groups if others},
        {names[first]: NO_REACTION for first, *_ in groups if by_link[first] == 0},
    )


def _of_planets(system: TorsionalSystem, of_links: Scales) -> dict[str, float | None]:
    inertias: dict[str, float | None] = {}
    for body in system.bodies[system.case_links :]:
        speeds = [(part, of_links.speeds[link]) for link, part in body.form.items()]
        terms = [part * speed for part, speed in speeds if speed is not None]
        if len(terms) == len(speeds):
            inertias[body.name] = (inertias.get(body.name) or 0.0) + body.inertia * sum(terms) ** 2
        else:
            inertias[body.name] = None
    return inertias


def reduced_compliance(device: TorsionalDevice, scale: float | None) -> float | None:
    """Reduce a compliance [rad/(N*m)] by the scale, if any, of the first link in its twist."""
    coefficient = next(iter(device.twist.values()))
    return scale**2 / coefficient**2 / device.rate if scale else None


class Scales(NamedTuple):
    """Speeds of the links of a gear relative to the reference link, and scales for reduction.

    Attributes
    ----------
    speeds : sequence of float or None
        ``w_link/w_to`` in the rigid motion; None for a link that does not rotate with the
        reference link. [-]
    scales : sequence of float or None
        ``w_to/w_link``. For a link at rest the scale follows from the reaction; it is 0 without a
        reaction. [-]
    """

    speeds: Sequence[float | None]
    scales: Sequence[float | None]


def scales(system: TorsionalSystem, to: int) -> Scales | str:
    """Return the scales of all links, or a message if the reference link is at rest.

    Parameters
    ----------
    system : TorsionalSystem
    to : int
        Index of the reference link.
    """
    rigid = free_motions([device.twist for device in system.devices], len(system.names))
    free = system.free()
    reference = rigid[to]
    if not reference.any():
        return f"link {system.names[to]} does not turn: nothing can be reduced to it"
    speeds = [_multiple(row, reference) for row in rigid]
    at_rest = {link for link, speed in enumerate(speeds) if speed == 0 and free[link].any()}
    by_link = [
        _reaction(system, link, to, at_rest) if link in at_rest else (1 / speed if speed else None)
        for link, speed in enumerate(speeds)
    ]
    # A link next to a link that takes the reaction, such as a frame next to a casing, is scaled so
    # that both coefficients in the twist of the spring between them have the same magnitude.
    between = [
        device.twist
        for device in system.devices
        if len(device.twist) == 2 and at_rest.issuperset(device.twist)
    ]
    for _ in between:
        for (first, a), (second, b) in (twist.items() for twist in between):
            for near, far, factor in ((first, second, b / a), (second, first, a / b)):
                scale = by_link[near]
                if scale and not by_link[far]:
                    by_link[far] = scale * factor
    return Scales(speeds, by_link)


def _multiple(row: Floats, reference: Floats) -> float | None:
    """Return the factor between two motions, None if they are not proportional."""
    factor = float(row @ reference / (reference @ reference))
    if np.abs(row - factor * reference).max() > TIE * np.abs(row).max(initial=0.0):
        return None
    return factor


def _reaction(system: TorsionalSystem, link: int, to: int, at_rest: set[int]) -> float | None:
    """Return ``w_to/w_link`` of a link at rest that is released while input or output is held.

    Links rigidly joined to it, such as a ring gear in a casing, are released, too.
    """
    group = next((set(links) for links in joined_links(system) if link in links), {link})
    holding = [
        device.twist
        for device in system.devices
        if group.isdisjoint(device.twist)
        or not at_rest.issuperset(device.twist)
        or (device.stiffness is None and group.issuperset(device.twist))
    ]
    ratios = []
    for end in system.ends:
        motions = free_motions([*holding, {end: 1.0}], len(system.names))
        if motions[link].any():
            ratio = _multiple(motions[to], motions[link])
            ratios += [] if ratio is None else [ratio]
    return max(ratios, key=lambda ratio: certain(abs(ratio)), default=None)


def joined_links(system: TorsionalSystem) -> list[list[int]]:
    """Return groups of links whose speeds are proportional because of rigid components.

    A link that is always held forms its own group.
    """
    free = system.free()
    groups: list[list[int]] = []
    for link in range(system.case_links):
        row = free[link]
        for group in groups if row.any() else ():
            first = free[group[0]]
            if first.any() and _multiple(row, first) is not None:
                group.append(link)
                break
        else:
            groups.append([link])
    return groups
