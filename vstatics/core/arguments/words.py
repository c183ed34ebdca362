"""Wording of messages about an argument: its expected type and the value received."""

from __future__ import annotations

import os
import typing
from collections.abc import Mapping
from types import NoneType, UnionType
from typing import Any, Literal

from vstatics.core.arguments.types import fits, is_of_rows
from vstatics.core.errors import spoken
from vstatics.core.suggestions import nearest

MAKERS = {
    "Transmission": "vstatics.load reads a file",
    "Results": "solve(case) gives them",
    "Scenario": "vstatics.load_scenario reads a file",
    "Motion": "vstatics.simulate(scenario) gives one",
    "TorsionScheme": "vstatics.torsion.gear_scheme(case, gear) gives one",
    "Gear": "such as case.gears[0]",
}
"""Advice on how to obtain an object, by class name."""
_WORDS = {
    float: "a number",
    int: "a whole number",
    bool: "True or False",
    str: "a text",
    bytes: "bytes",
    os.PathLike: "a path",
    Any: "anything",
    NoneType: "None",
}


def is_no_choice(given: object, hint: Any) -> bool:
    """Return whether a value is a text, but the type permits only other texts."""
    return isinstance(given, str) and bool(_choices(hint))


def _choices(hint: Any) -> list[str]:
    """Return the texts that a type lists; empty for other types."""
    if typing.get_origin(hint) is Literal:
        return [str(choice) for choice in typing.get_args(hint)]
    return [word for part in typing.get_args(hint) for word in _choices(part)]


def expected(given: object, hint: Any) -> str:
    """Return words for the expected type, with advice."""
    if isinstance(given, str) and (choices := _choices(hint)):
        return f"expected {_words(hint)}{nearest(given, choices)}"
    if isinstance(given, os.PathLike) and fits("", hint):
        return f"expected {_words(hint)}; vstatics.load reads a file"
    for kind in (hint, *typing.get_args(hint)):
        maker = MAKERS.get(getattr(kind, "__name__", ""), "")
        if maker:
            has_one = isinstance(kind, type) and isinstance(getattr(given, "case", None), kind)
            return f"expected {_words(hint)}; {'its `case` is one' if has_one else maker}"
    return f"expected {_words(hint)}"


def _words(hint: Any) -> str:
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    kind = origin or hint
    if kind in (typing.Union, UnionType):
        alternatives = dict.fromkeys(_words(part) for part in parts if part is not NoneType)
        if "a path" in alternatives:
            alternatives.pop("a text", None)  # a path is usually written as a text
        words = spoken(alternatives, "or")
    elif kind is Literal:
        words = spoken([repr(choice) for choice in parts], "or")
    elif kind in _WORDS:
        words = _WORDS[kind]
    elif kind.__module__ == "numpy":
        words = "an array"
    elif issubclass(kind, Mapping):
        words = f"a mapping of {' to '.join(map(_words, parts))}" if parts else "a mapping"
    elif is_of_rows(kind):
        words = f"a sequence of {_words(parts[0])}" if parts else "a sequence"
    elif getattr(kind, "_is_protocol", False):
        words = f"a {kind.__name__.lower()}"
    else:
        name = getattr(kind, "public_name", kind.__name__)
        words = name if name == "Results" else f"{'an' if name[0] in 'AEIO' else 'a'} {name}"
    return words


def type_and_value(given: object) -> str:
    """Return type and value of an argument as text, for a TypeError.

    >>> type_and_value("box.yaml")
    "str 'box.yaml'"
    """
    shown = " ".join(repr(given).split())
    if shown.startswith(f"<{type(given).__name__} "):
        return shown
    return f"{type(given).__name__} {shown if len(shown) <= 40 else shown[:37] + '...'}"
