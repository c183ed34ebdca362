"""Links and parts of two cases that are the same under other names, by what they join."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.written_results import WrittenResult

LINK = "link"
ROUNDS = 4
"""A link or part is told from others by what is so near: what is far may have changed."""
Key = tuple[str, str]
"""What it is, a link or a kind of part, and its name."""


class _JoiningPart(NamedTuple):
    kind: str
    name: str
    links: Sequence[int]
    says: object
    """What tells it from others between the same links."""
    rows: Sequence[str]
    """What rows and columns are called for it; those of its members begin with its name."""

    @property
    def key(self) -> Key:
        return self.kind, self.name


def renaming(actual: WrittenResult, expected: WrittenResult) -> Callable[..., str]:
    """What tells how a row of the actual result is called in the expected one, by their cases."""
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
    """What rows of the actual result are called in the expected one, where that is another name.

    What has one name is the same. Of the others those are the same that join the same links and
    have the same numbers, else that join the same links; else, where as many are left of a
    kind, those in turn.

    Returns
    -------
    links, parts : dict

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> one, other = (
    ...     Transmission(3, [], [Mechanism(1, 2, 3, u, name=m) for m, u in s], [Gear()])
    ...     for s in ([("X", -3.0), ("Y", -2.5)], [("P", -2.5), ("Q", -3.0)])
    ... )
    >>> links, parts = row_names_of(one, other)
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
    links = {now: then for (kind, now), then in same.items() if kind == LINK and now != then}
    parts: dict[str, str] = {}
    for key, part in sides[0].items():
        other = sides[1].get((key[0], same.get(key, "")))
        if other and len(part.rows) == len(other.rows):
            for one, two in zip(part.rows, other.rows, strict=True):
                parts |= {one: two, one.partition(".")[0]: two.partition(".")[0]}
    return links, parts


def _links(case: Transmission) -> Sequence[str]:
    return case.link_names[: case.own_links]


def _parts(case: Transmission, gears: Collection[str]) -> Iterator[_JoiningPart]:
    for number, element in enumerate(case.shift_elements, 1):
        held = sorted(one.name for one in case.gears if number in one.engaged and one.name in gears)
        says = element.kind, element.capacity, held
        yield _JoiningPart(
            "element", element.name, (element.first, element.second), says, [element.name]
        )
    for device in case.own_devices:
        sets = [case.mechanisms[index] for index in device.mechanisms]
        rows = [device.name, *(one.name for one in sets)]
        links = [member.link for member in device.members]
        yield _JoiningPart("device", device.name, links, [one.ratio for one in sets], rows)
    for spring in case.springs:
        yield _JoiningPart(
            "spring", spring.name, [*spring.form], [*spring.form.values()], [spring.name]
        )


def _same(
    cases: Sequence[Transmission],
    sides: Sequence[Mapping[Key, _JoiningPart]],
    names: Sequence[Sequence[Key]],
) -> dict[Key, str]:
    """What each link and part of the actual case is called in the expected one."""
    same = {key: key[1] for key in names[0] if key in names[1]}
    exact = True
    while True:
        known = same, {(kind, name): name for (kind, _), name in same.items()}
        left = [
            [key for key in own if key not in one] for own, one in zip(names, known, strict=True)
        ]
        if not all(left):
            return same
        looks = [_looks(*one, exact=exact) for one in zip(cases, sides, known, strict=True)]
        pairs = _pairs(left, looks)
        if pairs:
            same |= pairs
        elif exact:
            exact = False
        else:
            return same | _in_turn(left)


def _pairs(left: Sequence[Sequence[Key]], looks: Sequence[Mapping[Key, int]]) -> dict[Key, str]:
    """Those of one look, if that is of no other; else the first two of one look."""
    counts = [Counter(one[key] for key in own) for own, one in zip(left, looks, strict=True)]
    alike = [(one, two) for one in left[0] for two in left[1] if looks[0][one] == looks[1][two]]
    sure = [pair for pair in alike if all(count[looks[0][pair[0]]] == 1 for count in counts)]
    return {one: two[1] for one, two in sure or alike[:1]}


def _in_turn(left: Sequence[Sequence[Key]]) -> dict[Key, str]:
    found: dict[Key, str] = {}
    for kind in dict.fromkeys(kind for kind, _ in left[0]):
        here, there = ([key for key in own if key[0] == kind] for own in left)
        if len(here) == len(there):
            found |= {one: two[1] for one, two in zip(here, there, strict=True)}
    return found


def _looks(
    case: Transmission, parts: Mapping[Key, _JoiningPart], known: Mapping[Key, str], *, exact: bool
) -> dict[Key, int]:
    """What links and parts look like from where they are: of those that are known, the name.

    A link looks like the parts at it, a part like its links, so each round sees one further.
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
            says = repr(part.says) if exact else ""
            own = known.get(key) or tuple(seen.get(link, 0) for link in part.links)
            looks[key] = hash((part.kind, own, "" if key in known else says))
            for place, link in enumerate(part.links):
                if link in at:
                    at[link].append(hash((looks[key], place)))
        for number, key in links.items():
            if key not in known:
                seen[number] = hash((seen[number], *sorted(at[number])))
    return looks | {key: seen[number] for number, key in links.items()}
