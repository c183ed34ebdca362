"""Reference of the keys of a case and of a scenario, from the schema of their declarations."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from vstatics.core.cli.schemas import schemas
from vstatics.core.elements.kinds import KINDS
from website.page import Page, anchor, code, escaped

Schema = Mapping[str, Any]
FILES = {"case": "Keys of a case", "scenario": "Keys of a scenario"}


def pages() -> Iterator[Page]:
    """Yield a page for each kind of file."""
    for name, title in FILES.items():
        schema = schemas()[name]
        lines = [f"# {title}", "", escaped(str(schema["description"])), ""]
        of_kind = ""
        for path, key in keys(schema, name):
            own = path.partition(".")[2]
            if "places" in key:
                of_kind = f"{path}."
                parent = own.removesuffix(f".{key['const']}")
                lines += [anchor(path), f"## {parent} of kind: {key['const']}", "", *_of_kind(key)]
                continue
            if path.startswith(of_kind) and of_kind:
                heading = f"### {of_kind.split('.')[-2]}: {path.removeprefix(of_kind)}"
            else:
                heading = f"## {own}"
            lines += [anchor(path), heading, "", *_described(key, schema)]
        yield Page("reference", f"reference/keys/{name}", "\n".join(lines))


def keys(schema: Schema, path: str) -> Iterator[tuple[str, Schema]]:
    """Yield each key with its path, followed by the keys of its records.

    If records are of several kinds, each kind has a path such as `case.elements.worm`, with its
    name (`const`), its required keys, and the places at which its keys are described. A key that
    an earlier kind has in the same form is described there only.

    >>> case = {"properties": {"gears": {"items": {"properties": {"name": {}}}}}}
    >>> [path for path, _ in keys(case, "case")]
    ['case.gears', 'case.gears.name']
    """
    for name, key in schema.get("properties", {}).items():
        yield f"{path}.{name}", key
        described = list[tuple[str, Schema, str]]()
        for part in _parts(key):
            kind = part["properties"].get("kind", {}).get("const")
            if kind is None:
                yield from keys(part, f"{path}.{name}")
            else:
                yield from _keys_of_kind(part, f"{path}.{name}.{kind}", kind, described)


def _keys_of_kind(
    part: Schema, path: str, kind: str, described: list[tuple[str, Schema, str]]
) -> Iterator[tuple[str, Schema]]:
    """Yield a kind of records, and the keys that no earlier kind has in the same form."""
    own = {name: key for name, key in part["properties"].items() if name != "kind"}
    places = {
        name: next((at for *same, at in described if same == [name, key]), f"{path}.{name}")
        for name, key in own.items()
    }
    yield path, {"const": kind, "required": part.get("required", []), "places": places}
    new = {name: key for name, key in own.items() if places[name] == f"{path}.{name}"}
    yield from keys({"properties": new}, path)
    described += [(name, key, places[name]) for name, key in new.items()]


def _of_kind(kind: Schema) -> Iterator[str]:
    """Yield the description of a kind, its required keys and its optional keys."""
    yield escaped(KINDS[kind["const"]].description)
    yield ""
    needed = [name for name in kind["places"] if name in kind["required"]]
    for what, names in (
        ("needs", needed),
        ("may have", [name for name in kind["places"] if name not in needed]),
    ):
        if names:
            links = (f'<a href="#{kind["places"][name]}"><code>{name}</code></a>' for name in names)
            yield f"- {what}: {', '.join(links)}"
    yield ""


def _parts(key: Schema) -> Iterator[Schema]:
    """Yield the different shapes of the records below a key."""
    seen: set[str] = set()
    places = [key]
    while places:
        place = places.pop(0)
        if "properties" in place:
            kind = place["properties"].get("kind", {}).get("const")
            names = json.dumps([kind, sorted(place["properties"])])
            if names not in seen:
                seen.add(names)
                yield place
            continue
        below = (place.get("items"), place.get("additionalProperties"))
        places += [shape for shape in below if isinstance(shape, Mapping)]
        places += [shape for way in ("anyOf", "oneOf") for shape in place.get(way, [])]


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
    """Yield the kinds of values that a key accepts."""
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
        for alternative in key.get(choice, []):
            yield from _kinds(alternative, schema)
