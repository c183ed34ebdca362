"""Where a comparison in a formula switches that moves: at a speed by time and angle, or an angle.

``speed < 300 + t`` does so where the speed is 300 + t, ``sign(speed + 10*angle)`` where it is
-10 angle. A motion may slide along that (`jumps`).
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

from vstatics.core.readers.expressions.grammar import Applied, Tree
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.algebra import (
    applied,
    bare,
    number,
    parts,
    slope,
    straight,
    times,
    variables,
)
from vstatics.simulation.scenario.corners import JUMPS


class JumpSurface(NamedTuple):
    """Where something switches."""

    over: Literal["speed", "angle"]
    at: Tree
    """Of t. [rad/s or rad]"""
    by_angle: float = 0.0
    """What a speed there has besides, by the angle. [1/s]"""


def surfaces(tree: Tree) -> dict[JumpSurface, str]:
    """Those of a formula that depend on time or angle, each with the side it itself counts to.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("5*(speed <= 7 - 2*angle)*(angle < 3)", ""), Language([], "t", "t"))
    >>> surfaces(tree)
    {JumpSurface(over='speed', at=Constant(value=7.0), by_angle=-2.0): '-'}
    """
    found: dict[JumpSurface, str] = {}
    for part in parts(tree):
        surface, lead = _surface(part)
        if (
            surface
            and isinstance(part, Applied)
            and (surface.by_angle or "t" in variables(surface.at))
        ):
            own = _value(part, 0.0) == _value(part, -lead)
            found.setdefault(surface, "-" if own else "+")
    return found


def on_side(tree: Any, surface: JumpSurface, side: float) -> Any:
    """A formula on one side of a surface: above for +1, below for -1."""
    if not isinstance(tree, Applied):
        return tree
    own, lead = _surface(tree)
    if own == surface:
        return Constant(_value(tree, side * lead))
    inner = (on_side(one, surface, side) for one in tree.operands)
    return tree._replace(operands=tuple(inner))


def _surface(tree: Tree) -> tuple[JumpSurface | None, float]:
    """That of a comparison or a `sign`, and how what is compared grows across it."""
    if not isinstance(tree, Applied) or tree.name not in JUMPS:
        return None, 0.0
    first = bare(tree.operands[0])
    form = straight(first if tree.name == "sign" else applied("-", first, bare(tree.operands[1])))
    if form is None or not (lead := form.speed or form.angle):
        return None, 0.0
    at = times(Constant(-1 / lead), form.rest)
    rest = number(at)
    at = at if rest is None else Constant(rest)
    if variables(at) - {"t"}:
        return None, 0.0
    moves = slope(at)
    if moves is None or slope(moves) is None:
        return None, 0.0
    by_angle = -form.angle / lead if form.speed else 0.0
    return JumpSurface("speed" if form.speed else "angle", at, by_angle), lead


def _value(tree: Applied, difference: float) -> float:
    """Of a comparison or a `sign`, by what is compared."""
    operands = (Constant(difference), Constant(0.0))[: len(tree.operands)]
    found = number(tree._replace(operands=operands))
    assert found is not None  # noqa: S101 - nothing stands in it but numbers
    return found
