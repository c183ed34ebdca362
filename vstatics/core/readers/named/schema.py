"""JSON Schema of a case, generated from the declared shape."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, get_args

from vstatics.core.elements.keys import with_elements
from vstatics.core.model.carried import installed_keys
from vstatics.core.model.keys import CASE, EFFICIENCY, with_carried, with_masses
from vstatics.core.model.shape import (
    STRAIGHT,
    UNIT_OF,
    Balances,
    ByForm,
    ByKey,
    ByKind,
    ByLaw,
    ByName,
    ByPoints,
    Either,
    Ends,
    KeyShape,
    Leaf,
    Links,
    ListOf,
    Measure,
    Numbers,
    OneOrMany,
    Pair,
    Parsed,
    RowOf,
    Shape,
    Shares,
)
from vstatics.core.model.torsional_keys import DAMPING
from vstatics.core.readers.named.arithmetic import ARITHMETIC
from vstatics.core.readers.named.compounds import BARE
from vstatics.core.readers.named.scalars import LINK_NUMBER, NUMBER
from vstatics.core.readers.named.si_units import WITH_UNIT
from vstatics.core.readers.named.units import QUANTITY

Words = dict[str, Any]

_DAMPING, _EFFICIENCY = "any_damping", "efficiency"
_IN_NO_CASE = frozenset(("time", *STRAIGHT.values()))
_IN_NO_CASE -= {"length", "force", "velocity"}
"""Measures that occur only in scenarios."""
_NAME: Words = {"type": ["string", "integer"], "minLength": 1}
_DEFINITIONS: dict[str, Words] = {
    "link": {
        "title": "Link",
        "description": "Number or name of a link; 0 and `housing` are the housing.",
        "type": ["integer", "string"],
        "minimum": 0,
        "minLength": 1,
    },
    "number": {
        "title": "Number",
        "description": "A number, or a fraction of two such as -96/39.",
        "type": ["number", "string"],
        "pattern": NUMBER,
    },
}

_GIVEN: Words = {"not": {"type": "null"}}
_TWO_LINKS: Words = {"minimum": 2, "minItems": 2}
_NOT_EMPTY: Words = {"minProperties": 1}
_ROW: Words = {"type": "array", "items": {"type": ["number", "string", "boolean", "null"]}}
_BARE: Words = {"type": ["number", "string"], "pattern": f"^{BARE}$"}
_POINTS: Words = {
    "anyOf": [{"items": _ROW}, {"items": {"anyOf": [_ROW, _BARE]}, "minItems": 2}],
}
"""Lists that are read as a single list of points, see `compounds.read_one_or_many`."""
_GEARS: tuple[Words, ...] = (
    {"required": ["gears"], "properties": {"gears": {**_GIVEN, **_NOT_EMPTY}}},
    {"properties": {"shift_elements": {"maxProperties": 0}}},
)
"""Conditions on the gears: at least one gear; or no shift elements, which implies a single gear."""
_ENOUGH: tuple[Words, ...] = (
    {"required": ["elements"], "properties": {"links": _TWO_LINKS}, "anyOf": [*_GEARS]},
    {
        "required": ["links", "mechanisms"],
        "properties": {"links": {**_GIVEN, **_TWO_LINKS}, "mechanisms": _GIVEN},
        "anyOf": [*_GEARS],
    },
    *(
        {"required": [key], "properties": {key: {**_GIVEN, **_NOT_EMPTY}}}
        for key in ("springs", "inertias", "masses")
    ),
)
"""Smallest sets of keys that define a case."""
_WITH_ELEMENTS: Words = {
    "properties": {"elements": _GIVEN},
    "allOf": [
        {
            "anyOf": [
                {"required": [key], "properties": {key: _GIVEN}}
                for key in ("links", end, f"{end}s")
            ]
        }
        for end in ("input", "output")
    ],
}
"""A case with gear sets names its input and output, or lists its links."""


def json_schema() -> Words:
    """Return the JSON Schema (draft 2020-12) of a case in YAML or JSON.

    A schema cannot check the names of links and shift elements.

    Examples
    --------
    >>> [condition["required"] for condition in json_schema()["anyOf"]]
    [['elements'], ['links', 'mechanisms'], ['springs'], ['inertias'], ['masses']]
    """
    shape = with_elements(with_masses(with_carried(CASE, installed_keys())))
    measures = [name for name in get_args(Measure) if name not in _IN_NO_CASE]
    schema = document_schema(shape, measures)
    damping = {"anyOf": [_reference("damping"), _record(DAMPING.record)]}
    several = {_DAMPING: damping, _EFFICIENCY: _of_law(EFFICIENCY)}
    definitions = schema.pop("$defs") | several  # definitions come last
    needed = {"anyOf": list(_ENOUGH), "dependentSchemas": {"elements": _WITH_ELEMENTS}}
    return {**schema, **needed, "$defs": definitions}


def document_schema(shape: ByKey, measures: Iterable[Measure]) -> Words:
    """Return the JSON Schema of a document with the given shape."""
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", **_record(shape)}
    return {**schema, "$defs": {**_DEFINITIONS, **{name: _measure(name) for name in measures}}}


def _measure(name: Measure) -> Words:
    return {
        "title": name.removeprefix("si_").capitalize(),
        "description": f"Bare in {UNIT_OF[name]}, or with its unit.",
        "type": ["number", "string"],
        "pattern": f"^{ARITHMETIC}$|{WITH_UNIT}",
    }


def _reference(name: str) -> Words:
    return {"$ref": f"#/$defs/{name}"}


def _record(shape: ByKey) -> Words:
    words: Words = {
        "title": shape.title,
        "description": shape.description,
        "type": "object" if shape.required else ["object", "null"],
        "properties": {key.name: _key(key) for key in shape.keys},
        "additionalProperties": False,
    }
    for key in shape.keys:
        if key.unless:
            words["anyOf"] = [{"required": [key.name]}, {"required": [key.unless]}]
    return {**words, "required": shape.required} if shape.required else words


def _key(key: KeyShape) -> Words:
    words = {"description": key.description, **_shape(key.shape), **key.limits}
    if key.default is not None:
        words["default"] = key.default
    if key.examples:
        words["examples"] = list(key.examples)
    return words if key.required else _optional(words)


def _optional(words: Words) -> Words:
    """Return a schema that also permits null, which makes an optional key count as missing."""
    if "anyOf" in words:
        return {**words, "anyOf": [*words["anyOf"], {"type": "null"}]}
    if "$ref" in words:
        reference = {"$ref": words.pop("$ref")}
        return {**words, "anyOf": [reference, {"type": "null"}]}
    if "enum" in words:
        return {**words, "enum": [*words["enum"], None]}
    types = words["type"] if isinstance(words["type"], list) else [words["type"]]
    return {**words, "type": [*dict.fromkeys([*types, "null"])]}


def _shape(shape: Shape) -> Words:  # noqa: PLR0911, PLR0912, C901 - a table
    match shape:
        case ByKey():
            return _record(shape)
        case ByName():
            return _by_name(_shape(shape.item))
        case Links() | Ends() | ListOf() | Pair() | RowOf():
            return _sequence(shape)
        case Either() if shape is DAMPING:
            return _reference(_DAMPING)  # used by many keys
        case Either():
            return {"anyOf": [_shape(shape.short), _record(shape.record)]}
        case ByPoints():
            return _forms(shape.row.items[-1], _points(shape.row), shape.mapping)
        case ByLaw() if shape is EFFICIENCY:
            return _reference(_EFFICIENCY)
        case Balances() | ByLaw():
            return _of_law(shape)
        case Parsed():
            return {"type": ["number", "string"]}
        case ByForm():
            return _forms(shape.scalar, shape.listing, shape.mapping)
        case OneOrMany():
            item = _shape(shape.item)
            several = {"type": "array", "items": item, "minItems": 1, "not": _POINTS}
            return {"anyOf": [*item["anyOf"], several]}
        case ByKind():
            kinds = [_of_kind(shape, kind) for kind in shape.records]
            return {"oneOf": kinds} if len(kinds) > 1 else kinds[0]
        case Numbers():
            return _by_name({**_shape(shape.item), **shape.limits})
        case Shares():
            return _by_name(_leaf(Leaf("share")))
        case Leaf():
            return _leaf(shape)


def _sequence(shape: Links | Ends | ListOf | Pair | RowOf) -> Words:
    """Return the schema of a list of items."""
    match shape:
        case Links():
            number: Words = {"type": ["integer", "string", "array"], "minimum": 1}
            names: Words = {"items": _NAME, "minItems": 1, "uniqueItems": True}
            return {**number, "pattern": LINK_NUMBER, **names}
        case Ends():
            items = {"items": _reference("link"), "minItems": shape.least, "maxItems": 2}
        case ListOf():
            unique = {"uniqueItems": True} if shape.kind and shape.unique else {}
            items = {"items": _shape(shape.item), **unique}
        case Pair():
            items = {"items": _NAME, "minItems": 2, "maxItems": 2}
        case RowOf():
            known = [_shape(item) for item in (*shape.items, *shape.optional)]
            last = {"maxItems": len(known)} if shape.more is None else {"items": _shape(shape.more)}
            items = {"prefixItems": known, "minItems": len(shape.items), **last}
    return {"type": "array", **items}


def _of_law(shape: Balances | ByLaw) -> Words:
    """Return the schema of a number or a law, or of a battery balance."""
    if isinstance(shape, Balances):
        words = _by_name(_shape(shape.links.item))
        return {**words, "properties": {shape.power: _leaf(Leaf("power"))}}
    return _forms(shape.scalar, shape.row and _points(shape.row), shape.mapping)


def _points(row: RowOf) -> Words:
    return {**_shape(ListOf(row)), "minItems": 1}


def _forms(*forms: Shape | Words | None) -> Words:
    """Return the schema of a value with several forms, none of which is null."""
    given = [form if isinstance(form, dict) else _shape(form) for form in forms if form]
    given = [{**words, "type": "object"} if "properties" in words else words for words in given]
    return {"anyOf": given} if len(given) > 1 else given[0]


def _of_kind(shape: ByKind, kind: str) -> Words:
    record = shape.records[kind]
    words = _record(record)
    name = kind.strip("[]").split(", ") if kind.startswith("[") else kind
    key = words["properties"].get(shape.key)
    described = {"description": key["description"]} if key else {}
    words["properties"][shape.key] = {**described, "const": name}
    return {**words, "type": "object", "required": [*dict.fromkeys([shape.key, *record.required])]}


def _by_name(item: Words) -> Words:
    return {
        "type": "object",
        "propertyNames": {"minLength": 1},
        "additionalProperties": item,
    }


def _leaf(shape: Leaf) -> Words:  # noqa: PLR0911 - a table
    match shape.kind:
        case "share":
            return {**_reference("number"), "minimum": 0}
        case "count":
            return {"type": ["integer", "string"], "minimum": 1, "pattern": LINK_NUMBER}
        case "relative_speed" | "drag" | "efficiency":
            return {"type": ["number", "string"]}  # a text is `FACTOR * LINK`, or a formula
        case "relative_torque" | "slip":
            return {"type": ["number", "string"], "pattern": f"{NUMBER}|{QUANTITY}"}
        case "speed" | "torque" | "power":
            return {"type": "string", "pattern": QUANTITY}
        case "flag":
            return {"type": "boolean"}
        case "choice":
            return {"enum": list(shape.choices)}
        case "element" | "converter":
            return dict(_NAME)
        case "text":
            return {"type": ["string", "number", "boolean"]}
    return _reference(shape.kind)  # kinds shared by many keys: a number, a link, a measure
