"""Results shown for what a case draws: its own links and elements, planets apart.

The solver speaks of mechanisms, and of planets as links. Here its numbers are put
together again: torques for each member of an element, losses for each element, speeds
for each planet.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.elements.element import drawing_of
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.kinds import Planetary
from vstatics.elements.lower import Part, parts
from vstatics.model.transmission import HOUSING
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.statics.results import Results
from vstatics.tables.members import member_torques
from vstatics.tables.rows import OUTPUT

ROUNDING = 2.0**-48
"""Two speeds that agree to this part are the same."""


class Shown(NamedTuple):
    """A table in place of the solver's."""

    rows: Sequence[str]
    values: Floats
    """(gears, rows)"""


def shown(results: Results) -> dict[str, Shown]:
    """The tables that differ from the solver's own, by their quantities.

    Parameters
    ----------
    results : Results
        Of one case, which has a drawing.
    """
    case = results.case
    drawing = drawing_of(case)
    if drawing is None:
        return {}
    made = parts(drawing)
    names = case.link_names[: drawing.links]
    elements = [part.name for part in made]
    exists, idle = results.calculable[:, None], by_element(made, results.idle, all_of=True)
    tables = {
        "speeds": Shown(names, results.speeds[:, : drawing.links]),
        "planet_speeds": _planets(results, made),
        "torques": _torques(results, made, lossy=False),
        "lossy_torques": _torques(results, made, lossy=True),
        "idle": Shown(elements, np.where(exists, idle, np.nan)),
        "losses": Shown(elements, by_element(made, results.losses, all_of=False)),
        "holding_torques": Shown(names, results.holding_torques[:, : drawing.links]),
        "lossy_holding_torques": Shown(names, results.lossy_holding_torques[:, : drawing.links]),
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


def _torques(results: Results, made: Sequence[Part], *, lossy: bool) -> Shown:
    """Torques of shift elements, then those that links give to the members, then the output."""
    case = results.case
    torques = results.lossy_torques if lossy else results.torques
    rows = [element.name for element in case.shift_elements]
    columns = list(torques[:, : len(rows)].T)
    for part, members in zip(made, member_torques(results, made, lossy=lossy), strict=True):
        rows += [f"{part.name}.{member}" for member in members]
        columns += list(members.values())
    return Shown([*rows, OUTPUT], np.array([*columns, torques[:, -1]]).T + 0.0)


def by_element(made: Sequence[Part], values: Floats | Booleans, *, all_of: bool) -> Floats:
    """Values of mechanisms put together for each element: whether all, or the sum."""
    columns = []
    number = 0
    for part in made:
        own = values[:, number : number + len(part.lowered)]
        columns.append(own.all(axis=1) if all_of else own.sum(axis=1))
        number += len(part.lowered)
    return np.array(columns, dtype=np.float64).reshape(len(columns), len(values)).T
