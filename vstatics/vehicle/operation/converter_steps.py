"""Steps of a driving cycle in a gear with a free converter.

The speed ratio is the largest at which speed and torque at the wheels agree with the torque of the
pump. The engine is at its first full-load point or above. The converter can drive too much even at
its largest ratio. Then the engine turns at this ratio and supplies the torque that the pump takes,
and the brakes absorb the excess. If the converter can only brake more than necessary, it has its
free ratio, without torque, and the brakes do all the braking.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics.solve import solve
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.converter import (
    FASTEST_OF_SEARCH,
    Carried,
    ConverterGear,
    EngineSearch,
    relative_slips,
)
from vstatics.vehicle.tolerances import SAME_ENGINE_TORQUE


class ConverterSteps(NamedTuple):
    """Steps of a driving cycle in a gear with a free converter."""

    converter: ConverterGear
    vehicle: Vehicle
    cases: tuple[Transmission, Transmission]
    """Case with the gear alone, and the case with output and input exchanged."""
    further: Sequence[Mapping[str, Floats]]
    """Values of other numbers at the steps, by path, for both cases."""
    load: tuple[Floats, Floats]
    """Speeds [rad/s] and torques [N*m] of the output, which is the input of the second case."""
    rows: Integers
    """Indices of the steps in the cycle."""
    are_slowing: Booleans
    """True for steps that slow the vehicle down, in which inertias drive the gear train."""

    @property
    def _output(self) -> Floats:
        return np.abs(self.load[0])

    def _at(self, chosen: Integers) -> ConverterSteps:
        """Return the steps with the given indices."""
        further = [
            {path: numbers[chosen] for path, numbers in of_case.items()} for of_case in self.further
        ]
        speeds, torques = self.load
        return self._replace(
            further=further,
            load=(speeds[chosen], torques[chosen]),
            rows=self.rows[chosen],
            are_slowing=self.are_slowing[chosen],
        )

    def _torques(
        self, place: int, rows: Integers, load: tuple[Floats, Floats], engine: Floats
    ) -> Floats:
        """Return torques of devices [N*m] in the case `cases[place]`, at engine speeds [rad/s]."""
        ratios = self.converter.ratio(engine, self._output[rows])
        further = self._further(place, rows, engine)
        return self.converter.torques(self.cases[place], load, ratios, further)

    def _further(self, place: int, rows: Integers, engine: Floats) -> dict[str, Floats]:
        """Return other numbers of the case `cases[place]` at engine speeds [rad/s], by path."""
        further = {path: numbers[rows] for path, numbers in self.further[place].items()}
        case = self.converter.case
        for path, slip in relative_slips(case, case.gears[0]).items():
            further[path] = slip * engine
        return further

    def _from_engine(self, rows: Integers, engine: Floats, torque: Floats) -> Floats:
        return self._torques(0, rows, (engine, torque), engine)

    def _search(self, carried: Carried, points: Sequence[float] = ()) -> EngineSearch:
        """Search for engine speeds; the slope of the torque changes at `points` [rad/s]."""
        first = self.vehicle.first_speed
        speeds = [first, *(point for point in points if point > first), FASTEST_OF_SEARCH]
        with np.errstate(divide="ignore"):
            inverse = 1 / np.array(speeds)
        limits = float(self.converter.points[-1, 0]), 1 / FASTEST_OF_SEARCH, float(inverse[0])
        return self.converter.search(inverse, limits, self._output, carried)

    def from_wheels(self) -> tuple[Floats, Floats]:
        """Return engine speeds [rad/s] and torques [N*m] for the wheel forces of the steps.

        Torques are NaN, except in steps whose brakes absorb an excess. In steps in which a
        freewheel locks the converter up, the engine turns with the turbine.

        Raises
        ------
        CaseError
            If no speed ratio fits a step.
        """
        speeds, torques = self.load
        return self._settled(self.search_of_wheels(torques), speeds * torques >= 0)

    def search_of_wheels(self, torques: Floats) -> EngineSearch:
        """Search for engine speeds at which the pump takes what the wheels need [N*m]."""
        speeds, _ = self.load
        return self._search(
            lambda rows, engine: self._torques(1, rows, (speeds[rows], torques[rows]), engine)
        )

    def _torques_at(self, rows: Integers, engine: Floats) -> Floats:
        """Return engine torques that supply the torque of the pump [N*m]; NaN if impossible."""
        return self.converter.torque_at(
            engine,
            self._output[rows],
            lambda part, torque: self._from_engine(rows[part], engine[part], torque),
        )

    def _at_open_freewheels(
        self, rows: Integers, engine: Floats, torques: Floats
    ) -> tuple[Integers, Floats]:
        """Return the steps in which the pump takes less than it gets, and engine speeds [rad/s].

        In these steps the wheels overrun a freewheel and do not drive the turbine. The drag of the
        turbine needs more torque than the pump takes at the free ratio, so the speed ratio is
        smaller. It follows from the wheel force at which the freewheel carries no torque. Steps
        without such a speed ratio are left out.
        """
        taken, direction = self.converter.taken(engine, self._output[rows])
        brought = self._from_engine(rows, engine, torques)[:, self.converter.row]
        excess = direction * (brought - taken)
        part = np.flatnonzero(excess > SAME_ENGINE_TORQUE)
        rows, engine, torques = rows[part], engine[part], torques[part]
        if not rows.size:
            return rows, engine
        ratios = self.converter.ratio(engine, self._output[rows])
        vary = {"load.speed": engine, "load.torque": torques, self.converter.path: ratios}
        driven = solve(self.cases[0], vary=vary | self._further(0, rows, engine))
        least = -driven.lossy_output_torque_Nm[:, 0]
        speeds = self._at(rows).search_of_wheels(least).engine
        solved = np.isfinite(speeds)
        return rows[solved], speeds[solved]

    def at_overrun(self) -> tuple[Floats, Floats]:
        """Return engine speeds [rad/s] and torques [N*m] if the engine brakes by overrun torque.

        Raises
        ------
        CaseError
            If no speed ratio fits a step.
        """
        overrun = self.vehicle.overrun_torque
        points = [speed for speed, _ in self.vehicle.braking]
        engine, torques = self._settled(
            self._search(
                lambda rows, engine: self._from_engine(rows, engine, overrun(engine)), points
            ),
            np.ones(len(self.rows), np.bool_),
        )
        return engine, np.where(np.isnan(torques), overrun(engine), torques)

    def _settled(self, search: EngineSearch, are_braking: Booleans) -> tuple[Floats, Floats]:
        """Return engine speeds [rad/s], and torques [N*m] of steps at the largest speed ratio."""
        at_lock = self.converter.engine_at(1.0, self._output)
        further = self._further(1, np.arange(len(self.rows)), at_lock)
        locked = self.converter.is_bypassed(self.cases[1], self.load, further)
        torques = np.full(len(at_lock), np.nan)
        surplus = search.surplus[:, 0]  # NaN if no speed ratio gives torques
        # Inertias of the gear train can drive the turbine although the wheels do not.
        are_braking = are_braking | (self.are_slowing & np.isnan(surplus))
        sign = np.where(self.converter.is_driving(search.ends[:, 0], self._output), 1, -1)
        is_strong = np.where(np.isnan(surplus), are_braking, sign * surplus <= 0)
        if self.converter.stops:
            locked = locked | (np.isnan(search.engine) & (sign * surplus <= 0))
        engine = np.where(locked, at_lock, search.engine)
        freest = self.converter.engine_at(self.converter.free_ratio, self._output)
        # The ratios up to the first with braking torque are free, or would gain power.
        is_free = are_braking & ~(is_strong & np.isfinite(surplus)) & (search.ends[:, 0] < freest)
        held = np.flatnonzero(np.isnan(engine) & (is_strong | is_free))
        engine[held] = np.where(is_free, freest, search.ends[:, 0])[held]
        held = held[np.isfinite(engine[held])]
        torques[held] = self._torques_at(held, engine[held])
        opened, speeds = self._at_open_freewheels(held, engine[held], torques[held])
        engine[opened], torques[opened] = speeds, self._torques_at(opened, speeds)
        lacking = np.isnan(engine)
        lacking[held] = np.isnan(torques[held])
        if lacking.any():
            name, gear = self.converter.name, self.converter.case.gears[0].name
            low, high = self.converter.points[[0, -1], 0]
            text = (
                f"gear {gear} has no speed ratio of {name} from {low:g} to {high:g} at which the "
                "pump takes the torque that it gets"
            )
            raise CaseError([Problem("E424", text, (int(row),)) for row in self.rows[lacking]])
        return engine, torques
