"""Natural modes of a gear by names of links and components, with shares of energy and nodes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, count_of, spoken
from vstatics.core.extras import higher
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.elimination import dependencies
from vstatics.core.numerics.motions import Form
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.tables.answer import Failure, Sometimes, json_keys
from vstatics.core.tables.html import shown
from vstatics.torsion.system.converters import WorkingConverter
from vstatics.torsion.system.coordinates import Coordinates, coordinates, form_values
from vstatics.torsion.system.gear_system import TorsionalSystem, torsional_system
from vstatics.torsion.system.slopes import spring_slopes
from vstatics.torsion.system.state import asked_gears, vibrating
from vstatics.torsion.system.working_points import Ratios, WorkingGear, working_gear
from vstatics.torsion.vibration.damped import DampedModes, damped_modes
from vstatics.torsion.vibration.natural import NaturalModes, lowest_modes, natural_modes
from vstatics.torsion.vibration.nodes import count_nodes
from vstatics.torsion.vibration.torques import Balance, balance, own_torques, torques

Named = Mapping[str, float]
"""Values by name of the link or component; NaN if undetermined."""
SOME_LINKS, SOME_MODES = 50, 20
"""Largest number of links with all modes by default; number of modes for larger systems."""


class Sensitivity(NamedTuple):
    """Relative change of a frequency per relative change of each stiffness and inertia [-]."""

    stiffness: Named
    inertia: Named


@json_keys(
    *("omega", "frequency", "damping_ratio", "damped_frequency"),
    *("nodes", "shape", "torques", "kinetic", "elastic", "sensitivity"),
)
class Mode(NamedTuple):
    """Natural mode that is not rigid.

    Attributes
    ----------
    omega : float
        Angular natural frequency without damping. [rad/s]
    damping_ratio : float
        Damping ratio. [-]
    damped_frequency : float
        Frequency with damping. [Hz]
    shape : mapping
        Amplitudes of the links of the case; the largest is +1. [rad]
    torques : mapping
        Torques of components at these amplitudes, with the signs of the results of a gear. [N*m]
    kinetic, elastic : mapping
        Shares of bodies in the kinetic energy, and of components in the elastic energy. [-]
    nodes : int
        Number of points at rest, within elastic components or at links between them.
    """

    omega: float
    damping_ratio: float
    damped_frequency: float
    shape: Named
    torques: Named
    kinetic: Named
    elastic: Named
    nodes: int

    @property
    def frequency(self) -> float:
        """Natural frequency without damping [Hz]."""
        return self.omega / (2 * math.pi)

    @property
    def by_stiffness(self) -> dict[str, float]:
        """Sensitivity to each stiffness, ``d ln(omega)/d ln(c) = elastic/2`` (Rayleigh) [-]."""
        return {name: share / 2 for name, share in self.elastic.items()}

    @property
    def by_inertia(self) -> dict[str, float]:
        """Sensitivity to each inertia, ``d ln(omega)/d ln(J) = -kinetic/2`` (Rayleigh) [-]."""
        return {name: -share / 2 for name, share in self.kinetic.items()}

    @property
    def sensitivity(self) -> Sensitivity:
        """Sensitivity of the natural frequency to stiffnesses and inertias."""
        return Sensitivity(self.by_stiffness, self.by_inertia)


class GearModes(NamedTuple):
    """Modes of a gear.

    Attributes
    ----------
    name : str
        Name of the gear.
    rigid_modes : int
        Number of motions without elastic twist.
    modes : sequence of Mode
        Modes with elastic twist, by ascending frequency.
    damped : sequence of complex
        Eigenvalues with an imaginary part of 0 or more, except for rigid modes; empty for a
        system without damping. [1/s]
    warnings : sequence of str
        Warnings about the model.
    error : str
        Reason why the gear has no modes.
    slopes : mapping of str to float
        Stiffnesses of nonlinear springs under the load; 0 for a disengaged spring. [N*m/rad]
    converters : mapping of str to WorkingConverter
        Converters at their operating points. They transmit nothing in `modes`, and resist in
        `damped`.
    """

    name: str
    rigid_modes: int = 0
    modes: Sequence[Mode] = ()
    damped: Sequence[complex] = ()
    warnings: Sequence[str] = ()
    error: Failure = ""
    slopes: Named = EMPTY
    converters: Sometimes[Mapping[str, WorkingConverter]] = None

    def __repr__(self) -> str:
        """Return the name of the gear and the numbers of rigid and elastic modes."""
        counts = f"{self.rigid_modes} rigid, {len(self.modes)} elastic"
        return f"<GearModes {self.name!r}: {self.error or counts}>"

    def _repr_html_(self) -> str:
        """Return all tables of the gear as HTML for a notebook."""
        return shown(higher("modes_grids")([self]))


class CaseModes(list[GearModes]):
    """Modes of several gears; a notebook displays their frequencies."""

    def _repr_html_(self) -> str:
        return shown(higher("overview_grids")(self))


@refusing()
def modes(
    case: Transmission,
    gears: Sequence[int | str] | None = None,
    *,
    count: int | None = None,
    coast: bool | None = None,
    speed_ratios: Ratios = EMPTY,
) -> CaseModes:
    """Calculate the natural modes of the gears of a case.

    Given speeds determine mean speeds but not vibration; losses and drag are neglected.

    Parameters
    ----------
    case : Transmission
        Case with `inertias` and elastic components.
    gears : sequence of int or str, optional
        Numbers (from 1) or names of gears. By default all gears.
    count : int, optional
        Number of modes to return, from the lowest frequency, without rigid modes. By default all,
        or 20 for a case with more than 50 links.
    coast : bool, optional
        True if power enters at the output, which decides on freewheels. By default as in the case.
    speed_ratios : mapping of str to float, optional
        Speed ratios by name of the converter, instead of the ratios in the gear. [-]

    Returns
    -------
    CaseModes
        List of the modes of each gear: frequencies [rad/s], shapes, torques and energy shares.

    Raises
    ------
    ValueError
        If a gear or converter does not exist.
    CaseError
        If nothing has an inertia, or numbers differ too much for floating-point numbers.

    Examples
    --------
    An engine of 0.1 kg*m^2 drives a gear pair of ratio -3 through a shaft of 9000 N*m/rad:

    >>> from vstatics import Mechanism, Spring, Transmission
    >>> case = Transmission(
    ...     3, [], [Mechanism(2, 3, 0, -3.0)], [], inertias={1: 0.1, 3: 0.9},
    ...     springs=[Spring({1: 1, 2: -1}, stiffness=9000, name="shaft")],
    ... )
    >>> [gear] = modes(case)
    >>> gear.rigid_modes, len(gear.modes), round(gear.modes[0].omega, 6)
    (1, 1, 424.264069)
    >>> {name: round(x, 9) for name, x in gear.modes[0].shape.items()}
    {'1': 1.0, '2': -1.0, '3': 0.333333333}
    """
    asked = asked_gears(case, gears)
    if not any(body.inertia for body in torsional_system(case, case.gears[0]).bodies):
        raise CaseError(
            "E514",
            "nothing has an inertia, so nothing vibrates; expected `inertias` of links",
            ("inertias",),
        )
    case = case.with_coast(coast)
    if count is None and case.own_links > SOME_LINKS:
        count = SOME_MODES
    with np.errstate(all="ignore"):  # invalid numbers are detected later
        gears_at_work = (working_gear(case, gear, speed_ratios) for gear in asked)
        return CaseModes(_gear_modes(working, count) for working in gears_at_work)


def _gear_modes(working: WorkingGear, count: int | None) -> GearModes:
    case, gear, converters, doubts = working
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearModes(gear.name, error=system)
    system = system._replace(converters=converters)
    split, held = coordinates(system), balance(system)
    if count is not None and split.has_many_more(count):
        natural = lowest_modes(system, split, count)
    else:
        natural = natural_modes(system, split)
    damped = None
    if system.resists or any(device.damping for device in system.elastic):
        damped = damped_modes(system, split, natural)
    warnings = [*doubts, *_warnings(system, split, held)]
    if damped and len(natural.omegas) < split.modes:
        part = f"the first {len(natural.omegas)} of {split.modes} modes"
        warnings.append(f"the damped vibration is calculated from {part} alone")
    lowest = NaturalModes(natural.omegas[:count], natural.shapes[:, :count])
    return GearModes(
        gear.name,
        split.rigid.shape[1],
        list(_named(case, system, split, held, lowest, damped)),
        [] if damped is None else [complex(value) for value in damped.eigenvalues],
        warnings,
        slopes={spring.name: spring.slope for spring in spring_slopes(case, gear)},
        converters={converter.name: converter for converter in converters},
    )


def _warnings(system: TorsionalSystem, split: Coordinates, held: Balance) -> Iterator[str]:
    if not system.elastic:
        yield (
            "nothing is elastic; expected `springs`, or a `stiffness` of a component that takes "
            "part"
        )
    names = [name for name, loose in zip(system.names, split.undetermined, strict=True) if loose]
    if names:
        verb = "has" if len(names) == 1 else "have"
        yield (
            f"{spoken(names)} {verb} neither an inertia nor a component that resists: left out; "
            "give an inertia, or join the link"
        )
    rigid = [device.name for device in system.rigid]
    unknown = [name for name, known in zip(rigid, held.determined, strict=True) if not known]
    if unknown:
        sets = [involved for involved, _ in dependencies(system.rigid_twists)]
        what = "; ".join(spoken([rigid[index] for index in involved]) for involved in sets)
        verb = "is" if len(sets) == 1 else "are"
        yield (
            f"{what}: {count_of('component', len(sets))} {verb} in excess; the speeds "
            f"agree, the torque of {spoken(unknown)} is not determined"
        )


def _named(  # noqa: PLR0913, PLR0917
    case: Transmission,
    system: TorsionalSystem,
    split: Coordinates,
    held: Balance,
    natural: NaturalModes,
    damped: DampedModes | None,
) -> Iterator[Mode]:
    """Yield the modes by names of links and components, scaled to a largest amplitude of 1."""
    shapes = natural.shapes / _largest(natural.shapes[: system.case_links])
    link_torques = torques(system, held, shapes, natural.omegas)
    by_device = own_torques(case, system, link_torques, shapes * natural.omegas**2)
    kinetic = _shares(shapes, [(body.name, body.inertia, body.form) for body in system.bodies])
    springs = [(device.name, device.rate, device.twist) for device in system.elastic]
    elastic = _shares(shapes, springs)
    nodes = count_nodes(system, split, shapes)
    shapes[split.undetermined] = math.nan
    links = system.names[: system.case_links]
    ratios = np.zeros_like(natural.omegas) if damped is None else damped.ratios
    damped_omegas = natural.omegas if damped is None else damped.frequencies
    for index, omega in enumerate(natural.omegas.tolist()):
        yield Mode(
            omega=omega,
            damping_ratio=float(ratios[index]),
            damped_frequency=float(damped_omegas[index]) / (2 * math.pi),
            shape=_of_mode(dict(zip(links, shapes, strict=False)), index),
            torques=_of_mode(by_device, index),
            kinetic=_of_mode(kinetic, index),
            elastic=_of_mode(elastic, index),
            nodes=int(nodes[index]),
        )


def _largest(amplitudes: Floats) -> Floats:
    """Return the signed amplitude of largest magnitude of each mode; the first in a tie."""
    sizes = np.abs(amplitudes)
    first = np.argmax(sizes >= sizes.max(axis=0) * (1 - TIE), axis=0)
    largest = amplitudes[first, np.arange(amplitudes.shape[1])]
    return np.where(largest, largest, 1.0)


def _shares(shapes: Floats, parts: Sequence[tuple[str, float, Form]]) -> dict[str, Floats]:
    energies = [size * form_values(form, shapes) ** 2 for _, size, form in parts]
    total = np.sum(energies, axis=0)
    shares: dict[str, Floats] = {}
    for (name, _, _), energy in zip(parts, energies, strict=True):
        shares[name] = shares.get(name, 0.0) + energy / np.where(total, total, 1.0)
    return shares


def _of_mode(by_name: Mapping[str, Floats], mode: int) -> dict[str, float]:
    return {name: float(values[mode]) + 0.0 for name, values in by_name.items()}
