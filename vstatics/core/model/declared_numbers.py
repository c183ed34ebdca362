"""Numbers that the shape of a document declares: one walk along the keys that lead to them.

`leaf_at` looks up the declaration at some keys, `bare_unit` its unit, and `numbers_below` lists all
numbers below a part of the model.
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
    KeyShape,
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
_NUMBERS = ("number", "count", "relative_torque", *get_args(Measure))
"""Kinds of single values that are numbers wherever they are."""


def leaf_at(shape: Shape, keys: Sequence[str]) -> Leaf | Parsed | None:
    """Return the declaration of the single value at some keys; items of lists by their numbers.

    None where there can be none, or keys alone do not decide it.
    """
    if isinstance(shape, Leaf | Parsed):
        return None if keys else shape
    below = _BELOW.get(shape.__class__)
    first, others = (keys[0], keys[1:]) if keys else ("", ())
    inner, left = below(shape, first, others) if below else (None, ())
    return leaf_at(inner, left) if inner else None


def bare_unit(shape: Shape, keys: Sequence[str]) -> str:
    """Return the unit of a bare number at some keys; empty without one, or if keys do not decide.

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
    """Return the numbers below a part of the model, also those that it leaves out.

    Laws and short forms are not entered: they are single numbers of their own kind.

    Parameters
    ----------
    shape : Shape
    part : object
        A record by its attributes or keys, a mapping of names, or a sequence.
    keys : tuple of str
        Keys of the part itself, which come first.

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
        case ListOf():
            names = (str(number) for number in range(1, len(part or ()) + 1))
    for name in names:
        inner, _ = _BELOW[shape.__class__](shape, name, ())
        assert inner is not None  # noqa: S101 - the names are declared
        yield from numbers_below(inner, value_at(part, name), (*keys, name))


def value_at(part: Any, key: str) -> Any:
    """Return the value of a part at a key: a number of an item from 1, None if it is left out."""
    if hasattr(part, "_fields"):
        return getattr(part, key, None)
    if isinstance(part, Sequence):
        return part[int(key) - 1]
    return part.get(key) if isinstance(part, Mapping) else getattr(part, key, None)


_Below = tuple[Shape | None, Sequence[str]]
"""Declaration at a key, or of the mapping or list there, and the keys that are left."""


def _of_keys(known: Iterable[KeyShape], first: str, others: Sequence[str]) -> _Below:
    return next((one.shape for one in known if one.name == first), None), others


def _by_key(shape: ByKey, first: str, others: Sequence[str]) -> _Below:
    return _of_keys(shape.keys, first, others)


def _by_kind(shape: ByKind, first: str, others: Sequence[str]) -> _Below:
    return _of_keys(
        (key for record in shape.records.values() for key in record.keys), first, others
    )


def _named(shape: ByName | Numbers, _: str, others: Sequence[str]) -> _Below:
    return shape.item, others


def _list_of(shape: ListOf, first: str, others: Sequence[str]) -> _Below:
    return shape.item if first.isdigit() else None, others


def _row(shape: RowOf, first: str, others: Sequence[str]) -> _Below:
    items = (*shape.items, *shape.optional)
    return next((items[n] for n in range(len(items)) if str(n + 1) == first), None), others


def _one_or_many(shape: OneOrMany, first: str, others: Sequence[str]) -> _Below:
    """Items of a list of lists are points of one."""
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


def _by_law(shape: ByLaw, first: str, others: Sequence[str]) -> _Below:
    if not first:
        return shape.scalar, ()
    return (shape.row, others) if first.isdigit() else (shape.mapping, (first, *others))


def _by_points(shape: ByPoints, first: str, others: Sequence[str]) -> _Below:
    if not first:
        return shape.row.items[1], ()
    return (shape.row, others) if first.isdigit() else (shape.mapping, (first, *others))


_BELOW: Mapping[type, Callable[[Any, str, Sequence[str]], _Below]] = {
    ByKey: _by_key,
    ByKind: _by_kind,
    ByName: _named,
    Numbers: _named,
    ListOf: _list_of,
    RowOf: _row,
    OneOrMany: _one_or_many,
    Either: _either,
    ByForm: _by_form,
    ByLaw: _by_law,
    ByPoints: _by_points,
}
