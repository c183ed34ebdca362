"""Found boxes as a document lists them, for pictures, a page and summaries."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, NamedTuple

from vstatics.core.errors import ReadError, listed
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers import from_dict
from vstatics.core.statics.solve import solve
from vstatics.core.tables.answer import Count, Sometimes, Words, told
from vstatics.core.writers.named import mapping
from vstatics.synthesis.boxes.box import ANY_QUOTIENT, BoxSearch
from vstatics.synthesis.boxes.choice import RankedBox
from vstatics.synthesis.boxes.figures.by_box import BoxFigures
from vstatics.synthesis.structures.growth import SchemeCode
from vstatics.synthesis.tolerances import SAME_BOX_RATIO


class ListedGear(NamedTuple):
    """A gear of a listed box."""

    engaged: tuple[str, ...]
    ratio: float
    target: float
    torques: Mapping[str, float]
    slips: Mapping[str, float]
    carriers: Mapping[str, float]
    planets: Mapping[str, float]
    losses: Mapping[str, float]
    circulating: float
    drag: float


@told(
    *("code", "input", "output", "held", "elements", "ratios", "gears"),
    *BoxFigures._fields,
    *("family", "core", "known", "ravigneaux", "pareto", "case"),
)
class ListedBox(NamedTuple):
    """A box of a document, with its number in the order of the document from 1."""

    error: float
    loss: float
    planet_speed: float
    slip: float
    torque: float
    brakes: int
    clutches: int
    drag: float
    skip_shifts: int
    reversing: tuple[str, ...]
    one_way: tuple[str, ...]
    beyond: tuple[float, ...]
    family: Count
    core: Count
    single: bool
    planar: bool
    pareto: bool
    code: SchemeCode
    elements: Mapping[str, tuple[str, ...]]
    """By name the two links that each joins, or a link and the housing."""
    ratios: Mapping[str, float]
    gears: Mapping[str, ListedGear]
    case: Annotated[Mapping[str, Any], Words(description="As vstatics convert has it.")]
    known: str | None
    """The shipped case that it is."""
    ravigneaux: Mapping[str, tuple[str, ...]]
    """By name the two sets that are one Ravigneaux set."""
    number: int = 0
    input: Count = 0
    """Links of the code; 0 where the document was read, which needs them not."""
    output: Count = 0
    held: Sometimes[Count] = None

    def transmission(self) -> Transmission:
        """Its case.

        Raises
        ------
        ReadError
            If what stands there is none.
        """
        try:
            return from_dict(self.case)
        except ReadError as error:
            name = f"case of box {self.number}"
            raise ReadError(
                one._replace(message=f"{name}: {one.message}") for one in error.problems
            ) from None

    def contradictions(self) -> Iterator[str]:
        """Name what the box says about ratios and shift elements, and its case says otherwise.

        Sets that its case has by other names are not compared; the ratios of its gears are.

        Raises
        ------
        ReadError
            If its case is not a case.
        """
        results = solve(self.transmission())
        case = results.case
        names = {
            name: f"{pair}.{mesh}"
            for pair, sets in self.ravigneaux.items()
            for name, mesh in zip(sets, ("large_sun-ring", "small_sun-ring"), strict=False)
        }
        of_sets = {one.name: one.ratio for one in case.mechanisms}
        for name, ratio in self.ratios.items():
            of_case = of_sets.get(names.get(name, name), ratio)
            if not _equal(ratio, of_case):
                yield f"the ratio of set {name} is {ratio:.9g}, but {of_case:.9g} in its `case`"
        of_gears = {
            gear.name: ({case.shift_elements[one - 1].name for one in gear.engaged}, float(ratio))
            for gear, ratio in zip(case.gears, results.ratio, strict=True)
        }
        if {*of_gears} != {*self.gears}:
            both = listed([*self.gears]), listed([*of_gears])
            yield f"its gears are {both[0]}, but {both[1]} in its `case`"
        for name in [one for one in self.gears if one in of_gears]:
            gear, (engaged, ratio) = self.gears[name], of_gears[name]
            if {*gear.engaged} != engaged:
                both = listed(sorted(gear.engaged)), listed(sorted(engaged))
                yield f"gear {name} engages {both[0]}, but {both[1]} in its `case`"
            elif not _equal(gear.ratio, ratio):
                yield f"the ratio of gear {name} is {gear.ratio:.9g}, but {ratio:.9g} in its `case`"


def _equal(ratio: float, other: float) -> bool:
    return math.isclose(ratio, other, rel_tol=SAME_BOX_RATIO) or (
        math.isnan(ratio) and math.isnan(other)
    )


def listed_box(number: int, ranked: RankedBox) -> ListedBox:
    """A found box as it is listed."""
    found, box = ranked.found, ranked.found.box
    return ListedBox(
        **found.figures._asdict(),
        family=ranked.family,
        core=ranked.core,
        known=found.known,
        ravigneaux=found.ravigneaux,
        pareto=ranked.pareto,
        code=box.scheme.code,
        elements=found.elements,
        ratios=found.ratios,
        gears={
            gear.name: ListedGear(*gear[1:-1], **gear.figures._asdict()) for gear in found.gears
        },
        case=mapping(found.case),
        number=number,
        input=box.input,
        output=box.output,
        held=box.held,
    )


Range = tuple[float, ...]
"""The least and the largest; empty where nothing is asked. [-]"""


class WantedOfBoxes(NamedTuple):
    """What was asked of the gears of the boxes of a document."""

    ratios: tuple[Range, ...]
    """Of each gear, below 0 backward."""
    tolerance: float
    """Of those ratios that are no ranges. [-]"""
    gears: tuple[int, ...]
    """The fewest and the most forward gears besides them; empty where none are asked."""
    spread: Range
    """Of the first ratio over the last."""
    steps: Range
    """Of each ratio over the next one."""
    falling: bool
    """Whether no step is larger than the one below it."""


def wanted_of(search: BoxSearch) -> WantedOfBoxes:
    """What a search asks of the gears.

    Examples
    --------
    >>> search = BoxSearch(1, 2, 1, (2.0, -1.0), tolerances=(math.log(2), 0.01))
    >>> [[round(end, 3) for end in one] for one in wanted_of(search).ratios]
    [[1.0, 4.0], [-1.01, -0.99]]
    """
    ratios = tuple(
        tuple(sorted(float(f"{target * math.exp(sign * width):.12g}") for sign in (-1, 1)))
        for target, width in zip(search.targets, search.widths, strict=True)
    )
    gears = search.sequence
    if gears is None:
        return WantedOfBoxes(ratios, search.tolerance, (), (), (), falling=False)
    ends = (gears.least, gears.most), _asked(gears.spread), _asked(gears.steps)
    return WantedOfBoxes(ratios, search.tolerance, *ends, falling=gears.falling)


def _asked(ends: Range) -> Range:
    """A range; empty where it has all that can be."""
    return () if tuple(ends) == ANY_QUOTIENT else ends


@told(
    *("searched", "found", "complete", "given_up", "wanted"),
    families="family_count",
    boxes="boxes",
)
class BoxListing(NamedTuple):
    """What a search for boxes has found."""

    searched: Count
    boxes: tuple[ListedBox, ...]
    given_up: Count = 0
    """Sets of elements that may be boxes, too, but could not be looked at to the end."""
    wanted: Sometimes[WantedOfBoxes] = None
    """None where a document does not tell it."""

    @property
    def complete(self) -> bool:
        """Whether there are no other boxes."""
        return not self.given_up

    @property
    def found(self) -> Count:
        """How many boxes there are."""
        return len(self.boxes)

    @property
    def family_count(self) -> Count:
        """How many families they are."""
        return len(self.families)

    @property
    def families(self) -> dict[int, list[ListedBox]]:
        """The boxes with equal ratios in all gears, by the number of their family."""
        found: dict[int, list[ListedBox]] = {}
        for box in self.boxes:
            found.setdefault(box.family, []).append(box)
        return found


def drawn_boxes(listing: BoxListing, most: int) -> list[ListedBox]:
    """The boxes that get a diagram, in the order of the document.

    First come those of the Pareto list, each of another family, then the first of each other
    family, the rest of the Pareto list, and the rest.
    """
    seen: set[int] = set()
    ranks: list[tuple[int, int, ListedBox]] = []
    for box in sorted(listing.boxes, key=lambda box: (not box.pareto, box.number)):
        is_first = box.family not in seen
        seen.add(box.family)
        rank = (0 if box.pareto else 1) if is_first else (2 if box.pareto else 3)
        ranks.append((rank, box.number, box))
    return sorted((box for *_, box in sorted(ranks)[:most]), key=lambda box: box.number)
