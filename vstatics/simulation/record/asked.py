"""Columns of a run that a user can request in addition to speeds, slips and torques."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from operator import attrgetter
from typing import NamedTuple, TypeAlias

import numpy as np

from vstatics.core.errors import CaseError, listed, quoted
from vstatics.core.model.converters import Converter
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.result_arrays import Message
from vstatics.core.suggestions import nearest
from vstatics.simulation.record.account import heat_and_losses
from vstatics.simulation.record.converters import efficiencies, speed_ratios, turning
from vstatics.simulation.record.moments import Moments
from vstatics.simulation.record.row_names import Kind, friction_areas, roads_of, rows_of_kind
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.scenario.rolling_radius import LoadedWheel
from vstatics.simulation.system.values import outside_torques

Maker: TypeAlias = Callable[[Moments, Sequence[str]], Floats]


def _powers(at: Moments, rows: Sequence[str]) -> Floats:
    """Return the powers of external torques by link, and of springs [W]."""
    system = at.system
    of_links = outside_torques(at.equations) @ at.ports * at.speeds
    powers = {
        spring.name: at.torques[spring.device] * (spring.row @ at.speeds)
        for spring in system.springs
    }
    powers |= zip(system.names, of_links, strict=True)
    return np.array([powers[name] for name in rows])


def _of_links(values: Callable[[Moments], Floats], at: Moments, rows: Sequence[str]) -> Floats:
    return values(at)[[at.system.names.index(name) for name in rows]]


def _of_vehicles(values: Callable[[Moments], Floats], at: Moments, rows: Sequence[str]) -> Floats:
    roads = roads_of(at.system.scenario)
    columns = []
    for name, column in zip(rows, _of_links(values, at, rows), strict=True):
        road = roads[at.system.names.index(name) + 1]
        if road.wheel:
            columns.append(_on_loaded_wheel(road.wheel, values, at, name))
        else:
            columns.append(road.radius * column)
    return np.array(columns)


def _on_loaded_wheel(
    wheel: LoadedWheel, values: Callable[[Moments], Floats], at: Moments, name: str
) -> Floats:
    """Return speed, acceleration or jerk of a vehicle with a torque-dependent rolling radius."""
    [turning] = _of_links(attrgetter("speeds"), at, [name])
    velocity = wheel.velocity(turning)
    if values not in (Moments.accelerations, Moments.jerks):
        return velocity
    first, second = wheel.turning_slopes(velocity)
    acceleration: Floats = _of_links(Moments.accelerations, at, [name])[0] / first
    if values is Moments.accelerations:
        return acceleration
    jerk: Floats = (_of_links(Moments.jerks, at, [name])[0] - second * acceleration**2) / first
    return jerk


def _heat(at: Moments, rows: Sequence[str]) -> Floats:
    heat, _ = heat_and_losses(at.equations, at.states)
    return np.array([heat.get(name, np.zeros(len(at.times))) for name in rows])


def _slip_power(at: Moments, rows: Sequence[str]) -> Floats:
    names = [element.name for element in at.system.case.shift_elements]
    places = [names.index(name) for name in rows]
    return at.torques[places] * at.slips[places]


def _per_area(values: Maker, at: Moments, rows: Sequence[str]) -> Floats:
    areas = friction_areas(at.system.case)
    per_area: Floats = values(at, rows) / np.array([[areas.get(name, np.nan)] for name in rows])
    return per_area


def _speed_ratios(at: Moments, rows: Sequence[str]) -> Floats:
    return speed_ratios(_converters(at, rows), at.speeds)


def _efficiencies(at: Moments, rows: Sequence[str]) -> Floats:
    converters, count = _converters(at, rows), len(at.system.case.devices)
    torques = at.torques[
        [count + at.system.converters.index(converter) for converter in converters]
    ]
    power = torques * at.speeds[[converter.pump - 1 for converter in converters]]
    return efficiencies(converters, speed_ratios(converters, at.speeds), power)


def _converters(at: Moments, rows: Sequence[str]) -> list[Converter]:
    by_name = {converter.name: converter for converter in at.system.converters}
    return [by_name[name] for name in rows]


def _reduced_inertia(at: Moments, _: Sequence[str]) -> Floats:
    """Return the inertia ``sum J (w/w_input)^2`` of all bodies except the output [kg*m^2].

    The shape is (1, times). The formula is Tarasik's equation (3).
    """
    system, case = at.system, at.system.case
    output = np.arange(len(system.names)) == case.main_output - 1
    others = (system.heavy != output).any(axis=1)
    doubled: Floats = system.inertias[others] @ (system.heavy[others] @ at.speeds) ** 2
    return doubled / turning(at.speeds[[case.input - 1]], at.speeds) ** 2


def _values(word: str, at: Moments, rows: Sequence[str]) -> Floats:
    equations = at.equations
    places = [equations.layout.values.index(Seen(word, name)) for name in rows]
    return at.states[equations.values][places]


class AskedTable(NamedTuple):
    """Additional table: kind of its rows, unit, and function that calculates its values."""

    kind: Kind
    unit: str
    """Unit of the values; empty for dimensionless numbers and for control states."""
    make: Maker


TABLES: Mapping[str, AskedTable] = {
    "accelerations": AskedTable("link", "rad/s^2", partial(_of_links, Moments.accelerations)),
    "jerks": AskedTable("link", "rad/s^3", partial(_of_links, Moments.jerks)),
    "powers": AskedTable("link or spring", "W", _powers),
    "heat": AskedTable("friction", "J", _heat),
    "slip_power": AskedTable("shift element", "W", _slip_power),
    "heat_per_area": AskedTable("shift element", "J/m^2", partial(_per_area, _heat)),
    "slip_power_per_area": AskedTable("shift element", "W/m^2", partial(_per_area, _slip_power)),
    "temperatures": AskedTable(
        "element with a heat_capacity", "degree_Celsius", partial(_values, "temperature")
    ),
    "states": AskedTable("state", "", partial(_values, "value")),
    "vehicle_speed": AskedTable(
        "link with a road", "m/s", partial(_of_vehicles, attrgetter("speeds"))
    ),
    "vehicle_acceleration": AskedTable(
        "link with a road", "m/s^2", partial(_of_vehicles, Moments.accelerations)
    ),
    "vehicle_jerk": AskedTable("link with a road", "m/s^3", partial(_of_vehicles, Moments.jerks)),
    "ratio": AskedTable("converter", "", _speed_ratios),
    "efficiency": AskedTable("converter", "", _efficiencies),
    "reduced_inertia": AskedTable("number", "kg*m^2", _reduced_inertia),
}
"""Tables that can be requested in addition, by name."""
PER_AREA = "_per_area"
"""Suffix of tables of energy or power divided by the friction area."""
MOST_EMPTY = 12
"""Largest number of empty columns that a warning names; it only counts the others."""
ALWAYS = ("speeds", "slips", "torques")
"""Tables of every run."""


def rows_of_tables(
    asked: Sequence[tuple[str, str]], scenario: Scenario
) -> Mapping[str, tuple[str, ...]]:
    """Return the requested rows of each table, in the order of `TABLES`, without repetition.

    Raises
    ------
    CaseError
        If a table or a row does not exist.
    """
    for table, row in asked:
        known: Sequence[str] = tuple(TABLES)
        what, read = "table", table
        if table in TABLES:
            kind = TABLES[table].kind
            rows = ("",) if kind == "number" else rows_of_kind(kind, scenario)
            known, what, read = rows, kind, row
        if read not in known:
            expected = f", expected one of {listed(known)}" if known else ""
            hint = nearest(read, known) or expected
            raise CaseError("E679", f"a run has no {what} {quoted(read)}{hint}")
    rows_by_table = {
        name: tuple(dict.fromkeys(row for table, row in asked if table == name)) for name in TABLES
    }
    return {name: rows for name, rows in rows_by_table.items() if rows}


def empty_columns(asked: Mapping[str, Mapping[str, Floats]]) -> list[Message]:
    """Return a warning about columns that contain only NaN, if any.

    Examples
    --------
    >>> asked = {"ratio": {"TC": np.array([0.0, 0.5])}, "heat_per_area": {"F1": np.array([np.nan])}}
    >>> [message.text for message in empty_columns(asked)]
    ['column heat_per_area[F1] has no value; give an `area` in `friction` of the shift element']
    """
    empty = [
        (table, f"{table}[{row}]" if row else table)
        for table, rows in asked.items()
        for row, values in rows.items()
        if len(values) and np.isnan(values).all()
    ]
    if not empty:
        return []
    names = listed([name for _, name in empty], MOST_EMPTY)
    text = f"columns {names} have no value" if empty[1:] else f"column {names} has no value"
    if all(table.endswith(PER_AREA) for table, _ in empty):
        text += "; give an `area` in `friction` of the shift element"
    return [Message("W896", text)]
