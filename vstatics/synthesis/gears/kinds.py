"""Effect of engaged shift elements on input and output: blocked, parking, neutral or a ratio.

`engaged_kinds` evaluates many sets of elements at once, by elimination as in
`numerics.elimination`. The size of a value, which is stored with it, shows when a difference is
only rounding noise, so the rank needs no chosen tolerance.

`kind_alone` evaluates one set and takes longer. It eliminates elements and mechanisms together, in
the order that loses the fewest digits, and is used where `engaged_kinds` can lose too many.
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
    """Effect of a combination on the possible speeds of input and output."""

    BLOCKED = 0
    """Input that cannot turn."""
    PARKING = 1
    """Output at rest while the input turns."""
    NEUTRAL = 2
    """Input and output that turn independently."""
    GEAR = 3
    """Fixed ratio."""
    DIRECT = 4
    """Ratio 1 for any ratios of the mechanisms."""

    @property
    def word(self) -> str:
        """Name in lower case, as printed."""
        return self.name.lower()


class EngagedKinds(NamedTuple):
    """Effect of each set of elements; arrays of shape (sets,)."""

    kinds: NDArray[np.int8]
    """Numbers of `EngagedKind`; direct drives count as `GEAR`."""
    ratios: Floats
    """Input speed divided by output speed; NaN without a ratio. [-]"""
    free: Booleans
    """True if links can turn while input and output are at rest."""
    unity: Booleans
    """True if input and output turn at equal speeds, or both are at rest."""
    doubtful: Booleans
    """True if too many digits were lost to trust the result."""


@np.errstate(all="ignore")  # overflows are marked as doubtful
def engaged_kinds(forms: SpeedForms, members: Indices) -> EngagedKinds:
    """Determine the effect of sets of engaged elements.

    Parameters
    ----------
    forms : SpeedForms
        Slips of all elements, then speeds of input and output, then their difference.
    members : ndarray, shape (sets, elements)
        Elements that each set engages.

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
    rows = _SizedRows(forms, np.concatenate([members, ports], axis=1).T)
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
    """Rows of many systems, shape (rows, unknowns, systems), eliminated in place."""

    def __init__(self, forms: SpeedForms, chosen: Indices) -> None:
        """Select the rows `chosen`, shape (rows, systems), of each system."""
        self.values = np.ascontiguousarray(np.moveaxis(forms.values[chosen], 2, 1))
        self.sizes = np.ascontiguousarray(np.moveaxis(forms.sizes[chosen], 2, 1))
        self.systems = np.arange(chosen.shape[1])
        self.doubtful = np.full(chosen.shape[1], forms.doubtful)

    def left(self, row: int) -> Booleans:
        """Return the systems in which a row is not zero."""
        turns: Booleans = self.values[row].any(axis=0)
        return turns

    def eliminate(self, row: int, others: slice) -> tuple[Booleans, Floats]:
        """Subtract a row from further rows to clear the column of the largest entry.

        Returns
        -------
        there : ndarray, shape (systems,)
            True if the row is not zero.
        factors : ndarray, shape (others, systems)
            Multiples of the row that were subtracted.
        """
        mine, its_size = self.values[row], self.sizes[row]
        if not len(mine):
            taken = np.zeros((len(self.values[others]), len(self.systems)))
            return np.zeros(len(self.systems), bool), taken
        place = abs(mine).argmax(axis=0), self.systems
        pivot = mine[place]
        there = pivot != 0
        divisor = np.where(there, pivot, 1.0)
        factors = np.where(there, self.values[others][:, *place] / divisor, 0.0)
        of_factors = self.sizes[others][:, *place] + abs(factors) * its_size[place]
        of_factors = np.where(there, of_factors / abs(divisor), 0.0)
        # The same rule as `less` of the entries of `numerics`, on arrays.
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
        values[:, *(index[there] for index in place)] = 0.0
        return there, factors


class KindAlone(NamedTuple):
    """Effect of a set of elements; direct drives count as `GEAR`."""

    kind: EngagedKind
    ratio: float
    """Input speed divided by output speed; NaN without a ratio. [-]"""
    free: bool


def kind_alone(case: Transmission, engaged: Iterable[Pair]) -> KindAlone:
    """Determine the effect of a set of elements, each given by two links.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> kind_alone(case, [(2, 0)]).ratio, kind_alone(case, [(1, 0)]).kind.word
    (3.5, 'blocked')
    """
    ratios = [mechanism.ratio for mechanism in case.mechanisms]
    fixed = columns(case, ratios)[len(case.shift_elements) :]
    rows: list[Equation] = [{link - 1: part for link, part in column.items()} for column in fixed]
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


@np.errstate(all="ignore")  # after an overflow, torques are NaN
def element_torques(forms: SpeedForms, members: Indices, ratios: Floats) -> Floats:
    """Return the torque that the first link gives to each element, shape (sets, elements) [-].

    Torques are relative to the input torque. In each motion that the mechanisms allow, the input
    power goes to the elements and the output: ``w_in = sum M_e (w_first - w_second) + M_out w_out``
    for all free speeds. The rows of speeds that give the ratio of a gear therefore give its
    torques.

    A torque is NaN if only the sum over several elements is determined, or if so many digits are
    lost that the output torque misses the ratio. In a direct drive by a single element its torque
    is ``1/slip``, with the slip while the output is at rest and no element is engaged (Voloshko,
    Salakhov and others, eqs. 17 to 19).

    Parameters
    ----------
    forms : SpeedForms
        As for `engaged_kinds`.
    members : ndarray, shape (sets, elements)
        Elements of sets with a ratio.
    ratios : ndarray, shape (sets,)
        Ratio of each set. [-]

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
    share = np.einsum("sef,sef->se", inverse, rows / sizes)
    torques = np.where(abs(torques) > NO_TORQUE, torques, 0.0)
    met = abs(torques[:, -1] - ratios) <= MET_RATIO * abs(ratios)
    known = np.where((share > 1 - DETERMINED) & met[:, None], torques, np.nan)
    return known[:, :-1]


class EngagedSet(NamedTuple):
    """Combination of shift elements with the effect on input and output."""

    engaged: Sequence[str]
    """Names of the elements, including freewheels that hold."""
    kind: Annotated[str, tuple(kind.word for kind in EngagedKind)]
    """Word of an `EngagedKind`."""
    ratio: float
    """Input speed divided by output speed; NaN except for `gear` and `direct`. [-]"""
    free: bool
    """True if a link other than input and output is undetermined."""
    torques: Sometimes[Mapping[str, float]] = None
    """Lossless torque that the first link gives to each element, relative to the input torque, for
    `gear` and `direct`; NaN where the torque split is indeterminate. [-]"""
    slip: Sometimes[float] = None
    """Slip of a single element of `direct` while the output is at rest and no element is engaged,
    relative to the input speed; NaN if undetermined. [-]"""

    @property
    def by_torque(self) -> tuple[int, float]:
        """Sort key: direct drives, gears, then all else, each by the largest torque."""
        largest = max(map(abs, (self.torques or {}).values()), default=math.inf)
        return -EngagedKind[self.kind.upper()], math.inf if math.isnan(largest) else largest


class EngagedSetList(NamedTuple):
    """List of all combinations."""

    combinations: Sequence[EngagedSet]


class EngagedSetsOfPorts(NamedTuple):
    """List of all combinations between two links."""

    input: str
    output: str
    combinations: Sequence[EngagedSet]


class EngagedSetsOfAllPorts(NamedTuple):
    """Lists of all combinations for several pairs of links."""

    ports: Sequence[EngagedSetsOfPorts]


class EngagedSets(NamedTuple):
    """Combinations in order, as arrays."""

    elements: Sequence[ShiftElement]
    """Elements to choose from."""
    members: Indices
    """Indices of the engaged elements, shape (sets, elements)."""
    kinds: Indices
    """Numbers of `EngagedKind`, shape (sets,)."""
    ratios: Floats
    """Input speed divided by output speed, NaN without a ratio, shape (sets,). [-]"""
    free: Booleans
    """True if a further link is undetermined, shape (sets,)."""
    torques: Floats
    """Torques of the elements, NaN without a ratio, shape (sets, elements). [-]"""

    def each(self) -> Iterator[EngagedSet]:
        """Yield the combinations as records."""
        names = [element.name for element in self.elements]
        words = [kind.word for kind in EngagedKind]
        columns = (column.tolist() for column in self[1:])
        for members, kind, ratio, free, torques in zip(*columns, strict=True):
            engaged = [names[index] for index in members]
            known = dict(zip(engaged, torques, strict=True)) if kind >= EngagedKind.GEAR else None
            alone = kind == EngagedKind.DIRECT and len(engaged) == 1
            slip = 1 / (torques[0] or math.nan) if alone else None
            yield EngagedSet(engaged, words[kind], ratio, free, known, slip)

    def where(self, chosen: Booleans) -> EngagedSets:
        """Return a selection of the combinations."""
        return EngagedSets._make((self.elements, *(column[chosen] for column in self[1:])))

    @property
    def gears(self) -> Booleans:
        """True for combinations with a ratio, shape (sets,)."""
        return self.kinds >= EngagedKind.GEAR


def combination_grids(sets: Iterable[EngagedSet]) -> Iterator[Grid]:
    """Yield a table with a row for each combination, and a table of the numbers of each kind.

    Examples
    --------
    >>> found = [EngagedSet(["F1", "T3"], "gear", 3.2, False)]
    >>> [grid.texts for grid in combination_grids(found)]
    [[['F1, T3', 'gear', '3.200', '·', '-', '-']], [['gear', '1']]]
    """
    kinds: Counter[str] = Counter()
    rows = []
    for combination in sets:
        kinds[combination.kind] += 1
        torques = _torque_cell([*(combination.torques or {}).values()])
        rows.append(
            (
                combination.engaged,
                combination.kind,
                combination.ratio,
                sign(combination.free),
                torques,
                combination.slip,
            )
        )
    yield grid_of(
        "Combinations",
        ("engaged", "kind", "ratio", Column("free", is_sign=True), "torques", "slip"),
        rows,
        key="combinations",
    )
    named = (kind.word for kind in reversed(EngagedKind))
    counts = ((kind, kinds[kind]) for kind in named if kinds[kind])
    yield grid_of("Kinds", ["kind", "combinations"], counts, key="kinds")


def _torque_cell(torques: Sequence[float]) -> Cell:
    """Return a cell with the torques of the engaged elements in their order.

    >>> _torque_cell([-2.5]).datum, _torque_cell([-2.5, 1 / 3]).text
    (-2.5, '-2.500, 0.333')
    >>> _torque_cell([-2.5, 1 / 3]).datum
    '-2.5, 0.3333333333333333'
    """
    if len(torques) < 2:
        return exact(torques[0] if torques else None)
    cells = [exact(torque) for torque in torques]
    digits = ("" if math.isnan(torque) else repr(torque) for torque in torques)
    return Cell(words([cell.text for cell in cells]), written_as=", ".join(digits))
