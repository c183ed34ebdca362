"""The scheme of a gear on its input shaft: masses and springs, no rigid devices left."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import linalg

from vstatics.core.arguments import refusing
from vstatics.core.elements.planet_bodies import Body
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.tolerances import TIE
from vstatics.torsion.reduction.reduced_values import Scales, joined_links, scales
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme
from vstatics.torsion.system.coordinates import form_values
from vstatics.torsion.system.gear_system import TorsionalDevice, TorsionalSystem
from vstatics.torsion.system.state import vibrating

STIFFER = 1e9
"""A rigid set by the stiffest device of the gear."""


@refusing()
def gear_scheme(case: Transmission, gear: Gear) -> TorsionScheme | str:
    """The scheme of a gear reduced to its input, or why it has none.

    Rigidly joined links are one mass, under the name of the first. A rigid set whose links all
    have inertia and can move is taken as a spring that is stiffer than all others by far: its
    partial frequency is the highest, so that simplification takes it out first. What does not
    turn with the input is left out, and so is a reaction where the ratio is 1.

    Parameters
    ----------
    case : Transmission
    gear : Gear
        One of the case.

    Returns
    -------
    TorsionScheme or str
        Inertias [kg*m^2] and compliances [rad/(N*m)] by the input; a text says why there is none.

    Raises
    ------
    CaseError
        If numbers are too far apart for floats.

    Examples
    --------
    >>> from vstatics import Mechanism, Spring, Transmission
    >>> case = Transmission(
    ...     3, [], [Mechanism(1, 2, 0, 2.0)], [], inertias={1: 0.1, 3: 8.0},
    ...     springs=[Spring({2: 1, 3: -1}, compliance=0.01, name="shaft")],
    ... )
    >>> scheme = gear_scheme(case, case.gears[0])
    >>> scheme.names, scheme.inertias, scheme.springs[0].twist, scheme.springs[0].compliance
    (('1', '3'), (0.1, 2.0), {0: 1.0, 1: -1.0}, 0.04)
    """
    system = vibrating(case, gear)
    if isinstance(system, str):
        return system
    scheme = _scheme(system) or _scheme(_with_stiff_sets(system))
    if scheme is None or (not isinstance(scheme, str) and min(scheme.inertias, default=0.0) < 0):
        return (
            "rigid devices make bodies follow several links that can move apart, so they are no "
            "masses by themselves; leave out their inertia, or give a device a stiffness"
        )
    return scheme


def _with_stiff_sets(system: TorsionalSystem) -> TorsionalSystem:
    """The system with springs in place of rigid devices of three links that can move apart.

    Planets are shared by the links of their set, as these have speeds of their own then.
    """
    group = {link: one[0] for one in joined_links(system) for link in one}
    free = system.free()
    stiffness = STIFFER * max((one.rate for one in system.elastic), default=1.0)

    def is_set(device: TorsionalDevice) -> bool:
        return len({group.get(link, link) for link in device.twist if free[link].any()}) > 2

    return system._replace(
        bodies=tuple(
            Body(name, {link: 1.0}, inertia)
            for link, (name, inertia) in enumerate(
                zip(system.names, system.link_inertias, strict=True)
            )
        ),
        devices=tuple(
            one._replace(stiffness=stiffness) if one.stiffness is None and is_set(one) else one
            for one in system.devices
        ),
    )


def _scheme(system: TorsionalSystem) -> TorsionScheme | str | None:
    """The scheme, or why there is none; None where rigid devices make a body follow several."""
    found = scales(system, system.ends[0])
    if isinstance(found, str):
        return found
    free = system.free()
    groups = [group for group in joined_links(system) if found.scales[group[0]]]
    masses = _independent(system, groups, free)
    turning = {link for group in groups for link in group}
    for body in system.bodies:
        of_scheme = turning.intersection(body.form)
        if body.inertia > 0 and of_scheme and not any(of_scheme.issubset(one) for one in masses):
            return None
    firsts = [group[0] for group in masses]
    own = np.array([found.scales[link] or np.nan for link in firsts])
    springs = [
        spring
        for device in system.elastic
        if (spring := _spring(device, free, firsts, own, found)) is not None
    ]
    return TorsionScheme(
        tuple(system.names[link] for link in firsts),
        tuple(_inertia(system, group, found) for group in masses),
        tuple(springs),
    )


def _independent(
    system: TorsionalSystem, groups: Sequence[Sequence[int]], free: Floats
) -> list[Sequence[int]]:
    """Groups of links by whose angles all others are known: those with inertia before others."""
    heavy = [set(body.form) for body in system.bodies if body.inertia > 0]
    by_inertia = sorted(groups, key=lambda group: not any(one.issubset(group) for one in heavy))
    chosen: list[Sequence[int]] = []
    basis = np.zeros((0, free.shape[1]))
    for group in by_inertia:
        if len(chosen) == free.shape[1]:
            break
        row = free[group[0]]
        with_it = np.vstack([basis, row / np.linalg.norm(row)])
        if np.linalg.svd(with_it, compute_uv=False)[-1] > TIE:
            basis = with_it
            chosen.append(group)
    return [group for group in groups if group in chosen]


def _inertia(system: TorsionalSystem, group: Sequence[int], found: Scales) -> float:
    """Of all bodies of a group, on the reference shaft [kg*m^2]."""
    total = 0.0
    for body in system.bodies:
        if body.inertia > 0 and any(link in group for link in body.form):
            speed = sum(
                part / scale for link, part in body.form.items() if (scale := found.scales[link])
            )
            total += body.inertia * speed**2
    return total


def _spring(
    device: TorsionalDevice, free: Floats, firsts: Sequence[int], own: Floats, found: Scales
) -> SchemeSpring | None:
    """An elastic device by the angles of masses on the reference shaft; none if it twists none."""
    by_mass, *_ = linalg.lstsq(free[firsts].T, form_values(device.twist, free))
    by_mass = by_mass / own
    largest = np.abs(by_mass).max(initial=0.0)
    terms = {n: float(a) for n, a in enumerate(by_mass) if abs(a) > TIE * largest}
    if not terms or any(found.scales[link] is None for link in device.twist):
        return None
    first = next(iter(terms.values()))
    lead = found.scales[next(iter(device.twist))]
    factor = next(iter(device.twist.values())) / lead if lead else first
    scaled = {n: _whole(a / factor) for n, a in terms.items()}
    compliance = 1 / (device.rate * factor**2)
    return SchemeSpring(device.name, scaled, compliance, device.damping.viscous * factor**2)


def _whole(coefficient: float) -> float:
    """A coefficient that is 1 or -1 but for rounding, as that of a shaft."""
    return float(round(coefficient)) if abs(coefficient - round(coefficient)) < TIE else coefficient
