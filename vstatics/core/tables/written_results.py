"""Numbers of written results, as read from a listing or JSON for a comparison."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission

GEAR_NUMBER = "gear number"
"""Column of a written driving cycle that contains the numbers of gears."""


class Figure(NamedTuple):
    """Number as written in a result; NaN without a value."""

    value: float
    slack: float = 0.0
    """Largest rounding error of a number in a listing: half a unit of the last digit."""


Figures = list[list[Figure]]
"""Rows of a table; a table with a value per gear has a single row."""


class WrittenResult(NamedTuple):
    """Result of a case as written in a file: tables by name."""

    tables: dict[str, Figures]
    case: Transmission | None
    """Case of the result, which gives the names of rows and gears, if known."""
    printed: bool
    """True if the result was read from a listing."""
    errors: bool = False
    """True if the case failed."""
    rows: Mapping[str, Sequence[str]] = MappingProxyType({})
    """Names of the rows of each table, if contained in the file (for a drawn case, or in CSV)."""
    file: str = ""
    """File of the case, with folders if written; empty if unknown."""
    gears: Sequence[str] = ()
    """Names of the gears, if the file contains names without the case."""
    devices: Sequence[str] = ()
    """Names of the devices, if the file contains names without the case."""

    @property
    def is_of_source(self) -> bool:
        """True if the result is a listing with the tables of the published report only."""
        return self.printed and "ratio" not in self.tables

    @property
    def has_own(self) -> bool:
        """True if the rows of torques are members of gear sets instead of mechanisms."""
        torques, elements, devices = (
            list(self.rows.get(table, ())) for table in ("torques", "slip_speeds", "idle")
        )
        return bool(torques) and torques[:-1] != elements + devices

    @property
    def gear_names(self) -> Sequence[str]:
        """Names of the gears, if known; a published listing has only numbers."""
        if self.is_of_source:
            return ()
        return self.gears or ([gear.name for gear in self.case.gears] if self.case else ())

    @property
    def device_names(self) -> Sequence[str]:
        """Names of the devices, if known."""
        if self.is_of_source:
            return ()
        return self.devices or (self.case.devices if self.case else ())

    @property
    def case_name(self) -> str:
        """Name of the case; empty if unknown."""
        return self.case.name if self.case else ""


GEAR = "gear"
"""Column of the gear in a sweep with a row for each gear."""


class WrittenSweep(NamedTuple):
    """Sweep as written in a file: columns with a value for each row."""

    variants: list[int]
    status: list[str]
    columns: dict[str, list[float]]
    """Numbers of each column; NaN for a missing value."""
    varied: tuple[str, ...] = ()
    """Names of the varied columns."""
    gears: Sequence[str] = ()
    """Gear of each row, in a sweep with a row for each gear."""
