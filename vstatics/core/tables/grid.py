"""A table of texts, which each format writes in its own way.

Plain text is `text`, then there are `markdown`, `latex`, `html` and, for a person at a
terminal, `terminal`. `csv` and `xlsx` write the numbers behind the texts.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from operator import attrgetter
from typing import Any, NamedTuple

from vstatics.core.numerics.tolerances import ROUNDED_PART
from vstatics.core.tables.numbers import certain, rounded
from vstatics.core.texts import heading, labelled, spoken, title, tr

NOTHING = "-"
"""Stands for a number that does not exist, and for a list of nothing."""
LARGE_CELL = 1e7
"""From here on numbers that keep their digits are written with a power of ten."""
YES, NO = "●", "·"


class Column(NamedTuple):
    """A column of a grid."""

    heading: str
    is_number: bool = True
    is_sign: bool = False
    """Of one sign in each row: such columns stand close together at a terminal."""
    over: str = ""
    """What a page writes over it, and over those beside it of which the same is told."""
    is_name: bool = False
    """Whether its heading is a name of the case, as all are that have something over them."""


Datum = float | int | bool | str | None
"""What a cell stands for; None does not exist."""


class Cell(NamedTuple):
    """A cell of which more is known than its text."""

    text: str
    value: float | None = None
    """What the text is rounded from, NaN for what does not exist; by it words are sorted, too."""
    says: str = ""
    """What a sign means, for those who do not see it."""
    style: str = ""
    """Its colour at a terminal, as `rich` names it."""
    kind: type[Any] = str
    """Of what it stands for: float, int, bool; str of words."""
    marks: Mapping[str, str] = {}
    """What a page writes at it as data, for a script."""
    is_said: bool = False
    """Whether its text is no name of the case but of this program, which has it in languages."""
    written_as: str = ""
    """The word of formats of data, where readers have a better one as its text."""
    look: str = ""
    """A class that a page gives it besides."""
    math: str = ""
    """The same for LaTeX in math mode, if it is a formula."""

    @property
    def datum(self) -> Datum:
        """What it stands for, with all digits."""
        if self.kind is str:
            return None if self.text in ("", NOTHING) else self.written_as or self.text
        known = self.value is not None and not math.isnan(self.value)
        return self.kind(self.value) if known else None

    @property
    def spoken(self) -> Cell:
        """The same in the language that is spoken; what a sign means is no name."""
        if spoken() == "en":
            return self
        text = labelled(self.text) if self.is_said else self.text
        return self._replace(text=text, says=tr(self.says))


Row = list[Cell | str]
"""Cells; one of words may be its text alone."""


class Grid(NamedTuple):
    """A table of texts; the first column names the rows."""

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell | str]]
    levels: Sequence[int] = ()
    """How far each row is set in, from 1: it stays below the row that it belongs to."""
    key: str = ""
    """A short name, unlike that of other tables, where the title is long."""
    group: str = ""
    """What it shares a sheet of a workbook with; nothing: it has one of its own."""
    prose: str = ""
    """Its title for LaTeX, formulas in math mode, where that is a sentence and it has no rows."""

    @property
    def cells(self) -> list[list[Cell]]:
        """The rows, where a text alone is a cell of words."""
        return [[one if isinstance(one, Cell) else Cell(one) for one in row] for row in self.rows]

    @property
    def texts(self) -> list[list[str]]:
        """The texts of all rows."""
        return [[cell.text for cell in row] for row in self.cells]

    @property
    def data(self) -> list[list[Datum]]:
        """What the cells of all rows stand for; the name of a row is as it is written."""
        named = bool(self.columns) and not self.columns[0].is_number
        rows = [[cell.datum for cell in row] for row in self.cells]
        return [
            [row[0].text, *data[1:]] if named else data
            for row, data in zip(self.cells, rows, strict=True)
        ]

    @property
    def spoken(self) -> Grid:
        """The same in the language that is spoken, for those who read it; data stay English.

        >>> from vstatics.core.texts import speaking
        >>> with speaking("ru"):
        ...     grid_of("Gears", ["gear", "state"], [["R", word("idle")]]).spoken.texts
        [['R', 'без нагрузки']]
        """
        if spoken() == "en":
            return self
        columns = [
            one._replace(
                heading=one.heading if one.over or one.is_name else heading(one.heading),
                over=heading(one.over) if one.over else "",
            )
            for one in self.columns
        ]
        made = self._replace(title=title(self.title), columns=columns)
        return made.changed(attrgetter("spoken"))

    def with_columns(self, chosen: Sequence[int]) -> Grid:
        """The same with some of its columns."""
        rows = [[row[place] for place in chosen] for row in self.rows]
        return self._replace(columns=[self.columns[place] for place in chosen], rows=rows)

    def changed(self, change: Callable[[Cell], Cell]) -> Grid:
        """The same with other cells in place of its own."""
        return self._replace(rows=[list(map(change, row)) for row in self.cells])

    def with_digits(self, digits: int | None) -> Grid:
        """The same with so many digits after the point; None: with those that suit a number.

        What is blank stays so.
        """
        if digits is None:
            return self

        def again(cell: Cell) -> Cell:
            if cell.kind is not float or not cell.text:
                return cell
            return exact(cell.value, digits=digits)._replace(style=cell.style)

        return self.changed(again)


Value = Cell | Datum | Sequence[str]
"""What a cell is made of: a float is exact, an int whole, a bool a sign, a sequence words."""
Values = Sequence[Value]
"""What a row is made of."""


def grid_of(
    title: str,
    headings: Iterable[str | Column],
    rows: Iterable[Iterable[Value]],
    *,
    key: str = "",
    optional: Collection[str] = (),
) -> Grid:
    """A grid of plain values; a column without any number is one of words.

    Parameters
    ----------
    title, key : str
        As of `Grid`.
    headings : iterable of str or Column
    rows : iterable of iterables
    optional : collection of str
        Headings of columns that are left out where they say nothing.

    Examples
    --------
    >>> grid = grid_of("Gears", ["gear", "ratio", "note"], [["1", 3.5, ""]], optional=["note"])
    >>> grid.columns[0] == text("gear"), grid.columns[1] == Column("ratio"), grid.texts
    (True, True, [['1', '3.500']])
    """
    made = dict(enumerate(zip(*[[_cell(value) for value in row] for row in rows], strict=True)))
    columns: list[Column] = []
    kept: list[Sequence[Cell]] = []
    for place, head in enumerate(headings):
        column = made.get(place, ())
        if head in optional and all(cell.text in ("", NOTHING) for cell in column):
            continue
        is_number = any(cell.kind is not str for cell in column)
        columns.append(Column(head, is_number) if isinstance(head, str) else head)
        kept.append(column)
    return Grid(title, columns, list(map(list, zip(*kept, strict=True))), key=key)


def _cell(value: Value) -> Cell:
    if isinstance(value, Cell):
        return value
    if isinstance(value, str):
        return Cell(value)
    if isinstance(value, bool):
        return sign(value)
    if isinstance(value, int):
        return whole(value)
    return exact(value) if value is None or isinstance(value, float) else Cell(words(value))


def text(heading: str) -> Column:
    """A column of words."""
    return Column(heading, is_number=False)


def word(text: str) -> Cell:
    """A cell that says a word of this program, in English; see `Grid.spoken`."""
    return Cell(text, is_said=True)


def exact(
    value: float | None, decimals: int = 3, *, digits: int | None = None, beside: float = 0.0
) -> Cell:
    """A number as a cell that keeps all its digits; None does not exist.

    Parameters
    ----------
    decimals : int
        Digits after the point; a small number has more, see `rounded`.
    digits : int, optional
        As many in any number.
    beside : float
        A larger number of its kind; a billionth part of it is shown as 0.

    Examples
    --------
    >>> exact(0.98765)[:2], exact(-1.5e9).text, exact(None).text, exact(-0.01038).text
    (('.988', 0.98765), '-1.5e+09', '-', '-.01038')
    >>> exact(2e-8, beside=1000)[:2]
    ('.000', 2e-08)
    """
    known = math.nan if value is None else value
    if not math.isfinite(known):
        return Cell(NOTHING, math.nan, kind=float)
    if abs(certain(known)) >= LARGE_CELL:
        text = f"{known:.6g}" if digits is None else f"{known:.{digits}e}"
    else:
        text = rounded(0.0 if abs(known) < ROUNDED_PART * beside else known, decimals, digits)
    return Cell(text, known, kind=float)


def whole(value: float) -> Cell:
    """A whole number as a cell: a count, or one of signs; NaN does not exist.

    >>> whole(-1.0)[:2], whole(-1.0).datum
    (('-1', -1.0), -1)
    """
    if math.isnan(value):
        return Cell(NOTHING, math.nan, kind=int)
    return Cell(f"{value:.0f}", value, kind=int)


def sign(value: float) -> Cell:
    """A dot for what is so; NaN where it is unknown."""
    if math.isnan(value):
        return Cell(NOTHING, math.nan, kind=bool)
    return Cell(YES, 1.0, "yes", kind=bool) if value else Cell(NO, 0.0, "no", kind=bool)


def words(names: Sequence[str]) -> str:
    """Names as a cell."""
    return ", ".join(names) or NOTHING
