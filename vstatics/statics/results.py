"""Results: named arrays, and what was noticed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from vstatics.errors import Severity
from vstatics.model.transmission import SpeedOf, Transmission
from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.statics.freewheels import find_state
from vstatics.statics.state import GearState
from vstatics.statics.status import OK, Status, statuses

if TYPE_CHECKING:
    import pandas as pd

Language = Literal["en", "ru"]
"""Of the headings of a listing and of a deck."""


class Message(NamedTuple):
    """What was noticed in a gear; a gear with an error makes the case fail."""

    severity: Severity
    text: str
    gear: str = ""

    def __str__(self) -> str:
        """The message in one line, with the gear it speaks of."""
        gear = f"gear {self.gear}: " if self.gear else ""
        return f"{self.severity}: {gear}{self.text}"


class Results(NamedTuple):
    """Everything that is calculated, for every gear.

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
    """(..., gears, shift elements + mechanisms + 1), on the first link of each; the last is
    the output torque, given to the load. In place of a drawn element stand its members:
    what their links give to them. Without losses. [-]"""
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

    def to_dataframe(self) -> pd.DataFrame:
        """One row per variant and gear, a column per table and row; needs pandas.

        `vstatics.tables.dataframe.to_dataframe`, put in its place by `vstatics/__init__`.
        """
        raise NotImplementedError

    @property
    def calculable(self) -> Booleans:
        """Of shape (..., gears): speeds and torques exist, so that losses can be asked for."""
        return self.balanced & ~self.tied_up & ~self.conflict

    def existing(self, name: str) -> Floats:
        """An array by its name, with NaN where there is nothing to be said.

        Whether a mechanism is idle, or a gear locked, is a question only for gears with
        speeds and torques; elsewhere the marks are 0.

        >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
        >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)],
        ...                     [Gear([1]), Gear([], name="N")])
        >>> solve(case).existing("locked")
        array([ 0., nan])
        """
        array: Floats = getattr(self, name)
        if name not in ("idle", "consistent", "locked"):
            return array
        exists = self.calculable & ~self.undecided if name == "locked" else self.calculable
        return np.where(exists[..., None] if name == "idle" else exists, array, np.nan)

    @property
    def output_torque(self) -> Floats:
        """Of shape (..., gears), without losses [-]."""
        return self.torques[..., -1]

    def gear(self, number: int) -> GearState:
        """The state of a gear of one case: its speeds, torques, powers and status as one object.

        Parameters
        ----------
        number : int
            From 1, in the order of the case.

        Raises
        ------
        ValueError
            For arrays of variants, or if there is no such gear.
        """
        if self.ratio.ndim != 1:
            raise ValueError(f"results of shape {self.ratio.shape}: a gear is one of a single case")
        if not 1 <= number <= len(self.case.gears):
            raise ValueError(f"gear {number}: expected 1 to {len(self.case.gears)}")
        mechanisms = self.case.mechanisms
        with np.errstate(all="ignore"):
            return find_state(
                self.case,
                self.case.gears[number - 1],
                [one.ratio for one in mechanisms],
                [one.efficiency for one in mechanisms],
            )

    def status(self, number: int) -> Status:
        """What is to be said of a gear of one case as a whole; its number counts from 1."""
        index, case = number - 1, self.case
        output = case.gear_output(case.gears[index])
        found = statuses(
            tied_up=bool(self.tied_up[index]),
            conflict=bool(self.conflict[index]),
            output_speed=float(self.speeds[index, output - 1]),
            balanced=bool(self.balanced[index]),
            locked=bool(self.locked[index]),
            undecided=bool(self.undecided[index]),
        )
        return found[0] if found else OK

    @property
    def with_freewheels_engaged(self) -> Transmission:
        """The case with every freewheel engaged in the gears where it holds, as a plain element.

        Of one case, not of arrays of variants.
        """
        case = self.case
        if not case.freewheels:
            return case
        plain = [e._replace(kind="") if e.is_freewheel else e for e in case.shift_elements]
        gears = [
            gear._replace(
                engaged=(*gear.engaged, *(n for n in case.freewheels if holds[n - 1])),
            )
            for gear, holds in zip(case.gears, self.holds.tolist(), strict=True)
        ]
        return replace(case, shift_elements=plain, gears=gears)

    @property
    def with_numbers_only(self) -> Transmission:
        """The case as a deck can tell it: freewheels engaged, speeds of other links as numbers.

        A speed that is not determined is left out. Of one case, not of arrays of variants.
        """
        case = self.with_freewheels_engaged
        if not any(isinstance(v, SpeedOf) for gear in case.gears for v in gear.speeds.values()):
            return case
        gears = []
        for gear, speeds in zip(case.gears, self.speeds.tolist(), strict=True):
            numbers = {
                link: speeds[link - 1] if isinstance(given, SpeedOf) else given
                for link, given in gear.speeds.items()
            }
            known = {link: speed for link, speed in numbers.items() if not math.isnan(speed)}
            gears.append(gear._replace(speeds=known))
        return replace(case, gears=gears)

    @property
    def failed(self) -> bool:
        """Whether a gear is tied up, or its freewheels in conflict: then the case fails."""
        return bool(self.tied_up.any() or self.conflict.any())
