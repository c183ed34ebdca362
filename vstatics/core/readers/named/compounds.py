"""Readers of compound values: mappings, rows, points, and values that have several forms."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Any, Protocol

from vstatics.core.errors import ReadError, quoted, spoken
from vstatics.core.model.shape import ByForm, ByPoints, KeyShape, OneOrMany, Parsed, RowOf, Shape
from vstatics.core.readers.named.arithmetic import UnitError
from vstatics.core.readers.named.nodes import (
    NAME,
    NUMBER,
    SHAPE,
    TWICE,
    UNIT,
    UNKNOWN_KEY,
    DocumentText,
    Listing,
    Mapping,
    Node,
    Scalar,
    Spot,
    Spots,
    is_null,
    length,
    shown,
)
from vstatics.core.readers.named.references import UnknownNameError

NO_COMMA = "write a decimal point, not a decimal comma"
_AFTER_COMMA = re.compile(r"\d+(%|[ \t].*)?", re.ASCII)
"""Pattern of a key that results from a decimal comma in braces: `5 rpm` of `{speed: 2000,5 rpm}`.
"""
BARE = "[-+]?[0-9.]+([eE][-+]?[0-9]+)?"
"""Pattern of a number without a unit."""
_SYNONYMS = {
    **dict.fromkeys(("clutches", "brakes", "clutch", "brake"), "shift_elements"),
    **dict.fromkeys(("gear_sets", "gearsets", "sets", "planetary"), "elements"),
    **dict.fromkeys(("one_way", "one_way_clutch", "oneway_clutch"), "freewheel"),
    **dict.fromkeys(("sprag", "sprag_clutch", "overrunning_clutch"), "freewheel"),
    **dict.fromkeys(("epicyclic", "simple", "planet"), "planetary"),
    **dict.fromkeys(("comment", "comments", "notes"), "description"),
    "title": "name",
    **dict.fromkeys(("spur", "spur_gear", "helical"), "gear_pair"),
    **dict.fromkeys(("closed", "applied", "active"), "engaged"),
    **dict.fromkeys(("crr", "rolling_resistance"), "rolling"),
    **dict.fromkeys(("zeta", "damping_ratio"), "ratio"),
    **dict.fromkeys(("k", "spring_rate", "spring_constant"), "stiffness"),
    "shafts": "springs",
    "annulus": "ring",
    "band": "brake",
    "dog": "dog_clutch",
    "eta": "efficiency",
    "differential": "bevel",
}
"""Keys and kinds that users try, with the words of a case that have this meaning."""
_OF_OTHERS = {
    ("frontal_area", "area", "drag_coefficient", "cd", "cw", "cda"): (
        "drag_area",
        "`drag_area` is the drag coefficient times the frontal area",
    ),
    ("diameter", "wheel_diameter", "tire_diameter"): ("radius", "`radius` is half the diameter"),
    ("k_factor", "capacity_factor"): (
        "points",
        "each of the `points` has a speed ratio, a torque ratio and lambda = 1/K^2",
    ),
    ("teeth",): ("diameters", "a toothed belt has the kind `chain`"),
    ("grade", "gradient", "incline"): (
        "slope",
        "`slope` is the sine of the angle, grade/sqrt(1 + grade^2)",
    ),
    ("traction", "grip", "mu", "drive_axle_weight_frac"): ("rolling", "tyres never slip here"),
    ("rule", "haibach", "k_2", "k2"): (
        "threshold",
        "`exponent` applies to all stresses down to `threshold` (Miner's rule)",
    ),
    ("ultimate", "uts", "goodman", "gerber", "mean"): (
        "asymmetry",
        "the influence of the mean stress is `asymmetry`",
    ),
}
"""Keys of other programs, in lower case, with a key of the same mapping and advice."""
_MEMBERS = {"sun", "ring", "carrier", "teeth", "planets"}


def entries(spots: Spots, spot: Spot) -> Iterator[tuple[Scalar, Node]]:
    """Yield the valid entries of a mapping, and report invalid entries."""
    assert isinstance(spot.node, Mapping)  # noqa: S101 (for mypy)
    seen: dict[str, Scalar] = {}
    for key, value in spot.node.entries:
        if is_null(key) or not key.text:
            spots.complain(spot, "read an empty key, expected a name", key, UNKNOWN_KEY)
        elif key.text in seen:
            first = seen[key.text]
            other = f"the first is on line {first.line}, column {first.column}"
            spots.complain(spot, f"key `{shown(key.text)}` is given twice, {other}", key, TWICE)
        else:
            seen[key.text] = key
            yield key, value


def known_entries(spots: Spots, spot: Spot, keys: Sequence[KeyShape]) -> dict[str, Node]:
    """Return the nodes of declared keys. An optional key without a value counts as missing.

    A mistyped key is read as the most similar key, so that it causes only a single message.
    """
    known = {key.name: key for key in keys}
    given = {}
    meant: dict[str, Node] = {}
    for key, value in entries(spots, spot):
        if key.text not in known:
            hint = meant_key(spots.document, key.text, known)
            expected = hint or f", expected {spoken(map(quoted, known))}"
            expected = _advice(key.text, known, has_value=not is_null(value)) or expected
            spots.complain(spot, f"unknown key `{shown(key.text)}`{expected}", key, UNKNOWN_KEY)
            meant.update((name, value) for name in known if f"`{name}`" in hint)
            if not hint:  # the key can hold a value that this mapping then seems to lack
                spots.unreadable.append((*spot.path, key.text))
        elif known[key.text].required or not is_null(value):
            given[key.text] = value
    return meant | given


def meant_key(document: DocumentText, key: str, known: Iterable[str]) -> str:
    """Return a hint with the key that an unknown key probably means; empty if not recognised."""
    names = [*known]
    synonym = _SYNONYMS.get(re.sub(r"[-\s]", "_", key.casefold()))
    return f"; did you mean `{synonym}`?" if synonym in names else document.hint(key, names)


def _advice(key: str, known: Collection[str], *, has_value: bool = False) -> str:
    """Return advice about the typical mistake that causes an unknown key; empty if unknown.

    >>> _advice("5 rpm", ["speed"])
    '; write a decimal point, not a decimal comma'
    >>> _advice("kind:belt", ["kind"])
    '; write a blank after the colon: `kind: belt`'
    >>> _advice("sun", ["first", "ratio"])
    '; sun, ring, carrier and teeth are keys of gear sets under `elements`'
    >>> _advice("ratio", ["sun", "ring", "teeth"])
    '; a gear set with a ratio instead of teeth is written under `mechanisms`'
    >>> _advice("diameter", ["mass", "radius"])
    '; `radius` is half the diameter'
    >>> _advice("teeth", ["first", "second", "diameters"])
    '; a toothed belt has the kind `chain`'
    """
    name, colon, value = key.partition(":")
    if _AFTER_COMMA.fullmatch(key) and not has_value:
        return f"; {NO_COMMA}"
    if colon and value and name in known:
        return f"; write a blank after the colon: `{shown(name)}: {shown(value)}`"
    for others, (neighbour, advice) in _OF_OTHERS.items():
        if neighbour in known and key.lower() in others:
            return f"; {advice}"
    if key in _MEMBERS and {"first", "ratio"} <= {*known}:
        return "; sun, ring, carrier and teeth are keys of gear sets under `elements`"
    if key == "ratio" and "teeth" in known and "ratios" not in known:
        return "; a gear set with a ratio instead of teeth is written under `mechanisms`"
    return ""


def id_of(error: ValueError) -> str:
    """Return the message id for an error in a single value.

    >>> id_of(UnknownNameError()), id_of(UnitError()), id_of(ValueError())
    ('E126', 'E124', 'E125')
    """
    if isinstance(error, UnknownNameError):
        return NAME
    return UNIT if isinstance(error, UnitError) else NUMBER


class ReadsShapes(Protocol):
    """Interface of `Walk` for the readers of compound values."""

    spots: Spots

    def read(self, spot: Spot, shape: Shape) -> Any:
        """Read the value at a spot; after an error, return a stand-in (a harmless value)."""

    def items(self, spot: Spot, nodes: Sequence[Node], shape: Shape) -> list[Any]:
        """Read the items of a list of a single shape."""

    def refuse(
        self, spot: Spot, shape: Shape, expected: object, read: str = "", identity: str = SHAPE
    ) -> Any:
        """Report an unreadable value, and return a stand-in."""


def read_row(walk: ReadsShapes, spot: Spot, shape: RowOf) -> Any:
    """Read a row with the prescribed number of values."""
    node, count = spot.node, len(shape.items)
    given = len(node.items) if isinstance(node, Listing) else 0
    known = shape.shapes(given)
    if not isinstance(node, Listing) or not count <= given <= len(known):
        return walk.refuse(spot, shape, f"expected {count} numbers: [{shape.kind}]", length(node))
    items = enumerate(zip(node.items, known, strict=True), 1)
    return tuple(walk.read(spot.item(n, n, item), leaf) for n, (item, leaf) in items)


def read_points(walk: ReadsShapes, spot: Spot, shape: ByPoints) -> Any:
    """Read a curve: rows of points, a number (the value at 0), or a mapping."""
    node, leaf = spot.node, shape.row.items[-1]
    if isinstance(node, Listing):
        if not node.items:
            return walk.refuse(spot, shape, f"expected points: [[{shape.row.kind}], ...]")
        return tuple(walk.items(spot, node.items, shape.row))
    if isinstance(node, Mapping):
        return walk.read(spot, shape.mapping)
    if is_null(node):
        return walk.refuse(spot, shape, f"expected a number, or points: [[{shape.row.kind}], ...]")
    return ((0.0, walk.read(spot._replace(path=(*spot.path, 1, 2)), leaf)),)


def read_parsed(walk: ReadsShapes, spot: Spot, shape: Parsed) -> Any:
    """Read a text with the parser declared by the shape."""
    node = spot.node
    if not isinstance(node, Scalar) or is_null(node):
        return walk.refuse(spot, shape, f"expected {shape.expected}")
    try:
        return shape.parse(node.text)
    except ReadError as error:
        for problem in error.problems:
            offset = problem.place.column - 1 if problem.place else 0
            moved = _moved_by(walk, node, offset)
            walk.spots.complain(spot, problem.message, moved, problem.id)
        walk.spots.unreadable.append(spot.path)
        return shape.stand_in
    except ValueError as error:
        return walk.refuse(spot, shape, error, identity=id_of(error))


def _moved_by(walk: ReadsShapes, node: Scalar, offset: int) -> Scalar:
    """Return a scalar whose place is moved by an offset; unchanged if it has several lines."""
    line = walk.spots.document.source.place(node.line).text
    begin = node.column - 1 + (line[node.column - 1 : node.column] in ("'", '"'))
    as_written = line.startswith(node.text, begin)
    return node._replace(column=begin + offset + 1) if as_written else node


def read_form(walk: ReadsShapes, spot: Spot, shape: ByForm) -> Any:
    """Read a single value, a list or a mapping."""
    if isinstance(spot.node, Listing):
        return walk.read(spot, shape.listing)
    if isinstance(spot.node, Mapping) and shape.mapping:
        return walk.read(spot, shape.mapping)
    if isinstance(spot.node, Scalar) and shape.scalar is not None and not is_null(spot.node):
        return walk.read(spot, shape.scalar)
    return walk.refuse(spot, shape, f"expected {shape.expected}")


def read_one_or_many(walk: ReadsShapes, spot: Spot, shape: OneOrMany) -> Any:
    """Read a list of items, or a single item as a list.

    Bare numbers, such as `[0, 0, 1, 100]`, are points without inner brackets, not a sum of items.
    """
    node = spot.node
    if not isinstance(node, Listing) or all(
        all(isinstance(item, Scalar) for item in row.items)
        if isinstance(row, Listing)
        else isinstance(row, Scalar) and len(node.items) > 1 and re.fullmatch(BARE, row.text)
        for row in node.items
    ):
        return [walk.read(spot, shape.item)]
    return walk.items(spot, node.items, shape.item)
