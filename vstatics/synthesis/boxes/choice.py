"""Found boxes side by side: those wanted, their order, families, the Pareto list."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher, require
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.tables.html import shown
from vstatics.synthesis.boxes.box import EFFICIENCY, BoxSearch, FoundBox, check_box_search
from vstatics.synthesis.boxes.figures.by_box import FIGURES, USUAL, BoxOrder
from vstatics.synthesis.boxes.figures.measured import ALIKE, FIGURE_DECIMALS, MeasuredBox, measured
from vstatics.synthesis.boxes.grouping import core_of, families, numbered, pareto, places
from vstatics.synthesis.boxes.least_form import identity

NO_RATIO = 1e9
"""In place of a gear that a box has not. [-]"""
ORDER = ("error", "loss", "torque", "clutches", "planet_speed")
"""The figures by which boxes stand in order."""


class RankedBox(NamedTuple):
    """A found box in its place."""

    found: MeasuredBox
    family: int
    """A number from 1; boxes of one family have equal ratios in all gears."""
    core: int
    """A number from 1; boxes of one core differ, in one family, by their clutches alone."""
    pareto: bool
    """Whether no other is better in one figure of the Pareto list and not worse in the others."""


def ranked(
    search: BoxSearch,
    boxes: Iterable[MeasuredBox],
    wanted: BoxFilter,
    by: BoxOrder = USUAL,
) -> tuple[RankedBox, ...]:
    """The boxes that are wanted, each once, in their order.

    First by the figures that are asked for, then as usual: errors within the tolerance count as
    equal, then by mean loss, largest torque, number of clutches, planet speed and code. Families
    and cores are numbered as they come.

    Parameters
    ----------
    search : BoxSearch
    boxes : iterable of MeasuredBox
        In any order.
    wanted : BoxFilter
    by : BoxOrder
        As usual when not given.

    Raises
    ------
    CaseError
        If a figure is none.

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
    there = (box for box in boxes if box.figures.error < math.inf)
    chosen = list(_each_once(box for box in there if wanted.lets(box)))
    if not chosen:
        return ()
    figures = {name: np.array([box.figures.number(name) for box in chosen]) for name in FIGURES}
    own = {name: places(values) for name, values in figures.items()}
    errors = figures["error"]
    within = errors <= max(search.widths, default=search.tolerance) * (1 + SAME_RATIO)
    usual = own | {"error": places(np.where(within, 0.0, errors))}
    keys = [own[name].tolist() for name in by.sort] + [usual[name].tolist() for name in ORDER]
    names = [identity(box.box) for box in chosen]
    rows = [row for *_, row in sorted(zip(*keys, names, range(len(chosen)), strict=True))]
    family = families(_ratios([chosen[row] for row in rows]))
    cores = numbered(
        (number, core_of(chosen[row].box)) for number, row in zip(family, rows, strict=True)
    )
    best = pareto(np.array([own[name] for name in by.pareto]).T[rows]).tolist()
    return tuple(
        RankedBox(chosen[row], *one) for row, *one in zip(rows, family, cores, best, strict=True)
    )


def family_count(boxes: Iterable[RankedBox]) -> int:
    """The number of families among boxes."""
    return len({box.family for box in boxes})


def _each_once(boxes: Iterable[MeasuredBox]) -> Iterable[MeasuredBox]:
    """Of those that are one up to renaming that with the least error."""
    best: dict[tuple[Any, ...], MeasuredBox] = {}
    for box in boxes:
        key = identity(box.box)
        best[key] = min(best.get(key, box), box, key=_worth)
    return best.values()


def _worth(box: MeasuredBox) -> tuple[Any, ...]:
    """By which one of several fits is taken; the ratios settle it, whoever came first."""
    error, loss = (round(one, FIGURE_DECIMALS) for one in box.figures[:2])
    return error, loss, box.box.ratios


def _ratios(boxes: Sequence[MeasuredBox]) -> Floats:
    """The ratios of all gears, (boxes, gears); where a box has fewer, what no gear has."""
    most = max(len(box.gears) for box in boxes)
    ratios = np.full((len(boxes), most), NO_RATIO)
    for row, box in zip(ratios, boxes, strict=True):
        row[: len(box.gears)] = [gear.ratio for gear in box.gears]
    return ratios


class BoxFilter(NamedTuple):
    """What a box has to be.

    Examples
    --------
    >>> BoxFilter(brakes=(2, 3), limits={"loss": 0.05})
    BoxFilter(single=False, planar=False, brakes=(2, 3), clutches=(), limits={'loss': 0.05})
    """

    single: bool = False
    """One element changes between neighbours."""
    planar: bool = False
    brakes: tuple[int, ...] = ()
    """It has one of these numbers of them; any when empty."""
    clutches: tuple[int, ...] = ()
    limits: Mapping[str, float] = MappingProxyType({})
    """The largest value of a figure, one of `LIMITED`."""

    def narrowed(self, search: BoxSearch) -> BoxSearch:
        """A search that leaves out what is not wanted as soon as that is known.

        >>> BoxFilter(clutches=(1,)).narrowed(BoxSearch(1, 3, 1, (3.0, 1.0))).brake_counts
        (2,)
        """
        every = range(search.elements + 1)
        counts = tuple(
            number
            for number in every
            if self._has_so_many(brakes=number, clutches=search.elements - number)
        )
        own = None if len(counts) == len(every) else counts
        return search._replace(brake_counts=own, singly=self.single)

    def before(self, box: FoundBox) -> bool:
        """Whether a box may be wanted, before its figures are known.

        >>> from vstatics.synthesis.boxes.box import HELD
        >>> from vstatics.synthesis.structures.scheme import SetScheme
        >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
        ...                ((1,), (0,)), 0.0)
        >>> BoxFilter(brakes=(1,)).before(box), BoxFilter(limits={"clutches": 0}).before(box)
        (True, False)
        """
        return self._has_so_many(brakes=len(box.brakes), clutches=len(box.clutches))

    def _has_so_many(self, *, brakes: int, clutches: int) -> bool:
        counts = ("brakes", brakes, self.brakes), ("clutches", clutches, self.clutches)
        return all(
            (not allowed or own in allowed) and own <= self.limits.get(name, math.inf)
            for name, own, allowed in counts
        )

    def lets(self, found: MeasuredBox) -> bool:
        """Whether a box with its figures is wanted."""
        figures = found.figures
        return (
            self.before(found.box)
            and figures.single >= self.single
            and figures.planar >= self.planar
            and not any(figures.number(name) > most for name, most in self.limits.items())
        )


ALL = BoxFilter()


class BoxList(NamedTuple):
    """What a search found."""

    searched: int
    """Boxes that were looked at."""
    boxes: tuple[RankedBox, ...]
    """Those that are wanted, in their order."""
    given_up: int
    """Sets of elements that may be boxes, too, but could not be looked at to the end."""

    def __repr__(self) -> str:
        """How many there are; not all their numbers."""
        return f"<BoxList: {len(self.boxes)} found, {self.searched} searched>"

    def _repr_html_(self) -> str:
        """How many there are, the Pareto list, the families, for a notebook."""
        return shown(higher("box_grids")(*self))


@refusing()
def find_boxes(
    search: BoxSearch,
    efficiency: float = EFFICIENCY,
    wanted: BoxFilter = ALL,
    by: BoxOrder = USUAL,
    weights: Mapping[str, float] = ALIKE,
) -> BoxList:
    """Find all gearboxes whose gears have wanted ratios, in this process.

    Parameters
    ----------
    search : BoxSearch
    efficiency : float
        Of each set with its carrier held, above 0 and up to 1. [-]
    wanted : BoxFilter
        All boxes when not given.
    by : BoxOrder
        By which figures they stand in order.
    weights : mapping of str to float
        Of forward gears in the mean of the drag, 1 of those that have none. [-]

    Returns
    -------
    BoxList
        The boxes in their order, which a notebook shows as tables.

    Raises
    ------
    CaseError
        If the search can't be, or the library that compiles it is missing.

    Examples
    --------
    A set with its ring held makes 1 + p, and direct drive when it is locked in any way:

    >>> found = find_boxes(BoxSearch(1, 2, 1, (3.0, 1.0)))
    >>> found.searched, [list(one.found.elements) for one in found.boxes]
    (36, [['T-L2', 'F-L0-L1'], ['T-L2', 'F-L0-L2'], ['T-L2', 'F-L1-L2']])
    """
    require("boxes", "the search for gearboxes")
    from vstatics.synthesis.boxes.batches.found import found_in  # compiles

    low, high = search.bounds
    search = search._replace(
        targets=tuple(search.targets), bounds=(low, high), tolerances=tuple(search.tolerances)
    )
    check_box_search(search)
    if not 0 < efficiency <= 1:
        message = f"read {efficiency:g}, expected a number above 0, up to 1"
        raise CaseError("E802", message, ("efficiency",))
    search = wanted.narrowed(search)
    found = found_in(search)
    boxes = (measured(search, box, efficiency, weights) for box in found.boxes)
    return BoxList(found.searched, ranked(search, boxes, wanted, by), found.given_up)
