"""Reader of the deck, the input format of the published Visual-Statics example.

The last deck without errors and warnings is stored. If the next deck differs from it only in
numbers of mechanisms, only the changed lines are read, and only these numbers are checked. In all
other cases a deck is read in full.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any

from vstatics.core.errors import CaseError, Path, Place, Problem, ReadError
from vstatics.core.model.checks import doubts
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.readers.deck.fields import Fields
from vstatics.core.readers.deck.numbers import integer, plain_numbers, real, value_lines
from vstatics.core.readers.deck.places import KINDS
from vstatics.core.readers.deck.table import FIELDS
from vstatics.core.readers.deck.text import SPRINGS, Scan, scan, texts
from vstatics.core.readers.reading import Reading, Source, finish

_known: KnownDeck | None = None
"""Last deck that was read in full without errors and warnings."""

NO_SPRINGS = "0: a deck has no springs; take the YAML or JSON of this case"
NAMED = {"J": "link", "F": "shift element", "D": "mechanism", "P": "gear", "T": "title"}

LONGEST_REMEMBERED_DECK = 20_000
"""Maximum number of characters of a stored deck, to limit memory."""


def read(data: bytes, file: str) -> Reading:
    r"""Read a deck, or a printed listing that begins with a deck.

    Parameters
    ----------
    data : bytes
        Content of the file in UTF-8, Windows-1251, CP866 or KOI8-R.
    file : str
        Name of the file, for messages.

    Returns
    -------
    Reading
        The transmission, its warnings, and the places of its parts.

    Raises
    ------
    ReadError
        The error contains every problem and its place.

    Examples
    --------
    >>> text = "KJG=2 KL=0 KG=1 NP=1\nNZD(I,1): 1\nNZD(I,2): 2\nNZD(I,3): 0\nIAB= 3.5\n"
    >>> read(f"{text}ETAI= 1\nKFRI= 0\n".encode(), "pair.dat").case
    <Transmission: 2 links, 0 shift elements, 1 mechanism, 1 gear>
    """
    best: Reading | ReadError | None = None
    fewest = (0, 0)
    for text, damage in texts(data, file):
        try:
            result: Reading | ReadError = _read_text(text, file, damage)
        except ReadError as error:
            result = error
        problems = result.warnings if isinstance(result, Reading) else result.problems
        score = sum(problem.severity == "error" for problem in problems), len(problems)
        damaged = bool(damage) and score[0] <= fewest[0]  # damaged UTF-8 explains as many errors
        if best is None or score < fewest or damaged:
            best, fewest = result, score
        if fewest == (0, 0):
            break
    assert best is not None  # noqa: S101 - `texts` yields at least one text, or raises
    if isinstance(best, ReadError):
        raise best
    return best


def _read_text(text: str, file: str, damage: Iterable[Problem]) -> Reading:
    source = Source(file, text)
    case = None if damage or _known is None else _known.variant(source.lines)
    if case is not None:
        return Reading(case, [], lambda problem: _read_lines(source, damage).locate(problem))
    return _read_lines(source, damage)


def _read_lines(source: Source, damage: Iterable[Problem]) -> Reading:
    """Read a deck in full, and store it for variants."""
    global _known  # noqa: PLW0603 - the last deck, whose variants are read faster
    text, deck = source.text, scan(source)
    if not text.strip() or not deck.fields:
        message = "no field of a deck found, expected `KJG=` first, or `--from yaml` for YAML"
        if not text.strip():
            message = "the file is empty, expected a deck that starts with `KJG=`"
        raise ReadError("E101", message, place=Place(source.file, 1, 1))
    deck.problems.extend(damage)
    fields = Fields(deck, len(text))
    reading = finish(_parts(fields), deck.problems, fields.hidden, fields.places.locate)
    if not reading.warnings:
        # Without repeat counts, a deck has at most as many values as characters.
        is_remembered = len(text) <= LONGEST_REMEMBERED_DECK and "*" not in text
        _known = KnownDeck(deck, reading.case, fields.places.planet) if is_remembered else None
    return reading


def _parts(fields: Fields) -> dict[str, Any]:
    """Return the arguments of `Transmission`, with stand-ins for unreadable values."""
    sizes = {
        "J": fields.size("KJG", "links (input and output)", 2),
        "F": fields.size("KL", "shift elements", 0),
        "D": fields.size("KG", "mechanisms", 0),
        "P": fields.size("NP", "gears", 1),
    }
    if fields.optional(SPRINGS, 0, range(1), NO_SPRINGS) is None:
        # The springs are unreadable. Do not report links as unconnected that only springs connect.
        fields.hidden.append(("links",))
    names = _names(fields, sizes)
    elements = fields.or_guess(sizes["F"], "NZF(I,1)", "shift_elements")
    mechanisms = fields.or_guess(sizes["D"], "NZD(I,1)", "mechanisms")
    gears = fields.or_guess(sizes["P"], "KFRI", "gears")
    element_members = _members(fields, "shift_elements", elements, names)
    mechanism_members = _members(fields, "mechanisms", mechanisms, names)
    planets = _planets(fields, mechanisms)
    parts: dict[str, Any] = {
        "shift_elements": [ShiftElement(**member) for member in element_members],
        "mechanisms": [
            Mechanism(**member, planet_ratio=planets.get(number))
            for number, member in enumerate(mechanism_members, 1)
        ],
        "gears": _gears(fields, gears, names),
        "input": _port(fields, "INP", 1),
        "output": _port(fields, "IOUT", 0),
        "name": names.get("T", ""),
    }
    idle = fields.optional("IDLE", 0, range(2), "0 (published) or 1 (exact)")
    coast = fields.optional("COAST", -1, range(2), "0 (driving) or 1 (coasting)")
    parts["idle"] = "exact" if idle == 1 else "published"
    parts["coast"] = None if coast == -1 else coast == 1
    links = sizes["J"]
    if None in sizes.values():
        fields.hidden += [("links",), ("input",), ("output",)]
    if sizes["F"] is None and not elements:
        fields.hidden += [("gears", gear, "engaged") for gear in range(1, gears + 1)]
    if links is not None and any(name.startswith("J") for name in names):
        parts["link_names"] = [names.get(f"J{link}", str(link)) for link in range(1, links + 1)]
    parts["links"] = _links_above_all(parts) if links is None else links
    fields.warn_of_unknown()
    return parts


def _members(fields: Fields, part: str, count: int, names: dict[str, str]) -> list[dict[str, Any]]:
    """Return the attributes of all parts of a kind, from lists and name lines."""
    members: list[dict[str, Any]] = [
        {"name": names.get(f"{KINDS[part]}{number}", "")} for number in range(1, count + 1)
    ]
    for key, field in FIELDS.items():
        if field.part == part and (part != "gears" or key in fields.scan.fields):
            parse = real if field.kind is float else integer
            for values, number in zip(
                members, fields.numbers(key, count, field.size, parse), strict=True
            ):
                values[field.member] = number
    return members


def _planets(fields: Fields, mechanisms: int) -> dict[int, float]:
    """Return the planet ratios of non-standard mechanisms, by mechanism number."""
    count = fields.optional("KNM", 0, range(mechanisms + 1), f"0 to {mechanisms} (KG)")
    every: list[Path] = [("mechanisms", number) for number in range(1, mechanisms + 1)]
    if count is None:
        fields.hidden += every
        return {}
    numbers = fields.numbers("NNM", count, "KNM", integer)
    ratios = fields.numbers("UAQ", count, "KNM", real)
    planets = {}
    for position, (number, ratio) in enumerate(zip(numbers, ratios, strict=True), 1):
        if f"NNM({position})" in fields.unreadable:
            fields.hidden += every
            continue
        if not 1 <= number <= mechanisms:
            expected = f"expected the number of a mechanism, from 1 to {mechanisms}"
            fields.error(f"NNM({position})", f"read {number}, {expected}")
        elif number in planets:
            fields.error(f"NNM({position})", f"mechanism {number} is given twice, expected once")
        else:
            planets[number] = ratio
            fields.places.planet[number] = position
            if f"UAQ({position})" in fields.unreadable:
                fields.hidden.append(("mechanisms", number, "planet_ratio"))
    return planets


def _gears(fields: Fields, count: int, names: dict[str, str]) -> list[Gear]:
    counts = fields.counts("KFRI", count, required=True)
    engaged, unreadable = fields.rows("NFRI", counts, "KFRI", integer)
    fields.hidden += [("gears", gear, "engaged") for gear in unreadable]
    speeds = _given(fields, count, "speeds", ("KWZ", "NWZ", "WZ"))
    torques = _given(fields, count, "torques", ("KMZ", "NMZ", "AMZ"))
    return [
        Gear(
            engaged[n], speeds[n], torques[n], **{key: values[key] for key in values if values[key]}
        )
        for n, values in enumerate(_members(fields, "gears", count, names))
    ]


def _given(
    fields: Fields, gears: int, part: str, keys: tuple[str, str, str]
) -> list[dict[int, float]]:
    """Return the prescribed speeds or torques of each gear, by link."""
    counted, name, amount = keys
    counts = fields.counts(counted, gears, required=False)
    links, unreadable = fields.rows(name, counts, counted, integer)
    values, stand_ins = fields.rows(amount, counts, counted, real)
    fields.hidden += [("gears", gear, part) for gear in unreadable | stand_ins]
    given: list[dict[int, float]] = []
    for gear, (row, numbers) in enumerate(zip(links, values, strict=True), 1):
        given.append({})
        for position, (link, value) in enumerate(zip(row, numbers, strict=True), 1):
            if link in given[-1] and gear not in unreadable:
                message = f"link {link} is given twice in gear {gear}, expected once"
                fields.error(f"{name}({position},{gear})", message)
            else:
                given[-1][link] = value
                fields.places.given[part, gear, link] = position
    return given


def _port(fields: Fields, key: str, default: int) -> int:
    link = fields.optional(key, default, range(1, 10**18), "a link number from 1")
    if link is None:
        fields.hidden += [("input",), ("output",)]
    return default if link is None else link


def _names(fields: Fields, sizes: dict[str, int | None]) -> dict[str, str]:
    """Return the names by kind and number, such as ``F3``; ``T`` is the title."""
    names = {}
    for kind, number, name, *spot in fields.scan.names:
        label = f"{kind}{int(number) if number else ''}"
        largest = sizes.get(kind)
        wrong = ""
        if kind not in NAMED:
            kinds = ", ".join(f"{letter} ({what})" for letter, what in NAMED.items())
            wrong = f"`{kind}` is not a kind of name, expected one of {kinds}"
        elif kind == "T" and number:
            wrong = "the title has no number, expected `NAME T:`"
        elif kind != "T" and largest is not None and not 1 <= int(number) <= largest:
            wrong = f"read {number}, expected the number of a {NAMED[kind]}, from 1 to {largest}"
        elif label in names:
            line, column = fields.places.spots[f"NAME {label}"]
            before = f"line {line}, column {column}"
            wrong = f"given again, first given in {before}; expected once"
        elif not name:
            wrong = "read nothing, expected a name after the colon"
        if wrong:
            fields.scan.error(f"NAME {kind}{number}: {wrong}", *spot)
        else:
            names[label] = name
            fields.places.spots[f"NAME {label}"] = spot[0], spot[1]
    return names


def _links_above_all(parts: dict[str, Any]) -> int:
    """Return a number of links above all link numbers, if the deck's KJG is unreadable."""
    links: list[int] = [2, parts["input"], parts["output"]]
    for element in parts["shift_elements"]:
        links += [element.first, element.second]
    for mechanism in parts["mechanisms"]:
        links += mechanism.links
    for gear in parts["gears"]:
        links += [gear.input or 0, gear.output or 0, *gear.speeds, *gear.torques]
    return max(links) + 1


class KnownDeck:
    """Deck without errors and warnings, whose variants are read faster."""

    def __init__(self, scan: Scan, case: Transmission, planets: Iterable[int]) -> None:
        """Store the lines; `planets` are the numbers of the mechanisms in the field UAQ."""
        self.scan = scan
        self.case = case
        self.planets = [number - 1 for number in planets]

    @cached_property
    def numbers(self) -> Mapping[int, tuple[str, Sequence[int]]]:
        """Attribute and mechanism indices of each line that contains only numbers of mechanisms."""
        every = range(len(self.case.mechanisms))
        known = {}
        for key, part, owners in (
            ("IAB", "ratio", every),
            ("ETAI", "efficiency", every),
            ("UAQ", "planet_ratio", self.planets),
        ):
            field, left = self.scan.fields.get(key), owners
            for line, text, start, _ in () if field is None else value_lines(self.scan, field):
                numbers = plain_numbers(text[start:], real)
                if numbers is None:
                    break
                if start == 0:
                    known[line - 1] = part, left[: len(numbers)]
                left = left[len(numbers) :]
        return known

    def variant(self, lines: Sequence[str]) -> Transmission | None:
        """Return the case of a variant of the deck; None if it must be read in full.

        This is so if lines other than numbers of mechanisms differ, or if there are warnings.
        """
        before = self.scan.source.lines
        if len(lines) != len(before):
            return None
        mechanisms = list(self.case.mechanisms)
        for index, (line, old) in enumerate(zip(lines, before, strict=True)):
            if line == old:
                continue
            part, owners = self.numbers.get(index, ("", ()))
            numbers = plain_numbers(line, real)
            if not owners or numbers is None or len(numbers) != len(owners):
                return None
            for owner, number in zip(owners, numbers, strict=True):
                changed: dict[str, Any] = {part: number}
                mechanisms[owner] = mechanisms[owner]._replace(**changed)
        try:
            case = self.case.with_numbers(mechanisms)
        except CaseError:
            return None
        return None if any(doubts(case)) else case
