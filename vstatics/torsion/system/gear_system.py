"""Torsional system of a gear, with bodies, elastic components and rigid components.

The equation is ``M q'' + D q' + K q = 0`` for the angles q of the links. The bodies give ``M``, the
elastic components ``K`` and ``D``, and the rigid components are constraints. The twist of a
component is a linear form of angles: its row of the structural-distribution matrix (Tsitovich,
Algin, Vehicle dynamics, 1981, 1.2 and (1.11)).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.elements.planet_bodies import Body, Shares, planet_bodies
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.parts import NO_DAMPING, Damping, Mechanism, ShiftElement, damping
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.motions import Form, free_motions, values_of
from vstatics.core.statics.matrix import rows, value
from vstatics.torsion.system.converters import WorkingConverter


class TorsionalDevice(NamedTuple):
    """Rigid or elastic component between links."""

    name: str
    twist: Form
    """Coefficients of the angles of links in the twist, by index of the link from 0. [-]"""
    stiffness: float | None = None
    """Stiffness, None for a rigid component, whose twist is 0. [N*m/rad]"""
    damping: Damping = NO_DAMPING

    @property
    def rate(self) -> float:
        """Stiffness, or 0 for a rigid component [N*m/rad]."""
        return self.stiffness or 0.0


class TorsionalSystem(NamedTuple):
    """Torsional system of the links of a gear.

    Attributes
    ----------
    names : sequence of str
        Names of all links: first of the case, then of planets.
    case_links : int
        Number of links of the case.
    bodies : sequence of Body
        A body for each link of the case, which can have the inertia 0; then planets.
    devices : sequence of TorsionalDevice
        Engaged shift elements, mechanisms, springs.
    link_inertias : sequence of float
        Inertias of all links, including shares of planets, which can be negative. [kg*m^2]
    ends : tuple of int
        Indices of the input and the output of the gear.
    planet_shares : sequence of tuple
        Name of each gear set, with the shares of its planets in `link_inertias`.
    converters : sequence of WorkingConverter
        Converters at their operating points; other converters transmit no torque.
    dampers : sequence of TorsionalDevice
        Springs without stiffness, which resist only rates of twist.
    """

    names: tuple[str, ...]
    case_links: int
    bodies: tuple[Body, ...]
    devices: tuple[TorsionalDevice, ...]
    link_inertias: tuple[float, ...]
    ends: tuple[int, int] = (0, 0)
    planet_shares: tuple[tuple[str, Shares], ...] = ()
    converters: tuple[WorkingConverter, ...] = ()
    dampers: tuple[TorsionalDevice, ...] = ()

    @property
    def resists(self) -> bool:
        """True if converters or separate dampers resist motions, even rigid motions."""
        return bool(self.converters or self.dampers)

    @property
    def elastic(self) -> list[TorsionalDevice]:
        """Elastic components."""
        return [device for device in self.devices if device.stiffness is not None]

    @property
    def rigid(self) -> list[TorsionalDevice]:
        """Rigid components."""
        return [device for device in self.devices if device.stiffness is None]

    @property
    def rigid_twists(self) -> list[Form]:
        """Twists of the rigid components, which are linear forms with the value 0."""
        return [device.twist for device in self.rigid]

    @property
    def elastic_twists(self) -> list[Form]:
        """Twists of the elastic components, as linear forms."""
        return [device.twist for device in self.elastic]

    @property
    def heavy(self) -> list[Form]:
        """Motions of the bodies that have inertia, as linear forms."""
        return [body.form for body in self.bodies if body.inertia > 0]

    @property
    def rates(self) -> Floats:
        """Stiffnesses of the elastic components, shape (components,) [N*m/rad]."""
        return np.array([device.rate for device in self.elastic], float)

    @property
    def inertias(self) -> Floats:
        """Inertias of the bodies, shape (bodies,) [kg*m^2]."""
        return np.array([body.inertia for body in self.bodies], float)

    @property
    def dampings(self) -> tuple[Floats, Floats]:
        """Viscous [N*m*s/rad] and hysteretic [N*m/rad] dampings of the elastic components."""
        dampings = [device.damping for device in self.elastic]
        lost = self.rates * np.array([damping.loss_factor for damping in dampings])
        return np.array([damping.viscous for damping in dampings]), lost

    def rows(self, forms: Sequence[Form]) -> Floats:
        """Return linear forms of link angles as a matrix, shape (forms, links)."""
        return values_of(forms, len(self.names))

    @property
    def damper_rows(self) -> Floats:
        """Twists of separate dampers times roots of their dampings, shape (dampers, links)."""
        sizes = np.sqrt([damper.damping.viscous for damper in self.dampers])
        return sizes[:, None] * self.rows([damper.twist for damper in self.dampers])

    @property
    def slip_resistance(self) -> Floats:
        """Contribution of dampers and converters to ``D``, shape (links, links) [N*m*s/rad].

        It is not symmetric with converters.
        """
        return self.damper_rows.T @ self.damper_rows + self.converter_resistance

    @property
    def converter_resistance(self) -> Floats:
        """Contribution of converters to ``D``, not symmetric, shape (links, links) [N*m*s/rad]."""
        resistance = np.zeros((len(self.names), len(self.names)))
        for slopes in self.converters:
            links = [slopes.pump, slopes.turbine]
            resistance[slopes.pump, links] += slopes.A1, slopes.A2
            resistance[slopes.turbine, links] -= slopes.A3, slopes.A4
        return resistance

    @property
    def twists(self) -> Floats:
        """Matrix from link angles to twists of elastic components, shape (components, links)."""
        return self.rows(self.elastic_twists)

    @property
    def speeds(self) -> Floats:
        """Matrix from link speeds to speeds of bodies, shape (bodies, links)."""
        return self.rows([body.form for body in self.bodies])

    def matrices(
        self, twists: Floats, speeds: Floats, motions: Floats
    ) -> tuple[Floats, Floats, Floats, Floats]:
        """Return M, K, D, and K times loss factors, for the coordinates of n motions, each (n, n).

        Parameters
        ----------
        twists : ndarray, shape (devices, n)
            Twists of the elastic components in the motions.
        speeds : ndarray, shape (bodies, n)
            Speeds of the bodies in the motions.
        motions : ndarray, shape (links, n)
        """
        stiffness, resistance, hysteresis = (
            twists.T @ (by_device[:, None] * twists) for by_device in (self.rates, *self.dampings)
        )
        resistance = resistance + motions.T @ self.slip_resistance @ motions
        return speeds.T @ (self.inertias[:, None] * speeds), stiffness, resistance, hysteresis

    def free(self, *others: Form) -> Floats:
        """Return the motions, as columns, in which rigid twists and `others` are 0."""
        return free_motions([*self.rigid_twists, *others], len(self.names))


def torsional_system(
    case: Transmission, gear: Gear, slopes: Mapping[str, float] = EMPTY
) -> TorsionalSystem:
    """Build the torsional system of a gear.

    `gear.engaged` must already include locked freewheels.

    `slopes` are the stiffnesses of nonlinear springs, by name [N*m/rad]. Springs with a slope of 0,
    and converters, transmit no torque.

    Examples
    --------
    >>> from vstatics import Spring, Transmission
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=500.0, name="shaft")
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 0.1, 2: 0.4})
    >>> system = torsional_system(case, case.gears[0])
    >>> [(body.name, body.inertia) for body in system.bodies]
    [('1', 0.1), ('2', 0.4)]
    >>> system.elastic[0].twist
    {0: 1.0, 1: -1.0}
    """
    heavy = case.heavy
    links = [
        Body(case.link_names[index], {index: 1.0}, heavy.get(index + 1, 0.0))
        for index in range(case.own_links)
    ]
    inertias = [heavy.get(index + 1, 0.0) for index in range(case.links)]
    planets = [*planet_bodies(case)]
    for _, shares in planets:
        for index, share in shares.items():
            inertias[index] += share
    devices = list(_devices(case, gear, slopes))
    return TorsionalSystem(
        tuple(case.link_names),
        case.own_links,
        (*links, *(body for body, _ in planets)),
        tuple(device for device in devices if device.stiffness != 0),
        tuple(inertias),
        (case.gear_input(gear) - 1, case.gear_output(gear) - 1),
        tuple((body.name.rpartition(".")[0], shares) for body, shares in planets),
        dampers=tuple(device for device in devices if device.stiffness == 0),
    )


def _devices(
    case: Transmission, gear: Gear, slopes: Mapping[str, float]
) -> Iterator[TorsionalDevice]:
    by_device = rows(case, case.gear_ratios(gear))
    devices: list[ShiftElement | Mechanism | Spring] = [*case.shift_elements, *case.mechanisms]
    devices += case.springs
    for number, (device, column) in enumerate(zip(devices, by_device, strict=True), 1):
        stiffness = device.rate if isinstance(device, Spring) else device.stiffness
        stiffness = slopes.get(device.name, stiffness)
        is_open = isinstance(device, ShiftElement) and number not in gear.joining
        is_open |= isinstance(device, Mechanism) and device.kind == "converter"
        is_open |= stiffness == 0 and not (isinstance(device, Spring) and device.is_damper)
        if not is_open:
            twist = {link - 1: float(value(part)) for link, part in column.items()}
            yield TorsionalDevice(device.name, twist, stiffness, damping(device.damping))
