"""Writes cases as YAML and JSON; read again they are equal to the last bit."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any, get_args

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import printable
from vstatics.core.model.checks import carried_keys
from vstatics.core.model.keys import CASE, with_carried
from vstatics.core.model.parts import BatteryBalance, Law, OfLoad, mechanism_record
from vstatics.core.model.shape import (
    UNITS,
    Balances,
    ByKey,
    ByKind,
    ByLaw,
    ByName,
    ByPoints,
    Either,
    Ends,
    Leaf,
    ListOf,
    Measure,
    Numbers,
    Pair,
    RowOf,
    Shape,
)
from vstatics.core.model.springs import spring_record
from vstatics.core.model.transmission import SpeedOf, Transmission

if TYPE_CHECKING:
    import yaml

_WORD = re.compile(r"[^\W\d]\w*")


class _OnOneLine(dict[str, Any]):
    """A mapping that YAML has in braces."""


def mapping(case: Transmission, *, units: bool = True) -> dict[str, Any]:
    """A case as plain data, with the keys of its YAML and JSON.

    Keys that have their default are left out.

    Parameters
    ----------
    case : Transmission
    units : bool
        Whether what was given with a unit keeps it, so that it is the same with another load;
        else it is a part of the load's speed or torque.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> case = Transmission(
    ...     2, [ShiftElement(1, 2)], [Mechanism(1, 2, 0, ratio=2.0)], [Gear([1])]
    ... )
    >>> mapping(case)["links"], mapping(case)["mechanisms"], mapping(case)["gears"]
    (2, {'D1': {'first': 1, 'second': 2, 'ratio': 2.0}}, {'1': {'engaged': ['F1']}})
    """
    shape, values = CASE, dict(vars(case))
    if drawing := drawing_of(case):
        from vstatics.core.elements.keys import record_of, with_elements

        shape = with_elements(CASE)
        values |= vars(drawing)
        values["elements"] = {one.name: record_of(one) for one in drawing.elements}
    wholes = {math.inf, *_wholes(case)} if units else {math.inf}
    if not units:
        values |= _drag_by_gear(case)
    links, own = _link_words(case), case.own_links
    values["links"] = own if links[1] == 1 else links[1 : own + 1]
    values["output"] = None if case.outputs or case.output == own else case.output
    for part in ("shift_elements", "mechanisms", "gears"):
        values[part] = {item.name: item for item in values[part]}
    sets = values["mechanisms"]  # those of a drawing, where there is one
    values["mechanisms"] = {name: mechanism_record(one) for name, one in sets.items()}
    values["springs"] = {one.name: spring_record(one) for one in case.springs}
    values["converters"] = {
        one.name: {"links": one.links, "points": one.points} for one in case.converters
    }
    if carried := carried_keys(case):
        shape = with_carried(shape, carried)
        values |= {key.shape.name: key.record(case) for key in carried}
    order = _CASE if shape is CASE else _as_written(shape)
    ratios = ["", *sets, *values["converters"]]
    writer = _Writer(links, ["", *values["shift_elements"]], ratios, wholes)
    return writer.by_key(values, order)


def write_yaml(case: Transmission) -> str:
    """A case as YAML; see `mapping`."""
    import yaml  # costs start-up time

    data = mapping(case)
    data["gears"] = {name: _OnOneLine(gear) for name, gear in data["gears"].items()}
    if "shift_elements" in data:
        data["shift_elements"] = {
            name: _OnOneLine(element) if isinstance(element, dict) else element
            for name, element in data["shift_elements"].items()
        }
    return yaml.dump(
        data,
        Dumper=_dumper(),
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=None,
        width=100,
    )


def write_json(case: Transmission) -> str:
    """A case as JSON; see `mapping`."""
    import json  # costs start-up time

    return json.dumps(mapping(case), indent=2, ensure_ascii=False) + "\n"


def _wholes(case: Transmission) -> set[float]:
    """The sizes of all speeds and torques of a load to which a number of the case may be related.

    One that is related to another would be no part of anything when it is read again.
    """
    loads = [case.load, *(gear.load and case.gear_load(gear) for gear in case.gears)]
    given = [load for load in loads if load]
    return {load.torque_size for load in given} | {abs(load.speed or 0.0) for load in given}


def _drag_by_gear(case: Transmission) -> dict[str, Any]:
    """Gears with all drags relative to their loads, which may differ from the load of the case."""
    gears = []
    for gear in case.gears:
        own = case.with_all_drag(gear)
        dragging = {n: drag for n, drag in own.open_drag.items() if drag or n in gear.open_drag}
        gears.append(own._replace(open_drag=dragging))
    elements = [element._replace(drag=0.0) for element in case.shift_elements]
    return {"drag": {}, "shift_elements": elements, "gears": gears}


def _link_words(case: Transmission) -> list[int | str]:
    """How each link is written, the housing first: the case's own by their numbers if they can."""
    own = case.own_links
    if list(case.link_names[:own]) == [str(number) for number in range(1, own + 1)]:
        return ["housing", *range(1, case.links + 1)]
    return ["housing", *map(str, case.link_names)]


def _as_written(case: ByKey) -> ByKey:
    """The keys in the order in which they are written: `load` after `coast`."""
    keys = {key.name: key for key in case.keys}
    load = keys.pop("load")
    at = [*keys].index("coast") + 1
    ordered = [*keys.values()]
    return case._replace(keys=(*ordered[:at], load, *ordered[at:]))


_CASE = _as_written(CASE)


class _Writer:
    """Gives parts of the model as plain data, by their shapes."""

    def __init__(
        self,
        links: Sequence[int | str],
        elements: Sequence[str],
        mechanisms: Sequence[str],
        wholes: Collection[float],
    ) -> None:
        """Keep how links, shift elements and mechanisms are written, and what keeps its unit.

        The first three by their numbers; what is related to one of `wholes` keeps its unit.
        """
        self.wholes = wholes
        self.links = links
        self.mechanisms = [str(name) for name in mechanisms]
        self.elements = [str(name) for name in elements]

    def by_key(self, part: Any, shape: ByKey) -> dict[str, Any]:
        """The keys of a part of the model, or of a mapping, without those that say nothing."""
        values = part if isinstance(part, dict) else None
        data: dict[str, Any] = {}
        for key in shape.keys:
            value = getattr(part, key.name, None) if values is None else values.get(key.name)
            says = key.required or isinstance(value, OfLoad) or not key.leaves_out(value)
            says &= key.name != "torque" or getattr(part, "power", None) is None  # it gives that
            if value is not None and says:  # what is a part of no load is 0 as a number
                data[key.name] = self.value(value, key.shape)
        return data

    def value(self, value: Any, shape: Shape) -> Any:
        write = _WRITERS.get(shape.__class__)
        return value if write is None else write(self, value, shape)

    def leaf(self, value: Any, shape: Leaf) -> Any:
        if isinstance(value, SpeedOf):
            return self.speed_of(value)
        if isinstance(value, OfLoad) and abs(value.whole) in self.wholes:
            measure = "speed" if shape.kind == "relative_speed" else "torque"
            return f"{value.given!r} {UNITS[measure]}"
        plain = _PLAIN.get(shape.kind)
        if plain is not None:
            return plain(value)
        if shape.kind == "link":
            return self.links[value]
        if shape.kind == "element":
            return self.elements[value]
        return f"{float(value)!r} {UNITS[shape.kind]}" if shape.kind in UNITS else value

    def speed_of(self, speed: SpeedOf) -> str:
        """The speed of another link; behind the word `link` no name is taken for anything else."""
        name = str(self.links[speed.link])
        link = name if _WORD.fullmatch(name) else f"link {name}"
        return link if speed.factor == 1 else f"{speed.factor!r}*{link}"

    def by_kind(self, value: Any, shape: ByKind) -> dict[str, Any]:
        return self.by_key(value, shape.records[value[shape.key]])

    def by_name(self, value: Any, shape: ByName) -> dict[str, Any]:
        return {str(name): self.value(item, shape.item) for name, item in value.items()}

    def either(self, value: Any, shape: Either) -> Any:
        data = self.by_key(value, shape.record)
        return data[shape.key] if shape.written and [*data] == [shape.key] else data

    def numbers(self, value: Any, shape: Numbers) -> dict[int | str, Any]:
        by = {"link": self.links, "shift element": self.elements, "mechanism": self.mechanisms}
        words = by[shape.by]
        return {words[part]: self.value(number, shape.item) for part, number in value.items()}

    def list_of(self, value: Any, shape: ListOf) -> list[Any]:
        return [self.value(item, shape.item) for item in value]

    def ends(self, value: Any, _: Ends) -> list[int | str]:
        return [self.links[link] for link in value]

    def row(self, value: Any, shape: RowOf) -> list[Any]:
        known = (*shape.items, *shape.optional)
        return [self.value(one, item) for one, item in zip(value, known, strict=False)]

    def by_law(self, value: Any, shape: ByLaw) -> Any:
        """A number, or a law as it was given; points of a file stand in the case."""
        if not isinstance(value, Law):
            return self.leaf(value, shape.scalar)
        points = [list(point) for point in value.points]
        if shape.row is None:
            return {"over": value.over, "points": points}
        return points or value.text

    def balance(self, value: BatteryBalance, shape: Balances) -> dict[int | str, Any]:
        data = self.numbers(dict(value.efficiencies), shape.links)
        return {**data, shape.power: self.leaf(value.battery, Leaf("power"))}

    def by_points(self, value: Any, shape: ByPoints) -> Any:
        """Points, or the number that holds everywhere; or by the keys of a mapping."""
        if hasattr(value, "_asdict"):
            return self.by_key(value, shape.mapping)
        rows = [self.row(one, shape.row) for one in value]
        return rows[0][1] if len(rows) == 1 and rows[0][0] == 0 else rows

    def pair(self, value: Any, _: Pair) -> list[str]:
        return [str(name) for name in value]


_WRITERS: Mapping[type, Callable[[_Writer, Any, Any], Any]] = {
    Leaf: _Writer.leaf,
    ByKey: _Writer.by_key,
    ByKind: _Writer.by_kind,
    ByName: _Writer.by_name,
    Either: _Writer.either,
    Numbers: _Writer.numbers,
    ListOf: _Writer.list_of,
    Ends: _Writer.ends,
    Pair: _Writer.pair,
    RowOf: _Writer.row,
    ByPoints: _Writer.by_points,
    ByLaw: _Writer.by_law,
    Balances: _Writer.balance,
}
"""How what a shape describes is written."""

_PLAIN: Mapping[str, Callable[[Any], Any]] = {
    **dict.fromkeys(
        ("number", "relative_speed", "relative_torque", "drag", *get_args(Measure)), float
    ),
    **dict.fromkeys(("text", "choice"), str),
    "flag": bool,
}
"""How a value is written that has no unit and is no name."""


def _dumper() -> type[yaml.SafeDumper]:
    """A dumper that writes texts of several lines as such, and no aliases."""
    import yaml

    class Dumper(yaml.SafeDumper):
        def ignore_aliases(self, data: Any) -> bool:
            del data
            return True

    def text(dumper: yaml.SafeDumper, data: str) -> yaml.ScalarNode:
        plain = printable(data, lines=True) == data  # else only quotes can hold its escapes
        style = ("|" if "\n" in data else None) if plain else '"'
        if data in {*"yYnN"}:  # true or false for strict readers of YAML 1.1, PyYAML writes it bare
            style = "'"
        return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=style)

    def on_one_line(dumper: yaml.SafeDumper, data: _OnOneLine) -> yaml.MappingNode:
        return dumper.represent_mapping("tag:yaml.org,2002:map", data, flow_style=True)

    Dumper.add_representer(str, text)
    Dumper.add_representer(_OnOneLine, on_one_line)
    return Dumper
