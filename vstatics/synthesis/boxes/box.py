"""Request for gearboxes with the limits, and the record of a found gearbox."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.errors import CaseError, Problem, plural, spoken

if TYPE_CHECKING:
    from vstatics.synthesis.structures.scheme import SetScheme

HELD = -1
"""Number that represents the housing, as the second link of a brake."""
EFFICIENCY = 0.98
"""Default basic efficiency of each gear set (carrier held). [-]"""


class KeptParts(NamedTuple):
    """Parts of an existing gearbox that the found gearboxes must retain."""

    scheme: SetScheme
    meshed: tuple[bool, ...]
    """True for each gear set with meshing planets (double-pinion set), shape (sets,)."""
    held: int | None
    """Number of the link of the scheme that is permanently held, if any."""
    input: int
    output: int
    elements: tuple[tuple[int, int], ...]
    """Shift elements of the existing gearbox, as in `FoundBox`."""
    free: int
    """Largest number of existing shift elements that may be missing in a found gearbox."""


class WantedSequence(NamedTuple):
    """Forward gears given by number, ratio spread and step ratios, not by ratios."""

    least: int
    """Smallest number of gears in the sequence."""
    most: int
    """Largest number of gears in the sequence."""
    spread: tuple[float, float]
    """Range of the ratio spread: first ratio divided by last ratio. [-]"""
    steps: tuple[float, float]
    """Range of the step ratios: each ratio divided by the next ratio. [-]"""
    falling: bool = False
    """True if step ratios must not increase from gear to gear."""


class BoxSearch(NamedTuple):
    """Request for gearboxes: numbers of gear sets and shift elements, wanted ratios, tolerances.

    Examples
    --------
    >>> search = BoxSearch(2, 4, 2, (2.84, 1.57, 1, -2.21), own_input=True)
    >>> search.links  # the input shaft is a further link, number 4
    4
    """

    sets: int
    """Number of planetary gear sets."""
    elements: int
    """Number of brakes and clutches, each engaged in at least one gear."""
    engaged: int
    """Number of shift elements engaged in every gear."""
    targets: tuple[float, ...]
    """Wanted ratios of the gears, all different. [-]"""
    bounds: tuple[float, float] = (1.4, 5.0)
    """Smallest and largest ring teeth divided by sun teeth, for each gear set. [-]"""
    meshed: int = 0
    """Number of gear sets with meshing planets (double-pinion sets)."""
    own_input: bool = False
    """True if the input is a separate shaft, connected to gear sets by clutches only."""
    own_output: bool = False
    """True if the output is a separate shaft, connected to gear sets by clutches only."""
    shafts: int = 0
    """Number of further shafts without a gear-set member, each with at least three shift elements.
    """
    fixed: int = 0
    """Number of permanently held gear-set members, which together are a link of the scheme."""
    tolerance: float = 0.01
    """Largest deviation ``|ln(i/target)|`` of the ratio i of each gear. [-]"""
    tolerances: tuple[float, ...] = ()
    """Largest deviation ``|ln(i/target)|`` of each gear; empty if `tolerance` is valid for all. [-]
    """
    brake_counts: tuple[int, ...] | None = None
    """Permitted numbers of brakes.

    Any number is permitted if None.
    """
    singly: bool = False
    """True to find only gearboxes in which neighbouring gears differ by exchange of a single
    element.
    """

    sequence: WantedSequence | None = None
    """Forward gears in addition to the targets, given by number, ratio spread and step ratios."""
    kept: KeptParts | None = None
    """Parts to retain from an existing gearbox, if any."""

    @property
    def widths(self) -> tuple[float, ...]:
        """Largest deviation ``|ln(i/target)|`` of each gear [-].

        >>> BoxSearch(2, 4, 2, (2.84, 1.57)).widths
        (0.01, 0.01)
        """
        return self.tolerances or (self.tolerance,) * len(self.targets)

    @property
    def links(self) -> int:
        """Number of links of the scheme, including a permanently held link."""
        return self.moving - self.own_input - self.own_output - self.shafts + bool(self.fixed)

    @property
    def moving(self) -> int:
        """Number of links that can rotate, including shafts without a gear-set member."""
        return self.sets + self.engaged + 1

    @property
    def input(self) -> int | None:
        """Number of the separate input shaft, after the links of the scheme.

        None means that the input is a link of the scheme.
        """
        return self.links if self.own_input else None

    @property
    def output(self) -> int | None:
        """Number of the separate output shaft, after the input shaft.

        None means that the output is a link of the scheme.
        """
        return self.links + self.own_input if self.own_output else None

    @property
    def may_be_in_parts(self) -> bool:
        """True if gear sets without common links are possible, as in Lepelletier's gearbox."""
        return bool(self.fixed) and not self.shafts


class FoundBox(NamedTuple):
    """Found gearbox: scheme, input, output, shift elements, and the best-fitting ratios.

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
    """Number of the permanently held link of the scheme, if any."""
    input: int
    """Number of the input link. Separate shafts have the numbers after the links of the scheme."""
    output: int
    """Number of the output link."""
    elements: tuple[tuple[int, int], ...]
    """Two links of each clutch, or a link and `HELD` for a brake. Brakes come first."""
    ratios: tuple[float, ...]
    """Basic ratio of each gear set, sun to ring, carrier held; positive with meshing planets. [-]
    """
    gears: tuple[tuple[int, ...], ...]
    """Engaged shift elements of each gear, in the order of the targets, as indices into `elements`.
    """
    error: float
    """Largest deviation ``|ln(i/target)|`` of all gears. [-]"""

    @property
    def links(self) -> int:
        """Number of links, including shafts that only shift elements connect."""
        ends = chain(*self.elements)
        return max(self.scheme.links, self.input + 1, self.output + 1, *(link + 1 for link in ends))

    @property
    def brakes(self) -> list[tuple[int, int]]:
        """Shift elements that hold a link, with `HELD` as second link."""
        return [element for element in self.elements if element[1] == HELD]

    @property
    def clutches(self) -> list[tuple[int, int]]:
        """Shift elements that connect two links."""
        return [element for element in self.elements if element[1] != HELD]


LARGEST_BOX_RATIO = 1000.0
"""Largest gear ratio, largest inverse of a gear ratio, and largest ring teeth/sun teeth. [-]"""
ANY_QUOTIENT = (1.0, LARGEST_BOX_RATIO**2)
"""Bounds of a quotient of two gear ratios that restrict nothing. [-]"""
MOST_BOX_SETS = 5
"""Largest number of gear sets. More sets have too many schemes to examine."""
SHAFT_ELEMENTS = 3
"""Smallest number of shift elements at a shaft without gear-set members; two would act as a single
clutch.
"""
MOST_LINKS = 10
"""Largest number of moving links: each possible shift element needs a bit of an integer."""
MOST_ELEMENTS = 12
"""Largest number of shift elements."""
MOST_SEQUENCE = 24
"""Largest number of forward gears that are not given by ratios."""
MOST_TARGETS = 62
"""Largest number of targets (wanted ratios): each needs a bit of an integer, a sequence one more.
"""
COARSEST = 0.5
"""Largest permitted tolerance. [-]"""


def check_box_search(search: BoxSearch) -> None:
    """Refuse a search that cannot be carried out.

    Raises
    ------
    CaseError
        If a value is out of bounds, or values are inconsistent. The path of each problem is the
        name of an option.

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
    """Return the possible numbers of shift elements engaged in each gear.

    The number of links of a connected scheme is limited. With a held link, a scheme can consist of
    parts that only clutches connect, as in Lepelletier's gearbox, and so have more links.

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
    """Return the numbers of possible brakes and of possible clutches.

    Examples
    --------
    >>> elements_there(BoxSearch(4, 5, 3, (2.0, 1.0)))
    (6, 28)
    """
    return search.moving - 2, math.comb(search.moving, 2)


def fewest_elements(shafts: int) -> int:
    """Return the smallest number of shift elements with which each shaft has three.

    >>> [fewest_elements(shafts) for shafts in range(5)]
    [0, 3, 5, 6, 6]
    """
    ends = SHAFT_ELEMENTS * shafts
    return ends - min(math.comb(shafts, 2), ends // 2)


def _of_numbers(search: BoxSearch) -> Iterator[Problem]:
    sets = f"{search.sets} {plural('set', search.sets)}"
    if not 1 <= search.sets <= MOST_BOX_SETS:
        yield _problem("sets", f"read {search.sets}, expected 1 to {MOST_BOX_SETS}")
        return
    for name, number in (("meshed", search.meshed), ("fixed", search.fixed)):
        if not 0 <= number <= search.sets:
            yield _problem(name, f"read {number}, expected 0 to {search.sets}, as there are {sets}")
    if not 0 <= search.shafts <= MOST_LINKS:
        yield _problem("shafts", f"read {search.shafts}, expected 0 to {MOST_LINKS}")
        return
    low, high = search.bounds
    if not 1 < low < high <= LARGEST_BOX_RATIO:
        expected = f"two numbers above 1, the larger one second, up to {LARGEST_BOX_RATIO:g}"
        yield _problem("bounds", f"read {low:g}:{high:g}, expected {expected}")
    if not 0 < search.tolerance <= COARSEST:
        yield _problem(
            "tolerance", f"read {search.tolerance:g}, expected a number above 0, up to {COARSEST:g}"
        )


def _of_ratios(search: BoxSearch) -> Iterator[Problem]:
    targets = search.targets
    if len(search.widths) != len(targets):
        yield _problem(
            "tolerances",
            f"read {len(search.tolerances)}, expected one for each of {len(targets)} gears",
        )
    for width in search.tolerances:
        if not 0 < width < math.inf:
            yield _problem("tolerances", f"read {width:g}, expected a number above 0")
    if not targets and search.sequence is None:
        yield _problem("ratios", "read none, expected the ratio of each gear")
    if len(targets) > MOST_TARGETS:
        yield _problem("ratios", f"read {len(targets)}, expected {MOST_TARGETS} at most")
        return
    for target in targets:
        if not 1 / LARGEST_BOX_RATIO <= abs(target) <= LARGEST_BOX_RATIO:
            sizes = f"{1 / LARGEST_BOX_RATIO:g} to {LARGEST_BOX_RATIO:g} in size, below 0 backward"
            yield _problem("ratios", f"read {target:g}, expected a ratio of {sizes}")
    for target in sorted({target for target in targets if targets.count(target) > 1}):
        yield _problem("ratios", f"read {target:g} twice, expected gears that differ")


def _of_sequence(wanted: WantedSequence | None) -> Iterator[Problem]:
    if wanted is None:
        return
    if not 2 <= wanted.least <= wanted.most <= MOST_SEQUENCE:
        given = f"read {wanted.least}:{wanted.most}"
        yield _problem(
            "gears", f"{given}, expected numbers from 2 to {MOST_SEQUENCE}, the larger second"
        )
    for name, (low, high) in (("spread", wanted.spread), ("steps", wanted.steps)):
        if not ANY_QUOTIENT[0] <= low <= high <= ANY_QUOTIENT[1]:
            yield _problem(
                name, f"read {low:g}:{high:g}, expected two numbers from 1 on, the larger second"
            )


def _of_counts(search: BoxSearch) -> Iterator[Problem]:
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
        yield _problem(
            "engaged",
            f"read {engaged}, but then {brakes + 2} links move, expected {MOST_LINKS} at most",
        )
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
            "elements", f"read {elements}, but {used} cannot use more than {gears * engaged}"
        )


def _with(search: BoxSearch) -> str:
    """Describe the settings that limit the engaged elements, except the number of gear sets."""
    ports = (("input", search.own_input), ("output", search.own_output))
    given = [f"an {name} shaft of its own" for name, is_own in ports if is_own]
    if search.shafts:
        given.append(f"{search.shafts} further {plural('shaft', search.shafts)}")
    if search.fixed:
        given.append("held members")
    return f" with {spoken(given)}" if given else ""


def _problem(option: str, message: str) -> Problem:
    return Problem("E801", message, path=(option,))
