"""Formulas with shares of both sides of the jumps along which a motion slides.

On a jump, a formula has a mean of its values on both sides (Filippov). The share s of a jump is 1
above the jump and -1 below. The values of the whole formula above and below have the weights
(1 + s)/2 and (1 - s)/2, so ``sign(x)*sign(x)`` has the correct mean. While the motion slides, s has
the value that keeps the motion on the jump (Utkin's equivalent control).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName
from vstatics.simulation.scenario.algebra import (
    applied,
    bare,
    plus,
    slope,
    times,
    with_names,
)
from vstatics.simulation.scenario.corners import JUMPS
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import PI
from vstatics.simulation.scenario.table_call import TableCall

NOW = "present time"
"""Name of the time in `total_slope`, which no state can have."""
LEAVING = -1
"""Number instead of a share if the motion leaves a jump now, to the side `Slide.sign`."""


class JumpPlace(NamedTuple):
    """Place of a jump: two compared terms of a formula, and the link on which the formula acts."""

    first: Tree
    second: Tree
    rate: int = 0
    """Port of the link on which the formula acts."""
    angle: int = -1
    """Index of the angle of this link among the recorded angles, or -1."""

    @property
    def difference(self) -> Formula:
        """Difference of the compared terms."""
        return Formula("", applied("-", self.first, self.second))


class Slide(NamedTuple):
    """Jump along which the motion slides."""

    place: JumpPlace
    share: int
    """Number of the share, or `LEAVING`. Jumps at the same instants have the same share."""
    sign: float
    """1, or -1 if the compared terms are in the other order than in the first such jump."""
    near: float = 0.0
    """Distance from the jump at which `abs` of the difference is evaluated on both sides.

    With it, the motion can also stay where a torque such as ``-sign(x)*sqrt(abs(x))`` is continuous
    but infinitely steep.
    """


def share_name(number: int) -> str:
    """Return the name of a share in formulas, which no state can have."""
    return f"share {number}"


def shared(formula: Formula, slides: tuple[Slide, ...], rate: int = 0, angle: int = -1) -> Formula:
    """Return the mean of the values of a formula on both sides of `slides`, weighted by shares.

    Examples
    --------
    >>> relay = Formula("8*(slip('C') > 2)*(p < 3)")
    >>> place = JumpPlace(*map(bare, relay.whole.operands[0].operands[1].operands))
    >>> mean = shared(relay, (Slide(place, 0, 1.0),))
    >>> mean.seen[0], [mean.function(0.0, 0.0, 0.0, share, 2.0) for share in (-1.0, 0.0, 0.5)]
    (Seen(word='value', of='share 0'), [0.0, 4.0, 6.0])
    """
    tree, here = formula.whole, [slide for slide in slides if slide.place[2:] == (rate, angle)]
    if not here:
        return formula
    read = sorted(
        {
            slide.share
            for slide in here
            if slide.share != LEAVING
            and on_sides(tree, [slide]) != on_sides(tree, [slide._replace(sign=-slide.sign)])
        }
    )
    mean: Tree = Constant(0.0)
    for sides in product((-1.0, 1.0), repeat=len(read)):
        side_of = dict(zip(read, sides, strict=True))
        part = on_sides(
            tree,
            [slide._replace(sign=slide.sign * side_of.get(slide.share, 1.0)) for slide in here],
        )
        for number, side in side_of.items():
            share = TableName(share_name(number), (), 0)
            part = times(plus(Constant(0.5), times(Constant(0.5 * side), share)), part)
        mean = plus(mean, part)
    return formula._replace(tree=mean)


def on_sides(tree: Tree, slides: Sequence[Slide]) -> Tree:
    """Return a tree with its values on the side of each jump that `Slide.sign` gives."""
    values: dict[tuple[Tree, ...], float] = {}
    for place, _, sign, near in slides:
        values[place[:2]] = sign
        if near:
            apart = place.first if place.second == Constant(0.0) else place.difference.whole
            values[apart,] = near
    whole: Tree = _with_values(tree, values)
    return whole


def _with_values(tree: Any, values: Mapping[tuple[Tree, ...], float]) -> Any:
    """Replace `abs` and jumps in a tree by the values that `values` gives for their operands."""
    if not isinstance(tree, Applied):
        return tree
    first, *others = map(bare, tree.operands)
    if tree.name == "abs" and (first,) in values:
        return Constant(values[first,])
    if isinstance(tree.name, TableCall):
        name: str = _part_of_table(tree.name, first, values)
        return tree._replace(name=name, operands=(_with_values(tree.operands[0], values),))
    place = first, *(others or [Constant(0.0)])
    if tree.name in JUMPS and place in values:
        return Constant(_value(tree.name, values[place]))
    return tree._replace(operands=tuple(_with_values(part, values) for part in tree.operands))


def _value(name: str, side: float) -> float:
    """Return the value of a comparison or of `sign` on a side of its jump."""
    if name == "sign":
        return side
    if name in ("==", "!="):
        return float(name == "!=")
    return float((side > 0) == (name[0] == ">"))


def _part_of_table(
    call: TableCall, of: Tree, values: Mapping[tuple[Tree, ...], float]
) -> TableCall:
    """Return a table on one side of a repeated breakpoint."""
    table = call.table
    for number, x in enumerate(table.x[1:], 1):
        if x == table.x[number - 1] and (side := values.get((of, Constant(x)))):
            part = slice(number, None) if side > 0 else slice(number)
            name = f"{call}_{number}{'mp'[side > 0]}"
            return TableCall(name, LookupTable(table.x[part], table.values[part]))
    return call


def total_slope(
    formula: Formula, fixed: Collection[str]
) -> tuple[Formula, Mapping[str, TableName]] | None:
    """Return the derivative of a formula along a motion, None if unknown.

    Parameters
    ----------
    formula : Formula
    fixed : collection of str
        Names of numbers that do not change.

    Returns
    -------
    formula : Formula
        Derivative. It also reads `NOW`, which is the time, and rates of change.
    rates : mapping of str to TableName
        Name of each rate of change, and the quantity that changes.

    Examples
    --------
    >>> change, rates = total_slope(Formula("2*slip('C') - k*t"), ["k"])
    >>> change.function(0.0, 0.0, 0.0, *[5.0] * len(change.seen))
    5.0
    """
    rates: dict[str, TableName] = {}

    def moving(part: TableName) -> Tree:
        if not part.subscripts and part.name in ("t", PI, *fixed):
            return part
        name = " ".join(["rate of", part.name, *(row.written for row in part.subscripts)])
        rates[name] = part
        passed = applied("-", TableName("t", (), 0), TableName(NOW, (), 0))
        return plus(part, applied("*", TableName(name, (), 0), passed))

    tree = slope(with_names(formula.whole, moving))
    return None if tree is None else (formula._replace(tree=tree), rates)
