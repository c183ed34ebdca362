"""Comparison of values with the types that a function declares for its arguments."""

from __future__ import annotations

import builtins
import collections.abc
import inspect
import os
import sys
import typing
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from importlib import import_module
from itertools import islice
from types import NoneType, UnionType
from typing import Any, Literal

MOST = 1000
"""Number of items of a sequence or mapping whose types are compared."""


class _AnnotationNames(dict[str, Any]):
    """Mapping from names in annotations to types. An unknown name means any type."""

    def __init__(self, module: Mapping[str, Any], classes: Mapping[str, str]) -> None:
        super().__init__()
        self.module, self.classes = module, classes

    def __missing__(self, name: str) -> Any:
        if name in self.module:
            return self.module[name]
        if self.classes.get(name):
            return getattr(import_module(self.classes[name]), name)
        for holder in (builtins, collections.abc, typing):
            if hasattr(holder, name):
                return getattr(holder, name)
        if name == "ArrayLike":
            return import_module("numpy").ndarray
        return os if name == "os" else Any


def hints(function: Any, classes: Mapping[str, str]) -> dict[str, Any]:
    """Return the types of arguments of a function, or of fields of a class."""
    names_of_module = (
        vars(sys.modules[function.__module__])
        if isinstance(function, type)
        else inspect.unwrap(function).__globals__
    )
    resolved = typing.get_type_hints(
        function, names_of_module, _AnnotationNames(names_of_module, classes)
    )
    return {name: hint for name, hint in resolved.items() if name != "return"}


def fits(given: object, hint: Any) -> bool:
    """Return whether a value has a type; the items of an iterator are not checked.

    >>> fits([1, "R"], Sequence[int | str] | None), fits("12", Sequence[int | str])
    (True, False)
    """
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    kind = origin or hint
    if kind in (typing.Union, UnionType):
        fit = any(fits(given, part) for part in parts)
    elif kind is Literal:
        fit = isinstance(given, Hashable) and given in parts
    elif kind in _BASIC:
        fit = _BASIC[kind](given)
    elif not isinstance(kind, type):
        fit = True
    elif kind.__module__ == "numpy":
        fit = _is_row(given) or _is_number(given) or hasattr(given, "__array__")
    elif issubclass(kind, Mapping):
        fit = hasattr(given, "keys") and _parts_fit(given, parts)  # pandas tables also have keys
    elif is_of_rows(kind):
        fit = _is_row(given) and _each_fits(given, parts)
    else:
        fit = isinstance(given, kind)
    return fit


def is_of_rows(kind: type) -> bool:
    """Return whether a type is a general sequence type, such as `Iterable`."""
    return kind.__module__ in {"collections.abc", "builtins"} and issubclass(kind, Iterable)


def _is_row(given: object) -> bool:
    """Return whether a value is a sequence and not a text."""
    return (
        isinstance(given, Iterable)
        and not isinstance(given, str | bytes | bytearray | Mapping)
        and getattr(given, "ndim", 1) != 0
    )


def _each_fits(given: Any, parts: Sequence[Any]) -> bool:
    if not parts or not isinstance(given, Sequence):
        return True  # checking would consume an iterator, and an array contains numbers
    if parts[-1] is not Ellipsis and len(parts) > 1:
        return len(given) == len(parts) and all(map(fits, given, parts))
    return all(fits(item, parts[0]) for item in islice(given, MOST))


def _parts_fit(given: Any, parts: Sequence[Any]) -> bool:
    if not (parts and isinstance(given, Mapping)):
        return True
    return all(fits(a, parts[0]) and fits(b, parts[1]) for a, b in islice(given.items(), MOST))


def _is_number(given: object) -> bool:
    return hasattr(given, "__float__") and getattr(given, "ndim", 0) == 0


def _is_whole(given: object) -> bool:
    return hasattr(given, "__index__") and getattr(given, "ndim", 0) == 0


def _is_truth(given: object) -> bool:
    return _is_whole(given) or type(given).__name__ in {"bool", "bool_"}


_BASIC: Mapping[Any, Callable[[object], bool]] = {
    object: lambda _: True,
    Any: lambda _: True,
    NoneType: lambda given: given is None,
    str: lambda given: isinstance(given, str),
    bytes: lambda given: isinstance(given, bytes | bytearray),
    float: _is_number,
    int: _is_whole,
    bool: _is_truth,
}
