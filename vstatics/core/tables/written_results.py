"""Results read from a listing, JSON or other file, for a comparison."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Transmission

GEAR_NUMBER = "gear number"
"""Column with the numbers of gears in the output for a driving cycle."""


class Figure(NamedTuple):
    """Number read from a result; NaN if its value is missing."""

    value: float
    slack: float = 0.0
    """Largest rounding error of a number in a listing: half a unit of the last digit."""


Figures = list[list[Figure]]
"""Rows of a table. A table with a value per gear has a single row."""


class WrittenResult(NamedTuple):
    """Result of a case as written in a file: tables by name."""

    tables: dict[str, Figures]
    case: Transmission | None
    """Case of the result, which contains the names of rows and gears; None if unknown."""
    printed: bool
    """True if the result was read from a listing."""
    errors: bool = False
    """True if the case failed."""
    rows: Mapping[str, Sequence[str]] = EMPTY
    """Names of the rows of each table, if the file contains them (for a drawn case, or in CSV)."""
    file: str = ""
    """File of the case, with its folders if the result contains them; empty if unknown."""
    gears: Sequence[str] = ()
    """Names of the gears, if the file contains names but not the case."""
    devices: Sequence[str] = ()
    """Names of the devices, if the file contains names but not the case."""

    @property
    def is_of_source(self) -> bool:
        """True for a listing that has only the tables of the published report."""
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
        """Names of the gears; empty if unknown, as in a published listing."""
        if self.is_of_source:
            return ()
        return self.gears or ([gear.name for gear in self.case.gears] if self.case else ())

    @property
    def device_names(self) -> Sequence[str]:
        """Names of the devices; empty if unknown."""
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
    gear_names: Mapping[float, str] = EMPTY
    """Names of gears by their number, in the time steps of a driving cycle."""
