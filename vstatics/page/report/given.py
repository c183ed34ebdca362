"""Tables of the input data of a case: components, gears, inertias and springs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from vstatics.core.elements.drawing import Drawing, drawing_of
from vstatics.core.explain.given_parts import kind_of, twist_text
from vstatics.core.model.laws import MapLaw
from vstatics.core.model.parts import Law, Mechanism, OfLoad, ShiftElement, damping
from vstatics.core.model.springs import Spring, SpringLimit
from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.grid import NOTHING, Cell, Grid, Values, exact, grid_of, word
from vstatics.core.tables.html import Markup, tables, terms
from vstatics.core.tables.straight import in_both_units
from vstatics.core.texts import spoken, tr

_NAMED = (
    *("name", "description", "source", "shift_elements", "elements", "mechanisms", "gears"),
    *("inertias", "masses", "springs"),
)
"""Keys of a case that have tables or texts of their own on the page."""
_LABELS = {"idle": "sign of unloaded mechanisms", "coast": "coasting"}


def given(
    case: Transmission,
    mapping: Mapping[str, Any],
    digits: int | None = None,
    marked: Callable[[Iterable[Grid]], Iterator[Grid]] = iter,
) -> Iterator[Markup]:
    """Yield the input data of a case: common values, then tables of components and gears.

    Parameters
    ----------
    mapping : mapping
        Case as plain data, the value of ``case`` in its result as JSON.
    marked : callable, optional
        Function that marks tables for the scripts of the page.
    """
    common = {key: value for key, value in mapping.items() if key not in _NAMED}
    common = {"input": case.link_name(case.input), "output": case.link_name(case.output), **common}
    labels = {key: _LABELS.get(key, key.replace("_", " ")) for key in common}
    yield terms((tr(labels[key]), _said(value)) for key, value in common.items())
    yield from tables(marked(_grids(case, mapping, digits)))


def _grids(case: Transmission, mapping: Mapping[str, Any], digits: int | None) -> Iterator[Grid]:
    drawing = drawing_of(case)
    if drawing is not None and drawing.elements:
        yield _elements(drawing, mapping["elements"])
    if case.mechanisms:
        yield _mechanisms(case).with_digits(digits)
    if case.shift_elements:
        yield _shift_elements(case).with_digits(digits)
    yield from torsion_grids(case)
    further = _gears(mapping["gears"])
    if further.rows:
        yield further


def _elements(drawing: Drawing, mapping: Mapping[str, Mapping[str, Any]]) -> Grid:
    rows = []
    for element in drawing.elements:
        data = dict(mapping[element.name])
        kind = str(data.pop("kind")).replace("_", " ")
        links = {member: data.pop(member) for member in element.members}
        rows.append((element.name, word(kind), _said(links), _said(data)))
    return grid_of("Gear sets", ["gear set", "kind", "links", "teeth and the rest"], rows)


def _mechanisms(case: Transmission) -> Grid:
    """Return the table of mechanisms, with planet ratios if a gear set defines them."""
    rows: list[Values] = [
        (
            mechanism.name,
            *map(case.link_name, (mechanism.first, mechanism.second)),
            case.link_name(mechanism.third) if mechanism.third else NOTHING,
            *map(_number_or_law, (mechanism.ratio, mechanism.efficiency)),
            *map(_number_or_law, (mechanism.back_efficiency, mechanism.planet_ratio)),
            *_elastic(mechanism),
        )
        for mechanism in case.mechanisms
    ]
    headings = ("mechanism", "first", "second", "third", "ratio", "efficiency")
    more = ("efficiency backward", "planet ratio", *ELASTIC)
    drawing = drawing_of(case)
    is_drawn = drawing is not None and bool(drawing.elements)
    title = "Mechanisms, as they are calculated" if is_drawn else "Mechanisms"
    return grid_of(title, (*headings, *more), rows, optional=more)


def _number_or_law(value: float | None) -> Any:
    """Return a number with its unit, or the description of a characteristic curve."""
    if isinstance(value, OfLoad):
        return f"{value.given:g} N*m"
    if isinstance(value, MapLaw):
        return tr("map over speed and torque")
    if isinstance(value, Law):
        return value.text or tr(
            "{count} point over {what}|{count} points over {what}",
            count=len(value.points),
            what=tr(value.over),
        )
    return exact(value, 4)


def _shift_elements(case: Transmission) -> Grid:
    """Return the table of shift elements, with columns for drag and friction ratio if present."""
    elements = case.shift_elements
    drags = any(element.drag for element in elements)
    slips = any(element.static != 1 for element in elements)
    rows = [
        (
            element.name,
            kind_of(element),
            *map(case.link_name, (element.first, element.second)),
            _number_or_law(element.drag) if drags else "",
            element.capacity,
            exact(element.static) if slips else "",
            _said({key: value for key, value in element.friction._asdict().items() if value})
            if element.friction
            else "",
            *_elastic(element),
        )
        for element in elements
    ]
    headings = ("shift element", "kind", "first", "second")
    more = (
        "drag torque, relative to the input torque",
        "torque capacity, relative to the input torque",
        "static by kinetic torque",
        "friction pack, SI",
        *ELASTIC,
    )
    return grid_of("Shift elements", (*headings, *more), rows, optional=more)


def _gears(gears: Mapping[str, Mapping[str, Any]]) -> Grid:
    rows = (
        (name, _said({key: value for key, value in gear.items() if key != "engaged"}))
        for name, gear in gears.items()
    )
    return grid_of("Further data of the gears", ["gear", "given"], (row for row in rows if row[1]))


def _said(value: Any) -> str:
    """Return a number, text, list or mapping of a case as text.

    >>> _said({"teeth": {"sun": 48, "ring": 96}, "planets": 3})
    'teeth: sun 48, ring 96; planets: 3'
    >>> _said({"rings": [{"link": "out", "teeth": 72}], "open_drag": {"C_2": 0.02 / 3}})
    'rings: (link out, teeth 72); open drag: C_2 0.00666667'
    """
    if isinstance(value, Mapping):
        pairs = (
            (_key(key), _inner(inner_value, keyed=key in KEYED))
            for key, inner_value in value.items()
        )
        return "; ".join(f"{key}: {inner}" for key, inner in pairs)
    return _inner(value)


def _key(key: str) -> str:
    return tr(str(key).replace("_", " "))


KEYED = ("teeth", "load", "mesh_efficiency", "efficiency", "planet", "damping", "suns", "rings")
"""Keys whose mappings have words of the case format as keys. Other mappings have names."""


def _inner(value: Any, *, keyed: bool = False) -> str:
    """Return a value in a list or mapping as text, with deeper levels in brackets."""
    if isinstance(value, bool):
        return tr("yes" if value else "no")
    if isinstance(value, Mapping):
        return ", ".join(
            f"{_key(key) if keyed and spoken() != 'en' else key} {_single(item)}"
            for key, item in value.items()
        )
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(_single(item, keyed=keyed) for item in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _single(value: Any, *, keyed: bool = False) -> str:
    is_word = isinstance(value, str) or not isinstance(value, Mapping | Sequence)
    return _inner(value) if is_word else f"({_inner(value, keyed=keyed)})"


DAMPED = ("damping, N*m*s/rad", "loss factor")
ELASTIC = ("stiffness, N*m/rad", *DAMPED)
"""Headings of the columns of elastic components: stiffness, compliance and damping."""


def torsion_grids(case: Transmission) -> Iterator[Grid]:
    """Yield tables of inertias and masses of links, and of springs, if the case has any.

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
        of_links = (
            (case.link_name(link), _six_digits(inertia)) for link, inertia in case.inertias.items()
        )
        yield grid_of("Inertias", ["link", "inertia, kg*m^2"], of_links)
    if case.masses:
        of_links = ((case.link_name(link), _six_digits(mass)) for link, mass in case.masses.items())
        yield grid_of("Masses", ["link", "mass, kg"], of_links)
    if case.springs:
        rows: list[Values] = [
            (
                spring.name,
                twist_text(case, spring),
                *_stiffness(spring),
                *_damped(spring),
                _limit(spring),
                _six_digits(spring.friction or None),
            )
            for spring in case.springs
        ]
        headings = ("spring", "twist", "stiffness, N*m/rad", "compliance, rad/(N*m)")
        more = (*DAMPED, "limit, N*m", "friction, N*m")
        grid = grid_of("Springs", (*headings, *more), rows, optional=more)
        yield from in_both_units(case, [grid])


def _elastic(part: Mechanism | ShiftElement) -> list[Cell]:
    return [_six_digits(part.stiffness), *_damped(part)]


def _stiffness(spring: Spring) -> list[Cell]:
    """Return stiffness and compliance of a spring, or the number of points of its curve."""
    if spring.strut:
        return [_six_digits(spring.rate), word("strut")]
    if spring.points:
        return [
            Cell(tr("{count} point|{count} points", count=len(spring.points)), None),
            _six_digits(None),
        ]
    if spring.is_damper:
        return [_six_digits(None), _six_digits(None)]
    return [_six_digits(spring.rate), _six_digits(1 / spring.rate)]


def _limit(spring: Spring) -> Cell:
    """Return the torque limit of a spring, or its formula if it depends on another spring."""
    limit = spring.limit
    if isinstance(limit, SpringLimit):
        return Cell(
            tr("{base:.6g} + {times:.6g} of {of}", base=limit.base, times=limit.times, of=limit.of)
        )
    return _six_digits(limit)


def _damped(part: Spring | Mechanism | ShiftElement) -> list[Cell]:
    given = damping(part.damping)
    return [_six_digits(given.viscous or None), _six_digits(given.loss_factor or None)]


def _six_digits(value: float | None) -> Cell:
    return Cell(NOTHING if value is None else f"{value:.6g}", value, kind=float)
