"""Expressions of a sweep: what is calculated of the results of each variant.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0}, name="low")])
>>> ratio = read_expression("ratio[low] - 1", case, [], "--out")
>>> ratio(solve(case), np.zeros(0))
array(2.5)

A text becomes a tree (`readers.expressions`), names become
tables and numbers of the case (`names`), and the values are calculated on arrays
(`evaluation`). All names are resolved when the text is read, so that a mistake is told before
anything is calculated and an expression can go to other processes. `columns` makes the list
of --out of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.evaluation import LAST, REDUCTIONS, evaluate
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Tree, parse
from vstatics.core.readers.expressions.operands import Constant, DottedName, TableName
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.meanings import Name, NameFinder, Selection, Tables, value_of
from vstatics.sweep.variants.targets import Varied

Node: TypeAlias = Name | Constant | Applied
CONSTANTS = {"pi": math.pi}
"""Numbers with a name."""


@dataclass(frozen=True)
class Expression:
    """What is calculated of the results of each variant.

    Parameters
    ----------
    text : str
        As it was read, without blanks at its ends.
    node : Constant, Applied, Selection or VariedNumber
        What is calculated.
    gears : tuple of str, optional
        The names along the axis of gears; None if there is no such axis.
    rows : tuple of str, optional
        The names along the axis of rows; None if there is no such axis.
    row : str
        What a row is, such as ``link``; empty if there is no such axis.
    table : str
        The name of the table as it was written, if it is nothing but a part of one.
    """

    text: str
    node: Node
    gears: tuple[str, ...] | None = None
    rows: tuple[str, ...] | None = None
    row: str = ""
    table: str = ""

    def __call__(self, tables: Tables, values: Floats) -> Floats:
        """Calculate it.

        Parameters
        ----------
        tables : Tables
            `Results` of arrays of variants, or what else has tables of them.
        values : ndarray, shape (variants, targets)
            The varied numbers. [-]

        Returns
        -------
        ndarray, shape (variants, [gears,] [rows])
            NaN does not exist; 1 and 0 stand for true and false. It may be a view. [-]
        """
        all_of_them = slice(None)
        gears, rows = (0 if axis is None else all_of_them for axis in (self.gears, self.rows))
        own_axes: Floats = self.spread(tables, values)[..., gears, rows]
        return own_axes

    def spread(self, tables: Tables, values: Floats) -> Floats:
        """As when called, but always of shape (variants, gears or 1, rows or 1)."""
        calculated = evaluate(self.node, lambda name: value_of(name, tables, values))
        return np.broadcast_to(calculated, (*values.shape[:-1], *calculated.shape[-2:]))

    @property
    def selections(self) -> Iterator[Selection]:
        """All parts of tables that it asks for."""
        nodes: list[Node] = [self.node]
        while nodes:
            node = nodes.pop()
            if isinstance(node, Selection):
                yield node
            elif isinstance(node, Applied):
                nodes += node.operands

    @property
    def per(self) -> str:
        """What it has a value for; nothing if it has one in all."""
        return " and ".join([self.row] * bool(self.row) + ["gear"] * bool(self.gears))


class Terms(NamedTuple):
    """What an expression may speak of besides tables and numbers of its subject."""

    targets: Sequence[Varied] = ()
    """What is varied, in the order of the values."""
    named: Mapping[str, ResolvedPart] = MappingProxyType({})
    """Columns with names of their own."""
    by_gear: bool = False
    """A row is of a gear, so that tables have none to be picked."""


def read_expression(
    text: str | Excerpt,
    subject: Subject,
    targets: Sequence[Varied] | Terms,
    option: str = "",
) -> Expression:
    """Read an expression.

    Parameters
    ----------
    text : str or Excerpt
        All of a text, or a part of it.
    subject : Transmission or VariedScenario
        Whose names the text uses.
    targets : sequence of Varied, or Terms
        What is varied, in the order of the values; other numbers are the subject's own.
    option : str
        Where a whole text was given, for messages: ``--where``.

    Raises
    ------
    ReadError
        With the place of what is wrong.

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
    """The terms where nothing but varied numbers is told."""
    return targets if isinstance(targets, Terms) else Terms(targets)


def resolved_expression(
    source: Excerpt, subject: Subject, terms: Terms
) -> tuple[Expression, ResolvedPart]:
    """An expression, and what stands for it in others; parameters as of `read_expression`."""
    names = names_of(source, subject, terms)
    tree = parse(source, names.language)
    part = _resolve(tree, names, terms.named)
    if part.per_gear and not names.gears:  # along time: what is left of it is the end
        part = part._replace(node=Applied(LAST, (part.node,), 0, 1), per_gear=False)
    node, per_gear, table = part
    picked = isinstance(tree, TableName) and tree.name not in terms.named
    expression = Expression(
        source.part.strip(),
        node,
        tuple(names.gears) if per_gear else None,
        tuple(names.rows(table)) if table else None,
        names.row(table) if table else "",
        tree.name if isinstance(tree, TableName) and picked else "",
    )
    return expression, part


def names_of(source: Excerpt, subject: Subject, targets: Sequence[Varied] | Terms) -> NameFinder:
    """Who knows the names in a text."""
    terms = terms_of(targets)
    if isinstance(subject, Transmission):
        from vstatics.sweep.results.names import SweepNames

        return SweepNames(source, subject, terms.targets, by_gear=terms.by_gear)
    return subject.names(source, terms.targets)


class ResolvedPart(NamedTuple):
    """A part whose names are resolved, and the axes that it has."""

    node: Node
    per_gear: bool = False
    table: str = ""
    """A table whose rows it has, if it has rows."""


def _resolve(tree: Tree, names: NameFinder, named: Mapping[str, ResolvedPart]) -> ResolvedPart:
    """Ask what the names in a tree mean, and whether operands go together."""
    if not isinstance(tree, Applied):
        return _named(tree, names, named)
    name, operands = tree.name, [_resolve(operand, names, named) for operand in tree.operands]
    if name in ("abs", "sum", "sqrt", LAST) and len(operands) > 1:
        message = f"{name} of {len(operands)} parts, expected one, as in {name}(losses)"
        raise names.source.error(message, tree.at)
    node = Applied(name, tuple(operand.node for operand in operands), tree.at, tree.depth)
    if name == LAST:
        return ResolvedPart(node, per_gear=False, table=operands[0].table)
    if name in REDUCTIONS and len(operands) == 1:
        if name == "sum" and operands[0].per_gear and not names.gears:
            message = "a sum over all instants means nothing: take min, max or last"
            raise names.source.error(message, tree.at)
        return ResolvedPart(node)
    tables = [operand.table for operand in operands if operand.table]
    for other in tables[1:]:
        one, two = names.row(tables[0]), names.row(other)
        unlike = (one == "mode") != (two == "mode")
        if unlike or names.rows(tables[0]) != names.rows(other):
            message = (
                f"`{tables[0]}` has one value per {one} and `{other}` one per {two}, so `{name}` "
                "can't pair them: pick a row, or use min, max or sum"
            )
            raise names.source.error(message, tree.at)
    per_gear = any(operand.per_gear for operand in operands)
    return ResolvedPart(node, per_gear, tables[0] if tables else "")


def _named(
    tree: Constant | DottedName | TableName,
    names: NameFinder,
    named: Mapping[str, ResolvedPart],
) -> ResolvedPart:
    """What a number or a name means."""
    if isinstance(tree, TableName):
        if tree.name in (*named, *CONSTANTS):
            if tree.subscripts:
                message = f"`{tree.name}` is a number, so nothing of it can be picked"
                raise names.source.error(message, tree.subscripts[0].at)
            return named.get(tree.name) or ResolvedPart(Constant(CONSTANTS[tree.name]))
        part = names.table(tree)
        if not isinstance(part, Selection):
            return ResolvedPart(part)
        has_rows = part.rows and part.row is None
        return ResolvedPart(part, part.gear is None, part.table if has_rows else "")
    return ResolvedPart(tree if isinstance(tree, Constant) else names.number(tree))
