"""Headings of tables of numbers, which contain names with units.

A unit can be in brackets, in parentheses, after `_` or `/`, or after a comma within a cell.
Units can also be in a row below the names. Lines above the headings are titles, even if
they contain numbers. Upper case and comment signs in headings are ignored.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain, islice, pairwise, repeat
from operator import itemgetter
from typing import NamedTuple

from vstatics.core.errors import quoted, spoken
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.shape import UNIT_OF, Measure
from vstatics.core.readers.named.csv_rows import (
    cells_of,
    headings_of,
    placed_cells,
    separator_of,
)
from vstatics.core.readers.named.si_units import measured
from vstatics.core.suggestions import nearest

MOST_TITLE_LINES = 100
"""Largest number of lines in which headings are searched for."""
MOST_QUOTED = 76
"""Maximum number of characters of a line quoted in a message."""
LEAST_LIKENESS = 0.75
"""Smallest similarity (0 to 1) at which a heading is a mistyped name."""
OTHER_SEPARATORS = re.compile(r"[\s|]+")
"""Pattern of characters that separate cells in tables of other programs."""
SEPARATOR_HINT = "; separate the cells by commas, semicolons or tabs"
_COMMENT_SIGNS = ("#", "%")
_IN_ANY_LETTERS: tuple[Measure, ...] = ("time", "velocity")
"""Measures whose units can have any mixture of upper and lower case."""
_UNIT_BEHIND = re.compile(
    r"(?P<name>.*?)\s*"
    r"(?:\[(?P<bracket>[^\[\]]*)\]?|\((?P<round>[^()]*(?:\([^()]*\)[^()]*)*)\)|,(?P<comma>[^,]*))"
)
_OF_NUMBERS = re.compile(r"[-+0-9.,;eE\s\"]*")
_UNIT = re.compile(r"(?!nan|inf)(?:[^\W\d_]|1/|[°%‰])", re.IGNORECASE)
"""Pattern of the beginning of a unit. The texts `nan` and `inf` are undefined numbers."""
_USUAL_UNITS: Mapping[Measure, Sequence[str]] = {
    "time": ("s", "ms", "min", "h"),
    "velocity": ("m/s", "km/h", "mph"),
    "si_speed": ("rad/s", "rpm", "rev/s"),
    "si_torque": ("N*m", "kN*m", "lbf*ft"),
}
"""Units that messages name, by measure. Other measures have only their SI unit."""
_CLOCK = "hh:mm:ss"
"""Unit of a time whose cells are clock times or dates."""
_LONGEST_WITH_UNIT = 200
NumberedLine = tuple[int, str]
"""Number and text of a line."""


class TableColumn(NamedTuple):
    """Declaration of a column that a table can have."""

    name: str
    measure: Measure | None = None
    """Measure of the numbers, converted to SI; `None` for texts and numbers without a unit."""
    is_text: bool = False
    optional: bool = False
    may_be_bare: bool = False
    """True if a heading without a unit means the SI unit."""
    usual: str = ""
    """Unit that messages suggest; empty for the SI unit."""
    any_unit: bool = False
    """True if the column can have any unit, which does not change the numbers."""
    meaning: str = ""
    """Hint that ends the message about a wrong unit."""
    sizes: Mapping[str, float] | None = None
    """Permitted units and factors to SI, for a column without a measure."""
    aliases: Mapping[str, str] = EMPTY
    """Alternative names in lower case, with the unit that each name implies (or an empty text)."""

    @property
    def heading(self) -> str:
        """Heading of the column with a unit.

        >>> TableColumn("speed", "si_speed").heading
        'speed [rad/s]'
        """
        if self.sizes:
            unit = next(iter(self.sizes))
            return f"{self.name} [{unit}]" if unit else self.name
        return f"{self.name} [{self.usual or UNIT_OF[self.measure]}]" if self.measure else self.name

    def accepts(self, unit: str | None) -> bool:
        """Return whether a text is a unit of the column, or whether it can be missing.

        >>> TableColumn("speed", "velocity").accepts("limit")
        False
        """
        try:
            return bool(self.size(unit))
        except ValueError:
            return False

    def size(self, unit: str | None) -> float:
        """Return the factor from a unit to SI, for a heading with or without a unit.

        Raises
        ------
        ValueError
            The message states the expectation.
        """
        if self.any_unit:
            return 1.0
        if self.sizes is not None or self.measure is None:
            sizes = {"": 1.0, "-": 1.0} if self.sizes is None else self.sizes
            if (unit or "") not in sizes or (unit == "" and self.sizes is None):
                spelled = [(size, unit) for unit, size in (self.sizes or {}).items() if unit]
                spellings = dict(reversed(spelled))
                units = spoken([*map(quoted, spellings.values())][::-1], "or") or "none"
                message = f"{self.name}: read the unit {(unit or '')[:40]!r}, expected {units}"
                raise ValueError(message + self.meaning)
            return sizes[unit or ""]
        if unit is None and self.may_be_bare:
            return 1.0
        if not unit:
            raise ValueError(f"{self.name}: its unit is missing, such as {quoted(self.heading)}")
        try:
            return _size_of(unit, self.measure)
        except ValueError as error:
            raise ValueError(f"{self.name}: read the unit {unit[:40]!r}, {error}") from None


_ENGINES = ("engine", "motor", "machine", "input", "shaft")
_SPEEDS = ("n", "omega", "ω", "w", "rotational speed", "angular speed", "angular velocity")
SHAFT_COLUMNS = (
    TableColumn(
        "speed",
        "si_speed",
        usual="rpm",
        aliases=dict.fromkeys((*_SPEEDS, *(f"{engine} speed" for engine in _ENGINES)), "")
        | {"rpm": "rpm"},
    ),
    TableColumn(
        "torque",
        "si_torque",
        aliases=dict.fromkeys(("m", "t", *(f"{engine} torque" for engine in _ENGINES)), "")
        | {"nm": "N*m"},
    ),
)
"""Columns for the speed and torque of a shaft, in this order."""


def _size_of(unit: str, measure: Measure) -> float:
    """Return the factor from a unit to SI; upper and lower case count as in `_IN_ANY_LETTERS`.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> _size_of("KM/H", "velocity") == _size_of("km/h", "velocity"), _size_of("MS", "time")
    (True, 0.001)
    """
    if measure == "time" and unit.casefold() == _CLOCK:
        return 1.0
    usual = _USUAL_UNITS.get(measure, (UNIT_OF[measure],))
    try:
        return measured(f"1 {unit}", measure, units=usual)
    except ValueError:
        if measure not in _IN_ANY_LETTERS or unit == unit.casefold():
            raise
        with suppress(ValueError):
            return measured(f"1 {unit.casefold()}", measure)
        raise


class Heading(NamedTuple):
    """Heading of a column that the reader uses."""

    column: TableColumn
    place: int
    """Index of the column in a row."""
    unit: str | None
    """Unit in the heading, if any."""

    @property
    def size(self) -> float:
        """Factor from the unit to SI."""
        return self.column.size(self.unit)


class HeadingLine(NamedTuple):
    """Line with the headings of a table."""

    number: int
    last: int
    """Number of the row of units below the headings; without such a row, the same as `number`."""
    separator: str
    headings: Sequence[Heading]
    width: int
    """Number of cells in the line of headings, including skipped columns."""
    skipped: Sequence[str]
    """Headings of columns that the reader does not use."""


class HeadingError(ValueError):
    """Error in the headings or in the units below them, with line and column from 1."""

    def __init__(self, message: str, line: int, column: int = 1) -> None:
        super().__init__(message)
        self.line = line
        self.column = column


class CellError(ValueError):
    """Error in a cell, with the index of the cell."""

    def __init__(self, message: str, place: int) -> None:
        super().__init__(message)
        self.place = place


def with_unit(cell: str) -> tuple[str, str | None]:
    """Split a heading into name and unit.

    Examples
    --------
    >>> [with_unit(cell) for cell in ("time [s]", "Speed / (km/h)", "Test Time, secs", "gear")]
    [('time', 's'), ('Speed', 'km/h'), ('Test Time', 'secs'), ('gear', None)]
    """
    parts = _UNIT_BEHIND.fullmatch(cell.strip()) if len(cell) <= _LONGEST_WITH_UNIT else None
    if not parts:
        return cell.strip(), None
    unit = next(part for part in parts.group("bracket", "round", "comma") if part is not None)
    return parts["name"].rstrip(" /"), unit.strip()


def read_headings(
    lines: Iterable[NumberedLine],
    what: str,
    columns: Sequence[TableColumn],
    *,
    skips: bool,
) -> HeadingLine:
    """Return the line of headings of a table.

    Parameters
    ----------
    lines : iterable of (int, str)
        First non-empty lines of the file, with their line numbers.
    what : str
        Kind of the table, in words: ``a duty cycle``.
    columns : sequence of TableColumn
        Columns that the table can have, in any order.
    skips : bool
        True if columns with other names are skipped, not reported.

    Raises
    ------
    HeadingError
        The message states what was read and expected.

    Examples
    --------
    >>> columns = [TableColumn("time", "time"), TableColumn("speed", "velocity")]
    >>> lines = ["City cycle, 2 rows", "Time (s),Speed (mph),Phase", "0,0,1"]
    >>> head = read_headings(enumerate(lines, 1), "a cycle", columns, skips=True)
    >>> head.number, [heading.unit for heading in head.headings], head.skipped
    (2, ['s', 'mph'], ['Phase'])
    """
    return _ExpectedTable(what, columns, skips).headings(list(islice(lines, MOST_TITLE_LINES)))


def without_titles(lines: Sequence[str], is_heading: Callable[[str], bool]) -> Iterator[str]:
    """Yield the lines of a table, with empty lines for titles.

    If no cell is a known heading, the headings are above the numbers and a row of units.

    Examples
    --------
    >>> list(without_titles(["Test 7", "Speed (rpm)", "5"], lambda cell: "Speed" in cell))
    ['', 'Speed (rpm)', '5']
    """
    top = lines[:MOST_TITLE_LINES]
    known = (at for at, _, cells in _heading_lines(top) if any(map(is_heading, cells)))
    head = next(known, None)
    if head is None:
        head = _above_numbers(top)
    return chain(repeat("", head), islice(lines, head, None))


class _ExpectedTable(NamedTuple):
    """Expected table, by which a line of headings is recognised."""

    what: str
    columns: Sequence[TableColumn]
    skips: bool

    def headings(self, lines: Sequence[NumberedLine]) -> HeadingLine:
        """Return the first line with all required columns, or report errors of the best line."""
        if not lines:
            raise HeadingError(f"read nothing, expected {self.what}", 1)
        candidates = []
        required = {column.name for column in self.columns if not column.optional}
        for at, separator, cells in _heading_lines([line for _, line in lines]):
            known = {heading.column.name for heading in self.understood(cells)}
            if known >= required:
                return self.checked(lines, at, separator, cells)
            candidates.append((len(known), at, separator, cells))
        most, at, separator, cells = max(candidates, key=itemgetter(0))  # the first of equal lines
        if not most:
            texts = [line for _, line in lines]
            apart = map(OTHER_SEPARATORS.split, texts)
            apart_at = (n for n, row in enumerate(apart) if len(self.understood(row)) > 1)
            at = next(apart_at, _above_numbers(texts))
            separator, cells = next(_split(lines[at][1]))
        return self.checked(lines, at, separator, cells)

    def understood(self, cells: Sequence[str]) -> list[Heading]:
        """Return the known headings among cells, in order.

        Of several headings of a column, those with a unit of another measure are not known.
        """
        found = (self.heading(cell, place) for place, cell in enumerate(cells))
        headings = [heading for heading in found if heading]
        fitting = [heading for heading in headings if heading.column.accepts(heading.unit)]
        names = {heading.column.name for heading in fitting}
        return [
            heading
            for heading in headings
            if heading in fitting or heading.column.name not in names
        ]

    def heading(self, cell: str, place: int) -> Heading | None:
        """Return the heading in a cell; None if its name is unknown."""
        name, unit = with_unit(cell)
        known = self.named(name, unit)
        if known is None and unit is None:
            for front, sign, behind in (name.partition("/"), name.rpartition("_")):
                named = self.named(front, behind.strip())
                if known is None and named and (sign == "_" or named[0].accepts(behind.strip())):
                    known, unit = named, behind.strip()
        if known is None:
            return None
        column, implied = known
        return Heading(column, place, implied or None if unit is None else unit)

    def named(self, name: str, unit: str | None) -> tuple[TableColumn, str] | None:
        """Return the column with a name or alias, and the unit that the alias implies.

        If several columns have the name, such as `t` for time and torque, the unit decides.
        Without a unit, `t` is the time and `T` the torque.
        """
        folded = _folded(name)
        known = [
            (column, column.aliases.get(folded, ""))
            for column in self.columns
            if folded == column.name or folded in column.aliases
        ]
        if unit is None and name == "T":
            known = known[-1:]
        fitting = (pair for pair in known if pair[0].accepts(unit))
        return next(fitting, known[0] if known else None)

    def checked(
        self, lines: Sequence[NumberedLine], at: int, separator: str, cells: Sequence[str]
    ) -> HeadingLine:
        """Return the headings of a line, whose names and units are checked.

        Raises
        ------
        HeadingError
            The message states the text that was read, and the expected headings.
        """
        number, line = lines[at]
        headings = self.understood(cells)
        places = {heading.place for heading in headings}
        others = [cell for place, cell in enumerate(cells) if place not in places]
        try:
            self.check_names(headings, others)
        except ValueError as error:
            raise HeadingError(f"{error}{_quoted_lines(lines, at)}", number) from None
        last, below = number, lines[at + 1 :]
        for index, (row_number, row) in enumerate(below, 1):
            try:
                with_units = with_units_below(headings, cells_of(row, separator))
            except CellError as error:
                column = _column(row, separator, error.place)
                raise HeadingError(str(error), row_number, column) from None
            if with_units:
                headings, last, below = with_units, row_number, below[index:]
                break
            if not is_comment(row):
                break
        headings = _with_clock(headings, below, separator)
        if fault := _fault_of_units(headings):
            column = _column(line, separator, fault.place)
            raise HeadingError(f"{fault}{_quoted_lines(lines, at)}", number, column)
        return HeadingLine(number, last, separator, headings, len(cells), others)

    def check_names(self, headings: Sequence[Heading], others: Sequence[str]) -> None:
        """Check that each required column occurs once, without unknown headings.

        Raises
        ------
        ValueError
            The message states the heading that was read, and the expected headings.
        """
        from difflib import get_close_matches  # costs start-up time

        names = [heading.column.name for heading in headings]
        lacking = [column for column in self.columns if column.name not in names]
        missing = [column.heading for column in lacking if not column.optional]
        wanted = [column.name for column in lacking]
        aliases = [alias for column in lacking for alias in (*column.aliases, column.name)]
        # a distance <s> is not a mistyped time <t>
        known = [alias for alias in aliases if not alias.startswith("<")]
        # Tables of R and pandas have no heading above row numbers.
        for cell in filter(None, others):
            name = _folded(with_unit(cell)[0])
            hint = nearest(name, known)
            is_mistyped = get_close_matches(name, wanted, cutoff=LEAST_LIKENESS)
            if is_mistyped or missing or not self.skips:
                expected = spoken([quoted(column.heading) for column in self.columns], "or")
                if len(self.understood(OTHER_SEPARATORS.split(cell))) > 1:
                    hint = SEPARATOR_HINT
                raise ValueError(f"read the heading {cell[:40]!r}, expected {expected}{hint}")
        if twice := next((name for name in names if names.count(name) > 1), None):
            raise ValueError(f"two columns are called {quoted(twice)}")
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            raise ValueError(f"{spoken(map(quoted, missing))} {verb} missing, expected {self.what}")


def _fault_of_units(headings: Sequence[Heading]) -> CellError | None:
    """Return an error about the first wrong or missing unit, if any."""
    for heading in headings:
        try:
            _ = heading.size
        except ValueError as error:
            return CellError(str(error), heading.place)
    return None


def with_units_below(headings: Sequence[Heading], row: Sequence[str]) -> list[Heading]:
    """Return headings with the units of the row below; empty if that is not a row of units.

    A row of units contains no numbers, and at least one unit of its column or of time. If a heading
    lacks its unit, a row of other words is also read as units. All units in a comment must fit
    their columns.

    Raises
    ------
    CellError
        If a unit does not fit its column, or differs from the unit in the heading.

    Examples
    --------
    >>> headings = [Heading(TableColumn("time", "time"), 0, None)]
    >>> [heading.unit for heading in with_units_below(headings, ["[ms]", "rpm"])]
    ['ms']
    """
    words = {heading.place for heading in headings if heading.column.is_text}
    first, *others = row
    bare = enumerate(cell.strip("[]() -") for cell in (without_sign(first), *others))
    cells = {place: cell for place, cell in bare if cell and place not in words}
    given = [(heading, cells[heading.place]) for heading in headings if heading.place in cells]
    fitting = [heading.column.any_unit or heading.column.accepts(cell) for heading, cell in given]
    lacks_units = _fault_of_units(headings) is not None
    if is_comment(first):
        are_units = lacks_units and all(fitting)
    else:
        has_time = any(map(TableColumn("time", "time").accepts, cells.values()))
        are_units = lacks_units or has_time or any(fitting)
    if not (cells and are_units and all(_UNIT.match(cell) for _, cell in given)):
        return []
    units = {}
    for heading, cell in given:
        try:
            size = heading.column.size(cell)
        except ValueError as error:
            raise CellError(str(error), heading.place) from None
        if heading.column.any_unit:
            differs = heading.unit != cell
        else:
            differs = heading.column.accepts(heading.unit) and heading.size != size
        if heading.unit and differs:
            message = f"read the unit {cell!r} below the unit {heading.unit!r}, expected one unit"
            raise CellError(f"{heading.column.name}: {message}", heading.place)
        units[heading.place] = cell
    return [heading._replace(unit=heading.unit or units.get(heading.place)) for heading in headings]


def _column(line: str, separator: str, place: int) -> int:
    """Return the column of a cell, from 1; the end of the line for a cell that does not exist."""
    columns = [column for _, column in placed_cells(line, separator)]
    return columns[place] if place < len(columns) else len(line) + 1


def _with_clock(
    headings: Sequence[Heading], below: Sequence[NumberedLine], separator: str
) -> list[Heading]:
    """Return headings in which a time above a clock time or a date has the unit of clock times."""
    row = next((cells_of(line, separator) for _, line in below if not is_comment(line)), [])
    clocks = {at for at, cell in enumerate(row) if ":" in cell and cell.strip()[:1].isdigit()}
    return [
        heading._replace(unit=_CLOCK)
        if heading.column.measure == "time" and heading.unit is None and heading.place in clocks
        else heading
        for heading in headings
    ]


def _heading_lines(lines: Sequence[str]) -> Iterator[tuple[int, str, list[str]]]:
    """Yield index, separator and cells of each line, for each possible separator."""
    for at, line in enumerate(lines):
        for separator, cells in _split(line):
            yield at, separator, cells


def _split(line: str) -> Iterator[tuple[str, list[str]]]:
    """Yield the cells of a line of headings for each possible separator."""
    bare = without_sign(line)
    for separator in dict.fromkeys((separator_of(bare), ";" if ";" in bare else ",")):
        yield separator, headings_of(cells_of(bare, separator))


def without_sign(line: str) -> str:
    """Return a line without the comment signs with which it begins.

    >>> without_sign("# speed [rpm]"), without_sign("speed [rpm]")
    ('speed [rpm]', 'speed [rpm]')
    """
    bare = line.strip()
    return bare.lstrip("".join(_COMMENT_SIGNS)).strip() if is_comment(line) else line


def is_comment(line: str) -> bool:
    """Return whether a line is a comment."""
    return line.lstrip().startswith(_COMMENT_SIGNS)


def is_row_of_numbers(line: str) -> bool:
    """Return whether a line has numbers and no words.

    >>> is_row_of_numbers("-2.5; 1e3"), is_row_of_numbers("speed 2")
    (True, False)
    """
    return bool(_OF_NUMBERS.fullmatch(line)) and any(sign.isdigit() for sign in line)


def _above_numbers(lines: Sequence[str]) -> int:
    """Return the index of the headings of the (first) longest row of numbers; 0 without numbers.

    It is the line above the row of numbers, or the line above that line if both have equally many
    cells, because the lower line can be a row of units.
    """
    above = [
        at
        for at, (line, below) in enumerate(pairwise(lines))
        if is_row_of_numbers(below) and not is_row_of_numbers(line)
    ]
    at = max(above, key=lambda at: len(next(_split(lines[at + 1]))[1]), default=0)
    separator = separator_of(lines[at]) if at else ","
    return at - bool(at and lines[at - 1].count(separator) == lines[at].count(separator) > 0)


def _folded(name: str) -> str:
    return " ".join(name.casefold().replace("_", " ").split())


def _quoted_lines(lines: Sequence[NumberedLine], at: int) -> str:
    below = [line for _, line in lines[at + 1 :] if is_row_of_numbers(line)]
    head, *row = (" ".join(line.split())[:MOST_QUOTED] for line in (lines[at][1], *below[:1]))
    first = "".join(f", the first row `{cells}`" for cells in row)
    return f"; the line of the headings is `{head}`{first}"
