"""The input of a case as tables: what it is made of, and its gears.

What a case gives for vibration as tables: inertias, springs, what is elastic of devices.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from vstatics.elements.drawing import Drawing, drawing_of
from vstatics.model.parts import Mechanism, ShiftElement, damping
from vstatics.model.springs import Spring, ends
from vstatics.model.transmission import HOUSING, Transmission
from vstatics.tables.grid import NOTHING, Cell, Column, Grid, exact, grid_of, text
from vstatics.tables.html import Markup, tables, terms

_NAMED = (
    *("name", "description", "source", "shift_elements", "elements", "mechanisms", "gears"),
    *("inertias", "springs"),
)
"""What has a place of its own on the page."""
_LABELS = {"idle": "sign of idle mechanisms", "coast": "coasting"}


def given(
    case: Transmission, mapping: Mapping[str, Any], digits: int | None = None
) -> Iterator[Markup]:
    """The input; `mapping` is the case as plain data: ``case`` of its result in JSON."""
    common = {key: value for key, value in mapping.items() if key not in _NAMED}
    common = {"input": case.link_name(case.input), "output": case.link_name(case.output), **common}
    labels = {key: _LABELS.get(key, key.replace("_", " ")) for key in common}
    yield terms((labels[key], _said(one)) for key, one in common.items())
    yield from tables(_grids(case, mapping, digits))


def _grids(case: Transmission, mapping: Mapping[str, Any], digits: int | None) -> Iterator[Grid]:
    """What the case is made of, and what its gears are given besides."""
    drawing = drawing_of(case)
    if drawing is not None and drawing.elements:
        yield _elements(drawing, mapping["elements"])
    if case.mechanisms:
        yield _mechanisms(case).with_digits(digits)
    if case.shift_elements:
        yield _shift_elements(case).with_digits(digits)
    yield from torsion_grids(case)
    besides = _gears(mapping["gears"])
    if besides.rows:
        yield besides


def _elements(drawing: Drawing, mapping: Mapping[str, Mapping[str, Any]]) -> Grid:
    rows = []
    for element in drawing.elements:
        data = dict(mapping[element.name])
        kind = str(data.pop("kind")).replace("_", " ")
        links = {member: data.pop(member) for member in element.members}
        rows.append((element.name, kind, _said(links), _said(data)))
    return grid_of("Elements", ["element", "kind", "links", "teeth and the rest"], rows)


def _mechanisms(case: Transmission) -> Grid:
    """Three-link mechanisms, with the links of planets where elements became these."""
    mechanisms = case.mechanisms
    more = {
        "efficiency backward": [one.back_efficiency for one in mechanisms],
        "planet ratio": [one.planet_ratio for one in mechanisms],
    }
    more = {heading: values for heading, values in more.items() if {*values} != {None}}
    columns = [text("mechanism"), text("first"), text("second"), text("third")]
    columns += [Column(heading) for heading in ("ratio", "efficiency", *more)]
    elastic = elastic_columns(mechanisms)
    columns += elastic
    rows = [
        [
            Cell(one.name),
            *(Cell(case.link_name(link)) for link in (one.first, one.second)),
            Cell(case.link_name(one.third) if one.third else "-"),
            *(exact(value, 4) for value in (one.ratio, one.efficiency)),
            *(exact(values[place], 4) for values in more.values()),
            *(cells[place] for cells in elastic.values()),
        ]
        for place, one in enumerate(mechanisms)
    ]
    drawing = drawing_of(case)
    drawn = drawing is not None and bool(drawing.elements)
    return Grid("Mechanisms, as they are calculated" if drawn else "Mechanisms", columns, rows)


def _shift_elements(case: Transmission) -> Grid:
    elements = case.shift_elements
    columns = [text("shift element"), text("kind"), text("first"), text("second")]
    drag = any(one.drag for one in elements)
    capacity = any(one.capacity is not None for one in elements)
    columns += [Column("drag, by the input torque")] * drag
    columns += [Column("capacity, by the input torque")] * capacity
    further = {**_friction(elements), **elastic_columns(elements)}
    columns += further
    rows = [
        [
            Cell(one.name),
            Cell((one.kind or ("brake" if HOUSING in one.links else "clutch")).replace("_", " ")),
            *(Cell(case.link_name(link)) for link in (one.first, one.second)),
            *[exact(one.drag, 4)] * drag,
            *[exact(one.capacity)] * capacity,
            *(cells[place] for cells in further.values()),
        ]
        for place, one in enumerate(elements)
    ]
    return Grid("Shift elements", columns, rows)


def _friction(elements: Sequence[ShiftElement]) -> dict[Column, list[Cell]]:
    """How they slip, where any of them tells it."""
    found = {}
    if any(one.static != 1 for one in elements):
        found[Column("static by kinetic torque")] = [exact(one.static) for one in elements]
    packs = [one.friction for one in elements]
    if any(packs):
        said = [_said(one._asdict()) if one else "" for one in packs]
        found[text("friction pack, SI")] = list(map(Cell, said))
    return found


def _gears(gears: Mapping[str, Mapping[str, Any]]) -> Grid:
    """What gears give besides the elements that they engage, which the table of gears has."""
    rows = (
        (name, _said({key: one for key, one in gear.items() if key != "engaged"}))
        for name, gear in gears.items()
    )
    return grid_of("What gears give besides", ["gear", "given"], (row for row in rows if row[1]))


def _said(value: Any) -> str:
    """Plain data in words.

    >>> _said({"teeth": {"sun": 48, "ring": 96}, "planets": 3})
    'teeth: sun 48, ring 96; planets: 3'
    >>> _said({"rings": [{"link": "out", "teeth": 72}], "open_drag": {"C_2": 0.02 / 3}})
    'rings: (link out, teeth 72); open drag: C_2 0.00666667'
    """
    if isinstance(value, Mapping):
        pairs = ((str(key).replace("_", " "), one) for key, one in value.items())
        return "; ".join(f"{key}: {_inner(one)}" for key, one in pairs)
    return _inner(value)


def _inner(value: Any) -> str:
    """Data within data; what is deeper still stands in brackets."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_single(one)}" for key, one in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(map(_single, value))
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _single(value: Any) -> str:
    is_word = isinstance(value, str) or not isinstance(value, Mapping | Sequence)
    return _inner(value) if is_word else f"({_inner(value)})"


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
        of_links = ((case.link_name(link), _number(one)) for link, one in case.inertias.items())
        yield grid_of("Inertias", ["link", "inertia, kg*m^2"], of_links)
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
