"""Search for the declaration of a number in a document, by the keys of the number.

A document is a case in YAML or JSON. Its shape declares the keys and their values. `leaf_at` finds
the declaration of a value, `bare_unit` the unit of a number written without a unit, and
`numbers_below` all numbers of a part of the model.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, get_args

from vstatics.core.model.paths import Keys
from vstatics.core.model.shape import (
    UNIT_OF,
    ByForm,
    ByKey,
    ByKind,
    ByLaw,
    ByName,
    ByPoints,
    Either,
    Leaf,
    ListOf,
    Measure,
    Numbers,
    OneOrMany,
    Parsed,
    RowOf,
    Shape,
)

_UNITS = {str(kind): unit for kind, unit in UNIT_OF.items()}
_NUMBERS = ("number", "count", "relative_torque", "efficiency", *get_args(Measure))
"""Kinds of single values (leaves) that are always numbers, never words."""


def leaf_at(shape: Shape, keys: Sequence[str]) -> Leaf | Parsed | None:
    """Return the declaration of the single value at the given keys; list items count from 1.

    The result is None if the keys cannot lead to a single value, or if the declaration depends on
    other values of the document.
    """
    if isinstance(shape, Leaf | Parsed):
        return None if keys else shape
    below = _BELOW.get(shape.__class__)
    first, others = (keys[0], keys[1:]) if keys else ("", ())
    inner, left = below(shape, first, others) if below else (None, ())
    return leaf_at(inner, left) if inner else None


def bare_unit(shape: Shape, keys: Sequence[str]) -> str:
    """Return the unit of a number written without a unit at the given keys; empty if dimensionless.

    Examples
    --------
    >>> from vstatics.core.model.keys import CASE
    >>> bare_unit(CASE, ["inertias", "w"]), bare_unit(CASE, ["springs", "s", "stiffness"])
    ('kg*m^2', 'N*m/rad')
    """
    leaf = leaf_at(shape, keys)
    if isinstance(leaf, Parsed):
        return leaf.unit
    return _UNITS.get(leaf.kind, "") if leaf else ""


def numbers_below(shape: Shape, part: Any, keys: Keys = ()) -> Iterator[tuple[Keys, Leaf]]:
    """Yield keys and declarations of all numbers in a part of the model, even omitted numbers.

    Numbers within laws and short forms are not yielded.

    Parameters
    ----------
    shape : Shape
    part : object
        Part of the model: an object with attributes, a mapping or a sequence.
    keys : tuple of str
        Keys of the part itself, to which the keys of the numbers are appended.

    Examples
    --------
    >>> from vstatics.core.model.keys import FRICTION
    >>> [keys for keys, leaf in numbers_below(FRICTION, {}) if leaf.kind == "count"]
    [('surfaces',)]
    """
    names: Iterable[str] = ()
    match shape:
        case Leaf() if shape.kind in _NUMBERS:
            yield keys, shape
        case ByKey(make=make) if part is not None or make is dict:
            names = (key.name for key in shape.keys)
        case ByName():
            names = part or ()
        case ByLaw(scalar=Leaf() as scalar) if not hasattr(part, "over"):
            yield from numbers_below(scalar, part, keys)
        case ListOf():
            names = (str(number) for number in range(1, len(part or ()) + 1))
    for name in names:
        inner, _ = _BELOW[shape.__class__](shape, name, ())
        assert inner is not None  # noqa: S101 - the names are declared
        yield from numbers_below(inner, value_at(part, name), (*keys, name))


def value_at(part: Any, key: str) -> Any:
    """Return the value of a part under a key or item number (from 1); None if omitted."""
    if hasattr(part, "_fields"):
        return getattr(part, key, None)
    if isinstance(part, Sequence):
        return part[int(key) - 1]
    return part.get(key) if isinstance(part, Mapping) else getattr(part, key, None)


_Below = tuple[Shape | None, Sequence[str]]
"""Declaration of the value under the first key, and the keys to follow from there."""


def _by_key(shape: ByKey | ByKind, first: str, others: Sequence[str]) -> _Below:
    return next((key.shape for key in shape.keys if key.name == first), None), others


def _named(shape: ByName | Numbers, _: str, others: Sequence[str]) -> _Below:
    return shape.item, others


def _list_of(shape: ListOf, first: str, others: Sequence[str]) -> _Below:
    return shape.item if first.isdigit() else None, others


def _row(shape: RowOf, first: str, others: Sequence[str]) -> _Below:
    shapes = shape.shapes(int(first)) if first.isdigit() else ()
    return (shapes[-1] if len(shapes) == int(first or 0) > 0 else None), others


def _one_or_many(shape: OneOrMany, first: str, others: Sequence[str]) -> _Below:
    # Two item numbers in a row, such as `1.2`, address a list of points, which is a single item.
    is_many = first.isdigit() and not (others and others[0].isdigit())
    return shape.item, others if is_many else (first, *others) if first else ()


def _either(shape: Either, first: str, others: Sequence[str]) -> _Below:
    if first and not first.isdigit():
        return shape.record, (first, *others)
    return shape.short, (first, *others) if first else ()


def _by_form(shape: ByForm, first: str, others: Sequence[str]) -> _Below:
    if not first:
        return shape.scalar, ()
    return shape.listing if first.isdigit() else shape.mapping, (first, *others)


def _by_law(shape: ByLaw | ByPoints, first: str, others: Sequence[str]) -> _Below:
    if not first:
        return shape.scalar, ()
    return (shape.row, others) if first.isdigit() else (shape.mapping, (first, *others))


_BELOW: Mapping[type, Callable[[Any, str, Sequence[str]], _Below]] = {
    ByKey: _by_key,
    ByKind: _by_key,
    ByName: _named,
    Numbers: _named,
    ListOf: _list_of,
    RowOf: _row,
    OneOrMany: _one_or_many,
    Either: _either,
    ByForm: _by_form,
    ByLaw: _by_law,
    ByPoints: _by_law,
}
