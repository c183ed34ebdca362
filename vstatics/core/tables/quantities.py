"""All quantities of the results: the one place for what they are called and when they exist.

A new quantity is an array of `vstatics.core.statics.result_arrays.ARRAYS` and an entry here. Each
has one name and one alias, and is known by either wherever a name is typed (`names`). Values of the
tables, JSON, CSV, the listing, the schema of results, the report, the comparison of results
and the names at which a deck ends are read off it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.result_arrays import ARRAYS, Rows
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import LOCKED

KINDS: dict[type, type] = {np.float64: float, np.int16: int, np.bool_: bool}
"""How the numbers of an array are written."""


class Quantity(NamedTuple):
    """A quantity as every format shows it."""

    name: str
    """In the library: that of an array or another attribute of `Results`, if it is one."""
    key: str
    """In JSON and CSV, one of the other two: the deck's, or that of the library."""
    alias: str
    """The deck's name, or one of its kind where the deck has none."""
    heading: str
    """In a listing, without its colon."""
    own_title: str = ""
    """In a report, where it is not that heading."""
    members: tuple[str, str] | None = None
    """Over the second part of a printed table of torques: of mechanisms and the output, and
    of what a drawn case has in place of them. None: the table has one part."""
    own_rows: Rows | None = None
    """Where it is no array of `Results`."""
    is_sign: bool = False
    """Whether it is +1, 0 or -1; its array is one of floats, for what does not exist."""
    columns: Literal["gears", "devices"] = "gears"
    published: bool = False
    """Whether the report of the source has it."""
    exists: Callable[[Results], bool] | None = None
    """Whether a case has what it speaks of; None: every case has."""
    decimals: int = 3
    """In a report."""
    with_load: str = ""
    """The unit in which it is shown, too, where the case has a load."""
    brief: str = ""
    """Over the table in that unit, instead of the heading."""
    unit: str = ""
    """Of its numbers; empty: relative to the input."""
    of: str = ""
    """The relative quantity that this one is in `unit`."""

    @property
    def printed(self) -> str:
        """The name in a listing."""
        return self.alias.replace("_", "").upper()

    @property
    def title(self) -> str:
        """In a report."""
        return self.own_title or self.heading

    @property
    def rows(self) -> Rows:
        """What a row of its table stands for; `one` is a list over the gears."""
        return self.own_rows or ARRAYS[self.name].rows

    @property
    def kind(self) -> type:
        """How a number is written: float, int or bool."""
        if self.is_sign:
            return int
        return KINDS[ARRAYS[self.name].dtype] if self.name in ARRAYS else float

    @property
    def always(self) -> bool:
        """Whether every result has it."""
        return self.exists is None and not self.unit


class Table(NamedTuple):
    """A quantity of a case: rows are links, devices or mechanisms, columns are gears.

    Columns of the distribution matrix are devices. A list over gears is a table of one row.
    """

    quantity: Quantity
    rows: Sequence[str]
    columns: Sequence[str]
    values: Floats
    """(rows, columns), NaN for what does not exist."""


class _Unit(NamedTuple):
    """A unit as headings write it, and the decimals of a report."""

    text: str
    decimals: int


UNITS = {
    "rpm": _Unit("rpm", 1),
    "Nm": _Unit("N*m", 1),
    "kW": _Unit("kW", 3),
}
"""What numbers have with a load, as it stands at the end of a key."""


def headed(name: str, unit: str) -> str:
    """What heads a column of numbers in a unit; an empty one: relative to the input.

    >>> headed("slip", "rpm"), headed("torque", "Nm"), headed("slip", "")
    ('slip, rpm', 'torque, N*m', 'slip')
    """
    return f"{name}, {UNITS[unit].text}" if unit else name


def in_unit(quantity: Quantity) -> Quantity:
    """A relative quantity in the unit that it has with a load.

    Examples
    --------
    >>> from vstatics.core.tables.quantities import BY_NAME
    >>> slip = in_unit(BY_NAME["slip_speeds"])
    >>> slip.name, slip.alias, slip.printed, slip.heading
    ('slip_speeds_rpm', 'WFRI_rpm', 'WFRIRPM', 'Slip speeds of clutches and brakes, rpm')
    """
    unit = quantity.with_load
    written = UNITS[unit]
    heading = quantity.brief or quantity.heading
    return Quantity(
        f"{quantity.name}_{unit}",
        f"{quantity.key}_{unit}",
        f"{quantity.alias}_{unit}",
        f"{heading}, {written.text}",
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
    return results.case.has_drag or bool(np.nan_to_num(results.drag_losses).any())


def _has_meshes(results: Results) -> bool:
    return bool(results.mesh_torques.shape[-1])


RELATIVE = (
    # name in the library, key in JSON and CSV, alias
    Quantity(
        "distribution_matrix",
        "AJK",
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
        "WSAT",
        "Speeds of the planets against the carrier",
        published=True,
        with_load="rpm",
    ),
    Quantity(
        "slip_speeds",
        "WFRI",
        "WFRI",
        "Slip speeds of clutches and brakes",
        published=True,
        with_load="rpm",
    ),
    Quantity(
        "torques",
        "AMLG",
        "AMLG",
        "B. Torques of clutches and brakes, without losses",
        own_title="Torques of shift elements, mechanisms and the output (Mx), without losses",
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
        "AMLGP",
        "C. Torques of clutches and brakes, with losses",
        own_title="Torques of shift elements, mechanisms and the output (Mx), with losses",
        members=(
            "Torques of mechanisms and output, with losses",
            "Torques of the members of the elements and of the output, with losses",
        ),
        published=True,
        with_load="Nm",
        brief="Torques with losses",
    ),
    Quantity("efficiency", "ETA", "ETA", "Efficiency of the gears", published=True, decimals=4),
    Quantity(
        "power_sign",
        "IX",
        "IX",
        "Sign of the power flow, first link drives (+1) or is driven (-1)",
        is_sign=True,
        published=True,
    ),
    Quantity("ratio", "ratio", "RATIO", "Ratio of the gears, input speed to output speed"),
    Quantity(
        "idle",
        "idle",
        "IDLING",
        "Mechanisms without flow of power",
        own_title="Mechanisms that are idle, or one piece",
    ),
    Quantity(
        "losses",
        "losses",
        "LOSS",
        "Power lost in the mechanisms",
        decimals=4,
        with_load="kW",
        brief="Power lost",
    ),
    Quantity(
        "power_balance", "power_balance", "BALANCE", "Balance of power, external power less losses"
    ),
    Quantity("consistent", "consistent", "CONSISTENT", "Directions of power agree with the losses"),
    Quantity("locked", "locked", "LOCKED", LOCKED.english.capitalize()),
    Quantity(
        "dragged",
        "dragged",
        "DRAGGED",
        "Drag takes more than the input gives",
        exists=_has_drag,
    ),
    Quantity(
        "holding_torques",
        "AMWZ",
        "AMWZ",
        "Torques that hold the given speeds, without losses",
        exists=_has_given_speeds,
        with_load="Nm",
    ),
    Quantity(
        "lossy_holding_torques",
        "AMWZP",
        "AMWZP",
        "Torques that hold the given speeds, with losses",
        exists=_has_given_speeds,
        with_load="Nm",
    ),
    Quantity(
        "drag_losses",
        "drag_losses",
        "DRAG",
        "Power that drag of bearings, oil and open elements takes",
        exists=_has_drag,
        decimals=4,
        with_load="kW",
        brief="Power that drag takes",
    ),
    Quantity(
        "holds",
        "holds",
        "HOLDS",
        "Elements that are engaged, and freewheels that hold",
        exists=lambda results: bool(results.case.freewheels),
    ),
    Quantity(
        "mesh_torques",
        "mesh_torques",
        "MESH",
        "Torques of the meshes, on the first wheel or planet, without losses",
        exists=_has_meshes,
        with_load="Nm",
        brief="Torques of the meshes without losses",
    ),
    Quantity(
        "lossy_mesh_torques",
        "lossy_mesh_torques",
        "MESHP",
        "Torques of the meshes, with losses",
        exists=_has_meshes,
        with_load="Nm",
        brief="Torques of the meshes with losses",
    ),
)
"""Those without a unit, in the order in which they are written."""

_ASKED = (
    Quantity(
        "output_torque",
        "output_torque",
        "Mx",
        "Output torque, without losses",
        own_rows="one",
        with_load="Nm",
    ),
    Quantity(
        "lossy_output_torque",
        "lossy_output_torque",
        "MxP",
        "Output torque, with losses",
        own_rows="one",
        with_load="Nm",
    ),
    Quantity(
        "mesh_losses",
        "mesh_losses",
        "MESHLOSS",
        "Power lost in the meshes",
        exists=_has_meshes,
        decimals=4,
        with_load="kW",
    ),
    Quantity("undecided", "undecided", "UNDECIDED", "Search for directions of power was cut short"),
    Quantity("turned", "turned", "TURNED", "Losses turn the flow round"),
    Quantity("choices", "choices", "CHOICES", "Sets of signs that agree with their flow"),
    Quantity("tied_up", "tied_up", "TIEDUP", "Conditions for the speeds contradict each other"),
    Quantity("conflict", "conflict", "CONFLICT", "A freewheel can neither hold nor overrun"),
    Quantity("exact", "exact", "EXACT", "Calculated in fractions, as rounding leaves few digits"),
    Quantity("balanced", "balanced", "BALANCED", "Torques without losses exist"),
    Quantity("missing", "missing", "MISSING", "Conditions that the speeds lack"),
    Quantity("excess", "excess", "EXCESS", "Conditions that others imply or contradict"),
)

_PORTS = (
    Quantity(
        "input_power_kW", "input_power_kW", "PIN_kW", "Input power, kW", own_rows="one", unit="kW"
    ),
    Quantity(
        "output_power_kW",
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
"""Those that a case with a load has, too: by unit, then by their rows."""

QUANTITIES = RELATIVE + WITH_UNITS
"""All that are written, in their order."""

ASKED = _ASKED + tuple(in_unit(quantity) for quantity in _ASKED if quantity.with_load)
"""Those that are written nowhere unless somebody asks for them by name.

The output torque stands in the tables of torques, too, as their last row.
"""

PRINTED = {quantity.printed: quantity for quantity in QUANTITIES}
"""By the name at the head of a table in a listing; there the deck before it ends, too."""

BY_NAME = {name: one for one in QUANTITIES + ASKED for name in (one.name, one.alias)}
"""By either name that a person may type; see `vstatics.core.tables.names`."""
