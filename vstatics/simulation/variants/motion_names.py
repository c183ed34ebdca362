"""Names in expressions of a sweep over runs: tables of runs, and numbers of the scenario."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from vstatics.core.errors import Place, listed, quoted, typed_number
from vstatics.core.model.paths import by_name, dotted
from vstatics.core.readers.expressions.evaluation import LAST, TABLE_FUNCTIONS
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Language
from vstatics.core.readers.expressions.operands import Constant, DottedName, Subscript, TableName
from vstatics.core.suggestions import nearest
from vstatics.core.tables.names import written
from vstatics.simulation.record.row_names import Kind
from vstatics.simulation.variants.motion_tables import TABLES, along_time
from vstatics.simulation.variants.numbers import ScenarioNumbers
from vstatics.sweep.results.meanings import PART_NUMBERS, Selection, VariedNumber
from vstatics.sweep.variants.targets import Varied, target

LANGUAGE = Language(
    (*TABLE_FUNCTIONS, LAST),
    "a number, a table such as heat[F2], a number of the scenario such as shifts.1.at, "
    "or a function",
    example="work",
    instead="; rows of a table go in [ ]",
)


class RunNames:
    """Resolver of table names in an expression over a run.

    Parameters
    ----------
    source : Excerpt
    rows_of : callable
        Function from a kind of rows to the names of the rows.
    """

    language = LANGUAGE
    gears: Sequence[str] = ()
    """No names of gears, because tables of a run have no axis of gears."""

    def __init__(self, source: Excerpt, rows_of: Callable[[Kind], Sequence[str]]) -> None:
        self.source = source
        self.rows_of = rows_of

    def selection(self, read: TableName) -> Selection:
        """Return the table, or the rows of a table, that a name selects.

        Raises
        ------
        ReadError
        """
        known = TABLES.get(read.name)
        if known is None:
            raise self.source.error(self._message_of_unknown_table(read.name), read.at)
        gear = None if along_time(read.name) else 0
        subscripts = list(read.subscripts)
        if known.kind == "number":
            if subscripts:
                raise self.source.error(
                    f"`{read.name}` has no rows, expected it without `[`", subscripts[0].at
                )
            return Selection(read.name, gear, None, 0)
        rows = self.rows(read.name)
        if not rows:
            raise self.source.error(f"there is no {known.kind}, so `{read.name}` is empty", read.at)
        if known.kind == "step" and len(subscripts) == 2:  # sequence and number name a row
            (sequence, at), (step, _) = subscripts
            subscripts = [Subscript(f"{_unquoted(sequence)},{step}", at)]
        row = self._row(subscripts.pop(0), rows, known.kind) if subscripts else None
        if subscripts:
            raise self.source.error(
                f"read one part too many, expected {read.name}[{known.kind}]", subscripts[0].at
            )
        return Selection(read.name, gear, row, len(rows))

    def rows(self, table: str) -> Sequence[str]:
        """Return the names of the rows of a table; empty for a table of a single number."""
        return self.rows_of(TABLES[table].kind)

    def written_rows(self, table: str) -> Sequence[str]:
        """Return the names of the rows of a table, which are equal in all variants."""
        return self.rows(table)

    def row(self, table: str) -> str:
        """Return the kind of the rows of a table, such as `link`."""
        return TABLES[table].kind

    def key(self, index: int, rows: Sequence[str]) -> str:
        """Return the text in brackets for a row; the text of a step is its sequence and number."""
        if tuple(rows) != self.rows_of("step"):
            return written(index, rows)
        sequence, _, number = rows[index].rpartition(",")
        return f"{written(0, [sequence])},{number}"

    def _row(self, subscript: Subscript, rows: Sequence[str], kind: str) -> int | None:
        """Return the row index in a subscript, by name or number; None means all rows (`:`)."""
        written = subscript.written
        if written == ":":
            return None
        name = _unquoted(written)
        rows_of_name = [] if written[0] == "#" else [n for n, row in enumerate(rows) if row == name]
        if not rows_of_name and kind == "target":  # a link with a single target speed
            rows_of_name = [n for n, row in enumerate(rows) if row.rpartition(" ")[0] == name]
        number = None if rows_of_name else typed_number(written.removeprefix("#"), len(rows))
        if number is not None:
            return number - 1
        if len(rows_of_name) == 1:
            return rows_of_name[0]
        count = f"there are {len(rows_of_name)}" if rows_of_name else "there is no"
        known = listed([quoted(row) for row in rows])
        raise self.source.error(
            f"{count} {kind} {quoted(name)}, expected one of {known}" + nearest(name, rows),
            subscript.at,
        )

    def _message_of_unknown_table(self, name: str) -> str:
        hint = ""
        for table in ("speeds", "heat", "torques"):
            if not hint and name in self.rows(table):
                hint = f"; a name goes in brackets: {table}[{name}]"
        hint = hint or nearest(name, (*TABLES, *TABLE_FUNCTIONS, LAST))
        hint = hint or f", expected one of {listed(list(TABLES), 30)}"
        return f"a run has no table {quoted(name)}{hint}"


class MotionNames(RunNames):
    """Resolver of all names in an expression: tables of a run, and numbers in scenario and case."""

    def __init__(
        self, source: Excerpt, subject: ScenarioNumbers, targets: Sequence[Varied]
    ) -> None:
        super().__init__(source, subject.rows)
        self.subject = subject
        self.targets = targets

    def number(self, name: DottedName) -> VariedNumber | Constant | Selection:
        """Return a named number: varied, as written, or a ratio that follows from tooth numbers."""
        return self._number(name.written, self.source.place(name.at))

    def _number(self, written: str, place: Place) -> VariedNumber | Constant | Selection:
        path = self.subject.target(written, place)
        for column, varied in enumerate(self.targets):
            if varied.numbers == path.numbers:
                return VariedNumber(column)
        if self.subject.follows_teeth(path):
            case = self.subject.base_case
            of_mechanism = target(dotted(by_name(path.keys)), case, place)
            table = PART_NUMBERS[of_mechanism.quantity]
            return Selection(table, 0, of_mechanism.owner, len(case.mechanisms))
        return Constant(self.subject.written_number(path, place))

    def rows(self, table: str) -> Sequence[str]:
        """Return the names of the rows of a table; empty for a table of a single number."""
        return [] if table in PART_NUMBERS.values() else super().rows(table)

    def table(self, read: TableName) -> Selection | VariedNumber | Constant:
        """Return the table, rows of a table, or duration that a name means."""
        if read.name == "duration" and not read.subscripts:
            return self._number(read.name, self.source.place(read.at))
        return self.selection(read)


def _unquoted(written: str) -> str:
    return written[1:-1] if written[0] in "\"'" else written
