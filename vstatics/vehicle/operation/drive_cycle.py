"""Driving cycle: engine torque, energies and fuel over a trace.

In a step between two rows of a trace, the acceleration is constant, the speed is the mean speed,
and the first row gives gear and slope. The wheel force follows from these quantities. The
transmission is solved backwards, with its output as the input of the calculation. The result is the
engine torque with all losses. Inertias J act as torques ``-J dw/dt`` on their links. If the engine
would have to brake more than its overrun torque, the brakes absorb the difference. At standstill
all torques are zero.

An electric machine supplies a share of each braking force at the wheels. With the efficiency e, its
mechanical power P requires the electric power P/e, or P e if it generates.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, listed, not_allowed
from vstatics.core.model.laws import speed_range, torque_range
from vstatics.core.model.parts import Law
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics.carried import overloads_at_points
from vstatics.core.statics.diagnosis import outside_message
from vstatics.core.statics.points.machines import outside_map
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import Sometimes, document, json_keys
from vstatics.vehicle.case.vehicle import Machine, Vehicle
from vstatics.vehicle.operation.cycle_steps import CycleLosses, CycleSteps, DrivenSteps
from vstatics.vehicle.operation.fuel_map import FuelMap
from vstatics.vehicle.operation.gear_choice import GearChoice
from vstatics.vehicle.operation.trace import Trace, blocks
from vstatics.vehicle.tolerances import NO_CYCLE_ENERGY, SAME_ENGINE_TORQUE

J_OF_KWH = 3.6e6
"""Energy of 1 kWh. [J]"""


@json_keys(
    *("battery", "machine_lost", "battery_lost", "auxiliary", "machine", "engine"),
    *("wheels", "inertias", "brakes", "lost"),
)
class CycleEnergy(NamedTuple):
    """Energies of a driving cycle [J].

    The energy of the engine or machine is the sum of `wheels`, `inertias`, `brakes` and `lost`.
    """

    engine: Sometimes[float]
    """Energy that the engine supplies; absent with an electric machine."""
    wheels: float
    """Energy of road resistance and acceleration of the vehicle mass."""
    inertias: float
    """Energy that accelerates rotating parts, including sudden changes of speed at shifts."""
    brakes: float
    lost: Mapping[str, float]
    """Lost energy by gear set, or by ``drag.NAME``, ``slip.NAME`` or ``gear.NAME``."""
    machine: Sometimes[float] = None
    """Mechanical energy that the electric machine supplies."""
    machine_lost: Sometimes[float] = None
    """Energy lost in the machine."""
    battery_lost: Sometimes[float] = None
    """Energy lost in the battery."""
    auxiliary: Sometimes[float] = None
    """Energy of other consumers of the battery; absent without consumers."""

    @property
    def battery(self) -> Sometimes[float]:
        """Energy from the battery: machine, other consumers, and losses of machine and battery."""
        if self.machine is None or self.machine_lost is None or self.battery_lost is None:
            return None
        return self.machine + self.machine_lost + self.battery_lost + (self.auxiliary or 0.0)


class BatteryEnergy(NamedTuple):
    """Energies that leave a battery (`out`) and re-enter it in a driving cycle [J]."""

    out: float
    returned: float


@json_keys("duration", "distance", "fuel", "energy", "battery", "consumption", "messages")
class DriveCycle(NamedTuple):
    """Results of a driving cycle."""

    duration: float
    """Duration of the cycle. [s]"""
    distance: float
    """Distance of the vehicle. [m]"""
    fuel: float
    """Consumed fuel; NaN without a fuel map. [g]"""
    energy: CycleEnergy
    gears: Sequence[str]
    """Name of the gear in each step."""
    beyond: int
    """Number of steps whose engine torque is above full load."""
    messages: Sequence[Message]
    """Warnings and notes."""
    steps: Mapping[str, Floats]
    """Columns of values at the middle of the steps, by heading with unit."""
    battery: Sometimes[BatteryEnergy] = None
    """Energies of the battery of an electric machine."""
    consumption: Sometimes[float] = None
    """Energy from the battery per distance; NaN at distance 0. [kWh/100 km]"""


def drive(
    case: Transmission, trace: Trace, choice: GearChoice, fuel: FuelMap | None = None
) -> DriveCycle:
    """Calculate the operating points, energies and losses of a vehicle in a driving cycle.

    Raises
    ------
    CaseError
        If the case has no vehicle, or a gear of the trace does not exist or has no torques. The
        paths of the problems are rows of the trace.

    Examples
    --------
    1000 kg from rest to 10 m/s in 10 s, with a gear pair of efficiency 0.8: 50 kJ at the wheels.

    >>> from vstatics import Gear, Mechanism
    >>> from vstatics.vehicle.case.vehicle import Vehicle
    >>> from vstatics.vehicle.operation.trace import read_trace
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0, 0.8, name="pair")], [Gear(name="1")],
    ...                     vehicle=Vehicle(1000, 0.5))
    >>> trace = read_trace(b"time [s],speed [km/h],gear\\n0,0,1\\n10,36,1\\n", "t.csv")
    >>> driven = drive(case, trace, GearChoice())
    >>> round(driven.energy.engine, 6), round(driven.energy.lost["pair"], 6), driven.distance
    (62500.0, 12500.0, 50.0)
    """
    vehicle = Vehicle.needed(case)
    driven = CycleSteps.of(case, vehicle, trace, choice).driven(np.flatnonzero(trace.speed > 0))
    steps, engine = driven.steps, driven.torques
    speeds = steps.engine_speeds
    lost, brakes = _losses(driven)
    energy = CycleEnergy(
        _total(engine * speeds * trace.duration),
        _total(steps.forces * trace.speed * trace.duration),
        _total(steps.inertia_energies),
        brakes,
        dict(lost.energies),
    )
    full = vehicle.full_torque(speeds) if vehicle.full_load else np.inf
    is_beyond = np.asarray(engine > full + SAME_ENGINE_TORQUE)
    taken, course = math.nan, steps.course(engine)
    outside = [*lost.outside]
    if fuel is not None:
        turning = np.where(trace.speed > 0, speeds, 0.0)
        rates = fuel.at(turning, engine)
        taken = float(rates @ trace.duration)
        course["fuel [g/h]"] = 3600 * rates
        of_map = f"{speed_range(fuel.speeds.tolist())}, {torque_range(fuel.torques.tolist())}"
        outside += [f"vehicle.fuel ({of_map})"] * bool(fuel.is_beyond(turning, engine).any())
    distance = float(trace.speed @ trace.duration)
    battery: BatteryEnergy | None = None
    if vehicle.machine is not None:
        supply = ElectricSupply.of(vehicle.machine, speeds, engine)
        course["battery power [W]"] = supply.battery
        energy = supply.energies(energy, trace.duration)
        given = supply.battery * trace.duration
        battery = BatteryEnergy(float(given[given > 0].sum()), float(-given[given < 0].sum()) + 0.0)
        if supply.is_outside and isinstance(law := vehicle.machine.efficiency, Law):
            outside.append(f"vehicle.machine.efficiency ({law.domain()})")
    gears = [case.gears[index].name for index in steps.gears]
    duration = float(trace.duration.sum())
    notes = (Message(note.id, note.message) for note in trace.notes)
    doubts = *notes, *_doubts(steps, is_beyond), *_overloads(case, steps, lost.held_torques)
    doubts += (outside_message(outside),) * bool(outside)
    messages = not_allowed(doubts, case.untold)
    course |= steps.input_course(engine)
    consumption = None if energy.battery is None else _per_distance(energy.battery, distance)
    return DriveCycle(
        *(duration, distance, taken, energy, gears, int(is_beyond.sum()), messages, course),
        battery=battery,
        consumption=consumption,
    )


def _losses(driven: DrivenSteps) -> tuple[CycleLosses, float]:
    """Return the losses in a driving cycle, and the energy of the brakes [J]."""
    steps, engine, limited = driven
    is_moving = steps.trace.speed > 0
    held = np.zeros((len(engine), len(steps.case.shift_elements)))
    lost = CycleLosses(defaultdict(float), {}, held)
    brakes = math.fsum(
        steps.add_losses(rows, engine, lost) for rows in _blocks(is_moving & ~limited)
    )
    brakes += math.fsum(steps.braked(rows, engine, lost) for rows in _blocks(limited))
    return lost, brakes


def _total(energies: Floats) -> float:
    total = float(energies.sum())
    return 0.0 if abs(total) <= NO_CYCLE_ENERGY * float(np.abs(energies).sum()) else total


def _per_distance(energy: float, distance: float) -> float:
    """Return an energy [J] per distance [m] in kWh/100 km."""
    return energy / J_OF_KWH / (distance / 1e5) if distance else math.nan


class ElectricSupply(NamedTuple):
    """Powers of an electric machine and its battery in each step, in W."""

    mechanical: Floats
    electric: Floats
    battery: Floats
    auxiliary: float
    is_outside: bool
    """True if the efficiency was evaluated outside its map."""

    @classmethod
    def of(cls, machine: Machine, speeds: Floats, torques: Floats) -> ElectricSupply:
        """Return the powers at speeds [rad/s] and torques in the direction of the speeds [N*m].

        Raises
        ------
        CaseError
            If a formula gives no efficiency in a step.
        """
        mechanical = torques * speeds
        electric = machine.electric_power(mechanical, speeds, torques)
        problems = [
            Problem(
                "E424",
                f"the formula for the efficiency of the machine, at {speeds[row]:g} rad/s and "
                f"{torques[row]:g} N*m, is not above 0 and at most 1",
                (int(row),),
            )
            for row in np.flatnonzero(np.isnan(electric))
        ]
        if problems:
            raise CaseError(problems)
        law, is_outside = machine.efficiency, False
        if isinstance(law, Law):
            is_outside = bool(outside_map(law, speeds, torques, mechanical).any())
        battery = machine.battery_power(electric)
        return cls(mechanical, electric, battery, 1e3 * machine.auxiliary, is_outside)

    def energies(self, energy: CycleEnergy, duration: Floats) -> CycleEnergy:
        """Return the energies of a cycle, with machine and battery instead of an engine."""
        return energy._replace(
            engine=None,
            machine=energy.engine,
            machine_lost=float((self.electric - self.mechanical) @ duration),
            battery_lost=float((self.battery - self.electric - self.auxiliary) @ duration),
            auxiliary=self.auxiliary * float(duration.sum()) if self.auxiliary else None,
        )


def _blocks(are_wanted: Booleans) -> Iterator[Integers]:
    wanted = np.flatnonzero(are_wanted)
    for part in blocks(len(wanted)):
        yield wanted[part]


def _doubts(steps: CycleSteps, is_beyond: Booleans) -> Iterator[Message]:
    """Yield warnings about guessed forward gears, and excessive engine speeds and torques."""
    if steps.guessed:
        text = f"forward is taken as {listed(steps.guessed)}, which are written first"
        yield Message(
            "N417",
            f"{text}: as many gears have the other direction, and no gear has a name such as R",
        )
    vehicle, speeds = steps.vehicle, steps.engine_speeds
    drive = "machine" if vehicle.machine else "engine"
    too_fast = ~vehicle.may_turn(speeds)
    if too_fast.any():
        last, fastest = (speed * 30 / math.pi for speed in (vehicle.full_load[-1][0], speeds.max()))
        text = (
            f"{_in_steps(steps, too_fast)} the {drive} would rotate at up to "
            f"{fastest:.6g} rpm, faster than at its last point, {last:.6g} rpm"
        )
        yield Message("W428", text)
    if is_beyond.any():
        text = f"the {drive} would need more torque than at full load"
        yield Message("W429", f"{_in_steps(steps, is_beyond)} {text}")


def _in_steps(steps: CycleSteps, are_wrong: Booleans) -> str:
    """Return the number of wrong steps, and the start of the first, as text for a message."""
    start = steps.trace.table.numbers["time"][int(are_wrong.argmax())]
    return f"in {int(are_wrong.sum())} of {len(are_wrong)} steps, the first at {start:.6g} s,"


def _overloads(case: Transmission, steps: CycleSteps, torques: Floats) -> Iterator[Message]:
    """Yield warnings about overloaded shift elements; `torques` is (steps, elements) [N*m]."""

    def where(row: int) -> str:
        start = steps.trace.table.numbers["time"][row]
        return f"from {start:.6g} s on, gear {case.gears[int(steps.gears[row])].name}"

    return overloads_at_points(case, torques, "steps", where)


@document("vstatics-cycle")
class CycleAnswer(NamedTuple):
    """JSON document of `vstatics cycle`."""

    name: str
    cycle: DriveCycle
