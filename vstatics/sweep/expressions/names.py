"""What the names in an expression of a sweep mean: tables, rows, gears, numbers of mechanisms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

from vstatics.errors import quoted, typed_number
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Floats
from vstatics.statics.arrays import Rows
from vstatics.statics.physical import known_units, lacking_load
from vstatics.statics.results import Results
from vstatics.sweep.expressions.evaluation import FUNCTIONS
from vstatics.sweep.expressions.excerpt import Excerpt
from vstatics.sweep.expressions.operands import Constant, DottedName, Subscript, TableName
from vstatics.sweep.targets import Target, target
from vstatics.tables.names import nearest_quantity, no_row, rows_called, several
from vstatics.tables.quantities import BY_NAME
from vstatics.tables.rows import ROWS, table_rows

OPERANDS = "a number, a table such as ratio[1], a varied number such as D1.ratio, or a function"
"""What an operand can be, for messages."""


class Selection(NamedTuple):
    """A table of the results, or what is left of it."""

    table: str
    gear: int | None
    """None for all gears."""
    row: int | None
    """None for all rows, or where the table has none."""
    has_rows: bool


class VariedNumber(NamedTuple):
    """A number that the sweep varies."""

    column: int


Name: TypeAlias = Selection | VariedNumber


def value_of(name: Name, results: Results, varied: Floats) -> Floats:
    """The values of what a name stands for, shape (..., gears or 1, rows or 1).

    Floats are views of the results, whatever their strides; marks are copied to floats.
    """
    if isinstance(name, VariedNumber):
        return varied[..., name.column, None, None]
    table: Any = results.existing(name.table)
    if not name.has_rows:
        table = table[..., None]
    gears, rows = (
        slice(None) if index is None else slice(index, index + 1) for index in (name.gear, name.row)
    )
    values: Floats = table[..., gears, rows].astype(float, copy=False)
    return values


class SweepNames:
    """Finds what names in a text mean, for a case and what is varied of it.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(), Gear()])
    >>> names = SweepNames(Excerpt("losses[D1, :]", "--out"), case, [])
    >>> names.table(TableName("losses", (Subscript("D1", 7), Subscript(":", 11)), 0))
    Selection(table='losses', gear=None, row=0, has_rows=True)
    """

    def __init__(self, source: Excerpt, case: Transmission, targets: Sequence[Target]) -> None:
        self.source = source
        self.case = case
        self.targets = targets
        self.gears = [gear.name for gear in case.gears]

    def number(self, name: DottedName) -> VariedNumber | Constant:
        """A number of a mechanism: varied, or else the case's own."""
        found = target(name.written, self.case, self.source.place(name.at))
        for column, varied in enumerate(self.targets):
            if varied[1:] == found[1:]:
                return VariedNumber(column)
        return Constant(getattr(self.case.mechanisms[found.mechanism], found.quantity))

    def table(self, read: TableName) -> Selection:
        """A table, or a part of it."""
        known = BY_NAME.get(read.name)
        if known is None:
            raise self.source.error(self._no_table(read.name), read.at)
        if known.columns != "gears":
            message = f"`{read.name}` is not of a gear, so a sweep does not have it"
            raise self.source.error(message, read.at)
        if known.unit and known.unit not in known_units(self.case):
            raise self.source.error(lacking_load(read.name, known.unit), read.at)
        kind, subscripts, row = known.rows, list(read.subscripts), None
        if kind != "one":
            rows = table_rows(known.name, self.case)
            if not rows:
                message = f"the case has no {ROWS[kind].all}, so `{read.name}` is empty"
                raise self.source.error(message, read.at)
            row = self._index(subscripts.pop(0), rows, kind) if subscripts else None
        gear = self._index(subscripts.pop(0), self.gears, "one") if subscripts else None
        if subscripts:
            parts = "[gear]" if kind == "one" else f"[{ROWS[kind].one}, gear]"
            message = f"read one part too many, expected {read.name}{parts}"
            raise self.source.error(message, subscripts[0].at)
        return Selection(known.name, gear, row, kind != "one")

    def _index(self, subscript: Subscript, names: Sequence[str], kind: Rows) -> int | None:
        """What a subscript stands for: by its name first, then by its number; None for all."""
        written = subscript.written
        if written == ":":
            return None
        in_quotes = written[0] in "\"'"
        name = written[1:-1] if in_quotes else written
        found = [] if written[0] == "#" else self._called(name, names, kind)
        if len(found) == 1:
            return found[0]
        if found:
            raise self.source.error(several(name, found, names), subscript.at)
        number = typed_number(written.removeprefix("#"), len(names))
        if number is not None:
            return number - 1
        raise self.source.error(self._no_row(written, name, names, kind), subscript.at)

    def _called(self, name: str, names: Sequence[str], kind: Rows) -> list[int]:
        """Indices of the rows or gears of a name."""
        if kind != "one":
            return rows_called(name, kind, self.case)
        return [names.index(name)] if name in names else []

    def _no_row(self, written: str, name: str, names: Sequence[str], kind: Rows) -> str:
        """What to say of a row or a gear that there is not."""
        if written[0] == "#":
            what = ROWS[kind].one
            return f"read `{written}`, expected the number of a {what}, #1 to #{len(names)}"
        second = f"; a gear goes in the second place: [:,{written}]"
        hint = second if kind != "one" and name in self.gears else ""
        return no_row(name, kind, names, hint)

    def _no_table(self, name: str) -> str:
        """What to say of a name that is no table."""
        case = self.case
        if name in [mechanism.name for mechanism in case.mechanisms]:
            hint = f"; `{name}` is a mechanism: {name}.ratio, or in brackets as in losses[{name}]"
        elif name in case.link_names:
            hint = f"; `{name}` is a link: in brackets, as in speeds[{name}]"
        elif name in [element.name for element in case.shift_elements]:
            hint = f"; `{name}` is a shift element: in brackets, as in torques[{name}]"
        else:
            hint = nearest_quantity(name, FUNCTIONS) or "; such as ratio, efficiency, speeds[C1]"
        return f"there is no table {quoted(name)}{hint}"
