"""What is given of the parts of a case, as tables: what solving reads of each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from vstatics.core.annexes import KEYS
from vstatics.core.elements.drawing import drawing_of, parts_of
from vstatics.core.elements.element import Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.parts import HOUSING, Law, Mechanism, ShiftElement
from vstatics.core.model.springs import Spring, ends
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.tables.grid import NOTHING, Cell, Grid, Value, Values, grid_of, word
from vstatics.core.texts import heading, tr

UNREAD = frozenset(
    (
        *("name", "description", "source", "allow", "links", "gears", "kind", "cylinders"),
        *("inertias", "masses", "stiffness", "damping", "static", "friction", "capacity"),
        *("converters", "planet", *KEYS),
    )
)
"""Keys of a case and of its parts that no blank depends on; other gears do not count, either."""
_TOLD = frozenset(
    (
        *("kind", "teeth", "diameters", "planets", "suns", "rings", "rims", "meshes"),
        *("efficiency", "back_efficiency", "mesh_efficiency"),
    )
)
"""Keys of an element that have columns of their own, or a table as losses have."""
_OVER = {"speed": "speed, rad/s", "torque": "torque, N*m"}


def cell_of(value: Any) -> Value:
    """A number with all the digits that a calculation wants, or a law with all its points."""
    if value is None or isinstance(value, str):
        return value or NOTHING
    if isinstance(value, Law):
        if value.text:
            return f"{value.text} [{tr('N*m')}]"
        points = ", ".join(f"({x:.6g}, {y:.6g})" for x, y in value.points)
        return f"{heading(_OVER[value.over])}: {points}"
    if math.isnan(value):
        return NOTHING
    return Cell(f"{value:.6g}", value, kind=float)


def link_text(case: Transmission, link: int) -> str:
    """A link by its name."""
    return case.link_name(link) if link else tr("housing")


def in_words(name: str) -> str:
    """A key or member of this program, in the language that is spoken."""
    return tr(name.replace("_", " "))


def elements(case: Transmission, data: Mapping[str, Mapping[str, Any]]) -> Grid:
    """Drawn elements, their teeth, and what else is told of them."""
    drawing = drawing_of(case)
    rows: list[Values] = []
    for one in drawing.elements if drawing else ():
        links = [f"{in_words(name)} {link_text(case, link)}" for name, link in one.members.items()]
        links += [f"{wheel.member} {link_text(case, wheel.link)}" for wheel in _own_wheels(one)]
        more = "; ".join(
            f"{in_words(key)}: {data_text(value)}"
            for key, value in data[one.name].items()
            if key not in {*one.members, *_TOLD, *UNREAD}
        )
        teeth = ", ".join(_teeth(one))
        row = one.name, word(one.kind.replace("_", " ")), ", ".join(links), teeth
        rows.append((*row, one.planets or "", more))
    headings = ["element", "kind", "links", "teeth", "planets", "given"]
    more_columns = ("teeth", "planets", "given")
    return grid_of("Elements", headings, rows, key="elements", optional=more_columns)


def fills_a_gap(element: Element) -> bool:
    """Whether one of several kinds of planets has its teeth by the sun and the ring around it."""
    if not isinstance(element.shape, Planetary) or element.rims:
        return False
    planets = group_of(element).planets
    found = {rim: teeth for rims in planets.values() for rim, teeth in rims.items()}
    return len(found) > 1 and any(
        teeth and rim not in element.teeth for rim, teeth in found.items()
    )


def _own_wheels(element: Element) -> Sequence[Any]:
    return [one for one in element.wheels if one.member not in element.members]


def _teeth(element: Element) -> Iterator[str]:
    """Teeth of wheels and rims; of a group also what meshes with what."""
    front = f"{tr('diameters')}: " if getattr(element.shape, "size", "") == "diameters" else ""
    for name, count in element.teeth.items():
        yield f"{front}{in_words(name)} {count:g}"
        front = ""
    for wheel in element.wheels:
        kind = tr("ring" if wheel.internal else "sun")
        yield f"{kind} {wheel.member} {wheel.teeth} ({wheel.rim})"
    for planet, rims in element.rims.items():
        own = ", ".join(f"{rim} {count}" for rim, count in rims.items())
        yield f"{planet}: {own}"
    for one, other in element.meshes:
        yield f"{one} - {other}"


def data_text(value: Any) -> str:
    """Plain data in words.

    >>> data_text({"large_sun": -2.0, "rest": [1, 2]})
    'large_sun -2, rest (1, 2)'
    """
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {data_text(one)}" for key, one in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"({', '.join(map(data_text, value))})"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def mechanisms(case: Transmission, gear: Gear) -> Grid:
    """Those that the case gives as such; of a variator its speed ratio in the gear."""
    ratios = case.gear_ratios(gear)[case.own_mechanisms.start :]
    rows = [
        (
            one.name,
            word(one.kind),
            *(link_text(case, link) for link in (one.first, one.second)),
            link_text(case, one.third) if one.third or one.is_set else NOTHING,
            *(cell_of(x) for x in ((None, ratio) if one.kind else (ratio, None))),
            cell_of(one.planet_ratio),
            _points(one),
        )
        for one, ratio in zip(case.mechanisms[case.own_mechanisms.start :], ratios, strict=True)
    ]
    optional = ("kind", "speed ratio", "planet ratio", "points")
    headings = ["mechanism", "kind", "first", "second", "third", "ratio", *optional[1:]]
    return grid_of("Mechanisms", headings, rows, key="mechanisms", optional=optional)


def _points(one: Mechanism) -> str:
    """Of a converter: speed ratio and torque ratio."""
    points = ", ".join(f"({i:.6g}, {k:.6g})" for i, k, *_ in one.points)
    return f"({tr('speed ratio')}, K): {points}" if points else ""


def losses(case: Transmission) -> Grid:
    """The efficiency of each mechanism that is solved: as a case gives it, or by its default."""
    rows: list[Values] = []
    for part in parts_of(case):
        for mechanism, members in part.lowered:
            if mechanism.kind == "converter":  # loses by its points
                continue
            between = " - ".join(map(in_words, filter(None, members[:2]))) if part.element else ""
            back = mechanism.back_efficiency
            both = cell_of(mechanism.efficiency), "" if back is None else cell_of(back)
            rows.append((part.name, between, *both))
    headings = ["mechanism", "between", "efficiency", "efficiency backward"]
    optional = ("between", "efficiency backward")
    return grid_of("Losses, third link held", headings, rows, key="losses", optional=optional)


def kind_of(one: ShiftElement) -> Cell:
    """The kind of a shift element, in words."""
    kind = one.kind or ("brake" if HOUSING in one.links else "clutch")
    return word(kind.replace("_", " "))


def shift_elements(case: Transmission, gear: Gear, engaged: Sequence[int]) -> Grid:
    """Those that are open may drag; freewheels that hold are engaged."""
    rows, drags = [], case.gear_open_drag(gear)
    for number, one in enumerate(case.shift_elements, 1):
        on, off = ("holds", "overruns") if one.is_freewheel else ("engaged", "open")
        rows.append(
            (
                one.name,
                kind_of(one),
                *(link_text(case, link) for link in one.links),
                word(on if number in engaged else off),
                cell_of(drag) if (drag := drags[number]) and number not in engaged else "",
            )
        )
    headings = ["shift element", "kind", "first", "second", "state", "drag"]
    return grid_of("Shift elements", headings, rows, key="shift_elements", optional=("drag",))


def springs(case: Transmission) -> Grid:
    """The twists of springs, in which speeds and torques follow one another."""
    rows = ((one.name, twist_text(case, one)) for one in case.springs)
    return grid_of("Springs", ["spring", "twist"], rows, key="springs")


def twist_text(case: Transmission, spring: Spring) -> str:
    """The twist of a spring as a sum: ``engine - disc``; of one link alone its name."""
    shaft = ends(spring.twist)
    said = ""
    for link, part in spring.form.items():
        size = "" if shaft or abs(part) == 1 else f"{abs(part):.6g} "
        sign = ("-" if part < 0 else "+") if said else "-" * (part < 0)
        said += f"{f' {sign} ' if said else sign}{size}{case.link_name(link)}"
    return said
