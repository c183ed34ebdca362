"""Walk through a tree of nodes along the declared shape of a case.

The walk creates parts of the model and plain values from the nodes, and stores the place of each.
For an unreadable value it returns a harmless stand-in, so that reading can continue.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

from vstatics.core.errors import quoted, spoken
from vstatics.core.model.parts import HOUSING
from vstatics.core.model.shape import (
    TEXT,
    Balances,
    ByForm,
    ByKey,
    ByKind,
    ByLaw,
    ByName,
    ByPoints,
    Either,
    Ends,
    Leaf,
    Links,
    ListOf,
    Numbers,
    OneOrMany,
    Pair,
    Parsed,
    RowOf,
    Shape,
    Shares,
)
from vstatics.core.readers.named import compounds, laws, scalars
from vstatics.core.readers.named.compounds import (
    NO_COMMA,
    entries,
    known_entries,
)
from vstatics.core.readers.named.leaves import LEAVES, either_way, stand_in, values_before
from vstatics.core.readers.named.nodes import (
    CONTRADICTION,
    DASH_HINT,
    MISSING,
    NAME,
    NUMBER,
    SHAPE,
    TWICE,
    Listing,
    Mapping,
    Node,
    Scalar,
    Spot,
    Spots,
    is_null,
    length,
    shown,
    what,
)
from vstatics.core.readers.named.references import NO_ELEMENT, NO_LINK, References

_ENDS = ("first", "second")
_SHORT: dict[type[Shape], type[Node]] = {ListOf: Listing, Leaf: Scalar}
"""Node types of the short form of a mapping. Messages about other nodes expect a mapping."""


class Walk:
    """Reader of nodes by shape."""

    def __init__(self, spots: Spots) -> None:
        self.spots = spots
        self.references = References(spots.document)
        self._readers: dict[type[Shape], Callable[[Spot, Any], Any]] = {
            ByKey: self._by_key,
            ByName: self._by_name,
            Links: self._links,
            Ends: self._ends,
            Either: self._either,
            Numbers: self._numbers,
            Shares: self._shares,
            Leaf: self._leaf,
            ListOf: self._list_of,
            Pair: self._pair,
            RowOf: partial(compounds.read_row, self),
            ByPoints: partial(compounds.read_points, self),
            Balances: partial(laws.read_balance, self),
            ByLaw: partial(laws.read_law, self),
            Parsed: partial(compounds.read_parsed, self),
            ByForm: partial(compounds.read_form, self),
            OneOrMany: partial(compounds.read_one_or_many, self),
            ByKind: self._by_kind,
        }

    def read(self, spot: Spot, shape: Shape) -> Any:
        """Read the value at a spot; after an error, return a stand-in."""
        self.spots.keep(spot)
        return self._readers[type(shape)](spot, shape)

    def items(self, spot: Spot, nodes: Sequence[Node], shape: Shape) -> list[Any]:
        """Read the items of a list of a single shape."""
        return [self.read(spot.item(n, n, node), shape) for n, node in enumerate(nodes, 1)]

    def refuse(
        self, spot: Spot, shape: Shape, expected: object, read: str = "", identity: str = SHAPE
    ) -> Any:
        """Report an unreadable value, and return a stand-in."""
        message = f"read {read or what(spot.node)}, {expected}"
        text = spot.node.text if isinstance(spot.node, Scalar) else ""
        if "a list" in message and text[:1] == "-" and not text[1:].isdigit():
            message += DASH_HINT
        self.spots.refuse(spot, message, identity)
        return stand_in(shape)

    def _by_key(self, spot: Spot, shape: ByKey) -> Any:
        node, unreadable = spot.node, len(self.spots.unreadable)
        given = {}
        if isinstance(node, Mapping):
            given = known_entries(self.spots, spot, shape.keys)
        elif not is_null(node) or shape.required:
            expected = "expected a mapping with " + spoken(quoted(key.name) for key in shape.keys)
            return self.refuse(spot, shape, expected)
        values = values_before(shape)
        for key in shape.keys:
            if key.name in given:
                inner = spot.key(key.name, key.name, given[key.name])
                values[key.name] = self.read(inner, key.shape)
            elif key.required and key.unless not in given:
                self.spots.missing(spot, key.name)
            elif key.required:
                del values[key.name]
        if fault := shape.fault(**values):
            if len(self.spots.unreadable) == unreadable:  # not a contradiction with a stand-in
                self.spots.complain(spot, fault, identity=CONTRADICTION)
            self.spots.unreadable.append(spot.path)
            return stand_in(shape)
        return shape.make(**values)

    def _by_name(self, spot: Spot, shape: ByName) -> Any:
        elements = shape.kind == "shift element"
        if not isinstance(spot.node, Mapping):
            self.references.elements_known &= not elements
            return self.refuse(spot, shape, f"expected a mapping: a name for each {shape.kind}")
        given = list(entries(self.spots, spot))
        names = [key.text for key, _ in given]
        if shape.kind in ("shift element", "mechanism"):
            self.references.set_numbers(shape.kind, names)
        elif shape.kind == "converter":
            self.references.add_converters(names)
        items: dict[str, Any] = {}
        for number, (key, value) in enumerate(given, 1):
            inner = spot.key(number, key.text, value)
            self.spots.keep(inner, key)
            items[key.text] = self.read(inner, shape.item)
        return items

    def _links(self, spot: Spot, shape: Links) -> Any:
        node = spot.node
        if isinstance(node, Listing):
            named = spot._replace(path=("link_names",))
            self.spots.keep(named)
            unreadable = len(self.spots.unreadable)
            names = self.items(named, node.items, TEXT)
            if len(self.spots.unreadable) == unreadable:  # a reference can mean an unreadable name
                self.references.set_link_names(names)
            return len(node.items)
        try:
            links = scalars.link_number(node.text) if isinstance(node, Scalar) else None
        except ValueError as error:
            return self.refuse(spot, shape, error, identity=NUMBER)
        if links is None:
            return self.refuse(spot, shape, "expected the number of links or a list of their names")
        self.references.set_links(links)
        return links

    def _ends(self, spot: Spot, shape: Ends) -> Any:
        node = spot.node
        if not isinstance(node, Listing) or not shape.least <= len(node.items) <= 2:
            alternative = " or one: [first]" if shape.least == 1 else ""
            self.spots.unreadable += [(*spot.path[:-1], end) for end in _ENDS]
            return self.refuse(
                spot, shape, f"expected two links: [first, second]{alternative}", length(node)
            )
        inner = [
            spot.item(member, number, item)
            for number, (member, item) in enumerate(zip(_ENDS, node.items, strict=False), 1)
        ]
        if spot.path[-1] == "links":  # within a mapping, the model has no part `links`
            inner = [end._replace(path=(*spot.path[:-1], end.path[-1])) for end in inner]
        first, *second = [self.read(end, Leaf("link")) for end in inner]
        return first, *(second or [HOUSING])

    def _either(self, spot: Spot, shape: Either) -> Any:
        """Read a mapping with declared keys, or its short form, the value of the main key.

        If the main key is unreadable, problems of the model in the mapping are hidden.
        """
        inner = spot._replace(path=(*spot.path, shape.key))
        if isinstance(spot.node, Mapping) or (is_null(spot.node) and not shape.record.required):
            record = self._by_key(spot, shape.record)
        elif isinstance(shape.short, Ends) or isinstance(spot.node, _SHORT[type(shape.short)]):
            record = shape.record.make(**{shape.key: self.read(inner, shape.short)})
        else:
            keys = spoken(quoted(key.name) for key in shape.record.keys)
            short = shape.short
            expected = (
                LEAVES[short.kind].expected
                if isinstance(short, Leaf)
                else f"a list of {short.kind}"
            )
            return self.refuse(spot, shape, f"expected {expected}, or a mapping with {keys}")
        if inner.path in self.spots.unreadable:
            self.spots.unreadable.append(spot.path)
        return record

    def _numbers(self, spot: Spot, shape: Numbers) -> Any:
        """Read a mapping from names of links, shift elements or other components to numbers."""
        node = spot.node
        if not isinstance(node, Mapping):
            return self.refuse(spot, shape, f"expected a mapping: a number for each {shape.by}")
        refer, unknown = self.references.link, NO_LINK
        if shape.by == "shift element":
            refer, unknown = self.references.element, NO_ELEMENT
        elif shape.by != "link":
            refer, unknown = partial(self.references.other, shape.by), NO_ELEMENT
        values = {}
        for key, value in entries(self.spots, spot):
            if self._is_behind_comma(spot, key, value):
                continue
            try:
                place = refer(key.text)
            except ValueError as error:
                self.spots.complain(spot, f"read {what(key)}, {error}", key, NAME)
                place = unknown
            inner = spot.key(place, key.text, value)
            self.spots.keep(inner, key)
            if place in values:
                self.spots.complain(inner, f"{shape.by} {place} is given twice", key, TWICE)
            number = self.read(inner, shape.item)
            if place != unknown:
                values[place] = number
        if node.entries and not values:
            self.spots.unreadable.append(spot.path)
        return values

    def _is_behind_comma(self, spot: Spot, key: Scalar, value: Node) -> bool:
        """Report a key that results from a decimal comma, as in `{a: 0,2 kg*m^2}`."""
        if not (is_null(value) and key.text.partition(" ")[0].isdigit()):
            return False
        message = f"read {what(key)} without a value; in a number, {NO_COMMA}"
        self.spots.complain(spot, message, key, NUMBER)
        return True

    def _shares(self, spot: Spot, shape: Shares) -> Any:
        """Read shares by gear name. The names are not compared with the case."""
        if not isinstance(spot.node, Mapping):
            return self.refuse(spot, shape, "expected a share for each gear")
        shares = {}
        for key, value in spot.node.entries:
            if self._is_behind_comma(spot, key, value):
                continue
            gear = spot._replace(
                path=(*spot.path, key.text), label=f"gear {shown(key.text)}", node=value
            )
            if key.text in shares:
                self.spots.complain(spot, f"{gear.label} is given twice", key, TWICE)
            self.spots.keep(gear, key)
            shares[key.text] = self.read(gear, Leaf("share"))
        return shares

    def _list_of(self, spot: Spot, shape: ListOf) -> Any:
        if not isinstance(spot.node, Listing):
            of = f" of {shape.kind}" if shape.kind else ""
            if isinstance(shape.item, RowOf):
                of += f": [[{shape.item.kind}], ...]"
            return self.refuse(spot, shape, f"expected a list{of}")
        return self.items(spot, spot.node.items, shape.item)

    def _pair(self, spot: Spot, shape: Pair) -> Any:
        node = spot.node
        if not isinstance(node, Listing) or len(node.items) != 2:
            return self.refuse(
                spot, shape, f"expected two: [{shape.kind}, {shape.kind}]", length(node)
            )
        return self.items(spot, node.items, TEXT)

    def _by_kind(self, spot: Spot, shape: ByKind) -> Any:
        node = spot.node
        known = tuple(shape.records)
        if not isinstance(node, Mapping):
            return self.refuse(spot, shape, "expected a mapping with `kind` and members")
        given = [value for key, value in node.entries if key.text == shape.key]
        if not given:
            kinds = spoken(map(quoted, known), "or")
            of_several = "one of " if len(known) > 1 else ""
            missing = f"{quoted(shape.key)} is missing; expected {of_several}{kinds}"
            names = {key.name for record in shape.records.values() for key in record.keys}
            unknown = [key.text for key, _ in node.entries if key.text not in names]
            missing += f"; unknown: {spoken(map(quoted, unknown))}" * bool(unknown)
            if any(name.startswith(f"{shape.key}:") for name in unknown):
                missing = f"{quoted(shape.key)} is missing; write a blank after the colon"
            self.spots.complain(spot, missing, identity=MISSING)
            self.spots.unreadable.append(spot.path)
            return {}
        kind = self.read(
            spot.key(shape.key, shape.key, _joined(given[0], known)), Leaf("choice", known)
        )
        if (*spot.path, shape.key) in self.spots.unreadable:
            return {}
        return self._by_key(spot, shape.records[kind])

    def _leaf(self, spot: Spot, shape: Leaf) -> Any:
        node = spot.node
        if not isinstance(node, Scalar) or is_null(node):
            return self.refuse(spot, shape, f"expected {LEAVES[shape.kind].expected}")
        try:
            value = self._scalar(node, shape)
        except ValueError as error:
            identity = NAME if shape.kind in ("choice", "flag") else compounds.id_of(error)
            return self.refuse(spot, shape, error, identity=identity)
        if value == stand_in(shape) and shape.kind in ("link", "element", "converter"):
            self.spots.unreadable.append(spot.path)
        return value

    def _scalar(self, node: Scalar, shape: Leaf) -> Any:  # noqa: PLR0911, C901 - a table
        match shape.kind:
            case "link":
                return self.references.link(node.text)
            case "element":
                return self.references.element(node.text)
            case "converter":
                return self.references.other("mechanism", node.text)
            case "relative_speed":
                speed = self.references.speed_of(node.text)
                if speed is not None:
                    return speed
            case "flag":
                return scalars.flag(node.text, plain=node.plain)
            case "choice":
                if node.text not in shape.choices:
                    several = shape.choices if len(shape.choices) > 1 else ()
                    hint = compounds.meant_key(self.spots.document, node.text, several)
                    raise ValueError(f"expected {spoken(map(quoted, shape.choices), 'or')}{hint}")
                return node.text
        if shape.infinite and node.plain and node.text in scalars.INFINITE:
            return math.inf
        if shape.straight:
            return either_way(node.text, shape.kind)
        return LEAVES[shape.kind].parse(node.text)


def _joined(node: Node, known: Iterable[str]) -> Node:
    """Return a list of words as a single word, as in the records of a `ByKind`."""
    if not isinstance(node, Listing) or not all(isinstance(item, Scalar) for item in node.items):
        return node
    if not any(name.startswith("[") for name in known):
        return node
    words = [item.text for item in node.items if isinstance(item, Scalar)]
    return Scalar(f"[{', '.join(words)}]", node.line, node.column)
