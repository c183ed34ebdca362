"""Found boxes as a document lists them, for pictures, a page and summaries; read back from JSON."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Annotated, Any, NamedTuple, NoReturn, get_args, get_origin, get_type_hints

from vstatics.errors import Problem, ReadError, of_file, plural, type_and_value
from vstatics.model.transmission import Transmission
from vstatics.readers import from_dict
from vstatics.readers.reading import Source
from vstatics.synthesis.boxes.box import BoxFigures
from vstatics.synthesis.boxes.choice import RankedBox
from vstatics.synthesis.structures.growth import SchemeCode
from vstatics.tables.answer import Count, Sometimes, Words, told
from vstatics.writers.named import mapping


class ListedGear(NamedTuple):
    """A gear of a listed box."""

    engaged: tuple[str, ...]
    ratio: float
    target: float


@told(
    *("code", "input", "output", "held", "elements", "ratios", "gears"),
    *BoxFigures._fields,
    *("family", "pareto", "case"),
)
class ListedBox(NamedTuple):
    """A box of a document, with its number in the order of the document from 1."""

    error: float
    loss: float
    planet_speed: float
    slip: float
    torque: float
    brakes: int
    clutches: int
    family: Count
    single: bool
    planar: bool
    pareto: bool
    code: SchemeCode
    elements: Mapping[str, tuple[str, ...]]
    """By name the two links that each joins, or a link and the housing."""
    ratios: Mapping[str, float]
    gears: Mapping[str, ListedGear]
    case: Annotated[Mapping[str, Any], Words(description="As vstatics convert has it.")]
    number: int = 0
    input: Count = 0
    """Links of the code; 0 where the document was read, which needs them not."""
    output: Count = 0
    held: Sometimes[Count] = None

    def transmission(self) -> Transmission:
        """Its case.

        Raises
        ------
        ReadError
            If what stands there is none.
        """
        try:
            return from_dict(self.case)
        except ReadError as error:
            name = f"case of box {self.number}"
            raise ReadError(
                one._replace(message=f"{name}: {one.message}") for one in error.problems
            ) from None


def listed_box(number: int, ranked: RankedBox) -> ListedBox:
    """A found box as it is listed."""
    found, box = ranked.found, ranked.found.box
    return ListedBox(
        **found.figures._asdict(),
        family=ranked.family,
        pareto=ranked.pareto,
        code=box.scheme.code,
        elements=found.elements,
        ratios=found.ratios,
        gears={gear.name: ListedGear(*gear[1:]) for gear in found.gears},
        case=mapping(found.case),
        number=number,
        input=box.input,
        output=box.output,
        held=box.held,
    )


@told(
    *("searched", "found", "complete", "given_up"),
    families="family_count",
    boxes="boxes",
)
class BoxListing(NamedTuple):
    """What a search for boxes has found."""

    searched: Count
    boxes: tuple[ListedBox, ...]
    given_up: Count = 0
    """Sets of elements that may be boxes, too, but could not be looked at to the end."""

    @property
    def complete(self) -> bool:
        """Whether there are no other boxes."""
        return not self.given_up

    @property
    def found(self) -> Count:
        """How many boxes there are."""
        return len(self.boxes)

    @property
    def family_count(self) -> Count:
        """How many families they are."""
        return len(self.families)

    @property
    def families(self) -> dict[int, list[ListedBox]]:
        """The boxes with equal ratios in all gears, by the number of their family."""
        found: dict[int, list[ListedBox]] = {}
        for box in self.boxes:
            found.setdefault(box.family, []).append(box)
        return found


def drawn_boxes(listing: BoxListing, most: int) -> list[ListedBox]:
    """The boxes that get a diagram, in the order of the document.

    First come those of the Pareto list, each of another family, then the first of each other
    family, the rest of the Pareto list, and the rest.
    """
    seen: set[int] = set()
    ranks: list[tuple[int, int, ListedBox]] = []
    for box in sorted(listing.boxes, key=lambda box: (not box.pareto, box.number)):
        is_first = box.family not in seen
        seen.add(box.family)
        rank = (0 if box.pareto else 1) if is_first else (2 if box.pareto else 3)
        ranks.append((rank, box.number, box))
    return sorted((box for *_, box in sorted(ranks)[:most]), key=lambda box: box.number)


ASKED = "a document of found boxes, as `vstatics synth box -f json` writes it"
MOST_SIZE = 1e300
"""Of a number of a document."""
MOST_WRONG = 20
"""So many problems of a document are told."""


def is_listing(data: bytes) -> bool:
    """Whether a text is a document of found boxes, and not a case.

    >>> is_listing(b'{"searched": 10, "found": 0, "families": 0, "boxes": []}')
    True
    >>> is_listing(b'{"links": 3, "gears": {"boxes": []}}')
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
        raise ReadError([of_file("E804", file, f"not JSON that can be read: {error}")]) from None
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
    BoxListing(searched=10, boxes=(), given_up=0)
    """
    if not isinstance(document, dict) or not isinstance(document.get("boxes"), list):
        raise ReadError("E805", f"expected {ASKED}: an object with `searched` and `boxes`")
    boxes: list[ListedBox] = []
    problems: list[Problem] = []
    searched = _read(int, document.get("searched"), "searched", problems)
    given_up = _read(int, document.get("given_up", 0), "given_up", problems)
    for number, given in enumerate(document["boxes"], 1):
        if len(problems) >= MOST_WRONG:
            break
        boxes += _box(given, number, problems)
    if problems:
        raise ReadError(problems[:MOST_WRONG])
    return BoxListing(searched, tuple(boxes), given_up)


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
    dict: ("an object", lambda one: isinstance(one, dict)),
}
"""By the type of a value: what is expected of JSON, and whether something is such."""


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
    if kind is float and given is None:
        return math.nan
    plain = get_origin(kind) or kind
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
    if get_origin(kind) is not Mapping:
        return value
    of_each = get_args(kind)[1]
    return {name: _read(of_each, one, f"{where}.{name}", problems) for name, one in value.items()}
