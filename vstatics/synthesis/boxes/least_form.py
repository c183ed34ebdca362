"""Canonical form of a gearbox, equal for gearboxes that differ only in names of sets and links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations, product
from typing import Any, NamedTuple

from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.structures.scheme import SetScheme


class _Renaming(NamedTuple):
    """New order of some gear sets, and new numbers of all links of the sets."""

    order: tuple[int, ...]
    links: dict[int, int]


def least_box(box: FoundBox) -> FoundBox:
    """Return a gearbox with gear sets and links renumbered for the least code.

    Several renumberings can give the least code, and shafts without a gear-set member can be
    numbered in any order. Of all these, the result has the least input, then output, held link,
    double-pinion sets and shift elements. Without double-pinion sets, code, input and output
    therefore agree with `schemes`.

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
    return min(least_forms(box), key=lambda form: (form.ratios, form.gears))


def least_forms(box: FoundBox) -> list[FoundBox]:
    """Return all renumbered gearboxes with the least `identity`, several if there is a symmetry.

    >>> box = FoundBox(SetScheme.of_code("0-1-2-0-1-3"), None, 0, 1, ((2, HELD), (3, HELD)),
    ...                (-2.0, -3.0), ((0,), (1,)), 0.0)
    >>> [one.ratios for one in least_forms(box)]
    [(-2.0, -3.0), (-3.0, -2.0)]
    """
    choices = product(_least_codes(box.scheme.sets), _shafts(box))
    forms = [_renamed(box, code._replace(links=code.links | shafts)) for code, shafts in choices]
    least = min(map(identity, forms))
    return [form for form in forms if identity(form) == least]


def identity(box: FoundBox) -> tuple[Any, ...]:
    """Return a key that equal gearboxes in the form of `least_box` share.

    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD),), (-2.0,), ((0,),), 0.0)
    >>> identity(box)
    (((0, 1, 2),), 0, 1, -1, (False,), ((2, -1),))
    """
    held = HELD if box.held is None else box.held
    meshed = tuple(ratio > 0 for ratio in box.ratios)
    return box.scheme.sets, box.input, box.output, held, meshed, box.elements


def _least_codes(sets: Sequence[tuple[int, int, int]]) -> Iterator[_Renaming]:
    """Yield all renumberings that give the least code, which is built up gear set by gear set."""
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
    """Yield possible new numbers of shafts without gear-set members, except input and output."""
    shafts = range(box.scheme.links, box.links)
    ports = {link: link for link in shafts if link in (box.input, box.output)}
    others = [link for link in shafts if link not in ports]
    for order in permutations(others):
        yield ports | dict(zip(others, order, strict=True))


def _numbers(links: dict[int, int], members: tuple[int, int, int]) -> tuple[int, ...]:
    """Return the new numbers of the links of a gear set.

    A link without a new number gets the next free number.
    """
    fresh = iter(range(len(links), len(links) + len(members)))
    return tuple(links[link] if link in links else next(fresh) for link in members)


def _renamed(box: FoundBox, renaming: _Renaming) -> FoundBox:
    order, links = renaming
    new = links | {HELD: HELD}
    if box.held is not None:  # a clutch to a held link acts as a brake
        new |= {box.held: HELD}
    elements = []  # the links of each shift element in order, the housing last
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
        gears=tuple(tuple(sorted(number[index] for index in engaged)) for engaged in box.gears),
        error=box.error,
    )
