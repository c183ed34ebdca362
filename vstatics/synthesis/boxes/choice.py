"""Choice among found gearboxes: filter, order, families and the Pareto list."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher, require
from vstatics.core.model.empty import EMPTY
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.tables.html import shown
from vstatics.synthesis.boxes.box import EFFICIENCY, BoxSearch, FoundBox, check_box_search
from vstatics.synthesis.boxes.figures.by_box import FIGURES, USUAL, BoxOrder
from vstatics.synthesis.boxes.figures.measured import ALIKE, FIGURE_DECIMALS, MeasuredBox, measured
from vstatics.synthesis.boxes.grouping import core_of, families, numbered, pareto, places
from vstatics.synthesis.boxes.least_form import identity

NO_RATIO = 1e9
"""Placeholder for the ratio of a missing gear, larger than any ratio. [-]"""
ORDER = ("error", "loss", "torque", "clutches", "planet_speed")
"""Figures that order gearboxes by default."""


class RankedBox(NamedTuple):
    """Found gearbox with the numbers of family and core, and a mark for the Pareto list."""

    found: MeasuredBox
    family: int
    """Number of the family, from 1; all gearboxes of a family have equal ratios in all gears."""
    core: int
    """Number of the core, from 1. Gearboxes of equal family and core differ only in clutches."""
    pareto: bool
    """True if no other gearbox is better in a figure of the Pareto list and worse in no figure.
    """


def ranked(
    search: BoxSearch,
    boxes: Iterable[MeasuredBox],
    wanted: BoxFilter,
    by: BoxOrder = USUAL,
) -> tuple[RankedBox, ...]:
    """Return the wanted gearboxes in order, without repetitions.

    Gearboxes are ordered by the requested figures, then by error (0 within the tolerance), mean
    loss, largest torque, number of clutches, planet speed and code. Families and cores are numbered
    in this order.

    Parameters
    ----------
    search : BoxSearch
    boxes : iterable of MeasuredBox
        Found gearboxes with figures, in any order.
    wanted : BoxFilter
        Conditions on the gearboxes.
    by : BoxOrder
        Figures to order by; by default the usual order.

    Raises
    ------
    CaseError
        If the name of a figure is unknown.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.box import HELD, FoundBox
    >>> from vstatics.synthesis.boxes.figures.measured import measured
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> scheme, search = SetScheme.of_code("0-1-2"), BoxSearch(1, 2, 1, (3.0, 1.0))
    >>> boxes = [
    ...     FoundBox(scheme, None, 0, 1, ((2, HELD), clutch), (-2.0,), ((0,), (1,)), 0.0)
    ...     for clutch in [(1, 2), (0, 2), (0, 1)]
    ... ]
    >>> found = ranked(search, [measured(search, box, 0.98) for box in boxes], BoxFilter())
    >>> [(one.found.box.elements[1], one.family, one.core, one.pareto) for one in found]
    [((0, 1), 1, 1, True), ((0, 2), 1, 1, True), ((1, 2), 1, 1, True)]
    """
    by.check()
    possible = (box for box in boxes if box.figures.error < math.inf)
    # Of gearboxes that are equal up to renaming, the one with the smallest error remains.
    by_identity: dict[tuple[Any, ...], MeasuredBox] = {}
    for box in filter(wanted.lets, possible):
        key = identity(box.box)
        by_identity[key] = min(by_identity.get(key, box), box, key=_worth)
    chosen = list(by_identity.values())
    if not chosen:
        return ()
    figures = {name: np.array([box.figures.number(name) for box in chosen]) for name in FIGURES}
    ranks = {name: places(values) for name, values in figures.items()}
    errors = figures["error"]
    within = errors <= max(search.widths, default=search.tolerance) * (1 + SAME_RATIO)
    usual = ranks | {"error": places(np.where(within, 0.0, errors))}
    keys = [ranks[name].tolist() for name in by.sort] + [usual[name].tolist() for name in ORDER]
    names = [identity(box.box) for box in chosen]
    rows = [row for *_, row in sorted(zip(*keys, names, range(len(chosen)), strict=True))]
    ordered = [chosen[row] for row in rows]
    most = max(len(box.gears) for box in ordered)
    ratios = np.full((len(ordered), most), NO_RATIO)
    for row, box in zip(ratios, ordered, strict=True):
        row[: len(box.gears)] = [gear.ratio for gear in box.gears]
    family = families(ratios)
    cores = numbered(
        (number, core_of(chosen[row].box)) for number, row in zip(family, rows, strict=True)
    )
    best = pareto(np.array([ranks[name] for name in by.pareto]).T[rows]).tolist()
    return tuple(
        RankedBox(chosen[row], *place)
        for row, *place in zip(rows, family, cores, best, strict=True)
    )


def family_count(boxes: Iterable[RankedBox]) -> int:
    """Return the number of families among gearboxes."""
    return len({box.family for box in boxes})


def _worth(box: MeasuredBox) -> tuple[Any, ...]:
    """Return a sort key for equal gearboxes whose fitted ratios differ. The smallest is kept."""
    error, loss = (round(figure, FIGURE_DECIMALS) for figure in box.figures[:2])
    return error, loss, box.box.ratios


class BoxFilter(NamedTuple):
    """Conditions that a found gearbox must satisfy to be listed.

    Examples
    --------
    >>> BoxFilter(brakes=(2, 3), limits={"loss": 0.05})
    BoxFilter(single=False, planar=False, brakes=(2, 3), clutches=(), limits={'loss': 0.05})
    """

    single: bool = False
    """True if neighbouring gears must differ by exchange of a single shift element."""
    planar: bool = False
    brakes: tuple[int, ...] = ()
    """Permitted numbers of brakes; empty for any number."""
    clutches: tuple[int, ...] = ()
    limits: Mapping[str, float] = EMPTY
    """Upper limits of figures, by the names in `LIMITED`."""

    def narrowed(self, search: BoxSearch) -> BoxSearch:
        """Return a search that already excludes unwanted gearboxes, as far as possible.

        >>> BoxFilter(clutches=(1,)).narrowed(BoxSearch(1, 3, 1, (3.0, 1.0))).brake_counts
        (2,)
        """
        every = range(search.elements + 1)
        counts = tuple(
            number
            for number in every
            if self._allows(brakes=number, clutches=search.elements - number)
        )
        brake_counts = None if len(counts) == len(every) else counts
        return search._replace(brake_counts=brake_counts, singly=self.single)

    def before(self, box: FoundBox) -> bool:
        """Return whether the numbers of brakes and clutches are wanted. Figures are not yet known.

        >>> from vstatics.synthesis.boxes.box import HELD
        >>> from vstatics.synthesis.structures.scheme import SetScheme
        >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
        ...                ((1,), (0,)), 0.0)
        >>> BoxFilter(brakes=(1,)).before(box), BoxFilter(limits={"clutches": 0}).before(box)
        (True, False)
        """
        return self._allows(brakes=len(box.brakes), clutches=len(box.clutches))

    def _allows(self, *, brakes: int, clutches: int) -> bool:
        counts = ("brakes", brakes, self.brakes), ("clutches", clutches, self.clutches)
        return all(
            (not allowed or count in allowed) and count <= self.limits.get(name, math.inf)
            for name, count, allowed in counts
        )

    def lets(self, box: MeasuredBox) -> bool:
        """Return whether a gearbox with known figures is wanted."""
        figures = box.figures
        return (
            self.before(box.box)
            and figures.single >= self.single
            and figures.planar >= self.planar
            and not any(figures.number(name) > most for name, most in self.limits.items())
        )


ALL = BoxFilter()


class BoxList(NamedTuple):
    """Result of a search: the wanted gearboxes in order."""

    searched: int
    """Number of examined gearboxes."""
    boxes: tuple[RankedBox, ...]
    """Wanted gearboxes in order."""
    given_up: int
    """Number of sets of shift elements that were not examined completely, but could give gearboxes.
    """

    def __repr__(self) -> str:
        """Return the numbers of found and examined gearboxes."""
        return f"<BoxList: {len(self.boxes)} found, {self.searched} searched>"

    def _repr_html_(self) -> str:
        """Return the numbers of gearboxes, the Pareto list and the families, for a notebook."""
        return shown(higher("box_grids")(*self))


@refusing()
def find_boxes(
    search: BoxSearch,
    efficiency: float = EFFICIENCY,
    wanted: BoxFilter = ALL,
    by: BoxOrder = USUAL,
    weights: Mapping[str, float] = ALIKE,
) -> BoxList:
    """Find all gearboxes whose gears have the wanted ratios, without worker processes.

    Parameters
    ----------
    search : BoxSearch
        Request: numbers of gear sets and shift elements, wanted ratios and tolerances.
    efficiency : float
        Basic efficiency of each gear set (carrier held), above 0 and up to 1. [-]
    wanted : BoxFilter
        Conditions on the listed gearboxes; by default all gearboxes are listed.
    by : BoxOrder
        Figures that order the gearboxes.
    weights : mapping of str to float
        Weights of forward gears in the mean drag, by the name of the gear; by default 1. [-]

    Returns
    -------
    BoxList
        Gearboxes in order, which a notebook shows as tables.

    Raises
    ------
    CaseError
        If the search cannot be carried out, or a package is missing.

    Examples
    --------
    A gear set with the ring held has the ratio 1 + p (p = ring teeth/sun teeth); locked up, it is a
    direct drive:

    >>> found = find_boxes(BoxSearch(1, 2, 1, (3.0, 1.0)))
    >>> found.searched, [list(one.found.elements) for one in found.boxes]
    (36, [['T-L2', 'F-L0-L1'], ['T-L2', 'F-L0-L2'], ['T-L2', 'F-L1-L2']])
    """
    require("boxes", "the search for gearboxes")
    # This import starts the compilation.
    from vstatics.synthesis.boxes.batches.found import found_in

    low, high = search.bounds
    search = search._replace(
        targets=tuple(search.targets), bounds=(low, high), tolerances=tuple(search.tolerances)
    )
    check_box_search(search)
    if not 0 < efficiency <= 1:
        raise CaseError(
            "E802", f"read {efficiency:g}, expected a number above 0, up to 1", ("efficiency",)
        )
    search = wanted.narrowed(search)
    piece = found_in(search)
    boxes = (measured(search, box, efficiency, weights) for box in piece.boxes)
    return BoxList(piece.searched, ranked(search, boxes, wanted, by), piece.given_up)
