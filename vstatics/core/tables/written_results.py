"""Numbers of written results, as read from a listing or JSON for a comparison."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission

GEAR_NUMBER = "gear number"
"""Column of a driving cycle with the numbers of gears, which are whole numbers."""


class Figure(NamedTuple):
    """Number as written; NaN: no value."""

    value: float
    slack: float = 0.0
    """Largest rounding error of a number from a listing: half a unit of its last digit."""


Figures = list[list[Figure]]
"""Rows of a table; a list over the gears has a single row."""


class WrittenResult(NamedTuple):
    """Written result of a case: the tables by name."""

    tables: dict[str, Figures]
    case: Transmission | None
    """Case of the result, if known, for the names of rows and gears."""
    printed: bool
    """True if the result was read from a listing."""
    errors: bool = False
    """True if the case failed."""
    rows: Mapping[str, Sequence[str]] = MappingProxyType({})
    """Names of the rows of each table, if written: for a drawn case, or in CSV."""
    file: str = ""
    """File of the case, with folders if written; empty: unknown."""
    gears: Sequence[str] = ()
    """Names of the gears, if written without the case."""
    devices: Sequence[str] = ()
    """Names of the devices, if written without the case."""

    @property
    def is_of_source(self) -> bool:
        """True if the result is a listing of the source, with published tables only."""
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
        """Names of the gears, if known; a listing of the source has numbers only."""
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
"""Column of the gear in a sweep with a row for each gear."""


class WrittenSweep(NamedTuple):
    """Written sweep: columns with a value for each row."""

    variants: list[int]
    status: list[str]
    columns: dict[str, list[float]]
    """Numbers of each column; NaN: no value."""
    varied: tuple[str, ...] = ()
    """Names of the varied columns."""
    gears: Sequence[str] = ()
    """Gear of each row, in a sweep with a row for each gear."""
