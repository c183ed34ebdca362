"""What a transmission consists of, before it is checked; what can be asked of it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Protocol, Self, runtime_checkable

from vstatics.core.errors import Problem, listed, typed_number
from vstatics.core.model.bodies import Bodies, join
from vstatics.core.model.parts import (
    Direction,
    Gear,
    Law,
    Load,
    Mechanism,
    Member,
    OfLoad,
    OwnDevice,
    Planet,
    ShiftElement,
    SpeedOf,
    related,
)
from vstatics.core.model.springs import Spring, ends
from vstatics.core.suggestions import nearest

if TYPE_CHECKING:  # who has none does without
    from vstatics.core.model.converters import Converter

IdleConvention = Literal["published", "exact"]
"""Which sign an idle mechanism gets; see docs/method.md."""


MOST_CYLINDERS = 48
"""Of an engine; orders of its speed go as far."""


@runtime_checkable
class AnyDrawing(Protocol):
    """What a case was drawn as, as far as the model knows: the room `elements` has the rest."""

    @property
    def links(self) -> int:
        """The case's own links; those of planets come after them."""

    @property
    def mechanisms(self) -> Sequence[Mechanism]:
        """Those that were given as such, not made from elements."""

    @property
    def devices(self) -> Sequence[OwnDevice]:
        """Elements and mechanisms, in the order of the mechanisms that they became."""

    def ratio_range(self, index: int) -> tuple[float, float]:
        """Between which ratios that of a mechanism is, by the kind of its element."""

    def problems(self) -> Iterator[Problem]:
        """Every error of its elements."""

    def lowered(self, link_names: Sequence[str]) -> dict[str, Any]:
        """The fields of a case that follow from it, for names of its own links."""


class Carried(Protocol):
    """Data of an annex in a case; the core only asks for them by the key of the annex."""

    def completed(self) -> Self:
        """Return checked data with all numbers as floats."""


@dataclass(frozen=True)
class TransmissionFields:
    """The fields of a `Transmission`, whose docstring tells of them."""

    links: int
    shift_elements: Sequence[ShiftElement]
    mechanisms: Sequence[Mechanism]
    gears: Sequence[Gear]
    input: int = 1
    output: int = 0
    idle: IdleConvention = "exact"
    coast: bool | None = None
    name: str = ""
    description: str = ""
    source: str = ""
    link_names: Sequence[str] = ()
    load: Load | None = None
    drawing: AnyDrawing | None = None
    outputs: Sequence[int] = ()
    inertias: Mapping[int, float] = field(default_factory=dict)
    springs: Sequence[Spring] = ()
    converters: Sequence[Converter] = ()
    dump: Carried | None = None
    vehicle: Carried | None = None
    fatigue: Mapping[str, Carried] = field(default_factory=dict)
    allow: Sequence[str] = ()
    masses: Mapping[int, float] = field(default_factory=dict)
    cylinders: int | None = None
    drag: Mapping[int, float] = field(default_factory=dict)
    hushed: Sequence[str] = field(default=(), repr=False, compare=False)
    """Ids that whoever asks wants to hear nothing of: no part of the case, and written nowhere."""
    _lowered: AnyDrawing | None = field(default=None, repr=False, compare=False)
    """The drawing that the mechanisms were made from; with another one they are not its own."""

    def __post_init__(self) -> None:
        """Nothing is checked here, but by `Transmission`."""

    @property
    def untold(self) -> Sequence[str]:
        """Ids of messages that are not told: what the case allows, and who asks."""
        return (*self.allow, *self.hushed)

    @property
    def main_output(self) -> int:
        """The output link also where it is not given: the first output, else the last link."""
        return self.output or next(iter(self.outputs), self.links)

    @property
    def own_links(self) -> int:
        """How many links the case itself has, without those of planets."""
        return self.links if self.drawing is None else self.drawing.links

    @property
    def heavy(self) -> dict[int, float]:
        """Inertias of links that turn, masses of those that move straight [kg*m^2, kg]."""
        return {**self.inertias, **self.masses}

    def is_straight(self, spring: Spring) -> bool:
        """Whether a spring is in N/m: its twist has a link that moves straight."""
        return any(link in self.masses for link in spring.form)

    @cached_property
    def own_devices(self) -> Sequence[OwnDevice]:
        """Mechanisms and drawn elements as the case itself names them."""
        if self.drawing is not None:
            return self.drawing.devices
        return [_own_device(number, one) for number, one in enumerate(self.mechanisms)]

    def ratio_range(self, index: int) -> tuple[float, float]:
        """Between which ratios that of a mechanism is: any, where that is given as such."""
        return self.drawing.ratio_range(index) if self.drawing else (-math.inf, math.inf)

    def gear_number(self, asked: int | str) -> int:
        """The number of a gear from 1: the one of a name, else the one of a number.

        Parameters
        ----------
        asked : int or str
            A text is a name, or ``#3`` of the third; ``3`` is the third, too, where no gear has
            a digit in its name. An int is a number from 1.

        Raises
        ------
        ValueError
            If there is none; it tells the nearest name. If an int is the number of one gear and
            the name of another.
        """
        names = [gear.name for gear in self.gears]
        if asked in names:
            return names.index(str(asked)) + 1
        number = gear_place(str(asked) if isinstance(asked, str) else f"#{asked}", names)
        if number is None:
            hint = nearest(str(asked), names) or f"; gears are {listed(names, 12)}"
            raise ValueError(f"no gear {asked!r}{hint}{numbered_gear(str(asked), names)}")
        if not isinstance(asked, str) and str(asked) in names and names[number - 1] != str(asked):
            other = f"gear {number} is {names[number - 1]!r}, and another is called {str(asked)!r}"
            raise ValueError(f"{other}: expected '#{asked}', or the name as a text")
        return number

    def link_number(self, asked: int | str) -> int:
        """The number of one of the case's own links: the one of a name, else the one of a number.

        Raises
        ------
        ValueError
            If there is none; it tells the nearest name.
        """
        names = self.link_names[: self.own_links]
        if str(asked) in names:
            return names.index(str(asked)) + 1
        if number := typed_number(str(asked), len(names)):
            return number
        hint = nearest(str(asked), names) or f"; links are {listed(names, 12)}"
        raise ValueError(f"no link {asked!r}{hint}")

    def gear_input(self, gear: Gear) -> int:
        """The input link of a gear."""
        return gear.input or self.input

    def gear_output(self, gear: Gear) -> int:
        """The output link of a gear."""
        return gear.output or self.output

    def further_outputs(self, gear: Gear) -> list[int]:
        """The outputs of a gear besides that of its ratio."""
        ends = self.gear_input(gear), self.gear_output(gear)
        return [link for link in self.outputs if link not in ends]

    def gear_load(self, gear: Gear) -> Load:
        """The load of a gear: its own, filled up with that of the case.

        `coast` turns its torque against the input's speed, or along it if it is false.
        """
        load = (gear.load or Load()).or_else(self.load or Load())
        coast = self.gear_coast(gear)
        if coast is None or not load.torque:
            return load
        against = load.torque * (load.speed or 1.0) < 0
        if against == coast:
            return load
        power = None if load.power is None else -load.power
        return load._replace(torque=-load.torque, power=power)

    def gear_coast(self, gear: Gear) -> bool | None:
        """What a gear, or else the case, says of power that enters at the output."""
        return self.coast if gear.coast is None else gear.coast

    def coasts(self, gear: Gear) -> bool:
        """Whether the input is driven: the sign of its power says so, else `coast`."""
        load = self.gear_load(gear) if gear.load or self.load else Load()
        if load.speed and load.torque:
            return load.speed * load.torque < 0
        return bool(self.gear_coast(gear))

    def torque_unit(self, gear: Gear) -> float:
        """What torques of a gear are related to: that of the input with its sign [N*m].

        1 N*m where the load gives none, along its speed unless the gear coasts; 0 if no load
        tells a torque.
        """
        load = self.gear_load(gear)
        if load.torque is None or load.torque:
            return load.torque or 0.0
        return math.copysign(1.0, load.speed or 1.0) * (-1.0 if self.coasts(gear) else 1.0)

    def input_torque(self, gear: Gear) -> float:
        """The torque of the input in the unit of all torques: 1, or 0 where the load gives none."""
        if gear.load is None and self.load is None:
            return 1.0
        return 0.0 if self.gear_load(gear).torque == 0 else 1.0

    @property
    def unloaded(self) -> list[int]:
        """Indices of the gears whose load gives no torque: theirs are relative to 1 N*m."""
        loads = [self.load, *(gear.load for gear in self.gears)]
        if not any(load is not None and load.torque == 0 for load in loads):
            return []
        return [n for n, gear in enumerate(self.gears) if not self.input_torque(gear)]

    def input_turns(self, gear: Gear) -> Direction | Literal[""]:
        """The way in which the input of a gear turns, as it says itself or its load does."""
        if gear.input_turns or (gear.load is None and self.load is None):
            return gear.input_turns
        load = self.gear_load(gear)
        said = load.speed or load.torque
        return "" if not said else "forward" if said > 0 else "backward"

    @property
    def has_converter(self) -> bool:
        """Whether output torque by input torque is not the ratio, even without losses."""
        return any(one.kind == "converter" for one in self.mechanisms)

    def bodies(self, gear: Gear) -> Bodies:
        """The bodies that the engaged elements, and springs as shafts, make of the links.

        Examples
        --------
        >>> from vstatics.core.model.transmission import Transmission
        >>> case = Transmission(3, [ShiftElement(2), ShiftElement(3, 1)],
        ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
        >>> [case.bodies(gear) for gear in case.gears]
        [[0, 1, 0, 3], [0, 1, 2, 1]]
        """
        bodies = list(range(self.links + 1))
        for number in gear.engaged:
            element = self.shift_elements[number - 1]
            join(bodies, element.first, element.second)
        for spring in self.springs:  # a shaft is not twisted further at mean speeds
            join(bodies, *(() if spring.is_damper else ends(spring.twist) or ()))
        return bodies

    def bypassed(self, gear: Gear) -> set[int]:
        """Indices of the converters whose links turn as one body, as by a lock-up clutch.

        Such a one carries no torque, whatever its speed ratio is in other gears: it has no
        equation in this gear.

        Examples
        --------
        >>> from vstatics.core.model.transmission import Transmission
        >>> converter = Mechanism(1, 2, 0, 0.8, kind="converter", points=((0, 2), (1, 1)))
        >>> case = Transmission(2, [ShiftElement(1, 2)], [converter], [Gear([]), Gear([1])])
        >>> [case.bypassed(gear) for gear in case.gears]
        [set(), {0}]
        """
        if not self.has_converter:
            return set()
        bodies = self.bodies(gear)
        return {
            number
            for number, one in enumerate(self.mechanisms)
            if one.kind == "converter" and bodies[one.first] == bodies[one.second]
        }

    @property
    def own_mechanisms(self) -> slice:
        """Where the mechanisms stand that the case gives: behind those of drawn elements."""
        drawn = len(self.mechanisms) - len(self.drawing.mechanisms) if self.drawing else 0
        return slice(drawn, len(self.mechanisms))

    def gear_ratios(self, gear: Gear, ratios: Sequence[Any] | None = None) -> list[Any]:
        """The ratio of each mechanism in a gear [-]: its speed ratios in place of others.

        That of a bypassed converter is 1.

        Parameters
        ----------
        ratios : sequence, optional
            In place of the mechanisms' own, for all gears. [-]
        """
        own = list(ratios) if ratios is not None else [one.ratio for one in self.mechanisms]
        for number, ratio in gear.speed_ratios.items():
            place = self.own_mechanisms.start + number - 1
            if place < len(own):  # else of one of the converters
                own[place] = ratio
        for place in self.bypassed(gear):
            own[place] = 1.0
        return own

    def link_name(self, link: int) -> str:
        """The name of a link; the housing is ``housing``."""
        return self.link_names[link - 1] if link else "housing"

    def speed_text(self, speed: float | SpeedOf) -> str:
        """A given speed in words: ``0.5``, or ``1.05*FL`` for that of another link."""
        if not isinstance(speed, SpeedOf):
            return f"{speed:g}"
        name = self.link_name(speed.link)
        name = f"link {name}" if name.isdigit() else name
        return name if speed.factor == 1 else f"{speed.factor:g}*{name}"

    @property
    def freewheels(self) -> list[int]:
        """Numbers of the shift elements that are freewheels."""
        return [n for n, element in enumerate(self.shift_elements, 1) if element.is_freewheel]

    def gear_drag(self, gear: Gear) -> dict[int, float]:
        """The drag of links in a gear: its own, and for other links the drag of the case.

        Examples
        --------
        >>> from vstatics.core.model.transmission import Transmission
        >>> gears = [Gear(), Gear(drag={1: 0.02})]
        >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 3.0)], gears, drag={1: 0.01, 2: 0.03})
        >>> [case.gear_drag(gear) for gear in case.gears]
        [{1: 0.01, 2: 0.03}, {1: 0.02, 2: 0.03}]
        """
        return {**self._in_gear(gear, self.drag), **gear.drag}

    def gear_open_drag(self, gear: Gear) -> dict[int, float]:
        """The drag of every shift element where it is open in a gear, by its number."""
        numbered = enumerate(self.shift_elements, 1)
        return {
            **self._in_gear(gear, {number: element.drag for number, element in numbered}),
            **gear.open_drag,
        }

    def with_all_drag(self, gear: Gear) -> Gear:
        """Return a gear with the drag of the case and of shift elements as its own."""
        return gear._replace(drag=self.gear_drag(gear), open_drag=self.gear_open_drag(gear))

    def _in_gear(self, gear: Gear, torques: Mapping[int, float]) -> dict[int, float]:
        """Torques of the case, by the load of a gear if they were given with a unit."""
        if not any(isinstance(torque, OfLoad) for torque in torques.values()):
            return dict(torques)
        unit = abs(self.torque_unit(gear)) if self.load or gear.load else None
        return {part: related(torque, unit) for part, torque in torques.items()}

    @property
    def has_drag(self) -> bool:
        """Whether anything drags, in one gear at least."""
        by_gear = [(self.gear_drag(gear), self.gear_open_drag(gear)) for gear in self.gears]
        return any(torque for both in by_gear for given in both for torque in given.values())

    @property
    def laws(self) -> list[Law]:
        """Drags and efficiencies that depend on speed or torque."""
        numbers = [*self.drag.values(), *(element.drag for element in self.shift_elements)]
        for one in self.mechanisms:
            numbers += [one.efficiency, one.back_efficiency or 0.0]
        for gear in self.gears:
            numbers += [*gear.drag.values(), *gear.open_drag.values()]
        return [number for number in numbers if isinstance(number, Law)]

    @property
    def depends(self) -> bool:
        """Whether a drag or an efficiency depends on speed or torque, or a torque on a balance."""
        return bool(self.laws) or any(gear.balance is not None for gear in self.gears)

    @property
    def devices(self) -> list[str]:
        """Names of all devices in the order of the structural-distribution matrix."""
        elements = [element.name for element in self.shift_elements]
        mechanisms = [mechanism.name for mechanism in self.mechanisms]
        return [*elements, *mechanisms, *(spring.name for spring in self.springs)]

    @property
    def has_own_rows(self) -> bool:
        """Whether rows of results have names that no deck tells: of elements, of springs."""
        return self.drawing is not None or bool(self.springs)

    @property
    def among_devices(self) -> slice:
        """Where the mechanisms stand among the devices: shift elements before, springs behind."""
        elements = len(self.shift_elements)
        return slice(elements, elements + len(self.mechanisms))


def gear_place(text: str, names: Sequence[str]) -> int | None:
    """The number from 1 of a gear that is not told by its name; None where a text is none.

    Who writes `9` of gears 1 to 8 and R means a gear that there is not, and not the ninth.

    >>> names = ["1", "2", "R"]
    >>> gear_place("3", names), gear_place("#3", names), gear_place("2", ["low", "high"])
    (None, 3, 2)
    """
    if not text.startswith("#") and any(map(str.isdigit, "".join(names))):
        return None
    return typed_number(text.removeprefix("#"), len(names))


def numbered_gear(text: str, names: Sequence[str]) -> str:
    """A hint how one asks for the gear of a number that is no name.

    >>> numbered_gear("3", ["1", "2", "R"]), numbered_gear("4", ["1", "2", "R"])
    ('; #3 is R', '')
    """
    place = typed_number(text, len(names))
    return f"; #{place} is {names[place - 1]}" if place else ""


def _own_device(index: int, mechanism: Mechanism) -> OwnDevice:
    """A mechanism that was not made from an element."""
    links = mechanism.links if mechanism.third else mechanism.links[:2]
    members = [
        Member(name, link, ((index, place),))
        for place, (name, link) in enumerate(zip(("first", "second", "third"), links, strict=False))
    ]
    return OwnDevice(mechanism.name, (index,), tuple(members), (Planet(mechanism.name, index),))
