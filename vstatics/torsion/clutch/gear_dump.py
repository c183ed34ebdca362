"""A clutch that is dumped in the gears of a case: reduced to one link, and the largest torques.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), 3.3: all is reduced to one shaft,
best to that whose torque is asked for, the propshaft or the half-shafts.

How far links turn under a torque while others are held: the compliance of what is between.

On the way of the power every elastic device has its part, wherever it stands in it: shafts,
the mounting of a casing that takes a reaction, shafts side by side.
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
from vstatics.core.tables.answer import Failure, Flat, Unfailed, document, told
from vstatics.torsion.clutch.clutch_dump import NEEDED, ClutchDump
from vstatics.torsion.clutch.dumped import DUMP_FORM, DumpTorque, dump
from vstatics.torsion.clutch.given import Dump
from vstatics.torsion.reduction.reduced_values import scales
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.system.state import asked_gears, vibrating


@told("name", "to", "error", reduced="given", made="made")
class GearDump(NamedTuple):
    """A clutch that is dumped in a gear."""

    name: str
    """Of the gear."""
    to: str
    """Name of the link to which all is reduced."""
    given: Unfailed[Dump] = None
    """On that link."""
    made: Flat[DumpTorque | None] = None
    """Likewise."""
    error: Failure = ""
    """Why there is neither."""


@document(DUMP_FORM)
class GearDumpAnswer(NamedTuple):
    """The largest torques in a gear of a case."""

    gear: Flat[GearDump]


@document(DUMP_FORM)
class GearsDumpAnswer(NamedTuple):
    """The largest torques in gears of a case."""

    gears: Sequence[GearDump]


@refusing()
def gear_dumps(
    case: Transmission, gears: Sequence[int | str] | None = None, rate: float | None = None
) -> list[GearDump]:
    """The largest torques when the clutch of a case is dumped, gear by gear.

    Parameters
    ----------
    case : Transmission
        With a `dump`.
    gears : sequence of int or str, optional
        Numbers from 1 or names; all gears when not given.
    rate : float, optional
        As of `dump`. [1/s]

    Returns
    -------
    list of GearDump
        What was given to `dump`, reduced to a link, and what it made; torques in N*m.

    Raises
    ------
    ValueError
        If there is no such gear.
    CaseError
        If the case has no `dump`.

    Examples
    --------
    A ВАЗ-2101 in gear I, on the propshaft; the book has 683 N*m in case A3.

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
    given = ClutchDump.of(case)
    if given is None:
        message = "there is no `dump`, expected the links of `J1` to `J5`, `M_C0` and `omega1`"
        raise CaseError("E503", message, ("dump",))
    return [_gear_dump(case, gear, given, rate) for gear in asked_gears(case, gears)]


def _gear_dump(case: Transmission, gear: Gear, asked: ClutchDump, rate: float | None) -> GearDump:
    to = case.link_name(asked.link)
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearDump(gear.name, to, error=system)
    found = scales(system, asked.link - 1)
    if isinstance(found, str):
        return GearDump(gear.name, to, error=found)
    inertias, left_out = _masses(case, system, asked, found.speeds)
    given = _reduced(case, system, asked, inertias, found.speeds)
    if isinstance(given, str):
        return GearDump(gear.name, to, error=given)
    try:
        made = dump(given, rate)
    except CaseError as error:
        return GearDump(gear.name, to, given, error=spoken(map(str, error.problems)))
    if left_out:
        message = f"in none of J1 to J5, though turning with {to}: {', '.join(left_out)}"
        made = made._replace(messages=(*made.messages, Message("N505", message)))
    return GearDump(gear.name, to, given, made)


def _reduced(
    case: Transmission,
    system: TorsionalSystem,
    asked: ClutchDump,
    inertias: Mapping[str, float],
    speeds: Sequence[float | None],
) -> Dump | str:
    """What is given, on one link, or why it can't be."""
    by_link: dict[int, float] = {}
    for name, links in asked.masses.items():
        for link in links:
            speed = speeds[link - 1]
            if not speed:
                hint = "; is the clutch engaged in this gear?" if name == "J1" else ""
                still = f"{case.link_name(link)} of {name} does not turn with"
                return f"{still} {case.link_name(asked.link)}{hint}"
            by_link[link] = speed
    without = [name for name in NEEDED if not inertias[name]]
    if without:
        return f"the links of {spoken(without)} have no inertia"
    near, far = ([link - 1 for link in links] for links in (asked.J2, asked.J5))
    turning = [by_link[link] for link in asked.J2]
    compliance = asked.E or path_compliance(system, near, turning, far)
    if not compliance:
        why = "nothing elastic is" if compliance == 0 else "no device is"
        return f"{why} between J2 and J5; give a device a compliance, or `dump` its `E`"
    tyres = asked.J4[0] if asked.J4 else asked.J5[0]
    return Dump(
        **inertias,
        E=compliance,
        M_C0=asked.M_C0 * abs(by_link[asked.J2[0]]),
        M_phi=asked.M_phi * abs(by_link[tyres]),
        omega1=asked.omega1 / abs(by_link[asked.J1[0]]),
    )


def _masses(
    case: Transmission, system: TorsionalSystem, asked: ClutchDump, speeds: Sequence[float | None]
) -> tuple[dict[str, float], list[str]]:
    """The inertias of J1 to J5 on the reference shaft, and what turns but is in none of them.

    Planets go with a link of their set, the carrier before others.
    """
    owners = {link: name for name, links in asked.masses.items() for link in links}
    totals = dict.fromkeys(asked.masses, 0.0)
    left_out: dict[str, None] = {}
    for index, body in enumerate(system.bodies):
        links = [index + 1] if index < system.case_links else _links_of_set(case, body.name)
        owner = next((owners[link] for link in links if link in owners), None)
        parts = [(part, speeds[link]) for link, part in body.form.items()]
        speed = sum(part * one for part, one in parts if one is not None)
        if owner is not None:
            totals[owner] += body.inertia * speed**2
        elif body.inertia * speed:
            left_out[body.name] = None
    return totals, [*left_out]


def _links_of_set(case: Transmission, planet: str) -> list[int]:
    """The links of the set that a planet belongs to, its carrier first."""
    name = planet.rpartition(".")[0]
    members = next(one.members for one in case.own_devices if one.name == name)
    return [member.link for member in sorted(members, key=lambda member: member.name != "carrier")]


def path_compliance(
    system: TorsionalSystem, near: Sequence[int], speeds: Sequence[float], far: Sequence[int]
) -> float | None:
    """The compliance from some links to others that are held, on the reference shaft.

    Elastic torques M that balance a torque of 1 there have the least ``sum E M^2``, which is
    the compliance (Castigliano). In a chain it is the sum of the reduced compliances.

    Parameters
    ----------
    near : sequence of int
        Indices of links that turn as one, the first with the torque.
    speeds : sequence of float
        Theirs by that of the reference shaft. [-]
    far : sequence of int
        Indices of links that are held.

    Returns
    -------
    float or None
        [rad/(N*m)]; none where nothing resists.

    Examples
    --------
    Two shafts with a gear pair of ratio -2 between them, on the first: ``E_1 + 4 E_2``.

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
