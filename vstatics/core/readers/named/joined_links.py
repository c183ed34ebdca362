"""Links of a case without a list of links, collected from the components."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from vstatics.core.elements.keys import with_elements
from vstatics.core.errors import Problem
from vstatics.core.model.keys import CASE
from vstatics.core.model.parts import Gear
from vstatics.core.model.paths import BODIES
from vstatics.core.model.shape import (
    ByKey,
    ByKind,
    ByName,
    Either,
    Ends,
    Leaf,
    ListOf,
    Numbers,
    Shape,
)
from vstatics.core.readers.named import nodes
from vstatics.core.readers.named.compounds import meant_key
from vstatics.core.readers.named.nodes import (
    MOST_HINTS,
    DocumentText,
    Listing,
    Node,
    Scalar,
    Spots,
    is_null,
    shown,
)
from vstatics.core.readers.named.walk import Walk

_HEAVY = CASE._replace(keys=tuple(key for key in CASE.keys if key.name in BODIES))


_HOUSINGS = {"ground", "frame", "case", "casing", "gehäuse", "fixed", "earth", "chassis", "корпус"}
"""Names, in lower case, that users write for the housing."""


def _is_housing(name: str) -> bool:
    """Return whether a name of a link probably means the housing."""
    return name.casefold() in _HOUSINGS


def is_listed(root: nodes.Mapping) -> bool:
    """Return whether a document has the key `links`."""
    first = next((value for key, value in root.entries if key.text == "links"), None)
    return first is not None and not is_null(first)


def gathered_links(root: nodes.Mapping, walk: Walk) -> list[str]:
    """Return the names of links in the order of the components, and register them as references.

    If there are no components, the links of the inertias are returned.
    """
    root = _as_meant(root, walk.spots.document)
    places = joined_links(root) or _named(_links(root, _HEAVY))
    names = list(dict.fromkeys(node.text for node in places))
    if names:
        walk.references.set_link_names(names)
    return names


def _as_meant(root: nodes.Mapping, document: DocumentText) -> nodes.Mapping:
    """Return a document in which similar known keys replace mistyped keys."""
    known = [key.name for key in with_elements(CASE).keys]
    entries = []
    for key, value in root.entries:
        hint = "" if key.text in known else meant_key(document, key.text, known)
        name = next((name for name in known if f"`{name}`" in hint), key.text)
        entries.append((key._replace(text=name), value))
    return root._replace(entries=entries)


def joined_links(root: nodes.Mapping) -> list[Scalar]:
    """Return all nodes where a component names a link other than the housing, in document order."""
    keys = [key for key in with_elements(CASE).keys if isinstance(key.shape, ByName)]
    devices = CASE._replace(keys=tuple(key for key in keys if key.name != "gears"))
    return _named(_links(root, devices))


def _named(links: Iterable[Node]) -> list[Scalar]:
    """Return the nodes with names of links other than the housing."""
    named = (node for node in links if isinstance(node, Scalar))
    return [node for node in named if not is_null(node) and node.text not in ("0", "housing")]


def loose_links(
    root: nodes.Mapping,
    values: Mapping[str, Any],
    names: Sequence[str],
    gears: Sequence[Gear],
    spots: Spots,
) -> Iterator[Problem]:
    """Yield a warning for each link that is connected to a single component.

    A link with a name like the housing is also reported if only shift elements use it. A carrier
    with a single connection is usual, so it is reported only if its name looks mistyped.
    """
    if any(path[:1] != ("load",) for path in spots.unreadable):
        return  # the unreadable text can contain names of links
    root = _as_meant(root, spots.document)
    places = joined_links(root)
    counts = Counter(node.text for node in places)
    shifts = [entry for entry in root.entries if entry[0].text == "shift_elements"]
    in_shifts = Counter(node.text for node in joined_links(root._replace(entries=shifts)))
    unheld = {name for name in names if _is_housing(name) and counts[name] == in_shifts[name] > 1}
    carriers = {record.get("carrier") for record in values.get("elements", {}).values()}
    outputs = [values.get("output"), *values.get("outputs", ())]
    connected = {values.get("input"), *(outputs if any(outputs) else [len(names)])}
    connected.update(link for key in ("drag", "inertias", "masses") for link in values.get(key, ()))
    for gear in gears:
        connected.update((*gear.speeds, *gear.torques, *gear.drag, gear.input, gear.output))
    loose = [
        n
        for n, name in enumerate(names, 1)
        if (counts[name] == 1 or name in unheld) and n not in connected
    ]
    first = {node.text: node for node in reversed(places)}
    for count, number in enumerate(loose):
        name = names[number - 1]
        others = [*(other for other in names if other != name), "housing"]
        hint = spots.document.hint(name, others) if count < MOST_HINTS else ""
        if _is_housing(name):
            hint = "; write `housing` for a part that never turns"
        if hint or number not in carriers:
            node = first[name]
            reason = (
                "appears only in shift elements, so nothing holds it"
                if name in unheld
                else "appears only once, so it is connected to nothing"
            )
            message = f"link `{shown(name)}` {reason}{hint}"
            yield Problem("W102", message, (), spots.document.source.place(node.line, node.column))


def _links(node: Node, shape: Shape) -> Iterator[Node]:  # noqa: C901, PLR0912 - a table
    """Yield the nodes under a node that name links; single links come before lists of links."""
    match node, shape:
        case _, Leaf("link"):
            yield node
        case nodes.Mapping(entries), ByKey():
            shapes = {key.name: key.shape for key in shape.keys}
            inner = [(shapes[key.text], value) for key, value in entries if key.text in shapes]
            for of, value in sorted(inner, key=lambda pair: isinstance(pair[0], ListOf)):
                yield from _links(value, of)
        case nodes.Mapping(entries), ByKind(records, name):
            kinds = [v.text for key, v in entries if key.text == name and isinstance(v, Scalar)]
            known = [records[kind] for kind in kinds[:1] if kind in records]
            for record in (
                known or records.values()
            ):  # if the kind is unknown, the members of all kinds are accepted
                yield from _links(node, record)
        case nodes.Mapping(entries), ByName(_, item):
            for _, value in entries:
                yield from _links(value, item)
        case nodes.Mapping(), Either(record=record):
            yield from _links(node, record)
        case Listing(), Either(short=short):
            yield from _links(node, short)
        case Listing(items), Ends():
            yield from items
        case nodes.Mapping(entries), Numbers("link"):
            yield from (key for key, _ in entries)
        case Listing(items), ListOf(item):
            for value in items:
                yield from _links(value, item)
