"""All quantities of the results: names, headings, units, and conditions for their existence.

A new quantity needs an array in `vstatics.core.statics.result_arrays.ARRAYS` and an entry here.
Outputs contain its name, but the listing its deck name. Users can type either name (see `names`).
Tables, JSON, CSV, listing, schema of results, report, comparison of results, and the detection of
the end of a deck are derived from these entries.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.start import NamedTuple
from vstatics.core.statics.result_arrays import ARRAYS, Rows
from vstatics.core.statics.results import Results

KINDS: dict[type, type] = {np.float64: float, np.int16: int, np.bool_: bool}
"""Python type of the written numbers, by the data type of an array."""


class Quantity(NamedTuple):
    """Quantity of the results, as shown in all formats."""

    name: str
    """Name in JSON, CSV, sweeps and Python. Most quantities are arrays of `Results`."""
    deck_name: str
    """Name in listings and decks (or a name of this style), which users can also type."""
    heading: str
    """Heading in a listing, without the colon."""
    own_title: str = ""
    """Title in a report; empty if equal to the heading."""
    members: tuple[str, str] | None = None
    """Headings of the second table of torques in a listing, if there is one.

    The first heading is for mechanisms, the second for members of gear sets in a drawn case.
    """
    own_rows: Rows | None = None
    """Kind of rows, for a quantity that is not an array of `Results`."""
    is_sign: bool = False
    """True if values are +1, 0 or -1; the array contains floats because of NaN."""
    columns: Literal["gears", "devices"] = "gears"
    published: bool = False
    """True for a table of the published report."""
    exists: Callable[[Results], bool] | None = None
    """Condition for the table; None if the table always exists."""
    decimals: int = 3
    """Number of decimals in a report."""
    with_load: str = ""
    """Unit of a further table for a case with an operating point; empty without such a table."""
    brief: str = ""
    """Heading of the table with the unit `with_load`; empty for the usual heading."""
    unit: str = ""
    """Unit of the numbers; empty if relative to the input."""
    of: str = ""
    """Name of the relative quantity that is converted to `unit`; empty without conversion."""

    @property
    def printed(self) -> str:
        """Name in a listing."""
        return self.deck_name.replace("_", "").upper()

    @property
    def title(self) -> str:
        """Title in a report."""
        return self.own_title or self.heading

    @property
    def rows(self) -> Rows:
        """Kind of rows of the table; `one` means a single value per gear."""
        return self.own_rows or ARRAYS[self.name].rows

    @property
    def kind(self) -> type:
        """Python type of a written number: float, int or bool."""
        if self.is_sign:
            return int
        return KINDS[ARRAYS[self.name].dtype] if self.name in ARRAYS else float

    @property
    def always(self) -> bool:
        """True if the table exists for all results."""
        return self.exists is None and not self.unit


class Table(NamedTuple):
    """Table of a quantity, usually with a row for each link or device and a column for each gear.

    The columns of the distribution matrix are devices. A quantity with one value per gear has a
    single row.
    """

    quantity: Quantity
    rows: Sequence[str]
    columns: Sequence[str]
    values: Floats
    """Values, shape (rows, columns); NaN if a value does not exist."""


class _Unit(NamedTuple):
    text: str
    decimals: int


UNITS = {
    "rpm": _Unit("rpm", 1),
    "Nm": _Unit("N*m", 1),
    "kW": _Unit("kW", 3),
}
"""Physical units, by the suffix of the names of quantities."""


def headed(name: str, unit: str) -> str:
    """Return the heading of a column with its unit; relative values have no unit.

    >>> headed("slip", "rpm"), headed("torque", "Nm"), headed("slip", "")
    ('slip, rpm', 'torque, N*m', 'slip')
    """
    return f"{name}, {UNITS[unit].text}" if unit else name


def in_unit(quantity: Quantity) -> Quantity:
    """Return a relative quantity in the physical unit `Quantity.with_load`.

    Examples
    --------
    >>> from vstatics.core.tables.quantities import BY_NAME
    >>> slip = in_unit(BY_NAME["slip_speeds"])
    >>> slip.name, slip.deck_name, slip.printed, slip.heading
    ('slip_speeds_rpm', 'WFRI_rpm', 'WFRIRPM', 'Slip speeds of clutches and brakes, rpm')
    """
    unit = quantity.with_load
    written = UNITS[unit]
    heading = quantity.brief or quantity.heading
    return Quantity(
        f"{quantity.name}_{unit}",
        f"{quantity.deck_name}_{unit}",
        f"{heading}, {written.text}",
        own_title=f"{quantity.own_title}, {written.text}" if quantity.own_title else "",
        own_rows=quantity.rows,
        exists=quantity.exists,
        decimals=written.decimals,
        unit=unit,
        of=quantity.name,
    )


def _has_given_speeds(results: Results) -> bool:
    given = any(gear.speeds for gear in results.case.gears)
    return given and not np.isnan(results.in_own_unit("holding_torques")).all()


def _has_drag(results: Results) -> bool:
    if results.case.has_drag or results.points is None:
        return results.case.has_drag
    return bool(np.count_nonzero(np.abs(results.drag_losses) > 0))


def _has_meshes(results: Results) -> bool:
    return bool(results.mesh_torques.shape[-1])


RELATIVE = (
    Quantity(
        "distribution_matrix",
        "AJK",
        "Structural-distribution matrix, KLG = KL + KG",
        own_title="Structural-distribution matrix",
        published=True,
        own_rows="links",
        columns="devices",
    ),
    Quantity(
        "speeds",
        "W",
        "A. Speeds of the links in each gear",
        own_title="Speeds of the links",
        published=True,
        with_load="rpm",
        brief="Speeds of the links",
    ),
    Quantity(
        "planet_speeds",
        "WSAT",
        "Speeds of the planets against the carrier",
        published=True,
        with_load="rpm",
    ),
    Quantity(
        "slip_speeds",
        "WFRI",
        "Slip speeds of clutches and brakes",
        published=True,
        with_load="rpm",
    ),
    Quantity(
        "torques",
        "AMLG",
        "B. Torques of clutches and brakes, without losses",
        own_title="Torques without losses",
        members=(
            "Torques of mechanisms and output, KLG1 = KLG + 1, without losses",
            "Torques of the members of the elements and of the output, without losses",
        ),
        published=True,
        with_load="Nm",
        brief="Torques without losses",
    ),
    Quantity(
        "lossy_torques",
        "AMLGP",
        "C. Torques of clutches and brakes, with losses",
        own_title="Torques with losses",
        members=(
            "Torques of mechanisms and output, with losses",
            "Torques of the members of the elements and of the output, with losses",
        ),
        published=True,
        with_load="Nm",
        brief="Torques with losses",
    ),
    Quantity("efficiency", "ETA", "Efficiency of the gears", published=True, decimals=4),
    Quantity(
        "power_sign",
        "IX",
        "Sign of the power flow, first link drives (+1) or is driven (-1)",
        own_title="Sign of the power flow through the first link",
        is_sign=True,
        published=True,
    ),
    Quantity("ratio", "RATIO", "Ratio of the gears, input speed to output speed"),
    Quantity(
        "idle",
        "IDLING",
        "Mechanisms without flow of power",
        own_title="Unloaded and locked-up mechanisms",
    ),
    Quantity(
        "losses",
        "LOSS",
        "Power lost in the mechanisms",
        decimals=4,
        with_load="kW",
        brief="Power lost",
    ),
    Quantity("power_balance", "BALANCE", "Balance of power, external power less losses"),
    Quantity("consistent", "CONSISTENT", "Directions of power agree with the losses"),
    Quantity("locked", "LOCKED", "Locked by friction", own_title="Self-locking gears"),
    Quantity(
        "dragged",
        "DRAGGED",
        "Drag takes more than the input gives",
        exists=_has_drag,
    ),
    Quantity(
        "holding_torques",
        "AMWZ",
        "Torques that hold the given speeds, without losses",
        exists=_has_given_speeds,
        with_load="Nm",
    ),
    Quantity(
        "lossy_holding_torques",
        "AMWZP",
        "Torques that hold the given speeds, with losses",
        exists=_has_given_speeds,
        with_load="Nm",
    ),
    Quantity(
        "drag_losses",
        "DRAG",
        "Power that drag of bearings, oil and open elements takes",
        own_title="Power lost to drag",
        exists=_has_drag,
        decimals=4,
        with_load="kW",
        brief="Power that drag takes",
    ),
    Quantity(
        "gear_losses",
        "GEARLOSS",
        "Power that the gears lose as a whole",
        exists=lambda results: any(gear.loss is not None for gear in results.case.gears),
        decimals=4,
        with_load="kW",
        brief="Power lost by the gears as a whole",
    ),
    Quantity(
        "slip_losses",
        "SLIPLOSS",
        "Power that slipping clutches and brakes lose",
        exists=lambda results: any(gear.slip for gear in results.case.gears),
        decimals=4,
        with_load="kW",
    ),
    Quantity(
        "holds",
        "HOLDS",
        "Elements that are engaged, and freewheels that hold",
        exists=lambda results: bool(results.case.freewheels),
    ),
    Quantity(
        "mesh_torques",
        "MESH",
        "Torques of the meshes, on the first wheel or planet, without losses",
        own_title="Torques of the meshes without losses",
        exists=_has_meshes,
        with_load="Nm",
        brief="Torques of the meshes without losses",
    ),
    Quantity(
        "lossy_mesh_torques",
        "MESHP",
        "Torques of the meshes, with losses",
        exists=_has_meshes,
        with_load="Nm",
        brief="Torques of the meshes with losses",
    ),
)
"""Relative quantities, in the order of the written tables."""

_ASKED = (
    Quantity(
        "output_torque",
        "Mx",
        "Output torque, without losses",
        own_rows="one",
        with_load="Nm",
    ),
    Quantity(
        "lossy_output_torque",
        "MxP",
        "Output torque, with losses",
        own_rows="one",
        with_load="Nm",
    ),
    Quantity(
        "mesh_losses",
        "MESHLOSS",
        "Power lost in the meshes",
        exists=_has_meshes,
        decimals=4,
        with_load="kW",
    ),
    Quantity("speed_ratio", "TCRATIO", "Speed ratios of converters, turbine to pump"),
    Quantity("undecided", "UNDECIDED", "Torques with losses are not known"),
    Quantity("turned", "TURNED", "Losses turn the flow round"),
    Quantity("choices", "CHOICES", "Sets of signs that agree with their flow"),
    Quantity("tied_up", "TIEDUP", "Constraints on the speeds contradict each other"),
    Quantity("conflict", "CONFLICT", "A freewheel can neither hold nor overrun"),
    Quantity("exact", "EXACT", "Calculated in fractions, as rounding leaves few digits"),
    Quantity("balanced", "BALANCED", "Torques without losses exist"),
    Quantity("missing", "MISSING", "Constraints that the speeds lack"),
    Quantity("excess", "EXCESS", "Constraints that others imply or contradict"),
)

_PORTS = (
    Quantity("input_power_kW", "PIN_kW", "Input power, kW", own_rows="one", unit="kW"),
    Quantity(
        "output_power_kW",
        "POUT_kW",
        "Output power with losses, kW",
        own_rows="one",
        unit="kW",
    ),
)

_ORDER: tuple[Rows, ...] = ("torques", "meshes", "links", "planets", "devices", "elements", "one")

WITH_UNITS = (
    *sorted(
        (in_unit(quantity) for quantity in RELATIVE if quantity.with_load),
        key=lambda quantity: (list(UNITS).index(quantity.unit), _ORDER.index(quantity.rows)),
    ),
    *_PORTS,
)
"""Quantities with physical units for a case with an operating point, by unit and kind of rows."""

QUANTITIES = RELATIVE + WITH_UNITS
"""All written quantities, in the order of the tables."""

ASKED = _ASKED + tuple(in_unit(quantity) for quantity in _ASKED if quantity.with_load)
"""Quantities in outputs only if users request them by name.

The output torque is such a quantity, because it is also the last row of the tables of torques.
"""

PRINTED = {quantity.printed: quantity for quantity in QUANTITIES}
"""Quantities by name in a listing. Such a name also ends the deck above."""

BY_NAME = {
    name: quantity
    for quantity in QUANTITIES + ASKED
    for name in (quantity.name, quantity.deck_name)
}
"""Quantities by name and by deck name; see `vstatics.core.tables.names`."""
