"""Written results as numbers: what a reader makes of a listing or JSON, to be compared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission

GEAR_NUMBER = "gear number"
"""The column of a driving cycle that is a whole number."""


class Figure(NamedTuple):
    """A number as it was written: NaN stands for none."""

    value: float
    slack: float = 0.0
    """Half of the last digit, for a number from a listing."""


Figures = list[list[Figure]]
"""Rows of a table; a list over gears is one row."""


class WrittenResult(NamedTuple):
    """The tables of one result, by their keys."""

    tables: dict[str, Figures]
    case: Transmission | None
    """For the names of rows and gears; a foreign listing may have none."""
    printed: bool
    """Whether it was a listing."""
    errors: bool = False
    """Whether it stands for a case that failed."""
    rows: Mapping[str, Sequence[str]] = MappingProxyType({})
    """Names of the rows of its tables, where it has them: of a drawn case, in CSV."""
    file: str = ""
    """Of its case, with the folders that it tells; nothing where it does not tell."""
    gears: Sequence[str] = ()
    devices: Sequence[str] = ()
    """Of tables whose columns they are, where it tells them without its case."""

    @property
    def is_of_source(self) -> bool:
        """Whether it is a listing of the source, which has its own tables only."""
        return self.printed and "ratio" not in self.tables

    @property
    def has_own(self) -> bool:
        """Whether its rows tell of elements, which have more than one each, or none."""
        rows = {key: list(self.rows.get(key, ())) for key in ("AMLG", "WFRI", "idle")}
        return bool(rows["AMLG"]) and rows["AMLG"][:-1] != [*rows["WFRI"], *rows["idle"]]

    @property
    def gear_names(self) -> Sequence[str]:
        """Names of its gears; none where it does not tell, as the source has numbers only."""
        if self.is_of_source:
            return ()
        return self.gears or ([gear.name for gear in self.case.gears] if self.case else ())

    @property
    def device_names(self) -> Sequence[str]:
        """Names of its devices; none where it does not tell."""
        if self.is_of_source:
            return ()
        return self.devices or (self.case.devices if self.case else ())

    @property
    def case_name(self) -> str:
        """The name of its case, or nothing."""
        return self.case.name if self.case else ""


GEAR = "gear"
"""The column of a sweep that has a row for each gear."""


class WrittenSweep(NamedTuple):
    """The columns of a sweep, a number for each row in their order."""

    variants: list[int]
    status: list[str]
    columns: dict[str, list[float]]
    """NaN stands for no number."""
    varied: tuple[str, ...] = ()
    """The columns that were varied."""
    gears: Sequence[str] = ()
    """By row, where there is a row for each gear."""
