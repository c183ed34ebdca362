"""Results shown for what a case draws: its own links and elements, planets apart.

The solver speaks of mechanisms, and of planets as links. Here its numbers are put
together again: torques for each member of an element, losses for each element, speeds
for each planet.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.arrays import Booleans, Floats
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.kinds import Planetary
from vstatics.elements.lower import Part, parts
from vstatics.model import HOUSING, Transmission
from vstatics.results import OUTPUT, Results

ROUNDING = 2.0**-48
"""Two speeds that agree to this part are the same."""


class Shown(NamedTuple):
    """A table in place of the solver's."""

    rows: Sequence[str]
    values: Floats
    """(gears, rows)"""


def shown(results: Results) -> dict[str, Shown]:
    """The tables that differ from the solver's own, by their names in `TABLES`.

    Parameters
    ----------
    results : Results
        Of one case, which has a drawing.
    """
    case = results.case
    drawing = case.drawing
    if drawing is None:
        return {}
    made = parts(drawing)
    names = case.link_names[: drawing.links]
    elements = [part.name for part in made]
    exists, idle = results.calculable[:, None], by_element(made, results.idle, all_of=True)
    tables = {
        "W": Shown(names, results.speeds[:, : drawing.links]),
        "WSAT": _planets(results, made),
        "AMLG": _torques(results, made, results.torques, ideal_ratios(case)),
        "AMLGP": _torques(results, made, results.lossy_torques, lossy_ratios(results)),
        "idle": Shown(elements, np.where(exists, idle, np.nan)),
        "losses": Shown(elements, by_element(made, results.losses, all_of=False)),
        "AMWZ": Shown(names, results.holding_torques[:, : drawing.links]),
        "AMWZP": Shown(names, results.lossy_holding_torques[:, : drawing.links]),
    }
    meshes = list(_meshes(made))
    if meshes:
        rows = [case.mechanisms[mesh.number].name for mesh in meshes]
        columns = len(case.shift_elements) + np.array([mesh.number for mesh in meshes])
        known = np.array([1.0 if mesh.is_known else np.nan for mesh in meshes])
        tables["mesh_torques"] = Shown(rows, known * results.torques[:, columns])
        tables["lossy_mesh_torques"] = Shown(rows, known * results.lossy_torques[:, columns])
    return tables


class _Mesh(NamedTuple):
    """A mechanism that is a mesh: its number, and whether the teeth of its first body are known."""

    number: int
    is_known: bool


def _meshes(made: Sequence[Part]) -> Iterator[_Mesh]:
    number = 0
    for part in made:
        for lowered in part.lowered:
            if part.element is not None and part.planet_links:
                first = lowered.members[0]
                group = group_of(part.element)
                yield _Mesh(number, first not in group.planets or group.is_known(first))
            number += 1


def _planets(results: Results, made: Sequence[Part]) -> Shown:
    """Speeds of all planets and idlers against their carriers."""
    rows: list[str] = []
    columns: list[Floats] = []
    number = 0
    for part in made:
        element = part.element
        if element is not None and isinstance(element.shape, Planetary):
            for name, column in _group_planets(results.speeds, group_of(element)):
                rows.append(f"{part.name}.{name}")
                columns.append(column)
        elif _has_planet(part):
            middle = element.shape.toothed[1] if element is not None else "planet"
            rows.append(f"{part.name}.{middle}")
            columns.append(results.planet_speeds[:, number])
        number += len(part.lowered)
    values = np.array(columns).T if columns else np.empty((len(results.case.gears), 0))
    return Shown(rows, values)


def _has_planet(part: Part) -> bool:
    """Whether an element of one mechanism turns a planet or an idler, as far as is told."""
    mechanism = part.lowered[0].mechanism
    own = part.element is None and mechanism.third != HOUSING
    return own or mechanism.planet_ratio is not None


def _group_planets(speeds: Floats, group: PlanetGroup) -> Iterator[tuple[str, Floats]]:
    """Speed of each planet of a group, from that of a wheel that meshes with its train."""
    with_housing = np.hstack([np.zeros((len(speeds), 1)), speeds])
    for train in group.trains:
        against = np.full(len(speeds), np.nan)
        for wheel in group.wheels_of(train):
            motion = _difference(with_housing[:, wheel.link], with_housing[:, group.carrier])
            motion /= float(group.relative(wheel, train))
            against = np.where(np.isnan(against), motion, against)
        for planet, speed in train.items():
            known = group.is_known(planet)
            yield planet, against * float(speed) + 0.0 if known else np.full(len(speeds), np.nan)


def _difference(one: Floats, other: Floats) -> Floats:
    """``one - other``, 0 where it is nothing but rounding."""
    difference = one - other
    noise = ROUNDING * (np.abs(one) + np.abs(other))
    return np.where(np.abs(difference) <= noise, 0.0, difference)


def ideal_ratios(case: Transmission) -> Floats:
    """Internal ratios, of shape (1, mechanisms)."""
    return np.array([[mechanism.ratio for mechanism in case.mechanisms]])


def lossy_ratios(results: Results) -> Floats:
    """Internal ratios with losses in each gear, of shape (gears, mechanisms)."""
    ratios = ideal_ratios(results.case)
    mechanisms = results.case.mechanisms
    given = [(one.efficiency, one.back_efficiency) for one in mechanisms]
    forward = np.array([one for one, _ in given])
    # a self-locking one never has power flow back
    back = 1 / np.array([(one if other is None else other) or np.nan for one, other in given])
    signs = results.power_sign
    factor = np.where(signs > 0, forward, np.where(signs < 0, back, 1.0))
    return np.where(np.isnan(signs), np.nan, ratios * factor)


def _torques(results: Results, made: Sequence[Part], torques: Floats, ratios: Floats) -> Shown:
    """Torques of shift elements, then those that links give to the members, then the output."""
    case = results.case
    elements = len(case.shift_elements)
    rows = [element.name for element in case.shift_elements]
    columns = list(torques[:, :elements].T)
    given = member_torques(made, torques[:, elements:-1], ratios)
    for part, members in zip(made, given, strict=True):
        rows += [f"{part.name}.{member}" for member in members]
        columns += list(members.values())
    return Shown([*rows, OUTPUT], np.array([*columns, torques[:, -1]]).T + 0.0)


def member_torques(
    made: Sequence[Part], torques: Floats, ratios: Floats
) -> Iterator[dict[str, Floats]]:
    """For each part, the torques that links give to its members, each of shape (gears,).

    Parameters
    ----------
    torques : ndarray, shape (gears, mechanisms)
        On the first link of each mechanism. [-]
    ratios : ndarray, shape (gears, mechanisms) or (1, mechanisms)
        Internal ratios, with losses if the torques are. [-]
    """
    number = 0
    for part in made:
        members = {member: np.zeros(len(torques)) for member in part.members}
        for lowered in part.lowered:
            torque, ratio = torques[:, number], ratios[:, number]
            given = (torque, -ratio * torque, (ratio - 1) * torque)
            for member, value in zip(lowered.members, given, strict=True):
                if member in members:
                    members[member] = members[member] + value
            number += 1
        yield members


def by_element(made: Sequence[Part], values: Floats | Booleans, *, all_of: bool) -> Floats:
    """Values of mechanisms put together for each element: whether all, or the sum."""
    columns = []
    number = 0
    for part in made:
        own = values[:, number : number + len(part.lowered)]
        columns.append(own.all(axis=1) if all_of else own.sum(axis=1))
        number += len(part.lowered)
    return np.array(columns, dtype=np.float64).reshape(len(columns), len(values)).T
