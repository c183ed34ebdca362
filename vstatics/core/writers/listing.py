"""Listing of results in the form of the published report: the deck, then the tables.

Rows, columns, names and index lists are printed as in the published report. Additional tables of
this program follow. The listing begins with the deck of the case. So it can be run again as a deck,
unless the case has springs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache

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
ASTERISKS = "Asterisks: the value is undefined or indeterminate, or given by a law."
LISTING_DECIMALS = 3
"""Number of decimals in the published report."""
MESSAGES = "Messages:"


def write(results: Results, lang: Language = "en", digits: int = LISTING_DECIMALS) -> str:
    """Write the listing of a case, with numbers in Fortran style.

    Parameters
    ----------
    results : Results
    lang : {"en", "ru"}
        Language of the headings.
    digits : int
        Number of decimals.
    """
    with speaking(lang):
        lines = [deck.write(results.with_numbers_only, lang), tr(RESULTS), tr(CONVENTIONS)]
        case = results.case
        coasting = [gear.name for gear in case.gears if case.coasts(gear)]
        if coasting:
            gears = f" ({', '.join(coasting)})" * (len(coasting) < len(case.gears))
            lines.append(tr(COASTING) + gears)
        body = [*table_lines(results, tables(results), digits)]
        if any("***" in line for line in (lines[0], *body)):
            lines.append(tr(ASTERISKS))
        lines += [*body, *messages(results)]
    return "\n".join(lines) + "\n"


def table_lines(results: Results, shown: Iterable[Table], digits: int) -> Iterator[str]:
    """Yield the lines of tables, with headings.

    Fields are equally wide: 7 characters for three decimals, 3 for integers. Longer numbers widen
    the fields.
    """
    named = results.case.has_own_rows
    for table in shown:
        kind = table.quantity.kind
        mark = " (1)" if kind is bool else ""  # in these tables, 1 means yes
        form = (digits + 4, digits) if kind is float else (3, 0)
        for title, indices, part in parts(table, results.case):
            yield from ("", f"{heading(title)}{mark}:", indices)
            rows = fixed_rows(part.values.tolist(), *form)
            yield from _named(rows, part) if named and table.quantity.rows != "one" else rows


def messages(results: Results) -> list[str]:
    """Return the lines of the messages about the gears."""
    said = [*map(str, results.messages)]
    return ["", tr(MESSAGES), *said] if said else said


def parts(table: Table, case: Transmission) -> Iterator[tuple[str, str, Table]]:
    """Yield heading, index list and rows of a table, or of both parts of a table of torques."""
    quantity = table.quantity
    if quantity.members is None:
        if table.values.size:
            yield quantity.heading, _indices(quantity), table
        return
    elements = len(case.shift_elements)
    if elements:
        first = Table(quantity, table.rows[:elements], table.columns, table.values[:elements])
        yield quantity.heading, _indices(quantity, "I=1,KL"), first
    second = Table(quantity, table.rows[elements:], table.columns, table.values[elements:])
    yield quantity.members[case.drawing is not None], _indices(quantity, "I=(KL+1),KLG1"), second


@lru_cache(maxsize=100)
def _indices(quantity: Quantity, rows: str = "") -> str:
    """Return a name with an index list, as in ``(W(I,J),J=1,NP),I=1,KJG:``."""
    column = "K" if quantity.columns == "devices" else "J"
    columns = f"{column}=1,{'KLG' if quantity.columns == 'devices' else 'NP'}"
    if quantity.rows == "one":
        return f"{quantity.printed}({column}),{columns}:"
    rows = rows or f"I=1,{ROWS[quantity.rows].size}"
    return f"({quantity.printed}(I,{column}),{columns}),{rows}:"


def _named(rows: Iterable[str], table: Table) -> Iterator[str]:
    """Yield rows with their names at the end (for cases with gear sets or springs)."""
    for row, name in zip(rows, table.rows, strict=True):
        yield f"{row}  {BEFORE_NAME} {name}"
