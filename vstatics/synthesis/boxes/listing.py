"""Records of found gearboxes as listed in a document, for pictures, pages and summaries."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, NamedTuple

from vstatics.core.errors import ReadError, listed
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers import from_dict
from vstatics.core.statics.solve import solve
from vstatics.core.tables.answer import Count, Sometimes, Words, json_keys
from vstatics.core.writers.named import mapping
from vstatics.synthesis.boxes.box import ANY_QUOTIENT, BoxSearch
from vstatics.synthesis.boxes.choice import RankedBox
from vstatics.synthesis.boxes.figures.by_box import BoxFigures
from vstatics.synthesis.structures.growth import SchemeCode
from vstatics.synthesis.tolerances import SAME_BOX_RATIO


class ListedGear(NamedTuple):
    """Gear of a gearbox listed in a document."""

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


@json_keys(
    *("code", "input", "output", "held", "elements", "ratios", "gears"),
    *BoxFigures._fields,
    *("family", "core", "known", "ravigneaux", "pareto", "case"),
)
class ListedBox(NamedTuple):
    """Gearbox listed in a document, with the number in the document, from 1."""

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
    """Two links of each shift element, by name. The second link of a brake is the housing."""
    ratios: Mapping[str, float]
    gears: Mapping[str, ListedGear]
    case: Annotated[
        Mapping[str, Any], Words(description="The case, as written by `vstatics convert`.")
    ]
    known: str | None
    """Name of the shipped case that equals the gearbox.

    None means that no shipped case equals the gearbox.
    """
    ravigneaux: Mapping[str, tuple[str, ...]]
    """Two gear sets that form each Ravigneaux set, by name."""
    number: int = 0
    input: Count = 0
    """Number of the input link; 0 for a gearbox that was read from a document, where the number is
    not needed.
    """
    output: Count = 0
    held: Sometimes[Count] = None

    def transmission(self) -> Transmission:
        """Return the case of the gearbox, as stored in the document.

        Raises
        ------
        ReadError
            If the stored case is not valid.
        """
        try:
            return from_dict(self.case)
        except ReadError as error:
            name = f"case of box {self.number}"
            raise ReadError(
                problem._replace(message=f"{name}: {problem.message}") for problem in error.problems
            ) from None

    def contradictions(self) -> Iterator[str]:
        """Yield contradictions between the data of the gearbox and the stored case.

        All gear ratios are compared, but gear sets only if they have the same names.

        Raises
        ------
        ReadError
            If the stored case is not valid.
        """
        results = solve(self.transmission())
        case = results.case
        names = {
            name: f"{pair}.{mesh}"
            for pair, sets in self.ravigneaux.items()
            for name, mesh in zip(sets, ("large_sun-ring", "small_sun-ring"), strict=False)
        }
        of_sets = {mechanism.name: mechanism.ratio for mechanism in case.mechanisms}
        for name, ratio in self.ratios.items():
            of_case = of_sets.get(names.get(name, name), ratio)
            if not _equal(ratio, of_case):
                yield f"the ratio of set {name} is {ratio:.9g}, but {of_case:.9g} in its `case`"
        of_gears = {
            gear.name: (
                {case.shift_elements[number - 1].name for number in gear.engaged},
                float(ratio),
            )
            for gear, ratio in zip(case.gears, results.ratio, strict=True)
        }
        if {*of_gears} != {*self.gears}:
            both = listed([*self.gears]), listed([*of_gears])
            yield f"its gears are {both[0]}, but {both[1]} in its `case`"
        for name in [name for name in self.gears if name in of_gears]:
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
    """Return the record of a found gearbox for a document."""
    measured_box, box = ranked.found, ranked.found.box
    return ListedBox(
        **measured_box.figures._asdict(),
        family=ranked.family,
        core=ranked.core,
        known=measured_box.known,
        ravigneaux=measured_box.ravigneaux,
        pareto=ranked.pareto,
        code=box.scheme.code,
        elements=measured_box.elements,
        ratios=measured_box.ratios,
        gears={
            gear.name: ListedGear(*gear[1:-1], **gear.figures._asdict())
            for gear in measured_box.gears
        },
        case=mapping(measured_box.case),
        number=number,
        input=box.input,
        output=box.output,
        held=box.held,
    )


Range = tuple[float, ...]
"""Lower and upper end of a wanted range; empty if unrestricted. [-]"""


class WantedOfBoxes(NamedTuple):
    """Gears requested by the search that a document describes."""

    ratios: tuple[Range, ...]
    """Range of the ratio of each gear; negative for reverse. [-]"""
    tolerance: float
    """Tolerance of ratios that are not given as ranges. [-]"""
    gears: tuple[int, ...]
    """Smallest and largest number of further forward gears; empty if not requested."""
    spread: Range
    """Range of the ratio spread: first ratio divided by last ratio. [-]"""
    steps: Range
    """Range of the step ratios: each ratio divided by the next ratio. [-]"""
    falling: bool
    """True if step ratios must not increase from gear to gear."""


def wanted_of(search: BoxSearch) -> WantedOfBoxes:
    """Return the gears that a search requests.

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
    """Return a range, or an empty range if nothing is restricted."""
    return () if tuple(ends) == ANY_QUOTIENT else ends


@json_keys(
    *("searched", "found", "complete", "given_up", "wanted"),
    families="family_count",
    boxes="boxes",
)
class BoxListing(NamedTuple):
    """Gearboxes listed in a document, with the counts of the search."""

    searched: Count
    boxes: tuple[ListedBox, ...]
    given_up: Count = 0
    """Number of sets of shift elements that were not examined completely, but could give gearboxes.
    """
    wanted: Sometimes[WantedOfBoxes] = None
    """Requested gears.

    None means that the document does not contain the request.
    """

    @property
    def complete(self) -> bool:
        """True if the search was complete, so that the request has no further gearboxes."""
        return not self.given_up

    @property
    def found(self) -> Count:
        """Number of gearboxes."""
        return len(self.boxes)

    @property
    def family_count(self) -> Count:
        """Number of families."""
        return len(self.families)

    @property
    def families(self) -> dict[int, list[ListedBox]]:
        """Gearboxes with equal ratios in all gears, by family number."""
        members: dict[int, list[ListedBox]] = {}
        for box in self.boxes:
            members.setdefault(box.family, []).append(box)
        return members


def drawn_boxes(listing: BoxListing, most: int) -> list[ListedBox]:
    """Return at most `most` gearboxes to draw, in the order of the document.

    Gearboxes are chosen in this order: gearboxes of the Pareto list from different families, the
    first gearbox of each other family, further gearboxes of the Pareto list, all others.
    """
    seen: set[int] = set()
    ranks: list[tuple[int, int, ListedBox]] = []
    for box in sorted(listing.boxes, key=lambda box: (not box.pareto, box.number)):
        is_first = box.family not in seen
        seen.add(box.family)
        rank = (0 if box.pareto else 1) if is_first else (2 if box.pareto else 3)
        ranks.append((rank, box.number, box))
    return sorted((box for *_, box in sorted(ranks)[:most]), key=lambda box: box.number)
