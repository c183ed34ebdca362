"""The torsional system of a gear: what is heavy, what is elastic, what is rigid.

``M q'' + D q' + K q = 0`` with ``M`` of the bodies, ``K`` and ``D`` of the elastic devices, for
the angles q of the links, of which the rigid devices leave some free. A device has in it the
row that it has in the structural-distribution matrix (Tsitovich, Algin, Vehicle dynamics, 1981,
1.2: the equations of a gearbox with a compliant casing, (1.11), are those of a mechanism whose
row is its twist).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from vstatics.core.elements.planet_bodies import Body, Shares, planet_bodies
from vstatics.core.model.parts import NO_DAMPING, Damping, Mechanism, ShiftElement, damping
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.motions import Form, free_motions, values_of
from vstatics.core.statics.matrix import rows, value
from vstatics.torsion.system.converters import WorkingConverter


class TorsionalDevice(NamedTuple):
    """A device that holds links together, rigidly or not."""

    name: str
    twist: Form
    """By the angles of links (indices from 0). [-]"""
    stiffness: float | None = None
    """[N*m/rad]; None: it is rigid, its twist is 0."""
    damping: Damping = NO_DAMPING

    @property
    def rate(self) -> float:
        """Its stiffness, 0 where it is rigid [N*m/rad]."""
        return self.stiffness or 0.0


class TorsionalSystem(NamedTuple):
    """The links of a gear as a vibrating system.

    Attributes
    ----------
    names : sequence of str
        Of all links, those of planets behind the case's own.
    own : int
        How many are the case's own.
    bodies : sequence of Body
        A body for each own link, also where its inertia is 0; then planets.
    devices : sequence of TorsionalDevice
        Engaged shift elements, mechanisms, springs.
    link_inertias : sequence of float
        Of all links, with the shares that they have of planets; some may be below 0. [kg*m^2]
    ends : tuple of int
        Indices of the input and the output of the gear.
    planet_shares : sequence of tuple
        Name of a set, and what its planets add to `link_inertias`.
    converters : sequence of WorkingConverter
        About their working points; without these they are open.
    dampers : sequence of TorsionalDevice
        Springs without a stiffness: they resist rates of twist only.
    """

    names: tuple[str, ...]
    own: int
    bodies: tuple[Body, ...]
    devices: tuple[TorsionalDevice, ...]
    link_inertias: tuple[float, ...]
    ends: tuple[int, int] = (0, 0)
    planet_shares: tuple[tuple[str, Shares], ...] = ()
    converters: tuple[WorkingConverter, ...] = ()
    dampers: tuple[TorsionalDevice, ...] = ()

    @property
    def resists(self) -> bool:
        """Whether converters or dampers alone resist motions, rigid ones too."""
        return bool(self.converters or self.dampers)

    @property
    def elastic(self) -> list[TorsionalDevice]:
        """The devices with a stiffness."""
        return [device for device in self.devices if device.stiffness is not None]

    @property
    def rigid(self) -> list[TorsionalDevice]:
        """The devices without."""
        return [device for device in self.devices if device.stiffness is None]

    @property
    def rigid_twists(self) -> list[Form]:
        """What the rigid devices keep at 0."""
        return [device.twist for device in self.rigid]

    @property
    def elastic_twists(self) -> list[Form]:
        """What the elastic devices resist."""
        return [device.twist for device in self.elastic]

    @property
    def rates(self) -> Floats:
        """Stiffnesses of the elastic devices, shape (devices,) [N*m/rad]."""
        return np.array([device.rate for device in self.elastic], float)

    @property
    def inertias(self) -> Floats:
        """Of the bodies, shape (bodies,) [kg*m^2]."""
        return np.array([body.inertia for body in self.bodies], float)

    def rows(self, forms: Sequence[Form]) -> Floats:
        """Forms of the angles of links as rows, shape (forms, links)."""
        return values_of(forms, len(self.names))

    @property
    def damper_rows(self) -> Floats:
        """Twists of dampers alone, each by the root of its damping, shape (dampers, links)."""
        sizes = np.sqrt([damper.damping.viscous for damper in self.dampers])
        return sizes[:, None] * self.rows([damper.twist for damper in self.dampers])

    @property
    def slip_resistance(self) -> Floats:
        """What dampers alone and converters add to ``D``, shape (links, links) [N*m*s/rad].

        The part of converters is not symmetric.
        """
        resistance: Floats = self.damper_rows.T @ self.damper_rows + self.converter_resistance
        return resistance

    @property
    def converter_resistance(self) -> Floats:
        """What converters add to ``D``, shape (links, links); not symmetric [N*m*s/rad]."""
        made = np.zeros((len(self.names), len(self.names)))
        for one in self.converters:
            made[one.pump, [one.pump, one.turbine]] += one.A1, one.A2
            made[one.turbine, [one.pump, one.turbine]] -= one.A3, one.A4
        return made

    @property
    def twists(self) -> Floats:
        """Those of the elastic devices as rows, shape (devices, links)."""
        return self.rows(self.elastic_twists)

    @property
    def speeds(self) -> Floats:
        """Those of the bodies by speeds of links, shape (bodies, links)."""
        return self.rows([body.form for body in self.bodies])

    def free(self, *others: Form) -> Floats:
        """What the rigid devices, and other forms that are 0, leave free: motions as columns."""
        return free_motions([*self.rigid_twists, *others], len(self.names))


def torsional_system(
    case: Transmission, gear: Gear, slopes: Mapping[str, float] = MappingProxyType({})
) -> TorsionalSystem:
    """The system of a gear whose freewheels that hold stand among the engaged elements.

    Springs with points have the slopes that are given by name; one of 0 is open [N*m/rad]. So are
    converters.

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
    for number, (one, column) in enumerate(zip(devices, by_device, strict=True), 1):
        stiffness = one.rate if isinstance(one, Spring) else one.stiffness
        stiffness = slopes.get(one.name, stiffness)
        is_open = isinstance(one, ShiftElement) and number not in gear.engaged
        is_open |= isinstance(one, Mechanism) and one.kind == "converter"
        is_open |= stiffness == 0 and not (isinstance(one, Spring) and one.is_damper)
        if not is_open:
            twist = {link - 1: float(value(part)) for link, part in column.items()}
            yield TorsionalDevice(one.name, twist, stiffness, damping(one.damping))
