"""A formula of the time, and of the speed and angle of a link.

The language is that of a sweep (`readers.expressions`), with ``^`` beside ``**``, and with
functions of a number. A text becomes a tree, and the tree a function (`formula_code`); where it
bends or jumps is told by `corners`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import lru_cache
from typing import NamedTuple

from vstatics.errors import nearest, quoted, spoken
from vstatics.numerics.arrays import Floats
from vstatics.readers.expressions.excerpt import Excerpt
from vstatics.readers.expressions.grammar import Applied, Language, Tree, parse
from vstatics.readers.expressions.operands import Constant, DottedName, TableName
from vstatics.simulation.scenario.algebra import parts, slope, variables
from vstatics.simulation.scenario.corners import JUMPS, between, corners
from vstatics.simulation.scenario.formula_code import FUNCTIONS, PI, VARIABLES, compiled, of_times
from vstatics.simulation.scenario.surfaces import JumpSurface, on_side, surfaces


class Formula(NamedTuple):
    """A formula of t [s], and of speed [rad/s] and angle [rad] of the link itself.

    Examples
    --------
    >>> formula = Formula("-1200*tanh(speed/0.05)")
    >>> formula.variables, formula.function(0.0, 10.0, 0.0)
    (frozenset({'speed'}), -1200.0)
    >>> Formula("2 + 84e-5*t^2").function(100.0, 0.0, 0.0)
    10.4
    """

    text: str
    tree: Tree | None = None
    """What of it is calculated, where not all: between jumps, or its slope."""

    @property
    def variables(self) -> frozenset[str]:
        """Which of t, speed and angle it has.

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return _read(*self).variables

    @property
    def constants(self) -> list[float]:
        """The numbers that stand in it.

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return [one.value for one in parts(_read(*self).tree) if isinstance(one, Constant)]

    @property
    def function(self) -> Callable[[float, float, float], float]:
        """Its value by t, speed and angle; NaN or infinite where it has none.

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return _read(*self).function

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which it bends or jumps, as far as it compares straight lines in time [s].

        Raises
        ------
        ReadError
            If the text is no formula.
        """
        return _read(*self).breaks

    def jumps(self, name: str) -> tuple[float, ...]:
        """Where it jumps along `speed` or `angle`, as far as it compares straight lines in it.

        >>> Formula("100*(abs(speed) < 300)").jumps("speed")
        (-300.0, 300.0)
        """
        return tuple(at for at, jumps in corners(_read(*self).tree, name).items() if jumps)

    def between(self, name: str, low: float, high: float) -> Formula:
        """What it is between two jumps along a variable."""
        return self._replace(tree=between(_read(*self).tree, name, low, high))

    @property
    def surfaces(self) -> dict[JumpSurface, str]:
        """Where else it switches, by time or angle, each with the side it itself counts to."""
        return surfaces(_read(*self).tree)

    def on_side(self, surface: JumpSurface, side: float) -> Formula:
        """What it is above a surface, +1, or below, -1."""
        return self._replace(tree=on_side(_read(*self).tree, surface, side))

    @property
    def slope(self) -> Formula:
        """Its change with time, of a formula of t of which that is known."""
        return self._replace(tree=slope(_read(*self).tree))

    @property
    def switches(self) -> bool:
        """Whether it compares speeds or angles."""
        return _read(*self).switches

    def along(self, times: Floats) -> Floats:
        """Its values at many times, of a formula of t alone."""
        return _read(*self).of_times(times)


def read_formula(source: Excerpt, names: Collection[str] = VARIABLES) -> Formula:
    """Read a formula.

    Parameters
    ----------
    source : Excerpt
    names : collection of str
        What it may have of t, speed and angle.

    Raises
    ------
    ReadError
        With the place of what is wrong.

    Examples
    --------
    >>> read_formula(Excerpt("3000*min(t/0.3, 1)", "FH"), ["t"])
    Formula(text='3000*min(t/0.3, 1)', tree=None)
    >>> read_formula(Excerpt("3000*speed", "FH"), ["t"])
    Traceback (most recent call last):
    ...
    vstatics.errors.ReadError: FH:1:6: error: read `speed`, expected a formula of t [E105]
    """
    _tree(source, names)
    return Formula(source.part.strip())


def _tree(source: Excerpt, names: Collection[str]) -> Tree:
    """The tree of a formula in which only these names stand."""
    operands = f"a number, {spoken(names, 'or')}, or a function such as {', '.join(FUNCTIONS)}"
    tree = parse(source, Language(FUNCTIONS, operands, "t", caret=True))
    for part in parts(tree):
        if isinstance(part, Applied):
            if (
                part.name not in ("min", "max")
                and part.name in FUNCTIONS
                and len(part.operands) > 1
            ):
                count, example = len(part.operands), f"{part.name}(t)"
                message = f"{part.name} of {count} parts, expected one, as in {example}"
                raise source.error(message, part.at)
        elif isinstance(part, DottedName):
            message = f"read {quoted(part.written)}, expected {operands}"
            raise source.error(message, part.at)
        elif isinstance(part, TableName):
            _check_name(part, names, source)
    return tree


def _check_name(part: TableName, names: Collection[str], source: Excerpt) -> None:
    name = part.name
    if name == PI or name in names:
        if part.subscripts:
            message = f"read `[` behind `{name}`, expected {name} alone"
            message += ": that of the link itself" if name in ("speed", "angle") else ""
            raise source.error(message, part.at)
        return
    expected = f"expected a formula of {spoken(names)}"
    hint = "" if name in VARIABLES else nearest(name, (*names, *FUNCTIONS, PI))
    raise source.error(f"read {quoted(name)}, {expected}{hint}", part.at)


class _Read(NamedTuple):
    """What is known of a text."""

    variables: frozenset[str]
    function: Callable[[float, float, float], float]
    of_times: Callable[[Floats], Floats]
    breaks: tuple[float, ...]
    switches: bool
    tree: Tree


@lru_cache(maxsize=256)
def _read(text: str, tree: Tree | None) -> _Read:
    tree = tree or _tree(Excerpt(text, "formula"), VARIABLES)
    breaks = tuple(corners(tree, "t"))
    switches = any(
        isinstance(part, Applied) and part.name in JUMPS and variables(part) - {"t"}
        for part in parts(tree)
    )
    return _Read(variables(tree), compiled(tree), of_times(tree), breaks, switches, tree)
