"""Numbers in rad/s and N*m beside a load that varies -> relative numbers -> `Results`.

Points go alike where no load changes its sign, nor any number to or from 0: these have the
same equations, the same directions of drag, and a case that stands for all of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, get_args

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.parts import KW_OF_RPM_NM, Load, OfLoad
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.statics import matrix
from vstatics.core.statics.points.paths import CaseNumber, Columns, OfLoads
from vstatics.core.statics.result_arrays import OperatingPoints
from vstatics.core.statics.results import Results
from vstatics.core.statics.variants import (
    OF_GEAR,
    OF_MECHANISMS,
    GearNumber,
    GearNumbers,
    OfGear,
    solve_variants,
)

RPM = 30 / math.pi
"""1 rad/s."""


class GearLoad(NamedTuple):
    """The load of a gear at some points, of shape (points,); None where it is not told."""

    speed: Floats | None
    """[rad/s]"""
    torque: Floats | None
    """With the sign that `coast` gives it. [N*m]"""
    coast: bool | None = None

    def turned(self) -> GearLoad:
        """The same with the torque as `coast` turns it."""
        if self.coast is None or self.torque is None:
            return self
        return self._replace(torque=np.abs(self.torque) * self._way)

    @property
    def _way(self) -> Floats:
        """The sign of a torque along the speed, or against it if it coasts."""
        way: Floats = np.sign(np.ones(1) if self.speed is None else self.speed)
        return -way if self.coast else way

    @property
    def torque_unit(self) -> Floats | None:
        """What torques are related to [N*m], as `Transmission.torque_unit`."""
        return None if self.torque is None else np.where(self.torque == 0, self._way, self.torque)

    def unit_of(self, quantity: OfGear) -> Floats | None:
        """What a given speed, torque or drag is related to [rad/s, N*m]."""
        if quantity == "speeds":
            return self.speed
        if quantity == "speed_ratios":
            return np.ones(1)
        unit = self.torque_unit
        return unit if unit is None or quantity == "torques" else np.abs(unit)


def solve_points(case: Transmission, columns: Columns, variants: int) -> Results:
    """Results of all points.

    Raises
    ------
    CaseError
        If a number needs a load, or the numbers make no case.
    """
    loads = loads_of(case, columns, variants)
    _expect_loads(case, columns, loads)
    found: dict[str, Any] = {}
    told = _Told(case, loads, variants)
    groups = list(alike(columns, loads, variants))
    for chosen in groups:
        part = {number: column[chosen] for number, column in columns.items()}
        own = loads_of(case, part, chosen.size)
        one = with_numbers(case, part)
        by_gear = [_relative(one, n, part, own[n]) for n in range(len(case.gears))]
        arrays = solve_variants(one, None, None, chosen.size, by_gear)
        told.take(one, chosen, by_gear, own)
        if len(groups) == 1:
            found = arrays
            break
        for name, array in arrays.items():
            if name not in found:
                found[name] = np.empty((variants, *array.shape[1:]), array.dtype)
            found[name][chosen] = array
    return Results(case=case, **found, points=told.points)


def loads_of(case: Transmission, columns: Columns, variants: int) -> list[GearLoad]:
    """The load of each gear: its own, filled up with that of the case."""

    def load(index: int, gear: Gear) -> GearLoad:
        """The last of them counts; the torque of a power follows a later speed."""
        speed: Floats | None = None
        torque: Floats | None = None
        power: float | None = None
        for place, own in ((None, case.load), (index, gear.load)):
            told = own or Load()
            numbers = _filled(told.speed, RPM, variants), _filled(told.torque, 1, variants)
            columns_here = [columns.get(CaseNumber(place, one)) for one in get_args(OfLoads)]
            for (new_speed, new_torque), new_power in (numbers, told.power), (columns_here, None):
                if new_torque is not None:
                    torque, power = new_torque, new_power
                elif new_speed is not None and power is not None:
                    with np.errstate(divide="ignore"):
                        torque = power / KW_OF_RPM_NM / (new_speed * RPM)
                speed = speed if new_speed is None else new_speed
        return GearLoad(speed, torque, case.gear_coast(gear)).turned()

    return [load(index, gear) for index, gear in enumerate(case.gears)]


def _filled(number: float | None, by: float, variants: int) -> Floats | None:
    return None if number is None else np.full(variants, number / by)


def _expect_loads(case: Transmission, columns: Columns, loads: Sequence[GearLoad]) -> None:
    """Raise the first number that is related to a load that is not told."""
    for index, quantity, owner in columns:
        if index is None or quantity not in OF_GEAR:
            continue
        if loads[index].unit_of(quantity) is None:
            half = "speed" if quantity == "speeds" else "torque"
            elements = quantity == "open_drag"
            name = case.shift_elements[owner - 1].name if elements else case.link_name(owner)
            where = f"gears.{case.gears[index].name}.{quantity}.{name}"
            message = f"{where} varies in SI, expected a load with a {half}"
            raise CaseError([Problem("E423", message, ("vary",))])


def alike(columns: Columns, loads: Sequence[GearLoad], variants: int) -> Iterator[Integers]:
    """The points in groups that go alike, by their places."""
    code = np.zeros(variants, dtype=np.int64)
    seen = {id(half): half for load in loads for half in load[:2] if half is not None}
    kinds = [np.sign(half).astype(np.int64) for half in seen.values()]
    for number, column in columns.items():
        if number.quantity in (*OF_GEAR, "back_efficiency"):
            kinds.append((column == 0).astype(np.int64))
    for kind in kinds:
        if variants and not (kind == kind[0]).all():
            _, code = np.unique(code * 3 + kind + 1, return_inverse=True)
    order = np.argsort(code, kind="stable")
    ends = np.flatnonzero(np.diff(code[order])) + 1
    yield from np.split(order, ends)


def with_numbers(case: Transmission, columns: Columns) -> Transmission:
    """The case of the first point, checked as any other."""

    def load(index: int | None, own: Load | None) -> Load | None:
        speed = columns.get(CaseNumber(index, "load.speed"))
        torque = columns.get(CaseNumber(index, "load.torque"))
        if speed is None and torque is None:
            return own
        told = Load(
            None if speed is None else float(speed[0]) * RPM,
            None if torque is None else float(torque[0]),
        )
        return told.or_else(own or Load())

    gears = [gear._replace(load=load(n, gear.load)) for n, gear in enumerate(case.gears)]
    for (index, quantity, owner), column in columns.items():
        if index is not None and quantity in OF_GEAR:
            given = float(column[0]) * (RPM if quantity == "speeds" else 1.0)
            number = given if quantity == "speed_ratios" else OfLoad(given, 1.0)
            numbers: Any = {**getattr(gears[index], quantity), owner: number}
            gears[index] = gears[index]._replace(**{quantity: numbers})
    return case.replace(load=load(None, case.load), gears=gears)


def _relative(case: Transmission, index: int, columns: Columns, load: GearLoad) -> GearNumbers:
    """What varies in a gear, relative to its load; what has a unit varies with the load."""
    found: dict[GearNumber, Floats] = {}
    gear = case.gears[index]
    for quantity in OF_GEAR:
        unit = load.unit_of(quantity)
        for owner, number in _given(case, gear, quantity).items():
            column = columns.get(CaseNumber(index, quantity, owner))
            if column is None and isinstance(number, OfLoad) and unit is not None:
                given = number.given / (RPM if quantity == "speeds" else 1.0)
                column = np.full(unit.shape, given)
            if column is not None and unit is not None:
                found[GearNumber(quantity, owner)] = column / unit
    for (place, of_mechanism, owner), column in columns.items():
        if place == index and of_mechanism in OF_MECHANISMS:
            found[GearNumber(of_mechanism, owner)] = column
    return found


def _given(case: Transmission, gear: Gear, quantity: OfGear) -> dict[int, Any]:
    """The numbers of a gear, with the drag that it has from the case and shift elements."""
    if quantity == "drag":
        return case.gear_drag(gear)
    return case.gear_open_drag(gear) if quantity == "open_drag" else dict(getattr(gear, quantity))


class _Told:
    """What results in units need of the points, group by group."""

    def __init__(self, case: Transmission, loads: Sequence[GearLoad], variants: int) -> None:
        shape = variants, len(case.gears)
        self.rpm, self.torque = np.full(shape, np.nan), np.full(shape, np.nan)
        self.loaded = np.ones(shape, np.bool_)
        self.torques: list[dict[int, Any]] = [{} for _ in case.gears]
        self.outside: dict[str, Any] = {}
        self.gears: list[Gear] = list(case.gears)
        self.variants = variants
        for n, load in enumerate(loads):
            if load.speed is not None:
                self.rpm[:, n] = load.speed * RPM
            if load.torque is not None:
                self.loaded[:, n] = load.torque != 0

    def take(
        self,
        case: Transmission,
        chosen: Integers,
        by_gear: Sequence[GearNumbers],
        loads: Sequence[GearLoad],
    ) -> None:
        """A group of points, for which a case stands."""
        for n, gear in enumerate(case.gears):
            unit = loads[n].torque_unit
            if unit is not None:
                self.torque[chosen, n] = unit
            self.gears[n] = gear
            for link, torque in gear.torques.items():
                varied = by_gear[n].get(GearNumber("torques", link))
                array = self.torques[n].setdefault(link, np.zeros(self.variants))
                fixed = matrix.given_torque(case, gear, torque)
                array[chosen] = fixed if varied is None else varied
            self._take_converters(case, chosen, n, by_gear[n])

    def _take_converters(
        self, case: Transmission, chosen: Integers, index: int, numbers: GearNumbers
    ) -> None:
        """Where converters are asked outside their points."""
        given, ratios = case.own_mechanisms, case.gear_ratios(case.gears[index])
        bypassed = case.bypassed(case.gears[index])
        for owner, (one, own) in enumerate(
            zip(case.mechanisms[given], ratios[given], strict=True), 1
        ):
            ratio = numbers.get(GearNumber("speed_ratios", owner), own)
            if given.start + owner - 1 in bypassed:
                continue
            if one.kind == "converter" and np.any(wrong := one.is_outside(ratio)):
                nowhere = np.zeros_like(self.loaded)
                self.outside.setdefault(one.name, nowhere)[chosen, index] = wrong

    @property
    def points(self) -> OperatingPoints:
        """All of it."""
        scales = {"rpm": self.rpm, "Nm": self.torque, "kW": self.rpm * self.torque * KW_OF_RPM_NM}
        both = zip(self.gears, self.torques, strict=True)
        gears: list[Any] = [gear._replace(torques=torques) for gear, torques in both]
        return OperatingPoints(scales, self.loaded, gears, outside=self.outside)
