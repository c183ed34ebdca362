"""Results as the printed report of the source: the input, then the tables.

Rows and columns are as printed there, under the same names and index lists; the
program's own tables follow. The report starts with the deck of its case, so it is
itself a deck that can be run again, but for a case with springs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.core.tables.names import BEFORE_NAME, ROWS
from vstatics.core.tables.numbers import fixed_rows
from vstatics.core.tables.quantities import Quantity, Table
from vstatics.core.tables.values import tables
from vstatics.core.texts import Language, heading, speaking, tr
from vstatics.core.writers import deck

RESULTS = "RESULTS"
CONVENTIONS = (
    "Conventions: speeds relative to the input speed, torques to the input torque;\n"
    "a torque is that on the first link of its device, the last one (KLG1) is the\n"
    "output torque, given to the load; ratio is w_input/w_output."
)
COASTING = "Coasting: the power enters at the output; in this scaling losses are below 0."
LISTING_DECIMALS = 3
"""After the point, as published."""
MESSAGES = "Messages:"


def write(results: Results, lang: Language = "en", digits: int = LISTING_DECIMALS) -> str:
    """The report of one case; numbers in Fortran style.

    Parameters
    ----------
    lang : {"en", "ru"}
        Language of the headings.
    digits : int
        After the point.
    """
    with speaking(lang):
        lines = [deck.write(results.with_numbers_only, lang), tr(RESULTS), tr(CONVENTIONS)]
        case = results.case
        coasting = [gear.name for gear in case.gears if case.coasts(gear)]
        if coasting:
            gears = f" ({', '.join(coasting)})" * (len(coasting) < len(case.gears))
            lines.append(tr(COASTING) + gears)
        lines += [*table_lines(results, tables(results), digits), *messages(results)]
    return "\n".join(lines) + "\n"


def table_lines(results: Results, shown: Iterable[Table], digits: int) -> Iterator[str]:
    """Some tables of the results, each below its heading."""
    named = results.case.has_own_rows
    for table in shown:
        for title, indices, part in parts(table, results.case):
            mark = " (1)" if part.quantity.kind is bool else ""  # of what is so
            yield from ("", f"{heading(title)}{mark}:", indices)
            yield from _rows(part, digits, named=named and table.quantity.rows != "one")


def messages(results: Results) -> list[str]:
    """What is said of the gears, if anything is."""
    said = [*map(str, results.messages)]
    return ["", tr(MESSAGES), *said] if said else said


def parts(table: Table, case: Transmission) -> Iterator[tuple[str, str, Table]]:
    """What is printed of a table: heading, index list and rows; torques in two parts."""
    quantity = table.quantity
    if quantity.members is None:
        if table.values.size:
            yield quantity.heading, _indices(quantity), table
        return
    elements = len(case.shift_elements)
    if elements:
        first = table._replace(rows=table.rows[:elements], values=table.values[:elements])
        yield quantity.heading, _indices(quantity, "I=1,KL"), first
    rest = table._replace(rows=table.rows[elements:], values=table.values[elements:])
    yield quantity.members[case.drawing is not None], _indices(quantity, "I=(KL+1),KLG1"), rest


def _indices(quantity: Quantity, rows: str = "") -> str:
    """The name with its index list, as in ``(W(I,J),J=1,NP),I=1,KJG:``."""
    column = "K" if quantity.columns == "devices" else "J"
    columns = f"{column}=1,{'KLG' if quantity.columns == 'devices' else 'NP'}"
    if quantity.rows == "one":
        return f"{quantity.printed}({column}),{columns}:"
    rows = rows or f"I=1,{ROWS[quantity.rows].size}"
    return f"({quantity.printed}(I,{column}),{columns}),{rows}:"


def _rows(table: Table, digits: int, *, named: bool) -> list[str]:
    """Rows of equal fields: 7 wide with three digits, 3 wide for whole numbers, or wider.

    Where the case is drawn, or has springs, each row ends with its name.
    """
    decimals, width = (digits, digits + 4) if table.quantity.kind is float else (0, 3)
    rows = fixed_rows(table.values.tolist(), width, decimals)
    if not named:
        return rows
    return [f"{row}  {BEFORE_NAME} {name}" for row, name in zip(rows, table.rows, strict=True)]
