"""Shift elements to choose from: those of a case, or all that its scheme may have."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations as subsets

from vstatics.errors import CaseError, listed, nearest, quoted, typed_number
from vstatics.model.transmission import HOUSING, ShiftElement, Transmission
from vstatics.synthesis.gears.speed_forms import Pair

AUTO = "auto"
"""What asks for all elements that a scheme may have."""


def chosen_elements(case: Transmission, asked: Sequence[str] = ()) -> list[ShiftElement]:
    """The shift elements that combinations are made of.

    Parameters
    ----------
    asked : sequence of str
        Names or numbers of elements of the case; all of them when not given. Or ``auto``
        alone: see `all_elements`.

    Raises
    ------
    CaseError
        If there is no such element.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> [one.name for one in chosen_elements(case, ["F2"])]
    ['F2']
    >>> [one.name for one in chosen_elements(case, ["auto"])]
    ['F2', 'F-1-3', 'F-2-3', 'T1']
    """
    if list(asked) == [AUTO]:
        return all_elements(case)
    if AUTO in asked:
        expected = f"expected `{AUTO}` alone, or names of shift elements"
        raise CaseError(f"read {quoted(', '.join(asked))}, {expected}")
    numbers = sorted({_number(case, one) for one in asked}) or range(len(case.shift_elements))
    return [case.shift_elements[number] for number in numbers]


def _number(case: Transmission, asked: str) -> int:
    """The index of an element: the one of a name, else the one of a number."""
    names = [element.name for element in case.shift_elements]
    if asked in names:
        return names.index(asked)
    number = typed_number(asked, len(names))
    if number:
        return number - 1
    hint = nearest(asked, [*names, AUTO])
    if not hint:
        hint = f"; they are {listed(names, 12)}" if names else f"; expected `{AUTO}`"
    raise CaseError(f"no shift element {quoted(asked)}{hint}")


def all_elements(case: Transmission) -> list[ShiftElement]:
    """All clutches and brakes that the scheme of a case may have.

    A clutch between any two links, then a brake on any link but the input and outputs.
    Links of planets have none. What the case has between the same links stands in place of
    a new one, with its own name; freewheels do not.
    """
    ports = {case.input, case.output, *case.outputs}
    links = range(1, case.own_links + 1)
    pairs: list[Pair] = [
        *subsets(links, 2),
        *((link, HOUSING) for link in links if link not in ports),
    ]
    own: dict[frozenset[int], ShiftElement] = {}
    for element in case.shift_elements:
        if not element.is_freewheel:
            own.setdefault(frozenset(element.links), element)
    new = [pair for pair in pairs if frozenset(pair) not in own]
    kept = {own[frozenset(pair)].name for pair in pairs if frozenset(pair) in own}
    names = dict(zip(new, _names(case, new, kept), strict=True))
    return [own.get(frozenset(pair)) or ShiftElement(*pair, name=names[pair]) for pair in pairs]


def count_all_elements(case: Transmission) -> int:
    """How many elements `all_elements` gives.

    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> count_all_elements(case)
    4
    """
    ports = {case.input, case.output, *case.outputs}
    return case.own_links * (case.own_links - 1) // 2 + case.own_links - len(ports)


def _names(case: Transmission, pairs: Sequence[Pair], taken: set[str]) -> list[str]:
    """Names that tell the links: ``F-sun-ring``, ``T-ring``; numbers of links if need be."""
    by_name = [_name([case.link_name(link) for link in pair if link]) for pair in pairs]
    if len(set(by_name)) == len(by_name) and not taken & set(by_name):
        return by_name
    names = [_name([str(link) for link in pair if link]) for pair in pairs]
    while taken & set(names):
        names = [f"{name}'" for name in names]
    return names


def _name(links: Sequence[str]) -> str:
    return "-".join(["T" if len(links) == 1 else "F", *links])
