"""Largest torques after a clutch dump in the gears of a case, reduced to a reference link.

The best reference link is the shaft whose torque is of interest, such as the propshaft or the
half-shafts (I. S. Tsitovich, V. B. Algin, Vehicle dynamics, 1981, 3.3).

The compliance E is the angle by which the disc turns under a torque of 1 N*m while the vehicle is
held. All elastic components in the power path contribute: shafts, parallel shafts, and the mounting
of a casing that takes a reaction.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from scipy import linalg

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import Failure, Flat, Unfailed, document, json_keys
from vstatics.torsion.clutch.clutch_dump import NEEDED, ClutchDump
from vstatics.torsion.clutch.dumped import DUMP_FORM, DumpTorque, dump
from vstatics.torsion.clutch.given import Dump
from vstatics.torsion.reduction.reduced_values import scales
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.system.state import asked_gears, vibrating


@json_keys("name", "to", "error", reduced="given", made="made")
class GearDump(NamedTuple):
    """Clutch dump in a gear, with its result."""

    name: str
    """Name of the gear."""
    to: str
    """Name of the reference link."""
    given: Unfailed[Dump] = None
    """Numbers of the dump, reduced to the reference link."""
    made: Flat[DumpTorque | None] = None
    """Largest torques on the reference link."""
    error: Failure = ""
    """Reason why the torques cannot be calculated."""


@document(DUMP_FORM)
class GearDumpAnswer(NamedTuple):
    """JSON document of the largest torques in a gear."""

    gear: Flat[GearDump]


@document(DUMP_FORM)
class GearsDumpAnswer(NamedTuple):
    """JSON document of the largest torques in several gears."""

    gears: Sequence[GearDump]


@refusing()
def gear_dumps(
    case: Transmission, gears: Sequence[int | str] | None = None, rate: float | None = None
) -> list[GearDump]:
    """Calculate the largest torques after the clutch of a case is dumped, in each gear.

    Parameters
    ----------
    case : Transmission
        Case with a `dump`.
    gears : sequence of int or str, optional
        Numbers (from 1) or names of gears. By default all gears.
    rate : float, optional
        Rate K of a gradual engagement, as in `dump`. [1/s]

    Returns
    -------
    list of GearDump
        For each gear: numbers reduced to the reference link, and largest torques [N*m].

    Raises
    ------
    ValueError
        If a gear does not exist.
    CaseError
        If the case has no `dump`.

    Examples
    --------
    ВАЗ-2101 in gear I, on the propshaft; the book has 683 N*m in case A3.

    >>> from vstatics import ClutchDump, Mechanism, Spring, Transmission
    >>> case = Transmission(
    ...     5, [], [Mechanism(1, 2, 0, 1.0), Mechanism(2, 3, 0, 3.753)], [],
    ...     inertias={1: 0.1358, 2: 0.004395, 3: 0.0239, 4: 0.091, 5: 5.68},
    ...     springs=[
    ...         Spring({3: 1, 4: -1}, compliance=4000e-6),
    ...         Spring({4: 1, 5: -1}, compliance=290e-6),
    ...     ],
    ...     dump=ClutchDump([1], [2], [3], [4], [5], M_C0=141.8, omega1=586, M_phi=335, to=3),
    ... )
    >>> [gear] = gear_dumps(case)
    >>> round(gear.given.J1, 3), round(gear.given.E, 5), round(gear.given.omega1)
    (1.913, 0.00429, 156)
    >>> gear.made.case, round(gear.made.max_torque)
    ('A3', 682)
    """
    clutch = ClutchDump.of(case)
    if clutch is None:
        raise CaseError(
            "E503",
            "the case has no `dump`, expected the links of engine `J1`, clutch disc `J2` and "
            "vehicle `J5`, the torque `M_C0` of the slipping clutch, and the engine speed `omega1`",
            ("dump",),
        )
    return [_gear_dump(case, gear, clutch, rate) for gear in asked_gears(case, gears)]


def _gear_dump(case: Transmission, gear: Gear, clutch: ClutchDump, rate: float | None) -> GearDump:
    to = case.link_name(clutch.link)
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearDump(gear.name, to, error=system)
    of_links = scales(system, clutch.link - 1)
    if isinstance(of_links, str):
        return GearDump(gear.name, to, error=of_links)
    inertias, left_out = _masses(case, system, clutch, of_links.speeds)
    given = _reduced(case, system, clutch, inertias, of_links.speeds)
    if isinstance(given, str):
        return GearDump(gear.name, to, error=given)
    try:
        torques = dump(given, rate)
    except CaseError as error:
        return GearDump(gear.name, to, given, error=spoken(map(str, error.problems)))
    if left_out:
        torques = torques._replace(
            messages=(
                *torques.messages,
                Message(
                    "N505",
                    f"links that rotate with {to} are in none of J1 to J5: {', '.join(left_out)}",
                ),
            )
        )
    return GearDump(gear.name, to, given, torques)


def _reduced(
    case: Transmission,
    system: TorsionalSystem,
    clutch: ClutchDump,
    inertias: Mapping[str, float],
    speeds: Sequence[float | None],
) -> Dump | str:
    """Return the numbers of a dump reduced to the reference link, or the reason for a failure."""
    by_link: dict[int, float] = {}
    for name, links in clutch.masses.items():
        for link in links:
            speed = speeds[link - 1]
            if not speed:
                hint = "; is the clutch engaged in this gear?" if name == "J1" else ""
                still = f"{case.link_name(link)} of {name} does not rotate with"
                return f"{still} {case.link_name(clutch.link)}{hint}"
            by_link[link] = speed
    without = [name for name in NEEDED if not inertias[name]]
    if without:
        return f"the links of {spoken(without)} have no inertia"
    near, far = ([link - 1 for link in links] for links in (clutch.J2, clutch.J5))
    turning = [by_link[link] for link in clutch.J2]
    compliance = clutch.E or path_compliance(system, near, turning, far)
    if not compliance:
        why = "nothing elastic is" if compliance == 0 else "no component is"
        return f"{why} between J2 and J5; give a component a compliance, or `dump` its `E`"
    tyres = clutch.J4[0] if clutch.J4 else clutch.J5[0]
    return Dump(
        **inertias,
        E=compliance,
        M_C0=clutch.M_C0 * abs(by_link[clutch.J2[0]]),
        M_phi=clutch.M_phi * abs(by_link[tyres]),
        omega1=clutch.omega1 / abs(by_link[clutch.J1[0]]),
    )


def _masses(
    case: Transmission, system: TorsionalSystem, clutch: ClutchDump, speeds: Sequence[float | None]
) -> tuple[dict[str, float], list[str]]:
    """Return the reduced inertias of J1 to J5, and the names of rotating bodies outside them.

    A planet belongs to the mass of a link of its gear set, preferably the carrier.
    """
    owners = {link: name for name, links in clutch.masses.items() for link in links}
    totals = dict.fromkeys(clutch.masses, 0.0)
    left_out: dict[str, None] = {}
    for index, body in enumerate(system.bodies):
        links = [index + 1] if index < system.case_links else _links_of_set(case, body.name)
        owner = next((owners[link] for link in links if link in owners), None)
        parts = [(part, speeds[link]) for link, part in body.form.items()]
        speed = sum(part * of_link for part, of_link in parts if of_link is not None)
        if owner is not None:
            totals[owner] += body.inertia * speed**2
        elif body.inertia * speed:
            left_out[body.name] = None
    return totals, [*left_out]


def _links_of_set(case: Transmission, planet: str) -> list[int]:
    """Return the links of the gear set of a planet, beginning with the carrier."""
    name = planet.rpartition(".")[0]
    members = next(device.members for device in case.own_devices if device.name == name)
    return [member.link for member in sorted(members, key=lambda member: member.name != "carrier")]


def path_compliance(
    system: TorsionalSystem, near: Sequence[int], speeds: Sequence[float], far: Sequence[int]
) -> float | None:
    """Calculate the compliance from near links to held links, reduced to the reference link.

    Many elastic torques M can balance a torque of 1 N*m on the reference link. The actual torques
    have the smallest ``sum E M^2``, which is the compliance (Castigliano). For a chain the result
    is the sum of the reduced compliances.

    Parameters
    ----------
    system : TorsionalSystem
    near : sequence of int
        Indices of links that rotate together; the torque acts on the first link.
    speeds : sequence of float
        Speeds of the near links, relative to the reference link. [-]
    far : sequence of int
        Indices of links that are held.

    Returns
    -------
    float or None
        Compliance [rad/(N*m)], 0 if the connection is rigid, None if nothing resists the torque.

    Examples
    --------
    Two shafts with a gear pair of ratio -2 between them have ``E_1 + 4 E_2`` on the first shaft:

    >>> from vstatics import Mechanism, Spring, Transmission
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> shafts = [Spring({1: 1, 2: -1}, compliance=0.1), Spring({3: 1, 4: -1}, compliance=0.2)]
    >>> case = Transmission(4, [], [Mechanism(2, 3, 0, -2.0)], [], springs=shafts)
    >>> round(path_compliance(torsional_system(case, case.gears[0]), [0], [1.0], [3]), 6)
    0.9
    """
    held = [{link: 1.0} for link in far]
    together = [
        {near[0]: speed, link: -speeds[0]} for link, speed in zip(near[1:], speeds[1:], strict=True)
    ]
    if system.free(*held, *together, *system.elastic_twists)[near[0]].any():
        return None
    free = system.free(*held, *together)
    acting = free[near[0]] / speeds[0]
    if not acting.any():
        return 0.0
    twists = np.sqrt(system.rates)[:, None] * (system.twists @ free)
    weighted, *_ = linalg.lstsq(twists.T, acting)
    return float(weighted @ weighted)
