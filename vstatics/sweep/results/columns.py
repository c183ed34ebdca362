"""Parser of --out, a list of expressions: each gives one or more columns with headings."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Problem, ReadError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.evaluation import LAST, TABLE_FUNCTIONS
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.tables.names import NAME, plain_names
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
    """Expression, and the elements of the value that are columns."""

    expression: Expression
    cells: tuple[tuple[int, int], ...]
    """Indices of the gear and the row of each element; 0 for an axis that the value lacks."""


@dataclass(frozen=True)
class OutputColumns:
    """Columns written for each variant.

    Parameters
    ----------
    headings : tuple of str
        Headings, all different.
    parts : tuple of ColumnGroup
        Expressions of the columns, in the order of the headings.
    """

    headings: tuple[str, ...]
    parts: tuple[ColumnGroup, ...]
    named: Mapping[str, ResolvedPart] = field(default_factory=dict)
    """Expressions of named columns, by the name."""

    def __call__(self, tables: Tables, values: Floats) -> Floats:
        """Calculate all columns for an array of variants.

        Parameters
        ----------
        tables : Tables
            `Results` of an array of variants, or another object with their tables.
        values : ndarray, shape (variants, targets)
            The varied numbers. [-]

        Returns
        -------
        ndarray, shape (variants, columns)
            Values, NaN where undefined; each column is contiguous. [-]
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
"""Name and equals sign before the expression of a named column."""


def read_columns(text: str, subject: Subject, targets: Sequence[Varied] | Terms) -> OutputColumns:
    """Read a list of column expressions, separated by commas outside brackets.

    Each expression gives a column for each gear and each row of its table, such as each link. The
    columns of all gears for the first row come first, then the columns for the second row. A
    repeated column is written once. Varied numbers are left out, since they have their own columns.
    ``NAME=EXPR`` names a column; later expressions can use the name.

    Parameters
    ----------
    text : str
    subject : Transmission or VariedScenario
        Case or scenario whose names the text uses.
    targets : sequence of Varied, or Terms
        Varied numbers.

    Raises
    ------
    ReadError
        If the text is invalid, with all errors and their places.

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
    varied = {target.name for target in terms.targets}
    known = set(varied)
    headings: list[str] = []
    parts: list[ColumnGroup] = []
    problems: list[Problem] = []
    named: dict[str, ResolvedPart] = {}
    for start, stop in items(text):
        name_match = _NAMED.match(text, start, stop)
        source = Excerpt(text, OPTION, name_match.end() if name_match else start, stop)
        try:
            terms = terms._replace(named=named)
            expression, part = resolved_expression(source, subject, terms)
            if name_match:
                _check_name(name_match[1], names, name_match.start(1), {*known, *named})
                named[name_match[1]] = part
        except ReadError as error:
            problems += error.problems
            if len(problems) >= MOST_PROBLEMS:
                break
            continue
        cells = []
        for cell, heading in _headings(
            expression, names, terms.targets, name_match[1] if name_match else ""
        ):
            if heading in varied and not isinstance(expression.node, VariedNumber):
                heading = f"({heading})"  # noqa: PLW2901 - unlike the varied number
            if heading not in known:
                known.add(heading)
                headings.append(heading)
                cells.append(cell)
        parts.append(ColumnGroup(expression, tuple(cells)))
    if problems:
        raise ReadError(problems)
    return OutputColumns(tuple(headings), tuple(parts), named)


def _check_name(name: str, names: NameFinder, at: int, known: Collection[str]) -> None:
    """Check that a name is available for a column.

    Raises
    ------
    ReadError
        If the name has another meaning, or another column has the name.
    """
    meanings: dict[str, Collection[str]] = {
        "a table of results": BY_NAME,
        "a function": names.language.functions,
        "a word of formulas": (*CONSTANTS, OMEGA, *OF_RATIOS, OK),
        "a column of every sweep": (*output_headings((), ()), GEAR),
    }
    if meaning := next((what for what, taken in meanings.items() if name in taken), ""):
        message = f"`{name}` already has a meaning: it is {meaning}, expected another name"
    elif name in known:
        message = f"two columns are called `{name}`, expected another name"
    else:
        return
    raise names.source.error(message, at)


def output_headings(
    names: Sequence[str], headings: Sequence[str], *, by_gear: bool = False
) -> list[str]:
    """Return the headings of the output: variant, varied numbers, status, gear, columns."""
    return ["variant", *names, "status", *[GEAR] * by_gear, *headings]


def items(text: str) -> Iterator[tuple[int, int]]:
    """Yield start and end of each part between commas outside brackets and quotes."""
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
    expression: Expression, names: NameFinder, targets: Sequence[Varied], given_name: str
) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield the gear and row of each column of an expression, and the heading."""
    node, text = expression.node, given_name or plain_names(_BLANK.sub(" ", expression.text))
    if isinstance(node, VariedNumber) and not given_name:
        yield (0, 0), targets[node.column].name
        return
    gears: Sequence[str] = expression.gears or ()
    rows: Sequence[str] = expression.rows or ()
    own_gear = own_row = None
    if isinstance(node, Applied) and node.name == LAST and expression.table:
        (node,) = node.operands
    call = given_name or (isinstance(node, Applied) and node.name in (*TABLE_FUNCTIONS, LAST))
    before = text if call else f"({text})"
    # The heading of a selection also contains the chosen row and gear.
    if isinstance(node, Selection):
        before = given_name or expression.table or node.table
        if not given_name and node.table not in (SPREAD, OK, *PART_NUMBERS.values()):
            gears, rows = names.gears, names.written_rows(node.table)
            own_gear, own_row = node.gear, node.row
    for row in range(len(expression.rows or ("",))):
        for gear in range(len(expression.gears or ("",))):
            picked = ((own_row, row, rows), (own_gear, gear, gears))
            keys = [
                names.key(n if given_name is None else given_name, every)
                for given_name, n, every in picked
                if every
            ]
            yield (gear, row), f"{before}[{','.join(keys)}]" if keys else text
