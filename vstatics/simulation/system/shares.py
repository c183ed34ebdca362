"""Replacement of a formula's jumps by variables, for a motion that slides along the jumps.

On a jump, a formula has a weighted mean of its values on both sides (Filippov). The weight is given
by the share of the jump, from -1 (value below) to 1 (value above): it replaces `sign`, and
(1 + share)/2 replaces `>`. While the motion slides, the share has the value that keeps the motion
on the jump (Utkin's equivalent control).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant, TableName
from vstatics.simulation.scenario.algebra import (
    applied,
    bare,
    minus,
    plus,
    slope,
    times,
    with_names,
)
from vstatics.simulation.scenario.corners import COMPARES, JUMPS
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import PI
from vstatics.simulation.scenario.table_call import TableCall

_LOGIC = ("and", "or", "not")
NOW = "now"
"""Name of the time in `total_slope`."""


class JumpPlace(NamedTuple):
    """Place of a jump: two terms that a formula compares, and the link on which it acts."""

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
    """Number of the share. Jumps at the same instants have the same share."""
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
    """Return a formula with shares of both sides instead of some of its jumps.

    Examples
    --------
    >>> relay = Formula("8*(slip('C') > 2)*(p < 3)")
    >>> place = JumpPlace(*map(bare, relay.whole.operands[0].operands[1].operands))
    >>> mean = shared(relay, (Slide(place, 0, 1.0),))
    >>> mean.seen[0], [mean.function(0.0, 0.0, 0.0, share, 2.0) for share in (-1.0, 0.0, 0.5)]
    (Seen(word='value', of='share 0'), [0.0, 4.0, 6.0])
    """
    means: dict[tuple[Tree, ...], Tree] = {}
    for place, share, sign, near in slides:
        if place[2:] == (rate, angle):
            means[place[:2]] = times(Constant(sign), TableName(share_name(share), (), 0))
            apart = place.first if place.second == Constant(0.0) else place.difference.whole
            means[apart,] = Constant(near)
    return formula._replace(tree=_shared(formula.whole, means)) if means else formula


def _shared(tree: Any, means: Mapping[tuple[Tree, ...], Tree]) -> Any:
    """Replace operations in a tree by means, which are given by the operands."""
    if not isinstance(tree, Applied):
        return tree
    if tree.name == "abs" and (size := means.get((bare(tree.operands[0]),))):
        return size
    inside = tree._replace(operands=tuple(_shared(part, means) for part in tree.operands))
    if isinstance(tree.name, TableCall):
        return _table(tree.name, bare(tree.operands[0]), inside, means)
    if tree.name in JUMPS:
        share = means.get((bare(tree.operands[0]), bare((*tree.operands, Constant(0.0))[1])))
        return _side(tree.name, share) if share else inside
    changed = inside != tree and tree.name in _LOGIC
    return _logic(tree, inside.operands) if changed else inside


def _half(share: Tree, sign: float) -> Tree:
    return plus(Constant(0.5), times(Constant(0.5 * sign), share))


def _side(name: str, share: Tree) -> Tree:
    """Return the mean value of a comparison or of `sign`."""
    if name == "sign":
        return share
    if name in ("==", "!="):
        return Constant(float(name == "!="))
    return _half(share, 1.0 if name[0] == ">" else -1.0)


def _logic(tree: Applied, operands: tuple[Tree, ...]) -> Tree:
    """Return `and`, `or` or `not` of truth values between 0 and 1 as a product."""
    truths = [
        operand
        if isinstance(part, Applied) and part.name in (*COMPARES, *_LOGIC)
        else applied("!=", operand, Constant(0.0))
        for part, operand in zip(tree.operands, operands, strict=True)
    ]
    if tree.name == "and":
        return applied("*", *truths)
    falses = [plus(Constant(1.0), minus(truth)) for truth in truths]
    if tree.name == "not":
        return falses[0]
    return plus(Constant(1.0), minus(applied("*", *falses)))


def _table(
    call: TableCall, of: Tree, inside: Applied, means: Mapping[tuple[Tree, ...], Tree]
) -> Tree:
    """Return a table as the mean of its parts below and above a repeated breakpoint."""
    table = call.table
    for number, x in enumerate(table.x[1:], 1):
        if x == table.x[number - 1] and (share := means.get((of, Constant(x)))):
            below, above = (
                times(
                    _half(share, sign),
                    inside._replace(
                        name=TableCall(
                            f"{call}_{number}{sign:+.0f}".replace("+", "p").replace("-", "m"),
                            LookupTable(table.x[part], table.values[part]),
                        )
                    ),
                )
                for sign, part in ((-1.0, slice(number)), (1.0, slice(number, None)))
            )
            return plus(below, above)
    return inside


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
        Derivative. It also reads `now`, which is the time, and rates of change.
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
