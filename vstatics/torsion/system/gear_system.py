"""The torsional system of a gear: what is heavy, what is elastic, what is rigid.

``M q'' + D q' + K q = 0`` with ``M`` of the bodies, ``K`` and ``D`` of the elastic devices, for
the angles q of the links, of which the rigid devices leave some free. A device has in it the
row that it has in the structural-distribution matrix (Tsitovich, Algin, Vehicle dynamics, 1981,
1.2: the equations of a gearbox with a compliant casing, (1.11), are those of a mechanism whose
row is its twist).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.model.parts import NO_DAMPING, Damping, damping
from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics.motions import Form
from vstatics.statics.matrix import Column, columns, value
from vstatics.torsion.system.bodies import Body, planet_bodies


class TorsionalDevice(NamedTuple):
    """A device that holds links together, rigidly or not."""

    name: str
    twist: Form
    """By the angles of links (indices from 0). [-]"""
    stiffness: float | None = None
    """[N*m/rad]; None: it is rigid, its twist is 0."""
    damping: Damping = NO_DAMPING


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
    """

    names: tuple[str, ...]
    own: int
    bodies: tuple[Body, ...]
    devices: tuple[TorsionalDevice, ...]
    link_inertias: tuple[float, ...]

    @property
    def elastic(self) -> list[TorsionalDevice]:
        """The devices with a stiffness."""
        return [device for device in self.devices if device.stiffness is not None]

    @property
    def rigid(self) -> list[TorsionalDevice]:
        """The devices without."""
        return [device for device in self.devices if device.stiffness is None]


def torsional_system(case: Transmission, gear: Gear) -> TorsionalSystem:
    """The system of a gear whose freewheels that hold stand among the engaged elements.

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
    links = [
        Body(case.link_names[index], {index: 1.0}, case.inertias.get(index + 1, 0.0))
        for index in range(case.own_links)
    ]
    inertias = [case.inertias.get(index + 1, 0.0) for index in range(case.links)]
    planets = []
    for body, shares in planet_bodies(case):
        planets.append(body)
        for index, share in shares.items():
            inertias[index] += share
    return TorsionalSystem(
        tuple(case.link_names),
        case.own_links,
        (*links, *planets),
        tuple(_devices(case, gear)),
        tuple(inertias),
    )


def _devices(case: Transmission, gear: Gear) -> Iterator[TorsionalDevice]:
    by_device = columns(case, [mechanism.ratio for mechanism in case.mechanisms])
    engaged = set(gear.engaged)
    for number, element in enumerate(case.shift_elements, 1):
        if number in engaged:
            twist = _form(by_device[number - 1])
            yield TorsionalDevice(element.name, twist, element.stiffness, damping(element.damping))
    for mechanism, column in zip(case.mechanisms, by_device[case.among_devices], strict=True):
        twist = _form(column)
        yield TorsionalDevice(
            mechanism.name, twist, mechanism.stiffness, damping(mechanism.damping)
        )
    for spring, column in zip(case.springs, by_device[case.among_devices.stop :], strict=True):
        yield TorsionalDevice(spring.name, _form(column), spring.rate, damping(spring.damping))


def _form(column: Column) -> dict[int, float]:
    return {link - 1: float(value(part)) for link, part in column.items()}
