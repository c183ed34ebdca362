"""Reference of the keys of a case and of a scenario, from the schema of their declarations."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from vstatics.cli.schemas import schemas
from website.page import Page, anchor, code, escaped

Schema = Mapping[str, Any]
FILES = {"case": "Keys of a case", "scenario": "Keys of a scenario"}


def pages() -> Iterator[Page]:
    """A page for each kind of file."""
    for name, title in FILES.items():
        schema = schemas()[name]
        lines = [f"# {title}", "", escaped(str(schema["description"])), ""]
        for path, key in keys(schema, name):
            lines += [anchor(path), f"## {path.partition('.')[2]}", "", *_described(key, schema)]
        yield Page("reference", f"reference/keys/{name}", "\n".join(lines))


def keys(schema: Schema, path: str) -> Iterator[tuple[str, Schema]]:
    """Each key with its path; those of the parts of a list or of named parts stand below it.

    >>> case = {"properties": {"gears": {"items": {"properties": {"name": {}}}}}}
    >>> [path for path, _ in keys(case, "case")]
    ['case.gears', 'case.gears.name']
    """
    for name, key in schema.get("properties", {}).items():
        yield f"{path}.{name}", key
        for part in _parts(key):
            yield from keys(part, f"{path}.{name}")


def _parts(key: Schema) -> Iterator[Schema]:
    """The shapes of what is below a key, each once."""
    seen: set[str] = set()
    places = [key]
    while places:
        place = places.pop(0)
        if "properties" in place:
            names = json.dumps(sorted(place["properties"]))
            if names not in seen:
                seen.add(names)
                yield place
            continue
        below = (place.get("items"), place.get("additionalProperties"))
        places += [one for one in below if isinstance(one, Mapping)]
        places += [one for choice in ("anyOf", "oneOf") for one in place.get(choice, [])]


def _described(key: Schema, schema: Schema) -> Iterator[str]:
    yield escaped(str(key.get("description", "")))
    yield ""
    kinds = ", ".join(dict.fromkeys(_kinds(key, schema)))
    if kinds:
        yield f"- what: {kinds}"
    if "default" in key:
        yield f"- when not given: {code(json.dumps(key['default']))}"
    for example in key.get("examples", []):
        yield f"- example: {code(json.dumps(example, ensure_ascii=False))}"
    yield ""


def _kinds(key: Schema, schema: Schema) -> Iterator[str]:
    """What a key may be."""
    if "$ref" in key:
        named = schema["$defs"][key["$ref"].rpartition("/")[2]]
        yield escaped(str(named.get("description", named.get("title", "")))).rstrip(".")
    if "const" in key:
        yield code(json.dumps(key["const"]).strip('"'))
    for value in key.get("enum", []):
        if value is not None:
            yield code(json.dumps(value).strip('"'))
    if "enum" not in key and "$ref" not in key:
        kinds = key.get("type", [])
        yield from (k for k in ([kinds] if isinstance(kinds, str) else kinds) if k != "null")
    for choice in ("anyOf", "oneOf"):
        for one in key.get(choice, []):
            yield from _kinds(one, schema)
