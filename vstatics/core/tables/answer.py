"""What a command answers is one record: its JSON and its JSON Schema follow from its types.

A record is a named tuple, its keys are its fields; `told` names others. One of a `form` is a
document, which begins with that. Types say what is not plain: `Sometimes`, `Flat`, `Failure`,
`Count`, `Known`. What does not exist is null.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, partial
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np

from vstatics.core.annexes import module, module_of_type
from vstatics.core.errors import Problem
from vstatics.core.statics.result_arrays import Message

T = TypeVar("T")
V = TypeVar("V")
Schema = dict[str, Any]
Answer = tuple[Any, ...] | dict[str, Any]
"""A record, or what is plain data already."""
VERSION = 1
"""Of every format of a document."""


class Words(dict[str, Any]):
    """What a schema says beside the type, as in ``Annotated[int, Words(minimum=0)]``."""

    __hash__ = object.__hash__  # type: ignore[assignment] # of a type it is a part


class Provided(str):
    """Name of a type that an annex provides, as in ``Annotated[object, Provided("Damages")]``."""

    __slots__ = ()


SOMETIMES, FLAT, FAILURE, UNFAILED = _MARKS = ("sometimes", "flat", "failure", "unfailed")
Sometimes = Annotated[T | None, SOMETIMES]
"""Of a key that is left out where it is None, or an empty mapping."""
Flat = Annotated[T, FLAT]
"""Of a record whose keys stand among those of the record that has it."""
Failure = Annotated[str, FAILURE]
"""Of a key that stands beside the first one in place of all others, unless it is empty."""
Unfailed = Annotated[T | None, UNFAILED]
"""Of a key that is None only where a failure stands in its place."""
Count = Annotated[int, Words(minimum=0)]
Known = Annotated[float, Words(type="number")]
"""Of a number that always exists."""

NUMBER: Schema = {"type": ["number", "null"]}
"""None where it does not exist."""
TEXT: Schema = {"type": "string"}
NULL: Schema = {"type": "null"}
_SIMPLE: Mapping[Any, Schema] = {
    float: NUMBER,
    float | None: NUMBER,
    int: {"type": "integer"},
    bool: {"type": "boolean"},
    str: TEXT,
    complex: {
        "type": "object",
        "properties": {"real": NUMBER, "imag": NUMBER},
        "required": ["real", "imag"],
        "additionalProperties": False,
    },
    Message: TEXT,
    NoneType: NULL,
    Any: {},
}
_FORMS: dict[Any, str] = {}
_TOLD: dict[Any, Mapping[str, str]] = {}
_DEFINED: dict[Any, str] = {}


def document(form: str) -> Callable[[T], T]:
    """Make a record a document of a format.

    >>> from typing import NamedTuple
    >>> @document("vstatics-steps")
    ... class Steps(NamedTuple):
    ...     case: str
    ...     count: int
    ...     notes: Sometimes[Sequence[str]] = None
    >>> plain_data(Steps("box", 2))
    {'format': 'vstatics-steps', 'version': 1, 'case': 'box', 'count': 2}
    >>> schema(Steps)["required"]
    ['format', 'version', 'case', 'count']
    """
    return _kept(_FORMS, form)


def defined(name: str) -> Callable[[T], T]:
    """Say that the schema of a record stands by itself, and others refer to it."""
    return _kept(_DEFINED, name)


def told(*names: str, **attributes: str) -> Callable[[T], T]:
    """Say which attributes of a record are its keys, in their order, in place of its fields.

    Parameters
    ----------
    **attributes
        By key, where it has another name; a last underscore of a key is left out.
    """
    others = {key.rstrip("_"): name for key, name in attributes.items()}
    return _kept(_TOLD, dict(zip(names, names, strict=True)) | others)


def _kept(where: dict[Any, V], value: V) -> Callable[[T], T]:
    def keep(kind: T) -> T:
        where[kind] = value
        return kind

    return keep


class _Key(NamedTuple):
    """A key of a record."""

    name: str
    attribute: str
    kind: Any
    mark: str


@cache
def _keys(kind: Any) -> Sequence[_Key]:
    """The keys of a kind of record."""
    hints, found = get_type_hints(kind, include_extras=True), []
    own = {one.rstrip("_"): one for one in kind._fields}
    for name, attribute in _TOLD.get(kind, own).items():
        if attribute not in hints:  # a property
            returned = get_type_hints(getattr(kind, attribute).fget, include_extras=True)
            hints[attribute] = returned["return"]
        one, mark = hints[attribute], ""
        if get_origin(one) is Annotated and get_args(one)[1] in _MARKS:
            one, mark = get_args(one)
            if NoneType in get_args(one):
                one = Union[tuple(part for part in get_args(one) if part is not NoneType)]  # noqa: UP007
        found.append(_Key(name, attribute, one, mark))
    return found


def plain_data(value: Any) -> Any:
    """A record as mappings, lists, texts and numbers, in any depth; None is what does not exist.

    Of an array of complex numbers their moduli are told.

    >>> from vstatics.core.model.parts import Load
    >>> plain_data({"load": Load(2000.0), "steps": (1.5, math.nan), "root": 1 - 2j})
    {'load': {'speed': 2000.0, 'torque': None, 'power': None}, 'steps': [1.5, None], \
'root': {'real': 1.0, 'imag': -2.0}}
    """
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Message):
        return str(value)
    if hasattr(value, "_fields"):
        return _of_record(value)
    if isinstance(value, complex):
        value = {"real": value.real, "imag": value.imag}
    if isinstance(value, Mapping):
        return {key: plain_data(one) for key, one in value.items()}
    if isinstance(value, np.ndarray):
        value = (np.abs(value) if np.iscomplexobj(value) else value).tolist()
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain_data(one) for one in value]
    return value


def _of_record(record: Any) -> dict[str, Any]:
    kind: Any = type(record)
    values = [(key, getattr(record, key.attribute)) for key in _keys(kind)]
    failed = [(key, value) for key, value in values if key.mark == FAILURE and value]
    found = {"format": _FORMS[kind], "version": VERSION} if kind in _FORMS else {}
    for key, value in [values[0], *failed] if failed else values:
        if key.mark == FLAT:
            found |= plain_data(value)
        elif not (key.mark == FAILURE and not value) and not (
            key.mark == SOMETIMES and (value is None or value == {})
        ):
            found[key.name] = plain_data(value)
    return found


def with_file(answer: Answer, file: str, *, folders: bool = False) -> dict[str, Any]:
    """A document as plain data that tells the file of its case, without folders or with them.

    An answer of no format is as it is; that of a case in error has its file already.

    >>> with_file({"format": "f", "version": 1, "case": {}}, "cases/box.yaml")
    {'format': 'f', 'version': 1, 'file': 'box.yaml', 'case': {}}
    """
    data = answer if isinstance(answer, dict) else plain_data(answer)
    front: dict[str, Any] = {key: data[key] for key in ("format", "version") if key in data}
    name = file if folders else os.path.basename(file)  # noqa: PTH119
    if "errors" in data:
        return {**data, "file": name}
    return {**front, "file": name, **data} if front else data


def text(value: Any) -> str:
    """Plain data as JSON on many lines, without the end of the last."""
    return _lines(value)


def line(value: Any) -> str:
    """Plain data as JSON on one line, with its end."""
    return _line(value) + "\n"


def as_json(answer: Answer, form: str | None) -> str:
    """An answer as JSON on many lines, or on one in the form `jsonl`, with its end."""
    data = answer if isinstance(answer, dict) else plain_data(answer)
    return line(data) if form == "jsonl" else text(data) + "\n"


_lines = json.JSONEncoder(ensure_ascii=False, allow_nan=False, indent=1).encode
_line = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode


def list_of(items: Schema) -> Schema:
    """The schema of an array."""
    return {"type": "array", "items": items}


def object_of(properties: Mapping[str, Schema], optional: Sequence[str] = ()) -> Schema:
    """The schema of an object with these keys and no others.

    >>> object_of({"a": TEXT, "b": NUMBER}, optional=["b"])["required"]
    ['a']
    """
    return {
        "type": "object",
        "properties": dict(properties),
        "required": [name for name in properties if name not in optional],
        "additionalProperties": False,
    }


def schema(kind: Any, definitions: Schema | None = None) -> Schema:
    """The schema of what `plain_data` makes of a type.

    Parameters
    ----------
    kind : type
        A number, a text, a record, or sequences, mappings and unions of these.
    definitions : dict, optional
        Gets those of records that are `defined`.

    Examples
    --------
    >>> from vstatics.core.model.parts import Load
    >>> schema(Load)["properties"]["speed"], schema(tuple[int, ...])
    ({'type': ['number', 'null']}, {'type': 'array', 'items': {'type': 'integer'}})
    """
    if kind in _SIMPLE:
        return _SIMPLE[kind]
    if hasattr(kind, "_fields"):
        made = _of_keys(kind, definitions)
        if kind not in _DEFINED or definitions is None:
            return made
        definitions[_DEFINED[kind]] = made
        return {"$ref": f"#/$defs/{_DEFINED[kind]}"}
    return _of_parts(kind, partial(schema, definitions=definitions))


def _of_parts(kind: Any, of: Callable[[Any], Schema]) -> Schema:
    """The schema of a type that is made of others."""
    origin, (first, *others) = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _of_marked(first, others[0], of)
    if origin is Literal:
        return {"enum": [first, *others]}
    if origin in (Union, UnionType):
        return _either(of(first), *map(of, others))
    if issubclass(origin, Mapping):
        more = {} if others[0] is Any else {"additionalProperties": of(others[0])}
        return {"type": "object", **more}
    return list_of(NUMBER if origin is np.ndarray else of(first))


def _of_marked(kind: Any, mark: Any, of: Callable[[Any], Schema]) -> Schema:
    """The schema of an annotated type; nothing is valid where an annex is not installed."""
    if isinstance(mark, Provided):
        declaring = module_of_type(mark)
        return of(getattr(module(declaring), mark)) if declaring else {"not": {}}
    if isinstance(mark, dict):
        return of(kind) | mark
    return of(kind) if mark in _MARKS else {"enum": [*mark]}


def _either(first: Schema, *others: Schema) -> Schema:
    """One of some; of null beside a text or a whole number both types are told at once."""
    if others == (NULL,) and first.get("type") in ("string", "integer"):
        return first | {"type": [first["type"], "null"]}
    return {"anyOf": [first, *others]}


def _of_keys(kind: Any, definitions: Schema | None) -> Schema:
    """The schema of a record."""
    properties = head(_FORMS[kind]) if kind in _FORMS else {}
    optional: list[str] = []
    failed: Schema = {}
    for key in _keys(kind):
        own = schema(key.kind, definitions)
        if key.mark == FAILURE:
            first = next(iter(properties))
            failed = object_of({first: properties[first], key.name: own})
            asked = {"required": [key.name]}
        elif key.mark == FLAT:
            properties |= own["properties"]
            optional += own["properties"].keys() - own["required"]
        else:
            properties[key.name] = own
            optional += [key.name] * (key.mark == SOMETIMES)
    made = object_of(properties, optional)
    return {"if": asked, "then": failed, "else": made} if failed else made


def head(form: str) -> Schema:
    """The schema of the keys with which every document begins."""
    return {"format": {"const": form}, "version": {"const": VERSION}}


def of_file(name: str, title: str, one: Schema) -> Schema:
    """The schema of a file, by that of what it has."""
    start = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {**start, "$id": f"{name}.schema.json", "title": title, **one}


def documents(name: str, title: str, one: Schema, definitions: Schema | None = None) -> Schema:
    """The schema of a file: a document, or several as an array; any may be a case in error.

    Parameters
    ----------
    name : str
        Of the format: that of the file is made of it.
    one : dict
        The schema of a document, without its `file`.
    definitions : dict, optional
        What it refers to by ``#/$defs/...``.
    """
    about = "The file of the case, without folders; with those of the path as found where"
    file = {"type": "string", "description": f"{about} several of an output have one name."}
    properties = {**one["properties"], "file": file}
    failure = {
        "title": "case in error",
        **object_of({"file": file, "case": TEXT, "errors": list_of(TEXT)}, optional=["file"]),
    }
    entry = {
        "if": {"type": "object", "required": ["errors"]},
        "then": {"$ref": "#/$defs/failure"},
        "else": {"$ref": "#/$defs/document"},
    }
    choice = {
        "if": {"type": "array"},
        "then": {"items": {"$ref": "#/$defs/entry"}},
        "else": {"$ref": "#/$defs/entry"},
        "$defs": {
            "entry": entry,
            "document": {**one, "properties": properties},
            "failure": failure,
            **(definitions or {}),
        },
    }
    return of_file(name, title, choice)


def documents_of(name: str, title: str, kind: Any) -> Schema:
    """The schema of documents of a kind, as `documents`."""
    definitions: Schema = {}
    return documents(name, title, schema(kind, definitions), definitions)


def failure(file: str, problems: Iterable[Problem]) -> dict[str, Any]:
    """The document of a case in error."""
    return {"file": os.path.basename(file), "case": file, "errors": list(map(str, problems))}  # noqa: PTH119
