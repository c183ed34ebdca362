"""Whether something is of the type that a function declares for it."""

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
"""Of so many parts of a sequence or mapping the types are looked at."""


class _AnnotationNames(dict[str, Any]):
    """Names as annotations mean them; those that nobody knows now stand for anything."""

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
    """The types of a function's arguments, or of a class's fields, resolved when it is called."""
    own = (
        vars(sys.modules[function.__module__])
        if isinstance(function, type)
        else inspect.unwrap(function).__globals__
    )
    found = typing.get_type_hints(function, own, _AnnotationNames(own, classes))
    return {name: hint for name, hint in found.items() if name != "return"}


def fits(given: object, hint: Any) -> bool:
    """Whether something is of a type, as far as that can be seen without using it up.

    >>> fits([1, "R"], Sequence[int | str] | None), fits("12", Sequence[int | str])
    (True, False)
    """
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    kind = origin or hint
    if kind in (typing.Union, UnionType):
        fit = any(fits(given, one) for one in parts)
    elif kind is Literal:
        fit = isinstance(given, Hashable) and given in parts
    elif kind in _BASIC:
        fit = _BASIC[kind](given)
    elif not isinstance(kind, type):
        fit = True
    elif kind.__module__ == "numpy":
        fit = _is_row(given) or _is_number(given) or hasattr(given, "__array__")
    elif issubclass(kind, Mapping):
        fit = hasattr(given, "keys") and _parts_fit(given, parts)  # as a table of pandas has
    elif is_of_rows(kind):
        fit = _is_row(given) and _each_fits(given, parts)
    else:
        fit = isinstance(given, kind)
    return fit


def is_of_rows(kind: type) -> bool:
    """Whether a type is a sequence of whatever class, such as `Iterable`."""
    return kind.__module__ in {"collections.abc", "builtins"} and issubclass(kind, Iterable)


def _is_row(given: object) -> bool:
    """Whether it is a row of things; a text is none, although it has letters."""
    return (
        isinstance(given, Iterable)
        and not isinstance(given, str | bytes | bytearray | Mapping)
        and getattr(given, "ndim", 1) != 0
    )


def _each_fits(given: Any, parts: Sequence[Any]) -> bool:
    if not parts or not isinstance(given, Sequence):
        return True  # an iterator would be used up, an array is of numbers
    if parts[-1] is not Ellipsis and len(parts) > 1:
        return len(given) == len(parts) and all(map(fits, given, parts))
    return all(fits(one, parts[0]) for one in islice(given, MOST))


def _parts_fit(given: Any, parts: Sequence[Any]) -> bool:
    if not (parts and isinstance(given, Mapping)):
        return True
    return all(fits(a, parts[0]) and fits(b, parts[1]) for a, b in islice(given.items(), MOST))


def _is_number(given: object) -> bool:
    """Of Python or of NumPy: one that is no text."""
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
