"""One form for a box: boxes that are one up to renaming of sets and links get the same."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations, product
from typing import Any, NamedTuple

from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.structures.scheme import SetScheme


class _Renaming(NamedTuple):
    """Some sets in a new order, with the new numbers of links."""

    order: tuple[int, ...]
    links: dict[int, int]


def least_box(box: FoundBox) -> FoundBox:
    """The box with its sets and links renamed so that its code is the least one.

    Of the renamings with this code, and of shafts without a member of a set, that with the least
    input, then output, held link, meshed sets, elements. So code and ports are those of
    `schemes`, where no set is meshed.

    Parameters
    ----------
    box : FoundBox

    Examples
    --------
    >>> box = FoundBox(SetScheme.of_code("0-1-2-3-0-1"), None, 1, 2, ((0, HELD), (3, 1)),
    ...                (-2.0, -3.0), ((0,), (1,)), 0.0)
    >>> least = least_box(box)
    >>> least.scheme.code, least.input, least.output, least.ratios
    ('0-1-2-1-2-3', 2, 3, (-3.0, -2.0))
    >>> least.elements, least.gears
    (((1, -1), (0, 2)), ((0,), (1,)))
    """
    return min(least_forms(box), key=lambda one: (one.ratios, one.gears))


def least_forms(box: FoundBox) -> list[FoundBox]:
    """The box in all forms of the least identity; there are several where it is symmetric.

    >>> box = FoundBox(SetScheme.of_code("0-1-2-0-1-3"), None, 0, 1, ((2, HELD), (3, HELD)),
    ...                (-2.0, -3.0), ((0,), (1,)), 0.0)
    >>> [one.ratios for one in least_forms(box)]
    [(-2.0, -3.0), (-3.0, -2.0)]
    """
    choices = product(_least_codes(box.scheme.sets), _shafts(box))
    found = [_renamed(box, one._replace(links=one.links | own)) for one, own in choices]
    least = min(map(identity, found))
    return [one for one in found if identity(one) == least]


def identity(box: FoundBox) -> tuple[Any, ...]:
    """What two boxes in the form of `least_box` share if they are one.

    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD),), (-2.0,), ((0,),), 0.0)
    >>> identity(box)
    (((0, 1, 2),), 0, 1, -1, (False,), ((2, -1),))
    """
    held = HELD if box.held is None else box.held
    meshed = tuple(ratio > 0 for ratio in box.ratios)
    return box.scheme.sets, box.input, box.output, held, meshed, box.elements


def _least_codes(sets: Sequence[tuple[int, int, int]]) -> Iterator[_Renaming]:
    """All renamings that give the least code: set by set, only the least go on."""
    least = [_Renaming((), {})]
    for _ in sets:
        codes = [
            (_numbers(before.links, sets[number]), number, before)
            for before in least
            for number in range(len(sets))
            if number not in before.order
        ]
        best = min(code for code, _, _ in codes)
        least = [
            _Renaming(
                (*before.order, number),
                before.links | dict(zip(sets[number], code, strict=True)),
            )
            for code, number, before in codes
            if code == best
        ]
    yield from least


def _shafts(box: FoundBox) -> Iterator[dict[int, int]]:
    """New numbers of the links without a member of a set: ports of their own keep theirs."""
    own = range(box.scheme.links, box.links)
    kept = {link: link for link in own if link in (box.input, box.output)}
    others = [link for link in own if link not in kept]
    for one in permutations(others):
        yield kept | dict(zip(others, one, strict=True))


def _numbers(links: dict[int, int], one: tuple[int, int, int]) -> tuple[int, ...]:
    """The new numbers of the links of a set, those that are new in turn."""
    fresh = iter(range(len(links), len(links) + len(one)))
    return tuple(links[link] if link in links else next(fresh) for link in one)


def _renamed(box: FoundBox, renaming: _Renaming) -> FoundBox:
    """The box in other words."""
    order, links = renaming
    new = links | {HELD: HELD}
    if box.held is not None:  # a clutch to what is held is a brake
        new |= {box.held: HELD}
    elements = []  # the links of each in order; what is held stands last
    for first, second in box.elements:
        low, high = sorted((new[first], new[second]))
        elements.append((high, low) if low == HELD else (low, high))
    brakes_first = sorted(
        range(len(elements)), key=lambda index: (elements[index][1] != HELD, elements[index])
    )
    number = {index: place for place, index in enumerate(brakes_first)}
    sets = (box.scheme.sets[index] for index in order)
    return FoundBox(
        scheme=SetScheme(tuple((links[a], links[h], links[b]) for a, h, b in sets)),
        held=None if box.held is None else links[box.held],
        input=new[box.input],
        output=new[box.output],
        elements=tuple(elements[index] for index in brakes_first),
        ratios=tuple(box.ratios[index] for index in order),
        gears=tuple(tuple(sorted(number[index] for index in one)) for one in box.gears),
        error=box.error,
    )
