"""Found boxes as a document lists them, for pictures, a page and summaries; read back from JSON."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping
from typing import Annotated, Any, NamedTuple, NoReturn

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

    number: int
    code: SchemeCode
    elements: Mapping[str, tuple[str, ...]]
    """By name the two links that each joins, or a link and the housing."""
    ratios: Mapping[str, float]
    gears: Mapping[str, ListedGear]
    error: float
    loss: float
    planet_speed: float
    slip: float
    torque: float
    brakes: int
    clutches: int
    single: bool
    planar: bool
    family: Count
    pareto: bool
    case: Annotated[Mapping[str, Any], Words(description="As vstatics convert has it.")]
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
        number,
        box.scheme.code,
        found.elements,
        found.ratios,
        {gear.name: ListedGear(*gear[1:]) for gear in found.gears},
        *found.figures,
        ranked.family,
        ranked.pareto,
        mapping(found.case),
        box.input,
        box.output,
        box.held,
    )


@told("searched", "found", families="family_count", boxes="boxes")
class BoxListing(NamedTuple):
    """What a search for boxes has found."""

    searched: Count
    boxes: tuple[ListedBox, ...]

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


def read_boxes(data: bytes, file: str) -> BoxListing:
    """Read a document of found boxes, as ``vstatics synth box -f json`` writes it.

    Raises
    ------
    ReadError
        With what is wrong, at the box that it is in.
    """
    return read_document(data, file)[0]


def read_document(data: bytes, file: str) -> tuple[BoxListing, dict[str, Any]]:
    """The found boxes of a document, and the document; errors as of `read_boxes`."""
    try:
        document = json.loads(data.decode("utf-8-sig"), parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        place = Source(file, data.decode("utf-8-sig")).place(error.lineno, error.colno)
        message = f"not JSON: {error.msg}; expected {ASKED}"
        raise ReadError(message, place=place) from None
    except (ValueError, RecursionError) as error:
        raise ReadError([of_file(file, f"not JSON that can be read: {error}")]) from None
    try:
        return listing_of(document), document
    except ReadError as error:
        raise ReadError(of_file(file, one.message) for one in error.problems) from None


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
    BoxListing(searched=10, boxes=())
    """
    if not isinstance(document, dict) or not isinstance(document.get("boxes"), list):
        raise ReadError(f"expected {ASKED}: an object with `searched` and `boxes`")
    boxes: list[ListedBox] = []
    problems: list[Problem] = []
    searched = _whole(document.get("searched"), "searched", problems)
    for number, given in enumerate(document["boxes"], 1):
        if len(problems) >= MOST_WRONG:
            break
        own: list[Problem] = []
        box = _box(given, number, own)
        problems += own
        if box is not None and not own:
            boxes.append(box)
    if problems:
        raise ReadError(problems[:MOST_WRONG])
    return BoxListing(searched, tuple(boxes))


_FIGURES: tuple[str, ...] = ("error", "loss", "planet_speed", "slip", "torque")
_COUNTS: tuple[str, ...] = ("brakes", "clutches", "family")
_MARKS: tuple[str, ...] = ("single", "planar", "pareto")


_Reader = Callable[[Any, str, list[Problem]], Any]
"""Reads a value of a place, and keeps what is wrong with it."""


def _box(given: Any, number: int, problems: list[Problem]) -> ListedBox | None:
    where = f"box {number}"
    if not isinstance(given, dict):
        problems.append(Problem(f"{where}: read {type_and_value(given)}, expected an object"))
        return None
    expected = [*_FIGURES, *_COUNTS, *_MARKS, "code", "elements", "ratios", "gears", "case"]
    missing = [key for key in expected if key not in given]
    if missing:
        keys = ", ".join(f"`{key}`" for key in missing)
        problems.append(Problem(f"{where}: expected the {plural('key', len(missing))} {keys}"))
        return None
    fields: dict[str, Any] = {"number": number, "code": str(given["code"])}
    kinds: list[tuple[tuple[str, ...], _Reader]] = [
        (_FIGURES, _number),
        (_COUNTS, _whole),
        (_MARKS, _mark),
    ]
    for its_keys, read in kinds:
        fields |= {key: read(given[key], f"{where}.{key}", problems) for key in its_keys}
    parts = {
        key: _mapping(given[key], f"{where}.{key}", problems)
        for key in ("elements", "ratios", "gears", "case")
    }
    readers: dict[str, _Reader] = {"elements": _names, "ratios": _number, "gears": _gear}
    for key, of_each in readers.items():
        fields[key] = {
            name: of_each(value, f"{where}.{key}.{name}", problems)
            for name, value in parts[key].items()
        }
    return ListedBox(**fields, case=parts["case"])


def _gear(given: Any, where: str, problems: list[Problem]) -> ListedGear:
    parts = _mapping(given, where, problems)
    return ListedGear(
        _names(parts.get("engaged"), f"{where}.engaged", problems),
        _number(parts.get("ratio"), f"{where}.ratio", problems),
        _number(parts.get("target"), f"{where}.target", problems),
    )


def _number(given: Any, where: str, problems: list[Problem]) -> float:
    """A number; NaN of what has none."""
    if given is None:
        return math.nan
    if isinstance(given, int | float) and not isinstance(given, bool) and abs(given) < 1e300:
        return float(given)
    problems.append(Problem(f"{where}: read {type_and_value(given)}, expected a number"))
    return math.nan


def _whole(given: Any, where: str, problems: list[Problem]) -> int:
    if isinstance(given, int) and not isinstance(given, bool) and given >= 0:
        return given
    problems.append(Problem(f"{where}: read {type_and_value(given)}, expected a count"))
    return 0


def _mark(given: Any, where: str, problems: list[Problem]) -> bool:
    if isinstance(given, bool):
        return given
    problems.append(Problem(f"{where}: read {type_and_value(given)}, expected true or false"))
    return False


def _names(given: Any, where: str, problems: list[Problem]) -> tuple[str, ...]:
    if isinstance(given, list) and all(isinstance(one, str) for one in given):
        return tuple(given)
    problems.append(Problem(f"{where}: read {type_and_value(given)}, expected a list of names"))
    return ()


def _mapping(given: Any, where: str, problems: list[Problem]) -> Mapping[str, Any]:
    if isinstance(given, dict):
        return given
    problems.append(Problem(f"{where}: read {type_and_value(given)}, expected an object"))
    return {}
