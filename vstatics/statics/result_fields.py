"""The arrays that are calculated, and what else a `Results` consists of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.errors import Severity
from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Booleans, Floats, Integers


class Message(NamedTuple):
    """What was noticed in a gear; a gear with an error makes the case fail."""

    severity: Severity
    text: str
    gear: str = ""

    def __str__(self) -> str:
        """The message in one line, with the gear it speaks of."""
        gear = f"gear {self.gear}: " if self.gear else ""
        return f"{self.severity}: {gear}{self.text}"


class ResultFields(NamedTuple):
    """The fields of `Results`.

    The order of axes is the same everywhere: variants first (none for one case), then
    gears, then what `row_names` of `vstatics.statics.arrays` names. Devices are mechanisms
    and drawn elements as the case itself names them; a case that is drawn has other
    mechanisms too, those that the solver made of its elements. NaN stands for what does
    not exist. Speeds are relative to the input
    speed, torques to the input torque, powers to the input power; signs as in
    `vstatics.statics.matrix`.
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

    mesh_torques: Floats
    """(..., gears, meshes), on the first wheel of each mesh of drawn elements. [-]"""
    lossy_mesh_torques: Floats
    """As `mesh_torques`, with losses. [-]"""
    mesh_losses: Floats
    """(..., gears, meshes), power lost. [-]"""

    messages: Sequence[Message] = ()
    """What was noticed; for one case only, not for arrays of variants."""

    @property
    def output_torque(self) -> Floats:
        """Of shape (..., gears), given to the load, without losses [-]."""
        return self.torques[..., -1]

    @property
    def lossy_output_torque(self) -> Floats:
        """Of shape (..., gears), with losses [-]."""
        return self.lossy_torques[..., -1]
