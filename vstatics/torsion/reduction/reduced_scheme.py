"""Scheme of a gear, reduced to its input shaft: masses and springs without rigid components."""

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

STIFFNESS_OF_RIGID_SETS = 1e9
"""Stiffness assumed for rigid gear sets, divided by the largest stiffness in the gear."""


@refusing()
def gear_scheme(case: Transmission, gear: Gear) -> TorsionScheme | str:
    """Return the scheme of a gear reduced to the input, or the reason why it has none.

    Rigidly joined links form a mass with the name of the first link. A rigid gear set whose links
    all have inertia and can move is replaced by a spring far stiffer than all others. Its partial
    frequency is the highest, so simplification removes it first. Links that do not rotate with the
    input are left out. So is a reaction member if the ratio is 1.

    Parameters
    ----------
    case : Transmission
    gear : Gear
        Gear of the case.

    Returns
    -------
    TorsionScheme or str
        Scheme with inertias [kg*m^2] and compliances [rad/(N*m)] on the input, or the reason why
        it does not exist.

    Raises
    ------
    CaseError
        If numbers differ too much for floating-point numbers.

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
            "rigid components make bodies follow several links that can move apart, so these "
            "bodies are not separate masses; leave out their inertia, or give a component a "
            "stiffness"
        )
    return scheme


def _with_stiff_sets(system: TorsionalSystem) -> TorsionalSystem:
    """Replace rigid gear sets by stiff springs, if all their links have inertia and can move.

    The links of such a set then have independent speeds, and share the inertia of its planets.
    """
    group = {link: links[0] for links in joined_links(system) for link in links}
    free = system.free()
    stiffest = max((device.rate for device in system.elastic), default=1.0)
    stiffness = STIFFNESS_OF_RIGID_SETS * stiffest

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
            device._replace(stiffness=stiffness)
            if device.stiffness is None and is_set(device)
            else device
            for device in system.devices
        ),
    )


def _scheme(system: TorsionalSystem) -> TorsionScheme | str | None:
    """Return the scheme, or the reason why the gear has none.

    None means that a body follows several independent masses.
    """
    to_input = scales(system, system.ends[0])
    if isinstance(to_input, str):
        return to_input
    free = system.free()
    groups = [group for group in joined_links(system) if to_input.scales[group[0]]]
    masses = _independent(system, groups, free)
    turning = {link for group in groups for link in group}
    for body in system.bodies:
        links = turning.intersection(body.form)
        if body.inertia > 0 and links and not any(links.issubset(mass) for mass in masses):
            return None
    firsts = [group[0] for group in masses]
    of_masses = np.array([to_input.scales[link] or np.nan for link in firsts])
    springs = [
        spring
        for device in system.elastic
        if (spring := _spring(device, free, firsts, of_masses, to_input)) is not None
    ]
    return TorsionScheme(
        tuple(system.names[link] for link in firsts),
        tuple(_reduced_inertia(system, group, to_input) for group in masses),
        tuple(springs),
    )


def _independent(
    system: TorsionalSystem, groups: Sequence[Sequence[int]], free: Floats
) -> list[Sequence[int]]:
    """Choose groups of rigidly joined links whose angles determine all motions.

    Groups with inertia come first.
    """
    heavy = [*map(set, system.heavy)]
    by_inertia = sorted(groups, key=lambda group: not any(b.issubset(group) for b in heavy))
    chosen: list[Sequence[int]] = []
    basis = np.zeros((0, free.shape[1]))
    for group in by_inertia:
        if len(chosen) == free.shape[1]:
            break
        row = free[group[0]]
        extended = np.vstack([basis, row / np.linalg.norm(row)])
        if np.linalg.svd(extended, compute_uv=False)[-1] > TIE:
            basis = extended
            chosen.append(group)
    return [group for group in groups if group in chosen]


def _reduced_inertia(system: TorsionalSystem, group: Sequence[int], to_input: Scales) -> float:
    return sum(
        body.inertia
        * sum(part / scale for link, part in body.form.items() if (scale := to_input.scales[link]))
        ** 2
        for body in system.bodies
        if any(link in group for link in body.form)
    )


def _spring(
    device: TorsionalDevice,
    free: Floats,
    firsts: Sequence[int],
    of_masses: Floats,
    to_input: Scales,
) -> SchemeSpring | None:
    """Return a component reduced to the input, None if no mass twists it."""
    by_mass, *_ = linalg.lstsq(free[firsts].T, form_values(device.twist, free))
    by_mass = by_mass / of_masses
    largest = np.abs(by_mass).max(initial=0.0)
    terms = {n: float(a) for n, a in enumerate(by_mass) if abs(a) > TIE * largest}
    if not terms or any(to_input.scales[link] is None for link in device.twist):
        return None
    first = next(iter(terms.values()))
    lead = to_input.scales[next(iter(device.twist))]
    factor = next(iter(device.twist.values())) / lead if lead else first
    scaled = {n: a / factor for n, a in terms.items()}
    # round off errors of coefficients that should be integers
    scaled = {n: float(round(a)) if abs(a - round(a)) < TIE else a for n, a in scaled.items()}
    compliance = 1 / (device.rate * factor**2)
    return SchemeSpring(device.name, scaled, compliance, device.damping.viscous * factor**2)
