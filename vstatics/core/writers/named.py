"""Writers of cases as YAML and JSON. Reading the text gives an equal case."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, get_args

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import printable
from vstatics.core.model.checks import carried_keys
from vstatics.core.model.keys import CASE, MAP, with_carried
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
from vstatics.core.readers.signs import with_escaped_blanks, with_plain_blanks

if TYPE_CHECKING:
    import yaml

_WORD = re.compile(r"[^\W\d]\w*")


class _OnOneLine(dict[str, Any]):
    """Mapping that YAML writes on a single line, in braces."""


def mapping(case: Transmission, *, units: bool = True) -> dict[str, Any]:
    """Convert a case to a mapping of plain data with the keys of YAML and JSON.

    Keys with the default value are omitted.

    Parameters
    ----------
    case : Transmission
    units : bool
        True to write units if the user gave them, so that a new operating point does not change the
        values. False to write values relative to the input speed or torque.

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
        values["elements"] = {element.name: record_of(element) for element in drawing.elements}
    wholes = {math.inf, *_wholes(case)} if units else {math.inf}
    if not units:
        values |= _drag_by_gear(case)
    links, own_links = _link_words(case), case.own_links
    values["links"] = own_links if links[1] == 1 else links[1 : own_links + 1]
    values["output"] = None if case.outputs or case.output == own_links else case.output
    for part in ("shift_elements", "mechanisms", "gears"):
        values[part] = {item.name: item for item in values[part]}
    sets = values["mechanisms"]  # only mechanisms that are not part of a gear set
    values["mechanisms"] = {name: mechanism_record(part) for name, part in sets.items()}
    values["springs"] = {spring.name: spring_record(spring) for spring in case.springs}
    values["converters"] = {
        part.name: {"links": part.links, "points": part.points} for part in case.converters
    }
    if carried := carried_keys(case):
        shape = with_carried(shape, carried)
        values |= {key.shape.name: key.record(case) for key in carried}
    order = _CASE if shape is CASE else _as_written(shape)
    ratios = ["", *sets, *values["converters"]]
    writer = _Writer(links, ["", *values["shift_elements"]], ratios, wholes)
    return writer.by_key(values, order)


def write_yaml(case: Transmission) -> str:
    """Write a case as YAML; see `mapping`."""
    import yaml  # costs start-up time

    data = mapping(case)
    data["gears"] = {name: _OnOneLine(gear) for name, gear in data["gears"].items()}
    if "shift_elements" in data:
        data["shift_elements"] = {
            name: _OnOneLine(element) if isinstance(element, dict) else element
            for name, element in data["shift_elements"].items()
        }
    written: str = yaml.dump(
        data,
        Dumper=_dumper(),
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=None,
        width=100,
    )
    return with_escaped_blanks(written)


def write_json(case: Transmission) -> str:
    """Write a case as JSON; see `mapping`."""
    import json  # costs start-up time

    return with_escaped_blanks(json.dumps(mapping(case), indent=2, ensure_ascii=False)) + "\n"


def _wholes(case: Transmission) -> set[float]:
    """Return the magnitudes of the speeds and torques of all operating points.

    A number relative to another value is written without a unit, because no operating point could
    convert it back when the case is read.
    """
    loads = [case.load, *(gear.load and case.gear_load(gear) for gear in case.gears)]
    return {size for load in loads if load for size in (load.torque_size, abs(load.speed or 0.0))}


def _drag_by_gear(case: Transmission) -> dict[str, Any]:
    """Return the gears for writing, with all drags relative to the operating point of each gear."""
    gears = []
    for gear, with_drag in zip(case.gears, case.gears_with_drag, strict=True):
        dragging = {
            n: drag for n, drag in with_drag.open_drag.items() if drag or n in gear.open_drag
        }
        gears.append(with_drag._replace(open_drag=dragging))
    elements = [element._replace(drag=0.0) for element in case.shift_elements]
    return {"drag": {}, "shift_elements": elements, "gears": gears}


def _link_words(case: Transmission) -> list[int | str]:
    """Return links as written, housing first: by name or, without names, by number."""
    own_links = case.own_links
    if list(case.link_names[:own_links]) == [str(number) for number in range(1, own_links + 1)]:
        return ["housing", *range(1, case.links + 1)]
    return ["housing", *map(str, case.link_names)]


def _as_written(case: ByKey) -> ByKey:
    """Return the declaration of a case with keys in the order in which they are written."""
    keys = {key.name: key for key in case.keys}
    load = keys.pop("load")
    position = [*keys].index("coast") + 1
    ordered = [*keys.values()]
    return case._replace(keys=(*ordered[:position], load, *ordered[position:]))


_CASE = _as_written(CASE)


class _Writer(NamedTuple):
    """Converter of parts of the model to plain data of the declared shapes.

    Its fields contain the names of links, shift elements and mechanisms in the text, by number.
    """

    links: Sequence[int | str]
    elements: Sequence[str]
    mechanisms: Sequence[str]
    wholes: Collection[float]
    """Speeds and torques of operating points. Values relative to these are written with a unit."""

    def by_key(self, part: Any, shape: ByKey) -> dict[str, Any]:
        """Return the keys and values of a part or mapping, without default values."""
        values = part if isinstance(part, dict) else None
        data: dict[str, Any] = {}
        for key in shape.keys:
            value = getattr(part, key.name, None) if values is None else values.get(key.name)
            # A value with a unit is written even if it equals the default, because it can be 0 only
            # for lack of an operating point.
            is_written = key.required or isinstance(value, OfLoad) or not key.leaves_out(value)
            if key.name == "torque" and getattr(part, "power", None) is not None:
                is_written = False  # the power determines the torque
            if value is not None and is_written:
                data[key.name] = self.value(value, key.shape)
        return data

    def value(self, value: Any, shape: Shape) -> Any:
        write = _WRITERS.get(shape.__class__)
        return value if write is None else write(self, value, shape)

    def leaf(self, value: Any, shape: Leaf) -> Any:
        if isinstance(value, SpeedOf):
            return self.speed_of(value)
        if isinstance(value, OfLoad) and abs(value.whole) in self.wholes:
            measure = "speed" if shape.kind in ("relative_speed", "slip") else "torque"
            return f"{value.given!r} {UNITS[measure]}"
        plain = _PLAIN.get(shape.kind)
        if plain is not None:
            return plain(value)
        words = {"link": self.links, "element": self.elements, "converter": self.mechanisms}
        if shape.kind in words:
            return words[shape.kind][value]
        return f"{float(value)!r} {UNITS[shape.kind]}" if shape.kind in UNITS else value

    def speed_of(self, speed: SpeedOf) -> str:
        """Write a speed relative to a link. The word `link` precedes ambiguous names."""
        name = str(self.links[speed.link])
        link = name if _WORD.fullmatch(name) else f"link {name}"
        return link if speed.factor == 1 else f"{speed.factor!r}*{link}"

    def by_kind(self, value: Any, shape: ByKind) -> dict[str, Any]:
        return self.by_key(value, shape.records[value[shape.key]])

    def by_name(self, value: Any, shape: ByName) -> dict[str, Any]:
        return {str(name): self.value(item, shape.item) for name, item in value.items()}

    def either(self, value: Any, shape: Either) -> Any:
        if isinstance(value, float) and isinstance(shape.short, Leaf):
            return self.leaf(value, shape.short)
        data = self.by_key(value, shape.record)
        return data[shape.key] if shape.written and [*data] == [shape.key] else data

    def numbers(self, value: Any, shape: Numbers) -> dict[int | str, Any]:
        names = {"link": self.links, "shift element": self.elements, "mechanism": self.mechanisms}
        words = names[shape.by]
        return {words[part]: self.value(number, shape.item) for part, number in value.items()}

    def list_of(self, value: Any, shape: ListOf) -> list[Any]:
        return [self.value(item, shape.item) for item in value]

    def ends(self, value: Any, _: Ends) -> list[int | str]:
        return [self.links[link] for link in value]

    def row(self, value: Any, shape: RowOf) -> list[Any]:
        shapes = shape.shapes(len(value))
        return [
            self.value(item, item_shape) for item, item_shape in zip(value, shapes, strict=True)
        ]

    def by_law(self, value: Any, shape: ByLaw) -> Any:
        """Write a number or a law. Points from a file are written in full."""
        if not isinstance(value, Law):
            return value if shape.scalar is None else self.leaf(value, shape.scalar)
        if value.text:
            return value.text
        if value.over == "both":
            return self.map_law(value, shape.mapping)
        points = [list(point) for point in value.points]
        return {"over": value.over, "points": points} if shape.row is None else points

    def map_law(self, value: Any, shape: ByKey | ByKind) -> dict[str, Any]:
        """Write a map over speed and torque in SI units."""
        record = shape.records[MAP] if isinstance(shape, ByKind) else shape
        words = {"over": ("speed", "torque"), "columns": value.columns, "rows": value.rows}
        return self.by_key({**words, "unit": value.unit or None}, record)

    def balance(self, value: BatteryBalance, shape: Balances) -> dict[int | str, Any]:
        data = self.numbers(dict(value.efficiencies), shape.links)
        return {**data, shape.power: self.leaf(value.battery, Leaf("power"))}

    def by_points(self, value: Any, shape: ByPoints) -> Any:
        """Write a curve: points, a constant number, or the keys of a mapping."""
        if hasattr(value, "_asdict"):
            return self.by_key(value, shape.mapping)
        rows = [self.row(point, shape.row) for point in value]
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
"""Method that writes a value, by the type of the shape."""

_PLAIN: Mapping[str, Callable[[Any], Any]] = {
    **dict.fromkeys(
        ("number", "relative_speed", "relative_torque", "slip", "drag", "efficiency"),
        float,
    ),
    **dict.fromkeys(get_args(Measure), float),
    **dict.fromkeys(("text", "choice"), str),
    "flag": bool,
}
"""Type of plain values in a document, by kind of the declared value."""


def _dumper() -> type[yaml.SafeDumper]:
    import yaml

    class Dumper(yaml.SafeDumper):
        def ignore_aliases(self, data: Any) -> bool:
            del data
            return True

    def text(dumper: yaml.SafeDumper, data: str) -> yaml.ScalarNode:
        # other texts need escapes, and therefore quotes
        plain = printable(data, lines=True) == data == with_plain_blanks(data)
        style = ("|" if "\n" in data else None) if plain else '"'
        if data in {*"yYnN"}:  # in YAML 1.1 these mean true or false
            style = "'"
        return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=style)

    Dumper.add_representer(str, text)
    Dumper.add_representer(
        _OnOneLine,
        lambda dumper, data: dumper.represent_mapping(
            "tag:yaml.org,2002:map", data, flow_style=True
        ),
    )
    return Dumper
