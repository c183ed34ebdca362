"""The gears that combinations of shift elements give, as gears of a case."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError, listed
from vstatics.core.model.transmission import Gear, ShiftElement, Transmission
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import is_same
from vstatics.core.summary.unused_sets import is_plain, shared
from vstatics.synthesis.gears.search import CombinationSearch

MOST_GEARS = 5000
"""So many gears may a case be written with."""


class FoundGears(NamedTuple):
    """A case with the gears that were found."""

    case: Transmission
    slipping: Sequence[str]
    """Names of gears that are left out, as their freewheels would not hold."""
    free: int = 0
    """So many are left out besides, as they leave other links undetermined."""


def found_gears(search: CombinationSearch) -> FoundGears:
    """The case of a search with all gears that its combinations give.

    They stand from the largest ratio to the smallest, those of the other direction last. One
    that the case has already, with its input and output and no given speeds, stays as it is;
    a new one is called by its elements, ``F1+T3``, and has the drag that all gears share. New
    ones that leave other links undetermined are left out, unless all gears are such.

    Raises
    ------
    CaseError
        If there is none, or more than a case should have.

    Examples
    --------
    >>> from vstatics import Mechanism
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1], name="low")])
    >>> [gear.name for gear in found_gears(CombinationSearch(case)).case.gears]
    ['low', 'F2']
    """
    case = search.case
    wheels = {one.name for one in search.elements if one.is_freewheel}
    own = _own(case)
    found: dict[frozenset[str], list[float]] = {}
    free: dict[frozenset[str], list[float]] = {}
    left = 0
    for one in (one for batch in search.batches() for one in batch.where(batch.gears).each()):
        names = frozenset(one.engaged) - wheels
        is_free = one.free and names not in own
        left += is_free
        if not is_free:
            found.setdefault(names, []).append(one.ratio)
        elif len(free) <= MOST_GEARS:
            free.setdefault(names, []).append(one.ratio)
        if len(found) > MOST_GEARS:
            break
    chosen = found or free
    if not chosen:
        raise CaseError("E809", "no combination of shift elements gives a gear")
    if len(chosen) > MOST_GEARS:
        message = f"the combinations give more than {MOST_GEARS} gears, too many for a case"
        raise CaseError("E810", f"{message}; expected fewer elements to choose from")
    left *= bool(found)
    elements = case.shift_elements if search.are_own else search.elements
    gears = list(_gears(case, elements, own, chosen))
    made = case.replace(shift_elements=elements, gears=gears)
    if made.freewheels:
        return _holding(made, list(chosen.values()))._replace(free=left)
    ratios = [ratio for [ratio] in chosen.values()]
    return FoundGears(_ordered(made, gears, ratios), [], left)


def _own(case: Transmission) -> dict[frozenset[str], Gear]:
    """Gears of a case that combinations can be compared with, by the names of their elements."""
    own: dict[frozenset[str], Gear] = {}
    for gear in case.gears:
        if is_plain(case, gear):
            names = (case.shift_elements[number - 1].name for number in gear.engaged)
            own.setdefault(frozenset(names), gear)
    return own


def _ordered(case: Transmission, gears: Sequence[Gear], ratios: Sequence[float]) -> Transmission:
    """The case with gears in the order of their ratios; digits of rounding do not decide."""

    def place(index: int) -> tuple[bool, float]:
        return ratios[index] < 0, -float(f"{abs(ratios[index]):.9e}")

    return case.replace(gears=[gears[index] for index in sorted(range(len(gears)), key=place)])


def _gears(
    case: Transmission,
    elements: Sequence[ShiftElement],
    own: Mapping[frozenset[str], Gear],
    engaged: Iterable[frozenset[str]],
) -> Iterator[Gear]:
    """Gears that engage these, its own ones or new ones; numbers are those of `elements`."""
    number = {element.name: place for place, element in enumerate(elements, 1)}
    old = {place: element.name for place, element in enumerate(case.shift_elements, 1)}

    def renumbered(by_element: Mapping[int, float]) -> dict[int, float]:
        pairs = ((old[place], value) for place, value in by_element.items())
        return {number[name]: value for name, value in pairs if name in number}

    drag = shared([gear.drag for gear in case.gears])
    open_drag = renumbered(shared([gear.open_drag for gear in case.gears]))
    taken = {gear.name for gear in own.values()}
    for names in engaged:
        chosen = sorted(number[name] for name in names)
        if names in own:
            gear = own[names]
            yield gear._replace(engaged=chosen, open_drag=renumbered(gear.open_drag))
            continue
        name = "+".join(elements[place - 1].name for place in chosen) or "open"
        while name in taken:
            name += "'"
        taken.add(name)
        yield Gear(chosen, name=name, drag=drag, open_drag=open_drag)


def _holding(case: Transmission, expected: Sequence[Sequence[float]]) -> FoundGears:
    """The same without the gears whose freewheels do not hold as they should."""
    found = list(zip(case.gears, solve(case).ratio.tolist(), expected, strict=True))
    holds = [any(is_same(ratio, one) for one in expected) for _, ratio, expected in found]
    slipping = [gear.name for (gear, *_), is_so in zip(found, holds, strict=True) if not is_so]
    kept = [one for one, is_so in zip(found, holds, strict=True) if is_so]
    if not kept:
        message = f"the freewheels do not hold in any of the gears {listed(slipping)}"
        raise CaseError("E811", message)
    gears, ratios, _ = zip(*kept, strict=True)
    return FoundGears(_ordered(case, gears, ratios), slipping)
