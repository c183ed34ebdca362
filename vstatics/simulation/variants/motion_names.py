"""What the names in an expression mean where a scenario is swept: tables of runs, its numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from vstatics.core.errors import Place, listed, quoted, typed_number
from vstatics.core.model.paths import by_name, dotted
from vstatics.core.readers.expressions.evaluation import FUNCTIONS, LAST
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Language
from vstatics.core.readers.expressions.operands import Constant, DottedName, Subscript, TableName
from vstatics.core.suggestions import nearest
from vstatics.core.tables.names import written
from vstatics.simulation.record.rows import Kind
from vstatics.simulation.variants.motion_tables import TABLES, along_time
from vstatics.simulation.variants.numbers import ScenarioNumbers
from vstatics.sweep.results.meanings import PART_NUMBERS, Selection, VariedNumber
from vstatics.sweep.variants.targets import Varied, target

LANGUAGE = Language(
    (*FUNCTIONS, LAST),
    "a number, a table such as heat[F2], a number of the scenario such as shifts.1.at, "
    "or a function",
    example="work",
    instead="; rows of a table go in [ ]",
)


class RunNames:
    """Finds what tables of a run a text means.

    Parameters
    ----------
    source : Excerpt
    rows_of : callable
        Gives the names of the rows of a kind.
    """

    language = LANGUAGE
    gears: Sequence[str] = ()
    """None: the first axis of the tables is that of time."""

    def __init__(self, source: Excerpt, rows_of: Callable[[Kind], Sequence[str]]) -> None:
        self.source = source
        self.rows_of = rows_of

    def selection(self, read: TableName) -> Selection:
        """A table, or a part of it.

        Raises
        ------
        ReadError
        """
        known = TABLES.get(read.name)
        if known is None:
            raise self.source.error(self._no_table(read.name), read.at)
        gear = None if along_time(read.name) else 0
        subscripts = list(read.subscripts)
        if known.kind == "number":
            if subscripts:
                message = f"`{read.name}` has no rows, expected it without `[`"
                raise self.source.error(message, subscripts[0].at)
            return Selection(read.name, gear, None, 0)
        rows = self.rows(read.name)
        if not rows:
            message = f"there is no {known.kind}, so `{read.name}` is empty"
            raise self.source.error(message, read.at)
        if known.kind == "step" and len(subscripts) == 2:  # its row has both names
            (sequence, at), (step, _) = subscripts
            subscripts = [Subscript(f"{_bare(sequence)},{step}", at)]
        row = self._row(subscripts.pop(0), rows, known.kind) if subscripts else None
        if subscripts:
            message = f"read one part too many, expected {read.name}[{known.kind}]"
            raise self.source.error(message, subscripts[0].at)
        return Selection(read.name, gear, row, len(rows))

    def rows(self, table: str) -> Sequence[str]:
        """The names of a table's rows; none if it has no rows."""
        return self.rows_of(TABLES[table].kind)

    def written_rows(self, table: str) -> Sequence[str]:
        """The same: all variants have the names of the scenario itself."""
        return self.rows(table)

    def row(self, table: str) -> str:
        """What a row of a table is."""
        return TABLES[table].kind

    def key(self, index: int, rows: Sequence[str]) -> str:
        """A row as it is written between brackets: of a step its sequence and its number."""
        if tuple(rows) != self.rows_of("step"):
            return written(index, rows)
        sequence, _, number = rows[index].rpartition(",")
        return f"{written(0, [sequence])},{number}"

    def _row(self, subscript: Subscript, rows: Sequence[str], kind: str) -> int | None:
        """What a subscript stands for: by its name first, then by its number; None for all."""
        written = subscript.written
        if written == ":":
            return None
        name = _bare(written)
        found = [] if written[0] == "#" else [n for n, row in enumerate(rows) if row == name]
        if not found and kind == "target":  # the one speed that is asked for of a link
            found = [n for n, row in enumerate(rows) if row.rpartition(" ")[0] == name]
        number = None if found else typed_number(written.removeprefix("#"), len(rows))
        if number is not None:
            return number - 1
        if len(found) == 1:
            return found[0]
        some = f"there are {len(found)}" if found else "there is no"
        known = listed([quoted(row) for row in rows])
        message = f"{some} {kind} {quoted(name)}, expected one of {known}"
        raise self.source.error(message + nearest(name, rows), subscript.at)

    def _no_table(self, name: str) -> str:
        """What to say of a name that is no table."""
        hint = ""
        for table in ("speeds", "heat", "torques"):
            if not hint and name in self.rows(table):
                hint = f"; a name goes in brackets: {table}[{name}]"
        hint = hint or nearest(name, (*TABLES, *FUNCTIONS, LAST))
        hint = hint or f", expected one of {listed(list(TABLES), 30)}"
        return f"a run has no table {quoted(name)}{hint}"


class MotionNames(RunNames):
    """Finds what names in a text mean, for a scenario and what is varied of it."""

    def __init__(
        self, source: Excerpt, subject: ScenarioNumbers, targets: Sequence[Varied]
    ) -> None:
        super().__init__(source, subject.rows)
        self.subject = subject
        self.targets = targets

    def number(self, name: DottedName) -> VariedNumber | Constant | Selection:
        """A number of the scenario or its case: varied, or as it is written or follows of teeth."""
        place = self.source.place(name.at)
        return self._number(name.written, place)

    def _number(self, written: str, place: Place) -> VariedNumber | Constant | Selection:
        found = self.subject.target(written, place)
        for column, varied in enumerate(self.targets):
            if varied.numbers == found.numbers:
                return VariedNumber(column)
        if self.subject.follows_teeth(found):
            case = self.subject.base_case
            of_mechanism = target(dotted(by_name(found.keys)), case, place)
            table = PART_NUMBERS[of_mechanism.quantity]
            return Selection(table, 0, of_mechanism.owner, len(case.mechanisms))
        return Constant(self.subject.written_number(found, place))

    def rows(self, table: str) -> Sequence[str]:
        """The names of a table's rows; none if it has no rows."""
        return [] if table in PART_NUMBERS.values() else super().rows(table)

    def table(self, read: TableName) -> Selection | VariedNumber | Constant:
        """A table, or a part of it; or the duration."""
        if read.name == "duration" and not read.subscripts:
            return self._number(read.name, self.source.place(read.at))
        return self.selection(read)


def _bare(written: str) -> str:
    """A subscript without its quotes."""
    return written[1:-1] if written[0] in "\"'" else written
