"""What a case gives for vibration as tables: inertias, springs, what is elastic of devices."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.model.parts import Mechanism, ShiftElement, damping
from vstatics.model.springs import Spring, ends
from vstatics.model.transmission import Transmission
from vstatics.tables.grid import NOTHING, Cell, Column, Grid, text

Elastic = Spring | Mechanism | ShiftElement


def torsion_grids(case: Transmission) -> Iterator[Grid]:
    """The inertias of links, and the springs, if there are any.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Spring, Transmission
    >>> case = Transmission(
    ...     3, [], [Mechanism(1, 2, 0, -2.5)], [Gear()], inertias={1: 0.15},
    ...     springs=[Spring({2: 1, 3: -1}, stiffness=9e4), Spring({1: 2, 3: -4}, compliance=84e-5)],
    ... )
    >>> inertias, springs = torsion_grids(case)
    >>> inertias.texts, springs.texts[1]
    ([['1', '0.15']], ['S2', '2 1 - 4 3', '1190.48', '0.00084'])
    """
    if case.inertias:
        columns = [text("link"), Column("inertia, kg*m^2")]
        of_links = [
            [Cell(case.link_name(link)), _number(one)] for link, one in case.inertias.items()
        ]
        yield Grid("Inertias", columns, of_links)
    if case.springs:
        columns = [text("spring"), text("twist")]
        columns += [Column("stiffness, N*m/rad"), Column("compliance, rad/(N*m)")]
        more = damping_columns(case.springs)
        limits = [one.limit for one in case.springs]
        if any(limits):
            more[Column("limit, N*m")] = list(map(_number, limits))
        made: list[list[Cell]] = [
            [Cell(one.name), Cell(twist_text(case, one)), _number(one.rate), _number(1 / one.rate)]
            for one in case.springs
        ]
        damped = zip(*more.values(), strict=True) if more else [()] * len(made)
        rows = [[*row, *cells] for row, cells in zip(made, damped, strict=True)]
        yield Grid("Springs", [*columns, *more], rows)


def elastic_columns(parts: Sequence[Mechanism | ShiftElement]) -> dict[Column, list[Cell]]:
    """Stiffness and damping of devices, by part; nothing where all are rigid."""
    if all(part.stiffness is None for part in parts):
        return {}
    rates = [_number(part.stiffness) for part in parts]
    return {Column("stiffness, N*m/rad"): rates, **damping_columns(parts)}


def damping_columns(parts: Sequence[Elastic]) -> dict[Column, list[Cell]]:
    """Viscous dampings and loss factors, by part, of which there are any."""
    given = [damping(part.damping) for part in parts]
    numbers = {
        Column("damping, N*m*s/rad"): [one.viscous for one in given],
        Column("loss factor"): [one.loss_factor for one in given],
    }
    return {
        column: [_number(value or None) for value in values]
        for column, values in numbers.items()
        if any(values)
    }


def twist_text(case: Transmission, spring: Spring) -> str:
    """The twist of a spring as a sum: ``engine - disc``; of one link alone its name."""
    shaft = ends(spring.twist)
    said = ""
    for link, part in spring.form.items():
        size = "" if shaft or abs(part) == 1 else f"{abs(part):.6g} "
        sign = ("-" if part < 0 else "+") if said else "-" * (part < 0)
        said += f"{f' {sign} ' if said else sign}{size}{case.link_name(link)}"
    return said


def _number(value: float | None) -> Cell:
    """A number of any size."""
    return Cell(NOTHING if value is None else f"{value:.6g}", value, kind=float)
