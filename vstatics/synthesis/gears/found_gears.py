"""Conversion of combinations of shift elements to gears of a case."""

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
"""Largest number of gears of a written case."""


class FoundGears(NamedTuple):
    """Case with the found gears, and the gears that were left out."""

    case: Transmission
    slipping: Sequence[str]
    """Names of gears that were left out because freewheels would not hold."""
    free: int = 0
    """Number of gears that were left out because other links would be undetermined."""


def found_gears(search: CombinationSearch) -> FoundGears:
    """Return the case of a search with the gears of all combinations.

    Forward gears come first; gears of each direction are ordered from the largest ratio to the
    smallest. An existing gear with the same elements, input and output, and without given speeds,
    is unchanged. A new gear is named after its shift elements, as in ``F1+T3``, and has the drag
    that all gears share. New gears that leave other links undetermined are left out, unless all
    gears do.

    Raises
    ------
    CaseError
        If no gear exists, or too many for a case.

    Examples
    --------
    >>> from vstatics import Mechanism
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1], name="low")])
    >>> [gear.name for gear in found_gears(CombinationSearch(case)).case.gears]
    ['low', 'F2']
    """
    case = search.case
    freewheels = {element.name for element in search.elements if element.is_freewheel}
    existing: dict[frozenset[str], Gear] = {}
    for gear in case.gears:
        if is_plain(case, gear):
            of_gear = (case.shift_elements[number - 1].name for number in gear.engaged)
            existing.setdefault(frozenset(of_gear), gear)
    determined: dict[frozenset[str], list[float]] = {}
    free: dict[frozenset[str], list[float]] = {}
    left = 0
    batches = (batch.where(batch.gears) for batch in search.batches())
    for combination in (combination for batch in batches for combination in batch.each()):
        names = frozenset(combination.engaged) - freewheels
        is_free = combination.free and names not in existing
        left += is_free
        if not is_free:
            determined.setdefault(names, []).append(combination.ratio)
        elif len(free) <= MOST_GEARS:
            free.setdefault(names, []).append(combination.ratio)
        if len(determined) > MOST_GEARS:
            break
    chosen = determined or free
    if not chosen:
        raise CaseError("E809", "no combination of shift elements gives a gear")
    if len(chosen) > MOST_GEARS:
        raise CaseError(
            "E810",
            f"the combinations give more than {MOST_GEARS} gears, too many for a case"
            "; choose from fewer shift elements",
        )
    left *= bool(determined)
    elements = case.shift_elements if search.are_own else search.elements
    gears = list(_gears(case, elements, existing, chosen))
    extended = case.replace(shift_elements=elements, gears=gears)
    if extended.freewheels:
        return _holding(extended, list(chosen.values()))._replace(free=left)
    ratios = [ratio for [ratio] in chosen.values()]
    return FoundGears(_ordered(extended, gears, ratios), [], left)


def _ordered(case: Transmission, gears: Sequence[Gear], ratios: Sequence[float]) -> Transmission:
    def place(index: int) -> tuple[bool, float]:
        return ratios[index] < 0, -float(f"{abs(ratios[index]):.9e}")

    return case.replace(gears=[gears[index] for index in sorted(range(len(gears)), key=place)])


def _gears(
    case: Transmission,
    elements: Sequence[ShiftElement],
    existing: Mapping[frozenset[str], Gear],
    engaged: Iterable[frozenset[str]],
) -> Iterator[Gear]:
    """Yield a gear for each set of engaged shift elements: the existing gear, or a new gear.

    Shift elements are numbered by their position in `elements`.
    """
    number = {element.name: place for place, element in enumerate(elements, 1)}
    old = {place: element.name for place, element in enumerate(case.shift_elements, 1)}

    def renumbered(by_element: Mapping[int, float]) -> dict[int, float]:
        pairs = ((old[place], value) for place, value in by_element.items())
        return {number[name]: value for name, value in pairs if name in number}

    drag = shared([gear.drag for gear in case.gears])
    open_drag = renumbered(shared([gear.open_drag for gear in case.gears]))
    taken = {gear.name for gear in existing.values()}
    for names in engaged:
        chosen = sorted(number[name] for name in names)
        if names in existing:
            gear = existing[names]
            yield gear._replace(engaged=chosen, open_drag=renumbered(gear.open_drag))
            continue
        name = "+".join(elements[place - 1].name for place in chosen) or "open"
        while name in taken:
            name += "'"
        taken.add(name)
        yield Gear(chosen, name=name, drag=drag, open_drag=open_drag)


def _holding(case: Transmission, expected: Sequence[Sequence[float]]) -> FoundGears:
    """Return a case with the gears whose freewheels hold, and the names of all other gears."""
    solved = list(zip(case.gears, solve(case).ratio.tolist(), expected, strict=True))
    holds = [any(is_same(ratio, wanted) for wanted in expected) for _, ratio, expected in solved]
    slipping = [gear.name for (gear, *_), is_so in zip(solved, holds, strict=True) if not is_so]
    holding = [gear for gear, is_so in zip(solved, holds, strict=True) if is_so]
    if not holding:
        raise CaseError(
            "E811", f"the freewheels do not hold in any of the gears {listed(slipping)}"
        )
    gears, ratios, _ = zip(*holding, strict=True)
    return FoundGears(_ordered(case, gears, ratios), slipping)
