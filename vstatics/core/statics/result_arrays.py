"""The arrays of `Results`: which there are, what their last axis stands for, their type."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.errors import Severity, severity
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers

if TYPE_CHECKING:
    from typing import Self, dataclass_transform

    @dataclass_transform(frozen_default=True)
    class _NamedFields:
        """A named tuple, but for its subscripts: those of results are names.

        A checker of types takes every subscript of a tuple for the number of an item.
        """

        _fields: ClassVar[tuple[str, ...]]

        def _replace(self, **changes: Any) -> Self: ...
        def __iter__(self) -> Iterator[Any]: ...

else:
    _NamedFields = NamedTuple


class Message(NamedTuple):
    """What was noticed in a gear; a gear with an error makes the case fail.

    Examples
    --------
    >>> str(Message("W414", "1 condition is missing", gear="N"))
    'warning: gear N: 1 condition is missing [W414]'
    """

    id: str
    """As that of a `Problem`."""
    text: str
    gear: str = ""

    @property
    def severity(self) -> Severity:
        """Whether it is an error, a warning or a note."""
        return severity(self.id)

    def __str__(self) -> str:
        """The message in one line, with the gear it speaks of."""
        gear = f"gear {self.gear}: " if self.gear else ""
        return f"{self.severity}: {gear}{self.text} [{self.id}]"


Outside: TypeAlias = Mapping[str, Booleans]
"""By the name of what has a law, (variants, gears): where it is asked outside its points."""
NOWHERE: Outside = MappingProxyType({})


class OperatingPoints(NamedTuple):
    """Loads that vary, and the gears with numbers that vary: arrays over the variants."""

    scales: Mapping[str, Floats]
    """By unit (rpm, Nm, kW), (variants, gears): `scales` of `vstatics.core.statics.physical`."""
    loaded: Booleans
    """(variants, gears): the load gives a torque, or does not tell it."""
    gears: Sequence[Gear]
    """With arrays, of shape (variants,), where torques vary; of one case with the drags that
    follow from its speeds."""
    efficiencies: Sequence[Sequence[Any]] = ()
    """Of one case, by gear and mechanism: where they depend on speed or torque. [-]"""
    open: Integers | None = None
    """(variants, gears): 0, or 1 where no, 2 where several torques agree with efficiencies that
    depend on them."""
    outside: Outside = NOWHERE
    """Laws that were asked outside their points."""


class ResultFields(_NamedFields):
    """The fields of `Results`.

    The order of axes is the same everywhere: variants first (none for one case), then
    gears, then what `row_names` of `vstatics.core.statics.result_arrays` names. Devices are
    mechanisms and drawn elements as the case itself names them; a case that is drawn has other
    mechanisms too, those that the solver made of its elements. NaN stands for what does
    not exist. Speeds are relative to the input
    speed, torques to the input torque, powers to the input power; signs as in
    `vstatics.core.statics.matrix`.
    """

    case: Transmission
    """What was calculated, with the conventions that were used."""

    speeds: Floats
    """(..., gears, links). [-]"""
    planet_speeds: Floats
    """(..., gears, planets), against the third link (carrier). [-]"""
    slip_speeds: Floats
    """(..., gears, shift elements), first link against second. [-]"""
    ratio: Floats
    """(..., gears), ``w_input/w_output``. [-]"""

    torques: Floats
    """(..., gears, shift elements + mechanisms + springs + 1), on the first link of each; the
    last is the output torque, given to the load; of a spring it is its own torque. In place of
    a drawn element stand its members: what their links give to them. Without losses. [-]"""
    holding_torques: Floats
    """(..., gears, links), the external torque that holds a given speed. [-]"""

    lossy_torques: Floats
    """As `torques`, with losses. [-]"""
    lossy_holding_torques: Floats
    """As `holding_torques`, with losses. [-]"""
    efficiency: Floats
    """(..., gears). [-]"""
    power_sign: Floats
    """(..., gears, mechanisms): +1 the first link drives, -1 it is driven, 0 idle. [-]"""
    idle: Booleans
    """(..., gears, devices): carries no torque, or turns as one piece."""
    losses: Floats
    """(..., gears, devices), power lost; below 0 when coasting, as the flow turns. [-]"""
    power_balance: Floats
    """(..., gears), external power less all losses, with losses: 0 to rounding. [-]"""
    drag_losses: Floats
    """(..., gears), power that drag takes in all; below 0 when coasting. [-]"""

    consistent: Booleans
    """(..., gears): the lossy torques stand, with signs that agree with their flow."""
    locked: Booleans
    """(..., gears): locked by friction."""
    dragged: Booleans
    """(..., gears): drag takes more than the input gives, so power enters at the output."""
    undecided: Booleans
    """(..., gears): the search for signs was cut short, so `locked` is unknown."""
    turned: Booleans
    """(..., gears, mechanisms): losses turn the flow round."""
    choices: Integers
    """(..., gears): how many sets of signs agree with their flow."""

    tied_up: Booleans
    """(..., gears): the conditions for the speeds contradict each other."""
    missing: Integers
    """(..., gears): conditions that the speeds lack."""
    excess: Integers
    """(..., gears): conditions for the speeds that others imply or contradict."""
    balanced: Booleans
    """(..., gears): torques without losses exist."""

    holds: Booleans
    """(..., gears, shift elements): is engaged, or a freewheel that holds."""
    conflict: Booleans
    """(..., gears): a freewheel can neither hold nor overrun."""
    exact: Booleans
    """(..., gears): calculated in fractions, as floats leave too few digits."""

    mesh_torques: Floats
    """(..., gears, meshes), on the first wheel of each mesh of drawn elements. [-]"""
    lossy_mesh_torques: Floats
    """As `mesh_torques`, with losses. [-]"""
    mesh_losses: Floats
    """(..., gears, meshes), power lost. [-]"""

    messages: Sequence[Message] = ()
    """What was noticed; for one case only, not for arrays of variants."""

    points: OperatingPoints | None = None
    """The loads, and what else of the gears varies, if more than ratios and efficiencies do."""

    @property
    def output_torque(self) -> Floats:
        """Of shape (..., gears), given to the load, without losses [-]."""
        return self.torques[..., -1]

    @property
    def lossy_output_torque(self) -> Floats:
        """Of shape (..., gears), with losses [-]."""
        return self.lossy_torques[..., -1]


Rows = Literal["links", "planets", "elements", "devices", "mechanisms", "torques", "meshes", "one"]
"""What the rows of an array or a table stand for.

`elements` are shift elements; `devices` mechanisms and drawn elements as the case names
them; `mechanisms` those that the solver knows; `torques` shift elements, mechanisms or
members of drawn elements, springs, and the output; `meshes` those of a case that is drawn, with
planets as links; `one`: a value of the gear itself.
"""


GearTable: TypeAlias = Literal[
    "ratio",
    "efficiency",
    "power_balance",
    "consistent",
    "locked",
    "dragged",
    "drag_losses",
    "drag_losses_kW",
    "input_power_kW",
    "output_power_kW",
    "output_torque",
    "lossy_output_torque",
    "output_torque_Nm",
    "lossy_output_torque_Nm",
    "undecided",
    "choices",
    "tied_up",
    "conflict",
    "exact",
    "balanced",
    "missing",
    "excess",
]
"""Tables of one value for each gear: for checkers of types, to whom a table and a gear are a
number there, else a table and a row an array."""


class GearArray(NamedTuple):
    """An array of `Results`."""

    rows: Rows
    dtype: type = np.float64


ARRAYS: Mapping[str, GearArray] = {
    "speeds": GearArray("links"),
    "planet_speeds": GearArray("planets"),
    "slip_speeds": GearArray("elements"),
    "ratio": GearArray("one"),
    "torques": GearArray("torques"),
    "holding_torques": GearArray("links"),
    "lossy_torques": GearArray("torques"),
    "lossy_holding_torques": GearArray("links"),
    "efficiency": GearArray("one"),
    "power_sign": GearArray("mechanisms"),
    "idle": GearArray("devices", np.bool_),
    "losses": GearArray("devices"),
    "power_balance": GearArray("one"),
    "drag_losses": GearArray("one"),
    "consistent": GearArray("one", np.bool_),
    "locked": GearArray("one", np.bool_),
    "dragged": GearArray("one", np.bool_),
    "undecided": GearArray("one", np.bool_),
    "turned": GearArray("mechanisms", np.bool_),
    "choices": GearArray("one", np.int16),
    "tied_up": GearArray("one", np.bool_),
    "missing": GearArray("one", np.int16),
    "excess": GearArray("one", np.int16),
    "balanced": GearArray("one", np.bool_),
    "holds": GearArray("elements", np.bool_),
    "conflict": GearArray("one", np.bool_),
    "exact": GearArray("one", np.bool_),
    "mesh_torques": GearArray("meshes"),
    "lossy_mesh_torques": GearArray("meshes"),
    "mesh_losses": GearArray("meshes"),
}
"""By name, in the order of the fields of `Results`."""

OUTPUT = "Mx"
"""The name of the row of the output torque."""


def row_names(case: Transmission, rows: Rows) -> list[str]:
    """The names of the rows of an array; none for a value of the gear itself.

    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> row_names(case, "torques"), row_names(case, "one")
    (['D1', 'Mx'], [])
    """
    return all_row_names(case)[rows]


def first_rows(case: Transmission) -> dict[int, str]:
    """Index of a mechanism -> the row of the torque on its first link alone, where there is one.

    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> first_rows(Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()]))
    {0: 'D1'}
    """
    return {
        index: f"{device.name}.{member.name}" if case.drawing else device.name
        for device in case.own_devices
        for member in device.members
        for index, place in (member.places if len(member.places) == 1 else ())
        if place == 0
    }


def all_row_names(case: Transmission) -> dict[Rows, list[str]]:
    """The names of the rows of each kind."""
    elements = [element.name for element in case.shift_elements]
    mechanisms = [mechanism.name for mechanism in case.mechanisms]
    devices = planets = members = mechanisms
    meshes: list[str] = []
    if case.drawing is not None:
        own = case.own_devices
        devices = [device.name for device in own]
        planets = [planet.name for device in own for planet in device.planets]
        members = [f"{one.name}.{member.name}" for one in own for member in one.members]
        meshes = [mechanisms[index] for one in own for index, _ in one.meshes_by_index]
    return {
        "links": list(case.link_names[: case.own_links]),
        "planets": planets,
        "elements": elements,
        "devices": devices,
        "mechanisms": mechanisms,
        "torques": [*elements, *members, *(spring.name for spring in case.springs), OUTPUT],
        "meshes": meshes,
        "one": [],
    }


def row_counts(case: Transmission) -> dict[str, int | None]:
    """How many values a gear has in each array of `Results`; None for one of the gear itself."""
    names = all_row_names(case)
    return {
        name: None if array.rows == "one" else len(names[array.rows])
        for name, array in ARRAYS.items()
    }
