"""Fields of a transmission before its checks, and quantities derived from the fields."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, Literal, Protocol, Self, TypeVar, runtime_checkable

from vstatics.core.errors import Problem, listed, plural, spoken, typed_number
from vstatics.core.groups import grouped
from vstatics.core.model.parts import (
    NO_LOAD,
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

if TYPE_CHECKING:  # imported only by cases with converters
    from vstatics.core.model.converters import Converter

Value = TypeVar("Value")
IdleConvention = Literal["published", "exact"]
"""Convention for the sign of power in mechanisms that transmit no power; see docs/method.md."""


Bodies = list[int]
"""Body of each link, housing first, identified by the smallest link number in the body."""
MOST_CYLINDERS = 48
"""Largest number of cylinders of a four-stroke engine, which fires 24 times per revolution."""


def join(bodies: Bodies, *links: int) -> None:
    """Merge the bodies of several links, in place."""
    joined = {bodies[link] for link in links}
    if len(joined) > 1:
        least = min(joined)
        bodies[:] = [least if body in joined else body for body in bodies]


@runtime_checkable
class AnyDrawing(Protocol):
    """Interface of a drawing (gear sets with teeth), implemented by `vstatics.core.elements`."""

    @property
    def links(self) -> int:
        """Number of links of the case. Links of planets have larger numbers."""

    @property
    def mechanisms(self) -> Sequence[Mechanism]:
        """Mechanisms listed by the case itself, in addition to gear sets."""

    @property
    def devices(self) -> Sequence[OwnDevice]:
        """Gear sets and mechanisms of the case, in the order of the mechanisms of the solver."""

    def ratio_range(self, index: int) -> tuple[float, float]:
        """Return the bounds of a mechanism's basic ratio, which depend on the kind of gear set."""

    def problems(self) -> Iterator[Problem]:
        """Yield every error of the gear sets."""

    def lowered(self, link_names: Sequence[str]) -> dict[str, Any]:
        """Return the fields of a case that follow from the drawing, such as its mechanisms."""


class Carried(Protocol):
    """Interface of data that an annex stores in a case and the core does not read."""

    def completed(self) -> Self:
        """Return the data with all numbers as floats; the data must have passed the checks."""


@dataclass(frozen=True)
class TransmissionFields:
    """Fields of a `Transmission`, explained in the docstring of `Transmission`."""

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
    bearings: Mapping[str, Carried] = field(default_factory=dict)
    allow: Sequence[str] = ()
    masses: Mapping[int, float] = field(default_factory=dict)
    cylinders: int | None = None
    drag: Mapping[int, float] = field(default_factory=dict)
    hushed: Sequence[str] = field(default=(), repr=False, compare=False)
    """Ids of messages suppressed by the caller, not by the case."""
    _lowered: AnyDrawing | None = field(default=None, repr=False, compare=False)
    """Drawing from which the mechanisms were derived, to detect a replaced `drawing`."""

    def __post_init__(self) -> None:
        """Leave all checks to `Transmission`."""

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields without cached derived values, for copying and pickling."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}

    @cached_property
    def _derived(self) -> dict[Callable[[Any], Any], Any]:
        return {}

    def derived(self, derive: Callable[[Self], Value]) -> Value:
        """Return `derive(case)`, calculated only once.

        Cases that differ only in ratios, efficiencies and planet ratios share the value. The
        function must therefore not read these numbers.
        """
        if derive not in self._derived:
            self._derived[derive] = derive(self)
        value: Value = self._derived[derive]
        return value

    @property
    def untold(self) -> Sequence[str]:
        """Ids of messages suppressed by the case or by the caller."""
        return (*self.allow, *self.hushed)

    @property
    def main_output(self) -> int:
        """Output link, by default the first of several outputs or the last link."""
        return self.output or next(iter(self.outputs), self.links)

    @property
    def own_links(self) -> int:
        """Number of links of the case, without planets."""
        return self.links if self.drawing is None else self.drawing.links

    @property
    def heavy(self) -> dict[int, float]:
        """Inertia of each rotating link [kg*m^2], mass of each link that moves straight [kg]."""
        return {**self.inertias, **self.masses}

    @property
    def connections(self) -> Counter[int]:
        """Number of components that are connected to each link, or to the housing."""
        return Counter(
            chain(
                *(element.links for element in self.shift_elements),
                *(mechanism.links for mechanism in self.mechanisms),
                *(converter.links for converter in self.converters),
                *(spring.form for spring in self.springs),
            )
        )

    def is_straight(self, spring: Spring) -> bool:
        """Return whether a spring acts along a straight line, with a stiffness in N/m."""
        return any(link in self.masses for link in spring.form)

    @cached_property
    def own_devices(self) -> Sequence[OwnDevice]:
        """Gear sets and mechanisms named in the case, each with its mechanisms of the solver."""
        if self.drawing is not None:
            return self.drawing.devices
        return [_own_device(number, mechanism) for number, mechanism in enumerate(self.mechanisms)]

    def ratio_range(self, index: int) -> tuple[float, float]:
        """Return the bounds of a mechanism's basic ratio [-]; infinite without gear sets."""
        return self.drawing.ratio_range(index) if self.drawing else (-math.inf, math.inf)

    def gear_number(self, asked: int | str) -> int:
        """Return the number of a gear (from 1), found by name or number.

        Parameters
        ----------
        asked : int or str
            A name, or the number as an int or as a text such as ``#3``. The text ``3`` is a
            number only if no name of a gear contains a digit.

        Raises
        ------
        ValueError
            If the gear does not exist (the message suggests the nearest name), or if an int is the
            number of a gear and the name of another gear.
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
        """Return the number of a link that is not a planet, found by name or number.

        Raises
        ------
        ValueError
            If the link does not exist. The message suggests the nearest name.
        """
        names = self.link_names[: self.own_links]
        if str(asked) in names:
            return names.index(str(asked)) + 1
        if number := typed_number(str(asked), len(names)):
            return number
        hint = nearest(str(asked), names) or f"; links are {listed(names, 12)}"
        raise ValueError(f"no link {asked!r}{hint}")

    def gear_input(self, gear: Gear) -> int:
        """Return the input link of a gear."""
        return gear.input or self.input

    def gear_output(self, gear: Gear) -> int:
        """Return the output link of a gear."""
        return gear.output or self.output

    def further_outputs(self, gear: Gear) -> list[int]:
        """Return the outputs of a gear other than the main output."""
        ends = self.gear_input(gear), self.gear_output(gear)
        return [link for link in self.outputs if link not in ends]

    def gear_load(self, gear: Gear) -> Load:
        """Return the operating point of a gear. The case supplies values that the gear omits.

        If `coast` is given, it determines the sign of the torque: opposite to the sign of the input
        speed if true, equal if false.
        """
        if gear.load is None and self.load is None:
            return NO_LOAD
        load = (gear.load or NO_LOAD).or_else(self.load or NO_LOAD)
        coast = self.gear_coast(gear)
        if coast is None or not load.torque:
            return load
        against = load.torque * (load.speed or 1.0) < 0
        if against == coast:
            return load
        power = None if load.power is None else -load.power
        return load._replace(torque=-load.torque, power=power)

    def gear_coast(self, gear: Gear) -> bool | None:
        """Return the `coast` setting of a gear, by default the setting of the case."""
        return self.coast if gear.coast is None else gear.coast

    def coasts(self, gear: Gear) -> bool:
        """Return whether a gear coasts, from the sign of the input power or else from `coast`."""
        load = self.gear_load(gear)
        if load.speed and load.torque:
            return load.speed * load.torque < 0
        return bool(self.gear_coast(gear))

    def torque_unit(self, gear: Gear) -> float:
        """Return the torque to which the torques of a gear are relative: its input torque [N*m].

        If the input torque is 0, the result is 1 N*m with the sign of the input speed, or the
        opposite sign if the gear coasts. If the input torque is unknown, the result is 0.
        """
        load = self.gear_load(gear)
        if load.torque is None or load.torque:
            return load.torque or 0.0
        return math.copysign(1.0, load.speed or 1.0) * (-1.0 if self.coasts(gear) else 1.0)

    def input_torque(self, gear: Gear) -> float:
        """Return the relative input torque of a gear: 1, or 0 if the input torque is 0."""
        return 0.0 if self.gear_load(gear).torque == 0 else 1.0

    @cached_property
    def unloaded(self) -> list[int]:
        """Indices of gears with an input torque of 0, whose torques are relative to 1 N*m."""
        return [n for n, gear in enumerate(self.gears) if not self.input_torque(gear)]

    def input_turns(self, gear: Gear) -> Direction | Literal[""]:
        """Return the direction of rotation of a gear's input; empty if unknown."""
        if gear.input_turns:
            return gear.input_turns
        load = self.gear_load(gear)
        said = load.speed or load.torque
        return "" if not said else "forward" if said > 0 else "backward"

    @cached_property
    def has_converter(self) -> bool:
        """True if the case has a converter, which multiplies torque differently from speed."""
        return any(mechanism.kind == "converter" for mechanism in self.mechanisms)

    def elements_at(self, numbers: Iterable[int]) -> list[ShiftElement]:
        """Return the shift elements with the given numbers."""
        return [self.shift_elements[number - 1] for number in numbers]

    def conserves_power(self, gear: Gear) -> bool:
        """Return whether all input power reaches the output of a gear if meshes have no losses."""
        return not (gear.speeds or gear.torques or self.has_converter or gear.slipping)

    def bodies(self, gear: Gear) -> Bodies:
        """Return the bodies of a gear: links joined by engaged shift elements and shafts.

        Examples
        --------
        >>> from vstatics.core.model.transmission import Transmission
        >>> case = Transmission(3, [ShiftElement(2), ShiftElement(3, 1)],
        ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
        >>> [case.bodies(gear) for gear in case.gears]
        [[0, 1, 0, 3], [0, 1, 2, 1]]
        """
        bodies = list(range(self.links + 1))
        for element in self.elements_at(gear.joining):
            join(bodies, element.first, element.second)
        for spring in self.springs:  # at constant speeds the twist of a shaft is constant
            join(bodies, *(() if spring.is_damper else ends(spring.twist) or ()))
        return bodies

    def bypassed(self, gear: Gear) -> set[int]:
        """Return the indices of converters bypassed in a gear, for example by a lock-up clutch.

        Pump and turbine are then one body, so the converter carries no torque and has no equation
        in this gear, whatever its speed ratio in other gears.

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
            for number, mechanism in enumerate(self.mechanisms)
            if mechanism.kind == "converter" and bodies[mechanism.first] == bodies[mechanism.second]
        }

    def freewheel_side(self, gear: Gear, place: int) -> int:
        """Return the side of a freewheel to which the pump of a converter is connected.

        Parameters
        ----------
        place : int
            Index of the converter among the mechanisms.

        Returns
        -------
        int
            1 if the pump is on the first link of a freewheel and the turbine on the second, so a
            forward turbine cannot overrun the pump. -1 for the opposite order. 0 if no freewheel
            connects pump and turbine.
        """
        bodies = self.bodies(gear)
        pump, turbine = (bodies[link] for link in self.mechanisms[place].links[:2])
        for element in self.elements_at(self.freewheels):
            ends = bodies[element.first], bodies[element.second]
            if {*ends} == {pump, turbine}:
                return 1 if ends[0] == pump else -1
        return 0

    def unloaded_converters(self, gear: Gear) -> set[int]:
        """Return the indices of converters that are bypassed in a gear or listed under its `open`.

        Such converters carry no torque and have no equation in this gear.

        Examples
        --------
        >>> from vstatics.core.model.transmission import Transmission
        >>> converter = Mechanism(1, 2, 0, 0.8, kind="converter", points=((0, 2), (1, 1)))
        >>> case = Transmission(2, [ShiftElement(1, 2)], [converter], [Gear(), Gear(open=[1])])
        >>> [case.unloaded_converters(gear) for gear in case.gears]
        [set(), {0}]
        """
        if not self.has_converter:
            return set()
        first = self.own_mechanisms.start - 1
        opened = {first + number for number in gear.open if first + number < len(self.mechanisms)}
        return opened | self.bypassed(gear)

    def sought_converters(self, gear: Gear) -> list[int]:
        """Return the indices of converters whose speed ratio the load determines in a gear.

        Examples
        --------
        >>> from vstatics.core.model.transmission import Transmission
        >>> points = ((0, 2, 0.001), (1, 1, 0.0))
        >>> converter = Mechanism(1, 2, 0, math.nan, kind="converter", points=points)
        >>> case = Transmission(2, [], [converter], [Gear(), Gear(speed_ratios={1: 0.8})])
        >>> [case.sought_converters(gear) for gear in case.gears]
        [[0], []]
        """
        if not self.has_converter:
            return []
        ratios = enumerate(zip(self.mechanisms, self.gear_ratios(gear), strict=True))
        return [n for n, (part, ratio) in ratios if part.kind == "converter" and ratio != ratio]  # noqa: PLR0124 - NaN

    @property
    def own_mechanisms(self) -> slice:
        """Slice of the mechanisms that are not derived from gear sets; these are last."""
        drawn = len(self.mechanisms) - len(self.drawing.mechanisms) if self.drawing else 0
        return slice(drawn, len(self.mechanisms))

    def gear_ratios(self, gear: Gear, ratios: Sequence[Any] | None = None) -> list[Any]:
        """Return the ratio of each mechanism in a gear, replaced by its `speed_ratios` [-].

        A converter that is bypassed or open gets the ratio 1 as a placeholder.

        Parameters
        ----------
        ratios : sequence, optional
            Ratios of the mechanisms in all gears, by default their `ratio`. [-]
        """
        in_gear = (
            list(ratios)
            if ratios is not None
            else [mechanism.ratio for mechanism in self.mechanisms]
        )
        for number, ratio in gear.speed_ratios.items():
            place = self.own_mechanisms.start + number - 1
            if place < len(in_gear):  # larger numbers belong to `converters`
                in_gear[place] = ratio
        for place in self.unloaded_converters(gear):
            in_gear[place] = 1.0
        return in_gear

    def link_name(self, link: int) -> str:
        """Return the name of a link; the housing is ``housing``."""
        return self.link_names[link - 1] if link else "housing"

    def speed_text(self, speed: float | SpeedOf) -> str:
        """Return a speed that the case prescribes as text, such as ``0.5`` or ``1.05*FL``."""
        if not isinstance(speed, SpeedOf):
            return f"{speed:g}"
        name = self.link_name(speed.link)
        name = f"link {name}" if name.isdigit() else name
        return name if speed.factor == 1 else f"{speed.factor:g}*{name}"

    @cached_property
    def freewheels(self) -> list[int]:
        """Numbers of the shift elements that are freewheels."""
        return [n for n, element in enumerate(self.shift_elements, 1) if element.is_freewheel]

    def gear_drag(self, gear: Gear) -> dict[int, float]:
        """Return the drag torque on links in a gear [-], by default the drag of the case.

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
        """Return the drag torque of each shift element when disengaged in a gear [-], by number."""
        numbered = enumerate(self.shift_elements, 1)
        return {
            **self._in_gear(gear, {number: element.drag for number, element in numbered}),
            **gear.open_drag,
        }

    @cached_property
    def gears_with_drag(self) -> Sequence[Gear]:
        """Gears completed with the drag torques of the case and of the shift elements."""
        return [
            gear._replace(drag=self.gear_drag(gear), open_drag=self.gear_open_drag(gear))
            for gear in self.gears
        ]

    def _in_gear(self, gear: Gear, torques: Mapping[int, float]) -> dict[int, float]:
        if not any(isinstance(torque, OfLoad) for torque in torques.values()):
            return dict(torques)
        unit = abs(self.torque_unit(gear))
        return {part: related(torque, unit) for part, torque in torques.items()}

    @cached_property
    def has_drag(self) -> bool:
        """True if any gear has a drag torque."""
        return any(
            any(gear.drag.values()) or any(gear.open_drag.values()) for gear in self.gears_with_drag
        )

    @cached_property
    def laws(self) -> list[Law]:
        """Drag torques, efficiencies and losses that depend on speed or torque."""
        of_elements = [element.drag for element in self.shift_elements]
        numbers: list[float | None] = [*self.drag.values(), *of_elements]
        for mechanism in self.mechanisms:
            numbers += [mechanism.efficiency, mechanism.back_efficiency or 0.0]
        for gear in self.gears:
            numbers += [*gear.drag.values(), *gear.open_drag.values(), gear.loss]
        return [number for number in numbers if isinstance(number, Law)]

    @property
    def depends(self) -> bool:
        """True if a loss or a converter depends on the load, or a gear has a battery balance."""
        return bool(self.laws) or any(
            gear.balance is not None or self.sought_converters(gear) for gear in self.gears
        )

    def problems_of_gears(
        self, identity: str, messages: Iterable[tuple[int, str]]
    ) -> Iterator[Problem]:
        """Yield a problem for each different message, at the first of its gears.

        Parameters
        ----------
        identity : str
            Id of the problems.
        messages : iterable of tuple
            Pairs of the number of a gear and a message.

        Examples
        --------
        >>> from vstatics import Gear, Transmission
        >>> case = Transmission(2, [], [], [Gear(), Gear(), Gear(name="R")])
        >>> for problem in case.problems_of_gears("E277", [(1, "none"), (2, "none"), (3, "none")]):
        ...     print(problem)
        gears[1]: none; this also concerns gears 2 and R [E277]
        """
        by_text = grouped((message, number) for number, message in messages)
        for message, (first, *others) in by_text.items():
            names = [self.gears[number - 1].name or str(number) for number in others]
            of_others = f"; this also concerns {plural('gear', len(names))} {spoken(names)}"
            yield Problem(identity, message + of_others * bool(names), ("gears", first))

    @property
    def devices(self) -> list[str]:
        """Names of all components in the order of the structural-distribution matrix."""
        elements = [element.name for element in self.shift_elements]
        mechanisms = [mechanism.name for mechanism in self.mechanisms]
        return [*elements, *mechanisms, *(spring.name for spring in self.springs)]

    @property
    def has_own_rows(self) -> bool:
        """True if results have rows for gear sets or springs, which a deck cannot name."""
        return self.drawing is not None or bool(self.springs)

    @property
    def among_devices(self) -> slice:
        """Slice of the mechanisms in `devices`, between shift elements and springs."""
        elements = len(self.shift_elements)
        return slice(elements, elements + len(self.mechanisms))


def gear_place(text: str, names: Sequence[str]) -> int | None:
    """Return the number of a gear from a text such as ``#3``, or None.

    Without ``#`` a text is a number only if no name contains a digit. For example, with gears 1 to
    8 and R, the text `9` does not select the ninth gear, R.

    >>> names = ["1", "2", "R"]
    >>> gear_place("3", names), gear_place("#3", names), gear_place("2", ["low", "high"])
    (None, 3, 2)
    """
    if not text.startswith("#") and any(map(str.isdigit, "".join(names))):
        return None
    return typed_number(text.removeprefix("#"), len(names))


def numbered_gear(text: str, names: Sequence[str]) -> str:
    """Return a hint with the name of the gear, if the user wrote its number instead.

    >>> numbered_gear("3", ["1", "2", "R"]), numbered_gear("4", ["1", "2", "R"])
    ('; #3 is R', '')
    """
    place = typed_number(text, len(names))
    return f"; #{place} is {names[place - 1]}" if place else ""


def _own_device(index: int, mechanism: Mechanism) -> OwnDevice:
    links = mechanism.links if mechanism.third else mechanism.links[:2]
    members = [
        Member(name, link, ((index, place),))
        for place, (name, link) in enumerate(zip(("first", "second", "third"), links, strict=False))
    ]
    return OwnDevice(mechanism.name, (index,), tuple(members), (Planet(mechanism.name, index),))
