"""Meanings of names in an expression for a case: tables, rows, gears, numbers."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from vstatics.core.errors import quoted, typed_number
from vstatics.core.extras import higher
from vstatics.core.model.fields import gear_place, numbered_gear
from vstatics.core.model.parts import Law
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.expressions.evaluation import TABLE_FUNCTIONS
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Language
from vstatics.core.readers.expressions.operands import Constant, DottedName, Subscript, TableName
from vstatics.core.statics.physical import known_units, lacking_load
from vstatics.core.statics.result_arrays import Rows
from vstatics.core.suggestions import nearest
from vstatics.core.tables.names import (
    ROWS,
    nearest_quantity,
    no_row,
    rows_called,
    several,
    table_rows,
    written,
)
from vstatics.core.tables.quantities import BY_NAME
from vstatics.sweep.results.meanings import (
    OF_RATIOS,
    OK,
    OMEGA,
    PART_NUMBERS,
    SPREAD,
    STEP,
    Selection,
    VariedNumber,
)
from vstatics.sweep.variants.path_numbers import CasePath, own_number_at
from vstatics.sweep.variants.subject import number_of_case
from vstatics.sweep.variants.targets import OF_MECHANISM, Target, Varied, own_number

LANGUAGE = Language(
    TABLE_FUNCTIONS,
    "a number, a table such as ratio[1], a varied number such as D1.ratio, or a function",
    example="ratio",
    instead="; rows and gears of a table go in [ ]",
)


def _changes_mechanisms(varied: Varied) -> bool:
    """Return whether a varied number can change the numbers of a mechanism."""
    return isinstance(varied, CasePath) and bool(varied.part or varied.quantity in OF_MECHANISM)


class SweepNames:
    """Finder of the meanings of names in an expression, for a case and the varied numbers.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(), Gear()])
    >>> names = SweepNames(Excerpt("losses[D1, :]", "--out"), case, [])
    >>> names.table(TableName("losses", (Subscript("D1", 7), Subscript(":", 11)), 0))
    Selection(table='losses', gear=None, row=0, rows=1)
    """

    key = staticmethod(written)
    """Function that returns the name of a row or gear as written between brackets."""

    def __init__(
        self,
        source: Excerpt,
        case: Transmission,
        targets: Sequence[Varied],
        *,
        by_gear: bool = False,
    ) -> None:
        self.source = source
        self.language = LANGUAGE
        self.case = case
        self.varied = targets
        self.by_gear = by_gear
        self.gears = [] if by_gear else [gear.name for gear in case.gears]
        """Names of the gears; empty if each output row represents a gear."""

    def number(self, name: DottedName) -> VariedNumber | Applied | Constant | Selection:
        """Return a number of the case: a varied number, a constant, or a part of a table.

        If a stiffness varies, its compliance is calculated. If varied numbers, such as tooth
        numbers, can change the number of a gear set, it is part of a table.
        """
        number_in_case = number_of_case(name.written, self.case, self.source.place(name.at))
        for column, varied in enumerate(self.varied):
            if varied.numbers == number_in_case.numbers:
                number = VariedNumber(column)
                if not isinstance(varied, Target) or varied.quantity == number_in_case.quantity:
                    return number
                return Applied("/", (Constant(1.0), number), name.at, 1)
        if isinstance(number_in_case, CasePath):
            try:
                return Constant(own_number_at(number_in_case, self.case))
            except ValueError as error:
                raise self.source.error(str(error), name.at) from None
        value = own_number(self.case, number_in_case.owner, number_in_case.quantity)
        if isinstance(value, Law):
            message = (
                f"{quoted(number_in_case.name)} depends on the operating point: it is not a number"
            )
            raise self.source.error(message, name.at)
        quantity, place = number_in_case.quantity, number_in_case.owner
        follows = place not in range(len(self.case.mechanisms))[self.case.own_mechanisms]
        if quantity in PART_NUMBERS and follows and any(map(_changes_mechanisms, self.varied)):
            table = PART_NUMBERS[quantity]
            return Selection(table, 0, place, len(self.case.mechanisms))
        return Constant(value)

    @property
    def _units(self) -> set[str]:
        """Units of tables that exist because the case or a varied number gives speed or torque."""
        loads = {varied.quantity for varied in self.varied if isinstance(varied, CasePath)}
        by_load = {"rpm": {"load.speed"}, "Nm": {"load.torque"}}
        known = known_units(self.case) | {unit for unit, of in by_load.items() if of & loads}
        return known | {"kW"} if {"rpm", "Nm"} <= known else known

    def table(self, read: TableName) -> Selection:
        """Return a table, or the part of a table that subscripts select."""
        if read.name == OMEGA:
            return self._frequency(read)
        if read.name in OF_RATIOS:
            subscripts = list(read.subscripts)
            gear = 0 if read.name == SPREAD else self._gear(subscripts)
            self._nothing_more(subscripts, STEP + "[gear]" if read.name == STEP else SPREAD)
            return Selection(read.name, gear, None, 0)
        if read.name == OK:
            self._nothing_more(list(read.subscripts), OK)
            return Selection(OK, 0, None, 0)
        known = BY_NAME.get(read.name)
        if known is None:
            raise self.source.error(self._no_table(read.name), read.at)
        if known.columns != "gears":
            message = f"`{read.name}` does not belong to a gear, so a sweep does not have it"
            raise self.source.error(message, read.at)
        if known.unit and known.unit not in self._units:
            raise self.source.error(lacking_load(read.name, known.unit), read.at)
        kind, subscripts, row = known.rows, list(read.subscripts), None
        rows = self.rows(known.name)
        if kind != "one":
            if not rows:
                message = f"the case has no {ROWS[kind].all}, so `{read.name}` is empty"
                raise self.source.error(message, read.at)
            row = self._index(subscripts.pop(0), rows, kind) if subscripts else None
        gear = self._gear(subscripts)
        parts = [ROWS[kind].singular] * (kind != "one") + ["gear"] * (not self.by_gear)
        self._nothing_more(subscripts, f"{read.name}[{', '.join(parts)}]" if parts else read.name)
        return Selection(known.name, gear, row, len(rows))

    def _gear(self, subscripts: list[Subscript]) -> int | None:
        """Return the index of the gear that the next subscript selects.

        Return None for all gears.
        """
        if self.by_gear:
            return 0
        return self._index(subscripts.pop(0), self.gears, "one") if subscripts else None

    def _nothing_more(self, subscripts: Sequence[Subscript], expected: str) -> None:
        if subscripts:
            gears = "each row has a single gear, " * self.by_gear
            message = f"read too many parts, {gears}expected {expected}"
            raise self.source.error(message, subscripts[0].at)

    def rows(self, table: str) -> Sequence[str]:
        """Return the names of the rows of a table in the case; empty for a table without rows."""
        if table in (*OF_RATIOS, OK, *PART_NUMBERS.values()):
            return []
        return self._modes if table == OMEGA else table_rows(table, self.case)

    def written_rows(self, table: str) -> Sequence[str]:
        """Return the names of all possible rows, including modes that only some variants have."""
        if table == OMEGA:
            return [str(number) for number in range(1, len(self.case.link_names) + 1)]
        return self.rows(table)

    def row(self, table: str) -> str:
        """Return the noun for a row of a table."""
        return "mode" if table == OMEGA else ROWS[BY_NAME[table].rows].singular

    @cached_property
    def _modes(self) -> list[str]:
        varied = [varied for varied in self.varied if isinstance(varied, Target)]
        names: list[str] = higher("mode_names", OMEGA)(self.case, varied)
        return names

    def _frequency(self, read: TableName) -> Selection:
        """Return natural frequencies. A mode that the case lacks can exist in a variant."""
        if not self._modes:
            message = "the case has no natural mode in any gear, so `omega` does not exist: give "
            message += "inertias, and springs or a stiffness between them"
            raise self.source.error(message, read.at)
        subscripts, mode = list(read.subscripts), None
        if subscripts and subscripts[0].written != ":":
            written, most = subscripts[0].written, self.written_rows(OMEGA)
            number = typed_number(written.removeprefix("#"), len(most))
            if number is None:
                message = f"read {quoted(written)}, expected the number of a mode, 1 to {most[-1]}"
                raise self.source.error(message, subscripts[0].at)
            mode = number - 1
        subscripts = subscripts[1:]
        gear = self._gear(subscripts)
        self._nothing_more(subscripts, "omega[mode]" if self.by_gear else "omega[mode, gear]")
        return Selection(OMEGA, gear, mode, len(self._modes))

    def _index(self, subscript: Subscript, names: Sequence[str], kind: Rows) -> int | None:
        """Return the index that a subscript selects, by name or else by number.

        Return None if the subscript selects all.
        """
        written = subscript.written
        if written == ":":
            return None
        name = written[1:-1] if written[0] in "\"'" else written
        if kind == "one":
            matches = [names.index(name)] if name in names else []
        else:
            matches = rows_called(name, kind, self.case)
        if written[0] == "#":
            matches = []
        if len(matches) == 1:
            return matches[0]
        if matches:
            raise self.source.error(several(name, matches, names), subscript.at)
        number = (
            gear_place(written, names)
            if kind == "one"
            else typed_number(written.removeprefix("#"), len(names))
        )
        if number is not None:
            return number - 1
        raise self.source.error(self._no_row(written, name, names, kind), subscript.at)

    def _no_row(self, written: str, name: str, names: Sequence[str], kind: Rows) -> str:
        if written[0] == "#":
            what = ROWS[kind].singular
            return f"read `{written}`, expected the number of a {what}, #1 to #{len(names)}"
        if kind == "one":
            hint = nearest(name, names) + numbered_gear(written, names)
        else:
            second = f"; a gear goes in the second place: [:,{written}]"
            hint = second if name in self.gears else ""
        return no_row(name, kind, names, hint)

    def _no_table(self, name: str) -> str:
        case = self.case
        if name in [mechanism.name for mechanism in case.mechanisms]:
            hint = f"; `{name}` is a mechanism: {name}.ratio, or in brackets as in losses[{name}]"
        elif name in case.link_names:
            hint = f"; `{name}` is a link: in brackets, as in speeds[{name}]"
        elif name in [element.name for element in case.shift_elements]:
            hint = f"; `{name}` is a shift element: in brackets, as in torques[{name}]"
        elif name in ("status", "assembled"):
            hint = "; `ok` is true where the column `status` says so"
        else:
            hint = (
                nearest_quantity(name, (*TABLE_FUNCTIONS, OMEGA, *OF_RATIOS, OK))
                or "; tables are, for example, ratio, efficiency, speeds[C1]"
            )
        return f"there is no table {quoted(name)}{hint}"
