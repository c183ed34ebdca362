"""In what bare numbers of documents are: told by the shape of what stands at their keys."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

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
    Numbers,
    OneOrMany,
    Parsed,
    RowOf,
    Shape,
)

_UNITS = {str(kind): unit for kind, unit in UNIT_OF.items()}


def bare_unit(shape: Shape, keys: Sequence[str]) -> str:
    """In what a bare number is, by the keys that lead to it; items of lists by their numbers.

    Nothing where it has no unit, or one that its keys do not tell.

    Examples
    --------
    >>> from vstatics.simulation.scenario.keys import SCENARIO
    >>> bare_unit(SCENARIO, ["duration"]), bare_unit(SCENARIO, ["speeds", "out", "2", "2"])
    ('s', 'rad/s')
    >>> bare_unit(SCENARIO, ["torques", "out", "road", "radius"])
    'm'
    >>> bare_unit(SCENARIO, ["torques", "out", "road", "slope"])
    ''
    """
    if isinstance(shape, Parsed):
        return "" if keys else shape.unit
    if isinstance(shape, Leaf):
        return "" if keys else _UNITS.get(shape.kind, "")
    below = _BELOW.get(shape.__class__)
    first, rest = (keys[0], keys[1:]) if keys else ("", ())
    found, others = below(shape, first, rest) if below else (None, ())
    return bare_unit(found, others) if found else ""


_Below = tuple[Shape | None, Sequence[str]]
"""What stands at a key, or in the place of a mapping or list, and the keys from there."""


def _of_keys(known: Iterable[KeyShape], first: str, rest: Sequence[str]) -> _Below:
    return next((one.shape for one in known if one.name == first), None), rest


def _by_key(shape: ByKey, first: str, rest: Sequence[str]) -> _Below:
    return _of_keys(shape.keys, first, rest)


def _by_kind(shape: ByKind, first: str, rest: Sequence[str]) -> _Below:
    return _of_keys((key for record in shape.records.values() for key in record.keys), first, rest)


def _named(shape: ByName | Numbers, _: str, rest: Sequence[str]) -> _Below:
    return shape.item, rest


def _list_of(shape: ListOf, first: str, rest: Sequence[str]) -> _Below:
    return shape.item if first.isdigit() else None, rest


def _row(shape: RowOf, first: str, rest: Sequence[str]) -> _Below:
    items = (*shape.items, *shape.optional)
    return next((items[n] for n in range(len(items)) if str(n + 1) == first), None), rest


def _one_or_many(shape: OneOrMany, first: str, rest: Sequence[str]) -> _Below:
    """Items of a list of lists are points of one."""
    is_many = first.isdigit() and not (rest and rest[0].isdigit())
    return shape.item, rest if is_many else (first, *rest) if first else ()


def _either(shape: Either, first: str, rest: Sequence[str]) -> _Below:
    if first and not first.isdigit():
        return shape.record, (first, *rest)
    return shape.short, (first, *rest) if first else ()


def _by_form(shape: ByForm, first: str, rest: Sequence[str]) -> _Below:
    if not first:
        return shape.scalar, ()
    return shape.listing if first.isdigit() else shape.mapping, (first, *rest)


def _by_law(shape: ByLaw, first: str, rest: Sequence[str]) -> _Below:
    if not first:
        return shape.scalar, ()
    return (shape.row, rest) if first.isdigit() else (shape.mapping, (first, *rest))


def _by_points(shape: ByPoints, first: str, rest: Sequence[str]) -> _Below:
    if not first:
        return shape.row.items[1], ()
    return (shape.row, rest) if first.isdigit() else (shape.mapping, (first, *rest))


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
