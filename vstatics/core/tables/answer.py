"""Records: outputs of commands, whose JSON and JSON Schema follow from the types of fields.

A record is a named tuple. Its keys in JSON are its fields, unless `json_keys` names other
attributes. A `document` begins with the keys of `head`. Annotations describe special keys:
`Sometimes`, `Asked`, `Flat`, `Failure`, `Unfailed`, `Count`, `Known`. A missing value is null.
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
from vstatics.core.extras import __version__
from vstatics.core.statics.result_arrays import Message

T = TypeVar("T")
V = TypeVar("V")
Schema = dict[str, Any]
Answer = tuple[Any, ...] | dict[str, Any]
"""Output of a command: a record, or plain data."""
VERSION = 2
"""Version of the format of documents."""
PROGRAM = f"vstatics {__version__}"
"""Name and version of the program that writes a document."""


class Words(dict[str, Any]):
    """Keywords of JSON Schema for a type, as in ``Annotated[int, Words(minimum=0)]``."""

    __hash__ = object.__hash__  # type: ignore[assignment] # arguments of a type are hashed


class Provided(str):
    """Name of a type of an annex, as in ``Annotated[object, Provided("Damages")]``."""

    __slots__ = ()


SOMETIMES, ASKED, FLAT, FAILURE, UNFAILED = _MARKS = (
    *("sometimes", "asked", "flat", "failure", "unfailed"),
)
Sometimes = Annotated[T | None, SOMETIMES]
"""Type of a key that is omitted if its value is null or an empty mapping."""
Asked = Annotated[T | None, ASKED]
"""Type of a key that is omitted if its value is null, but not if it is an empty mapping."""
Flat = Annotated[T, FLAT]
"""Type of a record whose keys become keys of the surrounding record."""
Failure = Annotated[str, FAILURE]
"""Type of an error message.

If the message is not empty, a record consists of its first key, the message, and empty lists and
mappings. Programs can therefore iterate over the lists and mappings of every record.
"""
Unfailed = Annotated[T | None, UNFAILED]
"""Type of a key whose value is null only in records with a `Failure`."""
Count = Annotated[int, Words(minimum=0)]
Known = Annotated[float, Words(type="number")]
"""Type of a number that is never null."""

NUMBER: Schema = {"type": ["number", "null"]}
"""Schema of a number, or of null for a missing number."""
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
_JSON_KEYS: dict[Any, Mapping[str, str]] = {}
_DEFINED: dict[Any, str] = {}


def document(form: str) -> Callable[[T], T]:
    """Return a decorator that declares a record as a document of the format `form`.

    >>> from typing import NamedTuple
    >>> @document("vstatics-steps")
    ... class Steps(NamedTuple):
    ...     case: str
    ...     count: int
    ...     notes: Sometimes[Sequence[str]] = None
    >>> list(plain_data(Steps("box", 2)).items())[2:]
    [('program', 'vstatics 0.1.0'), ('case', 'box'), ('count', 2)]
    >>> schema(Steps)["required"]
    ['format', 'version', 'program', 'case', 'count']
    """
    return _registering(_FORMS, form)


def defined(name: str) -> Callable[[T], T]:
    """Return a decorator for records to which schemas refer by name."""
    return _registering(_DEFINED, name)


def json_keys(*names: str, **attributes: str) -> Callable[[T], T]:
    """Return a decorator that declares which attributes of a record are its keys.

    Parameters
    ----------
    *names
        Attributes whose names are the keys.
    **attributes
        Further attributes, by key. A final underscore of the key is removed.
    """
    renamed = {key.rstrip("_"): name for key, name in attributes.items()}
    return _registering(_JSON_KEYS, dict(zip(names, names, strict=True)) | renamed)


def _registering(registry: dict[Any, V], value: V) -> Callable[[T], T]:
    def register(kind: T) -> T:
        registry[kind] = value
        return kind

    return register


class _Key(NamedTuple):
    name: str
    attribute: str
    kind: Any
    mark: str

    @property
    def empty(self) -> list[Any] | dict[str, Any] | None:
        """Empty list or mapping if the key always has a list or mapping, else None."""
        origin = get_origin(self.kind)
        if self.mark or not isinstance(origin, type):
            return None
        if issubclass(origin, Mapping):
            return {}
        return [] if issubclass(origin, Sequence | np.ndarray) else None


@cache
def _keys(kind: Any) -> Sequence[_Key]:
    """Return the keys of a record type."""
    hints, keys = get_type_hints(kind, include_extras=True), []
    fields = {field.rstrip("_"): field for field in kind._fields}
    for name, attribute in _JSON_KEYS.get(kind, fields).items():
        if attribute not in hints:  # a property
            returned = get_type_hints(getattr(kind, attribute).fget, include_extras=True)
            hints[attribute] = returned["return"]
        hint, mark = hints[attribute], ""
        if get_origin(hint) is Annotated and get_args(hint)[1] in _MARKS:
            hint, mark = get_args(hint)
            if NoneType in get_args(hint):
                hint = Union[tuple(part for part in get_args(hint) if part is not NoneType)]  # noqa: UP007
        keys.append(_Key(name, attribute, hint, mark))
    return keys


def plain_data(value: Any) -> Any:
    """Convert a record to mappings, lists, texts and numbers, at any depth.

    NaN becomes None, a complex number a mapping of real and imaginary part, and an array of complex
    numbers a list of moduli.

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
        return {key: plain_data(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        value = (np.abs(value) if np.iscomplexobj(value) else value).tolist()
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain_data(item) for item in value]
    return value


def _of_record(record: Any) -> dict[str, Any]:
    kind: Any = type(record)
    values = [(key, getattr(record, key.attribute)) for key in _keys(kind)]
    failed = [(key, value) for key, value in values if key.mark == FAILURE and value]
    if failed:
        empty = [(key, key.empty) for key, _ in values[1:] if key.empty is not None]
        values = [values[0], *failed, *empty]
    data = head(_FORMS[kind]) if kind in _FORMS else {}
    for key, value in values:
        if key.mark == FLAT:
            data |= plain_data(value)
        elif not (key.mark == FAILURE and not value) and not (
            key.mark in (SOMETIMES, ASKED)
            and (value is None or (value == {} and key.mark == SOMETIMES))
        ):
            data[key.name] = plain_data(value)
    return data


def with_file(answer: Answer, file: str, *, folders: bool = False) -> dict[str, Any]:
    """Return a document as plain data, with the file of the case under the key `file`.

    Data without the key `format` are returned unchanged. In the document of a case with errors, the
    value of `file` is replaced.

    >>> with_file({"format": "f", "version": 1, "case": {}}, "cases/box.yaml")
    {'format': 'f', 'version': 1, 'file': 'box.yaml', 'case': {}}
    """
    data = answer if isinstance(answer, dict) else plain_data(answer)
    front: dict[str, Any] = {key: data[key] for key in head("") if key in data}
    name = file if folders else os.path.basename(file)  # noqa: PTH119
    if "errors" in data:
        return {**data, "file": name}
    return {**front, "file": name, **data} if front else data


text = json.JSONEncoder(ensure_ascii=False, allow_nan=False, indent=1).encode
"""Function that returns plain data as JSON on several lines, without a final line end."""
_line = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode


def line(value: Any) -> str:
    """Return plain data as JSON on a single line, with a line end."""
    return _line(value) + "\n"


def as_json(answer: Answer, form: str | None) -> str:
    """Return a record as JSON, on a single line if the format is `jsonl`."""
    data = answer if isinstance(answer, dict) else plain_data(answer)
    return line(data) if form == "jsonl" else text(data) + "\n"


def list_of(items: Schema) -> Schema:
    """Return the schema of an array."""
    return {"type": "array", "items": items}


def object_of(properties: Mapping[str, Schema], optional: Sequence[str] = ()) -> Schema:
    """Return the schema of an object that permits no other keys.

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
    """Return the JSON Schema of the plain data of a type; see `plain_data`.

    Parameters
    ----------
    kind : type
        Type: number, text, record, or a sequence, mapping or union of such types.
    definitions : dict, optional
        Mapping to which the schemas of `defined` records are added, by name.

    Examples
    --------
    >>> from vstatics.core.model.parts import Load
    >>> schema(Load)["properties"]["speed"], schema(tuple[int, ...])
    ({'type': ['number', 'null']}, {'type': 'array', 'items': {'type': 'integer'}})
    """
    if kind in _SIMPLE:
        return _SIMPLE[kind]
    if hasattr(kind, "_fields"):
        of_record = _of_keys(kind, definitions)
        if kind not in _DEFINED or definitions is None:
            return of_record
        definitions[_DEFINED[kind]] = of_record
        return {"$ref": f"#/$defs/{_DEFINED[kind]}"}
    return _of_parts(kind, partial(schema, definitions=definitions))


def _of_parts(kind: Any, of: Callable[[Any], Schema]) -> Schema:
    """Return the schema of a type with arguments, such as ``tuple[int, ...]``."""
    origin, (first, *more) = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _of_marked(first, more[0], of)
    if origin is Literal:
        return {"enum": [first, *more]}
    if origin in (Union, UnionType):
        choices = [of(part) for part in (first, *more)]
        if choices[1:] == [NULL] and choices[0].get("type") in ("string", "integer"):
            return choices[0] | {"type": [choices[0]["type"], "null"]}
        return {"anyOf": choices}
    if issubclass(origin, Mapping):
        items = {} if more[0] is Any else {"additionalProperties": of(more[0])}
        return {"type": "object", **items}
    return list_of(NUMBER if origin is np.ndarray else of(first))


def _of_marked(kind: Any, mark: Any, of: Callable[[Any], Schema]) -> Schema:
    """Return the schema of an annotated type.

    The schema rejects everything if the annex that defines the type is not installed.
    """
    if isinstance(mark, Provided):
        declaring = module_of_type(mark)
        return of(getattr(module(declaring), mark)) if declaring else {"not": {}}
    if isinstance(mark, dict):
        return of(kind) | mark
    return of(kind) if mark in _MARKS else {"enum": [*mark]}


def _of_keys(kind: Any, definitions: Schema | None) -> Schema:
    properties = head_schema(_FORMS[kind]) if kind in _FORMS else {}
    optional = []
    failed, has_failed = Schema(), Schema()
    for key in _keys(kind):
        of_key = schema(key.kind, definitions)
        if not failed:
            failed[key.name] = of_key
        elif key.empty is not None:
            failed[key.name] = {"const": key.empty}
        if key.mark == FAILURE:
            failed[key.name] = of_key
            has_failed = {"required": [key.name]}
        elif key.mark == FLAT:
            properties |= of_key["properties"]
            optional += of_key["properties"].keys() - of_key["required"]
        else:
            properties[key.name] = of_key
            optional += [key.name] * (key.mark in (SOMETIMES, ASKED))
    record = object_of(properties, optional)
    return {"if": has_failed, "then": object_of(failed), "else": record} if has_failed else record


def head(form: str) -> dict[str, Any]:
    """Return the first keys of every document: format, format version, and program.

    >>> head("vstatics-result")
    {'format': 'vstatics-result', 'version': 2, 'program': 'vstatics 0.1.0'}
    """
    return {"format": form, "version": VERSION, "program": PROGRAM}


def head_schema(form: str) -> Schema:
    """Return the schema of the keys of `head`."""
    program = {**TEXT, "description": "Name and version of the program that wrote the document."}
    return {"format": {"const": form}, "version": {"const": VERSION}, "program": program}


def of_file(name: str, title: str, content: Schema) -> Schema:
    """Return the schema of a file from the schema of its content."""
    start = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {**start, "$id": f"{name}.schema.json", "title": title, **content}


def documents(name: str, title: str, content: Schema, definitions: Schema | None = None) -> Schema:
    """Return the schema of a file whose documents are `content`, or reports of errors in cases.

    Parameters
    ----------
    name : str
        Name of the format, from which the file name of the schema is derived.
    title : str
        Title of the schema.
    content : dict
        Schema of a document, without its `file`.
    definitions : dict, optional
        Schemas to which `content` refers by ``#/$defs/...``.
    """
    about = "Name of the file of the case, with folders only if several files have this name."
    file = {"type": "string", "description": about}
    properties = {**content["properties"], "file": file}
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
            "document": {**content, "properties": properties},
            "failure": failure,
            **(definitions or {}),
        },
    }
    return of_file(name, title, choice)


def documents_of(name: str, title: str, kind: Any) -> Schema:
    """Return the schema of a file of documents of a type; see `documents`."""
    definitions: Schema = {}
    return documents(name, title, schema(kind, definitions), definitions)


def failure(file: str, problems: Iterable[Problem]) -> dict[str, Any]:
    """Return the document of a case with errors."""
    return {"file": os.path.basename(file), "case": file, "errors": list(map(str, problems))}  # noqa: PTH119
