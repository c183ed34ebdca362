"""Expressions of a sweep: numbers calculated from the results of each variant.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0}, name="low")])
>>> ratio = read_expression("ratio[low] - 1", case, [], "--out")
>>> ratio(solve(case), np.zeros(0))
array(2.5)

The text is parsed to a tree (`readers.expressions`), its names are replaced by tables and numbers
of the case (`names`), and values are calculated on arrays (`evaluation`). All names are resolved
when the text is read, so that mistakes are reported before the calculation, and expressions can be
sent to other processes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.evaluation import (
    LAST,
    REDUCTIONS,
    evaluate,
    expect_operands,
)
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Tree, parse
from vstatics.core.readers.expressions.operands import Constant, DottedName, TableName
from vstatics.core.tables.names import plain_name
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.meanings import Name, NameFinder, Selection, Tables, value_of
from vstatics.sweep.variants.targets import Varied

Node: TypeAlias = Name | Constant | Applied
CONSTANTS = {"pi": math.pi}
"""Named constants of expressions."""


@dataclass(frozen=True)
class Expression:
    """Expression that is calculated from the results of variants.

    Parameters
    ----------
    text : str
        Text as read, without surrounding blanks.
    node : Constant, Applied, Selection or VariedNumber
        Tree of the calculation.
    gears : tuple of str, optional
        Names of the gears, if the value has an axis of gears.
    rows : tuple of str, optional
        Names of the rows, if the value has an axis of rows, such as links.
    row : str
        Noun for a row, such as ``link``, if the value has an axis of rows.
    table : str
        Name of the table, if the expression is just a table or a part of a table.
    """

    text: str
    node: Node
    gears: tuple[str, ...] | None = None
    rows: tuple[str, ...] | None = None
    row: str = ""
    table: str = ""

    def __call__(self, tables: Tables, values: Floats) -> Floats:
        """Calculate the value for each variant.

        Parameters
        ----------
        tables : Tables
            `Results` of arrays of variants, or another object with their tables.
        values : ndarray, shape (variants, targets)
            The varied numbers. [-]

        Returns
        -------
        ndarray, shape (variants, [gears,] [rows])
            Value, NaN where undefined; 1 and 0 mean true and false. The array can be a view. [-]
        """
        whole_axis = slice(None)
        gears, rows = (0 if axis is None else whole_axis for axis in (self.gears, self.rows))
        values_on_axes: Floats = self.spread(tables, values)[..., gears, rows]
        return values_on_axes

    def spread(self, tables: Tables, values: Floats) -> Floats:
        """Calculate the value with all axes, shape (variants, gears or 1, rows or 1)."""
        calculated = evaluate(self.node, lambda name: value_of(name, tables, values))
        return np.broadcast_to(calculated, (*values.shape[:-1], *calculated.shape[-2:]))

    @property
    def selections(self) -> Iterator[Selection]:
        """Tables, or parts of tables, used by the expression."""
        nodes: list[Node] = [self.node]
        while nodes:
            node = nodes.pop()
            if isinstance(node, Selection):
                yield node
            elif isinstance(node, Applied):
                nodes += node.operands

    @property
    def per(self) -> str:
        """Nouns for the axes of the value, such as "link and gear"; empty for a single value."""
        return " and ".join([self.row] * bool(self.row) + ["gear"] * bool(self.gears))


class Terms(NamedTuple):
    """Names that an expression can use in addition to the names of the subject."""

    targets: Sequence[Varied] = ()
    """Varied numbers, in the order of the values."""
    named: Mapping[str, ResolvedPart] = EMPTY
    """Expressions of named columns, by the name."""
    by_gear: bool = False
    """True if each output row represents a gear. Tables then have no axis of gears."""


def read_expression(
    text: str | Excerpt,
    subject: Subject,
    targets: Sequence[Varied] | Terms,
    option: str = "",
) -> Expression:
    """Read an expression of the results of variants.

    Parameters
    ----------
    text : str or Excerpt
        Text, or a part of a longer text.
    subject : Transmission or VariedScenario
        Case or scenario whose names the text uses.
    targets : sequence of Varied, or Terms
        Varied numbers, in the order of their values; all other numbers of the subject are
        constants.
    option : str
        Name of the option for messages, such as ``--where``, if `text` is a str.

    Raises
    ------
    ReadError
        If the text is invalid, with the place of the error.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.sweep.variants.targets import Target
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> expression = read_expression("speeds[3] + 1", case, [Target("D1.ratio", 0, "ratio")])
    >>> expression.gears, expression.rows
    (('1', '2'), None)
    >>> ratios = np.array([[-3.0], [-4.0]])
    >>> expression(solve(case, ratios=ratios), ratios)
    array([[2.  , 1.25],
           [2.  , 1.2 ]])
    """
    source = Excerpt(text, option) if isinstance(text, str) else text
    return resolved_expression(source, subject, terms_of(targets))[0]


def terms_of(targets: Sequence[Varied] | Terms) -> Terms:
    """Return given terms, or terms with the given varied numbers only."""
    return targets if isinstance(targets, Terms) else Terms(targets)


def resolved_expression(
    source: Excerpt, subject: Subject, terms: Terms
) -> tuple[Expression, ResolvedPart]:
    """Return an expression, and the tree with resolved names; see `read_expression`."""
    names = names_of(source, subject, terms)
    tree = parse(source, names.language)
    part = _resolve(tree, names, terms.named)
    if part.per_gear and not names.gears:  # of a value over time, only the last instant is used
        part = part._replace(node=Applied(LAST, (part.node,), 0, 1), per_gear=False)
    node, per_gear, table = part
    picked = isinstance(tree, TableName) and tree.name not in terms.named
    expression = Expression(
        source.part.strip(),
        node,
        tuple(names.gears) if per_gear else None,
        tuple(names.rows(table)) if table else None,
        names.row(table) if table else "",
        plain_name(tree.name) if isinstance(tree, TableName) and picked else "",
    )
    return expression, part


def names_of(source: Excerpt, subject: Subject, targets: Sequence[Varied] | Terms) -> NameFinder:
    """Return the finder of the meanings of names in a text."""
    terms = terms_of(targets)
    if isinstance(subject, Transmission):
        from vstatics.sweep.results.names import SweepNames

        return SweepNames(source, subject, terms.targets, by_gear=terms.by_gear)
    return subject.names(source, terms.targets)


class ResolvedPart(NamedTuple):
    """Part of an expression with resolved names, and the axes of the value."""

    node: Node
    per_gear: bool = False
    table: str = ""
    """Name of the table whose rows the value has; empty if the value has no axis of rows."""


def _resolve(tree: Tree, names: NameFinder, named: Mapping[str, ResolvedPart]) -> ResolvedPart:
    """Replace names in a tree by meanings, and check that the axes of operands agree."""
    if not isinstance(tree, Applied):
        return _named(tree, names, named)
    name, operands = tree.name, [_resolve(operand, names, named) for operand in tree.operands]
    expect_operands(tree, names.source, "losses")
    node = Applied(name, tuple(operand.node for operand in operands), tree.at, tree.depth)
    if name == LAST:
        return ResolvedPart(node, per_gear=False, table=operands[0].table)
    if name in REDUCTIONS and len(operands) == 1:
        if name == "sum" and operands[0].per_gear and not names.gears:
            message = "a sum over all instants has no meaning: use min, max or last"
            raise names.source.error(message, tree.at)
        return ResolvedPart(node)
    tables = [operand.table for operand in operands if operand.table]
    for other in tables[1:]:
        row, paired = names.row(tables[0]), names.row(other)
        unlike = (row == "mode") != (paired == "mode")
        if unlike or names.rows(tables[0]) != names.rows(other):
            message = (
                f"`{tables[0]}` has one value per {row} and `{other}` one per {paired}, so "
                f"`{name}` cannot pair them: select a row, or use min, max or sum"
            )
            raise names.source.error(message, tree.at)
    per_gear = any(operand.per_gear for operand in operands)
    return ResolvedPart(node, per_gear, tables[0] if tables else "")


def _named(
    tree: Constant | DottedName | TableName,
    names: NameFinder,
    named: Mapping[str, ResolvedPart],
) -> ResolvedPart:
    if isinstance(tree, TableName):
        if tree.name in (*named, *CONSTANTS):
            if tree.subscripts:
                message = f"`{tree.name}` is a number, so it has no rows to select"
                raise names.source.error(message, tree.subscripts[0].at)
            return named.get(tree.name) or ResolvedPart(Constant(CONSTANTS[tree.name]))
        part = names.table(tree)
        if not isinstance(part, Selection):
            return ResolvedPart(part)
        has_rows = part.rows and part.row is None
        return ResolvedPart(part, part.gear is None, part.table if has_rows else "")
    return ResolvedPart(tree if isinstance(tree, Constant) else names.number(tree))
