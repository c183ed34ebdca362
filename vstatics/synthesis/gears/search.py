"""Search through all combinations of the shift elements of a case, or of all possible elements."""

from __future__ import annotations

import math
import random
import time
from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import chain, islice
from itertools import combinations as subsets

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, listed, plural, quoted, typed_number
from vstatics.core.model.transmission import HOUSING, ShiftElement, Transmission
from vstatics.core.suggestions import nearest
from vstatics.core.summary.unused_sets import needed
from vstatics.synthesis.gears.kinds import (
    EngagedKind,
    EngagedSet,
    EngagedSets,
    Indices,
    element_torques,
    engaged_kinds,
    kind_alone,
)
from vstatics.synthesis.gears.speed_forms import FreeSpeeds, Pair, SpeedForms
from vstatics.synthesis.tolerances import NEAR_DIRECT

AUTO = "auto"
"""Text that requests all shift elements that a scheme can have."""


def chosen_elements(case: Transmission, asked: Sequence[str] = ()) -> list[ShiftElement]:
    """Return the shift elements from which combinations are formed.

    Parameters
    ----------
    asked : sequence of str
        Names or numbers of shift elements of the case, by default all; or ``auto`` alone for
        `all_elements`.

    Raises
    ------
    CaseError
        If a shift element does not exist.

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
        raise CaseError("E812", f"read {quoted(', '.join(asked))}, {expected}")
    numbers = sorted({_number(case, text) for text in asked}) or range(len(case.shift_elements))
    return [case.shift_elements[number] for number in numbers]


def _number(case: Transmission, asked: str) -> int:
    """Return the index of the shift element that a name or, failing that, a number means."""
    names = [element.name for element in case.shift_elements]
    if asked in names:
        return names.index(asked)
    number = typed_number(asked, len(names))
    if number:
        return number - 1
    hint = nearest(asked, [*names, AUTO])
    if not hint:
        hint = f"; expected {listed(names, 12)}" if names else f"; expected `{AUTO}`"
    raise CaseError("E813", f"no shift element {quoted(asked)}{hint}")


def all_elements(case: Transmission) -> list[ShiftElement]:
    """Return all clutches and brakes that are possible between the links of a case.

    Any two links can have a clutch, and any link except input and outputs a brake; planets have
    neither. Shift elements of the case, except freewheels, replace new ones between the same links.
    """
    ports = {case.input, case.output, *case.outputs}
    links = range(1, case.own_links + 1)
    pairs = [
        *subsets(links, 2),
        *((link, HOUSING) for link in links if link not in ports),
    ]
    existing: dict[frozenset[int], ShiftElement] = {}
    for element in case.shift_elements:
        if not element.is_freewheel:
            existing.setdefault(frozenset(element.links), element)
    known = [existing.get(frozenset(pair)) for pair in pairs]
    new = [pair for pair, element in zip(pairs, known, strict=True) if not element]
    names = iter(_names(case, new, {element.name for element in known if element}))
    both = zip(pairs, known, strict=True)
    return [element or ShiftElement(*pair, name=next(names)) for pair, element in both]


def count_all_elements(case: Transmission) -> int:
    """Return the number of shift elements that `all_elements` returns.

    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> count_all_elements(case)
    4
    """
    ports = {case.input, case.output, *case.outputs}
    return case.own_links * (case.own_links - 1) // 2 + case.own_links - len(ports)


def _names(case: Transmission, pairs: Sequence[Pair], taken: set[str]) -> list[str]:
    """Return names made of links, as in ``F-sun-ring`` and ``T-ring``, or of numbers."""
    by_name = [_name([case.link_name(link) for link in pair if link]) for pair in pairs]
    if len(set(by_name)) == len(by_name) and not taken & set(by_name):
        return by_name
    names = [_name([str(link) for link in pair if link]) for pair in pairs]
    while taken & set(names):
        names = [f"{name}'" for name in names]
    return names


def _name(links: Sequence[str]) -> str:
    return "-".join(["T" if len(links) == 1 else "F", *links])


MOST_TRIED_COMBINATIONS = 1_000_000
"""Default largest number of combinations, which take about ten seconds."""
ROW_NUMBERS_AT_ONCE = 500_000
"""Number of matrix entries of combinations that are calculated together."""
MOST_ROW_NUMBERS = 20_000_000
"""Largest number of matrix entries of all shift elements."""
DRAWS = 3
"""Number of random draws of the mechanisms' ratios by which direct drives are recognised."""
WORK = 30_000
"""Average number of elimination steps per combination above which a search is refused."""


def refuse_converters(case: Transmission) -> None:
    """Refuse a case with a torque converter, whose equations depend on the combination.

    Raises
    ------
    CaseError
        If the case has a torque converter.
    """
    for number, part in enumerate(case.mechanisms, 1):
        if part.kind == "converter":
            raise CaseError(
                "E456",
                f"a search for gears accepts no converter ({part.name}): expected the gear train "
                "behind it, with its turbine as `input`",
                ("mechanisms", number),
            )


class CombinationSearch:
    """Search through all combinations of shift elements of a case, calculated on demand.

    Parameters
    ----------
    case : Transmission
    engaged : sequence of int
        Numbers of engaged shift elements; by default the number that leaves one degree of freedom.
    elements : sequence of str
        Shift elements to choose from, by name or number, or ``auto``; by default all of the case.

    Raises
    ------
    CaseError
        If a shift element does not exist, there are too few of them, or the case has a converter.
    """

    def __init__(
        self, case: Transmission, engaged: Sequence[int] = (), elements: Sequence[str] = ()
    ) -> None:
        """Check the request, but calculate nothing yet."""
        refuse_converters(case)
        self.case = case
        self._asked = elements
        self.sizes = list(dict.fromkeys(engaged)) or [needed(case)]
        self.are_own = list(elements) != [AUTO]
        """True if all shift elements belong to the case. False if possible ones are added."""
        self.choice = (
            len(chosen_elements(case, elements)) if self.are_own else count_all_elements(case)
        )
        """Number of shift elements to choose from."""
        for size in engaged:
            if not 0 <= size <= self.choice:
                raise CaseError(
                    "E814",
                    f"read {size} engaged shift elements, expected 0 to {self.choice}: there are "
                    f"{self.choice} {plural('shift element', self.choice)} to choose from",
                )
        if not engaged and self.sizes[0] > self.choice:
            raise CaseError(
                "E815",
                f"{self.sizes[0]} engaged shift elements leave one degree of freedom, but there "
                f"are {self.choice} to choose from",
                ("shift_elements",),
            )

    @cached_property
    def count(self) -> float:
        """Number of combinations; infinite above about 1e200."""
        return sum(map(self._count, self.sizes))

    def _count(self, size: int) -> float:
        few = min(size, self.choice - size)
        digits = math.lgamma(self.choice + 1) - math.lgamma(few + 1)
        digits -= math.lgamma(self.choice - few + 1)
        return math.comb(self.choice, few) if digits < 600 else math.inf

    @cached_property
    def elements(self) -> list[ShiftElement]:
        """Shift elements to choose from."""
        return chosen_elements(self.case, self._asked)

    def check(self, at_most: int | None = MOST_TRIED_COMBINATIONS) -> None:
        """Refuse a search that needs too many combinations, too much memory or too much time.

        Raises
        ------
        CaseError
        """
        if at_most is not None and self.count > at_most:
            raise CaseError(
                "E420",
                f"{self.choice} shift elements have {count_text(self.count)} combinations, more "
                f"than the limit of {at_most}",
                ("shift_elements",),
            )
        room = (self.choice + 3) * (self.case.links + 1)
        free = needed(self.case) + 1  # number of elimination steps for each row
        work = sum(size * (size + 3) * free * self._count(size) for size in self.sizes)
        if room > MOST_ROW_NUMBERS or work > WORK * (at_most or math.inf):
            lacking = "the memory" if room > MOST_ROW_NUMBERS else "an hour of calculation"
            raise CaseError(
                "E817",
                f"{self.choice} shift elements between {self.case.links} links are too many for "
                f"{lacking}; choose from fewer of them, or engage fewer",
                ("shift_elements",),
            )

    def batches(self) -> Iterator[EngagedSets]:
        """Yield all combinations in the order of the shift elements, some thousands at a time."""
        for size in self.sizes:
            chosen = subsets(range(self.choice), size)
            while True:
                members = _members(chosen, size, self._room(size))
                if not len(members):
                    break
                yield self._examined(members)
                if not size:
                    break

    def samples(self) -> Iterator[EngagedSets]:
        """Yield the first combinations of each number of engaged elements."""
        for size in self.sizes:
            yield self._first(size, 100)

    def seconds(self) -> float:
        """Estimate the time for all combinations from a sample [s]."""
        self._first(self.sizes[0], 1)
        total = 0.0
        for size in self.sizes:
            began = time.perf_counter()
            sample = list(self._first(size, min(self._room(size), 2000)).each())
            total += (time.perf_counter() - began) / len(sample) * self._count(size)
        return total

    def _first(self, size: int, most: int) -> EngagedSets:
        return self._examined(_members(subsets(range(self.choice), size), size, most))

    def _room(self, size: int) -> int:
        return max(ROW_NUMBERS_AT_ONCE // ((size + 3) * max(self._forms.free, 1)), 1)

    @cached_property
    def _forms(self) -> SpeedForms:
        return self._forms_of(None)

    @cached_property
    def _drawn_forms(self) -> list[SpeedForms]:
        """Speed forms for random ratios of the mechanisms. The seed is fixed."""
        draw = random.Random(1)  # noqa: S311

        def drawn() -> list[float]:
            return [draw.choice((-1, 1)) * draw.uniform(1.4, 5) for _ in self.case.mechanisms]

        return [self._forms_of(drawn()) for _ in range(DRAWS)]

    def _forms_of(self, ratios: Sequence[float] | None) -> SpeedForms:
        ports = (self.case.input, 0), (self.case.output, 0), (self.case.input, self.case.output)
        pairs = [*(element.links for element in self.elements), *ports]
        return FreeSpeeds(self.case, ratios).forms(pairs)

    def _examined(self, members: Indices) -> EngagedSets:
        effects = engaged_kinds(self._forms, members)
        kinds, ratios, free = effects.kinds.astype(np.intp), effects.ratios, effects.free
        for index in np.flatnonzero(effects.doubtful):
            engaged = [self.elements[element].links for element in members[index]]
            kinds[index], ratios[index], free[index] = kind_alone(self.case, engaged)
        near = np.flatnonzero(abs(ratios - 1) < NEAR_DIRECT)
        for forms in self._drawn_forms if len(near) else ():
            again = engaged_kinds(forms, members[near])  # only results that are not doubtful decide
            near = near[(again.kinds == EngagedKind.GEAR) & again.unity | again.doubtful]
        kinds[near], ratios[near] = EngagedKind.DIRECT, 1.0
        torques = np.full(members.shape, np.nan)
        gears = kinds >= EngagedKind.GEAR
        torques[gears] = element_torques(self._forms, members[gears], ratios[gears])
        return EngagedSets(self.elements, members, kinds, ratios, free, torques)


def _members(chosen: Iterator[tuple[int, ...]], size: int, most: int) -> Indices:
    if not size:
        return np.zeros((1, 0), dtype=np.intp)
    flat = chain.from_iterable(islice(chosen, most))
    return np.fromiter(flat, dtype=np.intp).reshape(-1, size)


def count_text(count: float) -> str:
    """Return a number of combinations as text.

    >>> count_text(66), count_text(10**30), count_text(math.inf)
    ('66', 'about 1e+30', 'more than 1e+200')
    """
    if count == math.inf:
        return "more than 1e+200"
    return f"about {count:.3g}" if count >= 1e15 else f"{count}"


@refusing()
def combinations(
    case: Transmission,
    engaged: int | Sequence[int] = (),
    elements: str | Sequence[str] = (),
    at_most: int = MOST_TRIED_COMBINATIONS,
) -> list[EngagedSet]:
    """Return all combinations of engaged shift elements of a case, with kinds and ratios.

    The kind follows from the speeds of input and output that mechanisms, springs at mean speeds and
    engaged shift elements permit: ``blocked``: the input cannot turn; ``parking``: the output is at
    rest while the input turns; ``neutral``: input and output turn independently; ``gear``: input
    and output have a fixed ratio; ``direct``: the ratio is 1 for any ratios of the mechanisms.

    Parameters
    ----------
    case : Transmission
        Gearbox, possibly without gears.
    engaged : int or sequence of int
        Numbers of engaged shift elements; by default the number that leaves one degree of freedom.
    elements : str or sequence of str
        Shift elements to choose from, by names or numbers; by default all of the case. ``"auto"``
        selects all possible clutches and brakes. Freewheels count as engaged.
    at_most : int
        Largest number of combinations.

    Returns
    -------
    list of EngagedSet
        Names of the engaged shift elements, the kind, and the ratio [-] if it exists.

    Raises
    ------
    CaseError
        If a shift element does not exist, or there are more than `at_most` combinations.

    Source
    ------
    docs/synthesis/method.md.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> for one in combinations(case):
    ...     print(one.engaged, one.kind, one.ratio)
    ['T1'] gear 3.5
    ['F2'] direct 1.0
    """
    sizes = [engaged] if isinstance(engaged, int) else engaged
    asked = [elements] if isinstance(elements, str) else elements
    search = CombinationSearch(case, sizes, asked)
    search.check(at_most)
    return [combination for batch in search.batches() for combination in batch.each()]
