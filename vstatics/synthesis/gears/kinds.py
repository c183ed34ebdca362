"""What sets of engaged elements do with input and output: for many sets at once, and for one.

The rows of many systems are eliminated as `numerics.elimination` does it with those of one:
each value carries the size that tells when a difference is nothing but rounding, so rank needs
no tolerance that somebody has to choose.

It takes longer than `engaged_kinds`, but eliminates what is engaged together with the
mechanisms, in the order that loses least: for sets in which that may lose too many digits.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import IntEnum
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.core.model.transmission import HOUSING, ShiftElement, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.elimination import RIGHT, Equation, solve
from vstatics.core.numerics.tolerances import TRACED_REAL, ZERO
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.matrix import ON_ELEMENT, columns
from vstatics.core.tables.answer import Sometimes
from vstatics.core.tables.grid import Cell, Column, Grid, exact, grid_of, sign, words
from vstatics.synthesis.gears.speed_forms import Pair, SpeedForms
from vstatics.synthesis.tolerances import DETERMINED, KEPT_PART, MET_RATIO, NO_TORQUE

Indices = NDArray[np.intp]


class EngagedKind(IntEnum):
    """What a combination does, by all speeds of input and output that the equations allow."""

    BLOCKED = 0
    """The input can't turn."""
    PARKING = 1
    """The output stands, the input turns."""
    NEUTRAL = 2
    """Input and output turn independently of each other."""
    GEAR = 3
    """One ratio."""
    DIRECT = 4
    """The ratio 1, whatever the ratios of the mechanisms are."""

    @property
    def word(self) -> str:
        """As it is written."""
        return self.name.lower()


class EngagedKinds(NamedTuple):
    """What each set of elements does."""

    kinds: NDArray[np.int8]
    """(sets,), numbers of `EngagedKind`; a direct drive is not told from another gear."""
    ratios: Floats
    """(sets,), input speed by output speed; NaN where there is none. [-]"""
    free: Booleans
    """(sets,), whether links can turn while input and output stand."""
    unity: Booleans
    """(sets,), whether input and output turn alike, or both stand."""
    doubtful: Booleans
    """(sets,), whether too many digits are lost to believe this."""


@np.errstate(all="ignore")  # what overflows is doubtful
def engaged_kinds(forms: SpeedForms, members: Indices) -> EngagedKinds:
    """What sets of engaged elements do.

    Parameters
    ----------
    forms : SpeedForms
        The slips of all elements, then the speeds of input and output, then their difference.
    members : ndarray, shape (sets, elements)
        Which elements each set engages.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.gears.speed_forms import FreeSpeeds
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> forms = FreeSpeeds(case).forms([(2, 0), (2, 1), (1, 0), (3, 0), (1, 3)])
    >>> found = engaged_kinds(forms, np.array([[0], [1]]))
    >>> found.ratios.round(9), found.unity
    (array([3.5, 1. ]), array([False,  True]))
    """
    sets, engaged = members.shape
    ports = np.broadcast_to(np.arange(-3, 0), (sets, 3))
    chosen = np.concatenate([members, ports], axis=1).T
    rows = _SizedRows(forms, chosen)
    rank = np.zeros(sets, dtype=int)
    for row in range(engaged):
        rank += rows.eliminate(row, slice(row + 1, None))[0]
    of_input, of_output, of_difference = range(engaged, engaged + 3)
    unity = ~rows.left(of_difference)
    output_turns = rows.left(of_output)
    input_turns, [by_input] = rows.eliminate(of_input, slice(of_output, of_output + 1))
    apart = rows.left(of_output)
    kinds = np.select(
        [~input_turns, ~output_turns, apart],
        [EngagedKind.BLOCKED, EngagedKind.PARKING, EngagedKind.NEUTRAL],
        EngagedKind.GEAR,
    )
    ratios = np.where(kinds == EngagedKind.GEAR, 1 / by_input, np.nan)
    moving = rank + input_turns + apart
    free = moving < forms.free
    return EngagedKinds(kinds.astype(np.int8), ratios, free, unity, rows.doubtful)


class _SizedRows:
    """Rows of many systems, (rows, unknowns, systems), which are eliminated in place."""

    def __init__(self, forms: SpeedForms, chosen: Indices) -> None:
        """Take of all rows those of `chosen`, (rows, systems)."""
        self.values = np.ascontiguousarray(np.moveaxis(forms.values[chosen], 2, 1))
        self.sizes = np.ascontiguousarray(np.moveaxis(forms.sizes[chosen], 2, 1))
        self.systems = np.arange(chosen.shape[1])
        self.doubtful: Booleans = np.full(chosen.shape[1], forms.doubtful)

    def left(self, row: int) -> Booleans:
        """In which systems anything is left of a row."""
        turns: Booleans = self.values[row].any(axis=0)
        return turns

    def eliminate(self, row: int, others: slice) -> tuple[Booleans, Floats]:
        """Take a row from others, so that these lose its largest entry.

        Returns
        -------
        there : ndarray, shape (systems,)
            Whether anything is left of the row.
        factors : ndarray, shape (others, systems)
            How much of it was taken.
        """
        mine, its_size = self.values[row], self.sizes[row]
        if not len(mine):
            taken = np.zeros((len(self.values[others]), len(self.systems)))
            return np.zeros(len(self.systems), bool), taken
        place = abs(mine).argmax(axis=0), self.systems
        pivot = mine[place]
        there: Booleans = pivot != 0
        divisor = np.where(there, pivot, 1.0)
        factors = np.where(there, self.values[others][:, *place] / divisor, 0.0)
        of_factors = self.sizes[others][:, *place] + abs(factors) * its_size[place]
        of_factors = np.where(there, of_factors / abs(divisor), 0.0)
        # `less` of the entries of `numerics`, on arrays
        values, sizes = self.values[others], self.sizes[others]
        products = factors[:, None] * mine
        sizes += of_factors[:, None] * abs(mine) + abs(factors[:, None]) * its_size
        larger = TRACED_REAL * np.maximum(abs(values), abs(products))
        known = (sizes * (KEPT_PART * TRACED_REAL) <= larger) & (sizes < np.inf)
        lost = ~known & (larger != 0)
        self.doubtful |= lost.any(axis=(0, 1))
        values -= products
        rounding = np.minimum(ZERO * sizes, larger)
        values[(abs(values) <= rounding) & (rounding < np.inf)] = 0.0
        values[:, *(one[there] for one in place)] = 0.0
        return there, factors


class KindAlone(NamedTuple):
    """What a set of elements does; a direct drive is not told from another gear."""

    kind: EngagedKind
    ratio: float
    """NaN where there is none. [-]"""
    free: bool


def kind_alone(case: Transmission, engaged: Iterable[Pair]) -> KindAlone:
    """What a set of elements does, each given by the links that it joins.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> kind_alone(case, [(2, 0)]).ratio, kind_alone(case, [(1, 0)]).kind.word
    (3.5, 'blocked')
    """
    own = columns(case, [one.ratio for one in case.mechanisms])[len(case.shift_elements) :]
    rows: list[Equation] = [{link - 1: part for link, part in column.items()} for column in own]
    for pair in engaged:
        joined = zip(pair, ON_ELEMENT, strict=True)
        rows.append({link - 1: float(part) for link, part in joined if link != HOUSING})
    of_input, of_output = case.input - 1, case.output - 1
    turned = solve([*rows, {of_input: 1.0, RIGHT: 1.0}], case.links)
    if not turned.consistent:
        still: list[Equation] = [*rows, {of_input: 1.0}]
        output_turns = solve([*still, {of_output: 1.0, RIGHT: 1.0}], case.links).consistent
        missing = solve(still, case.links).missing
        return KindAlone(EngagedKind.BLOCKED, math.nan, missing > output_turns)
    speed = float(plain(turned.values[of_output]))
    if math.isnan(speed):
        return KindAlone(EngagedKind.NEUTRAL, math.nan, turned.missing > 1)
    free = turned.missing > 0
    if speed == 0:
        return KindAlone(EngagedKind.PARKING, math.nan, free)
    return KindAlone(EngagedKind.GEAR, 1 / speed, free)


@np.errstate(all="ignore")  # what overflows misses its ratio
def element_torques(forms: SpeedForms, members: Indices, ratios: Floats) -> Floats:
    """What the first link of each engaged element gives to it, shape (sets, elements) [-].

    In each motion that the mechanisms allow the power of the input goes to the elements and to the
    output: ``w_in = sum M_e (w_first - w_second) + M_out w_out`` for all free speeds, by torques
    over that of the input. So the rows of speeds that tell a gear's ratio tell its torques, too.

    NaN where several elements share what only their sum has, and where so many digits are lost
    that the torque of the output misses the ratio. Of a direct drive by one element the
    torque is ``1/slip`` by its slip while the output stands and nothing is engaged (Voloshko,
    Salakhov and others, (17) to (19)): then no other power is left.

    Parameters
    ----------
    forms : SpeedForms
        As of `engaged_kinds`.
    members : ndarray, shape (sets, elements)
        Sets that have a ratio.
    ratios : ndarray, shape (sets,)
        Theirs. [-]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.gears.speed_forms import FreeSpeeds
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> forms = FreeSpeeds(case).forms([(2, 0), (2, 1), (1, 0), (3, 0), (1, 3)])
    >>> element_torques(forms, np.array([[0], [1]]), np.array([3.5, 1])).round(9)
    array([[-2.5       ],
           [-0.71428571]])
    """
    output = np.full((len(members), 1), len(forms.values) - 2)
    chosen = np.concatenate([members, output], axis=1)
    values = np.nan_to_num(forms.values, posinf=0.0, neginf=0.0)
    rows = values[chosen]
    large = abs(rows).max(axis=2, keepdims=True, initial=0.0)
    sizes = np.where(large > 0, large, 1.0)
    inverse = np.linalg.pinv(np.swapaxes(rows / sizes, 1, 2), rcond=DETERMINED)
    torques = inverse @ values[-3] / sizes[..., 0]
    own = np.einsum("sef,sef->se", inverse, rows / sizes)
    torques = np.where(abs(torques) > NO_TORQUE, torques, 0.0)
    met = abs(torques[:, -1] - ratios) <= MET_RATIO * abs(ratios)
    known: Floats = np.where((own > 1 - DETERMINED) & met[:, None], torques, np.nan)
    return known[:, :-1]


class EngagedSet(NamedTuple):
    """A combination of shift elements, and what it does."""

    engaged: Sequence[str]
    """Their names; a freewheel among them holds."""
    kind: Annotated[str, tuple(one.word for one in EngagedKind)]
    """The word of an `EngagedKind`."""
    ratio: float
    """Input speed by output speed; NaN but for `gear` and `direct`. [-]"""
    free: bool
    """Whether a link besides input and output is left undetermined."""
    torques: Sometimes[Mapping[str, float]] = None
    """Of `gear` and `direct`: what the first link of each element gives to it, without losses,
    over the torque of the input; NaN where nothing tells how elements share it. [-]"""
    slip: Sometimes[float] = None
    """Of `direct` by one element: its slip while the output stands and nothing is engaged, over
    the speed of the input; NaN where that is not determined. [-]"""

    @property
    def by_torque(self) -> tuple[int, float]:
        """Sort key: direct drives, gears, others, each by the largest torque of an element."""
        largest = max(map(abs, (self.torques or {}).values()), default=math.inf)
        return -EngagedKind[self.kind.upper()], math.inf if math.isnan(largest) else largest


class EngagedSetList(NamedTuple):
    """All combinations."""

    combinations: Sequence[EngagedSet]


class EngagedSetsOfPorts(NamedTuple):
    """All combinations between two links."""

    input: str
    output: str
    combinations: Sequence[EngagedSet]


class EngagedSetsOfAllPorts(NamedTuple):
    """The same of several pairs of links."""

    ports: Sequence[EngagedSetsOfPorts]


class EngagedSets(NamedTuple):
    """Some combinations in their order, as arrays."""

    elements: Sequence[ShiftElement]
    """Those to choose from."""
    members: Indices
    """(sets, elements), indices of the engaged ones."""
    kinds: Indices
    """(sets,), numbers of `EngagedKind`."""
    ratios: Floats
    """(sets,), NaN where there is none. [-]"""
    free: Booleans
    """(sets,)"""
    torques: Floats
    """(sets, elements), NaN where there is none. [-]"""

    def each(self) -> Iterator[EngagedSet]:
        """One by one."""
        names = [element.name for element in self.elements]
        words = [kind.word for kind in EngagedKind]
        columns = (column.tolist() for column in self[1:])
        for members, kind, ratio, free, torques in zip(*columns, strict=True):
            engaged = [names[one] for one in members]
            known = dict(zip(engaged, torques, strict=True)) if kind >= EngagedKind.GEAR else None
            alone = kind == EngagedKind.DIRECT and len(engaged) == 1
            slip = 1 / (torques[0] or math.nan) if alone else None
            yield EngagedSet(engaged, words[kind], ratio, free, known, slip)

    def where(self, chosen: Booleans) -> EngagedSets:
        """Some of them."""
        return EngagedSets._make((self.elements, *(column[chosen] for column in self[1:])))

    @property
    def gears(self) -> Booleans:
        """(sets,), which have a ratio."""
        return self.kinds >= EngagedKind.GEAR


def combination_grids(found: Iterable[EngagedSet]) -> Iterator[Grid]:
    """A row for each combination; then how many there are of each kind.

    Examples
    --------
    >>> found = [EngagedSet(["F1", "T3"], "gear", 3.2, False)]
    >>> [grid.texts for grid in combination_grids(found)]
    [[['F1, T3', 'gear', '3.200', '·', '-', '-']], [['gear', '1']]]
    """
    kinds: Counter[str] = Counter()
    rows = []
    for one in found:
        kinds[one.kind] += 1
        torques = _torque_cell([*(one.torques or {}).values()])
        rows.append((one.engaged, one.kind, one.ratio, sign(one.free), torques, one.slip))
    headings = "engaged", "kind", "ratio", Column("free", is_sign=True), "torques", "slip"
    yield grid_of("Combinations", headings, rows, key="combinations")
    named = (kind.word for kind in reversed(EngagedKind))
    counts = ((kind, kinds[kind]) for kind in named if kinds[kind])
    yield grid_of("Kinds", ["kind", "combinations"], counts, key="kinds")


def _torque_cell(torques: Sequence[float]) -> Cell:
    """Return a cell with the torques of the engaged elements in their order.

    >>> _torque_cell([-2.5]).datum, _torque_cell([-2.5, 1 / 3]).text
    (-2.5, '-2.500, .333')
    >>> _torque_cell([-2.5, 1 / 3]).datum
    '-2.5, 0.3333333333333333'
    """
    if len(torques) < 2:
        return exact(torques[0] if torques else None)
    cells = [exact(torque) for torque in torques]
    digits = ("" if math.isnan(torque) else repr(torque) for torque in torques)
    return Cell(words([cell.text for cell in cells]), written_as=", ".join(digits))
