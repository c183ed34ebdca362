"""JSON Schema of plain data, of records by their types.

What `plain_data` makes of a record and what is said of it here follow from one declaration.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

Schema = dict[str, Any]

NUMBER: Schema = {"type": ["number", "null"]}
"""None where it does not exist."""
TEXT: Schema = {"type": "string"}
_SIMPLE: Mapping[Any, Schema] = {
    float: NUMBER,
    float | None: NUMBER,
    int: {"type": "integer"},
    bool: {"type": "boolean"},
    str: TEXT,
    NoneType: {"type": "null"},
}


def list_of(items: Schema) -> Schema:
    """An array."""
    return {"type": "array", "items": items}


def record(properties: Mapping[str, Schema], optional: Sequence[str] = ()) -> Schema:
    """An object with these keys and no others.

    >>> record({"a": TEXT, "b": NUMBER}, optional=["b"])["required"]
    ['a']
    """
    return {
        "type": "object",
        "properties": dict(properties),
        "required": [name for name in properties if name not in optional],
        "additionalProperties": False,
    }


def schema_of(kind: Any, /, **more: Schema) -> Schema:
    """The schema of what `plain_data` makes of a type.

    Parameters
    ----------
    kind : type
        A number, a text, a named tuple, or sequences, mappings and unions of these.
    **more
        Keys that a record has besides, or in place of its own.

    Examples
    --------
    >>> from vstatics.model.parts import Load
    >>> schema_of(Load)["properties"]["speed"], schema_of(tuple[int, ...])
    ({'type': ['number', 'null']}, {'type': 'array', 'items': {'type': 'integer'}})
    """
    if kind in _SIMPLE:
        return _SIMPLE[kind]
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin in (Union, UnionType):
        return {"anyOf": [schema_of(one) for one in arguments]}
    if hasattr(kind, "_fields"):
        hints = get_type_hints(kind)
        own = {name: schema_of(hints[name]) for name in kind._fields if name not in more}
        return record(own | more)
    if origin is not None and issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": schema_of(arguments[1])}
    if origin is not None and issubclass(origin, Sequence):
        return list_of(schema_of(arguments[0]))
    raise TypeError(f"no schema of {kind}")
