"""Numbers of a case, given by a path such as `load.torque` or `gears.split.speeds.MG1`.

All numbers that `vstatics.solve` accepts as varied can vary in a sweep. Values are given with a
unit, and converted to SI units for the calculation.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from typing import Any, Literal, NamedTuple

from vstatics.core.elements.part_numbers import PartNumber, own_part_number, part_numbers
from vstatics.core.errors import listed, quoted
from vstatics.core.model.parts import Law, OfLoad, SpeedOf
from vstatics.core.model.paths import OWNERS, dotted, plain, plain_keys, with_unit
from vstatics.core.model.shape import UNIT_OF, Measure
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.readers.named.si_units import measured
from vstatics.core.readers.named.units import quantity
from vstatics.core.statics.points.paths import CaseNumber, measure_of, numbers_of, wrong_numbers
from vstatics.core.suggestions import nearest
from vstatics.sweep.variants.targets import OF_MECHANISM

EXAMPLES = {"si_speed": "2000 rpm", "si_torque": "50 N*m", "power": "2 kW"}


_RELATIVE = ("speeds", "slip", "torques", "drag", "open_drag")
"""Quantities of a gear that are relative to the load if given without a unit."""
_FIXED = ("vehicle", "cylinders", "fatigue", "bearings", "dump")
"""Keys of a case whose numbers do not affect any table of a gear, so need not vary."""


class CasePath(NamedTuple):
    """Varied number of a case that is given by a path: a number of a gear, load or component."""

    path: str
    of: tuple[CaseNumber, ...] = ()
    """Numbers that `vstatics.solve` varies for the path; empty for a number of a component."""
    part: PartNumber | None = None
    """Number of a component, whose every value needs a new case.

    None means that the number does not belong to a component.
    """
    unit: str = ""
    """Unit of the values; empty for bare numbers, which are relative or in SI units."""
    relative: tuple[CaseNumber, ...] = ()
    """Numbers that vary relative to the load, for values without a unit; empty if not possible."""

    @property
    def name(self) -> str:
        """Name as written by the user, such as `load.speed [rpm]`."""
        return f"{self.path} [{self.unit}]" if self.unit else self.path

    @property
    def quantity(self) -> str:
        """Quantity of the varied `CaseNumber`; empty for a number of a component."""
        return self.of[0].quantity if self.of else ""

    @property
    def numbers(self) -> frozenset[Hashable]:
        """Keys that identify the number. A number of a mechanism has the key of its `Target`."""
        if self.quantity in OF_MECHANISM:
            return frozenset((number.owner, number.quantity) for number in self.of)
        if self.relative:
            return frozenset(number._replace(quantity="slip") for number in self.relative)
        return frozenset(self.of or [self.part])

    @property
    def solved(self) -> str:
        """Path for `vstatics.solve`."""
        return f"{self.path}.relative" if self.of and self.of == self.relative else self.path

    @property
    def measure(self) -> Measure | Literal["power"] | None:
        """Kind of quantity, such as torque, of the values.

        None represents numbers without a unit.
        """
        return self.part.measure if self.part else measure_of(self.quantity)

    def in_unit(self, unit: str) -> CasePath:
        """Return the varied number with values in a unit.

        Raises
        ------
        ValueError
            If the unit does not suit the quantity, or is missing.
        """
        unit = unit or self.unit
        if self.measure is None:
            if unit:
                advice = "; write each value as `98%` or 0.98" * (unit == "%")
                message = f"{self.path}: read values in {unit}, expected bare numbers{advice}"
                raise ValueError(message)
            return self
        if not unit and self.relative:
            return self._replace(of=self.relative)
        if not unit:
            raise ValueError(f"{self.path}: its values need their unit, such as {self.example}")
        _size(unit, self.measure)
        if self.unit and unit != self.unit:
            raise ValueError(f"read values in {unit}, expected them in {self.unit}")
        return self._replace(unit=unit)

    @property
    def example(self) -> str:
        """Value with a usual unit, as an example in messages."""
        assert self.measure is not None  # noqa: S101 - only called for numbers that have units
        if self.measure == "power" or self.measure in EXAMPLES:
            return EXAMPLES[self.measure]
        return f"1 {UNIT_OF[self.measure]}"

    def in_si(self, values: Floats) -> Floats:
        """Return values in SI units."""
        if not self.unit or self.measure is None:
            return values
        return values * _size(self.unit, self.measure)

    def impossible(self, values: Floats) -> Booleans:
        """Return a mask of impossible values."""
        numbers = self.in_si(values)
        return self.part.impossible(numbers) if self.part else wrong_numbers(self.quantity, numbers)


def _size(unit: str, measure: Measure | Literal["power"]) -> float:
    if measure == "power":
        return quantity(f"1 {unit}", measure) * 1000
    return measured(f"1 {unit}", measure, units=[UNIT_OF[measure]])


def case_path(text: str, case: Transmission) -> CasePath | None:
    """Return the number at a path, optionally with a unit as in `[rpm]`.

    Return None for other texts.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()], link_names=["in", "out"])
    >>> case_path("load.speed [rpm]", case).name, case_path("gears.*.torques.out", case).quantity
    ('load.speed [rpm]', 'torques')
    """
    numbers, parts = case.derived(numbers_of), case.derived(part_numbers)
    path, unit = text, None
    if text not in numbers and text not in parts:  # names in the path can be quoted
        path, unit = with_unit(text)
        path = plain(path.strip())
    of, part = numbers.get(path, ()), parts.get(path)
    relative = numbers.get(f"{path}.relative", ())
    return CasePath(path, of, None if of else part, unit or "", relative) if of or part else None


def known_paths(case: Transmission) -> list[str]:
    """Return all paths of a case."""
    return [*case.derived(numbers_of), *case.derived(part_numbers)]


def no_path(text: str, case: Transmission) -> str:
    """Return a message about a path without a number; "" if the text can be another name.

    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()])
    >>> no_path("load", case), no_path("D1.rat", case)
    ('', '')
    >>> print(no_path("load.sped", case).replace("; ", "\\n"))
    there is no number `load.sped`, expected `load.` and one of speed, torque
    did you mean `load.speed`?
    >>> print(no_path("load.power", case).partition("; ")[2])
    a power is varied by its torque, --with 'load.torque [N*m]=...'
    """
    parts = plain_keys(text)
    paths = known_paths(case)
    if len(parts) > 1 and parts[0] in _FIXED and parts[0] not in {*case.link_names, *case.devices}:
        message = f"numbers of {quoted(parts[0])} cannot vary in a sweep of a case, because they do"
        return f"{message} not affect a table of gears: expected a number such as `load.speed`"
    known = [*map(plain_keys, paths)]
    depth = max(n for n in range(len(parts) + 1) if any(keys[:n] == parts[:n] for keys in known))
    if len(parts) == 1 or (len(parts) == 2 and parts[0] not in OWNERS and depth < 2):
        return ""
    message = f"there is no number {quoted(text)}"
    if not depth:
        return message + nearest(text, paths)
    before = dotted(parts[:depth])
    longer = [keys for keys in known if keys[:depth] == parts[:depth] and len(keys) > depth]
    if not longer:
        return f"{message}, expected `{before}`"
    behind = [*dict.fromkeys(keys[depth] for keys in longer)]
    message += f", expected `{before}.` and one of {listed(behind)}"
    if depth == len(parts):
        return message
    hint = nearest(f"{before}.{parts[depth]}", [f"{before}.{key}" for key in behind])
    if parts[depth] == "power":
        hint = f"; a power is varied by its torque, --with '{before}.torque [N*m]=...'"
    return message + hint


def own_number_at(path: CasePath, case: Transmission) -> float:
    """Return the number at a path in a case, in rpm, N*m or kW; of a component in SI units.

    Raises
    ------
    ValueError
        If the case has no number or several numbers at the path.

    Examples
    --------
    >>> from vstatics import Gear, Load, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()], load=Load(1000, 50))
    >>> own_number_at(CasePath("load.speed", numbers_of(case)["load.speed"]), case)
    1000
    """
    values = (_number_in_case(case, number) for number in path.of)
    numbers = {own_part_number(case, path.part)} if path.part else {*values}
    if len(numbers) > 1:
        raise ValueError(f"{quoted(path.path)} differs from gear to gear or mesh to mesh")
    [number] = numbers
    if isinstance(number, OfLoad):
        return number.given
    if number is None or isinstance(number, Law | SpeedOf):
        raise ValueError(f"the case has no number at {quoted(path.path)}, and it is not varied")
    if number and not path.part and path.quantity in _RELATIVE:
        raise ValueError(f"{quoted(path.path)} is relative to the load, so it has no unit here")
    return number


def _number_in_case(case: Transmission, number: CaseNumber) -> Any:
    index, quantity, owner = number
    gear = case.gears[index or 0]
    match quantity:
        case "load.speed" | "load.torque":
            load = case.load if index is None else gear.load
            follows = load is not None and load.power is not None and quantity == "load.torque"
            return None if follows else getattr(load, quantity.removeprefix("load."), None)
        case "battery":
            return gear.balance and gear.balance.battery
        case "speed_ratios":
            ratio = case.gear_ratios(gear)[case.own_mechanisms.start + owner - 1]
            return None if math.isnan(ratio) else ratio
        case "speeds" | "slip" | "torques":
            return getattr(gear, quantity).get(owner)
        case "drag" | "open_drag":
            by_part = case.gear_drag if quantity == "drag" else case.gear_open_drag
            return by_part(gear).get(owner, 0.0)
    return getattr(case.mechanisms[owner], quantity)
