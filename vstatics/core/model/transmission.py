"""The class `Transmission`: a case with its links, components and gears, checked and completed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, replace
from itertools import count
from typing import Any

from vstatics.core.arguments import refuse_fields
from vstatics.core.errors import CaseError, plural
from vstatics.core.extras import higher
from vstatics.core.model.checks import carried_keys, problems
from vstatics.core.model.fields import AnyDrawing, IdleConvention, TransmissionFields
from vstatics.core.model.part_checks import of_mechanism_numbers
from vstatics.core.model.parts import (
    HOUSING,
    NO_LOAD,
    Gear,
    Load,
    Mechanism,
    ShiftElement,
    SpeedOf,
    damping,
    element_name,
    mechanism_name,
    related,
    with_floats,
)
from vstatics.core.model.springs import Spring, SpringLimit, spring_name
from vstatics.core.suggestions import nearest

__all__ = [
    "HOUSING",
    "Gear",
    "IdleConvention",
    "Mechanism",
    "ShiftElement",
    "SpeedOf",
    "Transmission",
]

_CLASSES = {"Converter": "vstatics.core.model.converters"}
"""Modules of classes that few cases need, imported only for messages about wrong arguments."""


class Transmission(TransmissionFields):
    """Vehicle transmission, checked at construction.

    Parameters
    ----------
    links : int
        Number of links, without the housing and without planets of drawn gear sets.
    shift_elements, mechanisms, gears : sequence
        Parts in the order of their numbers.
    input, output : int
        Link numbers; by default the output is the last link.
    idle : {"exact", "published"}
        Convention for the sign of power in mechanisms that transmit no power.
    coast : bool, optional
        True if power enters at the output (engine braking): the input torque acts against the input
        speed. False if it acts along the speed. By default the sign of the input power determines
        this.
    link_names : sequence of str
        By default the link numbers.
    load : Load, optional
        Operating point at the input, for results in rpm, N*m and kW.
    drawing : Drawing, optional
        Gear sets from which links and mechanisms are derived. If `replace` changes the drawing,
        they are derived again. If it changes only the mechanisms, the changed mechanisms are used.
    outputs : sequence of int
        Output links, if there are several. The first is `output`; each further link needs a given
        speed or torque.
    inertias : mapping of int to float
        Moments of inertia of links, 0 by default. [kg*m^2]
    springs : sequence of Spring
        Elastic components. A case with springs needs no mechanisms and no gears; without gears it
        has a single gear with no engaged shift elements.
    converters : sequence of Converter
        Torque converters for vibration and simulation. In statics they carry no torque.
    dump : ClutchDump, optional
        Clutch dump to be calculated.
    vehicle : Vehicle, optional
        Vehicle with this transmission.
    fatigue : mapping of str to Fatigue
        Fatigue strength of components or members, by their names.
    bearings : mapping of str to Bearing
        Rolling bearings, by their names.
    masses : mapping of int to float
        Masses of links that move along a straight line, in m instead of rad. [kg]
    cylinders : int, optional
        Number of cylinders of the four-stroke engine at the input; half of them fire per
        revolution.
    drag : mapping of int to float
        Drag torque of bearings and oil on links, against their rotation, relative to the input
        torque. A gear can override it for each link. [-]

    Raises
    ------
    CaseError
        Contains a `Problem` for every error, with the path of the faulty value.

    Examples
    --------
    >>> differential = Transmission(
    ...     links=3,
    ...     shift_elements=[ShiftElement(1, 2), ShiftElement(2, 0)],
    ...     mechanisms=[Mechanism(1, 2, 3, ratio=-2.5)],
    ...     gears=[Gear([1]), Gear([2])],
    ... )
    >>> [element.name for element in differential.shift_elements]
    ['F1', 'T2']
    """

    def __repr__(self) -> str:
        """Return a summary: the name, and the counts of links, elements, mechanisms and gears."""
        parts = {
            "link": self.own_links,
            "shift element": len(self.shift_elements),
            "mechanism": len(self.own_devices),
            "gear": len(self.gears),
        }
        if self.springs:
            parts["spring"] = len(self.springs)
        counts = (f"{count} {plural(what, count)}" for what, count in parts.items())
        name = f" {self.name!r}" if self.name else ""
        return f"<Transmission{name}: {', '.join(counts)}>"

    def replace(self, **changes: Any) -> Transmission:
        """Return the transmission with some parameters replaced, checked again.

        Examples
        --------
        >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()])
        >>> case.replace(name="pair", coast=True)
        <Transmission 'pair': 2 links, 0 shift elements, 1 mechanism, 1 gear>
        """
        known = [field.name for field in fields(self) if field.init]
        for name in changes:
            if name not in known:
                raise TypeError(f"a transmission has no {name!r}{nearest(name, known)}")
        return replace(self, **changes)

    def with_coast(self, coast: bool | None) -> Transmission:  # noqa: FBT001
        """Return the transmission with `coast`, if given, set for all gears."""
        if coast is None:
            return self
        gears = [gear._replace(coast=None) for gear in self.gears]
        unlike = coast != self.coast or gears != list(self.gears)
        return replace(self, coast=coast, gears=gears) if unlike else self

    def with_torque(self, torque: float | None) -> Transmission:
        """Return the transmission with an input torque, if given, for all gears [N*m]."""
        if torque is None:
            return self
        loads = (gear.load and Load(torque=torque).or_else(gear.load) for gear in self.gears)
        gears = [gear._replace(load=load) for gear, load in zip(self.gears, loads, strict=True)]
        return replace(self, load=Load(torque=torque).or_else(self.load or NO_LOAD), gears=gears)

    def as_pairs(self, gear: Gear) -> Transmission | None:
        """Return the case with variators replaced by gear pairs, which have the ratios of one gear.

        The result is None if a converter carries torque in the gear, or a variator has the speed
        ratio 0.

        Examples
        --------
        >>> hydro = Mechanism(1, 2, 0, 0.4, name="hydro", kind="variator")
        >>> case = Transmission(2, [], [hydro], [Gear()])
        >>> case.as_pairs(case.gears[0]).mechanisms[0].ratio
        2.5
        """
        ratios = self.gear_ratios(gear)
        pairs, unloaded = list[Mechanism](), self.unloaded_converters(gear)
        for place, (mechanism, ratio) in enumerate(zip(self.mechanisms, ratios, strict=True)):
            if place in unloaded:
                pairs.append(mechanism._replace(ratio=ratio))
                continue
            if mechanism.kind == "converter" or (mechanism.kind and not ratio):
                return None
            pairs.append(
                mechanism._replace(kind="", ratio=1 / ratio, points=())
                if mechanism.kind
                else mechanism
            )
        gears = [each._replace(speed_ratios={}) for each in self.gears]
        return replace(self, mechanisms=pairs, gears=gears)

    def with_numbers(self, mechanisms: Iterable[Mechanism]) -> Transmission:
        """Return the transmission with other ratios, efficiencies and planet ratios of mechanisms.

        All other fields of the mechanisms must be unchanged. Only the new numbers are checked.

        Raises
        ------
        CaseError
            If a number of a mechanism is not valid.
        """
        others = tuple(mechanisms)
        errors = [
            e
            for n, mechanism in enumerate(others, 1)
            for e in of_mechanism_numbers(mechanism, ("mechanisms", n))
        ]
        if errors:
            raise CaseError(errors)
        case = object.__new__(type(self))
        vars(case).update(vars(self), _derived=self._derived, mechanisms=others)
        vars(case).pop("laws", None)  # of all cached values, only `laws` depends on these numbers
        return case

    @staticmethod
    def from_dict(data: Mapping[str, Any]) -> Transmission:
        """Return the transmission described by a mapping with the keys of a YAML or JSON case.

        Raises
        ------
        ReadError
            The error contains every problem and its path.
        """
        case: Transmission = higher("from_dict")(data)
        return case

    def part_numbers(self) -> Mapping[str, Any]:
        """Return the numbers of all components by path, such as `P1.teeth.sun`."""
        numbers: Mapping[str, Any] = higher("part_numbers")(self)
        return numbers

    def with_part_numbers(self, numbers: Sequence[Any], values: Sequence[float]) -> Transmission:
        """Return the transmission with other values of `part_numbers`, in SI units."""
        case: Transmission = higher("with_part_numbers")(self, numbers, values)
        return case

    def __post_init__(self) -> None:
        """Check all parameters, then complete them with defaults."""
        try:
            if self.drawing is not None and self.drawing != self._lowered:
                self._follow(self.drawing)
            if errors := list(problems(self)):
                raise CaseError(errors)
            self._set(**_completed(self))
            for name in vars(self).keys() - self.__dataclass_fields__.keys():
                del vars(self)[name]  # the value was derived from incomplete fields
        except (AttributeError, TypeError):
            types = {key.shape.name: key.type for key in carried_keys(self)}
            refuse_fields("Transmission", self, types, **_CLASSES)
            raise

    def _follow(self, drawing: AnyDrawing) -> None:
        """Derive links and mechanisms from a drawing; drop planet names of an earlier drawing."""
        if errors := list(drawing.problems()):
            raise CaseError(errors)
        before, names = self._lowered, list(self.link_names)
        if before is not None:
            names_before = names[: before.links]
            if names == before.lowered(names_before)["link_names"]:
                names = names_before[: drawing.links]
        output = self.output or (0 if self.outputs else drawing.links)
        self._set(**drawing.lowered(names), output=output)

    def _set(self, **attributes: object) -> None:
        for attribute, value in attributes.items():
            object.__setattr__(self, attribute, value)


def _completed(case: Transmission) -> dict[str, object]:
    """Return the attributes of a checked case, with default names added and numbers as floats."""
    return {
        "output": case.main_output,
        "outputs": tuple(case.outputs) if len(case.outputs) > 1 else (),
        "link_names": tuple(case.link_names) or tuple(map(str, range(1, case.links + 1))),
        "shift_elements": tuple(
            _shift_element(element, number, case.load)
            for number, element in enumerate(case.shift_elements, 1)
        ),
        "mechanisms": tuple(map(_mechanism, case.mechanisms, count(1))),
        "gears": tuple(
            _gear(case, gear, number) for number, gear in enumerate(case.gears or (Gear(),), 1)
        ),
        "drag": {link: _by_torque(drag, case.load) for link, drag in case.drag.items()},
        "inertias": {link: float(inertia) for link, inertia in case.inertias.items()},
        "masses": {link: float(mass) for link, mass in case.masses.items()},
        "springs": tuple(map(_spring, case.springs, count(1))),
        "converters": tuple(converter.completed() for converter in case.converters),
        "dump": case.dump and case.dump.completed(),
        "vehicle": case.vehicle and case.vehicle.completed(),
        "fatigue": {name: strength.completed() for name, strength in case.fatigue.items()},
        "bearings": {name: bearing.completed() for name, bearing in case.bearings.items()},
    }


def _shift_element(element: ShiftElement, number: int, load: Load | None) -> ShiftElement:
    return element._replace(
        name=element.name or element_name(number, element),
        drag=_by_torque(element.drag, load),
        capacity=None if element.capacity is None else _by_torque(element.capacity, load),
        stiffness=element.stiffness and float(element.stiffness),
        damping=damping(element.damping),
        static=float(element.static),
        friction=element.friction and element.friction.completed(),
    )


def _mechanism(mechanism: Mechanism, number: int) -> Mechanism:
    numbers = mechanism.efficiency, mechanism.back_efficiency, mechanism.stiffness, mechanism.points
    efficiency, back_efficiency, stiffness, points = with_floats(numbers)
    return mechanism._replace(
        ratio=float(mechanism.ratio),
        efficiency=efficiency,
        name=mechanism.name or mechanism_name(number),
        back_efficiency=back_efficiency,
        stiffness=stiffness,
        damping=damping(mechanism.damping),
        points=points,
    )


def _spring(spring: Spring, number: int) -> Spring:
    return spring._replace(
        twist=tuple(spring.form.items()),
        stiffness=with_floats(spring.stiffness),
        compliance=with_floats(spring.compliance),
        damping=damping(spring.damping),
        name=spring.name or spring_name(number),
        limit=_limit(spring.limit),
        strut=with_floats(spring.strut),
        points=with_floats(spring.points),
        friction=float(spring.friction),
    )


def _gear(case: Transmission, gear: Gear, number: int) -> Gear:
    """Return a completed gear. Numbers with a unit become relative to the operating point."""
    load, torque = case.gear_load(gear), case.torque_unit(gear)
    return gear._replace(
        engaged=tuple(gear.engaged),
        speeds={link: _speed(speed, load.speed) for link, speed in gear.speeds.items()},
        slip=_by_load(gear.slip, load.speed),
        torques=_by_load(gear.torques, torque),
        name=gear.name or str(number),
        drag=_by_load(gear.drag, abs(torque)),
        open_drag=_by_load(gear.open_drag, abs(torque)),
        loss_torques=_by_load(gear.loss_torques, abs(torque)),
        pump_torques=_by_load(gear.pump_torques, torque),
        balance=gear.balance
        and gear.balance._replace(efficiencies=tuple(gear.balance.efficiencies)),
        speed_ratios={number: float(ratio) for number, ratio in gear.speed_ratios.items()},
        open=tuple(gear.open),
    )


def _by_load(numbers: Mapping[int, float], whole: float | None) -> dict[int, float]:
    return {part: with_floats(related(number, whole)) for part, number in numbers.items()}


def _by_torque(number: float, load: Load | None) -> float:
    return with_floats(related(number, load.torque_size if load else None))


def _speed(speed: float | SpeedOf, whole: float | None) -> float | SpeedOf:
    if isinstance(speed, SpeedOf):
        return SpeedOf(speed.link, float(speed.factor))
    return with_floats(related(speed, whole))


def _limit(limit: float | SpringLimit | None) -> float | SpringLimit | None:
    if isinstance(limit, SpringLimit):
        return SpringLimit(float(limit.base), limit.of, float(limit.times))
    return with_floats(limit)
