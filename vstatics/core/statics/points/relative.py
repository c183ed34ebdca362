"""Calculation of points with numbers in SI units, relative to an operating point that varies.

Points are variants of a common case if their loads have equal signs and the same numbers are 0.
Their equations and the directions of drag are then equal.
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
from vstatics.core.statics.points.paths import RELATIVE_TO_SPEED, CaseNumber, Columns, OfLoads
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
"""Conversion factor: 1 rad/s in rpm."""


class GearLoad(NamedTuple):
    """Operating points of a gear: arrays of shape (points,), None if unknown."""

    speed: Floats | None
    """Input speed. [rad/s]"""
    torque: Floats | None
    """Input torque; after `turned` with the sign that `coast` requires. [N*m]"""
    coast: bool | None = None

    def turned(self) -> GearLoad:
        """Return the operating points with the sign of the torque required by `coast`."""
        if self.coast is None or self.torque is None:
            return self
        return self._replace(torque=np.abs(self.torque) * self._sign)

    @property
    def _sign(self) -> Floats:
        """Sign of the torque: the sign of the speed, or the opposite when coasting."""
        way: Floats = np.sign(np.ones(1) if self.speed is None else self.speed)
        return -way if self.coast else way

    @property
    def torque_unit(self) -> Floats | None:
        """Torque to which torques are relative, as in `Transmission.torque_unit` [N*m]."""
        return None if self.torque is None else np.where(self.torque == 0, self._sign, self.torque)

    def unit_of(self, quantity: OfGear) -> Floats | None:
        """Return the unit of a relative quantity, shape (points,); None if the load is unknown.

        Speeds are relative to the input speed [rad/s]. External torques and torques on pumps are
        relative to the input torque, all other torques to its magnitude [N*m]. Speed ratios have
        the unit 1.
        """
        if quantity in RELATIVE_TO_SPEED:
            return self.speed
        if quantity == "speed_ratios":
            return np.ones(1)
        unit = self.torque_unit
        return unit if unit is None or quantity in ("torques", "pump_torques") else np.abs(unit)


def solve_points(case: Transmission, columns: Columns, variants: int) -> Results:
    """Calculate the results of all points.

    Raises
    ------
    CaseError
        If a number in SI units needs a missing operating point, or the case of a group of points is
        not valid.
    """
    loads = loads_of(case, columns, variants)
    _expect_loads(case, columns, loads)
    whole: dict[str, Any] = {}
    collected = _PointData(case, loads, variants)
    groups = list(alike(columns, loads, variants))
    for chosen in groups:
        part = {number: column[chosen] for number, column in columns.items()}
        part_loads = loads_of(case, part, chosen.size)
        part_case = with_numbers(case, part)
        by_gear = [_relative(part_case, n, part, part_loads[n]) for n in range(len(case.gears))]
        arrays = solve_variants(part_case, None, None, chosen.size, by_gear)
        collected.take(part_case, chosen, by_gear, part_loads)
        if len(groups) == 1:
            whole = arrays
            break
        for name, array in arrays.items():
            if name not in whole:
                whole[name] = np.empty((variants, *array.shape[1:]), array.dtype)
            whole[name][chosen] = array
    return Results(case=case, **whole, points=collected.points)


def loads_of(case: Transmission, columns: Columns, variants: int) -> list[GearLoad]:
    """Return the operating points of each gear. The case supplies values that a gear omits."""

    def load(index: int, gear: Gear) -> GearLoad:
        """Return the load of a gear; values of the case are defaults.

        A prescribed power stays constant.
        """
        speed: Floats | None = None
        torque: Floats | None = None
        power: float | None = None
        for place, given_load in ((None, case.load), (index, gear.load)):
            known = given_load or Load()
            numbers = _filled(known.speed, RPM, variants), _filled(known.torque, 1, variants)
            columns_here = [
                columns.get(CaseNumber(place, quantity)) for quantity in get_args(OfLoads)
            ]
            for (new_speed, new_torque), new_power in (numbers, known.power), (columns_here, None):
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
    """Raise CaseError for a number that is relative to a missing operating point."""
    for index, quantity, owner in columns:
        if index is None or quantity not in OF_GEAR:
            continue
        if loads[index].unit_of(quantity) is None:
            half = "speed" if quantity in RELATIVE_TO_SPEED else "torque"
            elements = quantity in ("open_drag", "slip")
            name = case.shift_elements[owner - 1].name if elements else case.link_name(owner)
            where = f"gears.{case.gears[index].name}.{quantity}.{name}"
            message = f"{where} varies in SI, expected a load with a {half}"
            raise CaseError([Problem("E423", message, ("vary",))])


def alike(columns: Columns, loads: Sequence[GearLoad], variants: int) -> Iterator[Integers]:
    """Group points that a common case can represent, and yield the indices of each group."""
    code = np.zeros(variants, dtype=np.int64)
    seen = {id(half): half for load in loads for half in load[:2] if half is not None}
    kinds = [np.sign(half).astype(np.int64) for half in seen.values()]
    for number, column in columns.items():
        if number.quantity in (*OF_GEAR, "relative_slip", "back_efficiency"):
            kinds.append((column == 0).astype(np.int64))
    for kind in kinds:
        if variants and not (kind == kind[0]).all():
            _, code = np.unique(code * 3 + kind + 1, return_inverse=True)
    order = np.argsort(code, kind="stable")
    ends = np.flatnonzero(np.diff(code[order])) + 1
    yield from np.split(order, ends)


def with_numbers(case: Transmission, columns: Columns) -> Transmission:
    """Return a checked case with the numbers of the first point."""

    def load(index: int | None, given_load: Load | None) -> Load | None:
        speed = columns.get(CaseNumber(index, "load.speed"))
        torque = columns.get(CaseNumber(index, "load.torque"))
        if speed is None and torque is None:
            return given_load
        varied = Load(
            None if speed is None else float(speed[0]) * RPM,
            None if torque is None else float(torque[0]),
        )
        return varied.or_else(given_load or Load())

    gears = [gear._replace(load=load(n, gear.load)) for n, gear in enumerate(case.gears)]
    for (index, quantity, owner), column in columns.items():
        if index is not None and quantity in OF_GEAR:
            given = float(column[0]) * (RPM if quantity in RELATIVE_TO_SPEED else 1.0)
            number = given if quantity == "speed_ratios" else OfLoad(given, 1.0)
            numbers: Any = {**getattr(gears[index], quantity), owner: number}
            gears[index] = gears[index]._replace(**{quantity: numbers})
        elif index is not None and quantity == "relative_slip":
            slip = {**gears[index].slip, owner: float(column[0])}
            gears[index] = gears[index]._replace(slip=slip)
    return case.replace(load=load(None, case.load), gears=gears)


def _relative(case: Transmission, index: int, columns: Columns, load: GearLoad) -> GearNumbers:
    """Return the numbers of a gear that vary, relative to the input speed or torque.

    Constant numbers with a unit are included, because their relative values vary with the load.
    """
    numbers: dict[GearNumber, Floats] = {}
    gear = case.gears_with_drag[index]
    for quantity in OF_GEAR:
        unit = load.unit_of(quantity)
        for owner, number in getattr(gear, quantity).items():
            column = columns.get(CaseNumber(index, quantity, owner))
            if column is None and isinstance(number, OfLoad) and unit is not None:
                given = number.given / (RPM if quantity in RELATIVE_TO_SPEED else 1.0)
                column = np.full(unit.shape, given)
            if column is not None and unit is not None:
                numbers[GearNumber(quantity, owner)] = column / unit
    for (place, of_mechanism, owner), column in columns.items():
        if place == index and of_mechanism == "relative_slip":
            numbers[GearNumber("slip", owner)] = column
        elif place == index and of_mechanism in OF_MECHANISMS:
            numbers[GearNumber(of_mechanism, owner)] = column
    return numbers


class _PointData:
    """Data for results in rpm, N*m and kW, collected from groups of points."""

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
        """Store the data of the points with the indices `chosen`, which `case` represents."""
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
        given, ratios = case.own_mechanisms, case.gear_ratios(case.gears[index])
        unloaded = case.unloaded_converters(case.gears[index])
        for owner, (mechanism, fixed_ratio) in enumerate(
            zip(case.mechanisms[given], ratios[given], strict=True), 1
        ):
            ratio = numbers.get(GearNumber("speed_ratios", owner), fixed_ratio)
            if given.start + owner - 1 in unloaded:
                continue
            if mechanism.kind == "converter" and np.any(wrong := mechanism.is_outside(ratio)):
                nowhere = np.zeros_like(self.loaded)
                self.outside.setdefault(mechanism.name, nowhere)[chosen, index] = wrong

    @property
    def points(self) -> OperatingPoints:
        """Collected data of all points."""
        scales = {"rpm": self.rpm, "Nm": self.torque, "kW": self.rpm * self.torque * KW_OF_RPM_NM}
        both = zip(self.gears, self.torques, strict=True)
        gears: list[Any] = [gear._replace(torques=torques) for gear, torques in both]
        return OperatingPoints(scales, self.loaded, gears, outside=self.outside)
