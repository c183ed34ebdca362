"""What the numbers of a gear follow from: all that solving reads of its case, as tables.

An exercise can be solved from these alone, so what solving reads stands here. What it does not
read is listed in `UNREAD`; a key that is in neither shows itself among the rest.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from vstatics.elements.drawing import drawing_of, parts_of
from vstatics.elements.element import Element
from vstatics.explain.text import LOSSES, engaged
from vstatics.model.parts import HOUSING, Law, Mechanism
from vstatics.model.springs import Spring, ends
from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics.traced import plain
from vstatics.statics.results import Results
from vstatics.statics.state import GearState
from vstatics.tables.grid import NOTHING, Cell, Grid, Value, Values, grid_of, whole, word
from vstatics.texts import heading, tr
from vstatics.writers.named import mapping

UNREAD = frozenset(
    (
        *("name", "description", "source", "allow", "links", "gears", "kind", "cylinders"),
        *("inertias", "masses", "stiffness", "damping", "static", "friction", "capacity"),
        *("converters", "dump", "vehicle", "fatigue", "planet"),
    )
)
"""Keys of a case and of its parts that no blank depends on; other gears do not count, either."""
_SHOWN = frozenset(
    (
        *("shift_elements", "elements", "mechanisms", "springs", "input", "output", "outputs"),
        *("load", "coast", "idle", "losses", "mesh_efficiency"),
        *("engaged", "speeds", "torques", "drag", "open_drag", "speed_ratios", "input_turns"),
        "balance",
    )
)
"""Keys of a case or a gear whose numbers stand in tables of their own; losses as they act."""
_OF_ELEMENT = frozenset(("kind", "teeth", "efficiency", "back_efficiency", "mesh_efficiency"))
"""The same of an element, besides its members."""

_OVER = {"speed": "speed, rad/s", "torque": "torque, N*m"}


def given(results: Results, place: int) -> Iterator[Grid]:
    """What is given of a gear: its parts, how they are joined, what acts; and how signs count.

    Parameters
    ----------
    place : int
        Of the gear, from 0.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> [one.key for one in given(solve(case), 0) if one.rows]
    ['mechanisms', 'losses', 'shift_elements', 'ports', 'acting']
    """
    case, state = results.case, results.gear_at(place)
    gear = case.gears[place]
    names = [one.name for one in case.shift_elements]
    holding = [names[number - 1] for number in state.holding]
    said = engaged([names[number - 1] for number in gear.engaged], holding)
    yield Grid(tr("Gear {gear}: {engaged}", gear=gear.name, engaged=said), (), ())
    data = mapping(case)
    made = (
        _elements(case, data.get("elements", {})),
        _mechanisms(case, gear),
        _losses(case),
        _shift_elements(case, gear, state.engaged),
        _springs(case),
        _ports(case, gear),
        _acting(case, gear),
        _rest({**data, **data["gears"][gear.name]}),
        _idle(state),
    )
    yield from (one for one in made if one.rows)
    yield from (Grid(one, (), ()) for one in _conventions(state))


def _conventions(state: GearState) -> Iterator[str]:
    """How speeds and torques of a gear are counted, in words."""
    case = state.case
    if case.input_torque(state.gear):
        yield tr(
            "Speeds are relative to the speed of the input, torques to its torque, powers to its "
            "power."
        )
    else:
        yield tr("Speeds are relative to the speed of the input; torques are in N*m.")
    yield tr(
        "A torque on a device is that which its link gives to it, positive in the direction of the "
        "torque of the input; that of a shift element or mechanism is on its first link; Mx is "
        "what the output gives to the load."
    )
    if any(one.efficiency != 1 or one.back_efficiency is not None for one in case.mechanisms):
        yield f"{tr('Torques with losses')}: {tr(LOSSES)}"
    if any(one.is_plain(one.ratio) and one.planet_ratio is None for one in case.mechanisms):
        yield tr("The ratio first link to planet of a plain set is (u + 1)/2.")
    if case.freewheels:
        yield tr("A freewheel keeps its first link from turning backward against the second.")
    if case.coasts(state.gear):
        yield tr("Coasting: power enters at the output.")


def _number(value: Any) -> Value:
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


def _link(case: Transmission, link: int) -> str:
    return case.link_name(link) if link else tr("housing")


def _words(name: str) -> str:
    """A key or member of this program, in the language that is spoken."""
    return tr(name.replace("_", " "))


def _elements(case: Transmission, data: Mapping[str, Mapping[str, Any]]) -> Grid:
    drawing = drawing_of(case)
    rows: list[Values] = []
    for one in drawing.elements if drawing else ():
        links = [f"{_words(name)} {_link(case, link)}" for name, link in one.members.items()]
        links += [f"{wheel.member} {_link(case, wheel.link)}" for wheel in _own_wheels(one)]
        own = {key: value for key, value in data[one.name].items() if key not in one.members}
        rest = {k: v for k, v in own.items() if k not in _OF_ELEMENT | UNREAD | {"planets"}}
        known = {"suns", "rings", "rims", "meshes"}  # which the teeth tell
        more = "; ".join(f"{_words(k)}: {_said(v)}" for k, v in rest.items() if k not in known)
        teeth = ", ".join(_teeth(one))
        row = one.name, word(one.kind.replace("_", " ")), ", ".join(links), teeth
        rows.append((*row, one.planets or "", more))
    headings = ["element", "kind", "links", "teeth", "planets", "given"]
    more_columns = ("teeth", "planets", "given")
    return grid_of("Elements", headings, rows, key="elements", optional=more_columns)


def _own_wheels(element: Element) -> Sequence[Any]:
    return [one for one in element.wheels if one.member not in element.members]


def _teeth(element: Element) -> Iterator[str]:
    """Teeth of wheels and rims; of a group also what meshes with what."""
    for name, count in element.teeth.items():
        yield f"{_words(name)} {count:g}"
    for wheel in element.wheels:
        kind = tr("ring" if wheel.internal else "sun")
        yield f"{kind} {wheel.member} {wheel.teeth} ({wheel.rim})"
    for planet, rims in element.rims.items():
        own = ", ".join(f"{rim} {count}" for rim, count in rims.items())
        yield f"{planet}: {own}"
    for one, other in element.meshes:
        yield f"{one} - {other}"


def _said(value: Any) -> str:
    """Plain data in words.

    >>> _said({"large_sun": -2.0, "rest": [1, 2]})
    'large_sun -2, rest (1, 2)'
    """
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_said(one)}" for key, one in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"({', '.join(map(_said, value))})"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _mechanisms(case: Transmission, gear: Gear) -> Grid:
    """Those that the case gives as such; of a variator its speed ratio in the gear."""
    ratios = case.gear_ratios(gear)[case.own_mechanisms.start :]
    rows = [
        (
            one.name,
            word(one.kind),
            *(_link(case, link) for link in (one.first, one.second)),
            _link(case, one.third) if one.third or one.is_set else NOTHING,
            *(_number(x) for x in ((None, ratio) if one.kind else (ratio, None))),
            _number(one.planet_ratio),
            _said(one.points) if one.points else "",
        )
        for one, ratio in zip(case.mechanisms[case.own_mechanisms.start :], ratios, strict=True)
    ]
    optional = ("kind", "speed ratio", "planet ratio", "points")
    headings = ["mechanism", "kind", "first", "second", "third", "ratio", *optional[1:]]
    return grid_of("Mechanisms", headings, rows, key="mechanisms", optional=optional)


def _losses(case: Transmission) -> Grid:
    """The efficiency of each mechanism that is solved: as a case gives it, or by its default."""
    rows: list[Values] = []
    for part in parts_of(case):
        for mechanism, members in part.lowered:
            between = " - ".join(map(_words, filter(None, members[:2]))) if part.element else ""
            rows.append((part.name, between, *_efficiencies(mechanism)))
    headings = ["mechanism", "between", "efficiency", "efficiency backward"]
    optional = ("between", "efficiency backward")
    return grid_of("Losses, third link held", headings, rows, key="losses", optional=optional)


def _efficiencies(one: Mechanism) -> tuple[Value, Value]:
    back = one.back_efficiency
    return _number(one.efficiency), "" if back is None else _number(back)


def _shift_elements(case: Transmission, gear: Gear, engaged: Sequence[int]) -> Grid:
    """Those that are open may drag; freewheels that hold are engaged."""
    rows = []
    for number, one in enumerate(case.shift_elements, 1):
        kind = one.kind or ("brake" if HOUSING in one.links else "clutch")
        on, off = ("holds", "overruns") if one.is_freewheel else ("engaged", "open")
        drag = gear.open_drag.get(number, one.drag)
        drags = number not in engaged and (drag or isinstance(drag, Law))
        rows.append(
            (
                one.name,
                word(kind.replace("_", " ")),
                *(_link(case, link) for link in one.links),
                word(on if number in engaged else off),
                _number(drag) if drags else "",
            )
        )
    headings = ["shift element", "kind", "first", "second", "state", "drag"]
    return grid_of("Shift elements", headings, rows, key="shift_elements", optional=("drag",))


def _springs(case: Transmission) -> Grid:
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


def _ports(case: Transmission, gear: Gear) -> Grid:
    rows = [
        (case.link_name(case.gear_input(gear)), word("input")),
        (case.link_name(case.gear_output(gear)), word("output")),
        *((case.link_name(link), word("further output")) for link in case.further_outputs(gear)),
    ]
    return grid_of("Ports", ["link", "port"], rows, key="ports")


def _acting(case: Transmission, gear: Gear) -> Grid:
    """Speeds and torques that are given, drag, and what is told of the load."""
    entry = case.gear_input(gear)
    rows: list[tuple[int, str, Value]] = [
        (entry, "speed", _number(1.0)),
        (entry, "torque", _number(case.input_torque(gear))),
    ]
    for link, speed in gear.speeds.items():
        told = case.speed_text(speed) if not isinstance(speed, float) else _number(speed)
        rows.append((link, "speed", told))
    rows += [(link, "torque", _number(torque)) for link, torque in gear.torques.items()]
    rows += [(link, "drag", _number(drag)) for link, drag in gear.drag.items()]
    load = case.gear_load(gear)
    if load.speed is not None:
        rows.append((entry, "speed, rpm", _number(load.speed)))
    if load.torque is not None:
        rows.append((entry, "torque, N*m", _number(load.torque)))
    if case.freewheels and (turns := case.input_turns(gear)):
        rows.append((entry, "sense of rotation", word(turns)))
    if gear.balance:
        rows += [
            (link, "efficiency", _number(efficiency))
            for link, efficiency in gear.balance.efficiencies
        ]
        rows.append((HOUSING, "charging power, kW", _number(gear.balance.battery)))
    named = (
        (_link(case, link) if link else NOTHING, heading(what), value) for link, what, value in rows
    )
    return grid_of("Given", ["link", "quantity", "value"], named, key="acting")


def _rest(data: Mapping[str, Any]) -> Grid:
    """Any other key of the case or the gear."""
    rows = [
        (_words(key), _said(value)) for key, value in data.items() if key not in UNREAD | _SHOWN
    ]
    return grid_of("Given besides", ["quantity", "value"], rows, key="rest")


def _idle(state: GearState) -> Grid:
    """Signs that no power decides, but a convention."""
    rows = [
        (one.name, whole(plain(sign)))
        for one, sign, idle in zip(
            state.case.mechanisms, state.signs, state.search.idle, strict=True
        )
        if idle
    ]
    return grid_of("Signs of idle mechanisms", ["mechanism", "x"], rows, key="idle")
