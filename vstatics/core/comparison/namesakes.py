"""Matching of renamed links and parts of two cases by their connections."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.written_results import WrittenResult

LINK = "link"
ROUNDS = 4
"""Number of connections up to which neighbours are compared to identify a link or part.

Links and parts at a larger distance can differ between the cases.
"""
Key = tuple[str, str]
"""Kind and name of a part, or `LINK` and the name of a link."""


class _JoiningPart(NamedTuple):
    kind: str
    name: str
    links: Sequence[int]
    data: object
    """Data that distinguish parts with the same links."""
    rows: Sequence[str]
    """Names of the rows and columns of the part in tables, including members of a gear set."""

    @property
    def key(self) -> Key:
        return self.kind, self.name


def renaming(actual: WrittenResult, expected: WrittenResult) -> Callable[..., str]:
    """Return a function that converts row names of the actual result to expected names."""
    if not (actual.case and expected.case):
        return lambda name, _rows="": name
    links, parts = row_names_of(actual.case, expected.case)
    named = {"links": parts | links}

    def called(name: str, rows: str = "") -> str:
        known = named.get(rows, links | parts)
        device, dot, member = name.partition(".")
        return known.get(name, f"{parts.get(device, device)}{dot}{links.get(member, member)}")

    return called


def row_names_of(actual: Transmission, expected: Transmission) -> tuple[dict[str, str], ...]:
    """Return the expected names of renamed links and parts of the actual case.

    Links and parts with equal names match. Others match if their connections and data agree or,
    failing that, if their connections agree. The remaining parts of a kind match in order, if both
    cases have the same number of such parts.

    Returns
    -------
    links, parts : dict
        Expected names by actual names. Links with equal names are omitted.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> new, old = (
    ...     Transmission(3, [], [Mechanism(1, 2, 3, u, name=m) for m, u in s], [Gear()])
    ...     for s in ([("X", -3.0), ("Y", -2.5)], [("P", -2.5), ("Q", -3.0)])
    ... )
    >>> links, parts = row_names_of(new, old)
    >>> parts["X"], parts["Y"]
    ('Q', 'P')
    """
    cases = actual, expected
    gears = {gear.name for gear in actual.gears} & {gear.name for gear in expected.gears}
    sides = [{part.key: part for part in _parts(case, gears)} for case in cases]
    names = [
        [*((LINK, link) for link in _links(case)), *side]
        for case, side in zip(cases, sides, strict=True)
    ]
    same = _same(cases, sides, names)
    links = {new: old for (kind, new), old in same.items() if kind == LINK and new != old}
    parts: dict[str, str] = {}
    for key, part in sides[0].items():
        other = sides[1].get((key[0], same.get(key, "")))
        if other and len(part.rows) == len(other.rows):
            for new, old in zip(part.rows, other.rows, strict=True):
                parts |= {new: old, new.partition(".")[0]: old.partition(".")[0]}
    return links, parts


def _links(case: Transmission) -> Sequence[str]:
    return case.link_names[: case.own_links]


def _parts(case: Transmission, gears: Collection[str]) -> Iterator[_JoiningPart]:
    for number, element in enumerate(case.shift_elements, 1):
        held = sorted(
            gear.name for gear in case.gears if number in gear.engaged and gear.name in gears
        )
        data = element.kind, element.capacity, held
        yield _JoiningPart(
            "element", element.name, (element.first, element.second), data, [element.name]
        )
    for device in case.own_devices:
        sets = [case.mechanisms[index] for index in device.mechanisms]
        rows = [device.name, *(mechanism.name for mechanism in sets)]
        links = [member.link for member in device.members]
        ratios = [mechanism.ratio for mechanism in sets]
        yield _JoiningPart("device", device.name, links, ratios, rows)
    for spring in case.springs:
        yield _JoiningPart(
            "spring", spring.name, [*spring.form], [*spring.form.values()], [spring.name]
        )


def _same(
    cases: Sequence[Transmission],
    sides: Sequence[Mapping[Key, _JoiningPart]],
    names: Sequence[Sequence[Key]],
) -> dict[Key, str]:
    """Return the expected name of each matched link and part of the actual case."""
    same = {key: key[1] for key in names[0] if key in names[1]}
    exact = True
    while True:
        known = same, {(kind, name): name for (kind, _), name in same.items()}
        left = [
            [key for key in keys if key not in matched]
            for keys, matched in zip(names, known, strict=True)
        ]
        if not all(left):
            return same
        looks = [_looks(*side, exact=exact) for side in zip(cases, sides, known, strict=True)]
        pairs = _pairs(left, looks)
        if pairs:
            same |= pairs
        elif exact:
            exact = False
        else:
            return same | _in_turn(left)


def _pairs(left: Sequence[Sequence[Key]], looks: Sequence[Mapping[Key, int]]) -> dict[Key, str]:
    """Return pairs of links and parts whose hashes are equal and unique, or else any pair."""
    counts = [Counter(look[key] for key in keys) for keys, look in zip(left, looks, strict=True)]
    alike = [(new, old) for new in left[0] for old in left[1] if looks[0][new] == looks[1][old]]
    sure = [pair for pair in alike if all(count[looks[0][pair[0]]] == 1 for count in counts)]
    return {new: old[1] for new, old in sure or alike[:1]}


def _in_turn(left: Sequence[Sequence[Key]]) -> dict[Key, str]:
    matched: dict[Key, str] = {}
    for kind in dict.fromkeys(kind for kind, _ in left[0]):
        here, there = ([key for key in keys if key[0] == kind] for keys in left)
        if len(here) == len(there):
            matched |= {new: old[1] for new, old in zip(here, there, strict=True)}
    return matched


def _looks(
    case: Transmission, parts: Mapping[Key, _JoiningPart], known: Mapping[Key, str], *, exact: bool
) -> dict[Key, int]:
    """Return a hash for the surroundings of each link and part, with known names.

    The hash of a link depends on its parts, and the hash of a part on its links. So each round
    extends the surroundings by one connection.
    """
    links = {number: (LINK, name) for number, name in enumerate(_links(case), 1)}
    ports = {case.link_name(case.input): "input", case.link_name(case.output): "output"}
    seen = {0: 0} | {
        number: hash(known.get(key) or (ports.get(key[1]), "")) for number, key in links.items()
    }
    looks: dict[Key, int] = {}
    for _ in range(ROUNDS):
        at: dict[int, list[int]] = {number: [] for number in links}
        for key, part in parts.items():
            data = repr(part.data) if exact else ""
            joined = known.get(key) or tuple(seen.get(link, 0) for link in part.links)
            looks[key] = hash((part.kind, joined, "" if key in known else data))
            for place, link in enumerate(part.links):
                if link in at:
                    at[link].append(hash((looks[key], place)))
        for number, key in links.items():
            if key not in known:
                seen[number] = hash((seen[number], *sorted(at[number])))
    return looks | {key: seen[number] for number, key in links.items()}
