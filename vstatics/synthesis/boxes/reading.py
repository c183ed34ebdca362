"""Documents of found boxes, read back from JSON, with what is wrong told at its box."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any, NoReturn, get_args, get_origin, get_type_hints

from vstatics.core.arguments import type_and_value
from vstatics.core.errors import Problem, ReadError, of_file, plural
from vstatics.core.readers.reading import Source
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox, WantedOfBoxes

ASKED = "a document of found boxes, as `vstatics synth box -f json` writes it"
MOST_SIZE = 1e300
"""Of a number of a document."""
MOST_WRONG = 20
"""So many problems of a document are told."""


def is_document(data: bytes) -> bool:
    """Whether a text is a document of found boxes, and not a case.

    >>> is_document(b'{"searched": 10, "found": 0, "families": 0, "boxes": []}')
    True
    >>> is_document(b'{"links": 3, "gears": {"boxes": []}}')
    False
    """
    if b'"boxes"' not in data or b'"searched"' not in data:
        return False
    if _BEGINNING.match(data):
        return True
    try:
        document = json.loads(data)
    except (ValueError, RecursionError):
        return False
    return isinstance(document, dict) and {"searched", "boxes"} <= document.keys()


_BEGINNING = re.compile(rb'(?:\xef\xbb\xbf)?\s*\{\s*"searched"\s*:')


def read_document(data: bytes, file: str) -> tuple[BoxListing, dict[str, Any]]:
    """What ``vstatics synth box -f json`` writes: the found boxes, and the document itself.

    Raises
    ------
    ReadError
        With what is wrong, at the box that it is in.
    """
    try:
        document = json.loads(data.decode("utf-8-sig"), parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        place = Source(file, data.decode("utf-8-sig")).place(error.lineno, error.colno)
        message = f"not JSON: {error.msg}; expected {ASKED}"
        raise ReadError("E803", message, place=place) from None
    except (ValueError, RecursionError) as error:
        told = "nested too deeply" if isinstance(error, RecursionError) else error
        raise ReadError([of_file("E804", file, f"not JSON that can be read: {told}")]) from None
    try:
        return listing_of(document), document
    except ReadError as error:
        raise ReadError(one.in_file(file) for one in error.problems) from None


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"read {name}, expected a number or null")


def listing_of(document: Any) -> BoxListing:
    """The found boxes of a document that was read or made.

    Raises
    ------
    ReadError
        With what is wrong, at the box that it is in.

    Examples
    --------
    >>> listing_of({"searched": 10, "boxes": []})
    BoxListing(searched=10, boxes=(), given_up=0, wanted=None)
    """
    if not isinstance(document, dict) or not isinstance(document.get("boxes"), list):
        raise ReadError("E805", f"expected {ASKED}: an object with `searched` and `boxes`")
    boxes: list[ListedBox] = []
    problems: list[Problem] = []
    searched = _read(int, document.get("searched"), "searched", problems)
    given_up = _read(int, document.get("given_up", 0), "given_up", problems)
    wanted = _wanted(document["wanted"], problems) if "wanted" in document else None
    for number, given in enumerate(document["boxes"], 1):
        if len(problems) >= MOST_WRONG:
            break
        boxes += _box(given, number, problems)
    if problems:
        raise ReadError(problems[:MOST_WRONG])
    return BoxListing(searched, tuple(boxes), given_up, wanted)


def _wanted(given: Any, problems: list[Problem]) -> WantedOfBoxes:
    """What was asked, if it is that; what is wrong with it is told."""
    found: WantedOfBoxes = _read(WantedOfBoxes, given, "wanted", problems)
    for name in ("gears", "spread", "steps"):
        ends = getattr(found, name)
        if len(ends) not in (0, 2):
            message = f"wanted.{name}: read {type_and_value([*ends])}, expected two numbers or none"
            problems.append(Problem("E807", message))
    return found


def _box(given: Any, number: int, problems: list[Problem]) -> Iterator[ListedBox]:
    """A box, if it is one; what is wrong with it is told."""
    where = f"box {number}"
    if _fits(dict, given, where, problems):
        missing = [f"`{key}`" for key in _kinds(ListedBox) if key not in given]
        if missing:
            noun = plural("key", len(missing))
            problems.append(Problem("E806", f"{where}: expected the {noun} {', '.join(missing)}"))
        else:
            yield _read(ListedBox, given, where, problems)._replace(number=number)


@cache
def _kinds(record: Any) -> dict[str, Any]:
    """The types of the keys that a record has."""
    kinds = get_type_hints(record)
    return {key: kinds[key] for key in record._fields if key not in record._field_defaults}


_EXPECTED: Mapping[Any, tuple[str, Callable[[Any], bool]]] = {
    float: ("a number", lambda one: _is_number(one) and abs(one) < MOST_SIZE),
    int: ("a count", lambda one: isinstance(one, int) and _is_number(one) and one >= 0),
    bool: ("true or false", lambda one: isinstance(one, bool)),
    tuple: (
        "a list of names",
        lambda one: isinstance(one, list) and all(isinstance(name, str) for name in one),
    ),
    tuple[int, ...]: ("a list of counts", lambda one: _is_list(int, one)),
    tuple[float, ...]: ("a list of numbers", lambda one: _is_list(float, one)),
    tuple[tuple[float, ...], ...]: (
        "a list of ranges, each two numbers of one sign, the smaller one first",
        lambda one: isinstance(one, list) and all(map(_is_range, one)),
    ),
    dict: ("an object", lambda one: isinstance(one, dict)),
}
"""By the type of a value: what is expected of JSON, and whether something is such."""


def _is_list(kind: Any, given: Any) -> bool:
    return isinstance(given, list) and all(map(_EXPECTED[kind][1], given))


def _is_range(given: Any) -> bool:
    if not _is_list(float, given) or len(given) != 2:
        return False
    low, high = given
    return bool(low * high > 0 and low < high)


def _is_number(given: Any) -> bool:
    return isinstance(given, int | float) and not isinstance(given, bool)


def _fits(kind: Any, given: Any, where: str, problems: list[Problem]) -> bool:
    """Whether a value is of a type; it is told if not."""
    expected, is_such = _EXPECTED[kind]
    if is_such(given):
        return True
    problems.append(Problem("E807", f"{where}: read {type_and_value(given)}, expected {expected}"))
    return False


def _read(kind: Any, given: Any, where: str, problems: list[Problem]) -> Any:
    """What a type makes of JSON; what is wrong is told, and something stands in its place."""
    return _within(kind, _outside(kind, given, where, problems), where, problems)


def _outside(kind: Any, given: Any, where: str, problems: list[Problem]) -> Any:
    """The same, but for what is in an object."""
    if kind in (str, Any):
        return given if kind is Any else str(given)
    if kind == str | None:
        return None if given is None else str(given)
    if kind is float and given is None:
        return math.nan
    plain = kind if kind in _EXPECTED else get_origin(kind) or kind
    if plain is Mapping or hasattr(kind, "_fields"):
        plain = dict
    return plain(given) if _fits(plain, given, where, problems) else plain()


def _within(kind: Any, value: Any, where: str, problems: list[Problem]) -> Any:
    """What is in an object, of a record only when all of its keys are looked at."""
    if hasattr(kind, "_fields"):
        kinds = _kinds(kind)
        parts = {
            key: _outside(one, value.get(key), f"{where}.{key}", problems)
            for key, one in kinds.items()
        }
        return kind(
            **{
                key: _within(one, parts[key], f"{where}.{key}", problems)
                for key, one in kinds.items()
            }
        )
    if kind == tuple[tuple[float, ...], ...]:
        return tuple(map(tuple, value))
    if get_origin(kind) is not Mapping:
        return value
    of_each = get_args(kind)[1]
    return {name: _read(of_each, one, f"{where}.{name}", problems) for name, one in value.items()}
