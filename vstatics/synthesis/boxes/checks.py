"""What can be asked of a search for boxes: each mistake with the option that has it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.errors import CaseError, Problem, plural
from vstatics.synthesis.boxes.box import BoxSearch

LARGEST_RATIO = 1000.0
"""Of ratios of gears, of their reciprocals, and of ring teeth/sun teeth. [-]"""
MOST_BOX_SETS = 5
"""With more there are more schemes than can be looked at."""
MOST_LINKS = 10
"""Moving links: their brakes and clutches are bits of a number."""
MOST_ELEMENTS = 12
MOST_TARGETS = 924
"""So many sets of six have twelve elements, which is the most that there can be."""
COARSEST = 0.5
"""The largest tolerance. [-]"""


def check_box_search(search: BoxSearch) -> None:
    """Refuse what can't be searched for.

    Raises
    ------
    CaseError
        With the name of an option as the path of each problem.

    Examples
    --------
    >>> check_box_search(BoxSearch(2, 4, 2, (2.84, 1.57, 1, -2.21), own_input=True))
    >>> check_box_search(BoxSearch(2, 4, 3, (2.84, 1.57, 1, -2.21)))
    Traceback (most recent call last):
    vstatics.errors.CaseError: engaged: read 3, but 2 sets leave 1 or 2 to be engaged
    """
    problems = [*_of_numbers(search), *_of_ratios(search.targets)] or [*_of_counts(search)]
    if problems:
        raise CaseError(problems)


def engaged_range(search: BoxSearch) -> range:
    """How many elements may be engaged with so many sets: connected ones have so many links.

    With a held link a scheme may be in parts, as in Lepelletier's gearbox: clutches join them.

    Examples
    --------
    >>> engaged_range(BoxSearch(4, 5, 3, (2.0, 1.0)))
    range(1, 5)
    """
    others = search.links - search.engaged
    most = 3 * search.sets + 1 - search.fixed if search.fixed else 2 * search.sets + 1
    return range(max(search.sets + 2 - others, 1), most + 1 - others)


def elements_there(search: BoxSearch) -> tuple[int, int]:
    """How many brakes and clutches there are to choose from.

    Examples
    --------
    >>> elements_there(BoxSearch(4, 5, 3, (2.0, 1.0)))
    (6, 28)
    """
    shafts = search.links + (1 if search.own_input else 0) - (1 if search.fixed else 0)
    return shafts - 2, math.comb(shafts, 2)


def _of_numbers(search: BoxSearch) -> Iterator[Problem]:
    """Problems of one number each."""
    sets = f"{search.sets} {plural('set', search.sets)}"
    if not 1 <= search.sets <= MOST_BOX_SETS:
        yield _problem("sets", f"read {search.sets}, expected 1 to {MOST_BOX_SETS}")
        return
    for name, given in (("meshed", search.meshed), ("fixed", search.fixed)):
        if not 0 <= given <= search.sets:
            yield _problem(name, f"read {given}, expected 0 to {search.sets}, as there are {sets}")
    low, high = search.bounds
    if not 1 < low < high <= LARGEST_RATIO:
        expected = f"two numbers above 1, the larger one behind, up to {LARGEST_RATIO:g}"
        yield _problem("bounds", f"read {low:g}:{high:g}, expected {expected}")
    if not 0 < search.tolerance <= COARSEST:
        message = f"read {search.tolerance:g}, expected a number above 0, up to {COARSEST:g}"
        yield _problem("tolerance", message)


def _of_ratios(targets: tuple[float, ...]) -> Iterator[Problem]:
    """Problems of the ratios of gears."""
    if not targets:
        yield _problem("ratios", "read none, expected the ratio of each gear")
    if len(targets) > MOST_TARGETS:
        yield _problem("ratios", f"read {len(targets)}, expected {MOST_TARGETS} at most")
        return
    for target in targets:
        if not 1 / LARGEST_RATIO <= abs(target) <= LARGEST_RATIO:
            sizes = f"{1 / LARGEST_RATIO:g} to {LARGEST_RATIO:g} in size, below 0 backward"
            yield _problem("ratios", f"read {target:g}, expected a ratio of {sizes}")
    for target in sorted({one for one in targets if targets.count(one) > 1}):
        yield _problem("ratios", f"read {target:g} twice, expected gears that differ")


def _of_counts(search: BoxSearch) -> Iterator[Problem]:
    """Problems of numbers that do not go together."""
    engaged, elements, gears = search.engaged, search.elements, len(search.targets)
    possible = engaged_range(search)
    if engaged not in possible:
        sets = f"{search.sets} {plural('set', search.sets)}"
        given = " with an input shaft of its own" * search.own_input
        given += f"{' and' if given else ' with'} held members" * bool(search.fixed)
        words = " or ".join(map(str, possible)) or "none"
        if len(possible) > 2:
            words = f"{possible[0]} to {possible[-1]}"
        verb = "leave" if search.sets > 1 else "leaves"
        message = f"but {sets}{given} {verb} {words} to be engaged"
        yield _problem("engaged", f"read {engaged}, {message}")
        return
    brakes, clutches = elements_there(search)
    if brakes + 2 > MOST_LINKS:
        message = f"read {engaged}, but then {brakes + 2} links move, expected {MOST_LINKS} at most"
        yield _problem("engaged", message)
        return
    there = brakes + clutches
    most = min(there, MOST_ELEMENTS)
    if not engaged <= elements <= most:
        choice = f"{brakes} {plural('brake', brakes)} and {clutches} clutches"
        all_of_them = f", all that there are ({choice})" if most == there else ""
        message = f"expected {engaged}, which are engaged, to {most}{all_of_them}"
        yield _problem("elements", f"read {elements}, {message}")
    elif gears > math.comb(elements, engaged):
        most = math.comb(elements, engaged)
        given = f"read {gears} ratios, but {elements} elements with {engaged} engaged"
        yield _problem("ratios", f"{given} give {most} {plural('gear', most)} at most")
    elif elements > gears * engaged:
        used = f"{gears} {plural('gear', gears)} with {engaged} engaged"
        yield _problem(
            "elements", f"read {elements}, but {used} can't use more than {gears * engaged}"
        )


def _problem(option: str, message: str) -> Problem:
    return Problem(message, path=(option,))
