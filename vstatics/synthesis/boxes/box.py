"""A box to be found: what is asked for, what can be, what a found one is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.errors import CaseError, Problem, plural, spoken

if TYPE_CHECKING:
    from vstatics.synthesis.structures.scheme import SetScheme

HELD = -1
"""The second link of a brake."""
EFFICIENCY = 0.98
"""Of each set with its carrier held, where nothing is said."""


class KeptParts(NamedTuple):
    """What boxes have of a gearbox that there is."""

    scheme: SetScheme
    meshed: tuple[bool, ...]
    """Whether a set has meshed planets."""
    held: int | None
    """The link that is held for good."""
    input: int
    output: int
    elements: tuple[tuple[int, int], ...]
    """As those of a `FoundBox`."""
    free: int
    """So many of them may be missing."""


class WantedSequence(NamedTuple):
    """Forward gears that a box is to have, whatever their ratios are."""

    least: int
    """So many at least."""
    most: int
    spread: tuple[float, float]
    """Between which the ratio of the first over that of the last is. [-]"""
    steps: tuple[float, float]
    """Between which that of each over that of the next one is. [-]"""
    falling: bool = False
    """Whether no step is larger than the one below it."""


class BoxSearch(NamedTuple):
    """Which boxes are asked for.

    Examples
    --------
    >>> search = BoxSearch(2, 4, 2, (2.84, 1.57, 1, -2.21), own_input=True)
    >>> search.links  # the input shaft is one more, number 4
    4
    """

    sets: int
    elements: int
    """Brakes and clutches; each is engaged in a gear."""
    engaged: int
    """So many are engaged in every gear."""
    targets: tuple[float, ...]
    """Wanted ratios of the gears, all different. [-]"""
    bounds: tuple[float, float] = (1.4, 5.0)
    """Least and largest ring teeth/sun teeth of a set. [-]"""
    meshed: int = 0
    """So many sets have meshed planets."""
    own_input: bool = False
    """Whether the input is a shaft that only clutches join."""
    own_output: bool = False
    """Whether the output is a shaft that only clutches join."""
    shafts: int = 0
    """So many further shafts no set has a member on: three elements or more join each."""
    fixed: int = 0
    """So many members are held for good; they are one more link of the scheme."""
    tolerance: float = 0.01
    """A box is found if ratios of its sets leave no gear with a larger ``|ln(i/target)|``. [-]"""
    tolerances: tuple[float, ...] = ()
    """The same of each gear; `tolerance` of all where there are none. [-]"""
    brake_counts: tuple[int, ...] | None = None
    """It has one of these numbers of them; None for any."""
    singly: bool = False
    """Whether only such are looked for in which one element may change between neighbours."""

    sequence: WantedSequence | None = None
    """Gears besides the targets."""
    kept: KeptParts | None = None
    """What all boxes have in common with one that there is."""

    @property
    def widths(self) -> tuple[float, ...]:
        """The largest ``|ln(i/target)|`` of each gear [-].

        >>> BoxSearch(2, 4, 2, (2.84, 1.57)).widths
        (0.01, 0.01)
        """
        return self.tolerances or (self.tolerance,) * len(self.targets)

    @property
    def links(self) -> int:
        """Links of the scheme of its sets; the one that is held for good is among them."""
        return self.moving - self.own_input - self.own_output - self.shafts + bool(self.fixed)

    @property
    def moving(self) -> int:
        """Links that can turn, those that have no member of a set among them."""
        return self.sets + self.engaged + 1

    @property
    def input(self) -> int | None:
        """The number of an input shaft of its own, next to the links of the scheme."""
        return self.links if self.own_input else None

    @property
    def output(self) -> int | None:
        """The number of an output shaft of its own, next to that."""
        return self.links + self.own_input if self.own_output else None

    @property
    def may_be_in_parts(self) -> bool:
        """Whether only elements may join some of its sets, as in Lepelletier's gearbox."""
        return bool(self.fixed) and not self.shafts


class FoundBox(NamedTuple):
    """A scheme with ports and shift elements, with the ratios that fit best.

    Examples
    --------
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((0,), (1,)), 0.0)
    >>> box.brakes, box.clutches
    ([(2, -1)], [(0, 1)])
    """

    scheme: SetScheme
    held: int | None
    """The link of the scheme that is held for good."""
    input: int
    """A link of the scheme; after them are numbered an input shaft of its own, such an output
    shaft, and further shafts."""
    output: int
    elements: tuple[tuple[int, int], ...]
    """Two links that a clutch joins; a link and `HELD` of a brake. Brakes stand first."""
    ratios: tuple[float, ...]
    """Internal ratio of each set, sun to ring with the carrier held: above 0 where its planets
    are meshed. [-]"""
    gears: tuple[tuple[int, ...], ...]
    """For each target the elements engaged, numbers in `elements` from 0."""
    error: float
    """The largest ``|ln(i/target)|``. [-]"""

    @property
    def links(self) -> int:
        """Links of the scheme and shafts without a member of a set, which elements join all."""
        ends = chain(*self.elements)
        return max(self.scheme.links, self.input + 1, self.output + 1, *(one + 1 for one in ends))

    @property
    def brakes(self) -> list[tuple[int, int]]:
        """Elements that hold a link."""
        return [one for one in self.elements if one[1] == HELD]

    @property
    def clutches(self) -> list[tuple[int, int]]:
        """Elements that join two links."""
        return [one for one in self.elements if one[1] != HELD]


LARGEST_RATIO = 1000.0
"""Of ratios of gears, of their reciprocals, and of ring teeth/sun teeth. [-]"""
ANY_QUOTIENT = (1.0, LARGEST_RATIO**2)
"""Between which the ratio of a gear over that of a later one always is. [-]"""
MOST_BOX_SETS = 5
"""With more there are more schemes than can be looked at."""
SHAFT_ELEMENTS = 3
"""So many join a shaft at least: two would be one clutch."""
MOST_LINKS = 10
"""Moving links: their brakes and clutches are bits of a number."""
MOST_ELEMENTS = 12
MOST_SEQUENCE = 24
"""Forward gears, where their ratios are not told."""
MOST_TARGETS = 62
"""They are bits of a number, one more for a sequence; no gearbox has so many gears."""
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
    vstatics.core.errors.CaseError: engaged: read 3, but 2 sets leave 1 or 2 to be engaged [E801]
    """
    problems = [*_of_numbers(search), *_of_ratios(search), *_of_sequence(search.sequence)] or [
        *_of_counts(search)
    ]
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
    most = 2 * search.sets + 1
    if search.may_be_in_parts:
        most = 3 * search.sets + 1 - search.fixed
    return range(max(search.sets + 2 - others, 1), most + 1 - others)


def elements_there(search: BoxSearch) -> tuple[int, int]:
    """How many brakes and clutches there are to choose from.

    Examples
    --------
    >>> elements_there(BoxSearch(4, 5, 3, (2.0, 1.0)))
    (6, 28)
    """
    return search.moving - 2, math.comb(search.moving, 2)


def fewest_elements(shafts: int) -> int:
    """The fewest elements with which each of so many shafts has three; clutches may join two.

    >>> [fewest_elements(shafts) for shafts in range(5)]
    [0, 3, 5, 6, 6]
    """
    ends = SHAFT_ELEMENTS * shafts
    return ends - min(math.comb(shafts, 2), ends // 2)


def _of_numbers(search: BoxSearch) -> Iterator[Problem]:
    """Problems of one number each."""
    sets = f"{search.sets} {plural('set', search.sets)}"
    if not 1 <= search.sets <= MOST_BOX_SETS:
        yield _problem("sets", f"read {search.sets}, expected 1 to {MOST_BOX_SETS}")
        return
    for name, given in (("meshed", search.meshed), ("fixed", search.fixed)):
        if not 0 <= given <= search.sets:
            yield _problem(name, f"read {given}, expected 0 to {search.sets}, as there are {sets}")
    if not 0 <= search.shafts <= MOST_LINKS:
        yield _problem("shafts", f"read {search.shafts}, expected 0 to {MOST_LINKS}")
        return
    low, high = search.bounds
    if not 1 < low < high <= LARGEST_RATIO:
        expected = f"two numbers above 1, the larger one behind, up to {LARGEST_RATIO:g}"
        yield _problem("bounds", f"read {low:g}:{high:g}, expected {expected}")
    if not 0 < search.tolerance <= COARSEST:
        message = f"read {search.tolerance:g}, expected a number above 0, up to {COARSEST:g}"
        yield _problem("tolerance", message)


def _of_ratios(search: BoxSearch) -> Iterator[Problem]:
    """Problems of the ratios of gears."""
    targets = search.targets
    if len(search.widths) != len(targets):
        message = f"read {len(search.tolerances)}, expected one for each of {len(targets)} gears"
        yield _problem("tolerances", message)
    for width in search.tolerances:
        if not 0 < width < math.inf:
            yield _problem("tolerances", f"read {width:g}, expected a number above 0")
    if not targets and search.sequence is None:
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


def _of_sequence(wanted: WantedSequence | None) -> Iterator[Problem]:
    """Problems of gears whose ratios are not told."""
    if wanted is None:
        return
    if not 2 <= wanted.least <= wanted.most <= MOST_SEQUENCE:
        given = f"read {wanted.least}:{wanted.most}"
        yield _problem(
            "gears", f"{given}, expected numbers from 2 to {MOST_SEQUENCE}, the larger behind"
        )
    for name, (low, high) in (("spread", wanted.spread), ("steps", wanted.steps)):
        if not ANY_QUOTIENT[0] <= low <= high <= ANY_QUOTIENT[1]:
            message = f"read {low:g}:{high:g}, expected two numbers from 1 on, the larger behind"
            yield _problem(name, message)


def _of_counts(search: BoxSearch) -> Iterator[Problem]:
    """Problems of numbers that do not go together."""
    engaged, elements, gears = search.engaged, search.elements, len(search.targets)
    fewest, sequence = gears, search.sequence
    if sequence is not None:
        fewest, gears = gears + sequence.least, gears + sequence.most
    possible = engaged_range(search)
    if search.kept is None and engaged not in possible:
        sets = f"{search.sets} {plural('set', search.sets)}"
        given = _with(search)
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
    elif elements < (at_shafts := fewest_elements(search.shafts)):
        each = f"{SHAFT_ELEMENTS} join each of {search.shafts} {plural('shaft', search.shafts)}"
        yield _problem("elements", f"read {elements}, expected {at_shafts} or more, so that {each}")
    elif fewest > math.comb(elements, engaged):
        most = math.comb(elements, engaged)
        what = "ratios" if sequence is None else "gears"
        given = f"read {fewest} {what}, but {elements} elements with {engaged} engaged"
        yield _problem(what, f"{given} give {most} {plural('gear', most)} at most")
    elif elements > gears * engaged:
        used = f"{gears} {plural('gear', gears)} with {engaged} engaged"
        yield _problem(
            "elements", f"read {elements}, but {used} can't use more than {gears * engaged}"
        )


def _with(search: BoxSearch) -> str:
    """What leaves more to be engaged, or less, beside the number of sets."""
    ports = (("input", search.own_input), ("output", search.own_output))
    given = [f"an {name} shaft of its own" for name, is_own in ports if is_own]
    if search.shafts:
        given.append(f"{search.shafts} further {plural('shaft', search.shafts)}")
    if search.fixed:
        given.append("held members")
    return f" with {spoken(given)}" if given else ""


def _problem(option: str, message: str) -> Problem:
    return Problem("E801", message, path=(option,))
