"""Reader of JSON documents of found gearboxes, which locates problems at the gearbox."""

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
"""Largest absolute value of a number accepted in a document."""
MOST_WRONG = 20
"""Largest number of problems reported for a document."""


def is_document(data: bytes) -> bool:
    """Return whether a text is a document of found gearboxes rather than a case.

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
    """Read the output of ``vstatics synth box -f json``.

    Returns
    -------
    BoxListing, dict
        Found gearboxes, and the whole document.

    Raises
    ------
    ReadError
        If the document is not valid; problems name the gearbox.
    """
    try:
        document = json.loads(data.decode("utf-8-sig"), parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        place = Source(file, data.decode("utf-8-sig")).place(error.lineno, error.colno)
        raise ReadError(
            "E803", f"not valid JSON: {error.msg}; expected {ASKED}", place=place
        ) from None
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else error
        raise ReadError([of_file("E804", file, f"the JSON cannot be read: {reason}")]) from None
    try:
        return listing_of(document), document
    except ReadError as error:
        raise ReadError(problem.in_file(file) for problem in error.problems) from None


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"read {name}, expected a number or null")


def listing_of(document: Any) -> BoxListing:
    """Return the gearboxes of a document, checked against the types of the records.

    Raises
    ------
    ReadError
        If the document is not valid; problems name the gearbox.

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
    wanted: WantedOfBoxes = _read(WantedOfBoxes, given, "wanted", problems)
    for name in ("gears", "spread", "steps"):
        ends = getattr(wanted, name)
        if len(ends) not in (0, 2):
            problems.append(
                Problem(
                    "E807",
                    f"wanted.{name}: read {type_and_value([*ends])}, expected two numbers or none",
                )
            )
    return wanted


def _box(given: Any, number: int, problems: list[Problem]) -> Iterator[ListedBox]:
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
    kinds = get_type_hints(record)
    return {key: kinds[key] for key in record._fields if key not in record._field_defaults}


_EXPECTED: Mapping[Any, tuple[str, Callable[[Any], bool]]] = {
    float: ("a number", lambda value: _is_number(value) and abs(value) < MOST_SIZE),
    int: ("a count", lambda value: isinstance(value, int) and _is_number(value) and value >= 0),
    bool: ("true or false", lambda value: isinstance(value, bool)),
    tuple: (
        "a list of names",
        lambda value: isinstance(value, list) and all(isinstance(name, str) for name in value),
    ),
    tuple[int, ...]: ("a list of counts", lambda value: _is_list(int, value)),
    tuple[float, ...]: ("a list of numbers", lambda value: _is_list(float, value)),
    tuple[tuple[float, ...], ...]: (
        "a list of ranges, each two numbers of one sign, the smaller one first",
        lambda value: isinstance(value, list) and all(map(_is_range, value)),
    ),
    dict: ("an object", lambda value: isinstance(value, dict)),
}
"""Description of each JSON type for messages, and a test whether a value has the type."""


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
    expected, is_such = _EXPECTED[kind]
    if is_such(given):
        return True
    problems.append(Problem("E807", f"{where}: read {type_and_value(given)}, expected {expected}"))
    return False


def _read(kind: Any, given: Any, where: str, problems: list[Problem]) -> Any:
    """Convert a JSON value to a type; record problems, and return an empty value if wrong."""
    return _within(kind, _outside(kind, given, where, problems), where, problems)


def _outside(kind: Any, given: Any, where: str, problems: list[Problem]) -> Any:
    """Convert a JSON value to a type, except for the values within an object or list."""
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
    """Convert the values within an object or list; create a record after checking all keys."""
    if hasattr(kind, "_fields"):
        kinds = _kinds(kind)
        parts = {
            key: _outside(part_kind, value.get(key), f"{where}.{key}", problems)
            for key, part_kind in kinds.items()
        }
        return kind(
            **{
                key: _within(part_kind, parts[key], f"{where}.{key}", problems)
                for key, part_kind in kinds.items()
            }
        )
    if kind == tuple[tuple[float, ...], ...]:
        return tuple(map(tuple, value))
    if get_origin(kind) is not Mapping:
        return value
    of_each = get_args(kind)[1]
    return {name: _read(of_each, part, f"{where}.{name}", problems) for name, part in value.items()}
