"""Moving jumps of formulas: surfaces in time, speed and angle on which a comparison switches.

``speed < 300 + t`` switches where the speed is 300 + t, ``sign(speed + 10*angle)`` where the speed
is -10 angle. A motion can slide along such a surface (`jumps`).
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
    """Speed or angle at which a comparison in a formula switches, and which changes over time."""

    over: Literal["speed", "angle"]
    at: Tree
    """Speed or angle of the surface, a formula of t. [rad/s or rad]"""
    by_angle: float = 0.0
    """Derivative of the speed of the surface with respect to the angle of the link. [1/s]"""


def surfaces(tree: Tree) -> dict[JumpSurface, str]:
    """Return moving jumps, each with the side (`+` or `-`) to which the value at the jump belongs.

    Examples
    --------
    >>> from vstatics.core.readers.expressions.excerpt import Excerpt
    >>> from vstatics.core.readers.expressions.grammar import Language, parse
    >>> tree = parse(Excerpt("5*(speed <= 7 - 2*angle)*(angle < 3)", ""), Language([], "t", "t"))
    >>> surfaces(tree)
    {JumpSurface(over='speed', at=Constant(value=7.0), by_angle=-2.0): '-'}
    """
    sides: dict[JumpSurface, str] = {}
    for part in parts(tree):
        surface, lead = _surface(part)
        if (
            surface
            and isinstance(part, Applied)
            and (surface.by_angle or "t" in variables(surface.at))
        ):
            is_below = _value(part, 0.0) == _value(part, -lead)
            sides.setdefault(surface, "-" if is_below else "+")
    return sides


def on_side(tree: Any, surface: JumpSurface, side: float) -> Any:
    """Restrict a formula to the region above (`side` = 1) or below (-1) a surface."""
    if not isinstance(tree, Applied):
        return tree
    switch, lead = _surface(tree)
    if switch == surface:
        return Constant(_value(tree, side * lead))
    inner = (on_side(operand, surface, side) for operand in tree.operands)
    return tree._replace(operands=tuple(inner))


def _surface(tree: Tree) -> tuple[JumpSurface | None, float]:
    """Return the surface of a comparison or `sign`, and the factor of its speed or angle."""
    if not isinstance(tree, Applied) or tree.name not in JUMPS:
        return None, 0.0
    first = bare(tree.operands[0])
    form = straight(first if tree.name == "sign" else applied("-", first, bare(tree.operands[1])))
    if form is None or not (lead := form.speed or form.angle):
        return None, 0.0
    place = times(Constant(-1 / lead), form.offset)
    value = number(place)
    place = place if value is None else Constant(value)
    if variables(place) - {"t"}:
        return None, 0.0
    speed = slope(place)
    if speed is None or slope(speed) is None:
        return None, 0.0
    by_angle = -form.angle / lead if form.speed else 0.0
    return JumpSurface("speed" if form.speed else "angle", place, by_angle), lead


def _value(tree: Applied, difference: float) -> float:
    operands = (Constant(difference), Constant(0.0))[: len(tree.operands)]
    value = number(tree._replace(operands=operands))
    assert value is not None  # noqa: S101 - all operands are numbers
    return value
