"""Arrays of `Results`: names, types, and the meaning of the last axis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal, TypeAlias

import numpy as np

from vstatics.core.errors import Severity, severity
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.named_tuple import NamedTuple
from vstatics.core.numerics.arrays import Booleans, Floats, Integers

if TYPE_CHECKING:
    from typing import Self, dataclass_transform

    @dataclass_transform(frozen_default=True)
    class _NamedFields:
        """Named tuple that is subscripted with names."""

        _fields: ClassVar[tuple[str, ...]]

        def _replace(self, **changes: Any) -> Self: ...
        def __iter__(self) -> Iterator[Any]: ...

else:
    _NamedFields = NamedTuple


class Message(NamedTuple):
    """Error, warning or note about a gear; an error makes the case fail.

    Examples
    --------
    >>> str(Message("W414", "1 condition is missing", gear="N"))
    'warning: gear N: 1 condition is missing [W414]'
    """

    id: str
    """Identifier, as in a `Problem`."""
    text: str
    gear: str = ""

    @property
    def severity(self) -> Severity:
        """Severity of the message, from the identifier."""
        return severity(self.id)

    def __str__(self) -> str:
        """Return the message in a single line, with the name of the gear."""
        gear = f"gear {self.gear}: " if self.gear else ""
        return f"{self.severity}: {gear}{self.text} [{self.id}]"


Outside: TypeAlias = Mapping[str, Booleans]
"""Flags of laws evaluated outside their points, shape (variants, gears), by name of the part."""


class OperatingPoints(NamedTuple):
    """Operating points of variants, and gears whose numbers differ between variants."""

    scales: Mapping[str, Floats]
    """Factors by unit from `vstatics.core.statics.physical.scales`, shape (variants, gears)."""
    loaded: Booleans
    """False if the input torque of the operating point is 0, shape (variants, gears)."""
    gears: Sequence[Gear]
    """Gears of the case, in which a torque that varies is an array of shape (variants,).

    For a single variant, the drag of the gears is evaluated at their speeds.
    """
    efficiencies: Sequence[Sequence[Any]] = ()
    """Efficiencies that depend on speed or torque, by gear and mechanism. [-]"""
    open: Integers | None = None
    """State of each gear, shape (variants, gears); 0 for a unique solution.

    Efficiencies that depend on torque: 1 no solution, 2 several solutions, 5 a formula that gives
    no efficiency. Torque that balances a battery: 3 no solution, 4 several solutions. Speed ratio
    of a converter: 6 none agrees with the load, 7 no torques exist at any speed ratio.
    """
    outside: Outside = EMPTY
    """Flags of laws evaluated outside their points."""
    other_ratios: Mapping[int, Sequence[float]] = EMPTY
    """Smaller speed ratios at which a converter agrees with the load of a single point, by gear."""


class ResultFields(_NamedFields):
    """Fields of `Results`.

    Axes are always in the same order: variants (absent for a single case), gears, and rows such as
    links (see `row_names`). Devices are the mechanisms and drawn gear sets named in the case. The
    axis `mechanisms` refers to the mechanisms of the solver, including mechanisms derived from
    drawn gear sets. NaN marks values that do not exist. Speeds are relative to the input speed,
    torques to the input torque, powers to the input power; signs follow
    `vstatics.core.statics.matrix`.
    """

    case: Transmission
    """The transmission, with the conventions used."""

    speeds: Floats
    """Speeds of links, ``(..., gears, links)``. [-]"""
    planet_speeds: Floats
    """Speeds of planets relative to the third link (carrier), ``(..., gears, planets)``. [-]"""
    slip_speeds: Floats
    """Speed of the first link minus the second, ``(..., gears, shift elements)``. [-]"""
    ratio: Floats
    """Ratio ``w_input/w_output``, ``(..., gears)``. [-]"""
    speed_ratio: Floats
    """Speed ratios of converters, ``(..., gears, converters)``; NaN if locked up or drained. [-]"""

    torques: Floats
    """Torques without losses, ``(..., gears, shift elements + mechanisms + springs + 1)``. [-]

    The torque of a shift element, mechanism or spring is the torque that its first link gives to
    it. The last row is the output torque, given to the load. If the case has drawn gear sets, each
    gear set and mechanism has instead a row for each member: the torque that the member's link
    gives to the member.
    """
    holding_torques: Floats
    """External torques that hold given speeds, ``(..., gears, links)``. [-]"""

    lossy_torques: Floats
    """Torques with losses, in the layout of `torques`. [-]"""
    lossy_holding_torques: Floats
    """Holding torques with losses, in the layout of `holding_torques`. [-]"""
    efficiency: Floats
    """Efficiency, ``(..., gears)``. [-]"""
    power_sign: Floats
    """Sign of power, ``(..., gears, mechanisms)``: +1 first link drives, -1 driven. [-]

    Without power the convention `Transmission.idle` determines the sign, by default 0.
    """
    idle: Booleans
    """Flags of devices that have no torque or are locked up, ``(..., gears, devices)``."""
    losses: Floats
    """Power losses, negative when coasting (reversed flow), ``(..., gears, devices)``. [-]"""
    power_balance: Floats
    """External power minus all losses, ``(..., gears)``; 0 except for rounding. [-]"""
    drag_losses: Floats
    """Total power lost to drag, negative when coasting, ``(..., gears)``. [-]"""
    gear_losses: Floats
    """Loss measured for whole gears (`Gear.loss`), negative when coasting, ``(..., gears)``. [-]"""
    slip_losses: Floats
    """Power lost by prescribed slip, ``(..., gears, shift elements)``. [-]"""

    consistent: Booleans
    """Gears whose torques with losses agree with the directions of power, ``(..., gears)``."""
    locked: Booleans
    """Self-locking gears, ``(..., gears)``."""
    dragged: Booleans
    """Gears whose drag exceeds the input power, so power enters at the output, ``(..., gears)``."""
    undecided: Booleans
    """Gears for which the search for power directions ended early, ``(..., gears)``.

    The array `locked` is then unknown.
    """
    turned: Booleans
    """Mechanisms in which losses reverse the power flow, ``(..., gears, mechanisms)``."""
    choices: Integers
    """Number of possible combinations of power directions in mechanisms, ``(..., gears)``."""

    tied_up: Booleans
    """Gears with contradictory constraints on the speeds, ``(..., gears)``."""
    missing: Integers
    """Number of constraints that the speeds lack, ``(..., gears)``."""
    excess: Integers
    """Number of redundant or contradictory constraints on the speeds, ``(..., gears)``."""
    balanced: Booleans
    """Gears for which torques without losses exist, ``(..., gears)``."""

    holds: Booleans
    """Shift elements that carry torque: engaged, slipping, or freewheels that hold.

    Shape ``(..., gears, shift elements)``.
    """
    conflict: Booleans
    """Gears with a freewheel that can neither hold nor overrun, ``(..., gears)``."""
    exact: Booleans
    """Gears calculated in fractions because floats leave too few digits, ``(..., gears)``."""

    mesh_torques: Floats
    """Torque on the first gear of each mesh of drawn gear sets, ``(..., gears, meshes)``. [-]"""
    lossy_mesh_torques: Floats
    """Mesh torques with losses, in the layout of `mesh_torques`. [-]"""
    mesh_losses: Floats
    """Power lost in each mesh, ``(..., gears, meshes)``. [-]"""

    messages: Sequence[Message] = ()
    """Messages about the gears of a case; empty for arrays of variants."""

    points: OperatingPoints | None = None
    """Operating points and gears of the variants; None if only ratios and efficiencies vary."""

    @property
    def output_torque(self) -> Floats:
        """Output torque without losses, given to the load, shape ``(..., gears)`` [-]."""
        return self.torques[..., -1]

    @property
    def lossy_output_torque(self) -> Floats:
        """Output torque with losses, given to the load, shape ``(..., gears)`` [-]."""
        return self.lossy_torques[..., -1]


Rows = Literal[
    "links",
    "planets",
    "elements",
    "devices",
    "mechanisms",
    "torques",
    "meshes",
    "converters",
    "one",
]
"""Meaning of the rows of an array or a table.

`elements` are shift elements, `devices` the mechanisms and drawn gear sets of the case, and
`mechanisms` the mechanisms of the solver. `torques` are shift elements, mechanisms or members of
drawn gear sets, springs, and the output. `meshes` are the meshes of drawn gear sets, `converters`
the mechanisms of the kind `converter`. `one` is a single value for the gear.
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
    "gear_losses",
    "gear_losses_kW",
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
"""Tables with a single value for each gear.

The list lets type checkers infer a number for ``results["ratio", "low"]``, but an array for any
other table and gear.
"""


class GearArray(NamedTuple):
    """Meaning of the rows, and data type, of an array of `Results`."""

    rows: Rows
    dtype: type = np.float64


ARRAYS: Mapping[str, GearArray] = {
    "speeds": GearArray("links"),
    "planet_speeds": GearArray("planets"),
    "slip_speeds": GearArray("elements"),
    "ratio": GearArray("one"),
    "speed_ratio": GearArray("converters"),
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
    "gear_losses": GearArray("one"),
    "slip_losses": GearArray("elements"),
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
"""Arrays of `Results` by name, in the order of the fields."""

OUTPUT = "Mx"
"""Name of the row of the output torque."""


def row_names(case: Transmission, rows: Rows) -> list[str]:
    """Return the names of the rows of an array; empty for a value of the whole gear.

    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> row_names(case, "torques"), row_names(case, "one")
    (['D1', 'Mx'], [])
    """
    return all_row_names(case)[rows]


def first_rows(case: Transmission) -> dict[int, int]:
    """Return the row of `torques` that contains the torque on a first link, by mechanism index.

    Mechanisms whose torque is only a term of a sum are left out.

    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2, 0)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> first_rows(case)
    {0: 1}
    """
    before = len(case.shift_elements)
    if case.drawing is None:
        return {index: before + index for index in range(len(case.mechanisms))}
    members = (member for device in case.own_devices for member in device.members)
    return {
        index: row
        for row, member in enumerate(members, before)
        for index, place in (member.places if len(member.places) == 1 else ())
        if place == 0
    }


def all_row_names(case: Transmission) -> dict[Rows, list[str]]:
    """Return the names of the rows of each kind."""
    elements = [element.name for element in case.shift_elements]
    mechanisms = [mechanism.name for mechanism in case.mechanisms]
    devices = planets = members = mechanisms
    meshes: list[str] = []
    if case.drawing is not None:
        devices_of_case = case.own_devices
        devices = [device.name for device in devices_of_case]
        planets = [planet.name for device in devices_of_case for planet in device.planets]
        members = [
            f"{device.name}.{member.name}"
            for device in devices_of_case
            for member in device.members
        ]
        meshes = [
            mechanisms[index] for device in devices_of_case for index, _ in device.meshes_by_index
        ]
    return {
        "links": list(case.link_names[: case.own_links]),
        "planets": planets,
        "elements": elements,
        "devices": devices,
        "mechanisms": mechanisms,
        "torques": [*elements, *members, *(spring.name for spring in case.springs), OUTPUT],
        "meshes": meshes,
        "converters": [part.name for part in case.mechanisms if part.kind == "converter"],
        "one": [],
    }


def row_counts(case: Transmission) -> dict[str, int | None]:
    """Return the number of rows of each array of `Results`; None for a single value per gear."""
    names = all_row_names(case)
    return {
        name: None if array.rows == "one" else len(names[array.rows])
        for name, array in ARRAYS.items()
    }
