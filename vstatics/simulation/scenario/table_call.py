"""The names of tables where formulas call them."""

from __future__ import annotations

from typing import Any, Self

from vstatics.core.numerics.lookup_table import LookupTable


class TableCall(str):
    """The name of a table where a formula calls it: it knows the table.

    >>> one, other = (TableCall("p", LookupTable((0.0,), ((y,),))) for y in (1.0, 2.0))
    >>> one == "p", one == other
    (True, False)
    """

    __slots__ = ("table",)
    table: LookupTable

    def __new__(cls, name: str, table: LookupTable) -> Self:
        """Keep the table."""
        made = super().__new__(cls, name)
        made.table = table
        return made

    def __eq__(self, other: object) -> bool:
        """Formulas are remembered: those that call other tables of that name are not the same."""
        same = not isinstance(other, TableCall) or self.table == other.table
        return same and str(self) == other

    __hash__ = str.__hash__

    def __getnewargs__(self) -> tuple[Any, ...]:
        """For another process."""
        return str(self), self.table
