"""Name of a lookup table in a formula, which carries the table itself."""

from __future__ import annotations

from typing import Any, Self

from vstatics.core.numerics.lookup_table import LookupTable

UNREADABLE = LookupTable((0.0,), ((0.0,),))
"""Stand-in for a table file that cannot be read; a formula can call it with any operands."""


class TableCall(str):
    """Name of a lookup table in a formula, with the table as an attribute.

    >>> first, second = (TableCall("p", LookupTable((0.0,), ((y,),))) for y in (1.0, 2.0))
    >>> first == "p", first == second
    (True, False)
    """

    __slots__ = ("table",)
    table: LookupTable

    def __new__(cls, name: str, table: LookupTable) -> Self:
        """Return the name with the table."""
        call = super().__new__(cls, name)
        call.table = table
        return call

    def __eq__(self, other: object) -> bool:
        """Compare names and tables, because cached formulas are compared by their trees."""
        same = not isinstance(other, TableCall) or self.table == other.table
        return same and str(self) == other

    __hash__ = str.__hash__

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return the arguments from which `pickle` rebuilds the name in a different process."""
        return str(self), self.table
