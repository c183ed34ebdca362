"""Mechanical model of a scenario: bodies, constraints, contacts, springs and external torques.

A speed row contains the coefficients that give a speed, such as a slip, from the speeds of links.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.planet_bodies import planet_bodies
from vstatics.core.elements.planet_inertia import planet_inertias
from vstatics.core.errors import CaseError, Path, Problem
from vstatics.core.model.parts import Law, Mechanism, OfLoad, ShiftElement, damping
from vstatics.core.model.springs import Spring, SpringLimit, TwistCurve, straight_curve
from vstatics.core.model.struts import StrutCurve
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.matrix import structural_matrix
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.jumps import LawJump, LawPiece, curve_slope, split_at_jumps
from vstatics.simulation.scenario.laws import Points, Resistance, Road, constant
from vstatics.simulation.scenario.parts import Scenario, formulas
from vstatics.simulation.scenario.programme import (
    OPEN,
    Programme,
    bounded,
    friction_at,
    load_torque,
    newton_metres,
)
from vstatics.simulation.system.matrices import (
    Contact,
    Elastic,
    MotionSystem,
    MovingVariator,
    OutsideTorque,
    RigidMechanism,
    Switch,
    between,
    combination,
    unit,
)
from vstatics.simulation.system.sight import with_settings


def motion_system(
    scenario: Scenario, capacities: list[Programme], gear: Gear | None
) -> MotionSystem:
    """Build the mechanical model of a scenario.

    Parameters
    ----------
    scenario : Scenario
    capacities : sequence of Programme
        Capacities of the shift elements.
    gear : Gear, optional
        Gear at the start, which determines drags.

    Raises
    ------
    CaseError
    """
    case = scenario.case
    bodies = [
        (unit(link - 1, case.links), inertia) for link, inertia in case.heavy.items() if inertia
    ]
    for body, _ in planet_bodies(case):
        if body.inertia:
            by_number = [(index + 1, part) for index, part in body.form.items()]
            bodies.append((combination(by_number, case.links), body.inertia))
    if not bodies:
        raise CaseError(
            "E665",
            "the case has no `inertias`, so nothing can be accelerated: give the inertias of its "
            "links in kg*m^2",
            ("case",),
        )
    dragging = list(drags(case, gear))
    rows = np.ascontiguousarray(structural_matrix(case).T)
    elements = _elements(case, capacities, dragging, rows)
    contacts, outside = _loads(scenario, len(elements))
    frictions = (*_spring_friction(case, rows), *_drag_contacts(case, dragging, rows))
    contacts_of = (*elements, *contacts, *frictions)
    given = [*_given_speed_contacts(scenario)]
    moving = [*_moving_variators(scenario, len(contacts_of) + len(given))]
    system = MotionSystem(
        scenario=scenario,
        names=tuple(case.link_names),
        heavy=np.array([row for row, _ in bodies]),
        inertias=np.array([inertia for _, inertia in bodies]),
        meshes=tuple(_meshes(case, rows, scenario.speed_ratios)),
        contacts=(*contacts_of, *given, *(contact for contact, _ in moving)),
        springs=tuple(_springs(scenario, capacities, rows)),
        outside=tuple(outside),
        converters=scenario.converters,
        settings=scenario.settings,
        variators=tuple(variator for _, variator in moving),
    )
    return with_settings(system, scenario.settings)


def with_programmes(system: MotionSystem, capacities: list[Programme]) -> MotionSystem:
    """Return the system with new capacities of shift elements over time."""
    elements = system.case.shift_elements
    contacts = tuple(
        contact
        if contact.element is None
        else contact._replace(programme=capacities[contact.element])
        for contact in system.contacts
    )
    springs = tuple(
        spring
        if spring.element is None
        else spring._replace(
            programme=_slipping_torque(elements[spring.element], capacities[spring.element])
        )
        for spring in system.springs
    )
    return replace(system, contacts=contacts, springs=springs)


def _meshes(case: Transmission, rows: Floats, moving: Container[int]) -> list[RigidMechanism]:
    meshes = []
    planets = _taken_by_planets(case)
    for number, mechanism in enumerate(case.mechanisms, 1):
        if mechanism.stiffness is not None or number in moving:
            continue
        laws = mechanism.efficiency, _back_efficiency(mechanism, number)
        efficiency, back = map(float, laws)
        u, index = mechanism.ratio, len(case.shift_elements) + number - 1
        meshes.append(
            RigidMechanism(
                mechanism.name,
                index,
                rows[index],
                between(mechanism.first, mechanism.third, case.links),
                combination([(mechanism.second, -u), (mechanism.third, u)], case.links),
                efficiency,
                back,
                planets[number - 1],
                laws if any(isinstance(law, Law) for law in laws) else None,
            )
        )
    return meshes


def _back_efficiency(mechanism: Mechanism, number: int) -> float:
    """Return the efficiency of a back-driven mechanism; raise an error if self-locking."""
    back = mechanism.back_efficiency
    if back == 0:  # a law over speed or torque never equals 0
        raise CaseError(
            "E666",
            f"{mechanism.name} is self-locking, which a simulation cannot calculate yet: give "
            "it a larger efficiency",
            ("case", "mechanisms", number, "back_efficiency"),
        )
    return mechanism.efficiency if back is None else back


def _taken_by_planets(case: Transmission) -> Floats:
    """Return the inertias that relate planet torques to the accelerations of links [kg*m^2].

    The result has the shape (mechanisms, links). The teeth transmit ``J (dw_p/dw_1) dw_p/dt`` from
    the first link of a mechanism, with speed w_1, to planets with speed w_p that are not links of
    the case.
    """
    inertias = np.zeros((len(case.mechanisms), case.links))
    drawing = drawing_of(case)
    for motion in planet_inertias(drawing) if drawing else ():
        if not motion.wheel or motion.name in case.link_names:
            continue
        name = motion.name.rpartition(".")[0]
        [device] = (candidate for candidate in case.own_devices if candidate.name == name)
        [wheel] = (member for member in device.members if member.name == motion.wheel)
        row = combination(motion.speed.items(), case.links)
        for mechanism, place in wheel.places:
            if place == 0:
                inertias[mechanism] += motion.inertia * motion.by_wheel * row
    return inertias


def _elements(
    case: Transmission, capacities: list[Programme], dragging: list[DragTorque], rows: Floats
) -> list[Contact]:
    overrun = {drag.number: drag.torque for drag in dragging if drag.is_element}
    contacts = []
    for index, (element, programme) in enumerate(zip(case.shift_elements, capacities, strict=True)):
        if element.stiffness is not None and not element.is_freewheel:
            continue
        drag = overrun.get(index + 1, 0.0) if element.is_freewheel else 0.0
        contacts.append(
            Contact(
                element.name,
                rows[index],
                programme,
                None if programme.table else element.pack,
                element.static,
                one_way=element.is_freewheel,
                overrun_drag=drag,
                element=index,
            )
        )
    return contacts


def _drag_contacts(case: Transmission, dragging: list[DragTorque], rows: Floats) -> list[Contact]:
    """Return a contact for each drag torque, except for overrunning freewheels."""
    contacts = []
    for is_element, number, torque in dragging:
        if not is_element:
            name, row, while_open = case.link_name(number), unit(number - 1, case.links), None
        elif case.shift_elements[number - 1].is_freewheel:
            continue
        else:
            name = case.shift_elements[number - 1].name
            row, while_open = rows[number - 1], number - 1
        law = torque if isinstance(torque, Law) else None
        programme = Programme(constant(torque if law is None else 1.0))
        contacts.append(Contact(name, row, programme, law, is_drag=True, while_open=while_open))
    return contacts


def _spring_friction(case: Transmission, rows: Floats) -> list[Contact]:
    first = len(case.devices) - len(case.springs)
    return [
        Contact(spring.name, rows[n], Programme(constant(spring.friction)), is_drag=True, beside=n)
        for n, spring in enumerate(case.springs, first)
        if spring.friction
    ]


def _springs(scenario: Scenario, capacities: list[Programme], rows: Floats) -> list[Elastic]:
    case, springs = scenario.case, []
    first = len(case.devices) - len(case.springs) - 1
    bending: list[ShiftElement | Mechanism | Spring] = [
        *case.shift_elements,
        *case.mechanisms,
        *case.springs,
    ]
    for index, device in enumerate(bending):
        limit, element = Programme(constant(math.inf)), None
        if isinstance(device, Spring):
            curve: TwistCurve | StrutCurve = device.curve
        elif device.stiffness is None or (isinstance(device, ShiftElement) and device.is_freewheel):
            continue
        else:
            curve = straight_curve(device.stiffness)
        if isinstance(device, ShiftElement):
            limit, element = _slipping_torque(device, capacities[index]), index
        elif index - first in scenario.limits:
            limit = bounded(scenario.limits[index - first])
        elif isinstance(device, Spring) and device.limit is not None:
            follows = device.limit if isinstance(device.limit, SpringLimit) else None
            base = device.limit.base if isinstance(device.limit, SpringLimit) else device.limit
            limit = Programme(constant(base), follows=follows)
        damped = damping(device.damping)
        springs.append(Elastic(device.name, index, rows[index], curve, *damped, limit, element))
    return springs


def _slipping_torque(element: ShiftElement, capacity: Programme) -> Programme:
    pack = element.pack
    if element.static != 1 or (pack and len(pack.points) > 1):
        raise CaseError(
            "E667",
            f"{element.name} is elastic, so it slips at one torque: leave out `static` and "
            "give one coefficient of friction, or replace its `stiffness` with a spring next "
            "to it",
            ("case",),
        )
    if capacity.table:
        return capacity
    return capacity._replace(factor=capacity.factor * friction_at(pack))


def _loads(scenario: Scenario, first: int) -> tuple[list[Contact], list[OutsideTorque]]:
    """Return external torques: contacts for their dry friction and jumps, then all other terms.

    `first` is the index of the first contact.
    """
    contacts: list[Contact] = []
    outside = []
    for link, law in scenario.torques:
        friction = 0.0
        name = scenario.case.link_name(link)
        row = unit(link - 1, scenario.case.links)
        if isinstance(law, Resistance):
            friction = law.torque
        elif isinstance(law, Road):
            friction = law.rolling_torque
            outside.append(OutsideTorque(link - 1, law))
            if (growth := law.rolling_growth) is not None:
                outside.append(OutsideTorque(link - 1, growth))
        else:
            is_read = _is_read_elsewhere(scenario, name, law)
            jumps, pieces = ([], [LawPiece(law)]) if is_read else split_at_jumps(law)
            number = first + len(contacts)
            for jump in jumps:
                switch = Switch(link - 1, jump)
                contacts.append(Contact(name, row, OPEN, is_drag=True, switch=switch))
            for piece in pieces:
                when = tuple((number + jump, side) for jump, side in piece.when)
                outside.append(OutsideTorque(link - 1, piece.law, when))
        if friction:
            contacts.append(Contact(name, row, Programme(constant(friction))))
    return contacts, outside


def _is_read_elsewhere(scenario: Scenario, name: str, law: Points | Formula) -> bool:
    """Return whether other formulas jump at a speed of the link at which its torque jumps.

    A contact for the jump would not give these formulas the mean of both sides.
    """
    if not isinstance(law, Formula):
        return False
    jumps = {*law.jumps("speed"), *law.surfaces}
    others = (other for other in formulas(scenario) if jumps and other is not law)
    read = (other.elsewhere.on_link(name) for other in others)
    return any(not jumps.isdisjoint([*other.jumps("speed"), *other.surfaces]) for other in read)


def _given_speed_contacts(scenario: Scenario) -> Iterator[Contact]:
    case = scenario.case
    for link, speed in scenario.speeds.items():
        switch = Switch(link - 1, LawJump("speed", speed))
        row = unit(link - 1, case.links)
        yield Contact(case.link_name(link), row, OPEN, switch=switch, is_given=True)


def _moving_variators(scenario: Scenario, first: int) -> Iterator[tuple[Contact, MovingVariator]]:
    """Yield contact and data of each moving variator; `first` is the first contact index."""
    case = scenario.case
    for place, (number, ratio) in enumerate(scenario.speed_ratios.items()):
        mechanism = case.mechanisms[number - 1]
        reference = ratio.at(0.0)
        row = combination([(mechanism.first, reference), (mechanism.second, -1.0)], case.links)
        yield (
            Contact(mechanism.name, row, OPEN, is_variator=True),
            MovingVariator(
                mechanism.name,
                len(case.shift_elements) + number - 1,
                mechanism.first - 1,
                ratio,
                curve_slope(ratio),
                reference,
                first + place,
                mechanism.efficiency,
                _back_efficiency(mechanism, number),
            ),
        )


class DragTorque(NamedTuple):
    """Drag torque in a shift element or on a link."""

    is_element: bool
    """True if the drag acts in a shift element, not on a link."""
    number: int
    """Number of the shift element or link."""
    torque: float
    """Torque [N*m], or a law over speed [rad/s]."""


def drags(case: Transmission, gear: Gear | None) -> Iterator[DragTorque]:
    r"""Yield the drag torques in a gear; without a gear, the drag torques common to all gears.

    Raises
    ------
    CaseError
        If a drag has no unit and no load, or if a drag or loss cannot be simulated.

    Examples
    --------
    A drag given for the whole case also acts without a gear:

    >>> from vstatics.core.readers import loads
    >>> case = loads("links: [a]\ninertias: {a: 1}\ndrag: {a: 0.1}\nload: {torque: 20 N*m}")
    >>> list(drags(case, None))
    [DragTorque(is_element=False, number=1, torque=2.0)]
    """
    problems = []
    gears = [gear] if gear else case.gears
    open_drag = _of_all_gears([case.gear_open_drag(gear) for gear in gears])
    items = [
        (True, number, open_drag.get(number, element.drag), element.name)
        for number, element in enumerate(case.shift_elements, 1)
    ]
    of_links = _of_all_gears([case.gear_drag(gear) for gear in gears])
    items += [(False, link, drag, case.link_name(link)) for link, drag in of_links.items()]
    torques = []
    for is_element, number, drag, name in items:
        place = _place_of_drag(case, gear, number, is_element)
        if isinstance(drag, Law):
            if is_element and case.shift_elements[number - 1].is_freewheel:
                problems.append(
                    Problem(
                        "E695",
                        f"the drag of {name} depends on speed, expected a number in a scenario",
                        place,
                    )
                )
            torques.append(DragTorque(is_element, number, drag))
            continue
        torque = newton_metres(drag, case)
        if drag and not (isinstance(drag, OfLoad) or load_torque(case)):
            problems.append(
                Problem(
                    "E668",
                    f"the drag of {name} is {drag:g} of the input torque, but a scenario has no "
                    "input torque: write the unit, such as `3 N*m`, or give the case a `load` "
                    "with a torque",
                    place,
                )
            )
        elif torque:
            torques.append(DragTorque(is_element, number, torque))
    problems += _gear_losses(case)
    if problems:
        raise CaseError(problems)
    yield from torques


def _gear_losses(case: Transmission) -> Iterator[Problem]:
    for number, gear in enumerate(case.gears, 1):
        if gear.loss is not None:
            message = (
                f"gear {gear.name} has a loss as a whole, but a scenario knows no gear at each "
                "instant; expected efficiencies of mechanisms, or drag"
            )
            yield Problem("E695", message, ("case", "gears", number, "loss"))


def _place_of_drag(case: Transmission, gear: Gear | None, number: int, is_element: bool) -> Path:  # noqa: FBT001
    key, owner = "open_drag" if is_element else "drag", gear or case.gears[0]
    if number in getattr(owner, key):
        return ("case", "gears", case.gear_number(owner.name), key, number)
    return ("case", "shift_elements", number, "drag") if is_element else ("case", key, number)


def _of_all_gears(by_gear: Sequence[Mapping[int, float]]) -> dict[int, float]:
    """Return the drag torques that are equal in all gears, such as drags given for the case."""
    first, *others = by_gear
    return {
        part: drag
        for part, drag in first.items()
        if all(
            part in drags_of_gear and _given(drags_of_gear[part]) == _given(drag)
            for drags_of_gear in others
        )
    }


def _given(torque: float) -> float:
    """Return a drag torque as written: in N*m, or without a unit relative to the load."""
    return torque.given if isinstance(torque, OfLoad) else torque
