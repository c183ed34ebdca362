"""Request for gearboxes, its limits, and the record of a found gearbox."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.errors import CaseError, Problem, plural, spoken

if TYPE_CHECKING:
    from vstatics.synthesis.structures.scheme import SetScheme

HELD = -1
"""Number that replaces the second link of a brake: the housing."""
EFFICIENCY = 0.98
"""Default basic efficiency of each gear set (carrier held). [-]"""


class KeptParts(NamedTuple):
    """Parts of an existing gearbox that found gearboxes retain."""

    scheme: SetScheme
    meshed: tuple[bool, ...]
    """True for each set with meshed planets, shape (sets,)."""
    held: int | None
    """Permanently held link of the scheme, if any."""
    input: int
    output: int
    elements: tuple[tuple[int, int], ...]
    """Shift elements, as in `FoundBox`."""
    free: int
    """Largest number of these shift elements that a found gearbox can lack."""


class WantedSequence(NamedTuple):
    """Forward gears that are not given by ratios but by number, spread and steps."""

    least: int
    """Smallest number of gears."""
    most: int
    """Largest number of gears."""
    spread: tuple[float, float]
    """Range of the first ratio divided by the last. [-]"""
    steps: tuple[float, float]
    """Range of each ratio divided by the next. [-]"""
    falling: bool = False
    """True if no step can be larger than the step between the next lower gears."""


class BoxSearch(NamedTuple):
    """Request for gearboxes: numbers of parts, wanted ratios and tolerances.

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
    """Smallest and largest ring teeth/sun teeth of each gear set. [-]"""
    meshed: int = 0
    """Number of sets with meshed planets."""
    own_input: bool = False
    """True if the input is a separate shaft, connected by clutches only."""
    own_output: bool = False
    """True if the output is a separate shaft, connected by clutches only."""
    shafts: int = 0
    """Number of further shafts without a gear-set member, each connected to at least three
    elements."""
    fixed: int = 0
    """Number of permanently held members, which form an additional link of the scheme."""
    tolerance: float = 0.01
    """Largest ``|ln(i/target)|`` of the gears of a found gearbox. [-]"""
    tolerances: tuple[float, ...] = ()
    """Largest ``|ln(i/target)|`` of each gear; empty for `tolerance` everywhere. [-]"""
    brake_counts: tuple[int, ...] | None = None
    """Allowed numbers of brakes; any number if not given."""
    singly: bool = False
    """True to search only gearboxes in which neighbouring gears can differ by a single exchange."""

    sequence: WantedSequence | None = None
    """Forward gears in addition to the targets, given by number, spread and steps."""
    kept: KeptParts | None = None
    """Parts retained from an existing gearbox."""

    @property
    def widths(self) -> tuple[float, ...]:
        """Largest ``|ln(i/target)|`` of each gear [-].

        >>> BoxSearch(2, 4, 2, (2.84, 1.57)).widths
        (0.01, 0.01)
        """
        return self.tolerances or (self.tolerance,) * len(self.targets)

    @property
    def links(self) -> int:
        """Number of links of the scheme, including the held link."""
        return self.moving - self.own_input - self.own_output - self.shafts + bool(self.fixed)

    @property
    def moving(self) -> int:
        """Number of links that can rotate, including shafts without a gear-set member."""
        return self.sets + self.engaged + 1

    @property
    def input(self) -> int | None:
        """Number of a separate input shaft, which follows the links of the scheme."""
        return self.links if self.own_input else None

    @property
    def output(self) -> int | None:
        """Number of a separate output shaft, after a separate input shaft."""
        return self.links + self.own_input if self.own_output else None

    @property
    def may_be_in_parts(self) -> bool:
        """True if shift elements alone can connect some sets, as in Lepelletier's gearbox."""
        return bool(self.fixed) and not self.shafts


class FoundBox(NamedTuple):
    """Scheme with ports and shift elements, with the best-fitting ratios.

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
    """Permanently held link of the scheme, if any."""
    input: int
    """Input link. Separate shafts follow the links of the scheme: input, output, further shafts."""
    output: int
    """Output link."""
    elements: tuple[tuple[int, int], ...]
    """Two links of each clutch, or a link and `HELD` for a brake; brakes first."""
    ratios: tuple[float, ...]
    """Basic ratio of each set, sun to ring with the carrier held; positive with meshed planets.
    [-]"""
    gears: tuple[tuple[int, ...], ...]
    """Engaged elements in each target's gear, as indices into `elements`."""
    error: float
    """Largest ``|ln(i/target)|``. [-]"""

    @property
    def links(self) -> int:
        """Number of links, including shafts connected by shift elements only."""
        ends = chain(*self.elements)
        return max(self.scheme.links, self.input + 1, self.output + 1, *(link + 1 for link in ends))

    @property
    def brakes(self) -> list[tuple[int, int]]:
        """Shift elements that hold a link."""
        return [element for element in self.elements if element[1] == HELD]

    @property
    def clutches(self) -> list[tuple[int, int]]:
        """Shift elements that connect two links."""
        return [element for element in self.elements if element[1] != HELD]


LARGEST_BOX_RATIO = 1000.0
"""Upper limit of gear ratios, of reciprocal ratios, and of ring teeth/sun teeth. [-]"""
ANY_QUOTIENT = (1.0, LARGEST_BOX_RATIO**2)
"""Widest range of the ratio of a gear divided by the ratio of a later gear. [-]"""
MOST_BOX_SETS = 5
"""Largest number of gear sets; more sets have more schemes than can be examined."""
SHAFT_ELEMENTS = 3
"""Smallest number of shift elements at a further shaft; two would act as a single clutch."""
MOST_LINKS = 10
"""Largest number of moving links, whose possible brakes and clutches are bits of an integer."""
MOST_ELEMENTS = 12
"""Largest number of shift elements."""
MOST_SEQUENCE = 24
"""Largest number of forward gears without given ratios."""
MOST_TARGETS = 62
"""Largest number of targets, which are bits of an integer with a spare bit for a sequence."""
COARSEST = 0.5
"""Largest tolerance. [-]"""


def check_box_search(search: BoxSearch) -> None:
    """Refuse a search that cannot be carried out.

    Raises
    ------
    CaseError
        If a value is out of bounds or numbers are inconsistent; the path of each problem is the
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
    """Return the possible numbers of engaged elements for a number of gear sets.

    A connected scheme has a limited number of links. With a held link a scheme can consist of parts
    that only clutches connect, as in Lepelletier's gearbox.

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
    """Return the numbers of available brakes and clutches.

    Examples
    --------
    >>> elements_there(BoxSearch(4, 5, 3, (2.0, 1.0)))
    (6, 28)
    """
    return search.moving - 2, math.comb(search.moving, 2)


def fewest_elements(shafts: int) -> int:
    """Return the fewest shift elements that give each shaft three; a clutch can serve two shafts.

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
    """Describe the settings, except the number of sets, that limit the number engaged."""
    ports = (("input", search.own_input), ("output", search.own_output))
    given = [f"an {name} shaft of its own" for name, is_own in ports if is_own]
    if search.shafts:
        given.append(f"{search.shafts} further {plural('shaft', search.shafts)}")
    if search.fixed:
        given.append("held members")
    return f" with {spoken(given)}" if given else ""


def _problem(option: str, message: str) -> Problem:
    return Problem("E801", message, path=(option,))
