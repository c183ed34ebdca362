"""Effect of a combination of engaged shift elements: blocked, parking, neutral or a ratio.

`engaged_kinds` evaluates many combinations at once, by elimination as in `numerics.elimination`. A
magnitude that is stored with each value shows whether a difference is only rounding noise, so that
the rank does not depend on a chosen tolerance. `kind_alone` evaluates a single combination more
slowly. It eliminates shift elements and mechanisms together, in the order that loses the fewest
digits, where `engaged_kinds` can lose too many.
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
    """Effect of a combination of shift elements on the possible speeds of input and output."""

    BLOCKED = 0
    """The input cannot rotate."""
    PARKING = 1
    """The output is at rest while the input can rotate."""
    NEUTRAL = 2
    """Input and output rotate independently."""
    GEAR = 3
    """The ratio is fixed."""
    DIRECT = 4
    """The ratio is 1 for any ratios of the mechanisms."""

    @property
    def word(self) -> str:
        """Name of the effect in lower case, as printed."""
        return self.name.lower()


class EngagedKinds(NamedTuple):
    """Effects of many combinations of shift elements; arrays of shape (sets,)."""

    kinds: NDArray[np.int8]
    """Effects as numbers of `EngagedKind`. Direct drives count as `GEAR`."""
    ratios: Floats
    """Input speed divided by output speed; NaN without a ratio. [-]"""
    free: Booleans
    """True if links can rotate while input and output are at rest."""
    unity: Booleans
    """True if input and output rotate at equal speeds, or both are at rest."""
    doubtful: Booleans
    """True if too many digits were lost to rely on the result."""


@np.errstate(all="ignore")  # combinations with an overflow are marked as doubtful
def engaged_kinds(forms: SpeedForms, members: Indices) -> EngagedKinds:
    """Determine the effects of many combinations of engaged shift elements.

    Parameters
    ----------
    forms : SpeedForms
        Slip speeds of all shift elements, speeds of input and output, and their difference, in
        terms of the free speeds.
    members : ndarray, shape (sets, elements)
        Indices of the shift elements that each combination engages.

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
    """Rows of many linear systems, shape (rows, unknowns, systems), eliminated in place."""

    def __init__(self, forms: SpeedForms, chosen: Indices) -> None:
        """Select the rows `chosen`, shape (rows, systems), for each system."""
        self.values = np.ascontiguousarray(np.moveaxis(forms.values[chosen], 2, 1))
        self.sizes = np.ascontiguousarray(np.moveaxis(forms.sizes[chosen], 2, 1))
        self.systems = np.arange(chosen.shape[1])
        self.doubtful = np.full(chosen.shape[1], forms.doubtful)

    def left(self, row: int) -> Booleans:
        """Return a mask of the systems in which a row is not zero."""
        turns: Booleans = self.values[row].any(axis=0)
        return turns

    def eliminate(self, row: int, others: slice) -> tuple[Booleans, Floats]:
        """Subtract multiples of a row from further rows, to clear the column of the largest entry.

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
        # As in `numerics.elimination`, a difference that is only rounding noise becomes 0.
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
    """Effect of a single combination of shift elements. Direct drives count as `GEAR`."""

    kind: EngagedKind
    ratio: float
    """Input speed divided by output speed; NaN without a ratio. [-]"""
    free: bool


def kind_alone(case: Transmission, engaged: Iterable[Pair]) -> KindAlone:
    """Determine the effect of a combination of shift elements, each given by two links.

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


@np.errstate(all="ignore")  # an overflow gives torques that are NaN
def element_torques(forms: SpeedForms, members: Indices, ratios: Floats) -> Floats:
    """Return the torque of the first link on each shift element, shape (sets, elements) [-].

    Torques are relative to the input torque. In each motion that the mechanisms permit, the input
    power is transmitted to the shift elements and the output:
    ``w_in = sum M_e (w_first - w_second) + M_out w_out`` for all free speeds. Therefore the linear
    equations that give the ratio of a gear also give its torques.

    A torque is NaN if only the sum over several elements is determined, or if the loss of digits
    makes the output torque differ from the ratio. In a direct drive by a single shift element, the
    torque of this element is ``1/slip``. Here slip is its speed when it is released and the output
    is at rest (Voloshko, Salakhov and others, eqs. 17 to 19).

    Parameters
    ----------
    forms : SpeedForms
        Slip speeds and speeds, as for `engaged_kinds`.
    members : ndarray, shape (sets, elements)
        Indices of the shift elements of combinations with a ratio.
    ratios : ndarray, shape (sets,)
        Ratio of each combination. [-]

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
    """Combination of engaged shift elements, with the effect on input and output."""

    engaged: Sequence[str]
    """Names of the engaged shift elements, including holding freewheels."""
    kind: Annotated[str, tuple(kind.word for kind in EngagedKind)]
    """Effect as a word of `EngagedKind`."""
    ratio: float
    """Input speed divided by output speed; NaN except for the effects `gear` and `direct`. [-]"""
    free: bool
    """True if a link other than input and output is undetermined."""
    torques: Sometimes[Mapping[str, float]] = None
    """Torque of the first link on each shift element, without losses, relative to the input torque,
    for `gear` and `direct`; NaN where the torque split is indeterminate. [-]
    """
    slip: Sometimes[float] = None
    """Slip speed of the only shift element of `direct` when released with the output at rest,
    relative to the input speed; NaN if undetermined. [-]
    """

    @property
    def by_torque(self) -> tuple[int, float]:
        """Sort key: direct drives, gears, then other effects, each by the largest torque."""
        largest = max(map(abs, (self.torques or {}).values()), default=math.inf)
        return -EngagedKind[self.kind.upper()], math.inf if math.isnan(largest) else largest


class EngagedSetList(NamedTuple):
    """List of all combinations of a case, for JSON."""

    combinations: Sequence[EngagedSet]


class EngagedSetsOfPorts(NamedTuple):
    """List of all combinations with a given input and output link, for JSON."""

    input: str
    output: str
    combinations: Sequence[EngagedSet]


class EngagedSetsOfAllPorts(NamedTuple):
    """Lists of all combinations for several pairs of input and output link, for JSON."""

    ports: Sequence[EngagedSetsOfPorts]


class EngagedSets(NamedTuple):
    """Combinations of shift elements in order, as arrays."""

    elements: Sequence[ShiftElement]
    """Shift elements to choose from."""
    members: Indices
    """Indices of the engaged shift elements, shape (sets, elements)."""
    kinds: Indices
    """Effects as numbers of `EngagedKind`, shape (sets,)."""
    ratios: Floats
    """Input speed divided by output speed, shape (sets,); NaN without a ratio. [-]"""
    free: Booleans
    """True if a link other than input and output is undetermined, shape (sets,)."""
    torques: Floats
    """Torques of the shift elements relative to the input torque, shape (sets, elements). [-]

    NaN without a ratio.
    """

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
        """Return the combinations that a mask selects."""
        return EngagedSets._make((self.elements, *(column[chosen] for column in self[1:])))

    @property
    def gears(self) -> Booleans:
        """Mask of the combinations with a ratio, shape (sets,)."""
        return self.kinds >= EngagedKind.GEAR


def combination_grids(sets: Iterable[EngagedSet]) -> Iterator[Grid]:
    """Yield a table with a row for each combination, and a table with the count of each effect.

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
    """Return a table cell with the torques of the engaged shift elements in order.

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
