"""Numbers of written results, read from a listing or from JSON for a comparison."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission

GEAR_NUMBER = "gear number"
"""Name of the column with the numbers of gears in a driving cycle, which are whole numbers."""


class Figure(NamedTuple):
    """Number as written; NaN means a missing number."""

    value: float
    slack: float = 0.0
    """Largest possible rounding error of a number in a listing: half a unit of the last digit."""


Figures = list[list[Figure]]
"""Rows of a table; a quantity with one number per gear has a single row."""


class WrittenResult(NamedTuple):
    """Written result of a case, which contains tables by name."""

    tables: dict[str, Figures]
    case: Transmission | None
    """Case of the result, which names rows and gears; None if unknown."""
    printed: bool
    """Whether the result was read from a listing."""
    errors: bool = False
    """Whether the case had errors, so that there are no results."""
    rows: Mapping[str, Sequence[str]] = MappingProxyType({})
    """Names of the rows of each table, if known: for drawn cases, or from CSV."""
    file: str = ""
    """File name of the case, with folders if written; empty if unknown."""
    gears: Sequence[str] = ()
    """Names of the gears, if the result was written without the case."""
    devices: Sequence[str] = ()
    """Names of the devices, if the result was written without the case."""

    @property
    def is_of_source(self) -> bool:
        """Whether the result is a listing of the source, which contains only published tables."""
        return self.printed and "ratio" not in self.tables

    @property
    def has_own(self) -> bool:
        """Whether rows of torques are members of gear sets, not mechanisms."""
        torques, elements, devices = (
            list(self.rows.get(table, ())) for table in ("torques", "slip_speeds", "idle")
        )
        return bool(torques) and torques[:-1] != elements + devices

    @property
    def gear_names(self) -> Sequence[str]:
        """Names of the gears, if known; in a listing of the source, gears have only numbers."""
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
        """Name of the case, or an empty text."""
        return self.case.name if self.case else ""


GEAR = "gear"
"""Name of the column of gears in a sweep with one row per gear."""


class WrittenSweep(NamedTuple):
    """Written sweep, whose columns have one value per row."""

    variants: list[int]
    status: list[str]
    columns: dict[str, list[float]]
    """Numbers of each column; NaN means a missing number."""
    varied: tuple[str, ...] = ()
    """Names of the columns with varied quantities."""
    gears: Sequence[str] = ()
    """Gear of each row, for a sweep with one row per gear."""
