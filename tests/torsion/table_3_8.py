"""Tsitovich, Algin, Vehicle dynamics (1981): tables 3.7 (given) and 3.8 (largest torques)."""

from typing import NamedTuple

from tests.torsion.book import table
from vstatics.torsion.clutch.dumped import DumpCase
from vstatics.torsion.clutch.given import Dump


class Line(NamedTuple):
    """A line of table 3.8."""

    vehicle: str
    gear: int
    case: DumpCase
    given: Dump
    torques: list[float | None]
    """In kN*m: largest, at the input shaft; both by the simplified forms."""
    integrated: float
    """By an integration in time, apart from this project. [kN*m]"""


ROWS = table("table_3_8")["rows"]
TABLE_3_8 = [Line(**{**row, "given": Dump._make(map(float, row["given"]))}) for row in ROWS]
