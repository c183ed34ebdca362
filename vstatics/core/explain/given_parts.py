"""Given data of the parts of a case, as tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from vstatics.core.annexes import KEYS
from vstatics.core.elements.drawing import drawing_of, parts_of
from vstatics.core.elements.element import Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.laws import MapLaw
from vstatics.core.model.parts import HOUSING, Law, Mechanism, ShiftElement
from vstatics.core.model.springs import Spring, ends
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.readers.named.law_formulas import DragFormula
from vstatics.core.statics.state import GearState
from vstatics.core.tables.grid import NOTHING, Cell, Grid, Value, grid_of, word
from vstatics.core.texts import heading, tr

UNREAD = frozenset(
    (
        *("name", "description", "source", "allow", "links", "gears", "kind", "cylinders"),
        *("inertias", "masses", "stiffness", "damping", "static", "friction", "capacity"),
        *("converters", "planet", *KEYS),
    )
)
"""Keys of a case and of parts that do not affect any blank, such as other gears."""
_SHOWN = frozenset(
    (
        *("kind", "teeth", "diameters", "planets", "suns", "rings", "rims", "meshes"),
        *("efficiency", "back_efficiency", "mesh_efficiency"),
    )
)
"""Keys of a gear set that have their own columns or tables."""
_SPEED, _TORQUE = "speed, rad/s", "torque, N*m"
_OVER = {"speed": (_SPEED,), "torque": (_TORQUE,), "both": (_SPEED, _TORQUE)}


def cell_of(value: Any) -> Value:
    """Return a cell for a number (six significant digits) or for a law (all points)."""
    if value is None or isinstance(value, str):
        return value or NOTHING
    if isinstance(value, Law):
        if value.text:
            return f"{value.text} [{tr('N*m')}]" if isinstance(value, DragFormula) else value.text
        points: Sequence[Sequence[float]] = value.points
        if isinstance(value, MapLaw):
            points = [
                (row[0], column, inner)
                for row in value.rows
                for column, inner in zip(value.columns, row[1:], strict=True)
            ]
        told = ", ".join(f"({', '.join(f'{x:.6g}' for x in point)})" for point in points)
        return f"{', '.join(map(heading, _OVER[value.over]))}: {told}"
    if math.isnan(value):
        return NOTHING
    return Cell(f"{value:.6g}", value, kind=float)


def link_text(case: Transmission, link: int) -> str:
    """Return the name of a link, or the translated word for the housing."""
    return case.link_name(link) if link else tr("housing")


def in_words(name: str) -> str:
    """Return a key or member in the current language."""
    return tr(name.replace("_", " "))


def elements(case: Transmission, data: Mapping[str, Mapping[str, Any]]) -> Grid:
    """Return the table of drawn gear sets with teeth and further data."""
    drawing = drawing_of(case)
    rows = []
    for element in drawing.elements if drawing else ():
        links = [
            f"{in_words(name)}: {link_text(case, link)}" for name, link in element.members.items()
        ]
        links += [
            f"{wheel.member}: {link_text(case, wheel.link)}"
            for wheel in element.wheels
            if wheel.member not in element.members
        ]
        more = "; ".join(
            f"{in_words(key)}: {data_text(value)}"
            for key, value in data[element.name].items()
            if key not in {*element.members, *_SHOWN, *UNREAD}
        )
        teeth = ", ".join(_teeth(element))
        row = element.name, word(element.kind.replace("_", " ")), ", ".join(links), teeth
        rows.append((*row, element.planets or "", more))
    headings = ["gear set", "kind", "links", "teeth", "planets", "given"]
    more_columns = ("teeth", "planets", "given")
    return grid_of("Gear sets", headings, rows, key="elements", optional=more_columns)


def fills_a_gap(element: Element) -> bool:
    """Return whether a set with several rims has a rim whose teeth follow from a sun and a ring."""
    if not isinstance(element.shape, Planetary) or element.rims:
        return False
    planets = group_of(element).planets
    teeth_by_rim = {rim: teeth for rims in planets.values() for rim, teeth in rims.items()}
    return len(teeth_by_rim) > 1 and any(
        teeth and rim not in element.teeth for rim, teeth in teeth_by_rim.items()
    )


def _teeth(element: Element) -> Iterator[str]:
    """Yield the teeth of gears and rims in words; for a planet group, also the rims in mesh."""
    front = f"{tr('diameters')}: " if getattr(element.shape, "size", "") == "diameters" else ""
    for name, count in element.teeth.items():
        yield f"{front}{in_words(name)} {count:g}"
        front = ""
    for wheel in element.wheels:
        kind = tr("ring" if wheel.internal else "sun")
        yield f"{kind} {wheel.member} {wheel.teeth} ({wheel.rim})"
    for planet, rims in element.rims.items():
        sizes = ", ".join(f"{rim} {count}" for rim, count in rims.items())
        yield f"{planet}: {sizes}"
    for rim, partner in element.meshes:
        yield f"{rim} - {partner}"


def data_text(value: Any) -> str:
    """Return plain data (mappings, lists, numbers) in words.

    >>> data_text({"large_sun": -2.0, "rest": [1, 2]})
    'large_sun -2, rest (1, 2)'
    """
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {data_text(item)}" for key, item in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"({', '.join(map(data_text, value))})"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def mechanisms(case: Transmission, gear: Gear) -> Grid:
    """Return the table of mechanisms, with the speed ratios of variators in the gear."""
    ratios = case.gear_ratios(gear)[case.own_mechanisms.start :]
    rows = [
        (
            mechanism.name,
            word(mechanism.kind),
            *(link_text(case, link) for link in (mechanism.first, mechanism.second)),
            link_text(case, mechanism.third) if mechanism.third or mechanism.is_set else NOTHING,
            *(cell_of(x) for x in ((None, ratio) if mechanism.kind else (ratio, None))),
            cell_of(mechanism.planet_ratio),
            _points(mechanism),
        )
        for mechanism, ratio in zip(
            case.mechanisms[case.own_mechanisms.start :], ratios, strict=True
        )
    ]
    optional = ("kind", "speed ratio", "planet ratio", "points")
    headings = ["mechanism", "kind", "first", "second", "third", "ratio", *optional[1:]]
    return grid_of("Mechanisms", headings, rows, key="mechanisms", optional=optional)


def _points(mechanism: Mechanism) -> str:
    """Return the points of a converter as text, with lambda if the speed ratio is unknown."""
    count = 3 if mechanism.can_be_open and math.isnan(mechanism.ratio) else 2
    points = ", ".join(
        f"({', '.join(f'{x:.6g}' for x in point[:count])})" for point in mechanism.points
    )
    words = ", ".join((tr("speed ratio"), "K", "lambda")[:count])
    return f"({words}): {points}" if points else ""


def losses(case: Transmission) -> Grid:
    """Return the table of efficiencies of all mechanisms of the solver, including defaults."""
    rows = []
    for part in parts_of(case):
        for mechanism, members in part.lowered:
            if mechanism.kind == "converter":  # the loss of a converter follows from its points
                continue
            between = " - ".join(map(in_words, filter(None, members[:2]))) if part.element else ""
            back = mechanism.back_efficiency
            both = cell_of(mechanism.efficiency), "" if back is None else cell_of(back)
            rows.append((part.name, between, *both))
    headings = ["mechanism", "between", "efficiency", "efficiency backward"]
    optional = ("between", "efficiency backward")
    return grid_of("Losses, third link held", headings, rows, key="losses", optional=optional)


def kind_of(element: ShiftElement) -> Cell:
    """Return the kind of a shift element in words."""
    kind = element.kind or ("brake" if HOUSING in element.links else "clutch")
    return word(kind.replace("_", " "))


def shift_elements(case: Transmission, gear: Gear, state: GearState) -> Grid:
    """Return the table of shift elements, with prescribed slips and drag of disengaged elements."""
    rows, drags = [], case.gear_open_drag(gear)
    for number, element in enumerate(case.shift_elements, 1):
        on, off = ("holds", "overruns") if element.is_freewheel else ("engaged", "disengaged")
        is_open = number not in state.gear.carrying
        rows.append(
            (
                element.name,
                kind_of(element),
                *(link_text(case, link) for link in element.links),
                word(off if is_open else on if number in state.engaged else "slips"),
                cell_of(plain(state.gear.slip[number])) if number in state.gear.slipping else "",
                cell_of(drag) if (drag := drags[number]) and is_open else "",
            )
        )
    headings = ["shift element", "kind", "first", "second", "state", "slip", "drag"]
    optional = ("slip", "drag")
    return grid_of("Shift elements", headings, rows, key="shift_elements", optional=optional)


def springs(case: Transmission) -> Grid:
    """Return the table of springs with their twists."""
    rows = ((spring.name, twist_text(case, spring)) for spring in case.springs)
    return grid_of("Springs", ["spring", "twist"], rows, key="springs")


def twist_text(case: Transmission, spring: Spring) -> str:
    """Return the twist of a spring as a sum, such as ``engine - disc``."""
    shaft = ends(spring.twist)
    text = ""
    for link, part in spring.form.items():
        size = "" if shaft or abs(part) == 1 else f"{abs(part):.6g} "
        sign = ("-" if part < 0 else "+") if text else "-" * (part < 0)
        text += f"{f' {sign} ' if text else sign}{size}{case.link_name(link)}"
    return text
