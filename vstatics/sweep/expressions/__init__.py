"""Text of an expression and a case -> what can be calculated of results.

All names are resolved when the text is read, so that a mistake is told before anything is
calculated and an expression can go to other processes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Floats
from vstatics.statics.results import ARRAYS, Results, Rows
from vstatics.sweep.expressions import evaluation, syntax
from vstatics.sweep.expressions.evaluation import Applied, Constant, Given, Node
from vstatics.sweep.expressions.operands import Number, Table, Varied
from vstatics.sweep.expressions.selected import ROW, select
from vstatics.sweep.expressions.source import Source
from vstatics.sweep.targets import Target, target
from vstatics.tables.rows import table_rows

REDUCTIONS = ("min", "max", "sum")
"""Functions that make one number of all gears and rows of one operand."""


@dataclass(frozen=True)
class Expression:
    """What is calculated of the results of each variant.

    Parameters
    ----------
    text : str
        As it was read, without blanks at its ends.
    node : Node
        What is calculated.
    gears : tuple of str, optional
        The names along the axis of gears; None if there is no such axis.
    rows : tuple of str, optional
        The names along the axis of rows; None if there is no such axis.
    row : str
        What a row is, such as ``link``; empty if there is no such axis.
    """

    text: str
    node: Node
    gears: tuple[str, ...] | None
    rows: tuple[str, ...] | None
    row: str = ""

    def __call__(self, results: Results, values: Floats) -> Floats:
        """Calculate it.

        Parameters
        ----------
        results : Results
            Of arrays of variants.
        values : ndarray, shape (variants, targets)
            The varied numbers. [-]

        Returns
        -------
        ndarray, shape (variants, [gears,] [rows])
            NaN does not exist; 1 and 0 stand for true and false. It may be a view. [-]
        """
        all_of_them = slice(None)
        gears, rows = (0 if axis is None else all_of_them for axis in (self.gears, self.rows))
        made: Floats = self.spread(results, values)[..., gears, rows]
        return made

    def spread(self, results: Results, values: Floats) -> Floats:
        """As when called, but always of shape (variants, gears or 1, rows or 1)."""
        made = evaluation.evaluate(self.node, results, values)
        return np.broadcast_to(made, (*values.shape[:-1], *made.shape[-2:]))

    @property
    def per(self) -> str:
        """What it has a value for; nothing if it has one in all."""
        return " and ".join([self.row] * bool(self.row) + ["gear"] * bool(self.gears))


def read_expression(
    text: str, case: Transmission, targets: Sequence[Target], option: str
) -> Expression:
    """Read an expression.

    Parameters
    ----------
    text : str
    case : Transmission
        Whose names the text uses.
    targets : sequence of Target
        What is varied, in the order of the values; other numbers are those of the case.
    option : str
        Where the text was given, for messages: ``--where``.

    Raises
    ------
    ReadError
        With the place of what is wrong.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> expression = read_expression("speeds[3] + 1", case, [target("D1.ratio", case)], "--out")
    >>> expression.gears, expression.rows
    (('1', '2'), None)
    >>> ratios = np.array([[-3.0], [-4.0]])
    >>> expression(solve(case, ratios=ratios), ratios)
    array([[2.  , 1.25],
           [2.  , 1.2 ]])
    """
    return read_part(Source(text, option), case, targets)


def read_part(source: Source, case: Transmission, targets: Sequence[Target]) -> Expression:
    """Read an expression that is a part of a text; see `read_expression`."""
    shaped = _Resolver(source, case, targets).resolve(syntax.parse(source))
    gears = tuple(gear.name for gear in case.gears) if shaped.gears else None
    rows = tuple(table_rows(shaped.table, case)) if shaped.table else None
    row = ROW[shaped.rows] if shaped.rows else ""
    return Expression(source.part.strip(), shaped.node, gears, rows, row)


class _Shaped(NamedTuple):
    """A resolved part, and the axes that it has."""

    node: Node
    gears: bool = False
    table: str = ""
    """A table whose rows it has, if it has rows."""

    @property
    def rows(self) -> Rows | None:
        return ARRAYS[self.table].rows if self.table else None


class _Resolver:
    """Finds what names stand for, and whether operands go together."""

    def __init__(self, source: Source, case: Transmission, targets: Sequence[Target]) -> None:
        self.source = source
        self.case = case
        self.targets = targets

    def resolve(self, tree: syntax.Tree) -> _Shaped:
        """Resolve all that is in a tree."""
        match tree:
            case Number(value):
                return _Shaped(Constant(value))
            case Table():
                return self._table(tree)
            case Varied():
                return _Shaped(self._varied(tree))
            case syntax.Operation(name, operands, at):
                return self._operation(name, [self.resolve(one) for one in operands], at)

    def _table(self, table: Table) -> _Shaped:
        part = select(table, self.case, self.source)
        has_rows = part.has_rows and part.row is None
        return _Shaped(part, part.gear is None, part.table if has_rows else "")

    def _varied(self, varied: Varied) -> Node:
        """A number of a mechanism: varied, or else the case's own."""
        found = target(varied.text, self.case, self.source.place(varied.at))
        for column, one in enumerate(self.targets):
            if (one.mechanism, one.quantity) == (found.mechanism, found.quantity):
                return Given(column)
        return Constant(getattr(self.case.mechanisms[found.mechanism], found.quantity))

    def _operation(self, name: str, operands: list[_Shaped], at: int) -> _Shaped:
        if name in ("abs", "sum") and len(operands) > 1:
            message = f"{name} of {len(operands)} parts, expected one, as in {name}(losses)"
            raise self.source.error(message, at)
        if name == "+" and len(operands) == 1:
            return operands[0]
        node = Applied(name, tuple(operand.node for operand in operands))
        if name in REDUCTIONS and len(operands) == 1:
            return _Shaped(node)
        with_rows = [operand for operand in operands if operand.table]
        for other in with_rows[1:]:
            self._check_rows(name, with_rows[0], other, at)
        table = with_rows[0].table if with_rows else ""
        return _Shaped(node, any(operand.gears for operand in operands), table)

    def _check_rows(self, name: str, first: _Shaped, other: _Shaped, at: int) -> None:
        """Rows of different kinds do not belong together, one by one."""
        if first.rows is None or other.rows is None or first.rows == other.rows:
            return
        raise self.source.error(
            f"`{first.table}` has one value per {ROW[first.rows]} and `{other.table}` one per "
            f"{ROW[other.rows]}, so `{name}` can't pair them: pick a row, or use min, max or sum",
            at,
        )
