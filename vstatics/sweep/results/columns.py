"""The text of --out -> columns with headings."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Problem, ReadError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.evaluation import FUNCTIONS, LAST
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.tables.names import NAME
from vstatics.core.tables.quantities import BY_NAME
from vstatics.core.tables.written_results import GEAR
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.expressions import (
    CONSTANTS,
    Expression,
    ResolvedPart,
    Terms,
    names_of,
    resolved_expression,
    terms_of,
)
from vstatics.sweep.results.meanings import (
    OF_RATIOS,
    OK,
    OMEGA,
    PART_NUMBERS,
    SPREAD,
    NameFinder,
    Selection,
    Tables,
    VariedNumber,
)
from vstatics.sweep.variants.targets import Varied

OPTION = "--out"

_BLANK = re.compile(r"\s")


class ColumnGroup(NamedTuple):
    """An expression, and which of its values become columns."""

    expression: Expression
    cells: tuple[tuple[int, int], ...]
    """Index of gear and of row, 0 where it has none."""


@dataclass(frozen=True)
class OutputColumns:
    """What is written of each variant.

    Parameters
    ----------
    headings : tuple of str
        All different.
    parts : tuple of ColumnGroup
        What they stand for, in the same order.
    """

    headings: tuple[str, ...]
    parts: tuple[ColumnGroup, ...]
    named: Mapping[str, ResolvedPart] = field(default_factory=dict)
    """What names of columns stand for."""

    def __call__(self, tables: Tables, values: Floats) -> Floats:
        """Calculate all columns.

        Parameters
        ----------
        tables : Tables
            `Results` of an array of variants, or what else has tables of them.
        values : ndarray, shape (variants, targets)
            The varied numbers. [-]

        Returns
        -------
        ndarray, shape (variants, columns)
            Each column lies in one stretch of memory. NaN does not exist. [-]
        """
        columns = np.empty((len(self.headings), len(values))).T
        column = 0
        for expression, cells in self.parts:
            table = expression.spread(tables, values)
            for gear, row in cells:
                columns[:, column] = table[:, gear, row]
                column += 1
        return columns


_NAMED = re.compile(rf"\s*({NAME.pattern})\s*=(?!=)")
"""What stands before an expression that names its column."""


def read_columns(text: str, subject: Subject, targets: Sequence[Varied] | Terms) -> OutputColumns:
    """Read a list of expressions, separated by commas outside brackets.

    Each gives a column, or one for each gear and row that it has: all gears of the first
    row, then of the second. What is asked for twice is written once, and varied numbers not
    at all, since they have columns of their own. ``NAME=EXPR`` names a column, which later ones
    may speak of.

    Parameters
    ----------
    text : str
    subject : Transmission or VariedScenario
        Whose names the text uses.
    targets : sequence of Varied, or Terms
        What is varied.

    Raises
    ------
    ReadError
        With everything that is wrong, and its places.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2], name="1R")])
    >>> columns = read_columns("ratio, speeds[3], abs(losses[D1]), ratio[#2] - 1", case, [])
    >>> columns.headings[:4]
    ('ratio[1]', 'ratio["1R"]', 'speeds[3,1]', 'speeds[3,"1R"]')
    >>> columns.headings[4:]
    ('abs(losses[D1])[1]', 'abs(losses[D1])["1R"]', 'ratio[#2] - 1')
    """
    terms = terms_of(targets)
    names = names_of(Excerpt(text, OPTION), subject, terms)
    varied = {one.name for one in terms.targets}
    known = set(varied)
    headings: list[str] = []
    parts: list[ColumnGroup] = []
    problems: list[Problem] = []
    named: dict[str, ResolvedPart] = {}
    for start, stop in items(text):
        own = _NAMED.match(text, start, stop)
        source = Excerpt(text, OPTION, own.end() if own else start, stop)
        try:
            terms = terms._replace(named=named)
            expression, part = resolved_expression(source, subject, terms)
            if own:
                _check_name(own[1], names, own.start(1), {*known, *named})
                named[own[1]] = part
        except ReadError as error:
            problems += error.problems
            if len(problems) >= MOST_PROBLEMS:
                break
            continue
        cells = []
        for cell, heading in _headings(expression, names, terms.targets, own[1] if own else ""):
            if heading in varied and not isinstance(expression.node, VariedNumber):
                heading = f"({heading})"  # noqa: PLW2901 - it is not what is varied
            if heading not in known:
                known.add(heading)
                headings.append(heading)
                cells.append(cell)
        parts.append(ColumnGroup(expression, tuple(cells)))
    if problems:
        raise ReadError(problems)
    return OutputColumns(tuple(headings), tuple(parts), named)


def _check_name(name: str, names: NameFinder, at: int, known: Collection[str]) -> None:
    """Make sure that a column may have a name.

    Raises
    ------
    ReadError
        If it means something else, or another column has it.
    """
    meaning = *BY_NAME, *names.language.functions, *CONSTANTS, OMEGA, *OF_RATIOS, OK
    if name in (*meaning, *output_headings((), ()), GEAR):
        message = f"`{name}` means something already, expected another name"
    elif name in known:
        message = f"two columns are called `{name}`, expected another name"
    else:
        return
    raise names.source.error(message, at)


def output_headings(
    names: Sequence[str], headings: Sequence[str], *, by_gear: bool = False
) -> list[str]:
    """The headings of the output: of variants by varied numbers and columns."""
    return ["variant", *names, "status", *[GEAR] * by_gear, *headings]


def items(text: str) -> Iterator[tuple[int, int]]:
    """The ends of the parts between commas that stand outside brackets and quotes."""
    start, depth, quote = 0, 0, ""
    for at, letter in enumerate(text):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'":
            quote = letter
        elif letter in "([":
            depth += 1
        elif letter in ")]":
            depth -= 1
        elif letter == "," and depth <= 0:
            yield start, at
            start = at + 1
    yield start, len(text)


def _headings(
    expression: Expression, names: NameFinder, targets: Sequence[Varied], own: str
) -> Iterator[tuple[tuple[int, int], str]]:
    """Gear and row of each column, and its heading; `own` is the name that it was given."""
    node, text = expression.node, own or _BLANK.sub(" ", expression.text)
    if isinstance(node, VariedNumber) and not own:
        yield (0, 0), targets[node.column].name
        return
    gears: Sequence[str] = expression.gears or ()
    rows: Sequence[str] = expression.rows or ()
    own_gear = own_row = None
    if isinstance(node, Applied) and node.name == LAST and expression.table:
        (node,) = node.operands
    call = own or (isinstance(node, Applied) and node.name in (*FUNCTIONS, LAST))
    before = text if call else f"({text})"
    if isinstance(node, Selection):  # a heading tells the row and gear that were picked, too
        before = own or expression.table or node.table
        if not own and node.table not in (SPREAD, OK, *PART_NUMBERS.values()):
            gears, rows = names.gears, names.written_rows(node.table)
            own_gear, own_row = node.gear, node.row
    for row in range(len(expression.rows or ("",))):
        for gear in range(len(expression.gears or ("",))):
            picked = ((own_row, row, rows), (own_gear, gear, gears))
            keys = [
                names.key(n if own is None else own, every) for own, n, every in picked if every
            ]
            yield (gear, row), f"{before}[{','.join(keys)}]" if keys else text
