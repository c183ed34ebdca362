"""Found boxes side by side: those wanted, their order, families, the Pareto list."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from vstatics.errors import CaseError
from vstatics.extras import require
from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.tolerances import SAME_RATIO
from vstatics.synthesis.boxes.box import (
    EFFICIENCY,
    BoxFigures,
    BoxSearch,
    FoundBox,
    check_box_search,
)
from vstatics.synthesis.boxes.figures import FIGURE_DECIMALS, MeasuredBox, measured
from vstatics.synthesis.boxes.least_form import identity
from vstatics.synthesis.tolerances import EQUAL_FIGURES, SAME_FITTED_RATIO

NO_RATIO = 1e9
"""In place of a gear that a box has not. [-]"""
NUMBERS = BoxFigures._fields.index("single")
"""So many figures are numbers."""
ORDER = ("error", "loss", "torque", "clutches", "planet_speed")
"""The figures by which boxes stand in order."""
PARETO = ("loss", "planet_speed", "torque", "clutches")
"""The figures of the Pareto list."""


class RankedBox(NamedTuple):
    """A found box in its place."""

    found: MeasuredBox
    family: int
    """A number from 1; boxes of one family have equal ratios in all gears."""
    pareto: bool
    """Whether no other is better in one of `PARETO` and not worse in the others."""


def ranked(
    search: BoxSearch, boxes: Iterable[MeasuredBox], wanted: BoxFilter
) -> tuple[RankedBox, ...]:
    """The boxes that are wanted, each once, in their order.

    Errors within the tolerance count as equal. Then by mean loss, largest torque, number of
    clutches, planet speed and code. Families are numbered as they come.

    Parameters
    ----------
    search : BoxSearch
    boxes : iterable of MeasuredBox
        In any order.
    wanted : BoxFilter

    Examples
    --------
    >>> from vstatics.synthesis.boxes.box import HELD, FoundBox
    >>> from vstatics.synthesis.boxes.figures import measured
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> scheme, search = SetScheme.of_code("0-1-2"), BoxSearch(1, 2, 1, (3.0, 1.0))
    >>> boxes = [
    ...     FoundBox(scheme, None, 0, 1, ((2, HELD), clutch), (-2.0,), ((0,), (1,)), 0.0)
    ...     for clutch in [(1, 2), (0, 2), (0, 1)]
    ... ]
    >>> found = ranked(search, [measured(search, box, 0.98) for box in boxes], BoxFilter())
    >>> [(one.found.box.elements[1], one.family, one.pareto) for one in found]
    [((0, 1), 1, True), ((0, 2), 1, True), ((1, 2), 1, True)]
    """
    there = (box for box in boxes if box.figures.error < math.inf)
    chosen = list(_each_once(box for box in there if wanted.lets(box)))
    if not chosen:
        return ()
    sizes = np.array([box.figures[:NUMBERS] for box in chosen], np.float64)
    within = sizes[:, 0] <= max(search.widths) * (1 + SAME_RATIO)
    sizes[within, 0] = 0.0
    places = dict(zip(BoxFigures._fields, map(_places, sizes.T), strict=False))
    keys = (places[name].tolist() for name in ORDER)
    names = [identity(box.box) for box in chosen]
    order = sorted(zip(*keys, names, range(len(chosen)), strict=True))
    rows = [row for *_, row in order]
    families = _families(_ratios([chosen[row] for row in rows]))
    best = pareto(np.array([places[name] for name in PARETO]).T[rows])
    return tuple(
        RankedBox(chosen[row], family, is_best)
        for row, family, is_best in zip(rows, families, best.tolist(), strict=True)
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


def _places(values: Floats) -> Integers:
    """The place of each value among those that differ; one that does not exist is 0."""
    known = np.nan_to_num(values)
    order = np.argsort(known, kind="stable")
    gaps = np.diff(known[order]) > EQUAL_FIGURES * (1 + np.abs(known[order][:-1]))
    places = np.empty(len(values), np.int64)
    places[order] = np.concatenate([[0], np.cumsum(gaps)])
    return places


def _ratios(boxes: Sequence[MeasuredBox]) -> Floats:
    """The ratios of all gears, (boxes, gears); where a box has fewer, what no gear has."""
    most = max(len(box.gears) for box in boxes)
    ratios = np.full((len(boxes), most), NO_RATIO)
    for row, box in zip(ratios, boxes, strict=True):
        row[: len(box.gears)] = [gear.ratio for gear in box.gears]
    return ratios


def _families(ratios: Floats) -> list[int]:
    """The family of each row of ratios, (boxes, gears), numbered as they come."""
    groups = [np.arange(len(ratios))]
    sizes = np.log(np.abs(ratios))
    before = 0
    while len(groups) > before:  # a box that goes may have filled a gap between others
        before = len(groups)
        for gear in sizes.T:
            groups = [part for group in groups for part in _parted(group, gear)]
    family = np.empty(len(ratios), np.intp)
    for number, group in enumerate(sorted(groups, key=min), 1):
        family[group] = number
    return family.tolist()


def _parted(group: Any, sizes: Floats) -> list[Any]:
    """A group of boxes, parted where the sizes of a gear have a gap."""
    if len(group) == 1:
        return [group]
    ordered = group[np.argsort(sizes[group], kind="stable")]
    gaps = np.flatnonzero(np.diff(sizes[ordered]) > SAME_FITTED_RATIO) + 1
    return np.split(ordered, gaps)


def pareto(figures: Floats | Integers) -> Booleans:
    """Which rows no other row is better than in one column, and not worse in any.

    Parameters
    ----------
    figures : ndarray, shape (boxes, figures)
        The less the better.

    Returns
    -------
    ndarray, shape (boxes,)

    Examples
    --------
    >>> pareto(np.array([[1.0, 3.0], [2.0, 2.0], [2.0, 3.0], [2.0, 2.0], [3.0, 1.0]]))
    array([ True,  True, False,  True,  True])
    """
    rows, which = np.unique(figures, axis=0, return_inverse=True)  # the less stand first
    is_best = np.zeros(len(rows), np.bool_)
    front = np.empty_like(rows)
    size = 0
    for number, own in enumerate(rows):  # whoever is better than a row stands before it
        if not (front[:size] <= own).all(axis=1).any():
            is_best[number] = True
            front[size] = own
            size += 1
    return np.asarray(is_best[which.reshape(-1)])


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
            and not any(getattr(figures, name) > most for name, most in self.limits.items())
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


def find_boxes(
    search: BoxSearch, efficiency: float = EFFICIENCY, wanted: BoxFilter = ALL
) -> BoxList:
    """Find all gearboxes whose gears have wanted ratios, in this process.

    Parameters
    ----------
    search : BoxSearch
    efficiency : float
        Of each set with its carrier held, above 0 and up to 1. [-]
    wanted : BoxFilter
        All boxes when not given.

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
    from vstatics.synthesis.boxes.search.pieces import cut, found_in  # compiles

    low, high = search.bounds
    search = search._replace(
        targets=tuple(search.targets), bounds=(low, high), tolerances=tuple(search.tolerances)
    )
    check_box_search(search)
    if not 0 < efficiency <= 1:
        message = f"read {efficiency:g}, expected a number above 0, up to 1"
        raise CaseError("E802", message, ("efficiency",))
    search = wanted.narrowed(search)
    pieces = [found_in(search, piece) for piece in range(cut(search))]
    boxes = (measured(search, box, efficiency) for piece in pieces for box in piece.boxes)
    searched = sum(piece.searched for piece in pieces)
    given_up = sum(piece.given_up for piece in pieces)
    return BoxList(searched, ranked(search, boxes, wanted), given_up)
