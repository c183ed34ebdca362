"""Table of cells, each with a text and a value.

The modules `text`, `markdown`, `latex`, `html` and `terminal` write the texts. `csv` and `xlsx`
write the values.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from operator import attrgetter
from typing import Any, NamedTuple

from vstatics.core.numerics.tolerances import ROUNDED_PART
from vstatics.core.tables.numbers import certain, places, rounded
from vstatics.core.texts import heading, labelled, spoken, title, tr

NOTHING = "-"
"""Text for a number that does not exist, and for an empty list."""
LARGE_CELL = 1e7
"""Magnitude from which numbers are written with a power of ten."""
CELL_DECIMALS = 9
"""Largest number of decimals; smaller numbers are written with a power of ten."""
YES, NO = "●", "·"


class Column(NamedTuple):
    """Column of a table."""

    heading: str
    is_number: bool = True
    is_sign: bool = False
    """True for a column of single signs, such as dots, which is narrow at a terminal."""
    over: str = ""
    """Common heading in HTML above the headings of adjacent columns with the same `over`."""
    is_name: bool = False
    """True if the heading is a name from the case, which is not translated.

    Headings below `over` are always names.
    """


Datum = float | int | bool | str | None
"""Value of a cell in data formats; None if missing."""


class Cell(NamedTuple):
    """Cell of a table: a text for people, and a value for data formats."""

    text: str
    value: float | None = None
    """Number before rounding, NaN if missing. For words, the sorting key."""
    says: str = ""
    """Meaning of a sign, for screen readers."""
    style: str = ""
    """Colour at a terminal, in the words of the package `rich`."""
    kind: type[Any] = str
    """Type of the value in data formats; str for words."""
    marks: Mapping[str, str] = {}
    """HTML data attributes for the scripts of a page."""
    is_said: bool = False
    """True for a translated word of the program, False for a name from the case."""
    written_as: str = ""
    """Word in data formats; empty if equal to the text."""
    look: str = ""
    """Additional HTML class of the cell."""
    math: str = ""
    """Formula in LaTeX math mode, instead of the text."""

    @property
    def datum(self) -> Datum:
        """Value of the cell in data formats, with all digits."""
        if self.kind is str:
            return None if self.text in ("", NOTHING) else self.written_as or self.text
        known = self.value is not None and not math.isnan(self.value)
        return self.kind(self.value) if known else None

    @property
    def spoken(self) -> Cell:
        """Cell in the language of the output, including the meaning of a sign."""
        if spoken() == "en":
            return self
        text = labelled(self.text) if self.is_said else self.text
        return self._replace(text=text, says=tr(self.says))


Row = list[Cell | str]
"""Cells of a row. A plain text is a cell of words."""


class Grid(NamedTuple):
    """Table of cells. The first column contains the names of the rows."""

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell | str]]
    levels: Sequence[int] = ()
    """Level of each row in a hierarchy, from 1. Rows of higher levels are indented."""
    key: str = ""
    """Short unique name, for a table with a long title."""
    group: str = ""
    """Name of the sheet that several tables of a workbook share; empty for a separate sheet."""
    prose: str = ""
    """LaTeX text with formulas, for a table that is only a sentence (the title)."""

    @property
    def cells(self) -> list[list[Cell]]:
        """Rows of cells; plain texts are converted to cells of words."""
        return [[x if isinstance(x, Cell) else Cell(x) for x in row] for row in self.rows]

    @property
    def texts(self) -> list[list[str]]:
        """Texts of all rows."""
        return [[cell.text for cell in row] for row in self.cells]

    @property
    def data(self) -> list[list[Datum]]:
        """Values of all cells. The first cell of a row is a name."""
        named = bool(self.columns) and not self.columns[0].is_number
        return [
            [cell.text if named and not place else cell.datum for place, cell in enumerate(row)]
            for row in self.cells
        ]

    @property
    def spoken(self) -> Grid:
        """Table in the language of the output, for texts only; data formats stay English.

        >>> from vstatics.core.texts import speaking
        >>> with speaking("ru"):
        ...     grid_of("Gears", ["gear", "state"], [["R", word("unloaded")]]).spoken.texts
        [['R', 'без нагрузки']]
        """
        if spoken() == "en":
            return self
        columns = [
            column._replace(
                heading=column.heading
                if column.over or column.is_name
                else heading(column.heading),
                over=heading(column.over) if column.over else "",
            )
            for column in self.columns
        ]
        translated = self._replace(title=title(self.title), columns=columns)
        return translated.changed(attrgetter("spoken"))

    def with_columns(self, chosen: Sequence[int]) -> Grid:
        """Return the table with only some columns, by index."""
        rows = [[row[place] for place in chosen] for row in self.rows]
        return self._replace(columns=[self.columns[place] for place in chosen], rows=rows)

    def changed(self, change: Callable[[Cell], Cell]) -> Grid:
        """Return the table with a function applied to all cells."""
        return self._replace(rows=[list(map(change, row)) for row in self.cells])

    def with_digits(self, digits: int | None) -> Grid:
        """Return the table with `digits` decimals; unchanged if None.

        Blank cells stay blank, and words before a number stay.
        """
        if digits is None:
            return self

        def rewritten(cell: Cell) -> Cell:
            if cell.kind is not float or not cell.text:
                return cell
            words, space, _ = cell.text.rpartition(" ")
            number = exact(cell.value, digits=digits).text
            return cell._replace(text=f"{words}{space}{number}")

        return self.changed(rewritten)


Value = Cell | Datum | Sequence[str]
"""Value from which `grid_of` creates a cell."""
Values = Sequence[Value]
"""Values of a new row."""


def grid_of(
    title: str,
    headings: Iterable[str | Column],
    rows: Iterable[Iterable[Value]],
    *,
    key: str = "",
    optional: Collection[str] = (),
) -> Grid:
    """Return a table of plain values. A column without numbers is a column of words.

    Parameters
    ----------
    title, key : str
        Title and key of the `Grid`.
    headings : iterable of str or Column
    rows : iterable of iterable
        Values of the cells.
    optional : collection of str
        Headings of columns that are omitted if all their cells are empty.

    Examples
    --------
    >>> grid = grid_of("Gears", ["gear", "ratio", "note"], [["1", 3.5, ""]], optional=["note"])
    >>> grid.columns[0] == text("gear"), grid.columns[1] == Column("ratio"), grid.texts
    (True, True, [['1', '3.500']])
    """
    filled = dict(enumerate(zip(*[[_cell(value) for value in row] for row in rows], strict=True)))
    columns = []
    cells = []
    for place, head in enumerate(headings):
        column = filled.get(place, ())
        if head in optional and all(cell.text in ("", NOTHING) for cell in column):
            continue
        is_number = any(cell.kind is not str for cell in column)
        columns.append(Column(head, is_number) if isinstance(head, str) else head)
        cells.append(column)
    return Grid(title, columns, list(map(list, zip(*cells, strict=True))), key=key)


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
    """Return a column of words."""
    return Column(heading, is_number=False)


def word(text: str) -> Cell:
    """Return a cell with an English word of the program, which `Grid.spoken` translates."""
    return Cell(text, is_said=True)


def exact(
    value: float | None, decimals: int = 3, *, digits: int | None = None, largest: float = 0.0
) -> Cell:
    """Return a cell with a rounded number as text, and all digits as value.

    Parameters
    ----------
    value : float or None
        Number; None if it does not exist.
    decimals : int
        Usual number of decimals. Small numbers have more, up to 9; see `rounded`.
    digits : int, optional
        Number of decimals, for numbers of any size.
    largest : float
        Largest number of the same kind. Numbers below a billionth of this are shown as 0.

    Examples
    --------
    >>> exact(0.98765)[:2], exact(-1.5e9).text, exact(None).text, exact(-0.01038).text
    (('0.988', 0.98765), '-1.5e+09', '-', '-0.01038')
    >>> exact(2e-8, largest=1000)[:2], exact(-8.529e-10).text, exact(1e-6).text
    (('0.000', 2e-08), '-8.529e-10', '0.000001000')
    """
    known = math.nan if value is None else value
    if not math.isfinite(known):
        return Cell(NOTHING, math.nan, kind=float)
    if abs(certain(known)) >= LARGE_CELL:
        text = f"{known:.6g}" if digits is None else f"{known:.{digits}e}"
    else:
        shown = 0.0 if abs(known) < ROUNDED_PART * largest else known
        text = rounded(shown, decimals, digits)
        if digits is None and places(shown, decimals) > CELL_DECIMALS:
            text = f"{shown:.3e}"
    return Cell(text, known, kind=float)


def whole(value: float) -> Cell:
    """Return a cell with a whole number, such as a count or a sign +1; NaN if undefined.

    >>> whole(-1.0)[:2], whole(-1.0).datum
    (('-1', -1.0), -1)
    """
    if math.isnan(value):
        return Cell(NOTHING, math.nan, kind=int)
    return Cell(f"{value:.0f}", value, kind=int)


def sign(value: float) -> Cell:
    """Return a cell with a dot for yes (1) or no (0); NaN means unknown."""
    if math.isnan(value):
        return Cell(NOTHING, math.nan, kind=bool)
    return Cell(YES, 1.0, "yes", kind=bool) if value else Cell(NO, 0.0, "no", kind=bool)


def words(names: Sequence[str]) -> str:
    """Return the text of a cell that lists names."""
    return ", ".join(names) or NOTHING
